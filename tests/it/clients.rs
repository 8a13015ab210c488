//! Clients of the server: reqwest over HTTP, tonic over gRPC, both with the server's token.

use super::server::Server;
use cgda::grpc::proto::action_service_client::ActionServiceClient;
use cgda::grpc::proto::demonstration_service_client::DemonstrationServiceClient;
use cgda::grpc::proto::experiment_service_client::ExperimentServiceClient;
use cgda::grpc::proto::job_service_client::JobServiceClient;
use cgda::grpc::proto::recognition_service_client::RecognitionServiceClient;
use cgda::grpc::proto::robot_service_client::RobotServiceClient;
use cgda::grpc::proto::run_service_client::RunServiceClient;
use cgda::grpc::proto::trajectory_service_client::TrajectoryServiceClient;
use cgda::grpc::proto::world_service_client::WorldServiceClient;
use prost::Message as _;
use prost_reflect::bytes::{Buf as _, BufMut as _};
use prost_reflect::{DynamicMessage, MethodDescriptor};
use reqwest::{Method, RequestBuilder};
use serde_json::Value;
use std::sync::LazyLock;
use tonic::Status;
use tonic::codec::{Codec, DecodeBuf, Decoder, EncodeBuf, Encoder};
use tonic::codegen::http::uri::PathAndQuery;
use tonic::metadata::{Ascii, MetadataValue};
use tonic::service::Interceptor;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::{Channel, Endpoint};

/// HTTP client.
pub struct Http {
    client: reqwest::Client,
    address: String,
    token: String,
}

/// Status, content type and JSON body (null if the body is not JSON).
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub headers: reqwest::header::HeaderMap,
    pub text: String,
    pub json: Value,
}

impl Answer {
    /// The text at a JSON pointer.
    pub fn text(&self, pointer: &str) -> &str {
        self.json.pointer(pointer).and_then(Value::as_str).unwrap_or_else(|| panic!("no {pointer} in {}", self.text))
    }

    /// Asserts the status.
    pub fn expect(self, status: u16) -> Self {
        assert_eq!(self.status, status, "{}", self.text);
        self
    }

    /// Asserts that the answer is a problem with that status and code.
    pub fn expect_problem(self, status: u16, code: &str) -> Self {
        assert_eq!((self.status, self.json["code"].as_str()), (status, Some(code)), "{}", self.text);
        assert_eq!(self.headers["content-type"], "application/problem+json");
        assert_eq!(self.json["status"], status);
        assert_eq!(self.json["request_id"].as_str().unwrap(), self.headers["x-request-id"]);
        self
    }
}

impl Http {
    pub fn new(server: &Server) -> Self {
        let client = reqwest::Client::builder().redirect(reqwest::redirect::Policy::none()).build().unwrap();
        Self { client, address: server.address.clone(), token: server.token.clone() }
    }

    /// A request without credentials; `path` is relative to the root.
    pub fn bare(&self, method: Method, path: &str) -> RequestBuilder {
        self.client.request(method, format!("http://{}{path}", self.address))
    }

    /// A request with the token; `path` is relative to the API.
    pub fn request(&self, method: Method, path: &str) -> RequestBuilder {
        self.bare(method, &format!("/api/v1{path}")).bearer_auth(&self.token)
    }

    pub async fn get(&self, path: &str) -> Answer {
        send(self.request(Method::GET, path)).await
    }

    pub async fn post(&self, path: &str, body: &Value) -> Answer {
        send(self.request(Method::POST, path).json(body)).await
    }
}

/// Sends a request and reads the whole answer, whose status the OpenAPI document must list.
pub async fn send(request: RequestBuilder) -> Answer {
    let (client, request) = request.build_split();
    let request = request.unwrap();
    let (method, path) = (request.method().clone(), request.url().path().to_owned());
    let response = client.execute(request).await.unwrap();
    let (status, headers) = (response.status().as_u16(), response.headers().clone());
    let documented = documented(&method, &path);
    let known = documented.as_ref().is_none_or(|statuses| statuses.contains(&status.to_string()));
    assert!(known, "{method} {path}: {status} is not among {documented:?}");
    let text = response.text().await.unwrap();
    let json = serde_json::from_str(&text).unwrap_or_default();
    Answer { status, headers, text, json }
}

