//! The model as JSON: valid by its schema, and with the same totals as everything else.

use crate::support::{book, project};
use rungbook::book::model;

fn files() -> Vec<(String, String)> {
    let mut files = Vec::new();
    for sample in ["pick-and-place", "basics", "flawed"] {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(sample);
        gather(&root, sample, &mut files);
    }
    files
}

fn gather(folder: &std::path::Path, prefix: &str, out: &mut Vec<(String, String)>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).expect("a sample").flatten().map(|e| e.path()).collect();
    entries.sort();
    for path in entries {
        let name = format!("{prefix}/{}", path.file_name().expect("a name").to_string_lossy());
        if path.is_dir() {
            gather(&path, &name, out);
        } else if let Ok(text) = std::fs::read_to_string(&path) {
            out.push((name, text));
        }
    }
}

#[test]
fn the_model_of_the_samples_is_valid() {
    let files = files();
    let files: Vec<(&str, &str)> = files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let project = project(&files, "");
    let model: serde_json::Value = serde_json::from_str(&model::render(&book(&project))).expect("JSON");
    let schema: serde_json::Value = serde_json::from_str(model::SCHEMA).expect("JSON");
    let validator = jsonschema::validator_for(&schema).expect("a schema");
    let faults: Vec<String> =
        validator.iter_errors(&model).map(|error| format!("{}: {error}", error.instance_path())).take(10).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(model["entities"].as_array().is_some_and(|list| list.len() > 80), "the samples hold more entities");
}

#[test]
fn totals_are_those_of_the_lists() {
    let files = files();
    let files: Vec<(&str, &str)> = files.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
    let project = project(&files, "");
    let book = book(&project);
    let model: serde_json::Value = serde_json::from_str(&model::render(&book)).expect("JSON");
    let len = |key: &str| model[key].as_array().map_or(0, Vec::len);
    let total = |key: &str| usize::try_from(model["totals"][key].as_u64().expect("a number")).expect("small");
    assert_eq!(len("entities"), total("entities"));
    assert_eq!(len("tables"), total("tables"));
    assert_eq!(len("skipped"), total("files_skipped"));
    assert_eq!(len("findings"), total("errors") + total("warnings") + total("infos"));
    assert_eq!(len("findings"), project.findings.len());
    assert_eq!(total("documented") + total("undocumented"), total("entities"));
    assert_eq!(book.index.len(), total("entities"));
    assert_eq!(book.coverage.undocumented.len(), total("undocumented"));
    let counted: usize = book.codes.iter().map(|code| code.count).sum();
    assert_eq!(counted, project.findings.len());
}
