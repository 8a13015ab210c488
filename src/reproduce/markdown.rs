//! The paper's tables as Markdown, ours beside the published ones.

use super::agreement::agreement;
use super::paper::PaperCell;
use crate::framework::experiment::export::{markdown_table, rounded, spread};
use crate::framework::experiment::{CellResult, Summary};
use std::fmt::Write as _;

/// The paper's tables as Markdown: ours next to published and raw, the ratio to raw, and whether it agrees; below them
/// the joint test over all means.
///
/// # Panics
/// If there are not as many cells as results.
#[must_use]
pub fn paper_markdown(cells: &[PaperCell], results: &[CellResult]) -> String {
    const HEADER: [&str; 15] = [
        "table",
        "action",
        "setting",
        "agrees",
        "evaluations",
        "raw",
        "ratio",
        "published",
        "discrepancy",
        "raw",
        "ratio",
        "published",
        "painted %",
        "published",
        "invalid",
    ];
    assert_eq!(cells.len(), results.len(), "one result a cell");
    let known = |mean: f64, sd: Option<f64>, decimals: usize| match sd {
        Some(sd) => format!("{mean:.decimals$} \u{b1} {sd:.decimals$}"),
        None => format!("{mean:.decimals$}"),
    };
    let row = |(cell, r): (&PaperCell, &CellResult)| {
        let ratio = |summary: Option<Summary>, raw: f64| rounded(summary.map(|s| s.mean / raw), 3);
        let outside: Vec<&str> = cell.disagreements(r).iter().map(|d| d.quantity).collect();
        vec![
            cell.table.to_string(),
            cell.action.clone(),
            cell.setting.clone(),
            if outside.is_empty() { "yes".to_owned() } else { format!("no: {}", outside.join(", ")) },
            spread(r.evaluations, 0),
            known(cell.raw.evaluations, cell.raw.evaluations_sd, 0),
            ratio(r.evaluations, cell.raw.evaluations),
            rounded(Some(cell.published.evaluations), 0),
            spread(r.discrepancy, 1),
            known(cell.raw.discrepancy, cell.raw.discrepancy_sd, 1),
            ratio(r.discrepancy, cell.raw.discrepancy),
            rounded(Some(cell.published.discrepancy), 1),
            rounded(r.painted.map(|s| s.mean), 2),
            rounded(cell.published.painted_percent, 2),
            r.invalid.to_string(),
        ]
    };
    let mut text = markdown_table(&HEADER, &cells.iter().zip(results).map(row).collect::<Vec<_>>(), 4);
    if let Some(found) = agreement(cells, results) {
        let (k, (cell, quantity, z)) = (found.means, found.largest);
        let by_chance = (2.0 * k as f64).sqrt();
        let _ = write!(
            text,
            "\n{k} means against the raw logs: sum of z\u{b2} = {:.1}, by chance {k} \u{b1} {by_chance:.1} (p = {:.2}); \
             largest z = {z:+.1}, table {}, {}, {quantity}\n",
            found.sum_of_squares, found.p_value, cells[cell].table, cells[cell].setting
        );
    }
    text
}
