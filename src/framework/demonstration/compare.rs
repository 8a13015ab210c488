//! Checks between streams of one demonstration and between demonstrations: clock offsets, durations, duplicates.

use super::table::Findings;
use super::{ClockPolicy, Finding, FindingCode, Stream};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Largest accepted difference between the starts of streams recorded together, seconds.
const START_TOLERANCE_S: f64 = 1.0;
/// Largest accepted difference between their durations, as a share of the longest.
const DURATION_TOLERANCE: f64 = 0.05;
/// Differences of at most this many seconds are always accepted.
const DURATION_TOLERANCE_S: f64 = 0.5;

/// Reports clock offsets, differing durations and duplicate streams.
pub(super) fn check_streams(streams: &[Stream], policy: ClockPolicy, findings: &mut Findings) {
    if streams.len() < 2 {
        return;
    }
    report_clock_offsets(streams, policy, findings);
    report_durations(streams, findings);
    let hashes: Vec<(String, String)> = streams.iter().map(|s| (s.name().to_owned(), content_hash(s))).collect();
    for finding in duplicate_content(&hashes) {
        findings.push(finding);
    }
}

/// Compares every stream with the one whose start is the median, so that a single wrong clock is the one reported.
fn report_clock_offsets(streams: &[Stream], policy: ClockPolicy, findings: &mut Findings) {
    let mut by_start: Vec<&Stream> = streams.iter().collect();
    by_start.sort_by(|a, b| a.time_s()[0].total_cmp(&b.time_s()[0]));
    let reference = by_start[by_start.len() / 2];
    for stream in streams {
        let offset_s = stream.time_s()[0] - reference.time_s()[0];
        if offset_s.abs() <= START_TOLERANCE_S {
            continue;
        }
        let direction = if offset_s < 0.0 { "behind" } else { "ahead of" };
        let (done, remedy) = match policy {
            ClockPolicy::AsRecorded => ("", "set `clock_policy` to `align_by_start` if they were recorded together"),
            ClockPolicy::AlignByStart => (
                "; both now start at 0 s",
                "none needed; set `clock_policy` to `as_recorded` if the streams really start at different times",
            ),
        };
        let message = format!("the clock is {:.3} s {direction} that of {:?}{done}", offset_s.abs(), reference.name());
        findings.push(
            Finding::warning(FindingCode::ClockOffset, message, remedy)
                .in_stream(stream.name())
                .at_time(stream.time_s()[0]),
        );
    }
}

fn report_durations(streams: &[Stream], findings: &mut Findings) {
    let Some(longest) = streams.iter().max_by(|a, b| a.duration_s().total_cmp(&b.duration_s())) else { return };
    let allowed_s = DURATION_TOLERANCE_S.max(DURATION_TOLERANCE * longest.duration_s());
    for stream in streams.iter().filter(|s| longest.duration_s() - s.duration_s() > allowed_s) {
        let message =
            format!("lasts {:.3} s, but {:?} lasts {:.3} s", stream.duration_s(), longest.name(), longest.duration_s());
        let remedy = "check that the recording is complete and belongs to this demonstration";
        findings.push(Finding::warning(FindingCode::DurationMismatch, message, remedy).in_stream(stream.name()));
    }
}

/// SHA-256 over the bits of times and values, as hex; independent of format and names, so equal for copies.
#[must_use]
pub fn content_hash(stream: &Stream) -> String {
    let mut hash = Sha256::new();
    hash.update((stream.features().len() as u64).to_le_bytes());
    for number in stream.time_s().iter().chain(stream.values()) {
        hash.update(number.to_bits().to_le_bytes());
    }
    hex::encode(hash.finalize())
}

/// One warning for every repeated hash. The labels identify what was hashed: streams of one demonstration, or, across
/// several, demonstration and stream.
#[must_use]
pub fn duplicate_content(hashes: &[(String, String)]) -> Vec<Finding> {
    let mut first: BTreeMap<&str, &str> = BTreeMap::new();
    let mut findings = Vec::new();
    for (label, hash) in hashes {
        if let Some(original) = first.get(hash.as_str()) {
            let message = format!("the samples are identical to those of {original:?}");
            let remedy = "upload the intended recording; a copy gives one demonstration double weight";
            findings.push(Finding::warning(FindingCode::DuplicateContent, message, remedy).in_stream(label));
        } else {
            first.insert(hash, label);
        }
    }
    findings
}
