//! `rungbook verify`: decides whether blocks conform to their tables.
#![expect(clippy::disallowed_methods, reason = "cli reads the files that it is given")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use crate::cli::args::{Output, VerifyArgs};
use crate::cli::report::{progress::Progress, verdict};
use crate::cli::store::Store;
use crate::cli::{Exit, Failure, print, say, stamp, tree, write};
use crate::config::{ConfigFile, Settings};
use crate::evidence::record::{Answer, Record};
use crate::library::ItemKind;
use crate::library::names::fold;
use crate::pipeline::verify::Verified;
use crate::pipeline::{self, Project, answer, export, records};
use crate::prove::engine::Cancel;
use crate::semantics::fixed::Reading;
use crate::source::{Disk, FileSystem, Memory};
use crate::table::read;

/// What is verified, and where verdicts are kept.
struct Job {
    project: Project,
    settings: Settings,
    fs: Box<dyn FileSystem>,
    /// None for files without a folder.
    store: Option<Store>,
    dir: PathBuf,
}

pub(crate) fn run(args: &VerifyArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.quiet);
    let mut job = job(args, &progress)?;
    if let Some(unit) = &args.unit {
        attach(&mut job.project, unit)?;
    }
    if job.store.is_none() {
        attach_alone(&mut job.project);
    }
    let chosen = chosen(&job.project, args.table.as_deref())?;
    if let Some(folder) = &args.aiger {
        return obligations(&job.project, &chosen, folder);
    }
    let done = decide(&job, &chosen, args.fresh, &progress)?;
    match args.format {
        Output::Json => print(&format!("{:#}\n", verdict::json(&job.project, &done))),
        Output::Text => print(&verdict::text(&job.project, &done)),
    }
    if !args.quiet {
        say(&verdict::totals(&done));
    }
    Ok(verdict::exit(&done))
}

