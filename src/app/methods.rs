//! Methods that a job can search with.

use crate::app::UseCases;
use crate::app::model::{MethodList, MethodView};
use crate::framework::method::catalogue;

impl UseCases {
    /// Lists all methods with their parameters.
    #[must_use]
    pub fn list_methods(&self) -> MethodList {
        MethodList { items: catalogue().into_iter().map(MethodView::from).collect() }
    }
}
