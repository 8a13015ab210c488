//! Authentication: the token as `authorization: Bearer TOKEN` in the metadata.

use super::error::status;
use crate::app::model::{AppError, ErrorKind};
use crate::app::{Access, App, Caller, UseCases};
use tonic::service::Interceptor;
use tonic::{Request, Status};

/// Interceptor that rejects calls without the token.
#[derive(Debug, Clone)]
pub struct Guard(pub Access);

impl Interceptor for Guard {
    fn call(&mut self, mut request: Request<()>) -> Result<Request<()>, Status> {
        let value = request.metadata().get("authorization").and_then(|value| value.to_str().ok());
        let bearer = value.and_then(|text| text.split_once(' '));
        match bearer {
            Some((scheme, token)) if scheme.eq_ignore_ascii_case("bearer") && self.0.admits_token(token.trim()) => {
                request.extensions_mut().insert(Caller::LocalOperator);
                Ok(request)
            }
            _ => {
                let message = "send the token that `cgda serve` printed as `authorization: Bearer TOKEN`";
                Err(status(AppError::new(ErrorKind::Unauthenticated, "unauthenticated", message)))
            }
        }
    }
}

/// The use-cases on behalf of whoever [`Guard`] has admitted.
///
/// # Errors
/// `INTERNAL` for a service behind no guard.
pub fn as_caller<T>(app: &App, request: &Request<T>) -> Result<UseCases, Status> {
    let caller = request.extensions().get::<Caller>();
    let caller = caller.ok_or_else(|| status(AppError::internal("a service behind no authentication")))?;
    Ok(app.on_behalf_of(*caller))
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
