//! Ingest as a whole: the corpus of bad files, garbage, the accepted formats, and the shipped demonstrations.

#![expect(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use cgda::framework::demonstration::{
    ClockPolicy, Demonstration, Finding, Format, ReadOptions, Severity, SourceFile, read, read_files,
};
use cgda::framework::generalization::{GeneralizeSpec, Generalized, generalize};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

#[path = "../examples/generate_demonstrations.rs"]
#[expect(dead_code, reason = "the example's own main")]
mod generate_demonstrations;

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Files of a folder with the finding code that starts their name: `code--description.extension`.
fn corpus(folder: &str) -> Vec<(String, PathBuf)> {
    let mut files: Vec<(String, PathBuf)> = std::fs::read_dir(repository().join("tests/fixtures").join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .map(|path| (path.file_name().unwrap().to_string_lossy().split_once("--").unwrap().0.to_owned(), path))
        .collect();
    files.sort();
    files
}

#[test]
fn every_bad_file_is_refused_with_its_code_and_a_remedy() {
    let files = corpus("demonstrations");
    assert!(files.len() >= 38, "{} files in the corpus", files.len());
    for (code, path) in files {
        let findings = read(&std::fs::read(&path).unwrap(), &ReadOptions::default())
            .expect_err(&format!("{} was accepted", path.display()));
        let first = findings.iter().find(|finding| finding.is_error()).unwrap();
        assert_eq!(first.code.to_string(), code, "{}: {findings:?}", path.display());
        assert!(!first.remedy.is_empty() && !first.message.is_empty());
    }
}

#[test]
fn every_doubtful_file_is_accepted_with_its_warning() {
    let files = corpus("demonstrations/accepted");
    assert_eq!(files.len(), 5);
    for (code, path) in files {
        let (_, findings) = read(&std::fs::read(&path).unwrap(), &ReadOptions::default()).unwrap();
        let codes: Vec<String> = findings.iter().map(|finding| finding.code.to_string()).collect();
        assert_eq!(codes, [code], "{}", path.display());
        assert_eq!(findings[0].severity, Severity::Warning);
    }
}

#[test]
fn a_finding_says_where() {
    let findings = read(b"time,x,y\n0,1,1\n0.1,2,nan\n0.2,3,3\n", &ReadOptions::default()).unwrap_err();
    let Finding { stream, row, column, .. } = &findings[0];
    assert_eq!((stream.as_deref(), *row, column.as_deref()), (Some("stream"), Some(3), Some("y")));
    let findings = read(b"time,x\n0,1\n0.5,2\n0.25,3\n", &ReadOptions::default()).unwrap_err();
    assert_eq!((findings[0].row, findings[0].time_s), (Some(4), Some(0.25)));
}

#[test]
fn the_same_samples_in_every_form_are_the_same_stream() {
    let forms: [&[u8]; 8] = [
        b"time,x [mm],y [mm]\n0,1,2\n0.5,3,4\n",
        b"\xef\xbb\xbftime;x [mm];y [mm]\r\n0;1;2\r\n0.5;3;4",
        b"# a comment\nx [mm]\ttimestamp [ms]\ty (mm)\n1\t0\t2\n3\t500\t4\n",
        b"t,\"x [mm]\",\"y [mm]\"\n\"0\",\"1\",\"2\"\n\n0.5,3,4\n",
        br#"{"streams":[{"name":"s","features":[{"name":"x","unit":"mm"},{"name":"y","unit":"mm"}],"time_s":[0,0.5],"values":[[1,2],[3,4]]}]}"#,
        br#"{"name":"n","streams":[{"name":"s","features":[{"name":"x","unit":"mm"},{"name":"y","unit":"mm"}],"time_s":[0,0.5],"values":[1,2,3,4]}]}"#,
        br#"{"streams":[{"name":"s","features":[{"name":"x","unit":"mm"},{"name":"y","unit":"mm"}],"samples":[[0,1,2],[0.5,3,4]]}]}"#,
        b"-1 0 1 2\n-1 0.5 3 4\n",
    ];
    let options = ReadOptions {
        stream: Some("s".to_owned()),
        features: vec![cgda::framework::Feature::new("x", "mm"), cgda::framework::Feature::new("y", "mm")],
        ..ReadOptions::default()
    };
    let streams: Vec<_> = forms.iter().map(|bytes| read(bytes, &options).unwrap().0.streams.remove(0)).collect();
    for stream in &streams {
        assert_eq!(stream, &streams[0]);
    }
    let again = serde_json::to_vec(&Demonstration { name: "n".to_owned(), streams: vec![streams[0].clone()] }).unwrap();
    assert_eq!(read(&again, &options).unwrap().0.streams[0], streams[0]);
}

#[test]
fn bundles_name_streams_by_file_and_qualify_shared_features() {
    let files = [
        SourceFile { name: "demo/left.csv", bytes: b"time,x,only\n10,1,5\n11,2,6\n12,2,6\n" },
        SourceFile { name: "demo/right.csv", bytes: b"time,x\n500,1\n501,3\n502,3\n" },
    ];
    let options = ReadOptions { clock_policy: ClockPolicy::AlignByStart, ..ReadOptions::default() };
    let (demonstration, findings) = read_files(&files, &options).unwrap();
    let names: Vec<&str> = demonstration.features().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["left.x", "only", "right.x"]);
    assert_eq!(demonstration.streams[1].time_s(), [0.0, 1.0, 2.0]);
    assert_eq!(findings.len(), 1);
    assert!(findings[0].message.contains("490.000 s"), "{}", findings[0].message);
}

