//! Demonstrations, actions, robots, worlds, runs and experiments.

use super::{Data, Experiment, MemoryStore, check_unused, found, page, taken, trials};
use crate::app::model::{
    ActionGoals, ActionId, ActionView, ConvergencePoint, DemonstrationId, DemonstrationReport, DemonstrationView,
    ExperimentId, ExperimentView, JobId, Keyset, PatchDemonstration, RobotId, RobotView, RowFilter, RunFilter,
    RunGoals, RunId, RunView, TrajectoryId, TrajectoryView, WorldId, WorldView,
};
use crate::app::ports::rules::check_revision;
use crate::app::ports::store::{
    Actions, Demonstrations, Experiments, KeptTrials, NewDemonstration, NewRobot, Robots, Runs, StoreError, Worlds,
};
use crate::framework::experiment::{Plan, RunRow};
use crate::framework::method::whole_run::Trial;
use async_trait::async_trait;

#[async_trait]
impl Demonstrations for MemoryStore {
    async fn insert_demonstration(&self, new: NewDemonstration) -> Result<(), StoreError> {
        self.write(|data| match data.demonstrations.insert(new.view.id.clone(), new) {
            Some(_) => Err(taken("demonstration")),
            None => Ok(()),
        })
    }

    async fn demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, StoreError> {
        self.read(|data| found(data.demonstrations.get(id).map(|kept| kept.view.clone()), "demonstration", id))
    }

    async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, StoreError> {
        self.read(|data| found(data.demonstrations.get(id).map(|kept| kept.report.clone()), "demonstration", id))
    }

    async fn demonstration_samples(&self, id: &DemonstrationId) -> Result<Vec<u8>, StoreError> {
        self.read(|data| found(data.demonstrations.get(id).map(|kept| kept.samples.clone()), "demonstration", id))
    }

    async fn demonstrations(&self, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError> {
        let kept = self.read(|data| page(&data.demonstrations, keyset, |_| true));
        Ok(kept.into_iter().map(|kept| kept.view).collect())
    }

    async fn demonstrations_with_content(&self, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError> {
        let same = |data: &Data| {
            let same = data.demonstrations.values().filter(|kept| kept.view.sha256 == sha256);
            same.map(|kept| kept.view.id.clone()).collect()
        };
        Ok(self.read(same))
    }

    async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, StoreError> {
        self.write(|data| {
            let kept = found(data.demonstrations.get_mut(id), "demonstration", id)?;
            check_revision(&kept.view, if_match)?;
            kept.view = kept.view.clone().patched(patch);
            Ok(kept.view.clone())
        })
    }

    async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), StoreError> {
        self.write(|data| check_revision(&found(data.demonstrations.remove(id), "demonstration", id)?.view, if_match))
    }
}

#[async_trait]
impl Actions for MemoryStore {
    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError> {
        self.read(|data| found(data.actions.get(id).map(|(view, _)| view.clone()), "action", id))
    }

    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError> {
        self.read(|data| found(data.actions.get(id).map(|(_, goals)| goals.clone()), "action", id))
    }

    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError> {
        let kept = self.read(|data| page(&data.actions, keyset, |_| true));
        Ok(kept.into_iter().map(|(view, _)| view).collect())
    }
}

#[async_trait]
impl Robots for MemoryStore {
    async fn insert_robot(&self, new: NewRobot) -> Result<RobotView, StoreError> {
        let NewRobot { mut view, urdf } = new;
        self.write(|data| {
            let versions = data.robots.values().filter(|(other, _)| other.name == view.name);
            view.version = versions.map(|(other, _)| other.version).max().unwrap_or(0) + 1;
            data.robots.insert(view.id.clone(), (view.clone(), urdf));
            Ok(view)
        })
    }

    async fn robot(&self, id: &RobotId) -> Result<RobotView, StoreError> {
        self.read(|data| found(data.robots.get(id).map(|(view, _)| view.clone()), "robot", id))
    }

    async fn robot_urdf(&self, id: &RobotId) -> Result<String, StoreError> {
        self.read(|data| found(data.robots.get(id).map(|(_, urdf)| urdf.clone()), "robot", id))
    }

    async fn robots(&self, keyset: &Keyset) -> Result<Vec<RobotView>, StoreError> {
        let kept = self.read(|data| page(&data.robots, keyset, |_| true));
        Ok(kept.into_iter().map(|(view, _)| view).collect())
    }

    async fn delete_robot(&self, id: &RobotId) -> Result<(), StoreError> {
        self.write(|data| {
            check_unused(data, id.as_str(), |uses| uses.robot.as_ref() == Some(id))?;
            found(data.robots.remove(id), "robot", id).map(drop)
        })
    }
}

#[async_trait]
impl Worlds for MemoryStore {
    async fn insert_world(&self, new: WorldView) -> Result<(), StoreError> {
        self.write(|data| {
            data.worlds.insert(new.id.clone(), new);
            Ok(())
        })
    }

