//! `rungbook table`: reads, converts and aligns test tables, and makes concrete ones from them.
#![expect(clippy::disallowed_methods, reason = "cli reads what the command line names")]

mod check;
mod convert;
mod fmt;
mod instances;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, Subcommand};

use crate::cli::args::{Level, Output};
use crate::cli::{Exit, Failure, tree};
use crate::config::tables::TableReading;
use crate::table::form::{self, Form};
use crate::table::model::Table;
use crate::table::read::{self, Options, Read};
use crate::text::{FileId, Files, decode};

/// `rungbook table`.
#[derive(Debug, Args)]
pub(crate) struct TableArgs {
    #[command(subcommand)]
    command: TableCommand,
}

#[derive(Debug, Subcommand)]
enum TableCommand {
    /// Read tables and report what is wrong with them, without the block that they specify
    Check(CheckArgs),
    /// Write the tables of a file in another form
    Convert(ConvertArgs),
    /// Align pipe tables where they stand, in comments and Markdown, and touch nothing else
    Fmt(FmtArgs),
    /// Make concrete test tables from a generalized one, with values that satisfy it
    Instances(InstancesArgs),
}

/// What a table leaves to the caller.
#[derive(Debug, Args)]
struct ReadArgs {
    /// Length of a cycle (`10ms`), for tables that state none
    #[arg(long, value_name = "TIME")]
    cycle: Option<String>,
    /// Value of a time constant, in cycles or as a time; may be repeated
    #[arg(long = "const", value_name = "NAME=VALUE")]
    constants: Vec<String>,
    /// Configuration with the mapping of spreadsheet columns [default: rungbook.toml here, if there is one]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

#[derive(Debug, Args)]
struct CheckArgs {
    /// Files that hold tables
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadArgs,
    /// Fail from this severity on
    #[arg(long, value_enum, value_name = "SEVERITY", default_value = "warning")]
    deny: Level,
    /// How to print
    #[arg(long, value_enum, default_value_t = Output::Text)]
    format: Output,
}

#[derive(Debug, Args)]
struct ConvertArgs {
    /// File to read
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// File to write; `-` for stdout
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Form to write: pipe, gtt, csv, xlsx, ods, exteta, stvs, test-manager [default: by the name of OUT]
    #[arg(long, value_name = "FORM")]
    to: Option<String>,
    /// Only the table of this name
    #[arg(long, value_name = "NAME")]
    table: Option<String>,
    #[command(flatten)]
    read: ReadArgs,
}

#[derive(Debug, Args)]
struct FmtArgs {
    /// Files to align
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Write nothing; exit with 1 if a file would change
    #[arg(long)]
    check: bool,
}

#[derive(Debug, Args)]
struct InstancesArgs {
    /// Name of the table, or the file that holds it
    #[arg(value_name = "TABLE")]
    table: String,
    #[command(flatten)]
    tree: crate::cli::args::TreeArgs,
    /// File to write; `-` for stdout
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    output: PathBuf,
    /// Form to write: pipe, gtt, csv, xlsx, ods, test-manager, tcunit [default: by the name of OUT, else pipe]
    #[arg(long, value_name = "FORM")]
    to: Option<String>,
    /// How instances are chosen
    #[arg(long, value_enum, value_name = "HOW", default_value_t = How::Covering)]
    by: How,
    /// How many at most
    #[arg(long, value_name = "NUMBER", default_value_t = 100)]
    count: usize,
    /// From what is drawn
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// How many cycles a row without end lasts
    #[arg(long, value_name = "CYCLES", default_value_t = 5)]
    forever: u64,
}

/// How instances are chosen.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum How {
    /// Every row, and both bounds of every duration
    Covering,
    /// The lowest and the highest values
    Boundary,
    /// Each two of durations and inputs at each combination of lowest and highest
    Pairwise,
    /// Drawn ways and values
    Random,
}

pub(crate) fn run(args: &TableArgs) -> Result<Exit, Failure> {
    match &args.command {
        TableCommand::Check(args) => check::run(args),
        TableCommand::Convert(args) => convert::run(args),
        TableCommand::Fmt(args) => fmt::run(args),
        TableCommand::Instances(args) => instances::run(args),
    }
}

impl ReadArgs {
    /// How tables are read: as configured, and as the command line says.
    fn reading(&self) -> Result<TableReading, Failure> {
        let mut reading = tree::settings(Path::new("."), self.config.as_deref())?.tables;
        if let Some(text) = &self.cycle {
            let message = format!("`--cycle {text}` is no time such as `10ms`");
            reading.all.cycle = Some(read::time(text).ok_or(Failure(message))?);
        }
        for text in &self.constants {
            let wrong = || Failure(format!("`--const {text}` is not of the form `NAME=5` or `NAME=200ms`"));
            let (name, value) = text.split_once('=').ok_or_else(wrong)?;
            let value = read::quantity(value).ok_or_else(wrong)?;
            reading.all.constants.insert(name.trim().to_owned(), value);
        }
        Ok(reading)
    }
}

/// The bytes of a file.
fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| Failure(format!("`{}`: {error}", path.display())))
}

/// Reads the tables of a file, which becomes the next one of `files`.
fn tables(path: &Path, reading: &TableReading, files: &mut Files) -> Result<Read, Failure> {
    let bytes = bytes(path)?;
    let name = path.to_string_lossy().replace('\\', "/");
    let binary = Form::of_name(&name).is_some_and(Form::is_binary);
    let decoded = if binary { decode::decode(b"") } else { decode::decode(&bytes) };
    let text: Arc<str> = Arc::from(decoded.text);
    let id: FileId = files.add(name.clone(), Arc::clone(&text), decoded.encoding);
    let options: Options = reading.options(&name);
    Ok(form::read(&form::File { id, path: &name, text: &text, bytes: &bytes }, &options))
}

/// The tables that are meant: all, or the one of that name.
fn chosen<'t>(tables: &'t [Table], name: Option<&str>) -> Result<Vec<&'t Table>, Failure> {
    let found: Vec<&Table> =
        tables.iter().filter(|table| name.is_none_or(|name| table.name.eq_ignore_ascii_case(name))).collect();
    match (found.is_empty(), name) {
        (false, _) => Ok(found),
        (true, None) => Err(Failure("no test table was found".to_owned())),
        (true, Some(name)) => {
            let near = crate::text::near::nearest(name, tables.iter().map(|table| table.name.as_str()));
            let near = near.map_or_else(String::new, |near| format!("; `{near}` is one"));
            Err(Failure(format!("no table is named `{name}`{near}")))
        }
    }
}
