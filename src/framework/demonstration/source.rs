//! From files to a demonstration: format detection, parsing, checks within and between streams.

use super::table::{Findings, Table};
use super::{ClockPolicy, Demonstration, Finding, FindingCode, Format, ReadOptions, Stream, StreamError};
use super::{compare, csv, json, text, timing, yarp};
use std::collections::{BTreeMap, BTreeSet};

/// One file of a bundle.
#[derive(Debug, Clone, Copy)]
pub struct SourceFile<'a> {
    /// File name; without folder and extension it names the stream.
    pub name: &'a str,
    /// Raw content of the file.
    pub bytes: &'a [u8],
}

/// A demonstration with its warnings, or findings with at least one error.
pub type ReadResult = Result<(Demonstration, Vec<Finding>), Vec<Finding>>;

/// Reads one file; a JSON file may hold several streams.
///
/// # Errors
/// Findings, at least one of them an error.
pub fn read(bytes: &[u8], options: &ReadOptions) -> ReadResult {
    let name = options.stream.as_deref().unwrap_or("stream");
    read_named(&[(name.to_owned(), bytes)], options)
}

/// Reads a bundle: every file is a stream of one demonstration, named after the file without folder and extension.
///
/// A feature name used by several streams becomes `stream.feature` in each of them.
///
/// # Errors
/// Findings, at least one of them an error.
pub fn read_files(files: &[SourceFile<'_>], options: &ReadOptions) -> ReadResult {
    let named: Vec<(String, &[u8])> = files.iter().map(|f| (stem(f.name).to_owned(), f.bytes)).collect();
    read_named(&named, options)
}

fn read_named(files: &[(String, &[u8])], options: &ReadOptions) -> ReadResult {
    let mut findings = Findings::new(&options.limits);
    let (tables, own_name) = parse(files, options, &mut findings);
    let mut streams = Vec::new();
    for mut table in tables {
        timing::check(&mut table, &options.limits, &mut findings);
        if !findings.refused() {
            streams.push(table);
        }
    }
    if findings.refused() {
        return Err(findings.list);
    }
    let name = options.name.clone().or(own_name).unwrap_or_else(|| streams[0].stream.clone());
    text::check_display_name(&name, &mut findings);
    qualify_shared_names(&mut streams);
    let built = build(streams, options, &mut findings);
    if findings.refused() {
        return Err(findings.list);
    }
    Ok((Demonstration { name, streams: built }, findings.list))
}

/// Parses every file; rejects an empty bundle and totals beyond the limits.
fn parse(files: &[(String, &[u8])], options: &ReadOptions, findings: &mut Findings) -> (Vec<Table>, Option<String>) {
    let limits = &options.limits;
    let mut tables: Vec<Table> = Vec::new();
    let mut own_name = None;
    let total_bytes: u64 = files.iter().map(|(_, bytes)| bytes.len() as u64).sum();
    if total_bytes > limits.bytes {
        findings.too_large(&format!("{total_bytes} bytes"), &format!("{} bytes", limits.bytes), None);
        return (tables, own_name);
    }
    for (stream, bytes) in files {
        let Some(content) = text::decode(bytes, stream, findings) else { continue };
        match options.format.unwrap_or_else(|| text::detect(content)) {
            Format::Json => {
                if let Some((name, parsed)) = json::parse(content, stream, options, findings) {
                    own_name = own_name.or(name);
                    tables.extend(parsed);
                }
            }
            Format::Csv => tables.extend(csv::parse(content, stream, options, findings)),
            Format::Yarp => tables.extend(yarp::parse(content, stream, options, findings)),
        }
        if findings.full() {
            break;
        }
    }
    check_totals(&tables, options, findings);
    (tables, own_name)
}

fn check_totals(tables: &[Table], options: &ReadOptions, findings: &mut Findings) {
    let limits = &options.limits;
    if tables.is_empty() && !findings.refused() {
        findings.push(Finding::error(FindingCode::Empty, "there are no streams", "give at least one file of samples"));
    }
    if tables.len() > limits.streams {
        findings.too_large(&format!("{} streams", tables.len()), &format!("{} streams", limits.streams), None);
    }
    let features: usize = tables.iter().map(|t| t.features.len()).sum();
    if features > limits.features {
        findings.too_large(&format!("{features} features"), &format!("{} features", limits.features), None);
    }
    let samples: u64 = tables.iter().map(|t| t.time_s.len() as u64).sum();
    if samples > limits.samples {
        findings.too_large(&format!("{samples} samples"), &format!("{} samples", limits.samples), None);
    }
    let mut seen = BTreeSet::new();
    for table in tables {
        text::check_names(table, findings);
        if !seen.insert(table.stream.to_lowercase()) {
            findings.push(
                Finding::error(
                    FindingCode::DuplicateStream,
                    format!("two streams are named {:?}", table.stream),
                    "give each file of the bundle a different name",
                )
                .in_stream(&table.stream),
            );
        }
    }
}

/// Makes feature names unique within the demonstration: `x` of two streams becomes `left.x` and `right.x`.
fn qualify_shared_names(tables: &mut [Table]) {
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for table in tables.iter() {
        for feature in &table.features {
            *uses.entry(feature.name.to_lowercase()).or_default() += 1;
        }
    }
    for table in tables {
        for feature in &mut table.features {
            if uses[&feature.name.to_lowercase()] > 1 {
                feature.name = format!("{}.{}", table.stream, feature.name);
            }
        }
    }
}

fn build(tables: Vec<Table>, options: &ReadOptions, findings: &mut Findings) -> Vec<Stream> {
    let mut recorded = Vec::with_capacity(tables.len());
    for table in tables {
        let Table { stream, features, time_s, values, .. } = table;
        recorded.extend(accept(Stream::new(stream, features, time_s, values), findings));
    }
    compare::check_streams(&recorded, options.clock_policy, findings);
    match options.clock_policy {
        ClockPolicy::AsRecorded => recorded,
        ClockPolicy::AlignByStart => {
            recorded.into_iter().filter_map(|stream| accept(stream.starting_at_zero(), findings)).collect()
        }
    }
}

/// Unwraps a stream. The parsers and `timing` report the same defects with their row; this check keeps their rules from
/// drifting away from the type's.
fn accept(result: Result<Stream, StreamError>, findings: &mut Findings) -> Option<Stream> {
    let error = match result {
        Ok(stream) => return Some(stream),
        Err(error) => error,
    };
    let (code, stream) = match &error {
        StreamError::TooSmall { stream, .. } => (FindingCode::TooSmall, stream),
        StreamError::Shape { stream, .. } => (FindingCode::RaggedRow, stream),
        StreamError::NonFinite { stream, .. } => (FindingCode::NonFinite, stream),
        StreamError::NonIncreasing { stream, .. } => (FindingCode::NonIncreasingTime, stream),
    };
    findings.push(Finding::error(code, error.to_string(), "correct the stream").in_stream(stream));
    None
}

/// Strips folder and extension: `a/wrist-force.csv` becomes `wrist-force`.
fn stem(path: &str) -> &str {
    let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
    match file.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => file,
    }
}
