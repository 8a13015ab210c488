//! The one service layer: use-cases and the ports they need.
