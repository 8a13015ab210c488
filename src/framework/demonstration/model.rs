//! The demonstration and its streams, valid by construction.

use crate::Feature;
use serde::{Deserialize, Serialize};

/// One recorded stream: k samples of m features with strictly increasing time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "RawStream", into = "RawStream")]
pub struct Stream {
    name: String,
    features: Vec<Feature>,
    time_s: Vec<f64>,
    values: Vec<f64>,
}

/// Reasons why values do not form a stream.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StreamError {
    /// There is no feature, or there are fewer than two samples.
    #[error("stream {stream:?} has {samples} samples of {features} features: give at least 2 samples of 1 feature")]
    TooSmall {
        /// Stream name.
        stream: String,
        /// Number of samples found.
        samples: usize,
        /// Number of features found.
        features: usize,
    },
    /// The value matrix is not samples x features.
    #[error("stream {stream:?} has {values} values for {samples} samples of {features} features")]
    Shape {
        /// Stream name.
        stream: String,
        /// Number of values found.
        values: usize,
        /// Number of samples.
        samples: usize,
        /// Number of features.
        features: usize,
    },
    /// A time or value is NaN or infinite.
    #[error("stream {stream:?}, sample {sample}: {column} is {value}, not a finite number")]
    NonFinite {
        /// Stream name.
        stream: String,
        /// Sample index from 0.
        sample: usize,
        /// Column name.
        column: String,
        /// The non-finite value.
        value: f64,
    },
    /// Time does not strictly increase.
    #[error("stream {stream:?}, sample {sample}: time {time_s} s is not after {previous_s} s")]
    NonIncreasing {
        /// Stream name.
        stream: String,
        /// Sample index from 0.
        sample: usize,
        /// Time of that sample, seconds.
        time_s: f64,
        /// Time of the previous sample, seconds.
        previous_s: f64,
    },
}

impl Stream {
    /// A stream of `time_s.len()` samples; `values` is row-major, samples x features.
    ///
    /// # Errors
    /// [`StreamError`] names the first sample that breaks a rule.
    pub fn new(
        name: impl Into<String>,
        features: Vec<Feature>,
        time_s: Vec<f64>,
        values: Vec<f64>,
    ) -> Result<Self, StreamError> {
        let name = name.into();
        if features.is_empty() || time_s.len() < 2 {
            return Err(StreamError::TooSmall { stream: name, samples: time_s.len(), features: features.len() });
        }
        if values.len() != time_s.len() * features.len() {
            return Err(StreamError::Shape {
                stream: name,
                values: values.len(),
                samples: time_s.len(),
                features: features.len(),
            });
        }
        let mut previous_s = f64::NEG_INFINITY;
        for (sample, &t) in time_s.iter().enumerate() {
            let non_finite = |column: &str, value| StreamError::NonFinite {
                stream: name.clone(),
                sample,
                column: column.to_owned(),
                value,
            };
            if !t.is_finite() {
                return Err(non_finite("time", t));
            }
            let row = &values[sample * features.len()..(sample + 1) * features.len()];
            if let Some((feature, &value)) = features.iter().zip(row).find(|(_, v)| !v.is_finite()) {
                return Err(non_finite(&feature.name, value));
            }
            if t <= previous_s {
                return Err(StreamError::NonIncreasing { stream: name, sample, time_s: t, previous_s });
            }
            previous_s = t;
        }
        Ok(Self { name, features, time_s, values })
    }

    /// Stream name, for example `wrist-force`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The m features, in column order.
    #[must_use]
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// Sample times in seconds, strictly increasing; the origin is the recorder's.
    #[must_use]
    pub fn time_s(&self) -> &[f64] {
        &self.time_s
    }

    /// All values, row-major, samples x features.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The m values of one sample.
    #[must_use]
    pub fn row(&self, sample: usize) -> &[f64] {
        let m = self.features.len();
        &self.values[sample * m..(sample + 1) * m]
    }

    /// Number of samples k (at least 2).
    #[must_use]
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Never true: a stream holds at least two samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// Time from first to last sample, seconds.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.time_s[self.time_s.len() - 1] - self.time_s[0]
    }

    /// Shifts time so that the first sample is at 0 s.
    ///
    /// # Errors
    /// [`StreamError::NonIncreasing`] if rounding makes two times equal.
    pub fn starting_at_zero(self) -> Result<Self, StreamError> {
        let start_s = self.time_s[0];
        let time_s = self.time_s.iter().map(|t| t - start_s).collect();
        Self::new(self.name, self.features, time_s, self.values)
    }
}

/// Serialized form of [`Stream`]; `values` is row-major, samples x features.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStream {
    name: String,
    features: Vec<Feature>,
    time_s: Vec<f64>,
    values: Vec<f64>,
}

impl TryFrom<RawStream> for Stream {
    type Error = StreamError;
    fn try_from(raw: RawStream) -> Result<Self, StreamError> {
        Self::new(raw.name, raw.features, raw.time_s, raw.values)
    }
}

impl From<Stream> for RawStream {
    fn from(s: Stream) -> Self {
        Self { name: s.name, features: s.features, time_s: s.time_s, values: s.values }
    }
}

/// One performance of an action: one or more streams recorded together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Demonstration {
    /// Display name.
    pub name: String,
    /// At least one stream; stream names and the names of all features are unique.
    pub streams: Vec<Stream>,
}

impl Demonstration {
    /// Iterates over the features of all streams, in order.
    pub fn features(&self) -> impl Iterator<Item = &Feature> {
        self.streams.iter().flat_map(Stream::features)
    }

    /// First and last time over all streams, seconds; `None` without streams.
    #[must_use]
    pub fn span_s(&self) -> Option<(f64, f64)> {
        let start = self.streams.iter().map(|s| s.time_s()[0]).min_by(f64::total_cmp)?;
        let end = self.streams.iter().map(|s| s.time_s()[s.len() - 1]).max_by(f64::total_cmp)?;
        Some((start, end))
    }

    /// Time from the first to the last sample over all streams, seconds.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.span_s().map_or(0.0, |(start, end)| end - start)
    }
}
