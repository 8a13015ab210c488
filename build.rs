//! Compiles `proto/` without protoc and writes the descriptor set that gRPC reflection serves; sees to it that the
//! dashboard in `web/dist` is embedded when it is there, and that it is there when the feature `embed-web` demands it.

use prost::Message as _;
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

/// Where vite writes the built dashboard.
const DASHBOARD: &str = "web/dist";

fn main() -> Result<(), Box<dyn Error>> {
    watch_dashboard()?;
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=proto");

    let mut files: Vec<PathBuf> =
        fs::read_dir("proto/cgda/v1")?.map(|entry| Ok(entry?.path())).collect::<Result<_, std::io::Error>>()?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "proto"));
    files.sort();

    let descriptors = protox::compile(&files, ["proto"])?;
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    fs::write(out.join("cgda.v1.binpb"), descriptors.encode_to_vec())?;
    tonic_prost_build::configure().btree_map(".").boxed(".cgda.v1.Work.kind.execution").compile_fds(descriptors)?;
    Ok(())
}

/// Without the folder cargo could not watch it (a missing path counts as changed in every build), so it is created.
fn watch_dashboard() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed={DASHBOARD}");
    let present = Path::new(DASHBOARD).join("index.html").exists();
    if !present && std::env::var_os("CARGO_FEATURE_EMBED_WEB").is_some() {
        return Err(format!("feature embed-web: {DASHBOARD} is missing: run `make web` first").into());
    }
    if !present {
        // A read-only source tree only costs needless rebuilds.
        drop(fs::create_dir_all(DASHBOARD));
    }
    Ok(())
}
