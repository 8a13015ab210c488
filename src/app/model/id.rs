//! Typed resource ids: a prefix for the kind, then the 32 hexadecimal digits of a version 7 UUID.
//!
//! Ids are compared as text. Because they are version 7 UUIDs, later ids sort after earlier ones, which keyset paging
//! relies on.

use serde::{Deserialize, Serialize};
use std::fmt;
use uuid::Uuid;

/// The text is not an id of the requested kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is not {kind} id: expected `{prefix}_` and 32 hexadecimal digits")]
pub struct IdError {
    text: String,
    kind: &'static str,
    prefix: &'static str,
}

fn is_id(text: &str, prefix: &str) -> bool {
    text.strip_prefix(prefix)
        .and_then(|rest| rest.strip_prefix('_'))
        .is_some_and(|digits| digits.len() == 32 && digits.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f')))
}

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident = $prefix:literal, $kind:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(try_from = "String", into = "String")]
        pub struct $name(String);

        impl $name {
            /// The id for `uuid`.
            #[must_use]
            pub fn from_uuid(uuid: Uuid) -> Self {
                Self(format!(concat!($prefix, "_{}"), uuid.simple()))
            }

            /// Text form of the id.
            #[must_use]
            pub fn as_str(&self) -> &str {
                &self.0
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0)
            }
        }

        impl std::str::FromStr for $name {
            type Err = IdError;
            fn from_str(text: &str) -> Result<Self, IdError> {
                Self::try_from(text.to_owned())
            }
        }

        impl TryFrom<String> for $name {
            type Error = IdError;
            fn try_from(text: String) -> Result<Self, IdError> {
                if is_id(&text, $prefix) { Ok(Self(text)) } else { Err(IdError { text, kind: $kind, prefix: $prefix }) }
            }
        }

        impl From<$name> for String {
            fn from(id: $name) -> Self {
                id.0
            }
        }

        impl utoipa::PartialSchema for $name {
            fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::schema::Schema> {
                utoipa::openapi::ObjectBuilder::new()
                    .schema_type(utoipa::openapi::schema::Type::String)
                    .pattern(Some(concat!("^", $prefix, "_[0-9a-f]{32}$")))
                    .description(Some(concat!("Id of ", $kind, ".")))
                    .build()
                    .into()
            }
        }

        impl utoipa::ToSchema for $name {}
    )*};
}

ids! {
    /// Identifies a demonstration.
    DemonstrationId = "dem", "a demonstration";
    /// Identifies one immutable version of an action.
    ActionId = "act", "an action";
    /// Identifies one immutable version of a robot.
    RobotId = "rob", "a robot";
    /// Identifies a world.
    WorldId = "wld", "a world";
    /// Identifies a job.
    JobId = "job", "a job";
    /// Identifies a run: one repetition of an execution job.
    RunId = "run", "a run";
    /// Identifies an experiment.
    ExperimentId = "exp", "an experiment";
    /// Identifies a trajectory.
    TrajectoryId = "trj", "a trajectory";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_its_prefix_and_32_lowercase_hexadecimal_digits() {
        let id = JobId::from_uuid(Uuid::from_u128(0xabc));
        assert_eq!(id.as_str(), "job_00000000000000000000000000000abc");
        assert_eq!(id.as_str().parse::<JobId>(), Ok(id.clone()));
        for wrong in ["", "job", "job_", "run_00000000000000000000000000000abc", "job_0000000000000000000000000000ABC0"]
        {
            assert!(wrong.parse::<JobId>().is_err(), "{wrong:?}");
        }
        assert_eq!(serde_json::to_string(&id).unwrap(), "\"job_00000000000000000000000000000abc\"");
        assert!(serde_json::from_str::<RunId>("\"job_00000000000000000000000000000abc\"").is_err());
    }
}
