//! Authentication: the holder of the server's token may use the service.

use sha2::{Digest as _, Sha256};
use subtle::ConstantTimeEq as _;

/// Recognizes the token without storing it; a comparison takes the same time for every wrong token.
#[derive(Debug, Clone)]
pub struct Access {
    bearer: [u8; 32],
    session: String,
}

impl Access {
    /// Accepts `token` and the session value derived from it.
    #[must_use]
    pub fn new(token: &str) -> Self {
        let session = hex::encode(Sha256::digest(format!("cgda session 1\n{token}")));
        Self { bearer: Sha256::digest(token).into(), session }
    }

    /// Whether `token` is the server's token.
    #[must_use]
    pub fn admits_token(&self, token: &str) -> bool {
        let digest: [u8; 32] = Sha256::digest(token).into();
        digest.ct_eq(&self.bearer).into()
    }

    /// Value that a browser stores instead of the token.
    #[must_use]
    pub fn session(&self) -> &str {
        &self.session
    }

    /// Whether `session` is the value of [`Access::session`].
    #[must_use]
    pub fn admits_session(&self, session: &str) -> bool {
        session.as_bytes().ct_eq(self.session.as_bytes()).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_token_and_its_session_are_admitted_and_neither_in_place_of_the_other() {
        let access = Access::new("secret");
        assert!(access.admits_token("secret") && access.admits_session(access.session()));
        assert!(!access.admits_token("secre") && !access.admits_token("") && !access.admits_token(access.session()));
        assert!(!access.admits_session("secret") && !access.admits_session(""));
        assert!(!format!("{access:?}").contains("secret"));
    }
}
