//! `rungbook table convert`: the tables of a file in another form. A table with errors is not converted.

use super::ConvertArgs;
use crate::cli::report::text;
use crate::cli::{Exit, Failure, print, say, write};
use crate::diagnostic::Severity;
use crate::table::form::{self, Form};
use crate::text::Files;

pub(super) fn run(args: &ConvertArgs) -> Result<Exit, Failure> {
    let form = self::form(args.to.as_deref(), &args.output.to_string_lossy())?;
    let mut files = Files::default();
    let read = super::tables(&args.input, &args.read.reading()?, &mut files)?;
    if read.has_errors() {
        text::findings(read.findings.iter().filter(|f| f.severity == Severity::Error), &files);
        say(&format!("`{}` has errors; nothing was written", args.input.display()));
        return Ok(Exit::Findings);
    }
    // What a spreadsheet left open is said, since it is settled by what is written.
    let guesses = read.findings.iter().filter(|f| f.code == &crate::table::codes::TABLE_IMPORT_GUESS);
    guesses.for_each(|finding| say(&format!("guessed: {}", finding.message)));
    let tables = super::chosen(&read.tables, args.table.as_deref())?;
    let written = form::write(form, &tables).map_err(Failure)?;
    written.lost.iter().for_each(|lost| say(&format!("left out: {lost}")));
    output(&args.output, &written.content)?;
    Ok(Exit::Ok)
}

/// The form that is asked for, or that the name of the file says.
pub(super) fn form(to: Option<&str>, name: &str) -> Result<Form, Failure> {
    let keys = || Form::ALL.map(Form::key).join(", ");
    match to {
        Some(key) => Form::named(key).ok_or_else(|| Failure(format!("`{key}` is no form; the forms are {}", keys()))),
        None => Form::of_name(name)
            .ok_or_else(|| Failure(format!("the name `{name}` says no form; choose one with `--to`: {}", keys()))),
    }
}

/// Writes to a file, or to stdout for `-`.
pub(super) fn output(path: &std::path::Path, content: &[u8]) -> Result<(), Failure> {
    if path.as_os_str() != "-" {
        return write::file(path, content);
    }
    match std::str::from_utf8(content) {
        Ok(text) => print(text),
        Err(_) => return Err(Failure("a workbook is not printed; name a file with `-o`".to_owned())),
    }
    Ok(())
}
