//! Stored documents: the JSON that every engine keeps in its columns, independent of the API.
//!
//! # Invariants
//! - A document names its version (`"v": 1`). One without `v` was written before versions were kept: it is version 0.
//! - A row is never rewritten to a new version: it is upgraded, step by step, whenever it is read. An upgrade works on
//!   the JSON, so the types of old versions need not be kept.
//! - A document of a later version is refused: reading half of it would lose the rest.
//! - To change the shape of a document, add an upgrade to its `UPGRADES` and save a document of the new version in
//!   `tests/fixtures/documents/`; never change an upgrade or a saved document that was shared.
//! - A view or a request is never stored as it is: conversions destructure both sides, so that a field added to one does
//!   not compile until the other has it. Small values (ids, times, features, a named table) and the specifications of the
//!   core are stored as they are and pinned by the saved documents: a changed form fails a test.
//! - A number that is not finite is stored as null and read back as infinity: JSON has no such number.

mod action;
mod demonstration;
mod event;
mod experiment;
mod job;
mod progress;
mod robot;
mod run;
mod tally;
#[cfg(test)]
mod tests;
mod trajectory;
mod trials;
mod world;

pub(super) use action::{Action, GoalMatrix};
pub(super) use demonstration::{Demonstration, Report};
pub(super) use event::Event;
pub(super) use experiment::{Experiment, Plan, Row};
pub(super) use job::{Failure, Request, Work};
pub(super) use progress::Progress;
pub(super) use robot::Robot;
pub(super) use run::{Convergence, Run, RunGoals};
pub(super) use trajectory::Trajectory;
pub(super) use trials::Trials;
pub(super) use world::World;

use crate::app::ports::StoreError;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// A step from one version of a document to the next.
type Upgrade = fn(Value) -> Value;

/// A stored document in its present version.
pub(super) trait Document: Serialize + DeserializeOwned {
    /// Content, as the rest of the service knows it.
    type Content: From<Self>;

    /// Name in errors.
    const NAME: &'static str;

    /// Step `n` turns version `n` into version `n + 1`; their number is the present version.
    const UPGRADES: &'static [Upgrade];
}

/// A step that changes the version only.
fn unchanged(document: Value) -> Value {
    document
}

/// A document with its version, as it is written.
#[derive(Serialize)]
struct Versioned<'a, D> {
    v: usize,
    #[serde(flatten)]
    document: &'a D,
}

/// The JSON that keeps `content`.
///
/// # Errors
/// `Corrupt` if it has no JSON.
pub(super) fn write<D: Document>(content: impl Into<D>) -> Result<String, StoreError> {
    let versioned = Versioned { v: D::UPGRADES.len(), document: &content.into() };
    serde_json::to_string(&versioned)
        .map_err(|error| StoreError::Corrupt { what: format!("{} to be stored", D::NAME), cause: error.to_string() })
}

/// The content of a stored document of any version; `of` names the resource it belongs to, for errors.
///
/// # Errors
/// `Corrupt` if it is not such a document, or of a later version than this program knows.
pub(super) fn read<D: Document>(of: &str, text: &str) -> Result<D::Content, StoreError> {
    let corrupt = |cause: String| StoreError::Corrupt { what: format!("{} of {of}", D::NAME), cause };
    let mut document: Value = serde_json::from_str(text).map_err(|error| corrupt(error.to_string()))?;
    let version = take_version(&mut document).map_err(|found| corrupt(format!("its version is {found}")))?;
    let Some(missing) = D::UPGRADES.get(version..) else {
        let known = D::UPGRADES.len();
        return Err(corrupt(format!("it has version {version}, this program knows {known}: start the later program")));
    };
    let document = missing.iter().fold(document, |older, upgrade| upgrade(older));
    serde_json::from_value::<D>(document).map(D::Content::from).map_err(|error| corrupt(error.to_string()))
}

fn take_version(document: &mut Value) -> Result<usize, Value> {
    let Some(version) = document.as_object_mut().and_then(|object| object.remove("v")) else { return Ok(0) };
    version.as_u64().and_then(|version| usize::try_from(version).ok()).ok_or(version)
}

/// Gives `object` a field it lacks.
fn complete(object: &mut Value, field: &str, value: impl Into<Value>) {
    if let Some(object) = object.as_object_mut() {
        object.entry(field).or_insert_with(|| value.into());
    }
}

/// A document with the fields of its content; those after `each` are lists of documents of their own, those after
/// `with` single ones. A field that is added to one of the two does not compile until the other has it.
macro_rules! document {
    (
        $(#[$doc:meta])* $name:ident keeps $content:ident {
            $($(#[$attribute:meta])* $field:ident: $type:ty,)*
        }
        $(each { $($list:ident: $element:ty,)* })?
        $(with { $($(#[$part_attribute:meta])* $part:ident: $document:ty,)* })?
    ) => {
        $(#[$doc])*
        #[derive(Debug, serde::Serialize, serde::Deserialize)]
        pub(in crate::store) struct $name {
            $($(#[$attribute])* $field: $type,)*
            $($($list: Vec<$element>,)*)?
            $($($(#[$part_attribute])* $part: $document,)*)?
        }

        impl From<$content> for $name {
            fn from(content: $content) -> Self {
                let $content { $($field,)* $($($list,)*)? $($($part,)*)? } = content;
                Self {
                    $($field,)*
                    $($($list: $list.into_iter().map(Into::into).collect(),)*)?
                    $($($part: $part.into(),)*)?
                }
            }
        }

        impl From<$name> for $content {
            fn from(document: $name) -> Self {
                let $name { $($field,)* $($($list,)*)? $($($part,)*)? } = document;
                Self {
                    $($field,)*
                    $($($list: $list.into_iter().map(Into::into).collect(),)*)?
                    $($($part: $part.into(),)*)?
                }
            }
        }
    };
}

/// Declares the content, the name and the upgrades of a [`Document`].
macro_rules! versions {
    ($name:ident keeps $content:ty, $called:literal, [$($upgrade:expr),* $(,)?]) => {
        impl $crate::store::documents::Document for $name {
            type Content = $content;
            const NAME: &'static str = $called;
            const UPGRADES: &'static [$crate::store::documents::Upgrade] = &[$($upgrade),*];
        }
    };
}

use {document, versions};
