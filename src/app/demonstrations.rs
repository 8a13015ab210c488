//! Demonstrations: upload with findings, look, exclude, decimate, export.

use crate::app::id::DemonstrationId;
use crate::app::{App, AppError, FieldError, Page, PageQuery, Timestamp};
use crate::framework::Feature;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// One uploaded file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UploadFile {
    /// File name as the client gave it; it names the stream, never a path.
    pub file_name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// An upload: one file, or several that were recorded together.
#[derive(Debug, Clone, PartialEq)]
pub struct UploadDemonstration {
    /// Display name; the first file's name when absent.
    pub name: Option<String>,
    /// At least one file.
    pub files: Vec<UploadFile>,
    /// How to read them.
    pub options: UploadOptions,
}

/// How uploaded files are read; every field is optional.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, default)]
pub struct UploadOptions {
    /// `csv`, `yarp`, `reduced` or `json`; recognised from the content when absent.
    pub format: Option<String>,
    /// What to do with streams whose clocks differ: `report` or `align_start`.
    pub clock_policy: Option<String>,
    /// Name of the time column; the first column when absent.
    pub time_column: Option<String>,
    /// Names of the features of files without a header, in column order.
    pub features: Option<Vec<String>>,
    /// Units by feature name.
    pub units: std::collections::BTreeMap<String, String>,
}

/// A demonstration without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationView {
    /// Its id.
    pub id: DemonstrationId,
    /// Display name.
    pub name: String,
    /// Number of times it was changed; `If-Match` compares it.
    pub revision: u64,
    /// Why it is left out of new actions, if it is.
    pub excluded: Option<String>,
    /// Streams.
    pub streams: Vec<StreamView>,
    /// Longest duration of its streams, seconds.
    pub duration_s: f64,
    /// SHA-256 of the uploaded bytes, hexadecimal.
    pub sha256: String,
    /// Number of findings of the reader.
    pub findings: u32,
    /// When it was uploaded.
    pub created_at: Timestamp,
}

/// One stream without its samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct StreamView {
    /// Stream name.
    pub name: String,
    /// Features in column order.
    pub features: Vec<Feature>,
    /// Number of samples.
    pub samples: u64,
    /// Time of the first sample, seconds.
    pub start_s: f64,
    /// Duration, seconds.
    pub duration_s: f64,
}

/// What the reader found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct DemonstrationReport {
    /// The demonstration.
    pub demonstration: DemonstrationId,
    /// Findings in the order of the data.
    pub findings: Vec<FieldError>,
}

/// A change of a demonstration; absent fields stay.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchDemonstration {
    /// New display name.
    #[serde(default)]
    pub name: Option<String>,
    /// A reason leaves it out of new actions; the empty text takes it in again.
    #[serde(default)]
    pub excluded: Option<String>,
}

/// Which samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SamplesQuery {
    /// Features by name; all when empty.
    pub features: Vec<String>,
    /// From this time on, seconds after the first sample of the demonstration.
    pub from_s: Option<f64>,
    /// Up to this time, seconds after the first sample of the demonstration.
    pub to_s: Option<f64>,
    /// At most about so many points a feature (2 to 20000; 1000 when absent), by minimum and maximum of each bin.
    pub max_points: Option<u32>,
}

/// Samples of a demonstration, one series a feature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct SamplesView {
    /// The demonstration.
    pub demonstration: DemonstrationId,
    /// One series a feature.
    pub series: Vec<Series>,
}

/// One feature's samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Series {
    /// Stream name.
    pub stream: String,
    /// Feature.
    pub feature: Feature,
    /// Times, seconds after the first sample of the demonstration.
    pub t_s: Vec<f64>,
    /// Values, in the feature's unit.
    pub values: Vec<f64>,
    /// Whether some samples were left out.
    pub decimated: bool,
}

/// A file to send.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Export {
    /// Media type.
    pub content_type: &'static str,
    /// Suggested name.
    pub file_name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

impl App {
    /// Reads and keeps an upload.
    ///
    /// # Errors
    /// `Invalid` with one detail a finding that makes it unusable; `TooLarge`.
    pub async fn upload_demonstration(&self, upload: UploadDemonstration) -> Result<DemonstrationView, AppError> {
        let _ = upload;
        Err(self.unfinished())
    }

    /// Newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_demonstrations(&self, page: PageQuery) -> Result<Page<DemonstrationView>, AppError> {
        let _ = page;
        Err(self.unfinished())
    }

    /// One demonstration.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// Renames or excludes.
    ///
    /// # Errors
    /// `NotFound`; `Precondition` when `if_match` is not the present revision.
    pub async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, AppError> {
        let _ = (id, patch, if_match);
        Err(self.unfinished())
    }

    /// Deletes it; actions made from it keep their goals.
    ///
    /// # Errors
    /// `NotFound`; `Precondition`.
    pub async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), AppError> {
        let _ = (id, if_match);
        Err(self.unfinished())
    }

    /// Samples, decimated so that no minimum and no maximum is lost.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` query.
    pub async fn demonstration_samples(
        &self,
        id: &DemonstrationId,
        query: SamplesQuery,
    ) -> Result<SamplesView, AppError> {
        let _ = (id, query);
        Err(self.unfinished())
    }

    /// What the reader found at upload.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, AppError> {
        let _ = id;
        Err(self.unfinished())
    }

    /// The samples as `csv` (one stream only) or `json`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format.
    pub async fn export_demonstration(&self, id: &DemonstrationId, format: &str) -> Result<Export, AppError> {
        let _ = (id, format);
        Err(self.unfinished())
    }
}
