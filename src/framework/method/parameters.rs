//! Parameters of methods, each declared once: name, type, default, range, unit and a sentence.
//!
//! [`parameters!`] turns one declaration into the struct that users write, its defaults, the check of its ranges and the
//! rows of the catalogue, so that these cannot disagree.

use crate::range::{OutOfRange, Range};
use serde::Serialize;
use serde_json::Value;

/// A parameter as the catalogue describes it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// Name, as written in presets and requests.
    pub name: &'static str,
    /// One sentence for the person who sets it.
    pub purpose: String,
    /// Unit, `null` for a plain number, a choice or a flag.
    pub unit: Option<&'static str>,
    /// Whether it may be `null`.
    pub optional: bool,
    /// Value of a parameter that is left out.
    pub default: Value,
    /// Allowed values.
    pub values: Values,
}

/// The values a parameter may take.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Values {
    /// A whole number.
    Integer {
        /// Its limits.
        range: Range,
    },
    /// A finite number.
    Number {
        /// Its limits.
        range: Range,
    },
    /// `true` or `false`.
    Flag,
    /// One of a few names.
    Choice {
        /// The names, in the order of a menu.
        options: Vec<Value>,
    },
    /// An object of further parameters.
    Group {
        /// The parameters inside.
        parameters: Vec<Parameter>,
    },
}

/// A set of parameters; implemented by the macro `parameters!`.
pub trait Parameters {
    /// All of them, in the order of their declaration.
    fn parameters() -> Vec<Parameter>
    where
        Self: Sized;

    /// # Errors
    /// The first value that is out of its range.
    fn check_ranges(&self) -> Result<(), OutOfRange>;
}

/// A type that a parameter may have.
pub trait ParameterValue: Serialize {
    /// Whether a value may be absent.
    const OPTIONAL: bool = false;

    /// The values allowed within `range`.
    fn values(range: Range) -> Values;

    /// # Errors
    /// [`OutOfRange`] for a number outside `range`.
    fn check(&self, name: &'static str, unit: Option<&'static str>, range: &Range) -> Result<(), OutOfRange>;
}

/// A parameter that is one of a few named values.
pub trait Choice: Serialize + Sized + 'static {
    /// All of them, in the order of a menu.
    const ALL: &'static [Self];
}

impl ParameterValue for u32 {
    fn values(range: Range) -> Values {
        Values::Integer { range: range.or(0..=Self::MAX) }
    }
    fn check(&self, name: &'static str, unit: Option<&'static str>, range: &Range) -> Result<(), OutOfRange> {
        range.check(name, unit, f64::from(*self))
    }
}

impl ParameterValue for f64 {
    fn values(range: Range) -> Values {
        Values::Number { range }
    }
    fn check(&self, name: &'static str, unit: Option<&'static str>, range: &Range) -> Result<(), OutOfRange> {
        range.check(name, unit, *self)
    }
}

impl ParameterValue for bool {
    fn values(_: Range) -> Values {
        Values::Flag
    }
    fn check(&self, _: &'static str, _: Option<&'static str>, _: &Range) -> Result<(), OutOfRange> {
        Ok(())
    }
}

impl<T: ParameterValue> ParameterValue for Option<T> {
    const OPTIONAL: bool = true;

    fn values(range: Range) -> Values {
        T::values(range)
    }
    fn check(&self, name: &'static str, unit: Option<&'static str>, range: &Range) -> Result<(), OutOfRange> {
        self.as_ref().map_or(Ok(()), |value| value.check(name, unit, range))
    }
}

impl<T: Choice> ParameterValue for T {
    fn values(_: Range) -> Values {
        Values::Choice { options: T::ALL.iter().map(json).collect() }
    }
    fn check(&self, _: &'static str, _: Option<&'static str>, _: &Range) -> Result<(), OutOfRange> {
        Ok(())
    }
}

impl Parameter {
    /// The row of one parameter; `sentences` are the lines of its doc comment.
    pub(super) fn of<T: ParameterValue>(
        name: &'static str,
        sentences: &[&str],
        unit: Option<&'static str>,
        range: Range,
        default: &T,
    ) -> Self {
        Self {
            name,
            purpose: sentence(sentences),
            unit,
            optional: T::OPTIONAL,
            default: json(default),
            values: T::values(range),
        }
    }
}

/// The text of a doc comment, of which `lines` are the lines.
pub(super) fn sentence(lines: &[&str]) -> String {
    let lines: Vec<&str> = lines.iter().map(|line| line.trim()).collect();
    lines.join(" ")
}

/// A value as JSON; every parameter has one.
fn json<T: Serialize>(value: &T) -> Value {
    serde_json::to_value(value).unwrap_or_default()
}

/// Declares a struct of parameters:
///
/// ```ignore
/// parameters! {
///     /// Contents of the struct.
///     pub struct Spec {
///         /// One sentence.
///         pub radius_m: f64 = 0.1, in 0.0..=1.0, unit "m";
///     }
/// }
/// ```
///
/// A range may be `3..=100`, `0.0..` or [`above`](crate::range::above)`(0.0)`; without one, any finite number does.
macro_rules! parameters {
    (
        $(#[doc = $about:literal])+
        pub struct $spec:ident {
            $(
                $(#[doc = $sentence:literal])+
                $(#[serde($($serde:tt)*)])?
                pub $name:ident: $type:ty = $default:expr $(, in $range:expr)? $(, unit $unit:literal)?;
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
        #[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
        #[serde(deny_unknown_fields, default)]
        pub struct $spec {
            $(
                $(#[doc = $sentence])+
                $(#[serde($($serde)*)])?
                pub $name: $type,
            )+
        }

        impl Default for $spec {
            fn default() -> Self {
                Self { $($name: $default),+ }
            }
        }

        impl $crate::method::parameters::Parameters for $spec {
            fn parameters() -> Vec<$crate::method::parameters::Parameter> {
                let default = Self::default();
                vec![$(
                    $crate::method::parameters::Parameter::of(
                        stringify!($name),
                        &[$($sentence),+],
                        $crate::method::parameters::unit!($($unit)?),
                        $crate::method::parameters::range!($($range)?),
                        &default.$name,
                    )
                ),+]
            }

            fn check_ranges(&self) -> Result<(), $crate::range::OutOfRange> {
                use $crate::method::parameters::ParameterValue as _;
                $(
                    self.$name.check(
                        stringify!($name),
                        $crate::method::parameters::unit!($($unit)?),
                        &$crate::method::parameters::range!($($range)?),
                    )?;
                )+
                Ok(())
            }
        }

        impl $crate::method::parameters::ParameterValue for $spec {
            fn values(_: $crate::range::Range) -> $crate::method::parameters::Values {
                let parameters = <Self as $crate::method::parameters::Parameters>::parameters();
                $crate::method::parameters::Values::Group { parameters }
            }

            fn check(
                &self,
                _: &'static str,
                _: Option<&'static str>,
                _: &$crate::range::Range,
            ) -> Result<(), $crate::range::OutOfRange> {
                $crate::method::parameters::Parameters::check_ranges(self)
            }
        }
    };
}

/// The unit of a declaration, if it has one.
macro_rules! unit {
    () => {
        None
    };
    ($unit:literal) => {
        Some($unit)
    };
}

/// The range of a declaration; all finite numbers if it has none.
macro_rules! range {
    () => {
        $crate::range::Range::default()
    };
    ($range:expr) => {
        $crate::range::Range::from($range)
    };
}

pub(super) use {parameters, range, unit};
