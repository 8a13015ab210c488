//! A server in a child process, and a client for it.

use serde_json::{Value, json};
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest wait for anything a server is expected to do; an idle machine needs seconds.
pub const PATIENCE: Duration = Duration::from_mins(5);

/// A running server; killed on drop.
pub struct Server {
    child: Child,
    base: String,
    token: String,
    client: reqwest::Client,
}

impl Server {
    /// Starts the binary on `data`, on a free port.
    pub fn start(data: &Path) -> Self {
        Self::start_with(data, &[])
    }

    /// Like [`Server::start`], but experiments execute their runs one after the other, in the plan's order.
    pub fn start_in_order(data: &Path) -> Self {
        Self::start_with(data, &[("RAYON_NUM_THREADS", "1")])
    }

    fn start_with(data: &Path, environment: &[(&str, &str)]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_cgda"))
            .args(["serve", "--listen", "127.0.0.1:0", "--workers", "4", "--data-dir"])
            .arg(data)
            .env("CGDA_LOG__FILTER", "warn")
            .envs(environment.iter().copied())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let field = |name: &str| {
            let value = line.split_whitespace().find_map(|word| word.strip_prefix(name)).map(str::to_owned);
            value.unwrap_or_else(|| panic!("no {name} in {line:?}"))
        };
        let token = field("url=").split_once("token=").unwrap().1.to_owned();
        Self { base: field("http="), token, child, client: reqwest::Client::new() }
    }

    /// Sends SIGKILL: the server gets no chance to clean up.
    pub fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Sends SIGTERM; returns the time until exit and whether the exit code was 0.
    pub fn terminate(&mut self) -> (Duration, bool) {
        let started = Instant::now();
        let sent = Command::new("kill").args(["-TERM", &self.child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        let status = self.child.wait().unwrap();
        (started.elapsed(), status.success())
    }

    fn request(&self, method: reqwest::Method, path: &str) -> reqwest::RequestBuilder {
        self.client.request(method, format!("{}{path}", self.base)).bearer_auth(&self.token)
    }

    /// GETs a path that must answer with success; returns text.
    pub async fn text(&self, path: &str) -> String {
        let answer = self.request(reqwest::Method::GET, path).send().await.unwrap();
        let (status, text) = (answer.status(), answer.text().await.unwrap());
        assert!(status.is_success(), "GET {path}: {status} {text}");
        text
    }

    /// GETs a path that must answer with success; returns JSON.
    pub async fn get(&self, path: &str) -> Value {
        serde_json::from_str(&self.text(path).await).unwrap()
    }

    /// POSTs a body that must be accepted.
    pub async fn post(&self, path: &str, body: &Value) -> Value {
        let request = self.request(reqwest::Method::POST, path).header("content-type", "application/json");
        let answer = request.body(body.to_string()).send().await.unwrap();
        let (status, text) = (answer.status(), answer.text().await.unwrap());
        assert!(status.is_success(), "POST {path}: {status} {text}");
        serde_json::from_str(&text).unwrap()
    }

    /// Waits until what is shown of a job meets `condition`.
    pub async fn until(&self, job: &str, condition: impl Fn(&Value) -> bool) -> Value {
        let started = Instant::now();
        loop {
            let view = self.get(&format!("/api/v1/jobs/{job}")).await;
            if condition(&view) {
                return view;
            }
            assert!(started.elapsed() < PATIENCE, "{job} does not get there: {view}");
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    }

    /// Waits until the job is in a final state.
    pub async fn ended(&self, job: &str) -> Value {
        self.until(job, |view| ["SUCCEEDED", "FAILED", "CANCELLED"].contains(&view["state"].as_str().unwrap())).await
    }

    /// Waits until the job has made at least that many evaluations.
    pub async fn evaluated(&self, job: &str, least: u64) {
        self.until(job, |view| view["progress"]["total_evaluations"].as_u64().unwrap() >= least).await;
    }

    /// Has a worker do something else from beginning to end: whatever has not moved meanwhile rests.
    pub async fn work_on_something_else(&self) {
        self.set_up().await;
    }

    /// Uploads a demonstration.
    pub async fn upload(&self, file_name: &str, csv: String) -> Value {
        let path = format!("/api/v1/demonstrations?file_name={file_name}");
        let upload = self.request(reqwest::Method::POST, &path).header("content-type", "text/csv");
        serde_json::from_str(&upload.body(csv).send().await.unwrap().text().await.unwrap()).unwrap()
    }

    /// Uploads a small action, the shipped arm and a tool-position world; returns the fields an execution needs.
    pub async fn set_up(&self) -> Value {
        let csv = "time_s,x [mm],y [mm],z [mm]\n0,460,-500,304\n1,420,-590,300\n2,320,-620,294\n3,300,-480,300\n";
        let demonstration = self.upload("arc.csv", csv.to_owned()).await;
        let request = json!({"kind": "generalization", "name": "arc", "t_min_s": 0.75,
            "demonstrations": [demonstration["id"]]});
        let job = self.post("/api/v1/jobs", &request).await;
        let made = self.ended(job["id"].as_str().unwrap()).await;
        let spec = json!({"free_joints": ["shoulder_pitch", "shoulder_roll", "elbow_pitch"],
            "fixed": {"wrist_yaw": -std::f64::consts::FRAC_PI_4}});
        let urdf = include_str!("../../examples/robots/teo_right_arm.urdf");
        let robot = self.post("/api/v1/robots", &json!({"name": "arm", "urdf": urdf, "spec": spec})).await;
        let world = json!({"name": "tool", "spec": {"kind": "tool_position", "unit": "mm"}});
        let world = self.post("/api/v1/worlds", &world).await;
        json!({"kind": "execution", "action": made["result"]["action"], "robot": robot["id"], "world": world["id"],
            "execution": {"method": {"name": "sst", "population": 20, "stagnation": 3}}})
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // Already dead in tests that killed it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Evaluations per second at which a job that makes the evaluations of `ended` takes `seconds`. What meets the job in
/// its middle then has that long for it, on any machine.
pub fn pace(ended: &Value, seconds: f64) -> f64 {
    ended["progress"]["total_evaluations"].as_f64().unwrap() / seconds
}

/// The digests of a job's runs, in the order of repetitions.
pub async fn digests(server: &Server, job: &Value) -> Vec<String> {
    let mut digests = Vec::new();
    for run in job["result"]["runs"].as_array().unwrap() {
        let run = server.get(&format!("/api/v1/runs/{}", run.as_str().unwrap())).await;
        digests.push(run["digest"].as_str().unwrap().to_owned());
    }
    digests
}

/// All events of a finished job.
pub async fn events(server: &Server, job: &str) -> Vec<Value> {
    let text = server.text(&format!("/api/v1/jobs/{job}/events?after_seq=0")).await;
    text.lines()
        .filter_map(|line| line.strip_prefix("data: "))
        .map(|data| serde_json::from_str(data).unwrap())
        .collect()
}
