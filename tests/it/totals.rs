//! The totals of a manual are the same wherever they are shown: JSON, site, console, and the PDF where it is built.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Files of every kind that is counted: read, broken, skipped with a reason, and no source at all.
const FILES: [(&str, &str); 8] = [
    (
        "a.st",
        "// Adds.\n// @gtt Adds\n// | # | in x : INT | out y : INT | dur |\n// |---|---|---|---|\n// | 1 | 1 | 2 | 1 |\nFUNCTION_BLOCK FB_Add\nVAR_INPUT x : INT; END_VAR\nVAR_OUTPUT y : INT; END_VAR\ny := x + 1;\nEND_FUNCTION_BLOCK\n",
    ),
    ("b.st", "FUNCTION_BLOCK FB_Bare\nVAR u : INT; END_VAR\nu := ;\nEND_FUNCTION_BLOCK\n"),
    ("c.st", "PROGRAM P\n{IF defined (x)}\nx := 1 == 2\n{END_IF}\nEND_PROGRAM\n"),
    ("sub/d.scl", "FUNCTION \"F\" : Int\nBEGIN\n#x := 1;\nEND_FUNCTION\n"),
    ("e.project", "\u{0}\u{1}binary"),
    ("f.sfc", "SFC a\nEND_SFC\n"),
    ("notes.txt", "nothing"),
    (
        "p.TcPOU",
        "<TcPlcObject><POU Name=\"L\"><Declaration><![CDATA[FUNCTION_BLOCK L]]></Declaration><Implementation><CFC>x</CFC></Implementation></POU></TcPlcObject>",
    ),
];

fn built(output: &Path, formats: &[&str]) -> String {
    let tree = TempDir::new().expect("a folder");
    for (path, text) in FILES {
        let path = tree.path().join(path);
        fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
    let mut command = Command::cargo_bin("rungbook").expect("the binary of this package");
    command.env("SOURCE_DATE_EPOCH", "1795305600").arg("build").args(formats).arg("-o").arg(output).arg(tree.path());
    String::from_utf8_lossy(&command.assert().code(0).get_output().stderr).into_owned()
}

/// The totals of the model.
struct Totals(Value);

impl Totals {
    fn get(&self, key: &str) -> u64 {
        self.0[key].as_u64().expect("a number")
    }

    fn all_differ_from_nothing(&self) {
        for key in ["entities", "documented", "undocumented", "tables", "files", "files_skipped", "files_other"] {
            assert!(self.get(key) > 0, "{key}");
        }
        for key in ["errors", "warnings", "infos"] {
            assert!(self.get(key) > 0, "{key}");
        }
    }
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The text of a page, without its tags.
fn bare(html: &str) -> String {
    let pieces = html.split('<').map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text));
    words(&pieces.collect::<Vec<_>>().join(" "))
}

#[track_caller]
fn says(text: &str, wanted: &str) {
    assert!(words(text).contains(wanted), "`{wanted}` is missing in:\n{text}");
}

fn console(totals: &Totals, summary: &str) {
    let n = |key| totals.get(key);
    says(summary, &format!("entities {} in", n("entities")));
    says(summary, &format!("undocumented {}", n("undocumented")));
    says(summary, &format!("documented {} (", n("documented")));
    says(summary, &format!("tables {}:", n("tables")));
    says(summary, &format!("{} errors, {} warnings, {} infos", n("errors"), n("warnings"), n("infos")));
    let files = [n("files"), n("files_skipped"), n("files_other")];
    says(summary, &format!("{} read, {} skipped, {} not PLC source", files[0], files[1], files[2]));
}

fn site(totals: &Totals, folder: &Path) {
    let n = |key| totals.get(key);
    let page = |name: &str| bare(&fs::read_to_string(folder.join(name)).expect("a page"));
    let front = page("index.html");
    says(&front, &format!("{} entities", n("entities")));
    says(&front, &format!("{} % documented", n("documented") * 100 / n("entities")));
    says(&front, &format!("{} test tables", n("tables")));
    says(&front, &format!("{} findings", n("errors") + n("warnings") + n("infos")));
    says(&front, &format!("{} source files", n("files")));
    let findings = page("findings.html");
    says(&findings, &format!("errors: {} warnings: {} infos: {}", n("errors"), n("warnings"), n("infos")));
    let files = page("files.html");
    says(&files, &format!("{} source files were read; {} are not", n("files"), n("files_skipped")));
    says(&files, &format!("{} are no PLC source", n("files_other")));
}

#[test]
fn console_site_and_model_tell_the_same() {
    let output = TempDir::new().expect("a folder");
    let summary = built(output.path(), &["--html", "--json"]);
    let model = fs::read_to_string(output.path().join("model.json")).expect("a model");
    let model: Value = serde_json::from_str(&model).expect("JSON");
    let totals = Totals(model["totals"].clone());
    totals.all_differ_from_nothing();
    let findings = model["findings"].as_array().expect("a list");
    let of = |severity: &str| findings.iter().filter(|finding| finding["severity"] == severity).count() as u64;
    assert_eq!([of("error"), of("warning"), of("info")], ["errors", "warnings", "infos"].map(|key| totals.get(key)));
    assert_eq!(model["skipped"].as_array().expect("a list").len() as u64, totals.get("files_skipped"));
    console(&totals, &summary);
    site(&totals, &output.path().join("html"));
}

#[cfg(feature = "pdf")]
#[test]
fn the_pdf_tells_what_the_model_tells() {
    let output = TempDir::new().expect("a folder");
    let summary = built(output.path(), &["--pdf", "--json"]);
    let model = fs::read_to_string(output.path().join("model.json")).expect("a model");
    let model: Value = serde_json::from_str(&model).expect("JSON");
    let totals = Totals(model["totals"].clone());
    console(&totals, &summary);
    let pdf = output.path().join("manual.pdf");
    let text =
        match std::process::Command::new("pdftotext").args(["-layout", "-enc", "UTF-8"]).arg(&pdf).arg("-").output() {
            Ok(done) => String::from_utf8_lossy(&done.stdout).replace(['\u{200b}', '\u{2060}', '\u{ad}'], ""),
            Err(error) => {
                eprintln!("skipped: `pdftotext` does not run here ({error})");
                return;
            }
        };
    let counted = |key: &str, one: &str, many: &str| match totals.get(key) {
        1 => format!("1 {one}"),
        n => format!("{n} {many}"),
    };
    says(&text, &counted("entities", "entity", "entities"));
    says(&text, &format!("of which {} documented", totals.get("documented")));
    says(&text, &counted("tables", "test table", "test tables"));
    let severities = [("errors", "error"), ("warnings", "warning"), ("infos", "remark")];
    let severities = severities.map(|(key, one)| counted(key, one, &format!("{one}s")));
    says(&text, &format!("{}, {}, {} and", severities[0], severities[1], severities[2]));
    says(&text, &format!("{} that could not be read", counted("files_skipped", "file", "files")));
}
