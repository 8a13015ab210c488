//! The migrations of `migrations/sqlite`, compiled into the program. A file that has been released never changes: its
//! checksum stands in every database.

use sqlx::SqlSafeStr as _;
use sqlx::migrate::{Migration, MigrationType, Migrator};
use std::borrow::Cow;
use std::sync::LazyLock;

/// Version, description and text of each file, in order.
const FILES: [(i64, &str, &str); 4] = [
    (1, "start", include_str!("../../../migrations/sqlite/0001_start.sql")),
    (2, "experiments", include_str!("../../../migrations/sqlite/0002_experiments.sql")),
    (3, "trials", include_str!("../../../migrations/sqlite/0003_trials.sql")),
    (4, "documents", include_str!("../../../migrations/sqlite/0004_documents.sql")),
];

/// Brings a database of any earlier version up to date, each file in its own transaction.
pub(super) static MIGRATIONS: LazyLock<Migrator> = LazyLock::new(|| {
    let migrations = FILES.map(|(version, description, text)| {
        let kind = MigrationType::Simple;
        Migration::new(version, Cow::Borrowed(description), kind, text.into_sql_str(), false)
    });
    Migrator::with_migrations(migrations.into())
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_folder_is_compiled_in() {
        let mut files: Vec<String> = std::fs::read_dir("migrations/sqlite")
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        assert_eq!(files, FILES.map(|(version, description, _)| format!("{version:04}_{description}.sql")));
    }
}