fn shipped(action: &str, t_min_s: f64) -> Generalized {
    let folder = repository().join("examples/demonstrations").join(action);
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let demonstrations: Vec<Demonstration> = paths
        .iter()
        .map(|path| {
            let (demonstration, findings) = read(&std::fs::read(path).unwrap(), &ReadOptions::default()).unwrap();
            assert_eq!(findings, [], "{}", path.display());
            demonstration
        })
        .collect();
    assert_eq!(demonstrations.len(), 4);
    generalize(&demonstrations, &GeneralizeSpec::new(t_min_s)).unwrap()
}

#[test]
fn shipped_demonstrations_are_what_the_generator_writes() {
    let files = generate_demonstrations::files();
    assert_eq!(files.len(), 14);
    for (path, content) in files {
        let path = repository().join("examples/demonstrations").join(path);
        let shipped = std::fs::read_to_string(&path).unwrap();
        assert!(shipped == content, "{} differs: run the example generate_demonstrations", path.display());
    }
}

#[test]
fn shipped_wax_makes_the_nine_goals_of_the_paper() {
    const RAW: [[f64; 3]; 9] = [
        [638.762_472_7, 2.726_269_775, -3.978_450_85],
        [642.391_811_965, 16.857_355_995, -3.026_283_04],
        [680.641_917_184, 88.839_787_124, 1.230_439_249],
        [783.047_694_335, 120.799_710_345, 6.475_137_425],
        [864.809_906_692, 54.146_969_711, 7.086_119_303],
        [816.733_444_045, -51.924_880_645, -0.954_816_4],
        [691.319_608_448, -64.673_106_851, -6.881_748_483],
        [638.455_344_905, -15.701_801_49, -4.274_716_475],
        [636.920_685_935, 0.373_245_194, -3.830_948_204],
    ];
    let goals = shipped("wax", 1.0).goals;
    assert_eq!(goals.len(), 9);
    for (goal, raw) in goals.rows().zip(RAW) {
        for ((found, raw), origin) in goal.iter().zip(raw).zip([1100.0, -500.0, 300.0]) {
            assert!((found - (origin - raw)).abs() < 5.0, "{found} against {}", origin - raw);
        }
    }
}

#[test]
fn shipped_paint_makes_seventeen_goals_of_one_square_each() {
    let goals = shipped("paint", 1.0).goals;
    assert_eq!(goals.len(), 17);
    assert!(goals.values().is_sorted());
    for (square, found) in goals.values().iter().enumerate() {
        assert!((found - 6.25 * square as f64).abs() < 1.0, "{found} at square {square}");
    }
}

/// Checks that reading neither panics, nor accepts input without samples, nor rejects it without an error.
fn check_contract(bytes: &[u8], options: &ReadOptions) {
    match read(bytes, options) {
        Ok((demonstration, findings)) => {
            assert!(findings.iter().all(|finding| !finding.is_error()));
            for stream in &demonstration.streams {
                assert!(stream.len() >= 2 && stream.time_s().windows(2).all(|pair| pair[0] < pair[1]));
                assert!(stream.values().iter().all(|value| value.is_finite()));
            }
        }
        Err(findings) => {
            assert!(findings.iter().any(Finding::is_error) && findings.len() <= options.limits.findings + 1);
        }
    }
}

proptest! {
    #[test]
    fn garbage_is_refused_without_a_panic(
        bytes in proptest::collection::vec(any::<u8>(), 0..400),
        format in proptest::option::of(prop_oneof![Just(Format::Csv), Just(Format::Yarp), Just(Format::Json)]),
    ) {
        check_contract(&bytes, &ReadOptions { format, ..ReadOptions::default() });
    }

    #[test]
    fn text_like_files_are_handled_without_a_panic(
        text in "(time|t)?[,; \t]?[xy \\[\\]m]{0,6}(\n|\r\n)([-0-9.eE,;naif \t\"#]{0,30}\n){0,8}",
        format in proptest::option::of(prop_oneof![Just(Format::Csv), Just(Format::Yarp), Just(Format::Json)]),
        align in any::<bool>(),
    ) {
        let clock_policy = if align { ClockPolicy::AlignByStart } else { ClockPolicy::AsRecorded };
        check_contract(text.as_bytes(), &ReadOptions { format, clock_policy, ..ReadOptions::default() });
    }

    #[test]
    fn flipped_bytes_of_good_files_never_panic(
        which in 0..3_usize,
        flips in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let good: [&[u8]; 3] = [
            b"time [s],x [mm],y\n0,1,2\n0.1,2,3\n0.2,3,4\n0.3,3,4\n",
            b"-1.0 1501075006.9 0.0\n-1.0 1501075007.1 6.25\n-1.0 1501075007.2 12.5\n",
            br#"{"name":"n","streams":[{"name":"s","features":[{"name":"x","unit":"mm"}],"time_s":[0,0.5],"values":[[1],[3]]}]}"#,
        ];
        let mut bytes = good[which].to_vec();
        for (index, byte) in flips {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        check_contract(&bytes, &ReadOptions::default());
    }
}
