//! The command line: exit codes, what goes to stdout and to stderr, what is written.

mod export;
mod run;
mod table;

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

fn rungbook() -> Command {
    let mut command = Command::cargo_bin("rungbook").expect("the binary of this package");
    command.env("SOURCE_DATE_EPOCH", "1795305600").env_remove("NO_COLOR");
    command
}

fn tree(files: &[(&str, &str)]) -> TempDir {
    let dir = TempDir::new().expect("a folder");
    for (path, text) in files {
        let path = dir.path().join(path);
        fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
    dir
}

fn stdout(command: &mut Command) -> String {
    String::from_utf8(command.output().expect("it runs").stdout).expect("UTF-8")
}

fn sample(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name)
}

const CLEAN: &str = "// Opens and closes.\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
const BARE: &str = "FUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";

#[test]
fn check_exits_0_when_nothing_is_wrong() {
    let dir = tree(&[("a.st", CLEAN)]);
    rungbook().arg("check").arg(dir.path()).assert().code(0).stdout("");
}

#[test]
fn check_exits_1_at_the_denied_severity_and_0_below_it() {
    let dir = tree(&[("a.st", BARE)]);
    rungbook().arg("check").arg(dir.path()).assert().code(1);
    rungbook().args(["check", "--deny", "error"]).arg(dir.path()).assert().code(0);
    let dir = tree(&[("a.st", BARE), ("rungbook.toml", "[audit]\ndeny = \"error\"\n")]);
    rungbook().arg("check").arg(dir.path()).assert().code(0);
}

#[test]
fn check_exits_2_for_what_it_cannot_use() {
    rungbook().args(["check", "/no/such/folder"]).assert().code(2);
    rungbook().args(["check", "--deny", "nothing"]).assert().code(2);
    let dir = tree(&[("a.st", CLEAN), ("rungbook.toml", "titel = 1\n")]);
    rungbook().arg("check").arg(dir.path()).assert().code(2);
}

#[test]
fn a_finding_is_printed_with_code_place_line_and_help() {
    let dir = tree(&[("a.st", BARE)]);
    let text = stdout(rungbook().arg("check").arg(dir.path()));
    for part in ["warning[undocumented]", "a.st:1:16", "FUNCTION_BLOCK FB_Valve", "^^^^^^^^", "help: "] {
        assert!(text.contains(part), "{part} is missing in:\n{text}");
    }
    assert!(!text.contains('\u{1b}'), "no colours where stdout is no terminal");
}

#[test]
fn findings_as_json_are_one_object() {
    let dir = tree(&[("a.st", BARE)]);
    let text = stdout(rungbook().args(["check", "--format", "json"]).arg(dir.path()));
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(json["findings"][0]["code"], "undocumented");
    assert_eq!(json["findings"][0]["line"], 1);
    assert_eq!(json["findings"][0]["column"], 16);
    assert_eq!(json["totals"]["warning"], 1);
    assert_eq!(json["failed"], true);
}

#[test]
fn explain_prints_every_codes_page_and_refuses_unknown_ones() {
    let list = stdout(rungbook().arg("explain"));
    assert!(list.lines().count() > 10);
    for line in list.lines() {
        let code = line.split_whitespace().next().expect("a code");
        let page = stdout(rungbook().args(["explain", code]));
        assert!(page.starts_with("# "), "{code}:\n{page}");
    }
    let dir = tree(&[("a.st", CLEAN)]);
    rungbook().args(["explain", "no-such-code"]).arg(dir.path()).assert().code(2);
}

#[test]
fn explain_tells_which_comment_documents_an_entity() {
    let dir = tree(&[("a.st", CLEAN)]);
    let text = stdout(rungbook().args(["explain", "fb_valve"]).arg(dir.path()));
    assert!(text.contains("Function block FB_Valve") && text.contains("taken: line 1"), "{text}");
}

#[test]
fn init_writes_a_configuration_once() {
    let dir = tree(&[]);
    rungbook().arg("init").arg(dir.path()).assert().code(0);
    let text = fs::read_to_string(dir.path().join("rungbook.toml")).expect("written");
    assert!(text.contains("[audit]"));
    rungbook().arg("init").arg(dir.path()).assert().code(2);
    rungbook().arg("check").arg(dir.path()).assert().code(0);
}

#[test]
fn build_writes_site_and_model_and_a_summary() {
    let out = TempDir::new().expect("a folder");
    let run =
        rungbook().args(["build", "--html", "--json", "-o"]).arg(out.path()).arg(sample("basics")).assert().code(0);
    let summary = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    for word in ["entities", "documented", "undocumented", "tables", "verified", "files"] {
        assert!(summary.contains(word), "{word} is missing in:\n{summary}");
    }
    assert!(run.get_output().stdout.is_empty());
    assert!(out.path().join("html/index.html").is_file());
    assert!(out.path().join("model.json").is_file());
    assert!(!out.path().join("manual.pdf").exists(), "not asked for");
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let build = || {
        let out = TempDir::new().expect("a folder");
        rungbook()
            .args(["build", "-q", "--html", "--json", "-o"])
            .arg(out.path())
            .arg(sample("pick-and-place"))
            .assert()
            .code(0);
        let mut files = Vec::new();
        collect(out.path(), out.path(), &mut files);
        files
    };
    assert_eq!(build(), build());
}

fn collect(root: &Path, at: &Path, out: &mut Vec<(String, Vec<u8>)>) {
    let mut entries: Vec<_> = fs::read_dir(at).expect("a folder").flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(root, &path, out);
        } else {
            let name = path.strip_prefix(root).expect("below").to_string_lossy().into_owned();
            out.push((name, fs::read(&path).expect("readable")));
        }
    }
}

#[test]
fn a_folder_of_somebody_elses_is_not_overwritten() {
    let out = tree(&[("html/precious.txt", "mine")]);
    rungbook().args(["build", "--html", "-o"]).arg(out.path()).arg(sample("basics")).assert().code(2);
    assert!(out.path().join("html/precious.txt").is_file());
}

#[test]
fn the_output_inside_the_tree_is_not_read_again() {
    let dir = tree(&[("a.st", CLEAN)]);
    for _ in 0..2 {
        rungbook().args(["build", "-q", "--html", "--json"]).arg(dir.path()).assert().code(0);
    }
    let model = fs::read_to_string(dir.path().join("target/rungbook/model.json")).expect("written");
    let model: serde_json::Value = serde_json::from_str(&model).expect("JSON");
    assert_eq!(model["totals"]["files"], 1);
    assert_eq!(model["totals"]["files_other"], 0);
}

#[test]
fn help_teaches_and_documents_the_exit_codes() {
    let text = stdout(rungbook().arg("--help"));
    for part in ["build", "check", "explain", "init", "Exit codes", "NO_COLOR"] {
        assert!(text.contains(part), "{part} is missing in:\n{text}");
    }
    assert!(stdout(rungbook().args(["completions", "bash"])).contains("_rungbook"));
    assert!(stdout(rungbook().arg("man")).contains(".TH rungbook"));
}
