//! Checks of one stream's clock: number of samples, unit, order, repeated rows, gaps, duration.

use super::table::{Findings, Table};
use super::{Finding, FindingCode, Limits};

/// Times above this cannot be seconds of the Unix epoch (1e11 s is the year 5138); they are milliseconds or finer.
const LATEST_TIME_S: f64 = 1e11;
/// A time step this many times the median step counts as a gap.
const GAP_FACTOR: f64 = 10.0;
/// Maximum number of gaps reported per stream.
const GAPS_REPORTED: usize = 10;

/// Reports defects of the clock of `table`; removes rows that repeat the previous row in time and every value.
pub(super) fn check(table: &mut Table, limits: &Limits, findings: &mut Findings) {
    if table.time_s.iter().any(|t| !t.is_finite()) {
        return; // found by the parser, with its row
    }
    if let Some(sample) = table.time_s.iter().position(|t| t.abs() > LATEST_TIME_S) {
        let time_s = table.time_s[sample];
        let unit = if time_s.abs() > 1e17 { "nanoseconds" } else { "milliseconds or microseconds" };
        let message = format!("{time_s:e} s is too large for a time in seconds: probably {unit}");
        let remedy = "convert the times, or name the unit in the header as in `timestamp [ns]`";
        findings.push(at(table, sample, Finding::error(FindingCode::TimeUnit, message, remedy)));
        return;
    }
    drop_repeated_rows(table, findings);
    for sample in 1..table.time_s.len() {
        let (before, time_s) = (table.time_s[sample - 1], table.time_s[sample]);
        if time_s <= before && !findings.full() {
            let message = format!("time {time_s} s is not after {before} s");
            let remedy = "sort the rows by time and remove rows with equal times";
            findings.push(at(table, sample, Finding::error(FindingCode::NonIncreasingTime, message, remedy)));
        }
    }
    if table.time_s.len() < 2 {
        let message = format!("{} samples, but at least 2 are needed", table.time_s.len());
        let finding = Finding::error(FindingCode::TooSmall, message, "record the whole demonstration");
        findings.push(finding.in_stream(&table.stream));
        return;
    }
    if !findings.refused() {
        check_length(table, limits, findings);
        report_gaps(table, findings);
    }
}

fn at(table: &Table, sample: usize, finding: Finding) -> Finding {
    finding.in_stream(&table.stream).at_row(table.rows[sample]).at_time(table.time_s[sample])
}

fn drop_repeated_rows(table: &mut Table, findings: &mut Findings) {
    let m = table.features.len();
    let repeats = |table: &Table, sample: usize| {
        sample > 0
            && table.time_s[sample].to_bits() == table.time_s[sample - 1].to_bits()
            && table.values[sample * m..(sample + 1) * m] == table.values[(sample - 1) * m..sample * m]
    };
    let repeated: Vec<usize> = (0..table.time_s.len()).filter(|&sample| repeats(table, sample)).collect();
    let Some(&first) = repeated.first() else { return };
    let message = format!("{} rows repeat the previous row in time and every value", repeated.len());
    let remedy = "the copies were dropped; remove them from the file to silence this warning";
    findings.push(at(table, first, Finding::warning(FindingCode::DuplicateRow, message, remedy)));
    let mut copies = vec![false; table.time_s.len()];
    for sample in repeated {
        copies[sample] = true;
    }
    let keep = |index: &mut usize| {
        *index += 1;
        !copies[*index - 1]
    };
    let (mut row, mut time, mut value) = (0, 0, 0);
    table.rows.retain(|_| keep(&mut row));
    table.time_s.retain(|_| keep(&mut time));
    table.values.retain(|_| {
        value += 1;
        !copies[(value - 1) / m]
    });
}

fn check_length(table: &Table, limits: &Limits, findings: &mut Findings) {
    let duration_s = table.time_s[table.time_s.len() - 1] - table.time_s[0];
    let (code, bound_s, word) = if duration_s < limits.min_duration_s {
        (FindingCode::TooShort, limits.min_duration_s, "less")
    } else if duration_s > limits.max_duration_s {
        (FindingCode::TooLong, limits.max_duration_s, "more")
    } else {
        return;
    };
    let message = format!("the recording lasts {duration_s} s, {word} than {bound_s} s");
    let remedy = "check the unit of time, or trim the recording to the demonstration";
    findings.push(Finding::error(code, message, remedy).in_stream(&table.stream));
}

fn report_gaps(table: &Table, findings: &mut Findings) {
    let mut steps: Vec<f64> = table.time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    let (_, &mut median_s, _) = steps.select_nth_unstable_by(middle, f64::total_cmp);
    let gaps = (1..table.time_s.len()).filter(|&i| table.time_s[i] - table.time_s[i - 1] > GAP_FACTOR * median_s);
    for sample in gaps.take(GAPS_REPORTED) {
        let step_s = table.time_s[sample] - table.time_s[sample - 1];
        let message = format!("{step_s:.6} s without a sample; the usual step is {median_s:.6} s");
        let remedy = "record it again, or accept that goals in the gap are interpolated";
        findings.push(at(table, sample, Finding::warning(FindingCode::Gap, message, remedy)));
    }
}
