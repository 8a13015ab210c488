//! Robots: a URDF and the chain selected from it; every version is immutable.

use crate::app::model::{AppError, CreateRobot, Keyset, Page, PageQuery, RobotId, RobotView};
use crate::app::ports::NewRobot;
use crate::app::{UseCases, chain_text, check_name, compute};
use crate::framework::robot::{Chain, ChainSummary, RobotModel, RobotSpec, RobotSummary, summarize, summarize_chain};
use sha2::{Digest as _, Sha256};

fn read(urdf: &str, spec: &RobotSpec) -> Result<(RobotSummary, ChainSummary), AppError> {
    let model =
        RobotModel::from_urdf(urdf).map_err(|error| AppError::field("/urdf", "invalid_urdf", chain_text(&error)))?;
    let chain =
        Chain::new(&model, spec).map_err(|error| AppError::field("/spec", "invalid_chain", chain_text(&error)))?;
    Ok((summarize(&model), summarize_chain(&chain)))
}

impl UseCases {
    /// Checks and stores a robot.
    ///
    /// # Errors
    /// `Invalid` if the URDF or the chain is invalid.
    pub async fn create_robot(&self, request: CreateRobot) -> Result<RobotView, AppError> {
        let CreateRobot { name, urdf, spec } = request;
        check_name("/name", &name)?;
        let (urdf, spec, read) = compute(move || {
            let read = read(&urdf, &spec);
            (urdf, spec, read)
        })
        .await?;
        let (summary, chain) = read?;
        let view = RobotView {
            id: RobotId::from_uuid(self.ports.ids.uuid()),
            name,
            version: 0,
            spec,
            chain,
            summary,
            urdf_sha256: hex::encode(Sha256::digest(urdf.as_bytes())),
            created_at: self.now(),
        };
        Ok(self.ports.store.insert_robot(NewRobot { view, urdf }).await?)
    }

    /// Lists robots, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_robots(&self, page: PageQuery) -> Result<Page<RobotView>, AppError> {
        let keyset = Keyset::new(&page, "robots")?;
        let robots = self.ports.store.robots(&keyset).await?;
        Ok(keyset.page(robots, |robot| robot.id.to_string()))
    }

    /// Reads one robot.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_robot(&self, id: &RobotId) -> Result<RobotView, AppError> {
        Ok(self.ports.store.robot(id).await?)
    }

    /// Reads a robot's URDF, as uploaded.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn robot_urdf(&self, id: &RobotId) -> Result<String, AppError> {
        Ok(self.ports.store.robot_urdf(id).await?)
    }

    /// Deletes a robot unless a job uses it.
    ///
    /// # Errors
    /// `NotFound`; `Conflict` if jobs use it.
    pub async fn delete_robot(&self, id: &RobotId) -> Result<(), AppError> {
        Ok(self.ports.store.delete_robot(id).await?)
    }
}

#[cfg(test)]
mod tests {
    use crate::app::bench::Bench;
    use crate::app::model::{CreateRobot, ErrorKind, PageQuery};
    use crate::framework::robot::RobotSpec;
    use sha2::{Digest as _, Sha256};

    #[tokio::test]
    async fn a_robot_is_summarised_and_its_urdf_kept_as_uploaded() {
        let bench = Bench::new();
        let robot = bench.robot().await;
        let urdf = bench.app.robot_urdf(&robot.id).await.unwrap();
        assert_eq!(robot.urdf_sha256, hex::encode(Sha256::digest(urdf.as_bytes())));
        assert_eq!((robot.version, robot.chain.free_joints.len()), (1, 3));
        assert_eq!(bench.robot().await.version, 2);
        assert_eq!(bench.app.list_robots(PageQuery::default()).await.unwrap().items.len(), 2);
    }

    #[tokio::test]
    async fn an_error_in_urdf_and_in_chain_is_told_by_its_place() {
        let bench = Bench::new();
        let urdf = bench.app.robot_urdf(&bench.robot().await.id).await.unwrap();
        let nowhere = RobotSpec { tip_link: Some("nowhere".to_owned()), ..RobotSpec::default() };
        let cases = [
            ("/name", CreateRobot { name: String::new(), urdf: urdf.clone(), spec: RobotSpec::default() }),
            ("/urdf", CreateRobot { name: "r".to_owned(), urdf: "<robot".to_owned(), spec: RobotSpec::default() }),
            ("/spec", CreateRobot { name: "r".to_owned(), urdf, spec: nowhere }),
        ];
        for (place, request) in cases {
            let error = bench.app.create_robot(request).await.unwrap_err();
            assert_eq!((error.kind, error.details[0].pointer.as_str()), (ErrorKind::Invalid, place), "{error}");
        }
    }

    #[tokio::test]
    async fn a_robot_in_use_is_not_deleted() {
        let bench = Bench::new();
        let spare = bench.robot().await;
        let used = bench.run(false).await.robot;
        let error = bench.app.delete_robot(&used).await.unwrap_err();
        assert_eq!((error.kind, error.code), (ErrorKind::Conflict, "in_use"));
        bench.app.delete_robot(&spare.id).await.unwrap();
        assert_eq!(bench.app.get_robot(&spare.id).await.unwrap_err().kind, ErrorKind::NotFound);
    }
}
