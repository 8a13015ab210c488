//! REST: the router is the URL table; one file a resource.

pub mod assets;
