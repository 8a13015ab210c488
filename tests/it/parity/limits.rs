//! The numbers in the comments of `proto/` are the limits that the service enforces.

use super::messages::{PACKAGE, pool};
use cgda::app::model::limits;
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

fn bounds(range: &std::ops::RangeInclusive<u32>) -> [u32; 2] {
    [*range.start(), *range.end()]
}

/// The numbers that the comment of a field names; `None` if it names no limit.
fn expected(message: &str, field: &str) -> Option<Vec<u32>> {
    let [least_page, largest_page] = bounds(&limits::PAGE_SIZE);
    let [least_batch, largest_batch] = bounds(&limits::TRAJECTORY_BATCH);
    Some(match (message, field) {
        (_, "page_size") => vec![least_page, largest_page, limits::DEFAULT_PAGE_SIZE, 0],
        (_, "idempotency_key") => vec![*limits::IDEMPOTENCY_KEY_CHARS.end()],
        ("Execution", "repetitions") => [&bounds(&limits::REPETITIONS)[..], &[1, 0]].concat(),
        ("Execution" | "ExperimentSpec", "seed") => vec![2, limits::SEED_BOUND.ilog2()],
        ("GetDemonstrationSamplesRequest", "max_points") => {
            [&bounds(&limits::SAMPLE_POINTS)[..], &[limits::DEFAULT_POINTS]].concat()
        }
        ("GetRunConvergenceRequest", "max_points") => {
            [&bounds(&limits::CONVERGENCE_POINTS)[..], &[limits::DEFAULT_POINTS]].concat()
        }
        ("InterpolateActionRequest", "n") => bounds(&limits::INTERPOLATION_POINTS).to_vec(),
        ("RecognitionQuestion", "candidates") => vec![limits::MAX_CANDIDATES],
        ("StreamTrajectoryRequest", "batch") => vec![least_batch, largest_batch, limits::DEFAULT_TRAJECTORY_BATCH, 0],
        ("WaitJobRequest", "timeout_ms") => vec![limits::MAX_WAIT_MS, limits::DEFAULT_WAIT_MS, 0],
        _ => return None,
    })
}

#[test]
fn comments_name_the_limits_of_the_service() {
    let mut checked = 0;
    for (field, comment) in fields() {
        let Some(expected) = expected(field.parent_message().name(), field.name()) else { continue };
        assert_eq!(numbers(&comment), expected, "the comment of {}: {comment}", field.full_name());
        checked += 1;
    }
    assert!(checked >= 21, "only {checked} comments name a limit");
}
