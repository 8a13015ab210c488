//! Characters that no name may contain, wherever names come from.

/// Whether a character is not seen or turns the direction of the text around it: control characters, zero-width and
/// bidirectional ones.
#[must_use]
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}'
        )
}

#[cfg(test)]
mod tests {
    use super::is_hidden;

    #[test]
    fn letters_of_any_script_are_seen_and_overrides_are_not() {
        assert!("wrist_yaw 腕 é 😀".chars().all(|c| !is_hidden(c)));
        assert!("\0\n\u{7f}\u{200b}\u{202e}\u{2066}\u{feff}".chars().all(is_hidden));
    }
}
