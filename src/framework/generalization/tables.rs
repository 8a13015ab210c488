//! Goals as CSV: a header of `name [unit]`, then one row per goal with one column per feature.

use super::{Goals, GoalsError};
use crate::Feature;
use std::fmt::Write as _;

/// Reasons why a text is not a table of goals.
#[derive(Debug, thiserror::Error)]
pub enum GoalsFileError {
    /// The text is not CSV.
    #[error("the text is not a table of goals")]
    Csv(#[from] csv::Error),
    /// A cell is not a number.
    #[error("row {row}, column {column:?}: {cell:?} is not a number")]
    Number {
        /// Line of the file, from 1.
        row: u64,
        /// Column header.
        column: String,
        /// Content of the cell.
        cell: String,
    },
    /// The rows do not form a matrix of goals.
    #[error("the table does not form goals")]
    Goals(#[from] GoalsError),
}

/// Writes header and rows; numbers have the shortest digits that round-trip.
#[must_use]
pub fn goals_to_csv(goals: &Goals) -> String {
    let mut text = goals.features().iter().map(Feature::header).collect::<Vec<_>>().join(",");
    text.push('\n');
    for row in goals.rows() {
        for (column, value) in row.iter().enumerate() {
            let separator = if column == 0 { "" } else { "," };
            let _ = write!(text, "{separator}{value}");
        }
        text.push('\n');
    }
    text
}

/// Parses the output of [`goals_to_csv`].
///
/// # Errors
/// [`GoalsFileError`] with row and column.
pub fn goals_from_csv(text: &str) -> Result<Goals, GoalsFileError> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let headers: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let number = |(column, cell): (&String, &str)| {
            cell.parse::<f64>().map_err(|_| GoalsFileError::Number {
                row: record.position().map_or(0, csv::Position::line),
                column: column.clone(),
                cell: cell.to_owned(),
            })
        };
        rows.push(headers.iter().zip(record.iter()).map(number).collect::<Result<Vec<f64>, _>>()?);
    }
    Ok(Goals::new(headers.iter().map(|header| Feature::from_header(header)).collect(), &rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_gives_back_the_same_bits() {
        let features = vec![Feature::new("x", "mm"), Feature::new("score", "")];
        let goals = Goals::new(features, &[vec![0.1 + 0.2, -0.0], vec![1e-300, 1.0 / 3.0]]).unwrap();
        let back = goals_from_csv(&goals_to_csv(&goals)).unwrap();
        assert_eq!(back, goals);
        assert!(goals_to_csv(&goals).starts_with("x [mm],score\n"));
    }

    #[test]
    fn a_wrong_cell_is_named() {
        let error = goals_from_csv("x [mm]\n1\ntwo\n").unwrap_err();
        assert_eq!(error.to_string(), "row 3, column \"x [mm]\": \"two\" is not a number");
    }
}
