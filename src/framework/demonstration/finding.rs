//! Findings: each names its place in the file, a stable code and a remedy.

use serde::{Deserialize, Serialize};

/// Severity of a finding: whether it rejects the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// The file is rejected.
    Error,
    /// The file is accepted; the finding is stored with it.
    Warning,
}

/// Kind of a finding; the snake_case form is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum FindingCode {
    /// The file is empty or holds only whitespace.
    Empty,
    /// Not UTF-8 text, or text with control characters.
    NotText,
    /// Larger than a limit: bytes, line, samples, features, streams.
    TooLarge,
    /// Fewer than two samples or no features.
    TooSmall,
    /// Not valid JSON, or not in the canonical form.
    JsonSyntax,
    /// The required header is missing.
    MissingHeader,
    /// The header has no time column.
    MissingTime,
    /// Two columns have the same name.
    DuplicateColumn,
    /// Two streams have the same name.
    DuplicateStream,
    /// A name or unit is too long or contains characters that are not allowed.
    BadName,
    /// The options do not match the file.
    BadOption,
    /// A row's length differs from the first row's.
    RaggedRow,
    /// An empty cell.
    MissingValue,
    /// Not a decimal number.
    NumberSyntax,
    /// A number with a decimal comma.
    DecimalComma,
    /// NaN, infinite, or too large for a 64-bit number.
    NonFinite,
    /// Finite, but larger than any plausible measurement.
    OutOfRange,
    /// Time appears to be in milliseconds, microseconds or nanoseconds instead of seconds.
    TimeUnit,
    /// Time does not strictly increase.
    NonIncreasingTime,
    /// A row repeats the previous one; the copy was dropped.
    DuplicateRow,
    /// A time step is much longer than the stream's median step.
    Gap,
    /// The recording is shorter than the lower limit.
    TooShort,
    /// The recording is longer than the upper limit.
    TooLong,
    /// Streams recorded together start at different times.
    ClockOffset,
    /// Streams recorded together differ in duration.
    DurationMismatch,
    /// Two streams or demonstrations contain the same samples.
    DuplicateContent,
}

/// One observation about a file, with its place and remedy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Finding {
    /// `Error` if the finding rejects the file.
    pub severity: Severity,
    /// Stable kind of the finding.
    pub code: FindingCode,
    /// Name of the stream; `None` if the finding concerns the whole file.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub stream: Option<String>,
    /// Line of the file (CSV, logs) or sample (JSON), from 1.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub row: Option<u64>,
    /// Name of the column or feature; `column N` (from 1) if it has no name.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub column: Option<String>,
    /// Time at that place on the recorder's clock, seconds.
    #[cfg_attr(feature = "schema", schema(required = true))]
    pub time_s: Option<f64>,
    /// Description of the problem, with the numbers.
    pub message: String,
    /// Suggested remedy.
    pub remedy: String,
}

impl Finding {
    /// A finding that rejects the file. Its place is added with `in_stream`, `at_row`, `in_column` and `at_time`.
    pub fn error(code: FindingCode, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message.into(), remedy.into())
    }

    /// A finding that is stored with the accepted file.
    pub fn warning(code: FindingCode, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message.into(), remedy.into())
    }

    fn new(severity: Severity, code: FindingCode, message: String, remedy: String) -> Self {
        Self { severity, code, stream: None, row: None, column: None, time_s: None, message, remedy }
    }

    /// Sets the stream.
    #[must_use]
    pub fn in_stream(mut self, stream: impl Into<String>) -> Self {
        self.stream = Some(stream.into());
        self
    }

    /// Sets the row, from 1.
    #[must_use]
    pub fn at_row(mut self, row: u64) -> Self {
        self.row = Some(row);
        self
    }

    /// Sets the column.
    #[must_use]
    pub fn in_column(mut self, column: impl Into<String>) -> Self {
        self.column = Some(column.into());
        self
    }

    /// Sets the time on the recorder's clock, seconds.
    #[must_use]
    pub fn at_time(mut self, time_s: f64) -> Self {
        self.time_s = Some(time_s);
        self
    }

    /// Whether the finding rejects the file.
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
