//! Demonstrations: upload with findings, read, exclude, decimate, export.

mod codec;
mod series;
#[cfg(test)]
mod tests;

pub use codec::{CodecError, decode, encode};

use crate::app::model::{
    AppError, DemonstrationId, DemonstrationReport, DemonstrationView, ErrorKind, Export, FieldError, Keyset, Page,
    PageQuery, PatchDemonstration, SamplesQuery, SamplesView, StreamView, UploadDemonstration,
};
use crate::app::ports::NewDemonstration;
use crate::app::{UseCases, check_name, compute, json_pointer, unknown_format};
use crate::framework::Feature;
use crate::framework::demonstration::{
    Demonstration, Finding, FindingCode, ReadResult, SourceFile, content_hash, read_files,
};
use sha2::{Digest as _, Sha256};

impl UseCases {
    /// Parses and stores an upload.
    ///
    /// # Errors
    /// `Invalid` with one detail per finding that makes it unusable; `TooLarge`.
    pub async fn upload_demonstration(&self, upload: UploadDemonstration) -> Result<DemonstrationView, AppError> {
        if let Some(name) = &upload.name {
            check_name("/name", name)?;
        }
        if upload.files.is_empty() {
            return Err(AppError::field("/files", "missing_file", "an upload needs at least one file"));
        }
        let upload_limit_bytes = self.upload_limit_bytes;
        let (demonstration, mut findings, sha256, samples) =
            compute(move || read(upload, upload_limit_bytes)).await??;
        for twin in self.ports.store.demonstrations_with_content(&sha256).await? {
            let message = format!("the samples are identical to those of {twin}");
            let remedy = "delete one of them, unless it should count twice";
            findings.push(Finding::warning(FindingCode::DuplicateContent, message, remedy));
        }
        let id = DemonstrationId::from_uuid(self.ports.ids.uuid());
        let view = view(id.clone(), &demonstration, sha256, findings.len(), self.now());
        let report = DemonstrationReport { demonstration: id, findings };
        let new = NewDemonstration { view: view.clone(), report, samples };
        self.ports.store.insert_demonstration(new).await?;
        Ok(view)
    }

    /// Lists demonstrations, newest first.
    ///
    /// # Errors
    /// `Malformed` page.
    pub async fn list_demonstrations(&self, page: PageQuery) -> Result<Page<DemonstrationView>, AppError> {
        let keyset = Keyset::new(&page, "demonstrations")?;
        let found = self.ports.store.demonstrations(&keyset).await?;
        Ok(keyset.page(found, |demonstration| demonstration.id.to_string()))
    }

    /// Reads one demonstration.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn get_demonstration(&self, id: &DemonstrationId) -> Result<DemonstrationView, AppError> {
        Ok(self.ports.store.demonstration(id).await?)
    }

    /// Renames or excludes a demonstration.
    ///
    /// # Errors
    /// `NotFound`; `Precondition` if `if_match` is not the current revision.
    pub async fn patch_demonstration(
        &self,
        id: &DemonstrationId,
        patch: PatchDemonstration,
        if_match: Option<u64>,
    ) -> Result<DemonstrationView, AppError> {
        if let Some(name) = &patch.name {
            check_name("/name", name)?;
        }
        if let Some(reason) = patch.excluded.as_deref().filter(|reason| !reason.is_empty()) {
            check_name("/excluded", reason)?;
        }
        Ok(self.ports.store.patch_demonstration(id, patch, if_match).await?)
    }

    /// Deletes a demonstration; actions generalized from it keep their goals.
    ///
    /// # Errors
    /// `NotFound`; `Precondition`.
    pub async fn delete_demonstration(&self, id: &DemonstrationId, if_match: Option<u64>) -> Result<(), AppError> {
        Ok(self.ports.store.delete_demonstration(id, if_match).await?)
    }

    /// Reads samples, decimated without losing any minimum or maximum.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` query.
    pub async fn demonstration_samples(
        &self,
        id: &DemonstrationId,
        query: SamplesQuery,
    ) -> Result<SamplesView, AppError> {
        let demonstration = self.load_demonstration(id).await?;
        let series = compute(move || series::series(&demonstration, &query)).await??;
        Ok(SamplesView { demonstration: id.clone(), series })
    }

    /// Reads the findings made at upload.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn demonstration_report(&self, id: &DemonstrationId) -> Result<DemonstrationReport, AppError> {
        Ok(self.ports.store.demonstration_report(id).await?)
    }

    /// Exports the samples as `csv` (one stream only) or `json`.
    ///
    /// # Errors
    /// `NotFound`; `Malformed` format; `Conflict` for `csv` of several streams.
    pub async fn export_demonstration(&self, id: &DemonstrationId, format: &str) -> Result<Export, AppError> {
        let name = self.get_demonstration(id).await?.name;
        let demonstration = self.load_demonstration(id).await?;
        match format {
            "csv" => {
                let bytes = compute(move || csv(&demonstration)).await??;
                Ok(Export::new("text/csv; charset=utf-8", &name, "csv", bytes))
            }
            "json" => {
                let bytes = compute(move || serde_json::to_vec(&demonstration)).await?.map_err(AppError::internal)?;
                Ok(Export::new("application/json", &name, "json", bytes))
            }
            other => Err(unknown_format(other, "csv or json")),
        }
    }

    /// Loads a demonstration with its samples.
    ///
    /// # Errors
    /// `NotFound`.
    pub async fn load_demonstration(&self, id: &DemonstrationId) -> Result<Demonstration, AppError> {
        let bytes = self.ports.store.demonstration_samples(id).await?;
        compute(move || decode(&bytes)).await?.map_err(AppError::internal)
    }
}

