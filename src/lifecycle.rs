//! Start-up gates, signals and orderly shutdown.
