//! Generalization: from demonstrations to intermediate goals (paper eq. 1-3).

mod goals;

pub use goals::{Goals, GoalsError};
