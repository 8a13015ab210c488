//! Storage of demonstrations and their samples.

use super::StoreError;
use crate::app::model::{DemonstrationId, DemonstrationReport, DemonstrationView, Keyset, PatchDemonstration};
use async_trait::async_trait;

/// A demonstration to keep.
#[derive(Debug, Clone)]
pub struct NewDemonstration {
    /// The demonstration, as shown.
    pub view: DemonstrationView,
    /// Findings of the reader.
    pub report: DemonstrationReport,
    /// Encoded samples.
    pub samples: Vec<u8>,
}

/// Demonstrations, kept until they are deleted.
#[async_trait]
pub trait Demonstrations: Send + Sync {
    /// Keeps a demonstration.
    async fn insert_demonstration(&self, new: NewDemonstration) -> Result<(), StoreError>;
    /// Reads one demonstration.
    async fn demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, StoreError>;
    /// Findings of the reader.
    async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, StoreError>;
    /// Encoded samples, checked against the digest stored with them.
    async fn demonstration_samples(&self, id: &DemonstrationId) -> Result<Vec<u8>, StoreError>;
    /// Lists demonstrations, newest first: one item more than `keyset.limit`, as every list.
    async fn demonstrations(&self, keyset: &Keyset) -> Result<Vec<DemonstrationView>, StoreError>;
    /// Demonstrations whose samples have this digest.
    async fn demonstrations_with_content(&self, sha256: &str) -> Result<Vec<DemonstrationId>, StoreError>;
    /// Changes a demonstration and counts its revision up.
    async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, StoreError>;
    /// Deletes a demonstration and its samples.
    async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), StoreError>;
}
