//! What every engine behind the Store port must do; each function is one promise, run on a fresh store.

use crate::app::model::{
    ActionId, CreateJob, DemonstrationId, DemonstrationReport, DemonstrationView, EventData, ExperimentId,
    ExperimentView, GeneralizationRequest, JobFilter, JobId, JobKind, JobProgress, JobResult, JobView, Keyset,
    PageQuery, PatchDemonstration, RobotId, RobotView, RowFilter, RunFilter, RunGoals, RunId, RunView, Timestamp, Work,
    WorldId,
};
use crate::app::ports::{
    Advance, Claimed, IdempotencyKey, KeptTrials, NewDemonstration, NewExperiment, NewJob, NewRobot, NewRun, Store,
    StoreError, Submitted, Transition, Usage,
};
use crate::framework::experiment::{Plan, RunId as Which, RunRow};
use crate::framework::generalization::Weighting;
use crate::framework::job::{Event, State};
use crate::framework::method::per_goal::Tally;
use crate::framework::method::whole_run::Trial;
use crate::framework::recognition::Metric;
use crate::framework::robot::{ChainSummary, RobotSpec, RobotSummary};
use std::time::Duration;
use uuid::Uuid;

const AT: Timestamp = Timestamp(1_700_000_000_000);
const LEASE: Duration = Duration::from_mins(1);

/// One test a promise; `$fresh` opens an empty store.
macro_rules! conformance {
    ($fresh:expr; $($promise:ident),* $(,)?) => {$(
        #[tokio::test]
        async fn $promise() {
            let (_keep, store) = $fresh.await;
            $crate::store::suite::$promise(&store).await;
        }
    )*};
}
pub(crate) use conformance;

fn uuid(number: u128) -> Uuid {
    Uuid::from_u128(number)
}

fn page(size: u32, token: &str) -> Keyset {
    Keyset::new(&PageQuery { page_size: Some(size), page_token: Some(token.to_owned()) }, "").unwrap()
}

