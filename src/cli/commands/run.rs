//! `rungbook run`: plays tables on their blocks, or holds a recorded trace against them.
#![expect(clippy::disallowed_methods, reason = "cli reads the files that it is given")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::verify::{attach, memory};
use crate::cli::args::Output;
use crate::cli::report::progress::Progress;
use crate::cli::report::run::{self as report, Line};
use crate::cli::{Exit, Failure, print, say, tree, write};
use crate::config::{ConfigFile, Settings};
use crate::figure::timing::{self, Timing};
use crate::library::names::fold;
use crate::machine::trace::{Known, Trace, csv, lane, vcd};
use crate::pipeline::run::{NotPlayed, Options, kind, monitor, play};
use crate::pipeline::{self, Project};
use crate::source::{Disk, FileSystem};
use crate::table::read;

/// `rungbook run`.
#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// Tables by their names or those of their blocks, and where they are: a folder, or files [default: all in .]
    #[arg(value_name = "TABLE|DIR|FILE")]
    what: Vec<String>,
    /// Configuration file [default: DIR/rungbook.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// The block that all tables specify, whatever they say themselves
    #[arg(long, value_name = "NAME")]
    unit: Option<String>,
    /// Hold this recorded trace (CSV or VCD) against the tables, instead of playing them
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Cycle time of tables that state none, such as 4ms
    #[arg(long, value_name = "TIME")]
    cycle: Option<String>,
    /// Value of a global variable of the tables; may be repeated
    #[arg(long = "global", value_name = "NAME=VALUE")]
    globals: Vec<String>,
    /// Cycles of a row that lasts for ever
    #[arg(long, value_name = "N", default_value_t = 10)]
    cycles: u64,
    /// Repetitions of a block that is repeated for ever
    #[arg(long, value_name = "N", default_value_t = 2)]
    repeats: u64,
    /// Show the timing diagram of every table, not only of those that fail and of a single one
    #[arg(long)]
    diagram: bool,
    /// Write the run as comma-separated values; for a single table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the run as a value change dump; for a single table
    #[arg(long, value_name = "FILE")]
    vcd: Option<PathBuf>,
    /// Write the timing diagram as SVG; for a single table
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write a JUnit report
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t = Output::Text)]
    format: Output,
    /// No progress and no summary on stderr
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(args: &RunArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.quiet);
    let (paths, names): (Vec<&String>, Vec<&String>) = args.what.iter().partition(|what| Path::new(what).exists());
    let paths: Vec<PathBuf> = paths.into_iter().map(PathBuf::from).collect();
    let mut project = read_tree(args, &paths, &progress)?;
    if let Some(unit) = &args.unit {
        attach(&mut project, unit)?;
    }
    let chosen = chosen(&project, &names)?;
    let options = options(args)?;
    let mut lines = Vec::new();
    for index in chosen {
        let outcome = match &args.trace {
            Some(path) => held(&project, index, path),
            None => play(&project, index, &options),
        };
        lines.push(Line::new(&project, index, outcome));
    }
    progress.event(pipeline::Event::Done);
    write_files(args, &lines)?;
    match args.format {
        Output::Json => print(&format!("{:#}\n", report::json(&lines))),
        Output::Text => print(&report::text(&lines, args.diagram)),
    }
    if !args.quiet {
        say(&report::totals(&lines));
    }
    Ok(report::exit(&lines))
}

