//! The job state machine.