    async fn world(&self, id: &WorldId) -> Result<WorldView, StoreError> {
        self.read(|data| found(data.worlds.get(id).cloned(), "world", id))
    }

    async fn worlds(&self, keyset: &Keyset) -> Result<Vec<WorldView>, StoreError> {
        Ok(self.read(|data| page(&data.worlds, keyset, |_| true)))
    }

    async fn delete_world(&self, id: &WorldId) -> Result<(), StoreError> {
        self.write(|data| {
            check_unused(data, id.as_str(), |uses| uses.world.as_ref() == Some(id))?;
            found(data.worlds.remove(id), "world", id).map(drop)
        })
    }
}

#[async_trait]
impl Runs for MemoryStore {
    async fn run(&self, id: &RunId) -> Result<RunView, StoreError> {
        self.read(|data| found(data.runs.get(id).map(|kept| kept.view.clone()), "run", id))
    }

    async fn run_goals(&self, id: &RunId) -> Result<RunGoals, StoreError> {
        self.read(|data| found(data.runs.get(id).map(|kept| kept.goals.clone()), "run", id))
    }

    async fn run_convergence(&self, id: &RunId) -> Result<Vec<ConvergencePoint>, StoreError> {
        self.read(|data| found(data.runs.get(id).map(|kept| kept.convergence.clone()), "run", id))
    }

    async fn run_trials(&self, id: &RunId) -> Result<KeptTrials, StoreError> {
        Ok(self.read(|data| data.runs.get(id).map(trials).unwrap_or_default()))
    }

    async fn runs_on(&self, setup_key: &str, limit: u32) -> Result<Vec<(RunView, Vec<Trial>)>, StoreError> {
        let on_setup = |data: &Data| {
            let kept = data.runs.values().rev().filter(|kept| trials(kept).setup_key.as_deref() == Some(setup_key));
            kept.take(limit as usize).map(|kept| (kept.view.clone(), kept.trials.trials.clone())).collect()
        };
        Ok(self.read(on_setup))
    }

    async fn runs(&self, filter: &RunFilter, keyset: &Keyset) -> Result<Vec<RunView>, StoreError> {
        let is_wanted = |job: &JobId| filter.job.as_ref().is_none_or(|wanted| wanted == job);
        let kept = self.read(|data| page(&data.runs, keyset, |kept| is_wanted(&kept.view.job)));
        Ok(kept.into_iter().map(|kept| kept.view).collect())
    }

    async fn trajectory(&self, id: &TrajectoryId) -> Result<TrajectoryView, StoreError> {
        let of_runs = |data: &Data| {
            data.runs.values().filter_map(|kept| kept.trajectory.as_ref()).find(|kept| kept.id == *id).cloned()
        };
        found(self.read(of_runs), "trajectory", id)
    }
}

impl Data {
    fn shown(&self, kept: &Experiment) -> ExperimentView {
        let view = kept.new.view.clone();
        let state = self.jobs.get(&view.job).map_or(view.state, |job| job.view.state);
        ExperimentView { state, finished_runs: kept.rows.len() as u64, ..view }
    }
}

#[async_trait]
impl Experiments for MemoryStore {
    async fn experiment(&self, id: &ExperimentId) -> Result<ExperimentView, StoreError> {
        self.read(|data| found(data.experiments.get(id).map(|kept| data.shown(kept)), "experiment", id))
    }

    async fn experiments(&self, keyset: &Keyset) -> Result<Vec<ExperimentView>, StoreError> {
        let shown = |data: &Data| {
            let kept = page(&data.experiments, keyset, |_| true);
            kept.iter().map(|kept| data.shown(kept)).collect()
        };
        Ok(self.read(shown))
    }

    async fn experiment_plan(&self, id: &ExperimentId) -> Result<Plan, StoreError> {
        self.read(|data| found(data.experiments.get(id).map(|kept| kept.new.plan.clone()), "experiment", id))
    }

    async fn experiment_rows(&self, id: &ExperimentId, filter: &RowFilter) -> Result<Vec<RunRow>, StoreError> {
        let limit = filter.limit.map_or(usize::MAX, |limit| limit as usize);
        let is_wanted = |row: &&RunRow| {
            let place = (row.id.cell, row.id.repetition);
            filter.cell.is_none_or(|cell| cell == row.id.cell)
                && filter.after.is_none_or(|after| place > (after.cell, after.repetition))
        };
        let rows = |data: &Data| {
            let rows = data.experiments.get(id).into_iter().flat_map(|kept| kept.rows.values());
            rows.filter(is_wanted).take(limit).cloned().collect()
        };
        Ok(self.read(rows))
    }
}
