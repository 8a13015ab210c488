-- An experiment is its plan and the rows of its finished runs; where it stands is told by its job.

CREATE TABLE experiments (
    id TEXT PRIMARY KEY,
    job_id TEXT NOT NULL UNIQUE REFERENCES jobs (id),
    created_at INTEGER NOT NULL,
    -- Rows in experiment_rows, counted in the transaction that writes them.
    finished_runs INTEGER NOT NULL,
    view TEXT NOT NULL,
    plan TEXT NOT NULL
) STRICT;

CREATE TABLE experiment_rows (
    experiment_id TEXT NOT NULL REFERENCES experiments (id) ON DELETE CASCADE,
    cell INTEGER NOT NULL,
    repetition INTEGER NOT NULL,
    data TEXT NOT NULL,
    -- A run is completed once.
    PRIMARY KEY (experiment_id, cell, repetition)
) STRICT, WITHOUT ROWID;
