//! The numbers in the comments of `proto/` are the limits that the service enforces.

use super::messages::{PACKAGE, pool};
use cgda::app::model::{DEFAULT_PAGE_SIZE, MAX_PAGE_SIZE};
use prost_reflect::FieldDescriptor;

/// Every field of our messages with its comment.
fn fields() -> Vec<(FieldDescriptor, String)> {
    let pool = pool();
    let ours = pool.all_messages().filter(|message| message.package_name() == PACKAGE);
    let fields = ours.flat_map(|message| message.fields().collect::<Vec<_>>());
    fields.map(|field| (field.clone(), comment(&field))).collect()
}

fn comment(field: &FieldDescriptor) -> String {
    let file = field.parent_file();
    let info = file.file_descriptor_proto().source_code_info.as_ref().unwrap();
    let found = info.location.iter().find(|location| location.path == field.path());
    found.and_then(|location| location.leading_comments.clone()).unwrap_or_default()
}

/// The whole numbers of a text, in order.
fn numbers(text: &str) -> Vec<u32> {
    text.split(|c: char| !c.is_ascii_digit()).filter_map(|digits| digits.parse().ok()).collect()
}

#[test]
fn comments_name_the_limits_of_the_service() {
    let mut checked = 0;
    for (field, comment) in fields() {
        let expected = match field.name() {
            "page_size" => vec![1, MAX_PAGE_SIZE, DEFAULT_PAGE_SIZE, 0],
            "candidates" if comment.contains("most") => vec![MAX_PAGE_SIZE],
            _ => continue,
        };
        assert_eq!(numbers(&comment), expected, "the comment of {}: {comment}", field.full_name());
        checked += 1;
    }
    assert!(checked >= 9, "only {checked} comments name a limit");
}
