//! Demonstrations: kept, changed at the revision named, listed.

use super::fixtures::{demonstration, page};
use crate::app::model::PatchDemonstration;
use crate::app::ports::{Store, StoreError};

pub(crate) async fn keeps_demonstrations_until_deleted(store: &dyn Store) {
    let new = demonstration(1);
    let id = new.view.id.clone();
    store.insert_demonstration(new.clone()).await.unwrap();
    assert_eq!(store.demonstration(&id).await.unwrap(), new.view);
    assert_eq!(store.demonstration_report(&id).await.unwrap(), new.report);
    assert_eq!(store.demonstration_samples(&id).await.unwrap(), new.samples);
    assert_eq!(store.demonstrations_with_content("same").await.unwrap(), std::slice::from_ref(&id));
    store.delete_demonstration(&id, Some(1)).await.unwrap();
    assert!(matches!(store.demonstration_samples(&id).await, Err(StoreError::NotFound { .. })));
    assert!(matches!(store.delete_demonstration(&id, None).await, Err(StoreError::NotFound { .. })));
}

pub(crate) async fn changes_a_demonstration_only_at_the_revision_named(store: &dyn Store) {
    let new = demonstration(1);
    let id = new.view.id.clone();
    store.insert_demonstration(new).await.unwrap();
    let patch = |excluded: &str| PatchDemonstration { name: None, excluded: Some(excluded.to_owned()) };
    let view = store.patch_demonstration(&id, patch("noisy"), Some(1)).await.unwrap();
    assert_eq!((view.revision, view.excluded.as_deref()), (2, Some("noisy")));
    let stale = store.patch_demonstration(&id, patch("again"), Some(1)).await;
    assert!(matches!(stale, Err(StoreError::Revision { present: 2, expected: 1, .. })));
    assert_eq!(store.patch_demonstration(&id, patch(""), None).await.unwrap().excluded, None);
    assert!(matches!(store.delete_demonstration(&id, Some(1)).await, Err(StoreError::Revision { .. })));
}

pub(crate) async fn pages_lists_newest_first_without_gap_or_repeat(store: &dyn Store) {
    for number in 1..=5 {
        store.insert_demonstration(demonstration(number)).await.unwrap();
    }
    let mut names = Vec::new();
    let mut token = String::new();
    loop {
        let keyset = page(2, &token);
        let found = keyset.page(store.demonstrations(&keyset).await.unwrap(), |view| view.id.to_string());
        assert!(found.items.len() <= 2);
        names.extend(found.items.into_iter().map(|view| view.name));
        token = found.next_page_token;
        if token.is_empty() {
            break;
        }
    }
    assert_eq!(names, ["d5", "d4", "d3", "d2", "d1"]);
}
