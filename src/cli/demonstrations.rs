//! Demonstration files named on the command line: reads them and prints findings to stderr.

use super::values::{ClockPolicy, Format};
use crate::framework::demonstration::{
    Demonstration, Finding, ReadOptions, SourceFile, content_hash, duplicate_content, known_features, read, read_files,
};
use anyhow::{Context as _, bail};
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Options for reading demonstration files.
#[derive(Debug, Clone, clap::Args)]
pub struct ReadArguments {
    /// Format of the files; detected from their content if absent.
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Header of the time column; if absent, `time`, `time_s`, `t` and `timestamp` are recognized.
    #[arg(long, value_name = "NAME")]
    time_column: Option<String>,
    /// Unit of a feature; may be repeated.
    #[arg(long = "unit", value_name = "FEATURE=UNIT", value_parser = unit)]
    units: Vec<(String, String)>,
    /// Treatment of streams (files of one directory) whose clocks disagree.
    #[arg(long, value_enum, default_value_t = ClockPolicy::AsRecorded)]
    clock_policy: ClockPolicy,
}

fn unit(argument: &str) -> Result<(String, String), String> {
    let pair = argument.split_once('=').ok_or("write FEATURE=UNIT, for example x=mm")?;
    Ok((pair.0.to_owned(), pair.1.to_owned()))
}

/// Reads each path as one demonstration: a file is a single stream, a directory a bundle of streams.
///
/// # Errors
/// A path that cannot be read, or a file with an error among its findings; all findings have been printed to stderr by
/// then.
pub fn read_demonstrations(paths: &[PathBuf], arguments: &ReadArguments) -> anyhow::Result<Vec<Demonstration>> {
    let mut demonstrations = Vec::with_capacity(paths.len());
    let mut refused = 0;
    for path in paths {
        match read_path(path, arguments)? {
            Ok((demonstration, findings)) => {
                tell(path, &findings);
                demonstrations.push(demonstration);
            }
            Err(findings) => {
                tell(path, &findings);
                refused += 1;
            }
        }
    }
    if refused > 0 {
        bail!("{refused} of {} demonstrations were rejected, see the findings above", paths.len());
    }
    let hashes: Vec<(String, String)> = demonstrations
        .iter()
        .zip(paths)
        .flat_map(|(d, path)| {
            d.streams.iter().map(move |s| (format!("{}:{}", path.display(), s.name()), content_hash(s)))
        })
        .collect();
    for finding in duplicate_content(&hashes) {
        eprintln!("{finding}");
    }
    Ok(demonstrations)
}

fn tell(path: &Path, findings: &[Finding]) {
    for finding in findings {
        eprintln!("{}: {finding}", path.display());
    }
}

type Read = Result<(Demonstration, Vec<Finding>), Vec<Finding>>;

fn read_path(path: &Path, arguments: &ReadArguments) -> anyhow::Result<Read> {
    let options = ReadOptions {
        name: Some(name(path)),
        stream: Some(stream(path)),
        format: arguments.format.map(Into::into),
        time_column: arguments.time_column.clone(),
        units: arguments.units.iter().cloned().collect(),
        clock_policy: arguments.clock_policy.into(),
        ..ReadOptions::default()
    };
    if !path.is_dir() {
        return Ok(read(&content(path, &options)?, &options));
    }
    let entries = std::fs::read_dir(path).with_context(|| format!("cannot read {}", path.display()))?;
    let mut paths = entries.map(|entry| entry.map(|e| e.path())).collect::<Result<Vec<_>, _>>()?;
    paths.retain(|p| p.is_file() && !file_name(p).starts_with('.'));
    paths.sort();
    if paths.is_empty() {
        bail!("{} contains no files: a directory is one demonstration with a stream per file", path.display());
    }
    let contents = paths
        .iter()
        .map(|p| Ok((file_name(p), content(p, &options)?)))
        .collect::<anyhow::Result<Vec<(String, Vec<u8>)>>>()?;
    let files: Vec<SourceFile<'_>> = contents.iter().map(|(name, bytes)| SourceFile { name, bytes }).collect();
    Ok(read_files(&files, &options))
}

fn content(path: &Path, options: &ReadOptions) -> anyhow::Result<Vec<u8>> {
    let limit = options.limits.bytes;
    // Bounded while reading, because a device or a pipe has no known length.
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(limit.saturating_add(1)).read_to_end(&mut bytes));
    let size = read.with_context(|| format!("cannot read {}", path.display()))? as u64;
    if size > limit {
        bail!("{} exceeds the limit of {limit} bytes: split the recording", path.display());
    }
    Ok(bytes)
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn folder_name(path: &Path) -> Option<String> {
    path.parent().map(file_name).filter(|name| !name.is_empty())
}

/// Demonstration name: folder and file without extension, as in `painted-percentage/demo-1`.
fn name(path: &Path) -> String {
    let own = path.file_stem().map_or_else(|| "demonstration".to_owned(), |stem| stem.to_string_lossy().into_owned());
    folder_name(path).map_or_else(|| own.clone(), |folder| format!("{folder}/{own}"))
}

/// Stream name: the folder's name if it is that of a known stream (the authors keep one folder per stream), else the
/// file's.
fn stream(path: &Path) -> String {
    let known = |name: &String| (1..=7).any(|columns| known_features(name, columns).is_some());
    let own = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    folder_name(path).filter(known).or(own).unwrap_or_else(|| "stream".to_owned())
}
