//! The one writer: a task that owns the only writing connection and commits in groups.
//!
//! # Invariants
//! - An operation runs in the writer's task: a caller that goes away cannot cancel it half-way.
//! - Operations queued while a commit is under way share the next one; each has its own savepoint, so that one which
//!   fails takes nothing of the others along.
//! - An answer is given after the commit. When a commit fails, no operation of the group is acknowledged and the
//!   connection is closed and opened anew: after a failed sync nothing held in memory can be trusted.

use crate::app::ports::StoreError;
use futures_util::future::BoxFuture;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{ConnectOptions as _, Connection as _};
use tokio::sync::{mpsc, oneshot};

/// Operations that may wait for the writer.
const QUEUE: usize = 1024;
/// Operations of one commit.
const GROUP: usize = 64;

/// Hands operations to the writer's task; the task ends when the last clone is dropped.
#[derive(Clone)]
pub(super) struct Writer {
    sender: mpsc::Sender<Box<dyn Queued>>,
}

trait Queued: Send {
    /// Runs the operation; whether its savepoint is kept.
    fn run<'c>(&'c mut self, connection: &'c mut SqliteConnection) -> BoxFuture<'c, bool>;

    /// Answers the caller; `failed` is the reason if the commit did not happen.
    fn answer(self: Box<Self>, failed: Option<&StoreError>);
}

struct Operation<F, T> {
    work: Option<F>,
    result: Result<T, StoreError>,
    reply: oneshot::Sender<Result<T, StoreError>>,
}

impl<F, T> Queued for Operation<F, T>
where
    F: for<'c> FnOnce(&'c mut SqliteConnection) -> BoxFuture<'c, Result<T, StoreError>> + Send,
    T: Send,
{
    fn run<'c>(&'c mut self, connection: &'c mut SqliteConnection) -> BoxFuture<'c, bool> {
        Box::pin(async move {
            if let Some(work) = self.work.take() {
                self.result = work(connection).await;
            }
            self.result.is_ok()
        })
    }

    fn answer(self: Box<Self>, failed: Option<&StoreError>) {
        let result = match failed {
            Some(error) if self.result.is_ok() => Err(error.clone()),
            _ => self.result,
        };
        // A caller that went away does not need the answer.
        let _ = self.reply.send(result);
    }
}

impl Writer {
    /// Starts the task on `connection`; `options` open it anew after a failed commit.
    pub(super) fn start(connection: SqliteConnection, options: SqliteConnectOptions) -> Self {
        let (sender, receiver) = mpsc::channel(QUEUE);
        tokio::spawn(run(Some(connection), options, receiver));
        Self { sender }
    }

    /// Runs `work` in a transaction of the writer and answers after its commit.
    pub(super) async fn write<T, F>(&self, work: F) -> Result<T, StoreError>
    where
        T: Send + 'static,
        F: for<'c> FnOnce(&'c mut SqliteConnection) -> BoxFuture<'c, Result<T, StoreError>> + Send + 'static,
    {
        let (reply, answer) = oneshot::channel();
        let operation = Operation { work: Some(work), result: Err(StoreError::Unavailable), reply };
        self.sender.send(Box::new(operation)).await.map_err(|_| StoreError::Unavailable)?;
        answer.await.map_err(|_| StoreError::Unavailable)?
    }
}

async fn run(
    mut connection: Option<SqliteConnection>,
    options: SqliteConnectOptions,
    mut receiver: mpsc::Receiver<Box<dyn Queued>>,
) {
    let mut group = Vec::with_capacity(GROUP);
    while receiver.recv_many(&mut group, GROUP).await > 0 {
        let outcome = match open(&mut connection, &options).await {
            Ok(connection) => commit(connection, &mut group).await,
            Err(error) => Err(error),
        };
        if let Err(error) = &outcome {
            tracing::error!(error = %error, cause = ?error, "a commit failed; the writing connection is opened anew");
            if let Some(broken) = connection.take() {
                let _ = broken.close_hard().await;
            }
        }
        for operation in group.drain(..) {
            operation.answer(outcome.as_ref().err());
        }
    }
    if let Some(connection) = connection {
        let _ = connection.close().await;
    }
}

async fn open<'c>(
    connection: &'c mut Option<SqliteConnection>,
    options: &SqliteConnectOptions,
) -> Result<&'c mut SqliteConnection, StoreError> {
    match connection {
        Some(open) => Ok(open),
        empty => Ok(empty.insert(options.connect().await?)),
    }
}

async fn commit(connection: &mut SqliteConnection, group: &mut [Box<dyn Queued>]) -> Result<(), StoreError> {
    execute(connection, "BEGIN IMMEDIATE").await?;
    for operation in group {
        execute(connection, "SAVEPOINT operation").await?;
        if !operation.run(connection).await {
            execute(connection, "ROLLBACK TO operation").await?;
        }
        execute(connection, "RELEASE operation").await?;
    }
    execute(connection, "COMMIT").await
}

async fn execute(connection: &mut SqliteConnection, statement: &'static str) -> Result<(), StoreError> {
    sqlx::query(statement).execute(connection).await?;
    Ok(())
}
