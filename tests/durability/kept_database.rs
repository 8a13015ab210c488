//! A database that an earlier build wrote opens, migrates, reads back the same, and its unfinished jobs end with the
//! same bits. `tests/fixtures/databases/README.md` lists the content of each one; `keep_database.rs` makes the next.

use super::server::{Server, digests};
use flate2::read::GzDecoder;
use rstest::rstest;
use serde_json::{Value, json};
use std::fs::File;
use std::path::{Path, PathBuf};

/// Fields that an earlier build answered with and today's leaves out on purpose: (JSON pointer pattern, reason).
const DROPPED: &[(&str, &str)] = &[];

fn kept(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/databases").join(folder)
}

fn unpacked(path: &Path) -> GzDecoder<File> {
    GzDecoder::new(File::open(path).unwrap())
}

/// Places at which `now` lacks or changes a value of `then`, one line each. New fields are not differences.
fn differences(then: &Value, now: &Value, at: &str, found: &mut Vec<String>) {
    match (then, now) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in old {
                let place = format!("{at}/{key}");
                match new.get(key) {
                    Some(other) => differences(value, other, &place, found),
                    None if DROPPED.iter().any(|(pattern, _)| place.ends_with(pattern)) => {}
                    None => found.push(format!("{place}: {value} is gone")),
                }
            }
        }
        (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
            for (index, (value, other)) in old.iter().zip(new).enumerate() {
                differences(value, other, &format!("{at}/{index}"), found);
            }
        }
        _ if then == now => {}
        _ => found.push(format!("{at}: {then} became {now}")),
    }
}

/// Asserts that a trajectory of an earlier build is exported with its own points, and with the joints it holds.
async fn assert_exported(server: &Server, then: &Value) {
    let id = then["id"].as_str().unwrap();
    let csv = server.text(&format!("/api/v1/trajectories/{id}:export?format=csv")).await;
    let points = then["points"].as_array().unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), points.len() + 1, "{csv}");
    assert!(lines[0].contains(",wrist_yaw_position,"), "{}", lines[0]);
    for (line, point) in lines[1..].iter().zip(points) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |cell: &str| cell.parse::<f64>().unwrap();
        assert_eq!(Some(number(cells[0])), point["t_s"].as_f64());
        for (cell, position) in cells[1..].iter().zip(point["positions"].as_array().unwrap()) {
            assert_eq!(Some(number(cell)), position.as_f64());
        }
    }
    let goals = lines.iter().filter(|line| !line.ends_with(',')).count() - 1;
    assert_eq!(goals, then["goal_times_s"].as_array().unwrap().len());
}

/// Methods that choose other trials since: their jobs go on from the log and end.
const CHANGED: [&str; 2] = ["particle", "search"];

#[rstest]
#[case("schema-0003")]
#[case("schema-0004")]
#[tokio::test]
async fn a_kept_database_reads_back_the_same_and_its_jobs_end_with_the_same_bits(#[case] folder: &str) {
    let folder = kept(folder);
    let data = tempfile::tempdir().unwrap();
    let mut database = File::create(data.path().join("cgda.db")).unwrap();
    std::io::copy(&mut unpacked(&folder.join("cgda.db.gz")), &mut database).unwrap();
    let answers: Value = serde_json::from_reader(unpacked(&folder.join("answers.json.gz"))).unwrap();
    let server = Server::start(data.path());

    let paused = answers["paused"].as_str().unwrap();
    let mut found = Vec::new();
    for (path, then) in answers["answers"].as_object().unwrap() {
        // Lists also contain results of the resumed jobs.
        let is_list_that_grows = path.starts_with("/runs?");
        if is_list_that_grows {
            continue;
        }
        let text = server.text(&format!("/api/v1{path}")).await;
        let now = if then.is_string() { Value::String(text) } else { serde_json::from_str(&text).unwrap() };
        differences(then, &now, path, &mut found);
    }
    let trajectories = answers["answers"].as_object().unwrap().iter().filter(|(path, _)| path.ends_with("/trajectory"));
    for (_, then) in trajectories {
        assert_exported(&server, then).await;
    }
    assert!(found.is_empty(), "{} differences:\n{}", found.len(), found[..found.len().min(40)].join("\n"));

    server.post(&format!("/api/v1/jobs/{paused}:resume"), &json!({})).await;
    for (job, expected) in answers["resumed"].as_object().unwrap() {
        let ended = server.ended(job).await;
        assert_eq!(ended["state"], expected["state"], "{ended}");
        if CHANGED.iter().any(|method| expected["name"].as_str().unwrap().ends_with(method)) {
            continue;
        }
        assert_eq!(digests(&server, &ended).await, [expected["digest"].as_str().unwrap()], "{}", expected["name"]);
    }
}

#[test]
fn a_lost_or_changed_value_is_found() {
    let mut found = Vec::new();
    let then = json!({"a": 1, "b": [1.5, {"c": null}], "d": "x"});
    let now = json!({"a": 2, "b": [1.5, {"c": null, "e": 1}]});
    differences(&then, &now, "", &mut found);
    assert_eq!(found, ["/a: 1 became 2", "/d: \"x\" is gone"]);
}
