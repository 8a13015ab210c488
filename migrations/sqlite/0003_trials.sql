-- Every trial of the runs whose method remembers them, so that a later run on the same robot can begin with them.

CREATE TABLE run_trials (
    run_id TEXT PRIMARY KEY REFERENCES runs (id) ON DELETE CASCADE,
    -- Digest of all that decides what a pose shows: robot, tool, world, features. Absent where that changes with time.
    setting TEXT,
    trials TEXT NOT NULL
) STRICT;
CREATE INDEX run_trials_by_setting ON run_trials (setting, run_id) WHERE setting IS NOT NULL;
