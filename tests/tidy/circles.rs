//! No circles: of the modules side by side in a folder, none imports itself by way of others.
//!
//! Paths are resolved to the deepest module that exists; test code is left out. A parent and its children are one idea
//! and may name each other.

use crate::source::{is_test_file, references, sources, without_tests};
use std::collections::{BTreeMap, BTreeSet};

/// Folder of a package's sources, and what below it is not its own.
const PACKAGES: [(&str, &str); 2] = [("src/framework/", "-"), ("src/", "src/framework/")];

type Module = Vec<String>;
/// For each folder, which of its modules imports which.
type Imports = BTreeMap<Module, BTreeMap<String, BTreeSet<String>>>;

fn module(path: &str) -> Module {
    let stem = path.strip_suffix(".rs").unwrap_or(path);
    let mut segments: Module = stem.split('/').map(str::to_owned).collect();
    if matches!(segments.last().map(String::as_str), Some("mod" | "lib" | "main")) {
        segments.pop();
    }
    segments
}

/// Start of a path that stands in `from`, with `crate` and `super` resolved.
fn absolute(from: &Module, path: &[String]) -> Module {
    let mut base = from.clone();
    for (index, segment) in path.iter().enumerate() {
        match segment.as_str() {
            "crate" => base.clear(),
            "super" => drop(base.pop()),
            _ => return [base, path[index..].to_vec()].concat(),
        }
    }
    base
}

fn imports(files: &[(Module, &str)]) -> Imports {
    let modules: BTreeSet<&Module> = files.iter().map(|(module, _)| module).collect();
    let mut all = Imports::new();
    for (from, text) in files {
        for reference in references(without_tests(text)) {
            let mut to = absolute(from, &reference.path);
            while !to.is_empty() && !modules.contains(&to) {
                to.pop();
            }
            let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if let (Some(one), Some(other)) = (from.get(shared), to.get(shared)) {
                let siblings = all.entry(from[..shared].to_vec()).or_default();
                siblings.entry(one.clone()).or_default().insert(other.clone());
            }
        }
    }
    all
}

fn reached<'a>(graph: &'a BTreeMap<String, BTreeSet<String>>, start: &str) -> BTreeSet<&'a str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![start]);
    while let Some(next) = open.pop() {
        let unseen = graph.get(next).into_iter().flatten().filter(|name| found.insert(name.as_str()));
        open.extend(unseen.map(String::as_str).collect::<Vec<_>>());
    }
    found
}

/// Each circle as `folder: a, b`.
fn circles(imports: &Imports) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (folder, graph) in imports {
        for name in graph.keys() {
            let returns = |other: &&str| reached(graph, other).contains(name.as_str());
            let members: Vec<&str> = reached(graph, name).into_iter().filter(returns).collect();
            if !members.is_empty() {
                found.insert(format!("{}: {}", folder.join("/"), members.join(", ")));
            }
        }
    }
    found
}

#[test]
fn modules_import_one_another_in_one_direction() {
    let mut found = BTreeSet::new();
    for (package, others) in PACKAGES {
        let all = sources(&[package.trim_end_matches('/')], &["rs"]);
        let own = all.iter().filter(|(file, _)| !file.starts_with(others) && !is_test_file(file));
        let files: Vec<_> =
            own.map(|(file, text)| (module(file.strip_prefix(package).unwrap_or(file)), text.as_str())).collect();
        let imports = imports(&files);
        let edges: usize = imports.values().flat_map(BTreeMap::values).map(BTreeSet::len).sum();
        let circles = circles(&imports);
        println!("{package}: {} modules, {edges} imports between siblings, {} circles", files.len(), circles.len());
        assert!(edges > 20, "{package}: imports are not seen");
        found.extend(circles.into_iter().map(|circle| format!("{package}{circle}")));
    }
    crate::report("modules that import themselves by way of others", &found.into_iter().collect::<Vec<_>>());
}

#[test]
fn a_circle_is_found() {
    let module = |name: &str| name.split('/').map(str::to_owned).collect::<Module>();
    let files = [
        (module("a"), "use crate::b::c::X;"),
        (module("b"), ""),
        (module("b/c"), "use super::d;"),
        (module("b/d"), "fn x() { crate::a::y() }"),
    ];
    assert_eq!(circles(&imports(&files)).into_iter().collect::<Vec<_>>(), [": a, b"]);
    assert!(circles(&imports(&files[..3])).is_empty());
}