/// The statuses that the OpenAPI document lists for a request; `None` if it has no such operation.
fn documented(method: &Method, path: &str) -> Option<Vec<String>> {
    static DOCUMENT: LazyLock<Value> = LazyLock::new(cgda::http::document);
    let segments = |path: &str| -> Vec<String> {
        let parts = path.replacen(':', "/:", 1);
        parts.split('/').map(str::to_owned).collect()
    };
    let given = segments(path);
    let fits = |documented: &str| {
        let documented = segments(documented);
        documented.len() == given.len()
            && documented.iter().zip(&given).all(|(part, segment)| part == segment || part == "{id}")
    };
    let item = DOCUMENT["paths"].as_object().unwrap().iter().find(|(path, _)| fits(path))?.1;
    let responses = item.get(method.as_str().to_lowercase())?["responses"].as_object().unwrap();
    Some(responses.keys().cloned().collect())
}

/// Adds the token to the metadata.
#[derive(Clone)]
pub struct Token(MetadataValue<Ascii>);

impl Interceptor for Token {
    fn call(&mut self, mut request: tonic::Request<()>) -> Result<tonic::Request<()>, Status> {
        request.metadata_mut().insert("authorization", self.0.clone());
        Ok(request)
    }
}

type Guarded = InterceptedService<Channel, Token>;

/// Messages as bytes, for calls by description.
#[derive(Default)]
struct Bytes;

impl Codec for Bytes {
    type Encode = Vec<u8>;
    type Decode = Vec<u8>;
    type Encoder = Self;
    type Decoder = Self;

    fn encoder(&mut self) -> Self {
        Self
    }

    fn decoder(&mut self) -> Self {
        Self
    }
}

impl Encoder for Bytes {
    type Item = Vec<u8>;
    type Error = Status;

    fn encode(&mut self, item: Vec<u8>, buffer: &mut EncodeBuf<'_>) -> Result<(), Status> {
        buffer.put_slice(&item);
        Ok(())
    }
}

impl Decoder for Bytes {
    type Item = Vec<u8>;
    type Error = Status;

    fn decode(&mut self, buffer: &mut DecodeBuf<'_>) -> Result<Option<Vec<u8>>, Status> {
        Ok(Some(buffer.copy_to_bytes(buffer.remaining()).to_vec()))
    }
}

/// gRPC client.
pub struct Grpc {
    guarded: Guarded,
    pub demonstrations: DemonstrationServiceClient<Guarded>,
    pub actions: ActionServiceClient<Guarded>,
    pub recognition: RecognitionServiceClient<Guarded>,
    pub robots: RobotServiceClient<Guarded>,
    pub worlds: WorldServiceClient<Guarded>,
    pub experiments: ExperimentServiceClient<Guarded>,
    pub jobs: JobServiceClient<Guarded>,
    pub runs: RunServiceClient<Guarded>,
    pub trajectories: TrajectoryServiceClient<Guarded>,
}

impl Grpc {
    pub async fn new(server: &Server) -> Self {
        Self::with_token(server, &server.token).await
    }

    pub async fn with_token(server: &Server, token: &str) -> Self {
        let endpoint = Endpoint::from_shared(format!("http://{}", server.address)).unwrap();
        let channel = endpoint.connect().await.unwrap();
        let token = Token(format!("Bearer {token}").parse().unwrap());
        let guarded = InterceptedService::new(channel, token);
        Self {
            guarded: guarded.clone(),
            demonstrations: DemonstrationServiceClient::new(guarded.clone()),
            actions: ActionServiceClient::new(guarded.clone()),
            recognition: RecognitionServiceClient::new(guarded.clone()),
            robots: RobotServiceClient::new(guarded.clone()),
            worlds: WorldServiceClient::new(guarded.clone()),
            experiments: ExperimentServiceClient::new(guarded.clone()),
            jobs: JobServiceClient::new(guarded.clone()),
            runs: RunServiceClient::new(guarded.clone()),
            trajectories: TrajectoryServiceClient::new(guarded),
        }
    }

    /// Calls an rpc by its description: one message, or all that the server streams.
    pub async fn call(&self, rpc: &MethodDescriptor, request: DynamicMessage) -> Result<Vec<DynamicMessage>, Status> {
        let path = format!("/{}/{}", rpc.parent_service().full_name(), rpc.name());
        let mut client = tonic::client::Grpc::new(self.guarded.clone());
        client.ready().await.unwrap();
        let request = tonic::Request::new(request.encode_to_vec());
        let path = PathAndQuery::try_from(path).unwrap();
        let mut stream = client.server_streaming(request, path, Bytes).await?.into_inner();
        let mut messages = Vec::new();
        while let Some(bytes) = stream.message().await? {
            messages.push(DynamicMessage::decode(rpc.output(), bytes.as_slice()).unwrap());
        }
        Ok(messages)
    }
}
