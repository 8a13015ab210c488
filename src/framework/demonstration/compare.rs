//! Checks between streams of one demonstration and between demonstrations: clocks, lengths, copies.

use super::table::Findings;
use super::{ClockPolicy, Finding, FindingCode, Stream};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Starts of streams recorded together may differ this much, seconds.
const START_TOLERANCE_S: f64 = 1.0;
/// Durations of streams recorded together may differ by this share of the longest ..
const DURATION_TOLERANCE: f64 = 0.05;
/// .. or by this, seconds.
const DURATION_TOLERANCE_S: f64 = 0.5;

/// Reports clocks that disagree, lengths that differ, and streams that are copies.
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

/// Against the stream that starts in the middle of all, so that one wrong clock among several is the one reported.
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
                "nothing to do; set `clock_policy` to `as_recorded` if the streams really start apart",
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
        let message = format!(
            "lasts {:.3} s, where {:?} lasts {:.3} s",
            stream.duration_s(),
            longest.name(),
            longest.duration_s()
        );
        let remedy = "check that the stream was recorded to the end and belongs to this demonstration";
        findings.push(Finding::warning(FindingCode::DurationMismatch, message, remedy).in_stream(stream.name()));
    }
}

/// SHA-256 over the bits of times and values, as hex: equal for copies whatever their format and names.
#[must_use]
pub fn content_hash(stream: &Stream) -> String {
    let mut hash = Sha256::new();
    hash.update((stream.features().len() as u64).to_le_bytes());
    for number in stream.time_s().iter().chain(stream.values()) {
        hash.update(number.to_bits().to_le_bytes());
    }
    hex::encode(hash.finalize())
}

/// Which of the labelled hashes occur again, one warning for each copy; use it over streams of one demonstration or
/// over those of several (label: demonstration and stream).
#[must_use]
pub fn duplicate_content(hashes: &[(String, String)]) -> Vec<Finding> {
    let mut first: BTreeMap<&str, &str> = BTreeMap::new();
    let mut findings = Vec::new();
    for (label, hash) in hashes {
        if let Some(original) = first.get(hash.as_str()) {
            let message = format!("the samples are the same as those of {original:?}");
            let remedy = "upload the recording that was meant; a copy gives one showing double weight";
            findings.push(Finding::warning(FindingCode::DuplicateContent, message, remedy).in_stream(label));
        } else {
            first.insert(hash, label);
        }
    }
    findings
}
