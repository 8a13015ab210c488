//! Keyset paging: a page ends with an opaque token that encodes the last item seen and the query it belongs to.

use super::error::{AppError, ErrorKind};
use super::limits;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use utoipa::ToSchema;

/// Page of a list, as requested.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PageQuery {
    /// Maximum number of items; [`limits::DEFAULT_PAGE_SIZE`] if absent.
    pub page_size: Option<u32>,
    /// The `next_page_token` of the previous page; absent or empty for the first page.
    pub page_token: Option<String>,
}

/// One page of a list, newest first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Page<T> {
    /// Items of this page.
    pub items: Vec<T>,
    /// Pass it as `page_token` for the next page; empty at the end.
    pub next_page_token: String,
}

/// A validated page query, for the store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keyset {
    /// Only items whose id sorts before this one.
    pub before_id: Option<String>,
    /// Maximum number of items.
    pub limit: u32,
    filter_hash: String,
}

impl Keyset {
    /// Validates `query`. `filter` encodes the other parameters of the list call in a stable text form, because a token
    /// is rejected together with other filters.
    ///
    /// # Errors
    /// `Malformed` for a size outside [`limits::PAGE_SIZE`] or a token of another list.
    pub fn new(query: &PageQuery, filter: &str) -> Result<Self, AppError> {
        let limit = query.page_size.unwrap_or(limits::DEFAULT_PAGE_SIZE);
        if !limits::PAGE_SIZE.contains(&limit) {
            return Err(AppError::new(
                ErrorKind::Malformed,
                "invalid_page_size",
                format!("page_size is {limit}: give {}", limits::in_words(&limits::PAGE_SIZE)),
            ));
        }
        let filter_hash = hex::encode(&Sha256::digest(filter.as_bytes())[..4]);
        let before_id = match query.page_token.as_deref() {
            None | Some("") => None,
            Some(token) => Some(decode(token, &filter_hash)?),
        };
        Ok(Self { before_id, limit, filter_hash })
    }

    /// Builds the page from `items`, which the store read with a limit one above the requested size.
    pub fn page<T>(&self, mut items: Vec<T>, id: impl Fn(&T) -> String) -> Page<T> {
        let limit = self.limit as usize;
        let more = items.len() > limit;
        items.truncate(limit);
        let next_page_token = match items.last() {
            Some(last) if more => hex::encode(format!("{}:{}", self.filter_hash, id(last))),
            _ => String::new(),
        };
        Page { items, next_page_token }
    }
}

impl<T> Page<T> {
    /// Converts the items of the page.
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Page<U> {
        Page { items: self.items.into_iter().map(f).collect(), next_page_token: self.next_page_token }
    }
}

fn decode(token: &str, filter_hash: &str) -> Result<String, AppError> {
    let refuse = || {
        AppError::new(
            ErrorKind::Malformed,
            "invalid_page_token",
            "page_token does not belong to this list with these filters: start again without it",
        )
    };
    let text = hex::decode(token).ok().and_then(|bytes| String::from_utf8(bytes).ok()).ok_or_else(refuse)?;
    let (hash, id) = text.split_once(':').ok_or_else(refuse)?;
    if hash != filter_hash {
        return Err(refuse());
    }
    Ok(id.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_names_the_last_item_and_fits_its_own_list_only() {
        let first = Keyset::new(&PageQuery { page_size: Some(2), page_token: None }, "jobs").unwrap();
        let page = first.page(vec![3, 2, 1], ToString::to_string);
        assert_eq!(page.items, [3, 2]);
        let next = PageQuery { page_size: Some(2), page_token: Some(page.next_page_token) };
        assert_eq!(Keyset::new(&next, "jobs").unwrap().before_id.as_deref(), Some("2"));
        assert_eq!(Keyset::new(&next, "runs").unwrap_err().code, "invalid_page_token");
        assert_eq!(first.page(vec![2, 1], ToString::to_string).next_page_token, "");
    }

    #[test]
    fn sizes_outside_the_bounds_are_refused() {
        for size in [0, 201] {
            let query = PageQuery { page_size: Some(size), page_token: None };
            assert_eq!(Keyset::new(&query, "").unwrap_err().kind, ErrorKind::Malformed);
        }
    }
}
