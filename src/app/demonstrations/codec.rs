//! Binary encoding of a demonstration for the store: a header in JSON, then all numbers as little-endian IEEE 754.
//!
//! Layout: `u32` length of the header, the header, then for each stream its times and its values row by row.

use crate::framework::Feature;
use crate::framework::demonstration::{Demonstration, Stream, StreamError};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Header {
    name: String,
    streams: Vec<StreamHeader>,
}

#[derive(Serialize, Deserialize)]
struct StreamHeader {
    name: String,
    features: Vec<Feature>,
    samples: usize,
}

/// The bytes are not an encoded demonstration.
#[derive(Debug, thiserror::Error)]
pub enum CodecError {
    /// The number of bytes differs from what the header says.
    #[error("{found} bytes instead of {expected}")]
    Length {
        /// Number of bytes found.
        found: usize,
        /// Number of bytes expected.
        expected: usize,
    },
    /// The header is not valid JSON of the expected form.
    #[error("the header cannot be read")]
    Header(#[from] serde_json::Error),
    /// The numbers do not form a stream.
    #[error(transparent)]
    Stream(#[from] StreamError),
}

/// Encodes a demonstration; [`decode`] restores the same bits.
///
/// # Errors
/// [`CodecError::Length`] if the header reaches 4 GiB.
pub fn encode(demonstration: &Demonstration) -> Result<Vec<u8>, CodecError> {
    let streams = demonstration.streams.iter();
    let header = serde_json::to_vec(&Header {
        name: demonstration.name.clone(),
        streams: streams
            .map(|stream| StreamHeader {
                name: stream.name().to_owned(),
                features: stream.features().to_vec(),
                samples: stream.len(),
            })
            .collect(),
    })?;
    let length = u32::try_from(header.len())
        .map_err(|_| CodecError::Length { found: header.len(), expected: u32::MAX as usize })?;
    let mut bytes = length.to_le_bytes().to_vec();
    bytes.extend_from_slice(&header);
    for stream in &demonstration.streams {
        for number in stream.time_s().iter().chain(stream.values()) {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
    }
    Ok(bytes)
}

/// Decodes the output of [`encode`].
///
/// # Errors
/// [`CodecError`] if the bytes are malformed.
pub fn decode(bytes: &[u8]) -> Result<Demonstration, CodecError> {
    let short = |expected| CodecError::Length { found: bytes.len(), expected };
    let (length, rest) = bytes.split_first_chunk::<4>().ok_or_else(|| short(4))?;
    let length = u32::from_le_bytes(*length) as usize;
    if rest.len() < length {
        return Err(short(4 + length));
    }
    let (header, numbers) = rest.split_at(length);
    let header: Header = serde_json::from_slice(header)?;
    let counts = header.streams.iter().map(|s| s.samples.saturating_mul(s.features.len() + 1));
    let expected = counts.fold(0_usize, usize::saturating_add).saturating_mul(8);
    if numbers.len() != expected {
        return Err(short(expected.saturating_add(4 + length)));
    }
    let (chunks, _) = numbers.as_chunks::<8>();
    let mut numbers = chunks.iter().map(|chunk| f64::from_le_bytes(*chunk));
    let mut streams = Vec::with_capacity(header.streams.len());
    for stream in header.streams {
        let time_s: Vec<f64> = numbers.by_ref().take(stream.samples).collect();
        let values: Vec<f64> = numbers.by_ref().take(stream.samples * stream.features.len()).collect();
        streams.push(Stream::new(stream.name, stream.features, time_s, values)?);
    }
    Ok(Demonstration { name: header.name, streams })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_streams() -> Demonstration {
        let x = Stream::new("a", vec![Feature::new("x", "m")], vec![0.0, 0.1], vec![1.5, -0.0]).unwrap();
        let yz = Stream::new(
            "b",
            vec![Feature::new("y", "m"), Feature::new("z", "")],
            vec![5.0, 5.1, 5.2],
            vec![0.1, 0.2, 0.3, 1e-300, f64::MIN_POSITIVE / 2.0, 3.0],
        )
        .unwrap();
        Demonstration { name: "two".to_owned(), streams: vec![x, yz] }
    }

    #[test]
    fn decoding_gives_back_the_same_bits() {
        let demonstration = two_streams();
        let bytes = encode(&demonstration).unwrap();
        let decoded = decode(&bytes).unwrap();
        assert_eq!(decoded, demonstration);
        assert!(decoded.streams[0].values()[1].is_sign_negative());
    }

    #[test]
    fn no_shortened_or_lengthened_bytes_are_taken() {
        let mut bytes = encode(&two_streams()).unwrap();
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err(), "{length} bytes");
        }
        bytes.push(0);
        assert!(decode(&bytes).is_err());
    }
}
