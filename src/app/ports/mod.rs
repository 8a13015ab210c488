//! What the use-cases need from outside: storage, time, ids and seeds, wake-ups.

mod clock;
mod events;
mod ids;
mod store;

pub use clock::Clock;
pub use events::{Events, LocalEvents, Wake};
pub use ids::{Ids, SEED_BOUND};
pub use store::{
    Advance, Claim, Claimed, IdempotencyKey, KeptTrials, NewDemonstration, NewExperiment, NewJob, NewRobot, NewRun,
    Store, StoreError, Submitted, Transition, Usage,
};
