//! Reuse of trials: those of earlier runs with the same set-up are found when a job is submitted and stored in it, so
//! that it needs nothing else and goes on with the same bits.
//!
//! Runs share their trials when the same pose shows the same: one robot (by name, content of its URDF, chain and tool),
//! one world without memory, one list of features, and one reality. A simulated reality that draws its robot is the
//! same one only with the same seed, which each repetition has for itself unless `reality.seed` is given.

use super::reference::missing;
use crate::app::UseCases;
use crate::app::model::{AppError, EarlierRun, ExecutionRequest, FieldError, RobotView, RunView};
use crate::framework::execution::Problem;
use crate::framework::method::whole_run::Trial;
use serde_json::json;
use sha2::{Digest as _, Sha256};

/// Maximum number of earlier trials a method begins with: more of them take long and teach little.
const MAX_TRIALS: usize = 60;
/// Maximum number of runs searched for them.
const MAX_RUNS: u32 = 20;

/// Digest of everything that determines an observation (robot, tool, world, features); `None` if two runs can never
/// share trials.
pub(super) fn setup_key(robot: &RobotView, problem: &Problem, seed: u64, repetitions: u32) -> Option<String> {
    if problem.world.properties().surface.is_some() {
        return None;
    }
    let mut reality = problem.execution.reality.clone();
    if let Some(reality) = &mut reality {
        if !reality.is_distorted() {
            reality.seed = None;
        } else if reality.seed.is_none() {
            if repetitions > 1 {
                return None;
            }
            reality.seed = Some(seed);
        }
    }
    let chain = &robot.chain;
    let joints: Vec<&str> = chain.free_joints.iter().map(|joint| joint.name.as_str()).collect();
    let all = json!({
        "robot": [&robot.name, &robot.urdf_sha256, &chain.base_link, &chain.tip_link],
        "joints": joints,
        "fixed": chain.fixed_joints,
        "tool_offset_m": problem.robot.tool_offset_m,
        "world": problem.world,
        "reality": reality,
        "features": problem.goals.features(),
    });
    Some(hex::encode(Sha256::digest(all.to_string())))
}

impl UseCases {
    /// The trials the job begins with; records in `request` the runs they come from.
    pub(super) async fn earlier_trials(
        &self,
        request: &mut ExecutionRequest,
        setup_key: Option<&str>,
    ) -> Result<Vec<Trial>, AppError> {
        let begins_with_trials = request.execution.method.profile().learns_from_earlier_runs;
        let found = match (&request.earlier_runs, setup_key) {
            (None, Some(setup_key)) if begins_with_trials => self.ports.store.runs_on(setup_key, MAX_RUNS).await?,
            (None, _) => return Ok(Vec::new()),
            (Some(named), _) if named.is_empty() => return Ok(Vec::new()),
            (Some(_), _) if !begins_with_trials => {
                let detail = "only the method model begins with earlier trials: leave them out";
                return Err(AppError::field("/earlier_runs", "not_used", detail));
            }
            (Some(named), setup_key) => self.named_trials(named, setup_key).await?,
        };
        let mut left = MAX_TRIALS;
        let mut trials = Vec::new();
        let mut told = Vec::new();
        for (run, of_run) in found {
            let seen: Vec<Trial> = of_run.into_iter().filter(|trial| trial.observation.is_some()).collect();
            let latest = seen.len().saturating_sub(left);
            if seen.len() == latest {
                continue;
            }
            let count = u32::try_from(seen.len() - latest).unwrap_or(u32::MAX);
            told.push(EarlierRun { run: run.id, job: Some(run.job), trials: Some(count) });
            left -= seen.len() - latest;
            trials.splice(0..0, seen.into_iter().skip(latest));
        }
        request.earlier_runs = Some(told);
        Ok(trials)
    }

    async fn named_trials(
        &self,
        named: &[EarlierRun],
        setup_key: Option<&str>,
    ) -> Result<Vec<(RunView, Vec<Trial>)>, AppError> {
        let mut found = Vec::with_capacity(named.len());
        let mut errors = Vec::new();
        for (index, earlier) in named.iter().enumerate().take(MAX_RUNS as usize) {
            let pointer = format!("/earlier_runs/{index}/run");
            let run = match self.ports.store.run(&earlier.run).await {
                Ok(run) => run,
                Err(error) => {
                    errors.push(missing(pointer, error)?);
                    continue;
                }
            };
            let kept = self.ports.store.run_trials(&earlier.run).await?;
            if kept.setup_key.is_some() && kept.setup_key.as_deref() == setup_key {
                found.push((run, kept.trials));
                continue;
            }

            let detail = format!(
                "{} has no trials of this robot, tool, world and features: name another run, or give [] to begin with \
                 none",
                earlier.run
            );
            errors.push(FieldError::new(pointer, "other_robot", detail));
        }
        if errors.is_empty() { Ok(found) } else { Err(AppError::invalid(errors)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::{RobotId, Timestamp};
    use crate::framework::robot::{Chain, RobotModel, summarize, summarize_chain};
    use crate::framework::world::DisturbanceSpec;
    use crate::reproduce::shipped;

    fn robot(problem: &Problem) -> RobotView {
        let model = RobotModel::from_urdf(&problem.urdf).unwrap();
        let chain = Chain::new(&model, &problem.robot).unwrap();
        RobotView {
            id: RobotId::from_uuid(uuid::Uuid::from_u128(1)),
            name: "arm".to_owned(),
            version: 1,
            spec: problem.robot.clone(),
            summary: summarize(&model),
            chain: summarize_chain(&chain),
            urdf_sha256: "0".to_owned(),
            created_at: Timestamp(0),
        }
    }

    #[test]
    fn the_setup_key_is_all_that_decides_what_a_pose_shows_and_nothing_else() {
        let problem = shipped::preset("wax").unwrap().problem;
        let of = |problem: &Problem, seed, repetitions| setup_key(&robot(problem), problem, seed, repetitions);
        let same = of(&problem, 1, 1);
        assert!(same.is_some());
        let mut other = problem.clone();
        other.execution.tolerance = Some(3.0);
        other.robot.acceleration.clear();
        assert_eq!(of(&other, 2, 5), same);
        let mut tool = problem.clone();
        tool.robot.tool_offset_m[2] += 0.01;
        assert_ne!(of(&tool, 1, 1), same);
        let mut drawn = problem.clone();
        drawn.execution.reality = Some(DisturbanceSpec { link_share: 0.05, ..DisturbanceSpec::default() });
        assert!(of(&drawn, 1, 1).is_some() && of(&drawn, 1, 1) != of(&drawn, 2, 1));
        assert_eq!(of(&drawn, 1, 2), None, "each repetition meets a robot of its own");
        let mut own = drawn.clone();
        own.execution.reality.as_mut().unwrap().seed = Some(1);
        assert_eq!(of(&own, 7, 3), of(&drawn, 1, 1));
        assert_eq!(of(&shipped::preset("paint").unwrap().problem, 1, 1), None, "what a pose paints changes with time");
    }
}
