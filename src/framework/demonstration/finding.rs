//! What ingest finds in a file: each finding names its place, a stable code and a remedy.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Whether a finding refuses the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// The file is refused.
    Error,
    /// The file is accepted; the finding is kept with it.
    Warning,
}

/// What was found; the snake_case form is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum FindingCode {
    /// Nothing in the file but space.
    Empty,
    /// Not UTF-8 text, or text with control characters.
    NotText,
    /// Larger than a limit: bytes, line, samples, features, streams.
    TooLarge,
    /// Fewer than two samples or no feature.
    TooSmall,
    /// Not JSON of the canonical form.
    JsonSyntax,
    /// No header where one is needed.
    MissingHeader,
    /// The header has no time column.
    MissingTime,
    /// Two columns of one name.
    DuplicateColumn,
    /// Two streams of one name.
    DuplicateStream,
    /// A name or unit with other characters or longer than allowed.
    BadName,
    /// The options do not fit the file.
    BadOption,
    /// A row of another length than the first.
    RaggedRow,
    /// An empty cell.
    MissingValue,
    /// Not a decimal number.
    NumberSyntax,
    /// A number with a decimal comma.
    DecimalComma,
    /// NaN, infinite, or too large for a 64-bit number.
    NonFinite,
    /// Finite but beyond any measurement.
    OutOfRange,
    /// Time in milliseconds, microseconds or nanoseconds read as seconds.
    TimeUnit,
    /// Time that does not increase.
    NonIncreasingTime,
    /// The same row again; the copy was left out.
    DuplicateRow,
    /// A step in time much longer than the stream's usual one.
    Gap,
    /// First to last sample takes less than the lower limit.
    TooShort,
    /// First to last sample takes more than the upper limit.
    TooLong,
    /// Streams recorded together start at different times.
    ClockOffset,
    /// Streams recorded together last differently long.
    DurationMismatch,
    /// Two streams or demonstrations with the same samples.
    DuplicateContent,
}

/// One observation about a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Finding {
    /// Whether it refuses the file.
    pub severity: Severity,
    /// What was found.
    pub code: FindingCode,
    /// The stream, where it concerns one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    /// The line of the file from 1 (CSV, logs) or the sample from 1 (JSON).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub row: Option<u64>,
    /// The column's or feature's name, or `column N` from 1 where it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<String>,
    /// The recorder's time at that place, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// What is the matter, with the numbers.
    pub message: String,
    /// What to do about it.
    pub remedy: String,
}

impl Finding {
    /// A finding that refuses the file; its place is added by the `in_stream`, `at_row`, .. methods.
    pub fn error(code: FindingCode, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message.into(), remedy.into())
    }

    /// A finding that is kept with the accepted file.
    pub fn warning(code: FindingCode, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message.into(), remedy.into())
    }

    fn new(severity: Severity, code: FindingCode, message: String, remedy: String) -> Self {
        Self { severity, code, stream: None, row: None, column: None, time_s: None, message, remedy }
    }

    /// In that stream.
    #[must_use]
    pub fn in_stream(mut self, stream: impl Into<String>) -> Self {
        self.stream = Some(stream.into());
        self
    }

    /// At that row, from 1.
    #[must_use]
    pub fn at_row(mut self, row: u64) -> Self {
        self.row = Some(row);
        self
    }

    /// In that column.
    #[must_use]
    pub fn in_column(mut self, column: impl Into<String>) -> Self {
        self.column = Some(column.into());
        self
    }

    /// At that time of the recorder, seconds.
    #[must_use]
    pub fn at_time(mut self, time_s: f64) -> Self {
        self.time_s = Some(time_s);
        self
    }

    /// Whether it refuses the file.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl std::fmt::Display for Finding {
    /// One readable line: `error ragged_row in "x", row 3, column "y", at 0.2 s: message; remedy`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let severity = if self.is_error() { "error" } else { "warning" };
        write!(f, "{severity} {}", self.code)?;
        if let Some(stream) = &self.stream {
            write!(f, " in {stream:?}")?;
        }
        if let Some(row) = self.row {
            write!(f, ", row {row}")?;
        }
        if let Some(column) = &self.column {
            write!(f, ", column {column:?}")?;
        }
        if let Some(time_s) = self.time_s {
            write!(f, ", at {time_s} s")?;
        }
        write!(f, ": {}; {}", self.message, self.remedy)
    }
}

impl std::fmt::Display for FindingCode {
    /// The stable snake_case form.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, letter) in format!("{self:?}").chars().enumerate() {
            if letter.is_ascii_uppercase() && index > 0 {
                write!(f, "_")?;
            }
            write!(f, "{}", letter.to_ascii_lowercase())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_reads_the_same_in_text_and_json() {
        for code in [FindingCode::NonIncreasingTime, FindingCode::Gap, FindingCode::DuplicateContent] {
            assert_eq!(serde_json::to_string(&code).unwrap(), format!("\"{code}\""));
        }
    }

    #[test]
    fn a_finding_is_one_readable_line() {
        let finding = Finding::error(FindingCode::RaggedRow, "2 values, not 3", "complete or remove the row")
            .in_stream("wrist-force")
            .at_row(7)
            .at_time(0.25);
        assert_eq!(
            finding.to_string(),
            "error ragged_row in \"wrist-force\", row 7, at 0.25 s: 2 values, not 3; complete or remove the row"
        );
    }
}
