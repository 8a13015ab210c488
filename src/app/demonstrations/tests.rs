//! Use-cases of demonstrations on test doubles: upload, twins, revisions, export.

use crate::app::bench::{Bench, line};
use crate::app::model::{ErrorKind, PageQuery, PatchDemonstration, UploadDemonstration, UploadFile, UploadOptions};
use crate::app::ports::TestClock;
use crate::framework::demonstration::FindingCode;

fn rename(name: &str) -> PatchDemonstration {
    PatchDemonstration { name: Some(name.to_owned()), excluded: None }
}

#[tokio::test]
async fn the_same_samples_uploaded_twice_are_a_finding() {
    let bench = Bench::new();
    let first = bench.app.upload_demonstration(line()).await.unwrap();
    assert_eq!((first.findings, first.revision, first.created_at), (0, 1, TestClock::START));
    let second = bench.app.upload_demonstration(line()).await.unwrap();
    let report = bench.app.demonstration_report(&second.id).await.unwrap();
    assert_eq!(report.findings.iter().map(|finding| finding.code).collect::<Vec<_>>(), [FindingCode::DuplicateContent]);
    assert!(report.findings[0].message.contains(first.id.as_str()), "{:?}", report.findings);
}

#[tokio::test]
async fn an_unreadable_upload_keeps_nothing_and_tells_the_row() {
    let bench = Bench::new();
    let bytes = b"time_s,x [m]\n0,0\n0.1,word\n".to_vec();
    let files = vec![UploadFile { file_name: "a.csv".to_owned(), bytes }];
    let upload = UploadDemonstration { name: None, files, options: UploadOptions::default() };
    let error = bench.app.upload_demonstration(upload).await.unwrap_err();
    assert_eq!((error.kind, error.code), (ErrorKind::Invalid, "invalid_demonstration"));
    assert!(error.details.iter().any(|place| place.pointer.contains("/rows/")), "{:?}", error.details);
    assert!(bench.app.list_demonstrations(PageQuery::default()).await.unwrap().items.is_empty());
}

#[tokio::test]
async fn a_change_counts_the_revision_and_refuses_a_stale_one() {
    let bench = Bench::new();
    let id = bench.demonstration().await;
    let renamed = bench.app.patch_demonstration(&id, rename("straight"), Some(1)).await.unwrap();
    assert_eq!((renamed.name.as_str(), renamed.revision), ("straight", 2));
    let stale = bench.app.patch_demonstration(&id, rename("late"), Some(1)).await.unwrap_err();
    assert_eq!((stale.kind, stale.code), (ErrorKind::Precondition, "revision_mismatch"));
    let hidden = bench.app.patch_demonstration(&id, rename("a\u{7}b"), None).await.unwrap_err();
    assert_eq!(hidden.details[0].pointer, "/name");
    assert_eq!(bench.app.get_demonstration(&id).await.unwrap(), renamed);
}

#[tokio::test]
async fn an_export_gives_back_the_samples() {
    let bench = Bench::new();
    let id = bench.demonstration().await;
    let export = bench.app.export_demonstration(&id, "csv").await.unwrap();
    assert_eq!(export.file_name, "line.csv");
    assert!(String::from_utf8(export.bytes).unwrap().starts_with("time_s,x [m]\n0,0\n0.1,0.1\n"));
    assert_eq!(bench.app.export_demonstration(&id, "xlsx").await.unwrap_err().code, "unknown_format");
}
