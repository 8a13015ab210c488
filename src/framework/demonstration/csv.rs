//! CSV with a header line: one time column, all others are features; `x [mm]` or `x (mm)` gives a unit. The separator
//! is comma, semicolon or tab; `#` starts a comment line; quoting follows RFC 4180.

use super::table::{Findings, Place, Table, check_magnitude, number, quote};
use super::{Finding, FindingCode, ReadOptions, text};
use crate::Feature;
use ::csv::{ReaderBuilder, StringRecord, Trim};

/// Recognized headers of the time column, in lower case, if the options name none.
const TIME_COLUMNS: [&str; 4] = ["time", "time_s", "t", "timestamp"];

/// Layout of the file: the time column, its unit in seconds, and the features in the other columns.
struct Header {
    names: Vec<String>,
    time: usize,
    seconds_per_unit: f64,
    features: Vec<Feature>,
}

pub(super) fn parse(content: &str, stream: &str, options: &ReadOptions, findings: &mut Findings) -> Option<Table> {
    if text::has_long_line(content, options.limits.line_bytes, stream, findings) {
        return None;
    }
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter(content))
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(content.as_bytes());
    let mut record = StringRecord::new();
    if !next(&mut reader, &mut record, stream, findings) {
        return None;
    }
    let header = header(&record, stream, options, findings)?;
    let mut table = Table::new(stream, header.features.clone());
    while !findings.full()
        && table.rows.len() as u64 <= options.limits.samples
        && next(&mut reader, &mut record, stream, findings)
    {
        let row = record.position().map_or(0, ::csv::Position::line);
        if record.len() == header.names.len() {
            push_row(&mut table, &header, &record, row, options, findings);
        } else {
            findings.push(ragged(&record, header.names.len()).in_stream(stream).at_row(row));
        }
    }
    Some(table)
}

/// The most frequent of comma, semicolon and tab in the first line that is not a comment.
fn delimiter(content: &str) -> u8 {
    let first = content.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or_default();
    let count = |byte: u8| first.bytes().filter(|b| *b == byte).count();
    [b';', b'\t'].into_iter().fold(b',', |best, byte| if count(byte) > count(best) { byte } else { best })
}

fn next(reader: &mut ::csv::Reader<&[u8]>, record: &mut StringRecord, stream: &str, findings: &mut Findings) -> bool {
    match reader.read_record(record) {
        Ok(more) => more,
        Err(error) => {
            let row = error.position().map_or(0, ::csv::Position::line);
            findings.push(
                Finding::error(FindingCode::RaggedRow, error.to_string(), "quote the row as RFC 4180 requires")
                    .in_stream(stream)
                    .at_row(row),
            );
            false
        }
    }
}

fn header(record: &StringRecord, stream: &str, options: &ReadOptions, findings: &mut Findings) -> Option<Header> {
    let refuse = |findings: &mut Findings, code, message: String, remedy: &str| {
        findings.push(Finding::error(code, message, remedy).in_stream(stream).at_row(1));
        None
    };
    if record.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        let remedy = "start the file with a line of column names such as `time,x [mm]`, or set the format to `yarp`";
        return refuse(findings, FindingCode::MissingHeader, "the first row contains only numbers".to_owned(), remedy);
    }
    let columns: Vec<Feature> = record.iter().map(Feature::from_header).collect();
    let names: Vec<String> = columns.iter().map(|c| c.name.clone()).collect();
    let named = |wanted: &str| names.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let time = match &options.time_column {
        Some(wanted) => names.iter().position(|name| name == wanted),
        None => TIME_COLUMNS.iter().find_map(|wanted| named(wanted)),
    };
    let Some(time) = time else {
        let wanted = options.time_column.clone().unwrap_or_else(|| TIME_COLUMNS.join(", "));
        let message = format!("none of the columns {} is the time column ({wanted})", quote(&names.join(", ")));
        return refuse(findings, FindingCode::MissingTime, message, "name the time column in `time_column`");
    };
    let unit_of = |column: &Feature| options.units.get(&column.name).unwrap_or(&column.unit).clone();
    let time_unit = unit_of(&columns[time]);
    let Some(seconds_per_unit) = seconds_per(&time_unit) else {
        let message = format!("time is in {}", quote(&time_unit));
        return refuse(findings, FindingCode::TimeUnit, message, "give time in s, ms, us or ns");
    };
    let features: Vec<Feature> = columns
        .iter()
        .enumerate()
        .filter(|(index, _)| *index != time)
        .map(|(_, column)| Feature::new(column.name.clone(), unit_of(column)))
        .collect();
    if features.is_empty() {
        let message = "there is only a time column".to_owned();
        return refuse(findings, FindingCode::TooSmall, message, "add one column per feature");
    }
    if features.len() > options.limits.features {
        let limit = format!("{} features", options.limits.features);
        findings.too_large(&format!("{} features", features.len()), &limit, Some((stream, 1)));
        return None;
    }
    if let Some(unknown) = options.units.keys().find(|name| !names.contains(name)) {
        let message = format!("a unit is given for {}, which is not a column", quote(unknown));
        return refuse(findings, FindingCode::BadOption, message, "give units only for columns of the file");
    }
    Some(Header { names, time, seconds_per_unit, features })
}

fn seconds_per(unit: &str) -> Option<f64> {
    match unit {
        "" | "s" | "sec" | "seconds" => Some(1.0),
        "ms" => Some(1e-3),
        "us" | "\u{b5}s" | "\u{3bc}s" => Some(1e-6),
        "ns" => Some(1e-9),
        _ => None,
    }
}

fn push_row(
    table: &mut Table,
    header: &Header,
    record: &StringRecord,
    row: u64,
    options: &ReadOptions,
    findings: &mut Findings,
) {
    let stream = table.stream.clone();
    for (index, (cell, column)) in record.iter().zip(&header.names).enumerate() {
        let place = Place { stream: &stream, row, column };
        let value = number(cell, place, findings);
        if index == header.time {
            table.time_s.push(value * header.seconds_per_unit);
        } else {
            check_magnitude(value, &options.limits, place, findings);
            table.values.push(value);
        }
    }
    table.rows.push(row);
}

fn ragged(record: &StringRecord, columns: usize) -> Finding {
    let found = record.len();
    if found == 2 * columns && record.iter().all(|cell| cell.parse::<i64>().is_ok()) {
        return Finding::error(
            FindingCode::DecimalComma,
            format!("{found} whole numbers for {columns} columns: decimal commas in a comma-separated file"),
            "write numbers with a decimal point, or separate columns with semicolons",
        );
    }
    Finding::error(
        FindingCode::RaggedRow,
        format!("{found} cells, but the header has {columns}"),
        "complete or remove the row",
    )
}
