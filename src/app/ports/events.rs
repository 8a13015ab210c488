//! Wake-ups: hints that something was committed. A receiver then reads the store; a lost hint causes a delay, never a
//! loss.

use crate::app::model::JobId;
use tokio::sync::broadcast;

/// Content of a wake-up.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wake {
    /// The job may have new events.
    Job(JobId),
    /// A job is waiting for a worker.
    Queued,
}

/// Delivers wake-ups between the tasks of the service.
pub trait Events: Send + Sync {
    /// Wakes all subscribers.
    fn publish(&self, wake: Wake);

    /// Receives wake-ups from now on.
    fn subscribe(&self) -> broadcast::Receiver<Wake>;
}

/// Wake-ups within this process.
#[derive(Debug, Clone)]
pub struct LocalEvents {
    sender: broadcast::Sender<Wake>,
}

impl LocalEvents {
    /// Creates the channel. Receivers more than 1024 wake-ups behind are notified of that and read the store.
    #[must_use]
    pub fn new() -> Self {
        Self { sender: broadcast::Sender::new(1024) }
    }
}

impl Default for LocalEvents {
    fn default() -> Self {
        Self::new()
    }
}

impl Events for LocalEvents {
    fn publish(&self, wake: Wake) {
        // Without receivers there is nobody to wake.
        let _ = self.sender.send(wake);
    }

    fn subscribe(&self) -> broadcast::Receiver<Wake> {
        self.sender.subscribe()
    }
}
