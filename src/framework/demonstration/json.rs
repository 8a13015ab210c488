//! Canonical JSON: `{name, streams: [{name, features: [{name, unit}], time_s: [..], values: ..}]}`.
//!
//! `values` is a flat row-major array or an array of rows. Instead of `time_s` and `values` a stream may have
//! `samples`: rows of time followed by values. `null` and the strings `"NaN"` and `"Infinity"`, which other writers use
//! for non-finite numbers, are reported as non-finite with their row.

use super::table::{Findings, Place, Table, check_magnitude};
use super::{Finding, FindingCode, ReadOptions};
use crate::Feature;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, de};
use std::fmt;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default)]
    name: Option<String>,
    streams: Vec<StreamPart>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StreamPart {
    name: String,
    features: Vec<Feature>,
    #[serde(default)]
    time_s: Option<Vec<Number>>,
    #[serde(default)]
    values: Option<Vec<Cell>>,
    #[serde(default)]
    samples: Option<Vec<Vec<Number>>>,
}

/// A number; NaN for the placeholders of non-finite numbers.
#[derive(Clone, Copy)]
struct Number(f64);

enum Cell {
    One(Number),
    Row(Vec<Number>),
}

pub(super) fn parse(
    content: &str,
    file: &str,
    options: &ReadOptions,
    findings: &mut Findings,
) -> Option<(Option<String>, Vec<Table>)> {
    let document: Document = match serde_json::from_str(content) {
        Ok(document) => document,
        Err(error) => {
            let remedy = "give {name, streams: [{name, features: [{name, unit}], time_s: [..], values: [[..], ..]}]}; \
                          JSON has no NaN";
            let message = quote_long(&error.to_string());
            let finding = Finding::error(FindingCode::JsonSyntax, message, remedy).in_stream(file);
            findings.push(finding.at_row(error.line() as u64).in_column(format!("character {}", error.column())));
            return None;
        }
    };
    let tables = document.streams.into_iter().filter_map(|part| table(part, options, findings)).collect();
    Some((document.name, tables))
}

fn table(part: StreamPart, options: &ReadOptions, findings: &mut Findings) -> Option<Table> {
    let StreamPart { name, mut features, time_s, values, samples } = part;
    for feature in &mut features {
        if let Some(unit) = options.units.get(&feature.name) {
            feature.unit.clone_from(unit);
        }
    }
    let m = features.len();
    if m == 0 {
        let finding = Finding::error(FindingCode::TooSmall, "the stream has no feature", "add at least one feature");
        findings.push(finding.in_stream(name));
        return None;
    }
    let rows: Vec<(Number, Vec<Number>)> = match (time_s, values, samples) {
        (None, None, Some(samples)) => samples
            .into_iter()
            .zip(1_u64..)
            .filter_map(|(mut sample, row)| {
                if sample.len() != m + 1 {
                    findings.push(ragged(&name, row, sample.len(), m + 1));
                    return None;
                }
                let time = sample.remove(0);
                Some((time, sample))
            })
            .collect(),
        (Some(time_s), Some(values), None) => {
            let rows = rows_of(values, m, &name, findings)?;
            if rows.len() != time_s.len() {
                let message = format!("{} times for {} rows of values", time_s.len(), rows.len());
                let remedy = "give one time per row";
                findings.push(Finding::error(FindingCode::RaggedRow, message, remedy).in_stream(name));
                return None;
            }
            time_s.into_iter().zip(rows).collect()
        }
        _ => {
            let remedy = "give either `time_s` and `values` or `samples`";
            let message = "the stream needs either `time_s` and `values` or `samples`";
            findings.push(Finding::error(FindingCode::JsonSyntax, message, remedy).in_stream(name));
            return None;
        }
    };
    let mut table = Table::new(&name, features);
    for ((time, values), row) in rows.into_iter().zip(1_u64..) {
        if findings.full() {
            break;
        }
        push_row(&mut table, time, &values, row, options, findings);
    }
    Some(table)
}

fn push_row(
    table: &mut Table,
    time: Number,
    values: &[Number],
    row: u64,
    options: &ReadOptions,
    findings: &mut Findings,
) {
    let Table { stream, features, .. } = &*table;
    let mut check = |Number(value), column: &str| {
        let place = Place { stream, row, column };
        if !value.is_finite() {
            findings.push(place.finding(
                FindingCode::NonFinite,
                "not a finite number".to_owned(),
                "remove the sample or record it again; values are never filled in",
            ));
        } else if column != "time_s" {
            check_magnitude(value, &options.limits, place, findings);
        }
    };
    check(time, "time_s");
    for (value, feature) in values.iter().zip(features) {
        check(*value, &feature.name);
    }
    table.rows.push(row);
    table.time_s.push(time.0);
    table.values.extend(values.iter().map(|number| number.0));
}

/// Converts a flat array or an array of rows into rows of m values.
fn rows_of(values: Vec<Cell>, m: usize, stream: &str, findings: &mut Findings) -> Option<Vec<Vec<Number>>> {
    let mut flat: Vec<Number> = Vec::new();
    let mut rows = Vec::new();
    for (cell, row) in values.into_iter().zip(1_u64..) {
        match cell {
            Cell::Row(values) if values.len() == m => rows.push(values),
            Cell::Row(values) => findings.push(ragged(stream, row, values.len(), m)),
            Cell::One(number) => flat.push(number),
        }
    }
    if flat.is_empty() {
        return (!findings.refused()).then_some(rows);
    }
    if !rows.is_empty() || !flat.len().is_multiple_of(m) {
        let message = format!("{} numbers and {} rows do not form rows of {m} values", flat.len(), rows.len());
        let remedy = "give `values` as an array of rows";
        findings.push(Finding::error(FindingCode::RaggedRow, message, remedy).in_stream(stream));
        return None;
    }
    Some(flat.chunks_exact(m).map(<[Number]>::to_vec).collect())
}

fn ragged(stream: &str, row: u64, found: usize, expected: usize) -> Finding {
    let message = format!("{found} numbers instead of {expected}");
    Finding::error(FindingCode::RaggedRow, message, "complete or remove the sample").in_stream(stream).at_row(row)
}

fn quote_long(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(200).collect()
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number")
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Number, E> {
                Ok(Number(value))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
            fn visit_unit<E: Error>(self) -> Result<Number, E> {
                Ok(Number(f64::NAN))
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
                match text {
                    "NaN" | "Infinity" | "-Infinity" => Ok(Number(f64::NAN)),
                    _ => Err(E::invalid_type(de::Unexpected::Str("text"), &self)),
                }
            }
        }
        deserializer.deserialize_any(NumberVisitor)
    }
}

impl<'de> Deserialize<'de> for Cell {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CellVisitor;
        impl<'de> Visitor<'de> for CellVisitor {
            type Value = Cell;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a row of numbers")
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Cell, E> {
                Ok(Cell::One(Number(value)))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Cell, E> {
                Ok(Cell::One(Number(value as f64)))
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Cell, E> {
                Ok(Cell::One(Number(value as f64)))
            }
            fn visit_unit<E: Error>(self) -> Result<Cell, E> {
                Ok(Cell::One(Number(f64::NAN)))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Cell, A::Error> {
                let mut row = Vec::new();
                while let Some(number) = seq.next_element()? {
                    row.push(number);
                }
                Ok(Cell::Row(row))
            }
        }
        deserializer.deserialize_any(CellVisitor)
    }
}
