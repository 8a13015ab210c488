//! Every document of an old version in `tests/fixtures/documents/` (`NAME-VERSION.json`) is read, written in the present
//! version and read back the same.

use super::*;
use crate::framework::method::per_goal::{Provenance, Tally};
use std::fmt::Debug;

fn saved(name: &str) -> String {
    let file = format!("{}/tests/fixtures/documents/{name}.json", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// The content of a saved document, which is the same after it was written and read again.
fn upgraded<D>(name: &str) -> D::Content
where
    D: Document + TryFrom<D::Content, Error: Debug>,
    D::Content: Debug,
{
    let content = read::<D>("a test", &saved(name)).unwrap();
    let document = D::try_from(content).unwrap();
    let text = write::<D>(document).unwrap();
    assert!(text.starts_with(&format!("{{\"v\":{},", D::UPGRADES.len())), "{text}");
    let again = read::<D>("a test", &text).unwrap();
    assert_eq!(format!("{again:?}"), format!("{:?}", read::<D>("a test", &saved(name)).unwrap()));
    again
}

#[test]
fn documents_of_version_0_are_upgraded_and_kept() {
    upgraded::<Demonstration>("demonstration-0");
    upgraded::<Report>("report-0");
    upgraded::<Robot>("robot-0");
    upgraded::<World>("world-0");
    upgraded::<Action>("action-0");
    upgraded::<GoalMatrix>("action_goals-0");
    upgraded::<Request>("request-0");
    upgraded::<Work>("work-0");
    upgraded::<Failure>("failure-0");
    upgraded::<Trajectory>("trajectory-0");
    upgraded::<Plan>("plan-0");
    upgraded::<Experiment>("experiment-0");
    for event in ["event_state-0", "event_progress-0", "event_goal-0", "event_trial-0", "event_run-0"] {
        upgraded::<Event>(event);
    }
    assert!(upgraded::<Progress>("progress-0").trials.is_empty());
    assert_eq!(upgraded::<Trials>("trials-0").len(), 2);
}

#[test]
fn runs_of_builds_without_constraints_are_valid_and_their_nulls_infinite() {
    let run = upgraded::<Run>("run-0");
    assert_eq!((run.valid, run.discrepancy, run.provenance), (true, f64::INFINITY, Tally::default()));
    let goals = upgraded::<RunGoals>("run_goals-0");
    let goal = &goals.goals[0];
    assert_eq!((goal.winner, goal.feasible, goal.residual), (Provenance::Simulated, true, None));
    assert_eq!(goal.observation, [f64::INFINITY]);
    assert_eq!(upgraded::<Convergence>("convergence-0")[0].discrepancy, f64::INFINITY);
    let row = upgraded::<Row>("row-0");
    assert_eq!(row.provenance, Tally { simulated: row.evaluations, ..Tally::default() });
}

#[test]
fn a_later_version_and_a_missing_number_are_refused() {
    let later = read::<World>("wld_1", r#"{"v": 2, "id": "wld_1"}"#).unwrap_err().to_string();
    assert!(later.contains("version 2, this program knows 1"), "{later}");
    assert!(read::<Convergence>("a test", r#"[{"goal_index": 0, "evaluations": 1}]"#).is_err());
    assert!(read::<World>("a test", r#"{"v": "x"}"#).is_err());
}
