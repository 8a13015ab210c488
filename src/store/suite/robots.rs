//! Robots: versions counted, kept as long as jobs use them.

use super::fixtures::{job, robot};
use crate::app::ports::{Store, StoreError};

pub(crate) async fn counts_versions_and_keeps_what_jobs_name(store: &dyn Store) {
    let first = store.insert_robot(robot(1)).await.unwrap();
    let second = store.insert_robot(robot(2)).await.unwrap();
    assert_eq!((first.version, second.version), (1, 2));
    assert_eq!(store.robot(&second.id).await.unwrap(), second);
    assert_eq!(store.robot_urdf(&first.id).await.unwrap(), "<robot name='1'/>");
    let mut new = job(1);
    new.uses.robot = Some(first.id.clone());
    store.submit(new, None).await.unwrap();
    assert!(matches!(store.delete_robot(&first.id).await, Err(StoreError::InUse { count: 1, .. })));
    store.delete_robot(&second.id).await.unwrap();
    assert!(matches!(store.delete_robot(&second.id).await, Err(StoreError::NotFound { .. })));
}
