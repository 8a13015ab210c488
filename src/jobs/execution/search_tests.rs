//! The search loop with evaluators that answer, take long, lose outcomes and fail.

use super::search::{Search, SliceEnd, SliceError};
use crate::app::ports::{Evaluator, EvaluatorError, TrialId, Trials};
use crate::framework::execution::{Iet, Observations, Problem, run, simulated_world};
use crate::framework::method::per_goal::Provenance;
use crate::framework::world::World;
use crate::reproduce::shipped;
use async_trait::async_trait;
use std::collections::{BTreeMap, BTreeSet};
use std::future::{pending, ready};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::time::Instant;

const SEED: u64 = 3;

/// State that survives the process: trials started, how often each was executed, and the observations.
#[derive(Default)]
struct Journal {
    begun: BTreeSet<TrialId>,
    executed: BTreeMap<TrialId, u32>,
    seen: BTreeMap<TrialId, Vec<f64>>,
    outside_limits: u32,
    calls: u64,
}

impl Journal {
    /// Whether a trial was started whose outcome was never stored.
    fn is_hanging(&self) -> bool {
        self.seen.len() < self.begun.len()
    }
}

/// A simulated robot that keeps a journal. It hangs in the middle of every `dies_every`th call.
struct Robot {
    world: Box<dyn World>,
    limits: Vec<(f64, f64)>,
    journal: Arc<Mutex<Journal>>,
    dies_every: u64,
}

impl Robot {
    fn open(iet: &Iet, problem: &Problem, journal: &Arc<Mutex<Journal>>, dies_every: u64) -> Box<dyn Evaluator> {
        let world = simulated_world(problem, iet.chain(), SEED).unwrap();
        let limits = iet.chain().genes().iter().map(|gene| (gene.lower, gene.upper)).collect();
        Box::new(Self { world, limits, journal: Arc::clone(journal), dies_every })
    }

    /// Brings the world to the prefix and executes.
    fn act(&mut self, trials: Trials<'_>, joints: &[f64]) -> Vec<f64> {
        let mut seen = vec![0.0; self.world.features().len()];
        self.world.reset();
        for pose in trials.prefix {
            self.world.commit(pose, &mut seen);
        }
        self.world.observe(joints, &mut seen);
        seen
    }
}

#[async_trait]
impl Evaluator for Robot {
    fn provenance(&self) -> Provenance {
        Provenance::Real
    }

    fn most_at_once(&self) -> usize {
        1
    }

    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
        for (candidate, joints) in trials.batch.iter() {
            let id = trials.id(candidate);
            let (is_begun, known) = {
                let mut journal = self.journal.lock().unwrap();
                journal.calls += 1;
                (!journal.begun.insert(id), journal.seen.get(&id).cloned())
            };
            if let Some(known) = known {
                seen.observed(candidate, joints).copy_from_slice(&known);
                continue;
            }
            if is_begun {
                seen.unknown(candidate, joints);
                continue;
            }
            let observation = self.act(trials, joints);
            let dies = {
                let mut journal = self.journal.lock().unwrap();
                *journal.executed.entry(id).or_default() += 1;
                let is_outside = joints.iter().zip(&self.limits).any(|(j, (low, high))| j < low || j > high);
                journal.outside_limits += u32::from(is_outside);
                journal.calls.is_multiple_of(self.dies_every)
            };
            if dies {
                pending::<()>().await;
            }
            self.journal.lock().unwrap().seen.insert(id, observation.clone());
            seen.observed(candidate, joints).copy_from_slice(&observation);
        }
        Ok(())
    }
}

fn problem(method: &str) -> Problem {
    let mut preset = shipped::preset("wax").unwrap();
    assert!(preset.select_method(method));
    preset.problem
}

/// Executes `problem` as a job does. A hanging process is killed after a moment and resumed from the last checkpoint; if
/// an outcome is unknown, a person looks and lets the trial be repeated. Returns the digest and how often a person had to
/// look.
async fn driven(problem: &Problem, journal: &Arc<Mutex<Journal>>, dies_every: u64) -> (String, u32) {
    let mut iet = Iet::new(problem, SEED).unwrap();
    let mut looked = 0;
    loop {
        let saved = iet.state();
        let evaluator = Robot::open(&iet, problem, journal, dies_every);
        let mut search = Search::new(iet, evaluator, 0);
        let patience = tokio::time::sleep(Duration::from_millis(200));
        match search.slice(Instant::now() + Duration::from_millis(100), patience).await.unwrap() {
            SliceEnd::Finished => return (search.iet.finish().unwrap().digest, looked),
            SliceEnd::Unknown(trial) => {
                looked += 1;
                journal.lock().unwrap().begun.remove(&trial);
                iet = Iet::resume(problem, search.iet.state()).unwrap();
            }
            SliceEnd::Due => {
                // Killed: memory is lost, and everything told since the checkpoint is asked for again.
                let is_hanging = journal.lock().unwrap().is_hanging();
                let state = if is_hanging { saved } else { search.iet.state() };
                iet = Iet::resume(problem, state).unwrap();
            }
        }
    }
}

#[tokio::test]
async fn a_robot_that_dies_in_the_middle_of_trials_repeats_none_by_itself_and_ends_with_the_same_bits() {
    let problem = problem("broyden");
    let journal = Arc::new(Mutex::new(Journal::default()));
    let (digest, looked) = driven(&problem, &journal, 4).await;
    assert_eq!(digest, run(&problem, SEED).unwrap().digest);
    assert!(looked > 0, "no trial was ever unknown: the test shows nothing");
    let journal = journal.lock().unwrap();
    let repeated: u32 = journal.executed.values().map(|times| times - 1).sum();
    assert_eq!(repeated, looked, "every repetition was a person's decision");
    assert_eq!(journal.outside_limits, 0);
}

