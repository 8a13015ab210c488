//! The data directory: accessible to its owner only, locked by one server at a time.

use std::fs::{DirBuilder, File, OpenOptions, TryLockError};
use std::io::{Read as _, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

/// Reasons why the data directory cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum DataDirError {
    /// Another server has locked it.
    #[error("another server uses the data directory {path}: stop it, or give another --data-dir")]
    Held {
        /// Path of the directory.
        path: PathBuf,
    },
    /// It cannot be created, read or written.
    #[error("the data directory cannot be used: {path}: {cause}")]
    Unusable {
        /// Path of the directory or of a file in it.
        path: PathBuf,
        /// Error from the operating system.
        cause: std::io::Error,
    },
}

/// The data directory, locked until dropped or until the process ends in any way.
#[derive(Debug)]
pub struct DataDir {
    path: PathBuf,
    _lock: File,
}

impl DataDir {
    /// Creates the directory if necessary and locks it.
    ///
    /// # Errors
    /// [`DataDirError`] if another server has locked it or the operating system fails.
    pub fn hold(path: &Path) -> Result<Self, DataDirError> {
        let unusable = |path: &Path, cause| DataDirError::Unusable { path: path.to_owned(), cause };
        if !path.is_dir() {
            DirBuilder::new().recursive(true).mode(0o700).create(path).map_err(|cause| unusable(path, cause))?;
        }
        let file = path.join("lock");
        let lock = private().create(true).truncate(false).open(&file).map_err(|cause| unusable(&file, cause))?;
        match lock.try_lock() {
            Ok(()) => Ok(Self { path: path.to_owned(), _lock: lock }),
            Err(TryLockError::WouldBlock) => Err(DataDirError::Held { path: path.to_owned() }),
            Err(TryLockError::Error(cause)) => Err(unusable(&file, cause)),
        }
    }

    /// Path of the database.
    #[must_use]
    pub fn database(&self) -> PathBuf {
        self.path.join("cgda.db")
    }

    /// The stored token; if there is none yet, stores `fresh()`.
    ///
    /// # Errors
    /// [`DataDirError::Unusable`] if the operating system fails.
    pub fn token(&self, fresh: impl FnOnce() -> String) -> Result<String, DataDirError> {
        let path = self.path.join("token");
        let unusable = |cause| DataDirError::Unusable { path: path.clone(), cause };
        if path.is_file() {
            let mut text = String::new();
            File::open(&path).and_then(|mut file| file.read_to_string(&mut text)).map_err(unusable)?;
            let token = text.trim();
            if !token.is_empty() {
                return Ok(token.to_owned());
            }
        }
        let token = fresh();
        // Written to a temporary file and renamed, so that a token file is never partial.
        let aside = self.path.join("token.new");
        let write = || {
            let mut file = private().create(true).truncate(true).open(&aside)?;
            writeln!(file, "{token}")?;
            file.sync_all()?;
            std::fs::rename(&aside, &path)?;
            File::open(&self.path)?.sync_all()
        };
        write().map_err(unusable)?;
        Ok(token)
    }
}

fn private() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).write(true).mode(0o600);
    options
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt as _;

    #[test]
    fn one_holder_at_a_time() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("new/data");
        let held = DataDir::hold(&path).unwrap();
        assert!(matches!(DataDir::hold(&path), Err(DataDirError::Held { .. })));
        drop(held);
        DataDir::hold(&path).unwrap();
        assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o700);
    }

    #[test]
    fn the_token_stays_and_is_its_owners_only() {
        let directory = tempfile::tempdir().unwrap();
        let held = DataDir::hold(directory.path()).unwrap();
        assert_eq!(held.token(|| "first".to_owned()).unwrap(), "first");
        assert_eq!(held.token(|| "second".to_owned()).unwrap(), "first");
        let mode = std::fs::metadata(directory.path().join("token")).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }
}
