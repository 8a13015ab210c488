//! Errors of the store, and how a use-case passes each one on.

use crate::app::model::{AppError, ErrorKind, JobId};
use crate::framework::job::InvalidTransition;
use std::sync::Arc;

/// Reasons why the store rejected or failed an operation.
#[derive(Debug, Clone, thiserror::Error)]
pub enum StoreError {
    /// No such row.
    #[error("there is no {kind} {id}")]
    NotFound {
        /// Kind of the resource.
        kind: &'static str,
        /// Id of the resource.
        id: String,
    },
    /// The row has another revision.
    #[error("{id} has revision {present}, not {expected}")]
    Revision {
        /// The row.
        id: String,
        /// Revision in the store.
        present: u64,
        /// Revision the caller named.
        expected: u64,
    },
    /// The job's state does not accept the event.
    #[error(transparent)]
    Transition(#[from] InvalidTransition),
    /// Another claim, or none, holds the job.
    #[error("the lease of {job} is lost")]
    LeaseLost {
        /// Job of the claim.
        job: JobId,
    },
    /// The idempotency key was used with another body.
    #[error("idempotency key {key:?} was used with another body")]
    KeyReused {
        /// Key of the request.
        key: String,
    },
    /// Something still names the row.
    #[error("{id} is named by {count} jobs")]
    InUse {
        /// The row.
        id: String,
        /// Number of jobs that name it.
        count: u64,
    },
    /// A stored value cannot be read back.
    #[error("stored {what} cannot be read: {cause}")]
    Corrupt {
        /// Description of the value.
        what: String,
        /// Reason why it cannot be read.
        cause: String,
    },
    /// No room left to write.
    #[error("no space is left to write: nothing was changed; free space on the disk of the data directory")]
    Full,
    /// The store is shut down or cannot be reached.
    #[error("the store does not answer")]
    Unavailable,
    /// The engine failed.
    #[error("the database failed")]
    Engine(#[source] Arc<dyn std::error::Error + Send + Sync>),
}

impl From<StoreError> for AppError {
    fn from(error: StoreError) -> Self {
        let text = error.to_string();
        match error {
            StoreError::NotFound { .. } => Self::new(ErrorKind::NotFound, "not_found", text),
            StoreError::Revision { .. } => Self::new(ErrorKind::Precondition, "revision_mismatch", text),
            StoreError::Transition(_) => Self::new(ErrorKind::Conflict, "invalid_state", text),
            StoreError::LeaseLost { .. } => Self::new(ErrorKind::Conflict, "lease_lost", text),
            StoreError::KeyReused { .. } => Self::new(ErrorKind::Invalid, "idempotency_key_reused", text),
            StoreError::InUse { .. } => Self::new(ErrorKind::Conflict, "in_use", text),
            StoreError::Full => {
                Self { retry_after_s: Some(10), ..Self::new(ErrorKind::StorageFull, "storage_full", text) }
            }
            StoreError::Unavailable => Self::unavailable("store_unavailable", text),
            StoreError::Corrupt { .. } | StoreError::Engine(_) => Self::internal(error),
        }
    }
}
