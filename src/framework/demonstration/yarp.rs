//! The authors' YARP logs at full rate and their reduced files: one sample per line, separated by spaces: id, time in
//! seconds (Unix epoch), values. No header.

use super::table::{Findings, Place, Table, check_magnitude, number};
use super::{Finding, FindingCode, ReadOptions, known_features, text};
use crate::Feature;

pub(super) fn parse(content: &str, stream: &str, options: &ReadOptions, findings: &mut Findings) -> Option<Table> {
    if text::has_long_line(content, options.limits.line_bytes, stream, findings) {
        return None;
    }
    let mut lines = content.lines().zip(1_u64..).filter(|(line, _)| !line.trim().is_empty()).peekable();
    let (first, _) = lines.peek()?;
    let columns = first.split_whitespace().count();
    let features = features(columns, stream, options, findings)?;
    let m = features.len();
    let names: Vec<String> =
        ["id", "time"].into_iter().map(str::to_owned).chain(features.iter().map(|f| f.name.clone())).collect();
    let mut table = Table::new(stream, features);
    for (line, row) in lines {
        if findings.full() || table.rows.len() as u64 >= options.limits.samples.saturating_add(1) {
            break;
        }
        let found = line.split_whitespace().count();
        if found != columns {
            findings.push(
                Finding::error(
                    FindingCode::RaggedRow,
                    format!("{found} columns, but the first row has {columns}"),
                    "complete or remove the row; a log cut off during recording ends in half a row",
                )
                .in_stream(stream)
                .at_row(row),
            );
            continue;
        }
        let mut cells = line.split_whitespace().zip(&names);
        let mut next = |findings: &mut Findings| {
            cells.next().map_or(f64::NAN, |(cell, column)| number(cell, Place { stream, row, column }, findings))
        };
        next(findings);
        let time_s = next(findings);
        for feature in 0..m {
            let value = next(findings);
            let place = Place { stream, row, column: &names[feature + 2] };
            check_magnitude(value, &options.limits, place, findings);
            table.values.push(value);
        }
        table.rows.push(row);
        table.time_s.push(time_s);
    }
    Some(table)
}

/// Features of the columns after id and time: those given, else those known for the stream, else `value_1`, ...
fn features(columns: usize, stream: &str, options: &ReadOptions, findings: &mut Findings) -> Option<Vec<Feature>> {
    let Some(values) = columns.checked_sub(2).filter(|values| *values > 0) else {
        findings.push(
            Finding::error(
                FindingCode::TooSmall,
                format!("{columns} columns, but id, time and at least one value are needed"),
                "write rows as: id time value ..",
            )
            .in_stream(stream)
            .at_row(1),
        );
        return None;
    };
    let given = options.stream_features.get(stream).unwrap_or(&options.features);
    if !given.is_empty() && given.len() != values {
        findings.push(
            Finding::error(
                FindingCode::BadOption,
                format!("{} features are named, but there are {values} columns of values", given.len()),
                "name one feature per column after id and time",
            )
            .in_stream(stream),
        );
        return None;
    }
    let mut features = if given.is_empty() {
        known_features(stream, values)
            .unwrap_or_else(|| (1..=values).map(|i| Feature::new(format!("value_{i}"), "")).collect())
    } else {
        given.clone()
    };
    for feature in &mut features {
        if let Some(unit) = options.units.get(&feature.name) {
            feature.unit.clone_from(unit);
        }
    }
    Some(features)
}
