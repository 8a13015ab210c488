//! A file to send.

/// A file to download.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Export {
    /// Media type.
    pub content_type: &'static str,
    /// Suggested name, safe for every file system.
    pub file_name: String,
    /// Raw content of the file.
    pub bytes: Vec<u8>,
}

impl Export {
    /// A file named after `name`, reduced to letters, digits, `-` and `_`.
    #[must_use]
    pub fn new(content_type: &'static str, name: &str, extension: &str, bytes: Vec<u8>) -> Self {
        let safe: String = name
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' })
            .take(80)
            .collect();
        Self { content_type, file_name: format!("{safe}.{extension}"), bytes }
    }
}
