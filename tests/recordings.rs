//! The framework on the recorded demonstrations of `../shared/data`, if present.

#![expect(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use cgda::framework::demonstration::{
    ClockPolicy, Demonstration, Finding, FindingCode, ReadOptions, SourceFile, read, read_files,
};
use cgda::framework::generalization::{GeneralizeSpec, Weighting, generalize};
use std::path::{Path, PathBuf};

fn recordings() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/demonstrations");
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return None;
    }
    Some(folder)
}

fn stream(folder: &Path, stream: &str, demonstration: usize) -> Vec<u8> {
    std::fs::read(folder.join(stream).join(format!("demo-{demonstration}.csv"))).unwrap()
}

fn bundle(folder: &Path, streams: &[&str], demonstration: usize, policy: ClockPolicy) -> (Demonstration, Vec<Finding>) {
    let content: Vec<(String, Vec<u8>)> =
        streams.iter().map(|name| (format!("{name}.csv"), stream(folder, name, demonstration))).collect();
    let files: Vec<SourceFile> = content.iter().map(|(name, bytes)| SourceFile { name, bytes }).collect();
    let options = ReadOptions { clock_policy: policy, ..ReadOptions::default() };
    read_files(&files, &options).unwrap()
}

#[test]
fn authors_output_is_reproduced_per_sample() {
    const EXPECTED: [f64; 13] = [
        0.0, 1.294_821, 9.412_651, 17.086_694, 22.464_859, 32.025, 39.012_097, 49.425, 64.012_097, 68.800_813,
        76.219_512, 87.175, 96.595_528,
    ];
    let Some(folder) = recordings() else { return };
    let options = ReadOptions { stream: Some("painted-percentage".to_owned()), ..ReadOptions::default() };
    let demonstrations: Vec<Demonstration> =
        (1..=4).map(|k| read(&stream(&folder.join("paint"), "painted-percentage", k), &options).unwrap().0).collect();
    let spec = GeneralizeSpec { weighting: Weighting::PerSample, ..GeneralizeSpec::new(10.0) };
    let found = generalize(&demonstrations, &spec).unwrap();
    assert_eq!(found.goals.features()[0].name, "painted");
    assert_eq!(found.goals.len(), EXPECTED.len());
    for (found, expected) in found.goals.values().iter().zip(EXPECTED) {
        assert!((found - expected).abs() < 1e-6, "{found} against {expected}");
    }
}

#[test]
fn every_recorded_file_passes_without_a_finding() {
    let Some(folder) = recordings() else { return };
    let mut files = 0;
    for action in ["paint", "iron"] {
        for entry in std::fs::read_dir(folder.join(action)).unwrap() {
            let stream_folder = entry.unwrap().path();
            let name = stream_folder.file_name().unwrap().to_string_lossy().into_owned();
            for file in std::fs::read_dir(&stream_folder).unwrap() {
                let path = file.unwrap().path();
                let options = ReadOptions { stream: Some(name.clone()), ..ReadOptions::default() };
                let (demonstration, findings) = read(&std::fs::read(&path).unwrap(), &options)
                    .unwrap_or_else(|findings| panic!("{}: {findings:?}", path.display()));
                assert_eq!(findings, [], "{}", path.display());
                assert!(demonstration.duration_s() > 10.0);
                files += 1;
            }
        }
    }
    assert_eq!(files, 25);
}

#[test]
fn force_streams_are_609_s_behind() {
    let Some(folder) = recordings() else { return };
    let streams = ["left-hand-pose", "painted-percentage", "right-hand-pose", "wrist-force"];
    for k in 1..=4 {
        let (_, findings) = bundle(&folder.join("iron"), &streams, k, ClockPolicy::AsRecorded);
        assert_eq!(findings.len(), 1, "{findings:?}");
        assert_eq!((findings[0].code, findings[0].stream.as_deref()), (FindingCode::ClockOffset, Some("wrist-force")));
        assert!(findings[0].message.contains("the clock is 60") && findings[0].message.contains("s behind"));
        assert!(findings[0].remedy.contains("align_by_start"));
    }
    let (_, findings) =
        bundle(&folder.join("paint"), &["painted-percentage", "wrist-force"], 1, ClockPolicy::AsRecorded);
    assert_eq!(findings[0].stream.as_deref(), Some("wrist-force"));
}

#[test]
fn aligned_bundles_generalize_over_all_streams() {
    let Some(folder) = recordings() else { return };
    let streams = ["right-hand-pose", "wrist-force"];
    let demonstrations: Vec<Demonstration> =
        (1..=4).map(|k| bundle(&folder.join("iron"), &streams, k, ClockPolicy::AlignByStart).0).collect();
    let found = generalize(&demonstrations, &GeneralizeSpec::new(3.0)).unwrap();
    assert_eq!(found.goals.len(), 8);
    assert_eq!(found.goals.features().len(), 13);

    let as_recorded: Vec<Demonstration> =
        (1..=4).map(|k| bundle(&folder.join("iron"), &streams, k, ClockPolicy::AsRecorded).0).collect();
    let error = generalize(&as_recorded, &GeneralizeSpec::new(3.0)).unwrap_err();
    assert!(error.to_string().contains("align the streams by start"), "{error}");
}
