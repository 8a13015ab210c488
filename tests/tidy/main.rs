//! Architecture rules as tests: who may import whom, words forbidden per folder, length of files.
//!
//! Each rule lists every violation with file and line, so that one run shows everything to fix.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking, helpers included")]

mod circles;
mod source;

use source::{code_lines, is_test_file, references, root, sources, without_tests};
use std::collections::BTreeSet;

/// Maximum length of a file, lines.
const MAX_LINES: usize = 500;
/// Maximum median length of the Rust files in `src/`, lines.
const MAX_MEDIAN_LINES: usize = 150;

/// Folder or file under `src/` -> the modules of this crate it may name. What is not listed here may name everything.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("app/model", &["framework"]),
    ("reproduce", &["reproduce", "framework"]),
    ("app", &["app", "framework", "reproduce"]),
    ("store", &["store", "app", "framework"]),
    ("evaluate", &["evaluate", "app", "framework"]),
    ("jobs", &["jobs", "app", "framework", "reproduce"]),
    ("http", &["http", "app", "framework"]),
    ("grpc", &["grpc", "app", "framework"]),
    ("config", &["config", "app"]),
    ("telemetry", &["telemetry", "config"]),
    ("lifecycle", &["lifecycle", "app"]),
    // the inside of the core, from the bottom; its unit tests may name everything
    ("framework/cells", &[]),
    ("framework/distance", &[]),
    ("framework/feature", &[]),
    ("framework/text", &[]),
    ("framework/random", &[]),
    ("framework/range", &[]),
    ("framework/job", &[]),
    ("framework/tagged", &["tagged"]),
    (
        "framework/demonstration",
        &["demonstration", "Feature", "is_display_name", "is_hidden", "MAX_DISPLAY_NAME_CHARS"],
    ),
    ("framework/generalization", &["generalization", "demonstration", "range", "Feature"]),
    ("framework/recognition", &["recognition", "generalization", "demonstration", "distance", "Feature"]),
    ("framework/robot", &["robot", "range", "is_hidden"]),
    ("framework/trajectory", &["trajectory", "robot", "range"]),
    ("framework/world", &["world", "trajectory", "robot", "random", "range", "tagged", "CellSet", "Feature"]),
    (
        "framework/method",
        &[
            "method",
            "constraint",
            "world",
            "robot",
            "random",
            "range",
            "distance",
            "tagged",
            "CellSet",
            "infinite_as_null",
        ],
    ),
    ("framework/collision", &["collision", "world", "robot", "random", "range", "tagged"]),
    ("framework/constraint", &["constraint", "collision", "method", "world", "robot", "random", "range", "tagged"]),
    (
        "framework/execution",
        &[
            "execution",
            "constraint",
            "method",
            "world",
            "robot",
            "recognition",
            "generalization",
            "random",
            "range",
            "distance",
            "CellSet",
            "Feature",
        ],
    ),
    ("framework/preset", &["preset", "execution", "method", "world", "robot", "generalization"]),
    ("framework/experiment", &["experiment", "preset", "execution", "method", "generalization"]),
];

/// Folder under `src/` -> words forbidden in its code (comments are not code).
const FORBIDDEN: &[(&str, &[&str])] = &[
    (
        "framework",
        &[
            "async ",
            "tokio",
            "sqlx",
            "tonic",
            "axum",
            "std::fs",
            "std::env",
            "std::net",
            "std::io",
            "SystemTime",
            "Instant::now",
            "rand::rng",
            "println!",
            "eprintln!",
            "print!(",
            "tracing::",
            "HashMap",
            "HashSet",
        ],
    ),
    ("app", &["sqlx", "axum", "tonic", "std::fs", "SystemTime::now", "println!"]),
    ("http", &["sqlx", "tonic::", "println!", "SystemTime::now"]),
    ("grpc", &["sqlx", "axum::", "println!", "SystemTime::now"]),
    ("jobs", &["sqlx", "axum", "tonic", "println!", "SystemTime::now"]),
];

/// Words forbidden everywhere in `src/`.
const FORBIDDEN_EVERYWHERE: &[&str] =
    &["#[allow(", "#![allow(", "todo!(", "unimplemented!(", "dbg!(", "TODO", "FIXME", "XXX", "/work/"];

/// Allowed entries at the top of the repository.
const TOP_LEVEL: &[&str] = &[
    ".ci",
    ".dockerignore",
    ".github",
    ".gitignore",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "Dockerfile",
    "LICENSE",
    "Makefile",
    "README.md",
    "benches",
    "build.rs",
    "clients",
    "clippy.toml",
    "deny.toml",
    "deploy",
    "docs",
    "examples",
    "fuzz",
    "migrations",
    "proto",
    "rustfmt.toml",
    "src",
    "tests",
    "web",
];

fn in_place(file: &str, place: &str) -> bool {
    let rest = file.strip_prefix("src/").and_then(|rest| rest.strip_prefix(place));
    rest.is_some_and(|rest| rest.is_empty() || rest == ".rs" || rest.starts_with('/'))
}

fn report(rule: &str, violations: &[String]) {
    assert!(violations.is_empty(), "{rule}:\n  {}", violations.join("\n  "));
}

#[test]
fn folders_import_only_what_they_may() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src"], &["rs"]) {
        let Some((place, allowed)) = MAY_IMPORT.iter().find(|(place, _)| in_place(&file, place)) else { continue };
        let is_core = in_place(&file, "framework");
        if is_core && is_test_file(&file) {
            continue;
        }
        for reference in references(if is_core { without_tests(&text) } else { &text }) {
            let [root, name, ..] = reference.path.as_slice() else { continue };
            if root == "crate" && !allowed.contains(&name.as_str()) {
                violations.push(format!("{file}:{}: {place} may not import {name}", reference.line));
            }
        }
    }
    report("forbidden imports", &violations);
}

