//! Plain English, kept by tests: how comments begin, phrases that read as translated, comments that only repeat a name,
//! and paths named in the documents for newcomers.
//!
//! Each rule lists every violation with file and line. A rule is here only if it raises no false alarm.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking, helpers included")]

use std::fs;
use std::path::{Path, PathBuf};

/// Words with which no doc comment begins: it begins with a noun, a verb, or "Whether" for a flag.
const OPENINGS: [&str; 8] = ["What", "Which", "Who", "Whom", "Whose", "Where", "When", "Why"];

/// Phrases with a plainer form: "`None` if", "absent if", "per line".
const PHRASES: [&str; 9] = [
    "none where",
    "absent where",
    "where absent",
    "where none",
    "none when ",
    "one a line",
    "one a row",
    "one a goal",
    "one a core",
];

/// Words that may follow "is no".
const AFTER_IS_NO: [&str; 5] = ["longer", "more", "less", "better", "worse"];

/// Words that say nothing in a comment that repeats a name.
const FILLERS: [&str; 7] = ["the", "a", "an", "its", "of", "that", "this"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files_below(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let skipped = ["node_modules", "target", "dist"].iter().any(|name| path.ends_with(name));
        if path.is_dir() && !skipped {
            files_below(&path, extensions, found);
        } else if path.extension().is_some_and(|found| extensions.iter().any(|wanted| found == *wanted)) {
            found.push(path);
        }
    }
}

/// Files below the folders with one of the extensions, sorted, as (path from the root, text); this file is left out.
fn texts(folders: &[&str], extensions: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in folders {
        files_below(&root().join(folder), extensions, &mut found);
    }
    found.retain(|path| !path.ends_with("tests/english.rs"));
    found.sort();
    let relative = |path: &Path| path.strip_prefix(root()).unwrap().display().to_string();
    let texts = found.iter().map(|path| (relative(path), fs::read_to_string(path).unwrap()));
    texts.collect()
}

/// Rust sources of the service, the core, tests, benches and examples.
fn sources() -> Vec<(String, String)> {
    texts(&["src", "tests", "benches", "examples"], &["rs"])
}

/// Text of a doc comment line, without its marker.
fn doc(line: &str) -> Option<&str> {
    let line = line.trim_start();
    line.strip_prefix("///").or_else(|| line.strip_prefix("//!")).map(str::trim)
}

fn report(rule: &str, violations: &[String]) {
    assert!(violations.is_empty(), "{rule}:\n  {}", violations.join("\n  "));
}

#[test]
fn doc_comments_begin_with_a_noun_or_a_verb() {
    let mut violations = Vec::new();
    for (file, text) in sources().into_iter().chain(texts(&["proto"], &["proto"])) {
        let mut inside = false;
        for (index, line) in text.lines().enumerate() {
            let comment = if file.starts_with("proto/") { line.trim_start().strip_prefix("//") } else { doc(line) };
            let first = comment.filter(|_| !inside).and_then(|comment| comment.split_whitespace().next());
            if first.is_some_and(|word| OPENINGS.contains(&word)) {
                violations.push(format!("{file}:{}: {}", index + 1, line.trim()));
            }
            inside = comment.is_some();
        }
    }
    report("doc comments that begin with a question word", &violations);
}

#[test]
fn phrases_with_a_plainer_form_are_not_used() {
    let mut violations = Vec::new();
    for (file, text) in sources().into_iter().chain(texts(&["proto"], &["proto"])).chain(texts(&["docs"], &["md"])) {
        for (index, line) in text.lines().enumerate() {
            let found = PHRASES.iter().filter(|phrase| contains_words(line, phrase));
            violations.extend(found.map(|phrase| format!("{file}:{}: {phrase:?}", index + 1)));
            if says_is_no(line) {
                violations.push(format!("{file}:{}: \"is no ...\" for \"is not a ...\"", index + 1));
            }
        }
    }
    report("phrases with a plainer form", &violations);
}

