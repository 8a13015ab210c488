//! An example of every JSON body a client may send, at least one for each kind of job, world and observation.

use serde_json::{Map, Value, json};

const ACTION: &str = "act_0193c5a1f2b87c3d9e4f5a6b7c8d9e01";
const DEMONSTRATIONS: [&str; 2] = ["dem_0193c5a1f2b87c3d9e4f5a6b7c8d9e02", "dem_0193c5a1f2b87c3d9e4f5a6b7c8d9e03"];
const ROBOT: &str = "rob_0193c5a1f2b87c3d9e4f5a6b7c8d9e04";
const WORLD: &str = "wld_0193c5a1f2b87c3d9e4f5a6b7c8d9e05";

const URDF: &str = r#"<robot name="arm"><link name="base"/><link name="tool"/><joint name="turn" type="revolute"><parent link="base"/><child link="tool"/><axis xyz="0 0 1"/><limit lower="-1.5" upper="1.5" velocity="1" effort="1"/></joint></robot>"#;

/// A body for an operation.
struct Example {
    operation: &'static str,
    name: &'static str,
    summary: &'static str,
    body: Value,
}

impl Example {
    fn new(operation: &'static str, name: &'static str, summary: &'static str, body: Value) -> Self {
        Self { operation, name, summary, body }
    }
}

/// Adds the examples to the JSON bodies of `document`.
pub fn add(document: &mut Value) {
    let items = document["paths"].as_object_mut().into_iter().flat_map(Map::values_mut);
    for operation in items.filter_map(Value::as_object_mut).flat_map(Map::values_mut) {
        let id = operation["operationId"].as_str().unwrap_or_default();
        let own = all().into_iter().filter(|example| example.operation == id);
        let examples: Map<String, Value> = own
            .map(|example| (example.name.to_owned(), json!({"summary": example.summary, "value": example.body})))
            .collect();
        if let Some(media) = operation.pointer_mut("/requestBody/content/application~1json")
            && !examples.is_empty()
        {
            media["examples"] = Value::Object(examples);
        }
    }
}

fn all() -> Vec<Example> {
    let mut all = resources();
    all.extend(jobs());
    all
}

fn resources() -> Vec<Example> {
    let grid = json!({"kind": "coverage", "origin_m": [0.6, -0.8, 0.32], "column_step_m": [0, 0.2, 0],
        "row_step_m": [0, 0, 0.2], "columns": 4, "rows": 4, "radius_m": 0.13});
    let rows = json!({"kind": "rows", "features": [{"name": "x", "unit": "mm"}], "rows": [[0], [12.5], [31]]});
    let stored = json!({"kind": "demonstration", "demonstration": DEMONSTRATIONS[0]});
    vec![
        Example::new(
            "patchDemonstration",
            "exclude",
            "Leave a demonstration out of new actions",
            json!({"excluded": "the cloth slipped"}),
        ),
        Example::new(
            "createRobot",
            "chain",
            "A URDF with one free joint",
            json!({"name": "arm", "urdf": URDF, "spec": {"free_joints": ["turn"], "acceleration": {"turn": 2}}}),
        ),
        Example::new(
            "createWorld",
            "tool_position",
            "A world that observes the tool's position",
            json!({"name": "table", "spec": {"kind": "tool_position", "unit": "mm"}}),
        ),
        Example::new(
            "createWorld",
            "coverage",
            "A wall of 4 x 4 cells to be painted",
            json!({"name": "wall", "spec": grid}),
        ),
        Example::new("recognize", "rows", "Observed rows", json!({"observed": rows})),
        Example::new(
            "recognize",
            "demonstration",
            "An uploaded demonstration against one action",
            json!({"observed": stored, "candidates": [ACTION], "threshold": 0.3}),
        ),
    ]
}

fn jobs() -> Vec<Example> {
    let generalization = json!({"name": "wax", "demonstrations": DEMONSTRATIONS, "t_min_s": 1});
    let model = json!({"action": ACTION, "robot": ROBOT, "world": WORLD, "seed": 1,
        "execution": {"method": {"name": "model", "max_step_deg": 20}, "tolerance": 30}});
    let simulated = json!({"action": ACTION, "robot": ROBOT, "world": WORLD, "repetitions": 10,
        "execution": {"method": {"name": "sst", "population": 50, "stagnation": 3}}});
    let paper = json!({"paper_table": 1, "repetitions": 50, "seed": 1000});
    let methods = json!([{"name": "SST", "method": "sst"}, {"name": "CMA-ES", "method": "cma_es"}]);
    let matrix = json!({"name": "two methods", "repetitions": 20,
        "matrix": {"presets": ["wax"], "methods": methods}});
    let of_kind = |kind: &str, body: &Value| {
        let mut body = body.clone();
        body["kind"] = Value::from(kind);
        body
    };
    let mut all = vec![
        Example::new("createAction", "two_demonstrations", "Goals one second apart", generalization.clone()),
        Example::new("createExperiment", "paper_table", "Table 1 of the paper", paper.clone()),
        Example::new("createExperiment", "matrix", "Two methods on one task", matrix),
    ];
    for operation in ["createJob", "validateJob"] {
        all.extend([
            Example::new(
                operation,
                "generalization",
                "Generalize demonstrations into an action",
                of_kind("generalization", &generalization),
            ),
            Example::new(
                operation,
                "few_trials",
                "A few trials, each joint at most 20 degrees from the last pose",
                of_kind("execution", &model),
            ),
            Example::new(
                operation,
                "in_simulation",
                "Ten runs of a method for simulation",
                of_kind("execution", &simulated),
            ),
            Example::new(operation, "experiment", "Table 1 of the paper", of_kind("experiment", &paper)),
        ]);
    }
    all
}

#[cfg(test)]
mod tests {
    use crate::app::model::{
        CreateJob, CreateRobot, CreateWorld, ExperimentRequest, GeneralizationRequest, PatchDemonstration,
        RecognizeRequest,
    };
    use crate::app::strict_json::parse;

    #[test]
    fn every_json_body_has_examples_and_all_of_them_are_read() {
        let document = super::super::super::document();
        let items = document["paths"].as_object().unwrap().values();
        for operation in items.flat_map(|item| item.as_object().unwrap().values()) {
            let id = operation["operationId"].as_str().unwrap();
            let Some(media) = operation.pointer("/requestBody/content/application~1json") else { continue };
            let examples = media["examples"].as_object().unwrap_or_else(|| panic!("{id} has no example"));
            for example in examples.values() {
                let bytes = example["value"].to_string().into_bytes();
                let read = match id {
                    "createAction" => parse::<GeneralizationRequest>(&bytes).map(drop),
                    "createExperiment" => parse::<ExperimentRequest>(&bytes).map(drop),
                    "createJob" | "validateJob" => parse::<CreateJob>(&bytes).map(drop),
                    "createRobot" => parse::<CreateRobot>(&bytes).map(drop),
                    "createWorld" => parse::<CreateWorld>(&bytes).map(drop),
                    "patchDemonstration" => parse::<PatchDemonstration>(&bytes).map(drop),
                    "recognize" => parse::<RecognizeRequest>(&bytes).map(drop),
                    id => panic!("say what {id} reads"),
                };
                read.unwrap_or_else(|error| panic!("{id}: {error}"));
            }
        }
    }
}
