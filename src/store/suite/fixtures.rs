//! Resources to try the promises on.

use crate::app::model::{
    CreateJob, DemonstrationId, DemonstrationReport, DemonstrationView, EventData, ExperimentId, ExperimentView,
    GeneralizationRequest, JobId, JobKind, JobProgress, JobResult, JobView, Keyset, PageQuery, RobotId, RobotView,
    RunGoals, RunId, RunView, Timestamp, Work,
};
use crate::app::ports::{
    Advance, Claimed, KeptTrials, NewDemonstration, NewExperiment, NewJob, NewRobot, NewRun, Product, Store, Submitted,
    Transition, Usage,
};
use crate::framework::experiment::Plan;
use crate::framework::experiment::RunId as Which;
use crate::framework::experiment::RunRow;
use crate::framework::generalization::Weighting;
use crate::framework::job::Event;
use crate::framework::job::State;
use crate::framework::method::per_goal::Tally;
use crate::framework::recognition::Metric;
use crate::framework::robot::ChainSummary;
use crate::framework::robot::RobotSpec;
use crate::framework::robot::RobotSummary;
use std::time::Duration;
use uuid::Uuid;

pub(super) const AT: Timestamp = Timestamp(1_700_000_000_000);
pub(super) const LEASE: Duration = Duration::from_mins(1);

pub(super) fn uuid(number: u128) -> Uuid {
    Uuid::from_u128(number)
}

pub(super) fn page(size: u32, token: &str) -> Keyset {
    Keyset::new(&PageQuery { page_size: Some(size), page_token: Some(token.to_owned()) }, "").unwrap()
}

pub(super) fn demonstration(number: u128) -> NewDemonstration {
    let id = DemonstrationId::from_uuid(uuid(number));
    let view = DemonstrationView {
        id: id.clone(),
        name: format!("d{number}"),
        revision: 1,
        excluded: None,
        streams: Vec::new(),
        duration_s: 1.5,
        sha256: "same".to_owned(),
        findings: 0,
        created_at: AT,
    };
    let report = DemonstrationReport { demonstration: id, findings: Vec::new() };
    NewDemonstration { view, report, samples: vec![1, 2, 3] }
}

pub(super) fn robot(number: u128) -> NewRobot {
    let summary = RobotSummary {
        name: "r".to_owned(),
        root_link: "base".to_owned(),
        links: Vec::new(),
        leaf_links: Vec::new(),
        joints: Vec::new(),
        notes: Vec::new(),
    };
    let chain = ChainSummary {
        base_link: "base".to_owned(),
        tip_link: "tip".to_owned(),
        free_joints: Vec::new(),
        fixed_joints: std::collections::BTreeMap::default(),
    };
    let view = RobotView {
        id: RobotId::from_uuid(uuid(number)),
        name: "arm".to_owned(),
        version: 0,
        spec: RobotSpec::default(),
        chain,
        summary,
        urdf_sha256: String::new(),
        created_at: AT,
    };
    NewRobot { view, urdf: format!("<robot name='{number}'/>") }
}

pub(super) fn job(number: u128) -> NewJob {
    let request = GeneralizationRequest {
        name: "wax".to_owned(),
        demonstrations: vec![DemonstrationId::from_uuid(uuid(1))],
        t_min_s: 0.1 + 0.2,
        weighting: Weighting::default(),
        features: None,
        metric: Metric::default(),
    };
    let view = JobView {
        id: JobId::from_uuid(uuid(number)),
        kind: JobKind::Generalization,
        name: format!("job {number}"),
        state: State::Queued,
        state_reason: None,
        state_since: AT,
        attempt: 0,
        progress: JobProgress::default(),
        request: CreateJob::Generalization(request.clone()),
        result: JobResult::default(),
        failure: None,
        last_seq: 0,
        created_at: AT,
        started_at: None,
        finished_at: None,
    };
    NewJob { view, work: Work::Generalization(request), uses: Usage::default(), experiment: None }
}

pub(super) fn run(number: u128, job: &JobId, repetition: u32) -> NewRun {
    let id = RunId::from_uuid(uuid(number));
    let view = RunView {
        id: id.clone(),
        job: job.clone(),
        repetition,
        seed: (1 << 53) - 1,
        digest: format!("digest {number}"),
        created_at: AT,
        ..RunView::sample()
    };
    let goals = RunGoals {
        run: id,
        features: Vec::new(),
        joint_names: Vec::new(),
        goals: Vec::new(),
        path: Vec::new(),
        painted_cells: None,
    };
    NewRun { view, goals, convergence: Vec::new(), trajectory: None, trials: KeptTrials::default() }
}

pub(super) async fn submitted(store: &dyn Store, number: u128) -> JobId {
    let new = job(number);
    let id = new.view.id.clone();
    assert!(matches!(store.submit(new, None).await.unwrap(), Submitted::Created(_)));
    id
}

pub(super) async fn claimed(store: &dyn Store) -> Option<Claimed> {
    claimed_for(store, LEASE).await
}

pub(super) async fn claimed_for(store: &dyn Store, lease: Duration) -> Option<Claimed> {
    store.claim(Uuid::new_v4().simple().to_string(), lease, 3, AT).await.unwrap()
}

pub(super) fn made(run: NewRun) -> Product {
    Product::Run(Box::new(run))
}

pub(super) fn transition(event: Event) -> Advance {
    Advance { transition: Some(Transition::plain(event)), ..Advance::default() }
}

pub(super) fn checkpoint(bytes: &[u8]) -> Advance {
    Advance { checkpoint: Some(bytes.to_vec()), ..Advance::default() }
}

pub(super) async fn states(store: &dyn Store, id: &JobId) -> Vec<State> {
    let events = store.events(id, 0, 1000).await.unwrap().events;
    assert!(events.iter().enumerate().all(|(index, event)| event.seq == index as u64 + 1), "{events:?}");
    let state = |data: &EventData| if let EventData::State { state, .. } = data { Some(*state) } else { None };
    events.iter().filter_map(|event| state(&event.data)).collect()
}

pub(super) fn experiment(number: u128) -> NewJob {
    let mut new = job(number);
    let id = ExperimentId::from_uuid(uuid(number));
    new.view.kind = JobKind::Experiment;
    new.work = Work::Experiment { experiment: id.clone() };
    let view = ExperimentView {
        id,
        name: format!("experiment {number}"),
        job: new.view.id.clone(),
        state: State::Queued,
        seed: 7,
        repetitions: 2,
        cells: 2,
        runs: 4,
        finished_runs: 0,
        created_at: AT,
    };
    let plan = Plan { name: view.name.clone(), seed: 7, repetitions: 2, cells: Vec::new() };
    new.experiment = Some(NewExperiment { view, plan });
    new
}

pub(super) fn row(cell: u32, repetition: u32) -> RunRow {
    RunRow {
        id: Which { cell, repetition },
        seed: 7 + u64::from(repetition),
        evaluations: 5,
        discrepancy: 0.1 + 0.2,
        true_discrepancy: None,
        painted_percent: None,
        invalid: false,
        evaluations_per_goal: vec![2, 3],
        provenance: Tally { simulated: 5, ..Tally::default() },
        digest: "d".to_owned(),
    }
}
