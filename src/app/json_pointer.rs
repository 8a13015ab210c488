//! JSON pointers (RFC 6901): where in a document a value stands.

use std::fmt::Display;

/// The pointer to member or element `key` of what `parent` points to; the empty pointer is the whole document.
#[must_use]
pub fn join(parent: &str, key: impl Display) -> String {
    let key = key.to_string().replace('~', "~0").replace('/', "~1");
    format!("{parent}/{key}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_separates_is_escaped() {
        assert_eq!(join(&join("", "a/b~c"), 3), "/a~1b~0c/3");
    }
}