/// An evaluator whose answers come from a function.
struct Scripted<F>(F, Provenance);

#[async_trait]
impl<F: FnMut(Trials<'_>, &mut Observations) -> Result<(), EvaluatorError> + Send> Evaluator for Scripted<F> {
    fn provenance(&self) -> Provenance {
        self.1
    }

    fn most_at_once(&self) -> usize {
        8
    }

    async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
        (self.0)(trials, seen)
    }
}

fn search(
    problem: &Problem,
    provenance: Provenance,
    script: impl FnMut(Trials<'_>, &mut Observations) -> Result<(), EvaluatorError> + Send + 'static,
) -> Search {
    Search::new(Iet::new(problem, SEED).unwrap(), Box::new(Scripted(script, provenance)), 2)
}

#[tokio::test]
async fn a_trial_that_is_left_out_is_unknown_and_the_others_are_told() {
    let mut search = search(&problem("sst"), Provenance::Real, |trials, seen| {
        for (id, joints) in trials.batch.iter().skip(1) {
            seen.observed(id, joints).fill(1.0);
        }
        Ok(())
    });
    let end = search.slice(Instant::now(), pending()).await.unwrap();
    assert_eq!(end, SliceEnd::Unknown(TrialId { repetition: 2, goal: 0, candidate: 0 }));
    assert_eq!(search.iet.evaluations(), 7);
}

#[tokio::test]
async fn a_lost_observation_costs_an_evaluation_and_a_refused_trial_none() {
    for (is_lost, evaluations) in [(true, 8), (false, 0)] {
        let mut search = search(&problem("sst"), Provenance::Real, move |trials, seen| {
            for (id, joints) in trials.batch.iter() {
                if is_lost { seen.lost(id, joints) } else { seen.failed(id, joints) }
            }
            Ok(())
        });
        assert_eq!(search.slice(Instant::now(), pending()).await.unwrap(), SliceEnd::Due);
        assert_eq!(search.iet.evaluations(), evaluations);
    }
}

#[tokio::test]
async fn only_real_trials_are_checked_against_the_joint_limits() {
    let open = |problem: &mut Problem| {
        use crate::framework::method::MethodSpec;
        use crate::framework::method::per_goal::BoundsRule;
        let MethodSpec::Sst(spec) = &mut problem.execution.method else { panic!("sst was chosen") };
        spec.bounds = BoundsRule::Open;
        spec.mutation_probability = 1.0;
    };
    let mut problem = problem("sst");
    open(&mut problem);
    let chain = Iet::new(&problem, SEED).unwrap().chain().clone();
    for (provenance, expects_some) in [(Provenance::Simulated, true), (Provenance::Real, false)] {
        let outside = Arc::new(Mutex::new(0));
        let (count, genes) = (Arc::clone(&outside), chain.genes().to_vec());
        let mut search = search(&problem, provenance, move |trials, seen| {
            for (id, joints) in trials.batch.iter() {
                let is_outside = joints.iter().zip(&genes).any(|(j, gene)| *j < gene.lower || *j > gene.upper);
                *count.lock().unwrap() += u32::from(is_outside);
                seen.observed(id, joints).fill(joints.iter().sum());
            }
            Ok(())
        });
        search.slice(Instant::now() + Duration::from_millis(50), pending()).await.unwrap();
        assert_eq!(*outside.lock().unwrap() > 0, expects_some, "{provenance:?}");
    }
}

#[tokio::test]
async fn an_interrupted_batch_is_evaluated_by_the_next_slice_and_an_absent_evaluator_is_told() {
    struct Slow(Arc<Mutex<Vec<Vec<u64>>>>);

    #[async_trait]
    impl Evaluator for Slow {
        fn provenance(&self) -> Provenance {
            Provenance::Real
        }

        fn most_at_once(&self) -> usize {
            8
        }

        async fn evaluate(&mut self, trials: Trials<'_>, seen: &mut Observations) -> Result<(), EvaluatorError> {
            let calls = {
                let mut calls = self.0.lock().unwrap();
                calls.push(trials.batch.iter().map(|(id, _)| id).collect());
                calls.len()
            };
            if calls == 1 {
                pending::<()>().await;
            }
            if calls > 2 {
                return Err(EvaluatorError::Unavailable { reason: "the cable is out".to_owned() });
            }
            for (id, joints) in trials.batch.iter() {
                seen.observed(id, joints).fill(1.0);
            }
            Ok(())
        }
    }

    let calls = Arc::new(Mutex::new(Vec::new()));
    let iet = Iet::new(&problem("sst"), SEED).unwrap();
    let mut search = Search::new(iet, Box::new(Slow(Arc::clone(&calls))), 0);
    assert_eq!(search.slice(Instant::now(), ready(())).await.unwrap(), SliceEnd::Due);
    assert_eq!(search.iet.evaluations(), 0);
    assert_eq!(search.slice(Instant::now(), pending()).await.unwrap(), SliceEnd::Due);
    assert_eq!(search.iet.evaluations(), 8);
    let error = search.slice(Instant::now(), pending()).await.unwrap_err();
    assert!(matches!(&error, SliceError::Evaluator(EvaluatorError::Unavailable { .. })), "{error}");
    let calls = calls.lock().unwrap();
    assert_eq!(calls[0], calls[1]);
    assert_ne!(calls[1], calls[2]);
}
