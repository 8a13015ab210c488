//! Tests of sources, precedence and errors.

use super::*;

/// Reads `toml` as `cgda.toml`, with environment variables and flags.
fn read(toml: &str, variables: &[(&str, &str)], flags: &Flags) -> Result<Config, ConfigError> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("cgda.toml");
    std::fs::write(&path, toml).unwrap();
    let variables = variables.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    Config::of(Some(&path), variables, flags)
}

fn load(toml: &str) -> Result<Config, ConfigError> {
    read(toml, &[], &Flags::default())
}

fn from_environment(name: &str, text: &str) -> Result<Config, ConfigError> {
    read("", &[(name, text)], &Flags::default())
}

#[test]
fn a_file_changes_what_it_names_only() {
    let config = load("[jobs]\nworkers = 7\n").unwrap();
    assert_eq!(config, Config { jobs: JobsConfig { workers: Some(7), ..JobsConfig::default() }, ..Config::default() });
}

#[test]
fn unknown_keys_are_refused_by_name_and_source() {
    for (toml, name) in [("[jobs]\nworker = 7\n", "worker"), ("[job]\nworkers = 7\n", "job"), ("x = 1", "x")] {
        let text = load(toml).unwrap_err().to_string();
        assert!(text.contains(&format!("`{name}`, expected one of `")), "{text}");
        assert!(text.ends_with("cgda.toml)"), "{text}");
    }
    let text = from_environment("CGDA_JOBS__WORKER", "7").unwrap_err().to_string();
    assert!(
        text.contains("jobs.worker: unknown field `worker`") && text.ends_with("(set by CGDA_JOBS__WORKER)"),
        "{text}"
    );
}

#[test]
fn values_of_another_type_are_refused_with_key_and_source() {
    for (toml, key) in [
        ("[jobs]\nworkers = \"x\"\n", "jobs.workers"),
        ("[jobs]\nworkers = -1\n", "jobs.workers"),
        ("[jobs]\nlease_ms = 1000.5\n", "jobs.lease_ms"),
        ("[server]\nallow_remote = \"yes\"\n", "server.allow_remote"),
        ("[server]\nhosts = [\"a\", 1]\n", "server.hosts[1]"),
        ("[log]\nformat = \"xml\"\n", "log.format"),
        ("jobs = 3\n", "jobs"),
    ] {
        let text = load(toml).unwrap_err().to_string();
        assert!(text.starts_with(&format!("invalid configuration: {key}: ")), "{text}");
        assert!(text.ends_with("cgda.toml)"), "{text}");
    }
}

#[test]
fn the_environment_wins_over_the_file_and_flags_win_over_both() {
    let toml = "[server]\nlisten = \"127.0.0.1:1\"\n[jobs]\nworkers = 1\nlease_ms = 9000\n";
    let variables = [("CGDA_SERVER__LISTEN", "127.0.0.1:2"), ("CGDA_JOBS__WORKERS", "2"), ("CGDA_TOKEN", "not a key")];
    let flags = Flags::default().with("server.listen", "--listen", Some("127.0.0.1:3"));
    let config = read(toml, &variables, &flags.with("jobs.workers", "--workers", None::<i64>)).unwrap();
    assert_eq!((config.server.listen.port(), config.jobs.workers, config.jobs.lease_ms), (3, Some(2), 9000));
}

#[test]
fn variables_are_toml_or_plain_text() {
    for text in ["[a.example,b]", "[a.example, b]", "[\"a.example\", \"b\"]"] {
        assert_eq!(from_environment("CGDA_SERVER__HOSTS", text).unwrap().server.hosts, ["a.example", "b"], "{text}");
    }
    for (text, read) in [("info,cgda=debug", "info,cgda=debug"), ("\"warn\"", "warn"), ("", "")] {
        assert_eq!(from_environment("cgda_log__filter", text).unwrap().log.filter, read);
    }
    let text = from_environment("CGDA_SERVER__ALLOW_REMOTE", "1").unwrap_err().to_string();
    assert!(text.contains("server.allow_remote") && text.ends_with("(set by CGDA_SERVER__ALLOW_REMOTE)"), "{text}");
}

#[test]
fn values_out_of_bounds_are_refused_with_bounds_and_source() {
    let flags = Flags::default().with("jobs.workers", "--workers", Some(0));
    for (result, expected) in [
        (load("[jobs]\nlease_ms = 10\n"), "jobs.lease_ms is 10: give 500 to 3600000 (set by "),
        (read("", &[], &flags), "jobs.workers is 0: give 1 to 1024 (set by --workers)"),
        (load("[jobs]\nlease_ms = 3000\n"), "jobs.heartbeat_ms is 2000: give 50 to a third of jobs.lease_ms"),
    ] {
        let text = result.unwrap_err().to_string();
        assert!(text.contains(expected), "{text}");
    }
}

#[test]
fn a_file_that_is_no_toml_is_refused_with_its_name_and_the_place() {
    let text = load("[server\n").unwrap_err().to_string();
    assert!(text.contains("cgda.toml: TOML parse error at line 1, column 8"), "{text}");
}
