//! Storage of actions; a job writes a new one together with its progress.

use super::StoreError;
use crate::app::model::{ActionGoals, ActionId, ActionView, Keyset};
use async_trait::async_trait;

/// Actions, written once.
#[async_trait]
pub trait Actions: Send + Sync {
    /// Reads one action.
    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError>;
    /// The goals of an action.
    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError>;
    /// Lists actions.
    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError>;
}
