//! Tables of how the two protocols say the same thing differently, and of what only one of them says, each with its
//! reason. An exception that no longer applies fails the tests, so these tables cannot grow stale.

/// Operations of REST without an rpc of ours.
pub const REST_ONLY_OPERATIONS: &[(&str, &str)] = &[
    ("livez", "grpc.health.v1.Health answers over gRPC"),
    ("readyz", "grpc.health.v1.Health answers over gRPC"),
    ("getOpenapi", "server reflection describes gRPC"),
];

/// Rpcs without an operation of REST.
pub const GRPC_ONLY_OPERATIONS: &[(&str, &str)] = &[
    ("WaitJob", "a long poll for clients that cannot hold a stream; a REST client reads the events"),
    ("RecognizeOnline", "needs a stream in both directions"),
    ("StreamTrajectory", "sends the points that REST answers with the trajectory"),
];

/// Operations of REST whose rpc has another name.
pub const RENAMED_OPERATIONS: &[(&str, &str)] = &[("uploadDemonstration", "Upload")];

/// Operations of REST whose body is one field of the request message.
pub const BODY_FIELDS: &[(&str, &str)] = &[
    ("createAction", "generalization"),
    ("createExperiment", "experiment"),
    ("createJob", "work"),
    ("validateJob", "work"),
];

/// Requests whose message is another one than the rpc's: a client stream begins with it.
pub const FIRST_MESSAGES: &[(&str, &str)] = &[("uploadDemonstration", "UploadHeader")];

/// Parameters and headers of REST with another name in the message.
pub const RENAMED_PARAMETERS: &[(&str, &str)] = &[
    ("Idempotency-Key", "idempotency_key"),
    ("If-Match", "revision"),
    ("Last-Event-ID", "after_seq"),
    ("state", "states"),
    ("from", "from_s"),
    ("to", "to_s"),
];

/// Messages that stand for an array of REST: their only field is the array.
pub const LISTS: &[&str] = &["Row", "EarlierRuns"];

/// Messages that stand for an array of fixed length of REST: their fields, by number, are its items.
pub const TUPLES: &[&str] = &["Interval", "JointLimits", "NamePair", "PathStep"];

/// Messages whose fields REST has one level higher.
pub const FLATTENED: &[&str] = &["RecognizeRequest.question"];

/// Unions of REST whose variants repeat the fields of the whole.
pub const REPEATED: &[&str] = &["JobEvent"];

/// Oneofs that REST has as a field of their name.
pub const FIELDS: &[&str] = &["RecognizeRequest.observed"];

/// Oneofs of which REST has the members as alternatives of one field.
pub const ALTERNATIVES: &[&str] = &["ExecutionSpec.method_choice"];

/// The field that selects the variant of a oneof in JSON; `kind` for others.
pub const TAGS: &[(&str, &str)] = &[
    ("Geometry", "shape"),
    ("HandlingSpec", "strategy"),
    ("JobEvent", "type"),
    ("MethodSpec", "name"),
    ("RobotPoint", "at"),
];

/// Members of a oneof that REST keeps below a field of their name; it spreads those of others.
pub const NESTED: &[&str] = &["JobEvent.goal", "JobEvent.progress", "JobEvent.trial"];

/// Fields that one description has alone, and fields of another type.
pub const FIELDS_APART: &[(&str, &str)] = &[
    ("gRPC only: CovarianceAdaptation.cold_start", "an absent number is the default, so that `null` needs a field"),
    ("gRPC only: ExecutionSpec.method_name", "REST takes a name in place of the object"),
    ("gRPC only: Trajectory.point_count", "the points come from StreamTrajectory"),
    ("REST only: Trajectory.points", "the points come from StreamTrajectory"),
    ("gRPC only: Trial.observed", "an empty list and an absent one are the same in a message"),
    ("REST only: UploadHeader.file_name", "each file of the stream begins with its name"),
    ("type of: Finding.code", "an open list of codes is text"),
];

/// Values that REST leaves out because they are the default.
pub const LEFT_OUT: &[(&str, &str)] = &[("observes", "percent"), ("on_infeasible", "stop"), ("side", "inside")];
