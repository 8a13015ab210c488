//! Architecture rules as tests: who may import whom, words forbidden per folder, length of files.
//!
//! Each rule lists every violation with file and line, so that one run shows everything to fix.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking, helpers included")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Maximum length of a file, lines.
const MAX_LINES: usize = 500;

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
    ("config", &["config"]),
    ("telemetry.rs", &["telemetry", "config"]),
    ("lifecycle.rs", &["lifecycle"]),
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

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files_below(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            if !path.ends_with("node_modules") && !path.ends_with("dist") {
                files_below(&path, extensions, found);
            }
        } else if path.extension().is_some_and(|e| extensions.iter().any(|wanted| e == *wanted)) {
            found.push(path);
        }
    }
}

/// Files with one of the extensions below the folders, sorted, as (path from the root, text).
fn sources(folders: &[&str], extensions: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in folders {
        files_below(&root().join(folder), extensions, &mut found);
    }
    found.sort();
    let relative = |path: &Path| path.strip_prefix(root()).unwrap().display().to_string();
    found.iter().map(|path| (relative(path), fs::read_to_string(path).unwrap())).collect()
}

/// The lines of code with their numbers from 1: no comment lines, nothing after a trailing `//` comment.
fn code_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(index, line)| {
        let code = line.split(" // ").next().unwrap_or(line);
        (!line.trim_start().starts_with("//")).then_some((index + 1, code))
    })
}

fn in_place(file: &str, place: &str) -> bool {
    file.strip_prefix("src/").is_some_and(|rest| rest == place || rest.starts_with(&format!("{place}/")))
}

fn module_names_after(code: &str, prefix: &str) -> BTreeSet<String> {
    let first_word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut names = BTreeSet::new();
    for (at, _) in code.match_indices(prefix) {
        let preceded = code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':');
        let rest = &code[at + prefix.len()..];
        match rest.strip_prefix('{') {
            _ if preceded => {}
            Some(group) => names.extend(group.split(',').map(|s| first_word(s.trim()))),
            None => drop(names.insert(first_word(rest))),
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

fn report(rule: &str, violations: &[String]) {
    assert!(violations.is_empty(), "{rule}:\n  {}", violations.join("\n  "));
}

#[test]
fn folders_import_only_what_they_may() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src"], &["rs"]) {
        let Some((place, allowed)) = MAY_IMPORT.iter().find(|(place, _)| in_place(&file, place)) else { continue };
        for (line, code) in code_lines(&text) {
            let named = module_names_after(code, "crate::");
            let strangers = named.iter().filter(|name| !allowed.contains(&name.as_str()));
            violations.extend(strangers.map(|name| format!("{file}:{line}: {place} may not import {name}")));
        }
    }
    report("forbidden imports", &violations);
}

#[test]
fn forbidden_words_stay_out() {
    let mut violations = Vec::new();
    for (file, text) in sources(&["src"], &["rs"]) {
        let exempt = file.ends_with("/tests.rs"); // unit tests may read files
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

#[test]
fn files_are_short() {
    let mut all = sources(&["src", "tests", "benches", "examples", "proto"], &["rs", "py", "sh", "proto"]);
    all.extend(sources(&["web/src", "web/e2e"], &["ts", "tsx", "css"]));
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
fn the_checker_sees_what_it_should() {
    let seen = |code: &str| module_names_after(code, "crate::").into_iter().collect::<Vec<_>>();
    assert_eq!(seen("use crate::{app::App, store};"), ["app", "store"]);
    assert_eq!(seen("use crate::framework::Feature;"), ["framework"]);
    assert_eq!(seen("let a = othercrate::app::x();"), Vec::<String>::new());
    assert_eq!(code_lines("// sqlx\nlet a = 1; // tokio\n").collect::<Vec<_>>(), [(2, "let a = 1;")]);
    assert!(in_place("src/http/jobs.rs", "http") && !in_place("src/httpx.rs", "http"));
}