type Read = (Demonstration, Vec<Finding>, String, Vec<u8>);

fn read(upload: UploadDemonstration, limit_bytes: usize) -> Result<Read, AppError> {
    let files: Vec<SourceFile<'_>> =
        upload.files.iter().map(|file| SourceFile { name: &file.file_name, bytes: &file.bytes }).collect();
    let options = upload.options.read_options(upload.name, limit_bytes);
    let result: ReadResult = read_files(&files, &options);
    let (demonstration, findings) = result.map_err(|findings| refuse(&findings))?;
    let mut content = Sha256::new();
    for stream in &demonstration.streams {
        content.update(content_hash(stream));
    }
    let samples = encode(&demonstration).map_err(AppError::internal)?;
    Ok((demonstration, findings, hex::encode(content.finalize()), samples))
}

/// Place of a finding in the uploaded data, as a JSON pointer: `/streams/NAME/rows/ROW/columns/NAME`.
#[must_use]
pub fn pointer(finding: &Finding) -> String {
    let places = [
        ("streams", finding.stream.clone()),
        ("rows", finding.row.map(|row| row.to_string())),
        ("columns", finding.column.clone()),
    ];
    let given = places.into_iter().filter_map(|(key, value)| Some((key, value?)));
    given.fold(String::new(), |pointer, (key, value)| json_pointer::join(&json_pointer::join(&pointer, key), value))
}

fn refuse(findings: &[Finding]) -> AppError {
    let errors = findings.iter().filter(|finding| finding.is_error());
    let details: Vec<FieldError> = errors
        .map(|finding| {
            let detail = format!("{}; {}", finding.message, finding.remedy);
            FieldError::new(pointer(finding), finding.code.to_string(), detail)
        })
        .collect();
    let too_large = findings.iter().any(|finding| finding.is_error() && finding.code == FindingCode::TooLarge);
    let message = match details.as_slice() {
        [only] => format!("the demonstration is rejected: {}", only.detail),
        many => format!("the demonstration is rejected for {} reasons", many.len()),
    };
    let kind = if too_large { ErrorKind::TooLarge } else { ErrorKind::Invalid };
    AppError { details, ..AppError::new(kind, "invalid_demonstration", message) }
}

fn view(
    id: DemonstrationId,
    demonstration: &Demonstration,
    sha256: String,
    findings: usize,
    created_at: crate::app::model::Timestamp,
) -> DemonstrationView {
    let streams = demonstration.streams.iter().map(|stream| StreamView {
        name: stream.name().to_owned(),
        features: stream.features().to_vec(),
        samples: stream.len() as u64,
        start_s: stream.time_s()[0],
        duration_s: stream.duration_s(),
    });
    DemonstrationView {
        id,
        name: demonstration.name.clone(),
        revision: 1,
        excluded: None,
        streams: streams.collect(),
        duration_s: demonstration.duration_s(),
        sha256,
        findings: u32::try_from(findings).unwrap_or(u32::MAX),
        created_at,
    }
}

fn csv(demonstration: &Demonstration) -> Result<Vec<u8>, AppError> {
    let [stream] = demonstration.streams.as_slice() else {
        let message = format!(
            "the demonstration has {} streams, but a CSV file holds only one: export json",
            demonstration.streams.len()
        );
        return Err(AppError::new(ErrorKind::Conflict, "several_streams", message));
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = std::iter::once("time_s".to_owned()).chain(stream.features().iter().map(Feature::header));
    writer.write_record(header).map_err(AppError::internal)?;
    for (sample, time_s) in stream.time_s().iter().enumerate() {
        let row = std::iter::once(time_s).chain(stream.row(sample));
        writer.write_record(row.map(ToString::to_string)).map_err(AppError::internal)?;
    }
    writer.into_inner().map_err(|error| AppError::internal(error.to_string()))
}
