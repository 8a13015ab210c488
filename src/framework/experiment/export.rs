//! Tables as text: CSV for machines, Markdown for people. CSV numbers have full precision.

use super::{CellResult, PairedComparison, Summary};
use std::fmt::Write;

/// Columns of [`paper_csv`].
pub const PAPER_COLUMNS: [&str; 10] = [
    "table",
    "action",
    "setting",
    "evaluations_mean",
    "evaluations_sd",
    "discrepancy_mean",
    "discrepancy_sd",
    "painted_mean",
    "repetitions",
    "invalid",
];

fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn value(number: Option<f64>) -> String {
    number.map_or_else(String::new, |number| number.to_string())
}

fn lines(rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = String::new();
    for row in rows {
        text += &row.join(",");
        text.push('\n');
    }
    text
}

/// The table with the columns of [`PAPER_COLUMNS`].
#[must_use]
pub fn paper_csv(results: &[CellResult]) -> String {
    let header = PAPER_COLUMNS.map(str::to_owned).to_vec();
    let row = |r: &CellResult| {
        vec![
            field(&r.table),
            field(&r.action),
            field(&r.setting),
            value(r.evaluations.map(|s| s.mean)),
            value(r.evaluations.and_then(|s| s.sd)),
            value(r.discrepancy.map(|s| s.mean)),
            value(r.discrepancy.and_then(|s| s.sd)),
            value(r.painted.map(|s| s.mean)),
            r.repetitions.to_string(),
            r.invalid.to_string(),
        ]
    };
    lines(std::iter::once(header).chain(results.iter().map(row)))
}

/// The table with every statistic.
#[must_use]
pub fn full_csv(results: &[CellResult]) -> String {
    const QUANTITIES: [&str; 3] = ["evaluations", "discrepancy", "painted"];
    const STATISTICS: [&str; 9] = ["count", "mean", "sd", "low_95", "high_95", "median", "p90", "minimum", "maximum"];
    let mut header = ["table", "action", "setting", "repetitions", "invalid"].map(str::to_owned).to_vec();
    header.extend(QUANTITIES.iter().flat_map(|q| STATISTICS.iter().map(move |s| format!("{q}_{s}"))));
    let statistics = |summary: Option<Summary>| {
        let Some(s) = summary else { return [const { String::new() }; 9] };
        let exact = [Some(s.mean), s.sd, s.interval_95.map(|i| i[0]), s.interval_95.map(|i| i[1])];
        let [mean, sd, low, high] = exact.map(value);
        let [median, p90, minimum, maximum] = [s.median, s.p90, s.minimum, s.maximum].map(|v| v.to_string());
        [s.count.to_string(), mean, sd, low, high, median, p90, minimum, maximum]
    };
    let row = |r: &CellResult| {
        let mut row = vec![field(&r.table), field(&r.action), field(&r.setting)];
        row.extend([r.repetitions.to_string(), r.invalid.to_string()]);
        row.extend([r.evaluations, r.discrepancy, r.painted].into_iter().flat_map(statistics));
        row
    };
    lines(std::iter::once(header).chain(results.iter().map(row)))
}

/// Markdown with aligned columns; the first `names` columns are text, the rest numbers.
#[must_use]
pub fn markdown_table(header: &[&str], rows: &[Vec<String>], names: usize) -> String {
    let width = |k: usize| {
        let cells = rows.iter().map(|row| row[k].chars().count());
        cells.chain([header[k].chars().count(), 3]).max().unwrap_or(3)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let mut text = String::new();
    let mut push = |cells: Vec<String>| {
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    };
    let pad = |k: usize, cell: &str| {
        let blank = " ".repeat(widths[k].saturating_sub(cell.chars().count()));
        if k < names { format!("{cell}{blank}") } else { format!("{blank}{cell}") }
    };
    push(header.iter().enumerate().map(|(k, cell)| pad(k, cell)).collect());
    let rule = |k: usize| {
        let dashes = "-".repeat(widths[k] - 1);
        if k < names { format!("{dashes}-") } else { format!("{dashes}:") }
    };
    push((0..header.len()).map(rule).collect());
    for row in rows {
        push(row.iter().enumerate().map(|(k, cell)| pad(k, &cell.replace('|', "\\|"))).collect());
    }
    text
}

/// The number with that many decimals; `-` if there is none.
#[must_use]
pub fn rounded(number: Option<f64>, decimals: usize) -> String {
    number.map_or_else(|| "-".to_owned(), |number| format!("{number:.decimals$}"))
}

/// Mean and standard deviation; `-` if there is no run.
#[must_use]
pub fn spread(summary: Option<Summary>, decimals: usize) -> String {
    let Some(s) = summary else { return "-".to_owned() };
    format!("{} \u{b1} {}", rounded(Some(s.mean), decimals), rounded(s.sd, decimals))
}

fn interval(summary: Option<Summary>, decimals: usize) -> String {
    let Some([low, high]) = summary.and_then(|s| s.interval_95) else { return "-".to_owned() };
    format!("{low:.decimals$} to {high:.decimals$}")
}

/// Markdown for any experiment: mean and sd, 95 % interval of the mean, median.
#[must_use]
pub fn markdown(results: &[CellResult]) -> String {
    const HEADER: [&str; 12] = [
        "table",
        "action",
        "setting",
        "evaluations",
        "95 % interval",
        "median",
        "discrepancy",
        "95 % interval",
        "median",
        "painted %",
        "runs",
        "invalid",
    ];
    let row = |r: &CellResult| {
        vec![
            r.table.clone(),
            r.action.clone(),
            r.setting.clone(),
            spread(r.evaluations, 0),
            interval(r.evaluations, 0),
            rounded(r.evaluations.map(|s| s.median), 0),
            spread(r.discrepancy, 2),
            interval(r.discrepancy, 2),
            rounded(r.discrepancy.map(|s| s.median), 2),
            rounded(r.painted.map(|s| s.mean), 2),
            r.repetitions.to_string(),
            r.invalid.to_string(),
        ]
    };
    markdown_table(&HEADER, &results.iter().map(row).collect::<Vec<_>>(), 3)
}

/// A paired comparison in one sentence.
#[must_use]
pub fn sentence(first: &str, second: &str, quantity: &str, c: &PairedComparison) -> String {
    let mut text = format!("{second} against {first}, {quantity}: {:+.4}", c.mean_difference);
    if let Some([low, high]) = c.interval_95 {
        let _ = write!(text, " ({low:+.4} to {high:+.4} at 95 %)");
    }
    let _ = write!(
        text,
        " over {} seeds; Wilcoxon signed rank p = {:.3e}, rank-biserial {:+.3}",
        c.pairs, c.p_value, c.rank_biserial
    );
    text
}