#[test]
fn forbidden_words_stay_out() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src"], &["rs"]) {
        let exempt = file.ends_with("/tests.rs") || file.contains("/examples/"); // these may read files and print
        let local =
            FORBIDDEN.iter().filter(|(place, _)| !exempt && in_place(&file, place)).flat_map(|(_, words)| *words);
        let words: Vec<_> = local.chain(FORBIDDEN_EVERYWHERE).collect();
        for (line, code) in code_lines(&text) {
            let hits = words.iter().filter(|word| code.contains(**word));
            violations.extend(hits.map(|word| format!("{file}:{line}: {word:?}")));
            if code.trim_start().starts_with("pub use ") && code.contains("::*") {
                violations.push(format!("{file}:{line}: glob re-export"));
            }
        }
    }
    report("forbidden words", &violations);
}

/// Words of one home: what each may be named in, besides test code.
const AT_HOME: &[(&str, &[&str])] = &[
    // Others ask `WorldSpec::properties`, which is right for the next kind too.
    ("WorldSpec::", &["framework/world", "grpc/convert/world"]),
];

#[test]
fn kinds_are_told_apart_at_home_only() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src"], &["rs"]).iter().filter(|(file, _)| !is_test_file(file)) {
        for (word, homes) in AT_HOME.iter().filter(|(_, homes)| !homes.iter().any(|home| in_place(file, home))) {
            let named = code_lines(without_tests(text)).filter(|(_, code)| {
                let is_word = |before: &str| !before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
                let own = |at: usize| is_word(&code[..at]) && !code[..at].ends_with("proto::");
                code.match_indices(word).any(|(at, _)| own(at))
            });
            violations.extend(named.map(|(line, _)| format!("{file}:{line}: {word:?} outside of {homes:?}")));
        }
    }
    report("kinds asked for by name", &violations);
}

#[test]
fn files_are_short() {
    let mut all = sources(&["src", "tests", "benches", "examples", "proto"], &["rs", "py", "sh", "proto"]);
    all.extend(sources(&["web/src", "web/e2e"], &["ts", "tsx", "css"]));
    let rust = all.iter().filter(|(file, _)| file.starts_with("src/"));
    let mut lengths: Vec<usize> = rust.map(|(_, text)| text.lines().count()).collect();
    lengths.sort_unstable();
    let median = lengths[lengths.len() / 2];
    println!("src/: {} files, median {median} lines, longest {:?}", lengths.len(), lengths.last());
    assert!(median <= MAX_MEDIAN_LINES, "median length in src/ is {median} lines: at most {MAX_MEDIAN_LINES}");
    let long = all.iter().filter(|(file, _)| !file.ends_with(".d.ts"));
    let long = long.map(|(file, text)| (file, text.lines().count())).filter(|(_, lines)| *lines > MAX_LINES);
    report(
        &format!("files over {MAX_LINES} lines: split them by idea"),
        &long.map(|(file, lines)| format!("{file}: {lines} lines")).collect::<Vec<_>>(),
    );
}

/// Whether code leaves fields out with `..`: in a pattern, or filled in from a default.
fn leaves_fields_out(code: &str) -> bool {
    code.contains(", ..") || code.contains("{ .. }") || code.trim_start().starts_with("..")
}

#[test]
fn grpc_conversions_name_every_field() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src/grpc/convert"], &["rs"]) {
        let converting = text.split("#[cfg(test)]").next().unwrap_or(&text);
        let hits = code_lines(converting).filter(|(_, code)| leaves_fields_out(code));
        violations.extend(hits.map(|(line, code)| format!("{file}:{line}: {}", code.trim())));
    }
    report("fields that a conversion leaves out, so that a new one would be forgotten", &violations);
    assert!(leaves_fields_out("let Trial { joints, .. } = trial;") && leaves_fields_out("    ..Trial::default()"));
    assert!(!leaves_fields_out("let Trial { joints, goal } = trial;"));
}

#[test]
fn every_module_says_what_it_is() {
    let without = sources(&["src", "tests", "benches"], &["rs"]).into_iter();
    let without = without.filter(|(_, text)| !text.starts_with("//!")).map(|(file, _)| file);
    report("files without a module header (`//!` on the first line)", &without.collect::<Vec<_>>());
}

#[test]
fn the_top_level_holds_nothing_else() {
    let tracked = std::process::Command::new("git").arg("ls-files").current_dir(root()).output();
    let Ok(listing) = tracked else { return println!("skipped: git is not on this machine") };
    if !listing.status.success() {
        return println!("skipped: not a git checkout");
    }
    let listing = String::from_utf8(listing.stdout).unwrap();
    let top: BTreeSet<_> = listing.lines().filter_map(|path| path.split('/').next()).collect();
    let strangers = top.into_iter().filter(|name| !TOP_LEVEL.contains(name)).map(str::to_owned);
    report("entries at the top level without a reason", &strangers.collect::<Vec<_>>());
}

#[test]
fn places_are_folders_and_files() {
    assert!(in_place("src/http/jobs.rs", "http") && !in_place("src/httpx.rs", "http"));
    assert!(in_place("src/lifecycle.rs", "lifecycle") && in_place("src/lifecycle/system.rs", "lifecycle"));
}
