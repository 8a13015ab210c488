//! The conformance suite on SQLite, and tests of faults that only SQLite can have.

use super::*;
use crate::app::model::DemonstrationId;
use crate::app::ports::Demonstrations as _;
use crate::store::suite::conformance;
use sqlx::sqlite::SqliteConnection;
use sqlx::{ConnectOptions as _, Executor as _, SqlSafeStr as _};

async fn fresh() -> (tempfile::TempDir, SqliteStore) {
    let directory = tempfile::tempdir().unwrap();
    let store = SqliteStore::open(&directory.path().join("cgda.db")).await.unwrap();
    (directory, store)
}

conformance! { fresh() }

#[tokio::test]
async fn every_statement_prepares_on_a_fresh_database() {
    let (directory, _store) = fresh().await;
    let mut connection = open::writing(&directory.path().join("cgda.db")).connect().await.unwrap();
    let modules = [
        actions::STATEMENTS,
        demonstrations::STATEMENTS,
        events::STATEMENTS,
        experiments::STATEMENTS,
        job_row::STATEMENTS,
        jobs::STATEMENTS,
        queue::STATEMENTS,
        robots::STATEMENTS,
        runs::STATEMENTS,
        trials::STATEMENTS,
        worlds::STATEMENTS,
    ];
    let mut prepared = 0;
    for statement in modules.into_iter().flatten() {
        if let Err(error) = connection.prepare((*statement).into_sql_str()).await {
            panic!("{error}: {statement}");
        }
        prepared += 1;
    }
    assert!(prepared > 40, "{prepared}");
}

async fn note(connection: &mut SqliteConnection, text: String) -> Result<(), StoreError> {
    sqlx::query("INSERT INTO idempotency_keys (key, body_sha256, job_id, created_at) SELECT ?1, '', id, 0 FROM jobs")
        .bind(text)
        .execute(connection)
        .await?;
    Ok(())
}

async fn notes(store: &SqliteStore) -> i64 {
    sqlx::query_scalar("SELECT count(*) FROM idempotency_keys").fetch_one(&store.readers).await.unwrap()
}

/// A row that notes can refer to.
async fn with_a_job(store: &SqliteStore) {
    sqlx::query(
        "INSERT INTO jobs (id, kind, name, state, state_since, attempt, crashes, last_seq, progress, request, work,
            created_at) VALUES ('job', '', '', '', 0, 0, 0, 0, '', '', '', 0)",
    )
    .execute(&mut open::writing(&database(store).await).connect().await.unwrap())
    .await
    .unwrap();
}

async fn database(store: &SqliteStore) -> std::path::PathBuf {
    let file: String =
        sqlx::query_scalar("SELECT file FROM pragma_database_list").fetch_one(&store.readers).await.unwrap();
    file.into()
}

#[tokio::test]
async fn an_operation_that_fails_takes_nothing_of_its_group_along() {
    let (_directory, store) = fresh().await;
    with_a_job(&store).await;
    let write = |number: usize| {
        store.writer.write(move |connection| {
            Box::pin(async move {
                note(connection, number.to_string()).await?;
                if number.is_multiple_of(3) { Err(StoreError::Full) } else { Ok(number) }
            })
        })
    };
    let answers = futures_util::future::join_all((0..90).map(write)).await;
    assert_eq!(answers.iter().filter(|answer| answer.is_ok()).count(), 60);
    assert_eq!(notes(&store).await, 60);
}

#[tokio::test]
async fn a_caller_that_goes_away_cancels_nothing() {
    let (_directory, store) = fresh().await;
    with_a_job(&store).await;
    let write = store.writer.write(|connection| {
        Box::pin(async move {
            note(connection, "before".to_owned()).await?;
            tokio::time::sleep(Duration::from_millis(50)).await;
            note(connection, "after".to_owned()).await
        })
    });
    assert!(tokio::time::timeout(Duration::from_millis(20), write).await.is_err());
    // The next operation waits for the one that was left alone.
    store.writer.write(|_| Box::pin(async { Ok(()) })).await.unwrap();
    assert_eq!(notes(&store).await, 2);
}

#[tokio::test]
async fn damaged_samples_are_found() {
    let (_directory, store) = fresh().await;
    store
        .writer
        .write(|connection| {
            Box::pin(async move {
                for statement in [
                    "INSERT INTO demonstrations (id, name, revision, sha256, created_at, view, report)
                        VALUES ('dem_00000000000000000000000000000001', '', 1, '', 0, '', '')",
                    "INSERT INTO demonstration_samples (demonstration_id, sha256, data) VALUES
                        ('dem_00000000000000000000000000000001', 'other', x'00')",
                ] {
                    sqlx::query(statement).execute(&mut *connection).await?;
                }
                Ok(())
            })
        })
        .await
        .unwrap();
    let damaged = DemonstrationId::from_uuid(uuid::Uuid::from_u128(1));
    assert!(matches!(store.demonstration_samples(&damaged).await, Err(StoreError::Corrupt { .. })));
}
