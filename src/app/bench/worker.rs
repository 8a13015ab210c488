//! Results as a worker writes them, without the work: an action, a run with its trajectory, rows of an experiment.

use super::{Bench, generalization};
use crate::app::model::{
    ActionGoals, ActionId, ActionView, ConvergencePoint, CreateJob, ExecutionRequest, ExperimentId, JobId, RunGoal,
    RunGoals, RunId, RunView, TrajectoryId, TrajectoryView, Work,
};
use crate::app::ports::{
    Advance, Claimed, Experiments as _, Ids as _, KeptTrials, NewRun, Product, Queue as _, TestClock, Transition,
};
use crate::app::trajectories::{digest, points_of};
use crate::framework::experiment::{RunId as Place, RunRow};
use crate::framework::generalization::Weighting;
use crate::framework::job::Event;
use crate::framework::method::per_goal::{Provenance, StopReason, Tally};
use crate::framework::recognition::Metric;
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::trajectory::{Waypoint, plan};
use crate::reproduce::shipped;
use serde_json::json;
use std::time::Duration;

impl Bench {
    /// Claims the only queued job.
    async fn claimed(&self) -> Claimed {
        let at = TestClock::START;
        let claimed = self.store.claim("t".to_owned(), Duration::from_mins(1), 3, at).await.unwrap().unwrap();
        self.step(&claimed, Advance { transition: Some(Transition::plain(Event::Start)), ..Advance::default() }).await;
        claimed
    }

    async fn step(&self, claimed: &Claimed, step: Advance) {
        self.store.advance(&claimed.claim, step, TestClock::START).await.unwrap();
    }

    async fn succeed(&self, claimed: &Claimed, step: Advance) {
        self.step(claimed, Advance { transition: Some(Transition::plain(Event::Succeed)), ..step }).await;
    }

    /// The wax action of the paper's experiments under another name.
    pub(crate) async fn action(&self, name: &str) -> ActionView {
        let request = generalization(vec![self.demonstration().await]);
        self.app.create_job(CreateJob::Generalization(request), None).await.unwrap();
        let claimed = self.claimed().await;
        let goals = shipped::preset("wax").unwrap().problem.goals;
        let id = ActionId::from_uuid(self.ids.uuid());
        let view = ActionView {
            id: id.clone(),
            name: name.to_owned(),
            version: 0,
            features: goals.features().to_vec(),
            goals: u32::try_from(goals.len()).unwrap(),
            mean_duration_s: 2.0,
            t_min_s: 0.5,
            weighting: Weighting::default(),
            metric: Metric::default(),
            demonstrations: claimed.work.demonstrations().to_vec(),
            job: claimed.job.id.clone(),
            created_at: TestClock::START,
        };
        let rows: Vec<Vec<f64>> = goals.rows().map(<[f64]>::to_vec).collect();
        let matrix = ActionGoals {
            action: id.clone(),
            features: goals.features().to_vec(),
            spread: vec![vec![0.0; goals.features().len()]; rows.len()],
            goals: rows,
        };
        self.succeed(&claimed, made(Product::Action(Box::new((view, matrix))))).await;
        self.app.get_action(&id).await.unwrap()
    }

    /// Submits an execution of a new action on a new robot.
    pub(crate) async fn execution(&self) -> JobId {
        let (action, robot, world) = (self.action("wax").await, self.robot().await, self.world().await);
        let request: ExecutionRequest = serde_json::from_value(json!({
            "action": action.id, "robot": robot.id, "world": world.id, "execution": {"method": "sst"}, "seed": 7,
        }))
        .unwrap();
        self.app.create_job(CreateJob::Execution(Box::new(request)), None).await.unwrap().id
    }

    /// A finished run of a new execution.
    pub(crate) async fn run(&self, has_trajectory: bool) -> RunView {
        self.finish(|trajectory| has_trajectory.then_some(trajectory)).await
    }

    /// The trajectory of such a run, stored with a change.
    pub(crate) async fn run_with(&self, change: impl FnOnce(&mut TrajectoryView)) -> TrajectoryId {
        let run = self.finish(|mut trajectory| {
            change(&mut trajectory);
            Some(trajectory)
        });
        run.await.trajectory.unwrap()
    }