fn demonstration(number: u128) -> NewDemonstration {
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

fn robot(number: u128) -> NewRobot {
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

fn job(number: u128) -> NewJob {
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

fn run(number: u128, job: &JobId, repetition: u32) -> NewRun {
    let id = RunId::from_uuid(uuid(number));
    let view = RunView {
        id: id.clone(),
        job: job.clone(),
        repetition,
        action: ActionId::from_uuid(uuid(1)),
        robot: RobotId::from_uuid(uuid(1)),
        world: WorldId::from_uuid(uuid(1)),
        method: "sst".to_owned(),
        metric: Metric::default(),
        seed: (1 << 53) - 1,
        evaluations: 7,
        discrepancy: 0.1 + 0.2,
        true_discrepancy: None,
        valid: true,
        provenance: Tally { simulated: 6, inherited: 2, ..Tally::default() },
        painted_percent: None,
        goals: 0,
        digest: format!("digest {number}"),
        trajectory: None,
        trajectory_problem: None,
        created_at: AT,
    };
    let goals = RunGoals { run: id, features: Vec::new(), joint_names: Vec::new(), goals: Vec::new() };
    NewRun { view, goals, convergence: Vec::new(), trajectory: None, trials: KeptTrials::default() }
}

async fn submitted(store: &dyn Store, number: u128) -> JobId {
    let new = job(number);
    let id = new.view.id.clone();
    assert!(matches!(store.submit(new, None).await.unwrap(), Submitted::Created(_)));
    id
}

async fn claimed(store: &dyn Store) -> Option<Claimed> {
    claimed_for(store, LEASE).await
}

async fn claimed_for(store: &dyn Store, lease: Duration) -> Option<Claimed> {
    store.claim(Uuid::new_v4().simple().to_string(), lease, 3, AT).await.unwrap()
}

fn transition(event: Event) -> Advance {
    Advance { transition: Some(Transition::plain(event)), ..Advance::default() }
}

fn checkpoint(bytes: &[u8]) -> Advance {
    Advance { checkpoint: Some(bytes.to_vec()), ..Advance::default() }
}

async fn states(store: &dyn Store, id: &JobId) -> Vec<State> {
    let events = store.events(id, 0, 1000).await.unwrap().events;
    assert!(events.iter().enumerate().all(|(index, event)| event.seq == index as u64 + 1), "{events:?}");
    let state = |data: &EventData| if let EventData::State { state, .. } = data { Some(*state) } else { None };
    events.iter().filter_map(|event| state(&event.data)).collect()
}

pub(crate) async fn keeps_demonstrations_until_deleted(store: &dyn Store) {
    let new = demonstration(1);
    let id = new.view.id.clone();
    store.insert_demonstration(new.clone()).await.unwrap();
    assert_eq!(store.demonstration(&id).await.unwrap(), new.view);
    assert_eq!(store.demonstration_report(&id).await.unwrap(), new.report);
    assert_eq!(store.demonstration_samples(&id).await.unwrap(), new.samples);
    assert_eq!(store.demonstrations_with_content("same").await.unwrap(), std::slice::from_ref(&id));
    store.delete_demonstration(&id, Some(1)).await.unwrap();
    assert!(matches!(store.demonstration_samples(&id).await, Err(StoreError::NotFound { .. })));
    assert!(matches!(store.delete_demonstration(&id, None).await, Err(StoreError::NotFound { .. })));
}

pub(crate) async fn changes_a_demonstration_only_at_the_revision_named(store: &dyn Store) {
    let new = demonstration(1);
    let id = new.view.id.clone();
    store.insert_demonstration(new).await.unwrap();
    let patch = |excluded: &str| PatchDemonstration { name: None, excluded: Some(excluded.to_owned()) };
    let view = store.patch_demonstration(&id, patch("noisy"), Some(1)).await.unwrap();
    assert_eq!((view.revision, view.excluded.as_deref()), (2, Some("noisy")));
    let stale = store.patch_demonstration(&id, patch("again"), Some(1)).await;
    assert!(matches!(stale, Err(StoreError::Revision { present: 2, expected: 1, .. })));
    assert_eq!(store.patch_demonstration(&id, patch(""), None).await.unwrap().excluded, None);
    assert!(matches!(store.delete_demonstration(&id, Some(1)).await, Err(StoreError::Revision { .. })));
}

pub(crate) async fn pages_lists_newest_first_without_gap_or_repeat(store: &dyn Store) {
    for number in 1..=5 {
        store.insert_demonstration(demonstration(number)).await.unwrap();
    }
    let mut names = Vec::new();
    let mut token = String::new();
    loop {
        let keyset = page(2, &token);
        let found = keyset.page(store.demonstrations(&keyset).await.unwrap(), |view| view.id.to_string());
        assert!(found.items.len() <= 2);
        names.extend(found.items.into_iter().map(|view| view.name));
        token = found.next_page_token;
        if token.is_empty() {
            break;
        }
    }
    assert_eq!(names, ["d5", "d4", "d3", "d2", "d1"]);
}

pub(crate) async fn counts_versions_and_keeps_what_jobs_name(store: &dyn Store) {
    let first = store.insert_robot(robot(1)).await.unwrap();
    let second = store.insert_robot(robot(2)).await.unwrap();
    assert_eq!((first.version, second.version), (1, 2));
    assert_eq!(store.robot(&second.id).await.unwrap(), second);
    assert_eq!(store.robot_urdf(&first.id).await.unwrap(), "<robot name='1'/>");
    let mut new = job(1);
    new.uses.robot = Some(first.id.clone());
    store.submit(new, None).await.unwrap();
    assert!(matches!(store.delete_robot(&first.id).await, Err(StoreError::InUse { count: 1, .. })));
    store.delete_robot(&second.id).await.unwrap();
    assert!(matches!(store.delete_robot(&second.id).await, Err(StoreError::NotFound { .. })));
}

pub(crate) async fn submits_once_a_key(store: &dyn Store) {
    let key = |body: &str| Some(IdempotencyKey { key: "k".to_owned(), body_sha256: body.to_owned() });
    let all = (1..=50).map(|number| store.submit(job(number), key("same")));
    let answers = futures_util::future::join_all(all).await;
    let created = answers.iter().filter(|answer| matches!(answer, Ok(Submitted::Created(_)))).count();
    let ids: std::collections::BTreeSet<_> = answers
        .into_iter()
        .map(|answer| match answer.unwrap() {
            Submitted::Created(job) | Submitted::Existing(job) => job.id,
        })
        .collect();
    assert_eq!((created, ids.len()), (1, 1));
    assert_eq!(store.jobs(&JobFilter::default(), &page(200, "")).await.unwrap().len(), 1);
    assert!(matches!(store.submit(job(99), key("other")).await, Err(StoreError::KeyReused { .. })));
    let again = IdempotencyKey { key: "k".to_owned(), body_sha256: "same".to_owned() };
    assert_eq!(store.submitted(&again).await.unwrap().map(|job| job.id), ids.first().cloned());
}

pub(crate) async fn gives_the_oldest_job_to_one_worker(store: &dyn Store) {
    let (first, second) = (submitted(store, 1).await, submitted(store, 2).await);
    let given = claimed(store).await.unwrap();
    assert_eq!((given.job.id.clone(), given.job.state, given.job.attempt), (first.clone(), State::Preparing, 1));
    assert_eq!(given.work, job(1).work);
    assert_eq!(claimed(store).await.unwrap().job.id, second);
    assert!(claimed(store).await.is_none());
    assert_eq!(states(store, &first).await, [State::Queued, State::Preparing]);
}

pub(crate) async fn lists_jobs_by_state_and_kind(store: &dyn Store) {
    submitted(store, 1).await;
    submitted(store, 2).await;
    claimed(store).await.unwrap();
    let count = async |states: &[State], kind| {
        let filter = JobFilter { states: states.to_vec(), kind };
        store.jobs(&filter, &page(200, "")).await.unwrap().len()
    };
    assert_eq!(count(&[], None).await, 2);
    assert_eq!(count(&[State::Queued], None).await, 1);
    assert_eq!(count(&[State::Queued, State::Preparing], Some(JobKind::Generalization)).await, 2);
    assert_eq!(count(&[], Some(JobKind::Execution)).await, 0);
}

pub(crate) async fn writes_nothing_for_a_lost_claim(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let id = submitted(store, 1).await;
    let stale = claimed(store).await.unwrap().claim;
    store.advance(&stale, transition(Event::Start), AT).await.unwrap();
    assert_eq!(store.begin_epoch(AT).await.unwrap(), std::slice::from_ref(&id));
    let before = store.job(&id).await.unwrap();
    assert_eq!(before.state, State::Queued);
    let step = Advance { runs: vec![run(1, &id, 0)], checkpoint: Some(vec![9]), ..transition(Event::Succeed) };
    assert!(matches!(store.advance(&stale, step.clone(), AT).await, Err(StoreError::LeaseLost { .. })));
    assert!(matches!(store.heartbeat(&stale, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert_eq!(store.job(&id).await.unwrap(), before);
    let fresh = claimed(store).await.unwrap();
    assert_eq!((fresh.job.attempt, fresh.checkpoint), (2, None));
    assert!(matches!(store.advance(&stale, step, AT).await, Err(StoreError::LeaseLost { .. })));
    let expected =
        [State::Queued, State::Preparing, State::Running, State::Interrupted, State::Queued, State::Preparing];
    assert_eq!(states(store, &id).await, expected);
}

pub(crate) async fn writes_a_step_whole_or_not_at_all(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let before = store.job(&id).await.unwrap();
    // A running job cannot rest without having been asked to.
    let step = Advance { runs: vec![run(1, &id, 0)], checkpoint: Some(vec![9]), ..transition(Event::Rest) };
    assert!(matches!(store.advance(&claim, step, AT).await, Err(StoreError::Transition(_))));
    assert_eq!(store.job(&id).await.unwrap(), before);
    assert!(store.runs(&RunFilter::default(), &page(9, "")).await.unwrap().is_empty());
    // A repetition that is there already takes the whole step back.
    let step = || Advance { runs: vec![run(1, &id, 0)], ..Advance::default() };
    store.advance(&claim, step(), AT).await.unwrap();
    let twice = Advance { runs: vec![run(2, &id, 0)], events: vec![EventData::Resync], ..Advance::default() };
    assert!(store.advance(&claim, twice, AT).await.is_err());
    assert_eq!(store.job(&id).await.unwrap().last_seq, before.last_seq);
}

pub(crate) async fn ends_a_job_once_with_its_results(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let mut runs = vec![run(5, &id, 0), run(4, &id, 1)];
    let trial = Trial { joints: vec![0.1 + 0.2], observation: None, cells: None, goal: 2 };
    runs[0].trials = KeptTrials { setting: Some("arm".to_owned()), trials: vec![trial] };
    let step = Advance { runs: runs.clone(), ..transition(Event::Succeed) };
    assert_eq!(store.advance(&claim, step.clone(), AT).await.unwrap(), State::Succeeded);
    assert!(matches!(store.advance(&claim, step, AT).await, Err(StoreError::LeaseLost { .. })));
    let asked = store.apply_event(&id, Transition::plain(Event::Cancel), AT).await;
    assert!(matches!(asked, Err(StoreError::Transition(_))));
    let ended = store.job(&id).await.unwrap();
    assert_eq!(ended.result.runs, [runs[0].view.id.clone(), runs[1].view.id.clone()]);
    assert_eq!((ended.state, ended.finished_at), (State::Succeeded, Some(AT)));
    assert_eq!(store.run(&runs[0].view.id).await.unwrap(), runs[0].view);
    let of_job = RunFilter { job: Some(id.clone()) };
    assert_eq!(store.runs(&of_job, &page(9, "")).await.unwrap().len(), 2);
    assert_eq!(store.run_trials(&runs[0].view.id).await.unwrap(), runs[0].trials);
    assert_eq!(store.run_trials(&runs[1].view.id).await.unwrap(), KeptTrials::default());
    let kept = (runs[0].view.clone(), runs[0].trials.trials.clone());
    assert_eq!(store.runs_on("arm", 9).await.unwrap(), [kept]);
    assert!(store.runs_on("leg", 9).await.unwrap().is_empty());
    assert!(claimed(store).await.is_none());
    assert_eq!(states(store, &id).await.iter().filter(|state| state.is_final()).count(), 1);
}

pub(crate) async fn numbers_events_and_tells_unknown_positions(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    let events = vec![EventData::Progress { progress: JobProgress::default() }; 3];
    store.advance(&claim, Advance { events, ..transition(Event::Start) }, AT).await.unwrap();
    let page = store.events(&id, 2, 2).await.unwrap();
    assert_eq!(page.events.iter().map(|event| event.seq).collect::<Vec<_>>(), [3, 4]);
    assert_eq!((page.last_seq, page.resync, page.end), (6, false, false));
    assert!(store.events(&id, 7, 2).await.unwrap().resync);
    store.advance(&claim, transition(Event::Fail), AT).await.unwrap();
    assert!(!store.events(&id, 0, 6).await.unwrap().end);
    assert!(store.events(&id, 6, 6).await.unwrap().end && store.events(&id, 7, 6).await.unwrap().end);
}

pub(crate) async fn gives_back_the_last_checkpoint(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    submitted(store, 1).await;
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    store.advance(&claim, checkpoint(b"one"), AT).await.unwrap();
    store.advance(&claim, checkpoint(b"two"), AT).await.unwrap();
    store.begin_epoch(AT).await.unwrap();
    assert_eq!(claimed(store).await.unwrap().checkpoint.as_deref(), Some(&b"two"[..]));
}

pub(crate) async fn quarantines_only_jobs_that_crash_without_progress(store: &dyn Store) {
    let id = submitted(store, 1).await;
    for attempt in 1..=10 {
        let given = claimed(store).await.unwrap();
        assert_eq!(given.job.attempt, attempt);
        store.advance(&given.claim, transition(Event::Start), AT).await.unwrap();
        store.advance(&given.claim, checkpoint(b"on"), AT).await.unwrap();
        store.begin_epoch(AT).await.unwrap();
    }
    for _ in 0..3 {
        claimed(store).await.unwrap();
        store.begin_epoch(AT).await.unwrap();
    }
    assert!(claimed(store).await.is_none());
    let failed = store.job(&id).await.unwrap();
    assert_eq!((failed.state, failed.failure.unwrap().code.as_str()), (State::Failed, "quarantined"));
}

pub(crate) async fn takes_back_jobs_whose_lease_ran_out(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let (slow, dead) = (submitted(store, 1).await, submitted(store, 2).await);
    let alive = claimed_for(store, Duration::from_millis(1)).await.unwrap();
    let gone = claimed_for(store, Duration::from_millis(1)).await.unwrap();
    assert_eq!((&alive.job.id, &gone.job.id), (&slow, &dead));
    store.heartbeat(&alive.claim, LEASE).await.unwrap();
    tokio::time::sleep(Duration::from_millis(30)).await;
    assert_eq!(store.reap(AT).await.unwrap(), [dead]);
    assert!(matches!(store.heartbeat(&gone.claim, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert!(store.reap(AT).await.unwrap().is_empty());
}

pub(crate) async fn steers_jobs_as_the_machine_allows(store: &dyn Store) {
    let id = submitted(store, 1).await;
    let ask = async |event| store.apply_event(&id, Transition::plain(event), AT).await.map(|job| job.state);
    assert_eq!(ask(Event::Pause).await.unwrap(), State::Paused);
    assert!(claimed(store).await.is_none());
    assert_eq!(ask(Event::Resume).await.unwrap(), State::Queued);
    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    assert_eq!(ask(Event::Pause).await.unwrap(), State::Pausing);
    assert_eq!(store.advance(&claim, checkpoint(b"x"), AT).await.unwrap(), State::Pausing);
    assert_eq!(store.advance(&claim, transition(Event::Rest), AT).await.unwrap(), State::Paused);
    assert!(matches!(store.heartbeat(&claim, LEASE).await, Err(StoreError::LeaseLost { .. })));
    assert_eq!(ask(Event::Cancel).await.unwrap(), State::Cancelled);
    let missing = JobId::from_uuid(uuid(77));
    let asked = store.apply_event(&missing, Transition::plain(Event::Cancel), AT).await;
    assert!(matches!(asked, Err(StoreError::NotFound { .. })));
}

fn experiment(number: u128) -> NewJob {
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

fn row(cell: u32, repetition: u32) -> RunRow {
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

pub(crate) async fn keeps_an_experiment_with_its_job_and_its_rows_with_the_claim(store: &dyn Store) {
    store.begin_epoch(AT).await.unwrap();
    let new = experiment(1);
    let kept = new.experiment.clone().unwrap();
    let id = kept.view.id.clone();
    store.submit(new.clone(), None).await.unwrap();
    assert_eq!(store.experiment(&id).await.unwrap(), kept.view);
    assert_eq!(store.experiment_plan(&id).await.unwrap(), kept.plan);
    assert_eq!(store.job(&new.view.id).await.unwrap().result.experiment.as_ref(), Some(&id));

    let claim = claimed(store).await.unwrap().claim;
    store.advance(&claim, transition(Event::Start), AT).await.unwrap();
    let rows = |rows: &[RunRow]| Advance { rows: rows.to_vec(), ..Advance::default() };
    store.advance(&claim, rows(&[row(1, 0), row(0, 1)]), AT).await.unwrap();
    store.advance(&claim, rows(&[row(0, 0)]), AT).await.unwrap();
    // A run that is there already takes the whole step back, its new rows and its count.
    assert!(store.advance(&claim, rows(&[row(1, 1), row(0, 0)]), AT).await.is_err());
    let found = store.experiment(&id).await.unwrap();
    assert_eq!((found.state, found.finished_runs), (State::Running, 3));
    let all = store.experiment_rows(&id, &RowFilter::default()).await.unwrap();
    assert_eq!(all, [row(0, 0), row(0, 1), row(1, 0)]);
    let second = RowFilter { cell: None, after: Some(Which { cell: 0, repetition: 0 }), limit: Some(1) };
    assert_eq!(store.experiment_rows(&id, &second).await.unwrap(), [row(0, 1)]);
    let of_cell = RowFilter { cell: Some(1), ..RowFilter::default() };
    assert_eq!(store.experiment_rows(&id, &of_cell).await.unwrap(), [row(1, 0)]);

    // A lost claim writes no row; a job without an experiment has no place for one.
    store.begin_epoch(AT).await.unwrap();
    let late = store.advance(&claim, rows(&[row(1, 1)]), AT).await;
    assert!(matches!(late, Err(StoreError::LeaseLost { .. })));
    submitted(store, 2).await;
    claimed(store).await.unwrap();
    let plain = claimed(store).await.unwrap().claim;
    assert!(matches!(store.advance(&plain, rows(&[row(0, 0)]), AT).await, Err(StoreError::NotFound { .. })));
    store.submit(experiment(3), None).await.unwrap();
    let names: Vec<_> = store.experiments(&page(9, "")).await.unwrap().into_iter().map(|view| view.name).collect();
    assert_eq!(names, ["experiment 3", "experiment 1"]);
    let missing = ExperimentId::from_uuid(uuid(9));
    assert!(matches!(store.experiment_plan(&missing).await, Err(StoreError::NotFound { .. })));
}
