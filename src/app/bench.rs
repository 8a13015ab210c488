//! The service on test doubles, with resources to work on.

mod worker;

use crate::app::model::{CreateRobot, CreateWorld};
use crate::app::model::{
    DemonstrationId, GeneralizationRequest, RobotView, UploadDemonstration, UploadFile, UploadOptions, WorldView,
};
use crate::app::ports::{LocalEvents, MemoryStore, TestClock, TestIds};
use crate::app::{App, Caller, Ports, UseCases};
use crate::framework::generalization::Weighting;
use crate::framework::recognition::Metric;
use crate::reproduce::shipped;
use std::sync::Arc;

/// The service and the doubles it stands on.
pub(crate) struct Bench {
    pub app: UseCases,
    pub ports: Ports,
    pub store: Arc<MemoryStore>,
    pub clock: Arc<TestClock>,
    pub ids: Arc<TestIds>,
    pub events: Arc<LocalEvents>,
}

impl Bench {
    pub(crate) fn new() -> Self {
        let clock = Arc::new(TestClock::new());
        let store = Arc::new(MemoryStore::new(Arc::<TestClock>::clone(&clock)));
        let events = Arc::new(LocalEvents::new());
        let ids = Arc::new(TestIds::default());
        let ports = Ports {
            store: Arc::<MemoryStore>::clone(&store),
            clock: Arc::<TestClock>::clone(&clock),
            ids: Arc::<TestIds>::clone(&ids),
            events: Arc::<LocalEvents>::clone(&events),
        };
        let app = App::new(ports.clone()).on_behalf_of(Caller::LocalOperator);
        Self { app, ports, store, clock, ids, events }
    }

    /// Uploads 2 s of a straight line.
    pub(crate) async fn demonstration(&self) -> DemonstrationId {
        self.app.upload_demonstration(line()).await.unwrap().id
    }

    /// The robot of the paper's experiments.
    pub(crate) async fn robot(&self) -> RobotView {
        let problem = shipped::preset("wax").unwrap().problem;
        let request = CreateRobot { name: "arm".to_owned(), urdf: problem.urdf, spec: problem.robot };
        self.app.create_robot(request).await.unwrap()
    }

    /// A world that shows where the tool is.
    pub(crate) async fn world(&self) -> WorldView {
        let request = CreateWorld { name: "air".to_owned(), spec: shipped::preset("wax").unwrap().problem.world };
        self.app.create_world(request).await.unwrap()
    }
}

/// An upload of 2 s of a straight line.
pub(crate) fn line() -> UploadDemonstration {
    let rows: String = (0..=20).map(|sample| format!("{0},{0}\n", f64::from(sample) / 10.0)).collect();
    let bytes = format!("time_s,x [m]\n{rows}").into_bytes();
    let files = vec![UploadFile { file_name: "line.csv".to_owned(), bytes }];
    UploadDemonstration { name: Some("line".to_owned()), files, options: UploadOptions::default() }
}

/// A generalization of these demonstrations.
pub(crate) fn generalization(demonstrations: Vec<DemonstrationId>) -> GeneralizationRequest {
    GeneralizationRequest {
        name: "wipe".to_owned(),
        demonstrations,
        t_min_s: 0.5,
        weighting: Weighting::default(),
        features: None,
        metric: Metric::default(),
    }
}
