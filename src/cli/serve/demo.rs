//! Content of `--demo`. Everything goes through the service as if a user had done it, so that everything shown was
//! really computed.

use crate::app::UseCases;
use crate::app::model::{
    ActionId, AppError, CreateJob, CreateRobot, CreateWorld, DemonstrationId, ErrorKind, ExecutionRequest,
    GeneralizationRequest, JobFilter, JobId, PageQuery, RobotId, UploadDemonstration, UploadFile, UploadOptions,
    WorldId,
};
use crate::framework::generalization::Weighting;
use crate::framework::preset::Preset;
use crate::framework::recognition::Metric;
use crate::reproduce::shipped;
use std::time::Duration;

/// A shipped demonstration: name and bytes.
type Shipped = (&'static str, &'static [u8]);

const WAX: [Shipped; 4] = [
    ("wax 1", include_bytes!("../../../examples/demonstrations/wax/demo-1.csv")),
    ("wax 2", include_bytes!("../../../examples/demonstrations/wax/demo-2.csv")),
    ("wax 3", include_bytes!("../../../examples/demonstrations/wax/demo-3.csv")),
    ("wax 4", include_bytes!("../../../examples/demonstrations/wax/demo-4.csv")),
];
const PAINT: [Shipped; 4] = [
    ("paint 1", include_bytes!("../../../examples/demonstrations/paint/demo-1.csv")),
    ("paint 2", include_bytes!("../../../examples/demonstrations/paint/demo-2.csv")),
    ("paint 3", include_bytes!("../../../examples/demonstrations/paint/demo-3.csv")),
    ("paint 4", include_bytes!("../../../examples/demonstrations/paint/demo-4.csv")),
];

/// One action of the demo, with its robot, world and method.
struct Scene {
    /// Name of the action.
    action: &'static str,
    demonstrations: [Shipped; 4],
    preset: &'static str,
    world: &'static str,
    seed: u64,
    /// Slow enough to watch.
    evaluations_per_s: f64,
}

const SCENES: [Scene; 2] = [
    Scene {
        action: "wax",
        demonstrations: WAX,
        preset: "wax",
        world: "tool position, mm",
        seed: 1,
        evaluations_per_s: 1500.0,
    },
    Scene {
        action: "paint",
        demonstrations: PAINT,
        preset: "paint",
        world: "wall of 4 x 4 squares",
        seed: 1,
        evaluations_per_s: 150.0,
    },
];

/// Time between two goals of the shipped demonstrations, s.
const T_MIN_S: f64 = 1.0;

/// Fills an empty database; does nothing if it is not empty.
pub(super) async fn fill(app: UseCases) {
    match fill_if_empty(&app).await {
        Ok(true) => tracing::info!("submitted the demo's jobs"),
        Ok(false) => tracing::info!("the database is not empty: the demo is not added"),
        Err(error) => tracing::error!(error = %error, cause = ?error.source, "the demo could not be set up"),
    }
}

async fn fill_if_empty(app: &UseCases) -> Result<bool, AppError> {
    let one = || PageQuery { page_size: Some(1), page_token: None };
    let empty = app.list_demonstrations(one()).await?.items.is_empty()
        && app.list_jobs(JobFilter::default(), one()).await?.items.is_empty()
        && app.list_robots(one()).await?.items.is_empty();
    if !empty {
        return Ok(false);
    }
    let mut robot = None;
    for scene in &SCENES {
        let preset = shipped::preset(scene.preset).map_err(AppError::internal)?;
        let robot = match &robot {
            Some(robot) => robot,
            None => robot.insert(create_robot(app, &preset).await?),
        };
        let spec = preset.problem.world.clone();
        let world = app.create_world(CreateWorld { name: scene.world.to_owned(), spec }).await?;
        let demonstrations = upload(app, &scene.demonstrations).await?;
        let action = generalize(app, scene.action, demonstrations).await?;
        execute(app, scene, preset, action, robot.clone(), world.id).await?;
    }
    Ok(true)
}

async fn create_robot(app: &UseCases, preset: &Preset) -> Result<RobotId, AppError> {
    let (urdf, spec) = (preset.problem.urdf.clone(), preset.problem.robot.clone());
    Ok(app.create_robot(CreateRobot { name: "TEO, right arm".to_owned(), urdf, spec }).await?.id)
}

async fn upload(app: &UseCases, shipped: &[Shipped]) -> Result<Vec<DemonstrationId>, AppError> {
    let mut uploaded = Vec::with_capacity(shipped.len());
    for (name, bytes) in shipped {
        let upload = UploadDemonstration {
            name: Some((*name).to_owned()),
            files: vec![UploadFile { file_name: format!("{name}.csv"), bytes: bytes.to_vec() }],
            options: UploadOptions::default(),
        };
        uploaded.push(app.upload_demonstration(upload).await?.id);
    }
    Ok(uploaded)
}

async fn generalize(app: &UseCases, name: &str, demonstrations: Vec<DemonstrationId>) -> Result<ActionId, AppError> {
    let request = GeneralizationRequest {
        name: name.to_owned(),
        demonstrations,
        t_min_s: T_MIN_S,
        weighting: Weighting::default(),
        features: None,
        metric: Metric::default(),
    };
    let job = app.create_action(request, None).await?;
    made(app, &job.id).await
}

/// The action of a generalization, once the job has succeeded.
async fn made(app: &UseCases, id: &JobId) -> Result<ActionId, AppError> {
    let mut seen = 0;
    loop {
        let job = app.wait_job(id, seen, Duration::from_secs(10)).await?;
        if let Some(action) = job.result.action {
            return Ok(action);
        }
        if job.state.is_final() {
            let why = job.state_reason.unwrap_or_default();
            return Err(AppError::new(
                ErrorKind::Conflict,
                "no_action",
                format!("{id} did not create an action: {why}"),
            ));
        }
        seen = job.last_seq;
    }
}

async fn execute(
    app: &UseCases,
    scene: &Scene,
    preset: Preset,
    action: ActionId,
    robot: RobotId,
    world: WorldId,
) -> Result<(), AppError> {
    let request = ExecutionRequest {
        name: Some(format!("{} with the right arm of TEO", scene.action)),
        action,
        robot,
        world,
        execution: preset.problem.execution,
        seed: Some(scene.seed),
        repetitions: 1,
        max_evaluations_per_s: Some(scene.evaluations_per_s),
        earlier_runs: None,
        planning: None,
        avoid_collisions: Some(true),
    };
    app.create_job(CreateJob::Execution(Box::new(request)), None).await.map(drop)
}
