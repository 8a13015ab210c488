// Short names for the schemas of the REST API that this dashboard uses.

import type { components } from "./schema";

type Schemas = components["schemas"];

export type Action = Schemas["ActionView"];
export type CreateJob = Schemas["CreateJob"];
export type Demonstration = Schemas["DemonstrationView"];
export type EarlierRun = Schemas["EarlierRun"];
export type ExecutionSpec = Schemas["ExecutionSpec"];
export type ExperimentTable = Schemas["ExperimentTable"];
export type Feature = Schemas["Feature"];
export type FieldError = Schemas["FieldError"];
export type Finding = Schemas["Finding"];
export type GoalProgress = Schemas["GoalProgress"];
export type Judgement = Schemas["Judgement"];
export type RunVerdict = Schemas["RunVerdict"];
export type Job = Schemas["JobView"];
export type JobEvent = Schemas["JobEvent"];
export type JobProgress = Schemas["JobProgress"];
export type JobState = Schemas["JobState"];
export type Method = Schemas["MethodView"];
export type MethodChoice = Schemas["MethodChoice"];
export type Metric = Schemas["Metric"];
export type Parameter = Schemas["ParameterView"];
export type PlanSpec = Schemas["PlanSpec"];
export type PlanTiming = Schemas["PlanTiming"];
export type Robot = Schemas["RobotView"];
export type Run = Schemas["RunView"];
export type RunGoals = Schemas["RunGoals"];
export type Series = Schemas["Series"];
export type TrialProgress = Schemas["TrialProgress"];
export type Trajectory = Schemas["TrajectoryView"];
export type Weighting = Schemas["Weighting"];
export type World = Schemas["WorldView"];
export type WorldSpec = Schemas["WorldSpec"];
