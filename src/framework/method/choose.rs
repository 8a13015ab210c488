//! Choice of the method that `auto` stands for, with its reason: a pure function of the problem and the wishes.
//!
//! The figures behind each branch are those of the shipped presets (three joints, 20 to 50 seeds):
//! - features that follow the pose: a model takes 14 to 20 evaluations, CMA-ES 920; if evaluations cost nothing, CMA-ES
//!   to 0.1 % of the joints' ranges ends 2 mm above what can be reached (146 mm of 144 mm, 2700 evaluations);
//! - a surface: particles 16 evaluations for 16 cells; the search 182 for 99 % of them; CMA-ES all of them in 437;
//!   with hundreds of cells one pose per goal is too few, and the search goes on whatever the goals are;
//! - constraints that judge a population, or penalties: CMA-ES 870 evaluations to 209 mm, PSO 5800 to 202 mm, SST 21000
//!   to 157 mm; on a surface CMA-ES 195 for all cells, SST 228 for 97 %.

use super::auto::AutoSpec;
use super::catalogue::MethodSpec;
use super::per_goal::CmaEsSpec;
use super::whole_run::{CoverSpec, ModelSpec, ParticleSpec, Prior};
use crate::world::WorldProperties;
use serde::{Deserialize, Serialize};

/// Precision of a search whose evaluations cost nothing, as a share of each joint's range.
const FREE_PRECISION: f64 = 0.001;

/// Most cells of a surface that methods of one pose per goal are chosen for.
const FEW_CELLS: usize = 48;

/// The method that was chosen for a problem, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// Name of the method.
    pub method: String,
    /// One sentence for the person who runs the robot.
    pub reason: String,
}

/// The method for a problem, and why.
///
/// `needs_population` says whether constraints or their handling judge whole generations of candidates.
#[must_use]
pub fn choose(wishes: &AutoSpec, needs_population: bool, world: &WorldProperties) -> (MethodSpec, &'static str) {
    if needs_population {
        return (
            MethodSpec::CmaEs(CmaEsSpec::default()),
            "The constraints are judged on whole generations of candidates, which the methods of few trials do not have: \
             CMA-ES honours them with the fewest trials.",
        );
    }
    match (world.surface.is_some(), wishes.simulator, wishes.free_evaluations) {
        (true, true, _) => (
            MethodSpec::Particle(ParticleSpec::default()),
            "A surface is to be covered and the robot's description may be used: each trial is the pose that most of many \
             slightly different simulated robots expect to cover one new place, about one trial per place.",
        ),
        (true, false, true) if world.surface.is_some_and(|surface| surface.cells() <= FEW_CELLS) => (
            MethodSpec::CmaEs(CmaEsSpec::default()),
            "A surface is to be covered and trials cost nothing: CMA-ES goes on until every place is covered.",
        ),
        (true, false, _) => (
            MethodSpec::Search(CoverSpec::default()),
            "A surface is to be covered and nothing may be assumed of the robot: each trial is where past trials leave the \
             best chance of covering a new place.",
        ),
        (false, _, true) => (
            MethodSpec::CmaEs(CmaEsSpec { precision: FREE_PRECISION, ..CmaEsSpec::default() }),
            "Trials cost nothing, so the best result counts: CMA-ES searches on to a fine precision.",
        ),
        (false, true, false) => (
            MethodSpec::Model(ModelSpec { prior: Prior::Simulator, noise: wishes.noise, ..ModelSpec::default() }),
            "What is seen follows the pose, and the robot's description serves as a first guess: a model corrects it from \
             trial to trial, about one trial per goal.",
        ),
        (false, false, false) => (
            MethodSpec::Model(ModelSpec { noise: wishes.noise, ..ModelSpec::default() }),
            "What is seen follows the pose, and nothing may be assumed of the robot: a few first moves teach a model of it, \
             then one or two trials per goal do.",
        ),
    }
}
