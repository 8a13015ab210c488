//! Methods: how the joints for each goal are found.
//!
//! # Architecture Invariants
//! - A method owns no world: it names candidates and is told what became of them.
//! - The seed is mandatory; what a method saves holds its random stream, so that it resumes with the same bits.
//! - A method's file or folder owns its parameters, their check, what it needs of a world, start and resume. The
//!   [`catalogue()`] lists them; adding a method is a file and a row there.

mod auto;
mod catalogue;
mod choose;
mod contract;
mod notation;
mod parameters;
pub mod per_goal;
mod range;
pub mod whole_run;

pub use auto::AutoSpec;
pub use catalogue::{MethodEntry, MethodSpec, catalogue};
pub use choose::{Chosen, choose};
pub use contract::{Effects, Knowledge, Method, Needs, Profile, Scope, SimulatorUse};
pub use notation::{MethodChoice, method_or_name};
pub use parameters::{Choice, Parameter, ParameterValue, Parameters, Values};
pub use range::{OutOfRange, Range};
