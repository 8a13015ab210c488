//! Saved documents in `tests/fixtures/documents/`, named `KIND-VERSION.json` or `KIND.EXAMPLE-VERSION.json`.
//!
//! One of an old version is upgraded, written in the present version and read back the same. One of the present version
//! is written exactly as it was saved, which pins the types of the core that it contains.

use super::*;
use crate::framework::method::per_goal::{Provenance, Tally};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::fs;
use std::path::PathBuf;

/// Reads a document of any version and writes it again; also returns its present version.
type Rewrite = fn(&str) -> (usize, Value);

/// Every document by the name of its files.
const DOCUMENTS: [(&str, Rewrite); 19] = [
    ("action", rewritten::<Action>),
    ("action_goals", rewritten::<GoalMatrix>),
    ("convergence", rewritten::<Convergence>),
    ("demonstration", rewritten::<Demonstration>),
    ("event", rewritten::<Event>),
    ("experiment", rewritten::<Experiment>),
    ("failure", rewritten::<Failure>),
    ("plan", rewritten::<Plan>),
    ("progress", rewritten::<Progress>),
    ("report", rewritten::<Report>),
    ("request", rewritten::<Request>),
    ("robot", rewritten::<Robot>),
    ("row", rewritten::<Row>),
    ("run", rewritten::<Run>),
    ("run_goals", rewritten::<RunGoals>),
    ("trajectory", rewritten::<Trajectory>),
    ("trials", rewritten::<Trials>),
    ("work", rewritten::<Work>),
    ("world", rewritten::<World>),
];

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/documents")
}

fn saved(name: &str) -> String {
    let file = folder().join(format!("{name}.json"));
    fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// Text of every saved document by its kind, its name and its version.
fn all_saved() -> BTreeMap<(String, String, usize), String> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let key = |file: PathBuf| {
        let name = file.file_stem().unwrap().to_str().unwrap().to_owned();
        let (example, version) = name.rsplit_once('-').unwrap();
        let kind = example.split('.').next().unwrap().to_owned();
        let version = version.parse().unwrap();
        ((kind, name, version), fs::read_to_string(file).unwrap())
    };
    files.map(key).collect()
}

fn rewritten<D>(text: &str) -> (usize, Value)
where
    D: Document + TryFrom<D::Content, Error: Debug>,
    D::Content: Debug,
{
    let content = read::<D>("a test", text).unwrap();
    let shown = format!("{content:?}");
    let written = write::<D>(D::try_from(content).unwrap()).unwrap();
    assert_eq!(format!("{:?}", read::<D>("a test", &written).unwrap()), shown);
    (D::UPGRADES.len(), serde_json::from_str(&written).unwrap())
}

#[test]
fn saved_documents_of_every_version_are_read_and_those_of_the_present_one_are_written_as_saved() {
    for ((kind, name, version), text) in all_saved() {
        let (_, rewrite) = DOCUMENTS.iter().find(|(known, _)| *known == kind).unwrap_or_else(|| panic!("{name}: kind"));
        let (present, written) = rewrite(&text);
        assert!(version <= present, "{name}: the present version is {present}");
        assert_eq!(written["v"], json!(present), "{name}");
        if version == present {
            let before: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(
                written,
                before,
                "the stored form of {name} changed: data of today's users would be read differently. Add an upgrade to \
                 the versions of its document in src/store/documents/, keep {name}.json as it is, and save the new form \
                 as version {}:\n{written:#}\n",
                present + 1
            );
        }
    }
}

#[test]
fn every_document_is_saved_in_its_present_version() {
    let saved = all_saved();
    for (kind, rewrite) in DOCUMENTS {
        let (_, text) = saved.iter().rfind(|((found, _, _), _)| found == kind).unwrap_or_else(|| panic!("{kind}"));
        let (present, written) = rewrite(text);
        let is_present = |(found, _, version): &(String, String, usize)| found == kind && *version == present;
        assert!(saved.keys().any(is_present), "save this as {kind}-{present}.json:\n{written:#}\n");
    }
}

#[test]
fn runs_of_builds_without_constraints_are_valid_and_their_nulls_infinite() {
    let run = read::<Run>("a test", &saved("run-0")).unwrap();
    assert_eq!((run.valid, run.discrepancy, run.provenance), (true, f64::INFINITY, Tally::default()));
    let goals = read::<RunGoals>("a test", &saved("run_goals-0")).unwrap();
    let goal = &goals.goals[0];
    assert_eq!((goal.winner, goal.feasible, goal.residual), (Provenance::Simulated, true, None));
    assert_eq!(goal.observation, [f64::INFINITY]);
    let convergence = read::<Convergence>("a test", &saved("convergence-0")).unwrap();
    assert_eq!(convergence[0].discrepancy, f64::INFINITY);
    let row = read::<Row>("a test", &saved("row-0")).unwrap();
    assert_eq!(row.provenance, Tally { simulated: row.evaluations, ..Tally::default() });
    assert!(read::<Progress>("a test", &saved("progress-0")).unwrap().trials.is_empty());
    assert_eq!(read::<Trials>("a test", &saved("trials-0")).unwrap().len(), 2);
}

#[test]
fn a_later_version_and_a_missing_number_are_refused() {
    let later = read::<World>("wld_1", r#"{"v": 2, "id": "wld_1"}"#).unwrap_err().to_string();
    assert!(later.contains("version 2, this program knows 1"), "{later}");
    assert!(read::<Convergence>("a test", r#"[{"goal_index": 0, "evaluations": 1}]"#).is_err());
    assert!(read::<World>("a test", r#"{"v": "x"}"#).is_err());
}
