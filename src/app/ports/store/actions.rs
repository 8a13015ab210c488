//! Storage of actions; a job that makes one writes it with its progress.

use super::StoreError;
use crate::app::model::{ActionGoals, ActionId, ActionView, Keyset};
use async_trait::async_trait;

/// Actions, written once.
#[async_trait]
pub trait Actions: Send + Sync {
    /// One action.
    async fn action(&self, id: &ActionId) -> Result<ActionView, StoreError>;
    /// Its goals.
    async fn action_goals(&self, id: &ActionId) -> Result<ActionGoals, StoreError>;
    /// Actions.
    async fn actions(&self, keyset: &Keyset) -> Result<Vec<ActionView>, StoreError>;
}
