//! The queue runner, one job kind a file.
