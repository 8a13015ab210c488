//! Reading the sources: files, lines of code, and the paths that they name.

use std::fs;
use std::path::{Path, PathBuf};

/// The root of the repository.
pub fn root() -> PathBuf {
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
pub fn sources(folders: &[&str], extensions: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in folders {
        files_below(&root().join(folder), extensions, &mut found);
    }
    found.sort();
    let relative = |path: &Path| path.strip_prefix(root()).unwrap().display().to_string();
    found.iter().map(|path| (relative(path), fs::read_to_string(path).unwrap())).collect()
}

/// The lines of code with their numbers from 1: no comment lines, nothing after a trailing `//` comment.
pub fn code_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(index, line)| {
        let code = line.split(" // ").next().unwrap_or(line);
        (!line.trim_start().starts_with("//")).then_some((index + 1, code))
    })
}

/// Whether all of a file is test code, or the example of a package.
pub fn is_test_file(file: &str) -> bool {
    let name = file.rsplit('/').next().unwrap_or(file);
    file.contains("/examples/") || name.ends_with("tests.rs") || name == "fixtures.rs" || name == "suite.rs"
}

/// The text up to the file's unit tests.
pub fn without_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text)
}

/// A path that begins with `crate` or `super`, and the line it begins in.
#[derive(Debug, PartialEq, Eq)]
pub struct Reference {
    pub line: usize,
    /// Segments, `crate` or `super` among them.
    pub path: Vec<String>,
}

/// Every path that begins with `crate::` or `super::`; groups are expanded, over several lines too.
pub fn references(text: &str) -> Vec<Reference> {
    let mut code = String::new();
    let mut written = 0;
    for (line, part) in code_lines(text) {
        code.push_str(&"\n".repeat(line - 1 - written));
        written = line - 1;
        code.push_str(part);
    }
    let mut found = Vec::new();
    let starts = ["crate::", "super::"].iter().flat_map(|start| code.match_indices(start));
    for (at, _) in starts {
        let is_inner = code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':');
        if !is_inner {
            let line = code[..at].matches('\n').count() + 1;
            let mut paths = Vec::new();
            read_tree(&code[at..], &[], &mut paths);
            found.extend(paths.into_iter().map(|path| Reference { line, path }));
        }
    }
    found
}

/// Reads `a::b` or `a::{b, c::d}` behind `prefix`; returns the rest.
fn read_tree<'a>(text: &'a str, prefix: &[String], found: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        let mut rest = group.trim_start();
        while !rest.is_empty() && !rest.starts_with('}') {
            rest = read_tree(rest, prefix, found);
            let end = rest.find([',', '}']).unwrap_or(rest.len());
            rest = rest[end..].trim_start_matches(',').trim_start();
        }
        return rest.strip_prefix('}').unwrap_or(rest);
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    let path = [prefix, &[word.to_owned()]].concat();
    match rest.strip_prefix("::") {
        Some(rest) if !word.is_empty() => read_tree(rest, &path, found),
        _ => {
            found.push(path.into_iter().filter(|segment| !segment.is_empty()).collect());
            rest
        }
    }
}

#[test]
fn references_are_seen_wherever_they_stand() {
    let seen = |code: &str| references(code).iter().map(|r| (r.line, r.path.join(" "))).collect::<Vec<_>>();
    let of = |line: usize, path: &str| (line, path.to_owned());
    assert_eq!(seen("use crate::{app::App, store};"), [of(1, "crate app App"), of(1, "crate store")]);
    let lines = "// crate::http\nuse crate::{\n    app::{A, B as C},\n    store,\n};\n";
    assert_eq!(seen(lines), [of(2, "crate app A"), of(2, "crate app B"), of(2, "crate store")]);
    assert_eq!(seen("let a = othercrate::app::x();\nlet b = super::super::y(1);"), [of(2, "super super y")]);
    assert_eq!(code_lines("// sqlx\nlet a = 1; // tokio\n").collect::<Vec<_>>(), [(2, "let a = 1;")]);
}
