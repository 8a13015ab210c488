//! Errors of broken presets, and the repository's presets for the unit tests of this crate.

use super::*;
use std::path::Path;

fn read(file: &str) -> Result<String, String> {
    let presets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/presets");
    std::fs::read_to_string(presets.join(file)).map_err(|error| error.to_string())
}

/// A preset of `examples/presets`.
pub(crate) fn shipped(name: &str) -> Result<Preset, PresetError> {
    parse(name, &read(&format!("{name}.toml")).unwrap(), read)
}

#[test]
fn errors_say_where() {
    let error = parse("mine", "description = 3", |_| Ok(String::new())).unwrap_err().to_string();
    assert!(error.contains("mine") && error.contains("line 1"), "{error}");
    let text = read("wax.toml").unwrap();
    let error = parse("mine", &text, |_| Err("no such file".into())).unwrap_err().to_string();
    assert!(error.contains("teo_right_arm.urdf") && error.contains("no such file"), "{error}");
    let misspelt = text.replace("free_joints", "free_joint");
    assert!(parse("mine", &misspelt, |_| Ok(String::new())).is_err());
}

#[test]
fn a_method_is_chosen_with_the_presets_own_parameters() {
    let mut preset = shipped("paper-wax").unwrap();
    let own = preset.methods.first().cloned().unwrap();
    assert!(preset.select_method(own.name()));
    assert_eq!(preset.problem.execution.method, own);
    assert!(preset.select_method("broyden") && !preset.select_method("annealing"));
    assert_eq!(preset.problem.execution.method.name(), "broyden");
}
