//! Methods: how the joints for each goal are found.
//!
//! # Architecture Invariants
//! - A method owns no world: it proposes candidates and receives their outcomes.
//! - The seed is mandatory; a saved method includes its random stream, so that it resumes with the same bits.
//! - A method's file or folder owns its parameters, their check, its needs, start and resume. The
//!   [`catalogue()`] lists them; adding a method is a file and a row there.
//!
//! # A method of your own
//! Random search, one search per goal; a method that plans the whole run implements [`whole_run::WholeRunMethod`]:
//! ```
//! use cgda_core::Feature;
//! use cgda_core::execution::{ExecutionSpec, Iet, Problem, simulate};
//! use cgda_core::generalization::Goals;
//! use cgda_core::method::{MethodKind, MethodSpec};
//! use cgda_core::method::per_goal::{
//!     Batch, Best, Optimizer, OptimizerError, OptimizerState, Outcome, PerGoalMethod, Provenance, SearchSpace,
//!     StopReason,
//! };
//! use cgda_core::random::RandomStream;
//! use cgda_core::robot::RobotSpec;
//! use cgda_core::world::{ToolPositionSpec, WorldSpec};
//!
//! struct RandomSearch;
//!
//! struct Search {
//!     space: SearchSpace,
//!     random: RandomStream,
//!     asked: Vec<(u64, Vec<f64>)>,
//!     told: u64,
//!     best: Option<(f64, Vec<f64>, Vec<f64>)>,
//! }
//!
//! impl PerGoalMethod for RandomSearch {
//!     fn start(&self, space: SearchSpace, seed: u64, goal: u64) -> Result<Box<dyn Optimizer>, OptimizerError> {
//!         let random = RandomStream::new(seed, goal);
//!         Ok(Box::new(Search { space, random, asked: Vec::new(), told: 0, best: None }))
//!     }
//!     fn resume(&self, space: SearchSpace, state: OptimizerState) -> Result<Box<dyn Optimizer>, OptimizerError> {
//!         let (random, told, best) = state.read("random")?;
//!         Ok(Box::new(Search { space, random, asked: Vec::new(), told, best }))
//!     }
//! }
//!
//! impl Optimizer for Search {
//!     fn ask(&mut self, batch: &mut Batch) {
//!         while !batch.is_full() {
//!             let limits = self.space.lower.iter().zip(&self.space.upper);
//!             let joints: Vec<f64> = limits.map(|(&low, &high)| self.random.between(low, high)).collect();
//!             let id = self.told + self.asked.len() as u64;
//!             batch.push(id, &joints);
//!             self.asked.push((id, joints));
//!         }
//!     }
//!     fn tell(&mut self, id: u64, outcome: Outcome<'_>) {
//!         let Some(at) = self.asked.iter().position(|asked| asked.0 == id) else { return };
//!         let (_, joints) = self.asked.remove(at);
//!         self.told += 1;
//!         if let Outcome::Observed { fitness, observation, .. } = outcome
//!             && self.best.as_ref().is_none_or(|best| fitness < best.0)
//!         {
//!             self.best = Some((fitness, joints, observation.to_vec()));
//!         }
//!     }
//!     fn best(&self) -> Option<Best<'_>> {
//!         let (fitness, joints, observation) = self.best.as_ref()?;
//!         Some(Best { joints, fitness: *fitness, observation, provenance: Provenance::Simulated })
//!     }
//!     fn stop(&self) -> Option<StopReason> {
//!         (self.told >= 100).then_some(StopReason::Stagnation)
//!     }
//!     fn state(&self) -> OptimizerState {
//!         OptimizerState::of("random", &(&self.random, self.told, &self.best))
//!     }
//!     fn origins(&self, _: u64) -> [Option<&[f64]>; 2] {
//!         [None; 2]
//!     }
//!     fn amend(&mut self, id: u64, joints: &[f64]) {
//!         if let Some(asked) = self.asked.iter_mut().find(|asked| asked.0 == id) {
//!             asked.1.copy_from_slice(joints);
//!         }
//!     }
//! }
//!
//! let arm = r#"<robot name="arm"><link name="base"/><link name="upper"/><link name="lower"/>
//!   <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
//!     <limit lower="-2" upper="2" velocity="3" effort="1"/></joint>
//!   <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0.3 0 0"/>
//!     <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="3" effort="1"/></joint></robot>"#;
//! let features = vec![Feature::new("x", "m"), Feature::new("y", "m")];
//! let problem = Problem {
//!     goals: Goals::new(features, &[vec![0.3, 0.0], vec![0.2, 0.2]])?,
//!     urdf: arm.to_owned(),
//!     robot: RobotSpec::default(),
//!     world: WorldSpec::ToolPosition(ToolPositionSpec { unit: "m".to_owned() }),
//!     execution: ExecutionSpec::new(MethodSpec::by_name("auto").ok_or("unknown")?),
//!     earlier: Vec::new(),
//! };
//! let mut iet = Iet::with_method(&problem, 7, "random", MethodKind::PerGoal(Box::new(RandomSearch)))?;
//! let mut world = iet.world()?;
//! simulate(&mut iet, world.as_mut(), u64::MAX)?;
//! let result = iet.finish()?;
//! assert_eq!(result.goals.len(), problem.goals.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod auto;
mod catalogue;
mod choose;
mod contract;
mod kind;
mod notation;
mod parameters;
pub mod per_goal;
#[cfg(feature = "schema")]
mod schema;
pub mod whole_run;

pub use auto::AutoSpec;
pub use catalogue::{MethodEntry, MethodSpec, catalogue};
pub use choose::{Chosen, choose};
pub use contract::{Effects, Knowledge, Method, Needs, Profile, Scope, SimulatorUse};
pub use kind::MethodKind;
pub use notation::method_or_name;
pub use parameters::{Choice, Parameter, ParameterValue, Parameters, Values};
#[cfg(feature = "schema")]
pub use schema::{MethodChoice, MethodName};
