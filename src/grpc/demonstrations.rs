//! `DemonstrationService`.

use super::auth::as_caller;
use super::convert::demonstration::{header, patch, samples};
use super::convert::{items, page, resource};
use super::error::status;
use super::files::{FileStream, send};
use super::proto;
use crate::app::App;
use crate::app::model::{AppError, ErrorKind, UploadDemonstration, UploadFile, limits};
use proto::demonstration_service_server::DemonstrationService;
use proto::upload_request::Part;
use tonic::{Request, Response, Status, Streaming};

/// Service implementation on the use cases.
pub struct Service(pub App);

#[tonic::async_trait]
impl DemonstrationService for Service {
    type ExportDemonstrationStream = FileStream;

    async fn upload(
        &self,
        request: Request<Streaming<proto::UploadRequest>>,
    ) -> Result<Response<proto::Demonstration>, Status> {
        let app = as_caller(&self.0, &request)?;
        let upload = receive(request.into_inner(), app.upload_limit_bytes()).await?;
        let view = app.upload_demonstration(upload).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn get_demonstration(
        &self,
        request: Request<proto::GetDemonstrationRequest>,
    ) -> Result<Response<proto::Demonstration>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetDemonstrationRequest { id } = request.into_inner();
        let view = app.get_demonstration(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn list_demonstrations(
        &self,
        request: Request<proto::ListDemonstrationsRequest>,
    ) -> Result<Response<proto::ListDemonstrationsResponse>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ListDemonstrationsRequest { page_size, page_token } = request.into_inner();
        let found = app.list_demonstrations(page(page_size, page_token)).await.map_err(status)?;
        let (demonstrations, next_page_token) = items(found);
        Ok(Response::new(proto::ListDemonstrationsResponse { demonstrations, next_page_token }))
    }

    async fn get_demonstration_report(
        &self,
        request: Request<proto::GetDemonstrationReportRequest>,
    ) -> Result<Response<proto::DemonstrationReport>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::GetDemonstrationReportRequest { id } = request.into_inner();
        let report = app.demonstration_report(&resource(&id).map_err(status)?).await.map_err(status)?;
        Ok(Response::new(report.into()))
    }

    async fn get_demonstration_samples(
        &self,
        request: Request<proto::GetDemonstrationSamplesRequest>,
    ) -> Result<Response<proto::DemonstrationSamples>, Status> {
        let app = as_caller(&self.0, &request)?;
        let (id, query) = samples(request.into_inner()).map_err(status)?;
        let view = app.demonstration_samples(&resource(&id).map_err(status)?, query).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn patch_demonstration(
        &self,
        request: Request<proto::PatchDemonstrationRequest>,
    ) -> Result<Response<proto::Demonstration>, Status> {
        let app = as_caller(&self.0, &request)?;
        let (id, change, revision) = patch(request.into_inner());
        let id = resource(&id).map_err(status)?;
        let view = app.patch_demonstration(&id, change, revision).await.map_err(status)?;
        Ok(Response::new(view.into()))
    }

    async fn delete_demonstration(
        &self,
        request: Request<proto::DeleteDemonstrationRequest>,
    ) -> Result<Response<()>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::DeleteDemonstrationRequest { id, revision } = request.into_inner();
        app.delete_demonstration(&resource(&id).map_err(status)?, revision).await.map_err(status)?;
        Ok(Response::new(()))
    }

    async fn export_demonstration(
        &self,
        request: Request<proto::ExportDemonstrationRequest>,
    ) -> Result<Response<FileStream>, Status> {
        let app = as_caller(&self.0, &request)?;
        let proto::ExportDemonstrationRequest { id, format } = request.into_inner();
        let id = resource(&id).map_err(status)?;
        let file = app.export_demonstration(&id, &format).await.map_err(status)?;
        Ok(send(file))
    }
}

async fn receive(mut parts: Streaming<proto::UploadRequest>, limit: usize) -> Result<UploadDemonstration, Status> {
    let mut assembly = Assembly::new(limit);
    while let Some(request) = parts.message().await? {
        assembly.take(request.part).map_err(status)?;
    }
    assembly.finish().map_err(status)
}

/// An upload, assembled part by part.
struct Assembly {
    header: Option<proto::UploadHeader>,
    files: Vec<UploadFile>,
    limit: usize,
    received: usize,
}

impl Assembly {
    fn new(limit: usize) -> Self {
        Self { header: None, files: Vec::new(), limit, received: 0 }
    }

    fn take(&mut self, part: Option<Part>) -> Result<(), AppError> {
        match part {
            Some(Part::Header(header)) if self.header.is_none() && self.files.is_empty() => self.header = Some(header),
            Some(Part::FileName(file_name)) if self.header.is_some() => {
                let most = *limits::UPLOAD_FILES.end() as usize;
                if self.files.len() == most {
                    let message = format!("an upload has at most {most} files");
                    return Err(AppError::new(ErrorKind::TooLarge, "too_many_files", message));
                }
                self.files.push(UploadFile { file_name, bytes: Vec::new() });
            }
            Some(Part::Content(content)) => {
                let file = self.files.last_mut().ok_or_else(out_of_order)?;
                self.received += content.len();
                if self.received > self.limit {
                    let message = format!(
                        "the upload is larger than the limit of {} bytes: split it, or raise the limit",
                        self.limit
                    );
                    return Err(AppError::new(ErrorKind::TooLarge, "body_too_large", message));
                }
                file.bytes.extend_from_slice(&content);
            }
            _ => return Err(out_of_order()),
        }
        Ok(())
    }

    fn finish(self) -> Result<UploadDemonstration, AppError> {
        let (name, options) = header(self.header.ok_or_else(out_of_order)?)?;
        Ok(UploadDemonstration { name, files: self.files, options })
    }
}

fn out_of_order() -> AppError {
    let message = "send one header, then for each file its name and then its content";
    AppError::new(ErrorKind::Malformed, "out_of_order", message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assemble(parts: Vec<Part>) -> Result<UploadDemonstration, &'static str> {
        let mut assembly = Assembly::new(10);
        parts.into_iter().try_for_each(|part| assembly.take(Some(part))).map_err(|error| error.code)?;
        assembly.finish().map_err(|error| error.code)
    }

    #[test]
    fn files_are_put_together_in_order_and_within_the_limit() {
        let header = || Part::Header(proto::UploadHeader::default());
        let name = |name: &str| Part::FileName(name.to_owned());
        let content = |text: &str| Part::Content(text.as_bytes().to_vec());
        let upload = assemble(vec![header(), name("a"), content("12"), content("3"), name("b"), content("4")]).unwrap();
        let files: Vec<(&str, &[u8])> =
            upload.files.iter().map(|f| (f.file_name.as_str(), f.bytes.as_slice())).collect();
        assert_eq!(files, [("a", &b"123"[..]), ("b", &b"4"[..])]);
        for wrong in
            [vec![], vec![name("a")], vec![content("1")], vec![header(), content("1")], vec![header(), header()]]
        {
            assert_eq!(assemble(wrong).unwrap_err(), "out_of_order");
        }
        let large = vec![header(), name("a"), content("123456"), name("b"), content("12345")];
        assert_eq!(assemble(large).unwrap_err(), "body_too_large");
        assert_eq!(Assembly::new(1).take(None).unwrap_err().code, "out_of_order");
    }
}
