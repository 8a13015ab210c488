-- Times are milliseconds since 1970 (UTC). JSON columns hold what the service shows; columns beside them are what it
-- asks for. Ids are version 7 UUIDs with a prefix: a later one sorts after an earlier one.

CREATE TABLE instance (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    -- Counted up by every start of a server: what an earlier one held is an orphan.
    epoch INTEGER NOT NULL
) STRICT;
INSERT INTO instance (id, epoch) VALUES (1, 0);

CREATE TABLE demonstrations (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    revision INTEGER NOT NULL,
    excluded TEXT,
    sha256 TEXT NOT NULL,
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL,
    report TEXT NOT NULL
) STRICT;

CREATE INDEX demonstrations_by_content ON demonstrations (sha256);

CREATE TABLE demonstration_samples (
    demonstration_id TEXT PRIMARY KEY REFERENCES demonstrations (id) ON DELETE CASCADE,
    sha256 TEXT NOT NULL,
    data BLOB NOT NULL
) STRICT;

CREATE TABLE robots (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    version INTEGER NOT NULL,
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL,
    urdf TEXT NOT NULL,
    UNIQUE (name, version)
) STRICT;

CREATE TABLE worlds (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL
) STRICT;

CREATE TABLE jobs (
    id TEXT PRIMARY KEY,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    state TEXT NOT NULL,
    state_reason TEXT,
    state_since INTEGER NOT NULL,
    -- How often it was claimed, ever; and how often in a row without a checkpoint.
    attempt INTEGER NOT NULL,
    crashes INTEGER NOT NULL,
    last_seq INTEGER NOT NULL,
    progress TEXT NOT NULL,
    request TEXT NOT NULL,
    work TEXT NOT NULL,
    failure TEXT,
    created_at INTEGER NOT NULL,
    started_at INTEGER,
    finished_at INTEGER,
    -- The fence: every write of a worker names it. Present exactly while a worker holds the job.
    claim_token TEXT,
    claim_epoch INTEGER,
    -- Milliseconds of the holding server's monotonic clock; void in any other epoch.
    lease_until INTEGER,
    action_id TEXT,
    robot_id TEXT,
    world_id TEXT
) STRICT;
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_action ON jobs (action_id) WHERE action_id IS NOT NULL;
CREATE INDEX jobs_by_robot ON jobs (robot_id) WHERE robot_id IS NOT NULL;
CREATE INDEX jobs_by_world ON jobs (world_id) WHERE world_id IS NOT NULL;

-- Appended only.
CREATE TABLE job_events (
    job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    seq INTEGER NOT NULL,
    at INTEGER NOT NULL,
    terminal INTEGER NOT NULL CHECK (terminal IN (0, 1)),
    data TEXT NOT NULL,
    PRIMARY KEY (job_id, seq)
) STRICT, WITHOUT ROWID;
-- A job ends once, whatever a worker believes.
CREATE UNIQUE INDEX job_events_one_end ON job_events (job_id) WHERE terminal = 1;

CREATE TABLE checkpoints (
    job_id TEXT PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    at INTEGER NOT NULL,
    sha256 TEXT NOT NULL,
    data BLOB NOT NULL
) STRICT;

CREATE TABLE idempotency_keys (
    key TEXT PRIMARY KEY,
    body_sha256 TEXT NOT NULL,
    job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    created_at INTEGER NOT NULL
) STRICT;

CREATE TABLE actions (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    version INTEGER NOT NULL,
    job_id TEXT NOT NULL UNIQUE REFERENCES jobs (id),
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL,
    goals TEXT NOT NULL,
    UNIQUE (name, version)
) STRICT;

CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    job_id TEXT NOT NULL REFERENCES jobs (id),
    repetition INTEGER NOT NULL,
    seed INTEGER NOT NULL,
    evaluations INTEGER NOT NULL,
    discrepancy REAL NOT NULL,
    digest TEXT NOT NULL,
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL,
    -- A repetition is completed once.
    UNIQUE (job_id, repetition)
) STRICT;

CREATE TABLE run_goals (
    run_id TEXT PRIMARY KEY REFERENCES runs (id) ON DELETE CASCADE,
    goals TEXT NOT NULL,
    convergence TEXT NOT NULL
) STRICT;

CREATE TABLE trajectories (
    id TEXT PRIMARY KEY,
    run_id TEXT NOT NULL UNIQUE REFERENCES runs (id) ON DELETE CASCADE,
    created_at INTEGER NOT NULL,
    view TEXT NOT NULL
) STRICT;
