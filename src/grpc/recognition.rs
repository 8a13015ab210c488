//! `RecognitionService`.

use super::auth::as_caller;
use super::convert::recognition::{question, request};
use super::convert::{self, all};
use super::error::status;
use super::proto;
use crate::app::model::{AppError, ErrorKind, Observed, limits};
use crate::app::{App, UseCases};
use crate::framework::Feature;
use futures_util::StreamExt as _;
use futures_util::stream::{BoxStream, try_unfold};
use proto::recognition_service_server::RecognitionService;
use proto::recognize_online_request::Part;
use tonic::{Request, Response, Status, Streaming};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl RecognitionService for Service {
    type RecognizeOnlineStream = BoxStream<'static, Result<proto::Recognition, Status>>;

    async fn recognize(
        &self,
        message: Request<proto::RecognizeRequest>,
    ) -> Result<Response<proto::Recognition>, Status> {
        let app = as_caller(&self.0, &message)?;
        let wanted = request(message.into_inner()).map_err(status)?;
        let view = app.recognize(wanted).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn recognize_online(
        &self,
        message: Request<Streaming<proto::RecognizeOnlineRequest>>,
    ) -> Result<Response<Self::RecognizeOnlineStream>, Status> {
        let app = as_caller(&self.0, &message)?;
        let mut parts = message.into_inner();
        let first = parts.message().await?.and_then(|request| request.part);
        let Some(Part::Start(start)) = first else { return Err(status(out_of_order())) };
        let proto::RecognizeOnlineStart { question, features } = start;
        let session =
            Session { app, parts, question: question.unwrap_or_default(), features: all(features), seen: Vec::new() };
        Ok(Response::new(try_unfold(session, Session::next).boxed()))
    }
}

/// One online recognition: all rows so far, and the stream of further ones.
struct Session {
    app: UseCases,
    parts: Streaming<proto::RecognizeOnlineRequest>,
    question: proto::RecognitionQuestion,
    features: Vec<Feature>,
    seen: Vec<Vec<f64>>,
}

impl Session {
    /// The answer after the next message of samples; `None` at the end of the stream.
    async fn next(mut self) -> Result<Option<(proto::Recognition, Self)>, Status> {
        let Some(message) = self.parts.message().await? else { return Ok(None) };
        let Some(Part::Samples(proto::RecognizeOnlineSamples { rows })) = message.part else {
            return Err(status(out_of_order()));
        };
        if self.seen.len() + rows.len() > limits::MAX_RECOGNITION_ROWS {
            let most = limits::MAX_RECOGNITION_ROWS;
            let text = format!("an online recognition takes at most {most} rows: start another");
            return Err(status(AppError::new(ErrorKind::TooLarge, "too_many_rows", text)));
        }
        self.seen.extend(convert::rows("/rows", rows).map_err(status)?);
        let observed = Observed::Rows { features: self.features.clone(), rows: self.seen.clone() };
        let wanted = question(self.question.clone(), observed).map_err(status)?;
        let view = self.app.recognize(wanted).await.map_err(status)?;
        Ok(Some((view.into(), self)))
    }
}

fn out_of_order() -> AppError {
    AppError::new(ErrorKind::Malformed, "out_of_order", "send one start message, then samples")
}
