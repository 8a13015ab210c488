//! Requests for experiments.

use super::enumeration::Enumeration as _;
use super::json;
use super::{all, finite, required, text};
use crate::app::model::{AppError, ErrorKind, EveryTable, ExperimentRequest, PaperTable};
use crate::framework::experiment::{CellSpec, InvalidRule, MatrixSpec, Quantity, Variant};
use crate::grpc::proto;
use proto::PaperTable as Table;
use proto::invalid_rule::Rule;

/// An experiment as it is asked for.
///
/// # Errors
/// `Invalid` at the JSON pointer that the field has over HTTP.
pub fn request(spec: proto::ExperimentSpec) -> Result<ExperimentRequest, AppError> {
    let proto::ExperimentSpec { name, seed, repetitions, paper_table, cells, matrix } = spec;
    let cell = |(index, message)| cell(&format!("/cells/{index}"), message);
    Ok(ExperimentRequest {
        name: name.and_then(text),
        seed,
        repetitions: if repetitions == 0 { 1 } else { repetitions },
        paper_table: table(paper_table)?,
        cells: cells.into_iter().enumerate().map(cell).collect::<Result<_, _>>()?,
        matrix: matrix.map(self::matrix).transpose()?,
    })
}

/// The quantity to compare.
///
/// # Errors
/// `Malformed` for a number without a quantity, and if it is unspecified.
pub fn quantity(number: i32) -> Result<Quantity, AppError> {
    let malformed = |message: &str| AppError::new(ErrorKind::Malformed, "invalid_query", message);
    let found = Quantity::read("/quantity", number).map_err(|error| malformed(&error.message))?;
    found.ok_or_else(|| malformed("quantity is unspecified: give evaluations, discrepancy or painted"))
}

fn table(number: i32) -> Result<Option<PaperTable>, AppError> {
    let numbered = |number| Ok(Some(PaperTable::Number(number)));
    match Table::try_from(number) {
        Ok(Table::Unspecified) => Ok(None),
        Ok(Table::PaperTable1) => numbered(1),
        Ok(Table::PaperTable2) => numbered(2),
        Ok(Table::PaperTable3) => numbered(3),
        Ok(Table::PaperTable4) => numbered(4),
        Ok(Table::PaperTable5) => numbered(5),
        Ok(Table::PaperTable6) => numbered(6),
        Ok(Table::All) => Ok(Some(PaperTable::Every(EveryTable::All))),
        Err(_) => Err(AppError::field("/paper_table", "invalid_value", format!("{number} is not a table"))),
    }
}

fn cell(at: &str, message: proto::CellSpec) -> Result<CellSpec, AppError> {
    let proto::CellSpec { table, action, setting, preset, method, overrides, invalid } = message;
    Ok(CellSpec {
        table,
        action,
        setting,
        preset,
        method,
        overrides: json::read(&format!("{at}/overrides"), overrides)?,
        invalid: rule(&format!("{at}/invalid"), invalid)?,
    })
}

fn matrix(message: proto::MatrixSpec) -> Result<MatrixSpec, AppError> {
    let proto::MatrixSpec { presets, methods, settings, invalid } = message;
    Ok(MatrixSpec {
        presets,
        methods: variants("/matrix/methods", methods)?,
        settings: variants("/matrix/settings", settings)?,
        invalid: rule("/matrix/invalid", invalid)?,
    })
}

fn variants(at: &str, messages: Vec<proto::Variant>) -> Result<Vec<Variant>, AppError> {
    let variant = |(index, proto::Variant { name, method, overrides })| {
        Ok(Variant { name, method, overrides: json::read(&format!("{at}/{index}/overrides"), overrides)? })
    };
    messages.into_iter().enumerate().map(variant).collect()
}

fn rule(at: &str, message: Option<proto::InvalidRule>) -> Result<InvalidRule, AppError> {
    let Some(proto::InvalidRule { rule }) = message else { return Ok(InvalidRule::default()) };
    match required(at, rule)? {
        Rule::Exclude(proto::Exclude {}) => Ok(InvalidRule::Exclude),
        Rule::CountAs(value) => Ok(InvalidRule::CountAs(finite(&format!("{at}/count_as"), value)?)),
    }
}

impl From<ExperimentRequest> for proto::ExperimentSpec {
    fn from(request: ExperimentRequest) -> Self {
        let ExperimentRequest { name, seed, repetitions, paper_table, cells, matrix } = request;
        Self {
            name,
            seed,
            repetitions,
            paper_table: paper_table.map_or(Table::Unspecified, Into::into) as i32,
            cells: all(cells),
            matrix: matrix.map(Into::into),
        }
    }
}

