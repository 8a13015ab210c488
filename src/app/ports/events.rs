//! Wake-ups: a hint that something was committed. Whoever is woken reads the store; a lost hint delays, never loses.

use crate::app::model::JobId;
use tokio::sync::broadcast;

/// What happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wake {
    /// The job has new events.
    Job(JobId),
    /// A job waits for a worker.
    Queued,
}

/// Carries wake-ups between the tasks of the service.
pub trait Events: Send + Sync {
    /// Wakes whoever listens.
    fn publish(&self, wake: Wake);

    /// From now on.
    fn subscribe(&self) -> broadcast::Receiver<Wake>;
}

/// Wake-ups inside this process.
#[derive(Debug, Clone)]
pub struct LocalEvents {
    sender: broadcast::Sender<Wake>,
}

impl LocalEvents {
    /// Listeners that are more than 1024 wake-ups behind are told so and read the store.
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
        // Without a listener there is nobody to wake.
        let _ = self.sender.send(wake);
    }

    fn subscribe(&self) -> broadcast::Receiver<Wake> {
        self.sender.subscribe()
    }
}
