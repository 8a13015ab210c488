//! Authentication: the token as `authorization: Bearer TOKEN` in the metadata.

use super::error::status;
use crate::app::Access;
use crate::app::model::{AppError, ErrorKind};
use tonic::service::Interceptor;
use tonic::{Request, Status};

/// Interceptor that rejects calls without the token.
#[derive(Debug, Clone)]
pub struct Guard(pub Access);

impl Interceptor for Guard {
    fn call(&mut self, request: Request<()>) -> Result<Request<()>, Status> {
        let value = request.metadata().get("authorization").and_then(|value| value.to_str().ok());
        let bearer = value.and_then(|text| text.split_once(' '));
        match bearer {
            Some((scheme, token)) if scheme.eq_ignore_ascii_case("bearer") && self.0.admits_token(token.trim()) => {
                Ok(request)
            }
            _ => {
                let message = "send the token that `cgda serve` printed as `authorization: Bearer TOKEN`";
                Err(status(AppError::new(ErrorKind::Unauthenticated, "unauthenticated", message)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_token_opens() {
        let mut guard = Guard(Access::new("secret"));
        let mut ask = |value: Option<&str>| {
            let mut request = Request::new(());
            if let Some(value) = value {
                request.metadata_mut().insert("authorization", value.parse().unwrap());
            }
            guard.call(request).map(|_| ()).map_err(|status| status.code())
        };
        assert_eq!(ask(Some("Bearer secret")), Ok(()));
        for wrong in [None, Some("Bearer other"), Some("secret"), Some("")] {
            assert_eq!(ask(wrong), Err(tonic::Code::Unauthenticated), "{wrong:?}");
        }
    }
}
