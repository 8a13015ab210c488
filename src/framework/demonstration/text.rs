//! Decoding bytes to text, format detection, and the rules for names.

use super::table::{Findings, Table, quote};
use super::{Finding, FindingCode, Format};
use crate::{MAX_DISPLAY_NAME_CHARS, is_display_name, is_hidden};

/// Decodes UTF-8 without NUL and other control characters; a byte order mark is dropped.
pub(super) fn decode<'a>(bytes: &'a [u8], stream: &str, findings: &mut Findings) -> Option<&'a str> {
    let refuse = |findings: &mut Findings, at: usize, what: &str| {
        let row = bytes[..at].split(|b| *b == b'\n').count() as u64;
        findings.push(
            Finding::error(FindingCode::NotText, format!("{what} at byte {at}"), "save the file as UTF-8 text")
                .in_stream(stream)
                .at_row(row),
        );
        None
    };
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => return refuse(findings, error.valid_up_to(), "not UTF-8"),
    };
    if let Some(at) = bytes.iter().position(|b| b.is_ascii_control() && !matches!(b, b'\t' | b'\n' | b'\r')) {
        return refuse(findings, at, &format!("control character {:#04x}", bytes[at]));
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        findings
            .push(Finding::error(FindingCode::Empty, "the file is empty", "give a file of samples").in_stream(stream));
        return None;
    }
    Some(text)
}

/// Detects the format from the first line that is not empty.
pub(super) fn detect(text: &str) -> Format {
    if text.trim_start().starts_with(['{', '[']) {
        return Format::Json;
    }
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let mut cells = first.split_whitespace().peekable();
    let spaced_numbers = first.split_whitespace().nth(1).is_some() && cells.all(looks_numeric);
    if spaced_numbers { Format::Yarp } else { Format::Csv }
}

/// A number or a malformed one (`1,5`, `nan`), but not a cell of a comma-separated line.
fn looks_numeric(cell: &str) -> bool {
    cell.parse::<f64>().is_ok()
        || (cell.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b',' | b'e' | b'E'))
            && !cell.ends_with(',')
            && cell.matches(',').count() < 2)
}

/// Reports a line beyond the limit; returns true if there is one.
pub(super) fn has_long_line(text: &str, limit: usize, stream: &str, findings: &mut Findings) -> bool {
    let Some((index, line)) = text.split('\n').enumerate().find(|(_, line)| line.len() > limit) else { return false };
    findings.too_large(
        &format!("{} bytes in a line", line.len()),
        &format!("{limit} bytes"),
        Some((stream, index as u64 + 1)),
    );
    true
}

/// Checks names: streams and features are `[A-Za-z0-9 _.:-]{1,128}`, units at most 32 visible characters, all names
/// unique.
pub(super) fn check_names(table: &Table, findings: &mut Findings) {
    let stream = &table.stream;
    let plain = |name: &str| {
        (1..=128).contains(&name.len())
            && name.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b' ' | b'_' | b'.' | b':' | b'-'))
    };
    let bad = |what: &str, name: &str, rule: &str| {
        Finding::error(FindingCode::BadName, format!("{what} {} is not {rule}", quote(name)), "choose another name")
    };
    let rule = "1 to 128 of the characters A-Z a-z 0-9 space _ . : -";
    if !plain(stream) {
        findings.push(bad("stream name", stream, rule));
    }
    for (index, feature) in table.features.iter().enumerate() {
        let column = format!("column {}", index + 1);
        if !plain(&feature.name) {
            findings.push(bad("feature name", &feature.name, rule).in_stream(stream).in_column(&column));
        }
        if feature.unit.chars().count() > 32 || feature.unit.chars().any(is_hidden) {
            let rule = "at most 32 visible characters";
            findings.push(bad("unit", &feature.unit, rule).in_stream(stream).in_column(&column));
        }
        let lower = feature.name.to_lowercase();
        if table.features[..index].iter().any(|other| other.name.to_lowercase() == lower) {
            findings.push(
                Finding::error(
                    FindingCode::DuplicateColumn,
                    format!("two columns are named {}", quote(&feature.name)),
                    "give each column a different name; case is ignored",
                )
                .in_stream(stream)
                .in_column(column),
            );
        }
    }
}

/// Rejects a display name that is too long or holds hidden characters.
pub(super) fn check_display_name(name: &str, findings: &mut Findings) {
    if !is_display_name(name) {
        findings.push(Finding::error(
            FindingCode::BadName,
            format!("demonstration name {} is not 1 to {MAX_DISPLAY_NAME_CHARS} visible characters", quote(name)),
            "choose another name",
        ));
    }
}