/// Decides what the store of the folder `dir` does not know, for a command that goes on with the verdicts.
///
/// # Errors
/// If the folder cannot be read, or the store not written.
pub(crate) fn settle(
    dir: &Path,
    (project, settings): (Project, Settings),
    progress: &Progress,
) -> Result<(Project, Settings), Failure> {
    let disk = Disk::new(dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
    let store = Some(Store::new(dir, &settings));
    let job = Job { project, settings, fs: Box::new(disk), store, dir: dir.to_owned() };
    let all: Vec<usize> = (0..job.project.tables.len()).collect();
    decide(&job, &all, false, progress)?;
    Ok((job.project, job.settings))
}

/// A folder with its configuration, or some files.
fn job(args: &VerifyArgs, progress: &Progress) -> Result<Job, Failure> {
    let folder = match args.paths.as_slice() {
        [] => Some(Path::new(".")),
        [one] if one.is_dir() => Some(one.as_path()),
        _ => None,
    };
    let dir = folder.map_or_else(|| Ok(PathBuf::from(".")), tree::folder)?;
    let mut settings = match (folder, &args.config) {
        (None, None) => Settings::new(ConfigFile::default()).map_err(|error| Failure(error.message))?,
        _ => tree::settings(&dir, args.config.as_deref())?,
    };
    apply(args, &mut settings)?;
    let (fs, name): (Box<dyn FileSystem>, String) = match folder {
        Some(_) => {
            let disk = Disk::new(&dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
            let name = dir.file_name().map_or_else(|| "manual".to_owned(), |name| name.to_string_lossy().into_owned());
            (Box::new(disk), name)
        }
        None => (Box::new(memory(&args.paths)?), "files".to_owned()),
    };
    let project = pipeline::read(fs.as_ref(), &name, &settings, &|event| progress.event(event));
    let store = folder.map(|_| Store::new(&dir, &settings));
    Ok(Job { project, settings, fs, store, dir })
}

/// The options of the command line win.
fn apply(args: &VerifyArgs, settings: &mut Settings) -> Result<(), Failure> {
    let options = &mut settings.verify.options;
    if let Some(seconds) = args.timeout {
        options.timeout = Duration::try_from_secs_f64(seconds)
            .map_err(|_| Failure(format!("`--timeout {seconds}` is no time in seconds")))?;
    }
    options.memory = args.memory.unwrap_or(options.memory);
    options.strict |= args.strict;
    if let Some(text) = &args.fixed {
        let reading = Reading::parse(text).map_err(|message| Failure(format!("`--fixed {text}`: {message}")))?;
        settings.verify.fixed = Some(reading);
    }
    settings.verify.mutants |= args.mutants;
    settings.verify.coverage |= args.mutants;
    settings.verify.jobs = args.jobs.unwrap_or(settings.verify.jobs);
    if let Some(text) = &args.cycle {
        let cycle = read::time(text).filter(|nanos| *nanos > 0);
        let failure = || Failure(format!("`--cycle {text}` is no time; it takes `4ms`, `500us`, `T#1s`"));
        settings.tables.all.cycle = Some(cycle.ok_or_else(failure)?);
    }
    for text in &args.constants {
        let value = text.split_once('=').and_then(|(name, value)| Some((name.trim(), read::quantity(value)?)));
        let failure = || Failure(format!("`--const {text}` is no constant; it takes `TOUT=10` or `TOUT=200ms`"));
        let (name, value) = value.ok_or_else(failure)?;
        settings.tables.all.constants.insert(name.to_owned(), value);
    }
    Ok(())
}

/// The files, by their names; files of one name keep their folders.
pub(super) fn memory(paths: &[PathBuf]) -> Result<Memory, Failure> {
    let mut fs = Memory::new();
    for path in paths {
        let bytes = fs::read(path).map_err(|error| Failure(format!("`{}`: {error}", path.display())))?;
        let short = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let twice = paths.iter().filter(|other| other.file_name() == path.file_name()).count() > 1;
        let name = if twice { path.to_string_lossy().trim_start_matches(['/', '.']).to_owned() } else { short };
        fs = fs.with(&name, bytes);
    }
    Ok(fs)
}

/// Binds every table to the unit that the command line names.
pub(super) fn attach(project: &mut Project, unit: &str) -> Result<(), Failure> {
    let found = project.catalogue.iter().find(|(_, item)| fold(&item.name) == fold(unit)).map(|(id, _)| id);
    let id = found.ok_or_else(|| Failure(format!("no block is named `{unit}`")))?;
    project.tables.iter_mut().for_each(|table| table.item = Some(id));
    Ok(())
}

/// Binds tables that name no block to the only program of the files, or to their only block.
fn attach_alone(project: &mut Project) {
    let of = |kind: ItemKind| {
        let mut found = project.catalogue.iter().filter(|(_, item)| item.kind == kind).map(|(id, _)| id);
        found.next().filter(|_| found.next().is_none())
    };
    let alone = of(ItemKind::Program).or_else(|| of(ItemKind::FunctionBlock)).or_else(|| of(ItemKind::Function));
    project.tables.iter_mut().filter(|table| table.item.is_none()).for_each(|table| table.item = alone);
}

/// The tables to decide.
fn chosen(project: &Project, name: Option<&str>) -> Result<Vec<usize>, Failure> {
    let fits = |index: &usize| name.is_none_or(|name| fold(&project.tables[*index].table.name) == fold(name));
    let chosen: Vec<usize> = (0..project.tables.len()).filter(fits).collect();
    match name {
        Some(name) if chosen.is_empty() => Err(Failure(format!("no table is named `{name}`"))),
        _ => Ok(chosen),
    }
}

/// Writes each obligation for other checkers; what is not modelled is named.
fn obligations(project: &Project, chosen: &[usize], folder: &Path) -> Result<Exit, Failure> {
    let mut exit = Exit::Ok;
    for &index in chosen {
        let attached = &project.tables[index];
        let unit = attached.item.map_or("", |item| &project.catalogue.item(item).name);
        let name = format!("{unit}-{}", attached.table.name).replace(|c: char| !c.is_alphanumeric() && c != '-', "_");
        match pipeline::ready::ready(project, index) {
            Ok(ready) => write::file(&folder.join(format!("{name}.aig")), &export::obligation(ready.system()))?,
            Err(reason) => {
                say(&format!("`{}` has no obligation: {reason}", attached.table.name));
                exit = Exit::Findings;
            }
        }
    }
    Ok(exit)
}

/// Decides the tables, several at a time; each verdict is kept as soon as it is there.
fn decide(job: &Job, chosen: &[usize], fresh: bool, progress: &Progress) -> Result<Vec<verdict::Line>, Failure> {
    let stamp = stamp::stamp(&job.dir);
    let known = |claim: &_, _: &_| match (&job.store, fresh) {
        (Some(store), false) => store.answer(claim),
        _ => answer::nothing(),
    };
    let known = records::records(&job.project, job.fs.as_ref(), &stamp, &mut { known });
    progress.event(pipeline::Event::Stage { name: "proving", total: chosen.len() });
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<verdict::Line>> = Mutex::new(Vec::new());
    let failed: Mutex<Option<Failure>> = Mutex::new(None);
    let cancel = Cancel::default();
    let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let jobs = if job.settings.verify.jobs == 0 { cores() } else { job.settings.verify.jobs };
    // Where there are fewer tables than threads, a table gets more than one.
    let open = chosen.iter().filter(|index| !is_settled(job, &known[**index])).count();
    let mut settings = job.settings.clone();
    settings.verify.options.threads = (jobs / open.max(1)).max(1);
    let order = if 1 < jobs && jobs < open { largest_first(job, chosen, &known) } else { chosen.to_vec() };
    let work = || {
        while let Some(index) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            let line = one((job, &settings), &known[*index], *index, &cancel, progress, &failed);
            progress.event(pipeline::Event::Advance(1));
            if let Ok(mut done) = done.lock() {
                done.push(line);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(chosen.len()).max(1) {
            scope.spawn(work);
        }
    });
    progress.event(pipeline::Event::Done);
    if let Some(failure) = failed.into_inner().unwrap_or_default() {
        return Err(failure);
    }
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|line| line.table);
    Ok(done)
}

/// The tables in the order in which they are begun: what takes the longest is not left for the end, where nothing else is
/// left to do.
fn largest_first(job: &Job, chosen: &[usize], known: &[(Record, Answer)]) -> Vec<usize> {
    let size = |index: &usize| {
        let ready = (!is_settled(job, &known[*index])).then(|| pipeline::ready::ready(&job.project, *index).ok());
        ready.flatten().map_or(0, |ready| ready.system().pool.len())
    };
    let mut order = chosen.to_vec();
    order.sort_by_cached_key(|index| std::cmp::Reverse(size(index)));
    order
}

/// Whether nothing is left to find out.
fn is_settled(job: &Job, known: &(Record, Answer)) -> bool {
    let wants_mutants = job.settings.verify.mutants
        && known.1.coverage.as_ref().is_none_or(|coverage| coverage.mutants.is_none())
        && known.1.verdict == crate::evidence::record::Verdict::Verified;
    answer::is_settled(&known.1) && !wants_mutants
}

/// What the store knows of a table, or a new verdict.
fn one(
    (job, settings): (&Job, &Settings),
    known: &(Record, Answer),
    table: usize,
    cancel: &Cancel,
    progress: &Progress,
    failed: &Mutex<Option<Failure>>,
) -> verdict::Line {
    if is_settled(job, known) {
        return verdict::Line { table, answer: known.1.clone(), verified: None };
    }
    let unit = job.project.tables[table].table.name.clone();
    let listener = |_: usize, now: crate::prove::engine::Progress| {
        progress.message(&format!("{unit}: {} {}", now.engine, now.depth));
    };
    let verified: Verified = pipeline::verify::verify(&job.project, settings, table, cancel, &listener);
    let answer = answer::of(&job.project, &verified);
    if let Some(store) = &job.store {
        let record = Record::new(known.0.claim.clone(), &answer, known.0.origin.clone());
        if let (Err(failure), Ok(mut failed)) = (store.keep(&record, &answer), failed.lock()) {
            *failed = Some(failure);
        }
    }
    verdict::Line { table, answer, verified: Some(verified) }
}
