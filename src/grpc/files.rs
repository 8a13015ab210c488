//! Streams of the exports: a header, then the content in pieces.

use super::convert::file::chunks;
use super::proto;
use crate::app::model::Export;
use futures_util::StreamExt as _;
use futures_util::stream::{BoxStream, iter};
use tonic::{Response, Status};

/// The messages of one file.
pub type FileStream = BoxStream<'static, Result<proto::FileChunk, Status>>;

/// Sends a file.
pub fn send(file: Export) -> Response<FileStream> {
    Response::new(iter(chunks(file)).map(Ok).boxed())
}