    /// Every goal is reached at the same pose, the first one with many improvements.
    async fn finish(&self, stored: impl FnOnce(TrajectoryView) -> Option<TrajectoryView>) -> RunView {
        self.execution().await;
        let claimed = self.claimed().await;
        let Work::Execution(work) = claimed.work.clone() else { panic!("{:?}", claimed.work) };
        let pose = vec![0.4, 0.6, 0.8];
        let id = RunId::from_uuid(self.ids.uuid());
        let goals = work.problem.goals.rows().enumerate().map(|(index, goal)| RunGoal {
            index: u32::try_from(index).unwrap(),
            evaluations: 10,
            discrepancy: 5.0,
            stop_reason: StopReason::Stagnation,
            judgement: None,
            joints: pose.clone(),
            observation: goal.to_vec(),
            goal: goal.to_vec(),
            residual: Some(0.0),
            winner: Provenance::Simulated,
            true_discrepancy: None,
            feasible: true,
            provenance: Tally { simulated: 10, ..Tally::default() },
        });
        let goals: Vec<RunGoal> = goals.collect();
        let chain = Chain::new(&RobotModel::from_urdf(&work.problem.urdf).unwrap(), &work.problem.robot).unwrap();
        let way = Waypoint::goals(&vec![pose; goals.len()]);
        let planned = plan(&chain, chain.home(), &way, None, &work.planning).unwrap();
        let points = points_of(&planned);
        let trajectory = stored(TrajectoryView {
            id: TrajectoryId::from_uuid(self.ids.uuid()),
            run: id.clone(),
            job: claimed.job.id.clone(),
            robot: work.robot.clone(),
            joint_names: planned.joints().to_vec(),
            fixed_joints: planned.fixed_joints().clone(),
            duration_s: planned.duration_s(),
            pose_times_s: planned.goal_times_s(),
            goal_times_s: planned.goal_times_s(),
            tightest: Vec::new(),
            notes: Vec::new(),
            sha256: digest(&points),
            points,
            created_at: TestClock::START,
        });
        let count = goals.len();
        let view = RunView {
            id: id.clone(),
            job: claimed.job.id.clone(),
            action: work.action.clone(),
            robot: work.robot.clone(),
            world: work.world.clone(),
            evaluations: 10 * count as u64,
            provenance: Tally { simulated: 10 * count as u64, ..Tally::default() },
            goals: u32::try_from(count).unwrap(),
            trajectory: trajectory.as_ref().map(|trajectory| trajectory.id.clone()),
            trajectory_problem: trajectory.is_none().then(|| "too steep".to_owned()),
            created_at: TestClock::START,
            ..RunView::sample()
        };
        let improvement =
            |evaluations| ConvergencePoint { goal_index: 0, evaluations, discrepancy: 1.0 / evaluations as f64 };
        let features = work.problem.goals.features().to_vec();
        let goals = RunGoals {
            run: id,
            features,
            joint_names: planned.joints().to_vec(),
            goals,
            path: Vec::new(),
            painted_cells: None,
        };
        let convergence = (1..=100).map(improvement).collect();
        let run = NewRun { view: view.clone(), goals, convergence, trajectory, trials: KeptTrials::default() };
        self.succeed(&claimed, made(Product::Run(Box::new(run)))).await;
        view
    }

    /// Writes finished runs of the only queued experiment: repetitions `0..repetitions` of each cell, in which cell
    /// `c` takes `100 (c + 1)` evaluations plus the seed.
    pub(crate) async fn rows(&self, cells: u32, repetitions: u32) -> ExperimentId {
        let claimed = self.claimed().await;
        let Work::Experiment { experiment } = claimed.work.clone() else { panic!("{:?}", claimed.work) };
        let plan = self.store.experiment_plan(&experiment).await.unwrap();
        let places = (0..cells).flat_map(|cell| (0..repetitions).map(move |repetition| Place { cell, repetition }));
        let rows = places.map(|id| {
            let seed = plan.seed + u64::from(id.repetition);
            let evaluations = 100 * u64::from(id.cell + 1) + seed;
            RunRow {
                id,
                seed,
                evaluations,
                discrepancy: 5.0,
                true_discrepancy: None,
                painted_percent: None,
                invalid: false,
                evaluations_per_goal: vec![evaluations],
                provenance: Tally { simulated: evaluations, ..Tally::default() },
                digest: "d".to_owned(),
            }
        });
        self.step(&claimed, made(Product::Rows(rows.collect()))).await;
        experiment
    }
}

/// A step that made one product.
fn made(product: Product) -> Advance {
    Advance { products: vec![product], ..Advance::default() }
}