/// A folder with its configuration, or some files.
fn read_tree(args: &RunArgs, paths: &[PathBuf], progress: &Progress) -> Result<Project, Failure> {
    let folder = match paths {
        [] => Some(Path::new(".")),
        [one] if one.is_dir() => Some(one.as_path()),
        _ => None,
    };
    let mut settings = match (folder, &args.config) {
        (None, None) => Settings::new(ConfigFile::default()).map_err(|error| Failure(error.message))?,
        (folder, config) => tree::settings(folder.unwrap_or(Path::new(".")), config.as_deref())?,
    };
    if let Some(text) = &args.cycle {
        let cycle = read::time(text).filter(|nanos| *nanos > 0);
        let failure = || Failure(format!("`--cycle {text}` is no time; it takes `4ms`, `500us`, `T#1s`"));
        settings.tables.all.cycle = Some(cycle.ok_or_else(failure)?);
    }
    let (fs, name): (Box<dyn FileSystem>, String) = match folder {
        Some(folder) => {
            let dir = tree::folder(folder)?;
            let disk = Disk::new(&dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
            let name = dir.file_name().map_or_else(|| "tables".to_owned(), |name| name.to_string_lossy().into_owned());
            (Box::new(disk), name)
        }
        None => (Box::new(memory(paths)?), "files".to_owned()),
    };
    Ok(pipeline::read(fs.as_ref(), &name, &settings, &|event| progress.event(event)))
}

/// The tables of these names, or of blocks of these names; all without a name.
fn chosen(project: &Project, names: &[&String]) -> Result<Vec<usize>, Failure> {
    let fits = |index: usize, name: &str| {
        let attached = &project.tables[index];
        let block = attached.item.map(|item| &project.catalogue.item(item).name);
        fold(&attached.table.name) == fold(name) || block.is_some_and(|block| fold(block) == fold(name))
    };
    let all = 0..project.tables.len();
    for name in names {
        if !all.clone().any(|index| fits(index, name)) {
            return Err(Failure(format!("no table, block or file is named `{name}`")));
        }
    }
    let chosen: Vec<usize> =
        all.filter(|index| names.is_empty() || names.iter().any(|name| fits(*index, name))).collect();
    if chosen.is_empty() { Err(Failure("no test table was found".to_owned())) } else { Ok(chosen) }
}

fn options(args: &RunArgs) -> Result<Options, Failure> {
    let mut globals = BTreeMap::new();
    for text in &args.globals {
        let wrong = || Failure(format!("`--global {text}` is not of the form `NAME=VALUE`"));
        let (name, value) = text.split_once('=').ok_or_else(wrong)?;
        globals.insert(name.trim().to_owned(), value.trim().to_owned());
    }
    Ok(Options { cycles: args.cycles, repeats: args.repeats, globals })
}

/// Reads a recorded trace as the table's variables need it, and holds it against the table.
fn held(project: &Project, index: usize, path: &Path) -> Result<pipeline::run::Outcome, NotPlayed> {
    let unread = |message: String| NotPlayed { reasons: vec![message], is_wrong: true };
    let bytes = fs::read(path).map_err(|error| unread(format!("`{}`: {error}", path.display())))?;
    let kinds = |name: &str| {
        // A file may say where a variable lies in the plant: `Main.Cylinder.Extend`.
        let mut tail = Some(name);
        while let Some(name) = tail {
            if let Some(kind) = kind(project, index, name) {
                return Some(kind);
            }
            tail = name.split_once('.').map(|(_, tail)| tail);
        }
        None
    };
    let name = project.tables[index].table.name.clone();
    let known = Known { name: &name, cycle_time: pipeline::run::cycle_time(project, index), kind: &kinds };
    let is_dump = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("vcd"));
    let trace: Trace =
        if is_dump { vcd::read(&bytes, &known) } else { csv::read(&crate::text::decode::decode(&bytes).text, &known) }
            .map_err(|error| unread(format!("`{}`: {error}", path.display())))?;
    monitor(project, index, &trace)
}

fn write_files(args: &RunArgs, lines: &[Line]) -> Result<(), Failure> {
    if let Some(path) = &args.junit {
        write::file(path, report::junit(lines).map_err(Failure)?.as_bytes())?;
    }
    let files = [&args.csv, &args.vcd, &args.svg];
    if files.iter().all(|path| path.is_none()) {
        return Ok(());
    }
    let [line] = lines else {
        let message = format!("{} tables were chosen; a run is written of one: name it", lines.len());
        return Err(Failure(message));
    };
    let Ok(outcome) = &line.outcome else { return Ok(()) };
    if let Some(path) = &args.csv {
        write::file(path, csv::write(&outcome.trace).as_bytes())?;
    }
    if let Some(path) = &args.vcd {
        write::file(path, &vcd::write(&outcome.trace))?;
    }
    if let Some(path) = &args.svg {
        let mark = (!outcome.passed).then(|| outcome.trace.cycles().saturating_sub(1));
        let drawn = Timing { name: outcome.trace.name.clone(), lanes: lane::lanes(&outcome.trace), mark };
        write::file(path, timing::draw(&drawn).to_svg().as_bytes())?;
    }
    Ok(())
}
