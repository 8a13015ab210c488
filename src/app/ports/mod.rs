//! Ports of the use-cases to the outside: storage, evaluation, time, ids and seeds, wake-ups.

mod clock;
mod evaluator;
mod events;
mod ids;
pub mod rules;
mod store;

pub use clock::Clock;
#[cfg(test)]
pub use clock::TestClock;
pub use evaluator::{Evaluator, EvaluatorError, Evaluators, RunContext, TrialId, Trials};
pub use events::{Events, LocalEvents, Wake};
pub use ids::Ids;
#[cfg(test)]
pub use ids::TestIds;
pub use store::{
    Actions, Advance, Claim, Claimed, Demonstrations, Experiments, IdempotencyKey, Jobs, KeptTrials, NewDemonstration,
    NewExperiment, NewJob, NewRobot, NewRun, Product, Queue, Robots, Runs, Store, StoreError, Submitted, Transition,
    Usage, Worlds,
};
#[cfg(test)]
pub use store::{Connection, MemoryStore};
