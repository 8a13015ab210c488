//! Promises of every engine behind the Store port: one function each, run on a fresh store.

pub(in crate::store) mod demonstrations;
pub(in crate::store) mod experiments;
mod fixtures;
pub(in crate::store) mod jobs;
mod memory;
pub(in crate::store) mod queue;
pub(in crate::store) mod robots;
pub(in crate::store) mod runs;

/// One test per promise; `$fresh` opens an empty store and returns it with the guard that keeps it alive.
macro_rules! conformance {
    ($fresh:expr) => {
        $crate::store::suite::conformance! { $fresh;
            demonstrations::keeps_demonstrations_until_deleted,
            demonstrations::changes_a_demonstration_only_at_the_revision_named,
            demonstrations::pages_lists_newest_first_without_gap_or_repeat,
            robots::counts_versions_and_keeps_what_jobs_name,
            jobs::submits_once_a_key,
            jobs::lists_jobs_by_state_and_kind,
            jobs::numbers_events_and_tells_unknown_positions,
            jobs::steers_jobs_as_the_machine_allows,
            queue::gives_the_oldest_job_to_one_worker,
            queue::writes_nothing_for_a_lost_claim,
            queue::gives_back_the_last_checkpoint,
            queue::quarantines_only_jobs_that_crash_without_progress,
            queue::takes_back_jobs_whose_lease_ran_out,
            runs::writes_a_step_whole_or_not_at_all,
            runs::ends_a_job_once_with_its_results,
            experiments::keeps_an_experiment_with_its_job_and_its_rows_with_the_claim,
        }
    };
    ($fresh:expr; $($resource:ident::$promise:ident,)*) => {$(
        #[tokio::test]
        async fn $promise() {
            let (_keep, store) = $fresh.await;
            $crate::store::suite::$resource::$promise(&store).await;
        }
    )*};
}
pub(crate) use conformance;