impl From<PaperTable> for Table {
    /// Unspecified for a number without a table, which the service rejects and therefore never stores.
    fn from(table: PaperTable) -> Self {
        match table {
            PaperTable::Number(1) => Self::PaperTable1,
            PaperTable::Number(2) => Self::PaperTable2,
            PaperTable::Number(3) => Self::PaperTable3,
            PaperTable::Number(4) => Self::PaperTable4,
            PaperTable::Number(5) => Self::PaperTable5,
            PaperTable::Number(6) => Self::PaperTable6,
            PaperTable::Number(_) => Self::Unspecified,
            PaperTable::Every(EveryTable::All) => Self::All,
        }
    }
}

impl From<CellSpec> for proto::CellSpec {
    fn from(cell: CellSpec) -> Self {
        let CellSpec { table, action, setting, preset, method, overrides, invalid } = cell;
        let overrides = json::write(overrides);
        Self { table, action, setting, preset, method, overrides, invalid: Some(invalid.into()) }
    }
}

impl From<MatrixSpec> for proto::MatrixSpec {
    fn from(matrix: MatrixSpec) -> Self {
        let MatrixSpec { presets, methods, settings, invalid } = matrix;
        Self { presets, methods: all(methods), settings: all(settings), invalid: Some(invalid.into()) }
    }
}

impl From<Variant> for proto::Variant {
    fn from(variant: Variant) -> Self {
        let Variant { name, method, overrides } = variant;
        Self { name, method, overrides: json::write(overrides) }
    }
}

impl From<InvalidRule> for proto::InvalidRule {
    fn from(rule: InvalidRule) -> Self {
        let rule = match rule {
            InvalidRule::Exclude => Rule::Exclude(proto::Exclude {}),
            InvalidRule::CountAs(value) => Rule::CountAs(value),
        };
        Self { rule: Some(rule) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn a_request_survives_the_wire() {
        let overrides = json!({"execution": {"method": {"name": "pso"}, "tolerance": null}});
        let cell = json!({"table": "2", "action": "wax", "setting": "fast", "preset": "paper-wax", "method": "sst",
            "overrides": overrides, "invalid": {"count_as": 5.5}});
        let variant = json!({"name": "a", "method": "pso", "overrides": overrides});
        let matrix = json!({"presets": ["paper-wax"], "methods": [variant], "settings": [variant, {"name": "b"}],
            "invalid": "exclude"});
        let full = json!({"name": "night", "seed": 7, "repetitions": 3, "cells": [cell], "matrix": matrix});
        let tables = [json!(1), json!(2), json!(3), json!(4), json!(5), json!(6), json!("all")];
        let tables = tables.map(|table| json!({"paper_table": table}));
        for json in tables.iter().chain([&full]) {
            let before: ExperimentRequest = serde_json::from_value(json.clone()).unwrap();
            assert_eq!(request(before.clone().into()).unwrap(), before, "{json}");
        }
    }

    #[test]
    fn an_empty_message_is_an_empty_object() {
        let json: ExperimentRequest = serde_json::from_value(json!({})).unwrap();
        assert_eq!(request(proto::ExperimentSpec::default()).unwrap(), json);
        let json: CellSpec = serde_json::from_value(json!({"action": "a", "setting": "b", "preset": "c"})).unwrap();
        let text = str::to_owned;
        let message =
            proto::CellSpec { action: text("a"), setting: text("b"), preset: text("c"), ..Default::default() };
        assert_eq!(cell("", message).unwrap(), json);
        assert_eq!(json.overrides, Value::Null);
    }

    #[test]
    fn a_wrong_field_is_named_by_its_pointer() {
        let pointer = |spec| request(spec).unwrap_err().details[0].pointer.clone();
        assert_eq!(quantity(3).unwrap(), Quantity::Painted);
        assert!([0, 4].into_iter().all(|number| quantity(number).unwrap_err().kind == ErrorKind::Malformed));
        assert_eq!(pointer(proto::ExperimentSpec { paper_table: 8, ..Default::default() }), "/paper_table");
        let invalid = Some(proto::InvalidRule { rule: Some(Rule::CountAs(f64::NAN)) });
        let matrix = Some(proto::MatrixSpec { invalid, ..Default::default() });
        assert_eq!(pointer(proto::ExperimentSpec { matrix, ..Default::default() }), "/matrix/invalid/count_as");
        let cell = proto::CellSpec { invalid: Some(proto::InvalidRule::default()), ..Default::default() };
        assert_eq!(pointer(proto::ExperimentSpec { cells: vec![cell], ..Default::default() }), "/cells/0/invalid");
    }
}