/// Whether `phrase` stands in `line` as whole words.
fn contains_words(line: &str, phrase: &str) -> bool {
    let letter = |text: &str, last: bool| {
        let character = if last { text.chars().next_back() } else { text.chars().next() };
        character.is_some_and(char::is_alphanumeric)
    };
    line.match_indices(phrase).any(|(at, _)| !letter(&line[..at], true) && !letter(&line[at + phrase.len()..], false))
}

/// Whether `line` says "x is no y"; "there is no y" and "is no longer" are plain.
fn says_is_no(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    words.windows(4).any(|window| {
        let there = window[0].to_lowercase().ends_with("there");
        window[1..3] == ["is", "no"] && !there && !AFTER_IS_NO.contains(&window[3])
    })
}

#[test]
fn doc_comments_say_more_than_the_name_below_them() {
    let mut violations = Vec::new();
    for (file, text) in sources() {
        let lines: Vec<&str> = text.lines().collect();
        for index in 0..lines.len() {
            let alone = index == 0 || doc(lines[index - 1]).is_none();
            let Some(comment) = doc(lines[index]).filter(|_| alone) else { continue };
            let below = lines[index + 1..].iter().map(|line| line.trim()).find(|line| !line.starts_with("#["));
            if below.is_some_and(|declaration| words(comment) == words(&name_of(declaration))) {
                violations.push(format!("{file}:{}: {}", index + 1, lines[index].trim()));
            }
        }
    }
    report("doc comments that only repeat the name", &violations);
}

/// Words of a comment or of a name in snake or camel case, lower case, without fillers.
fn words(text: &str) -> Vec<String> {
    let mut spaced = String::new();
    for character in text.chars() {
        if character.is_uppercase() && spaced.ends_with(|c: char| c.is_lowercase() || c.is_ascii_digit()) {
            spaced.push(' ');
        }
        spaced.push(if character.is_alphanumeric() { character.to_ascii_lowercase() } else { ' ' });
    }
    spaced.split_whitespace().filter(|word| !FILLERS.contains(word)).map(str::to_owned).collect()
}

/// Name that a line declares; empty if it declares none.
fn name_of(declaration: &str) -> String {
    let keywords = ["pub", "const", "static", "async", "unsafe", "fn", "struct", "enum", "type", "trait", "mod"];
    let mut rest = declaration;
    while let Some(space) = rest.find(' ') {
        let word = rest[..space].split('(').next().unwrap_or("");
        if !keywords.contains(&word) {
            break;
        }
        rest = &rest[space + 1..];
    }
    rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

#[test]
fn paths_named_for_newcomers_exist() {
    let mut violations = Vec::new();
    for document in ["CONTRIBUTING.md", "README.md"] {
        let text = fs::read_to_string(root().join(document)).unwrap();
        let named = text.split(['`', '(', ')', ' ', '\n']).map(|word| word.trim_end_matches([',', '.', ';', ':']));
        for path in named.filter(|word| is_path(word)) {
            let known: PathBuf =
                Path::new(path).iter().take_while(|part| !is_placeholder(&part.to_string_lossy())).collect();
            if !root().join(&known).exists() {
                violations.push(format!("{document}: {path}"));
            }
        }
    }
    report("paths that do not exist", &violations);
}

/// Whether a word names a file or folder of the repository.
fn is_path(word: &str) -> bool {
    let top = word.split('/').next().unwrap_or("");
    let plain = word.chars().all(|c| c.is_alphanumeric() || "/._-*{},".contains(c));
    plain && word.contains('/') && !top.is_empty() && root().join(top).is_dir()
}

/// Whether a part of a path stands for any name: `NAME.rs`, `NNNN_what.sql`, `*.csv`, `{a,b}.rs`.
fn is_placeholder(part: &str) -> bool {
    part.contains(['*', '{']) || ["NAME", "NNNN"].iter().any(|any| part.starts_with(any))
}
