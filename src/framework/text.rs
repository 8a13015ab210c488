//! Names as people read them: how long they are and which characters they cannot hold, wherever they come from.

/// Maximum length of a display name, characters.
pub const MAX_DISPLAY_NAME_CHARS: u32 = 128;

/// Whether a text may be shown as a name: something to see, nothing hidden, not too long.
#[must_use]
pub fn is_display_name(text: &str) -> bool {
    let length = text.chars().count();
    !text.trim().is_empty() && length <= MAX_DISPLAY_NAME_CHARS as usize && !text.chars().any(is_hidden)
}

/// Whether a character is not seen or turns the direction of the text around it: control characters, zero-width and
/// bidirectional ones.
#[must_use]
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_any_script_are_seen_and_overrides_are_not() {
        assert!("wrist_yaw 腕 é 😀".chars().all(|c| !is_hidden(c)));
        assert!("\0\n\u{7f}\u{200b}\u{202e}\u{2066}\u{feff}".chars().all(is_hidden));
    }

    #[test]
    fn a_display_name_has_something_to_see_and_ends() {
        assert!(is_display_name("wax 2") && is_display_name(&"é".repeat(128)));
        assert!(!is_display_name(" ") && !is_display_name(&"é".repeat(129)) && !is_display_name("a\u{2028}b"));
    }
}
