//! Reading bodies with a bound while they stream in, whatever length they declare.
//!
//! A rejected body is drained for a while: a client that is still sending would otherwise see its connection break
//! instead of the response.

use crate::app::model::{AppError, ErrorKind};
use axum::body::{Body, BodyDataStream};
use axum::extract::Request;
use axum::http::HeaderMap;
use axum::http::header::{CONTENT_LENGTH, EXPECT};
use futures_util::StreamExt as _;
use std::time::Duration;

/// Number of bytes of a rejected body to drain, and for how long, before the connection may be closed.
const DRAINED_BYTES: usize = 32 << 20;
const DRAINED_FOR: Duration = Duration::from_secs(5);

/// Reads the body if it has at most `limit` bytes.
pub async fn read(request: Request, limit: usize) -> Result<Vec<u8>, AppError> {
    let (parts, body) = request.into_parts();
    if declared(&parts.headers).is_some_and(|length| length > limit as u64) {
        if !parts.headers.contains_key(EXPECT) {
            drain(body.into_data_stream()).await;
        }
        return Err(too_large(limit));
    }
    collect(body, limit).await
}

async fn collect(body: Body, limit: usize) -> Result<Vec<u8>, AppError> {
    let mut stream = body.into_data_stream();
    let mut bytes = Vec::new();
    while let Some(chunk) = stream.next().await {
        let chunk = chunk.map_err(|error| unreadable(&error.to_string()))?;
        if bytes.len() + chunk.len() > limit {
            drain(stream).await;
            return Err(too_large(limit));
        }
        bytes.extend_from_slice(&chunk);
    }
    Ok(bytes)
}

async fn drain(mut stream: BodyDataStream) {
    let rest = async {
        let mut left = DRAINED_BYTES;
        while let Some(Ok(chunk)) = stream.next().await {
            left = left.saturating_sub(chunk.len());
            if left == 0 {
                break;
            }
        }
    };
    // Whether the client has finished or ran out of time, it is answered now.
    let _ = tokio::time::timeout(DRAINED_FOR, rest).await;
}

fn declared(headers: &HeaderMap) -> Option<u64> {
    headers.get(CONTENT_LENGTH)?.to_str().ok()?.parse().ok()
}

/// Error for a body that cannot be read to its end.
pub fn unreadable(cause: &str) -> AppError {
    AppError::new(ErrorKind::Malformed, "unreadable_body", format!("the body ended early or is malformed: {cause}"))
}

/// Error for a body above its limit.
pub fn too_large(limit: usize) -> AppError {
    let message = format!("the body is larger than the limit of {limit} bytes: send less, or raise the limit");
    AppError::new(ErrorKind::TooLarge, "body_too_large", message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[tokio::test]
    async fn a_refused_body_is_read_on_and_not_kept() {
        let sent = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&sent);
        let chunks = futures_util::stream::iter((0..100).map(move |_| {
            count.fetch_add(1, Ordering::Relaxed);
            Ok::<_, std::io::Error>(vec![0_u8; 10])
        }));
        let request = Request::new(Body::from_stream(chunks));
        let error = read(request, 25).await.unwrap_err();
        assert_eq!((error.kind, sent.load(Ordering::Relaxed)), (ErrorKind::TooLarge, 100));
    }

    #[tokio::test]
    async fn the_bound_is_the_last_byte_allowed() {
        let body = |length: usize| Request::new(Body::from(vec![7_u8; length]));
        assert_eq!(read(body(25), 25).await.unwrap().len(), 25);
        assert_eq!(read(body(26), 25).await.unwrap_err().code, "body_too_large");
    }
}
