//! Output of every parser: a stream's rows as they appear in the file, and the list of findings.

use super::{Finding, FindingCode, Limits};
use crate::Feature;

/// A stream under construction: `values` is row-major, `rows[i]` is the row of sample i in its file.
#[derive(Debug)]
pub(super) struct Table {
    pub stream: String,
    pub features: Vec<Feature>,
    pub rows: Vec<u64>,
    pub time_s: Vec<f64>,
    pub values: Vec<f64>,
}

impl Table {
    pub fn new(stream: &str, features: Vec<Feature>) -> Self {
        Self { stream: stream.to_owned(), features, rows: Vec::new(), time_s: Vec::new(), values: Vec::new() }
    }
}

/// Findings so far; parsers stop once the limit is reached.
#[derive(Debug)]
pub(super) struct Findings {
    pub list: Vec<Finding>,
    limit: usize,
}

impl Findings {
    pub fn new(limits: &Limits) -> Self {
        Self { list: Vec::new(), limit: limits.findings.max(1) }
    }

    /// Adds a finding. Beyond the limit only the first error is still added, so that a rejection is never lost.
    pub fn push(&mut self, finding: Finding) {
        if !self.full() || (finding.is_error() && !self.refused()) {
            self.list.push(finding);
        }
    }

    pub fn full(&self) -> bool {
        self.list.len() >= self.limit
    }

    pub fn refused(&self) -> bool {
        self.list.iter().any(Finding::is_error)
    }

    pub fn too_large(&mut self, found: &str, limit: &str, place: Option<(&str, u64)>) {
        let mut finding = Finding::error(
            FindingCode::TooLarge,
            format!("{found} exceed the limit of {limit}"),
            "split the recording or record at a lower rate",
        );
        if let Some((stream, row)) = place {
            finding = finding.in_stream(stream).at_row(row);
        }
        self.push(finding);
    }
}

/// Location of a cell, for findings.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    pub stream: &'a str,
    pub row: u64,
    pub column: &'a str,
}

impl Place<'_> {
    pub fn finding(&self, code: FindingCode, message: String, remedy: &str) -> Finding {
        Finding::error(code, message, remedy).in_stream(self.stream).at_row(self.row).in_column(self.column)
    }
}

/// Parses a decimal number. Anything else becomes an error finding, which rejects the file, and NaN.
pub(super) fn number(cell: &str, place: Place<'_>, findings: &mut Findings) -> f64 {
    let finding = match cell.parse::<f64>() {
        Ok(value) if value.is_finite() => return value,
        Ok(_) => place.finding(
            FindingCode::NonFinite,
            format!("{} is not a finite number", quote(cell)),
            "remove the row or record it again; values are never filled in",
        ),
        Err(_) if cell.is_empty() => place.finding(
            FindingCode::MissingValue,
            "the cell is empty".to_owned(),
            "complete or remove the row; values are never filled in",
        ),
        Err(_) if is_decimal_comma(cell) => place.finding(
            FindingCode::DecimalComma,
            format!("{} has a decimal comma", quote(cell)),
            "write numbers with a decimal point",
        ),
        Err(_) => place.finding(
            FindingCode::NumberSyntax,
            format!("{} is not a decimal number", quote(cell)),
            "write numbers as 12.5 or 1.25e1",
        ),
    };
    findings.push(finding);
    f64::NAN
}

/// Checks that a feature's value is within the plausibility bound.
pub(super) fn check_magnitude(value: f64, limits: &Limits, place: Place<'_>, findings: &mut Findings) {
    if value.abs() > limits.max_magnitude {
        findings.push(place.finding(
            FindingCode::OutOfRange,
            format!("{value:e} is not a plausible measurement (limit {:e})", limits.max_magnitude),
            "correct the value or its unit",
        ));
    }
}

fn is_decimal_comma(cell: &str) -> bool {
    cell.split_once(',').is_some_and(|(whole, rest)| {
        let whole = whole.trim_start_matches(['+', '-']);
        !rest.is_empty() && [whole, rest].iter().all(|part| part.bytes().all(|b| b.is_ascii_digit()))
    })
}

/// The text in quotes, shortened, because it comes from an untrusted file.
pub(super) fn quote(text: &str) -> String {
    if text.chars().count() <= 40 {
        format!("{text:?}")
    } else {
        format!("{:?}..", text.chars().take(40).collect::<String>())
    }
}
