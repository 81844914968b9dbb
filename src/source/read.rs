//! Reads a tree: lists it, reads and unwraps its files in parallel, and puts the results in order.

use std::borrow::Cow;
use std::sync::Arc;

use rayon::prelude::*;

use super::formats::{self, Format, Input, Unwrapped};
use super::membership;
use super::note::Note;
use super::projects::{self, Draft};
use super::tree::{Skipped, TableFile, Tree};
use super::{Failure, FileSystem, Options, Progress, codes, paths, walk};
use crate::diagnostic::Code;
use crate::text::{Encoding, FileId, Unit, decode};

/// Reads every file below the root of `fs` that a format, a project or a table claims.
pub fn read_tree(fs: &dyn FileSystem, options: &Options, progress: &(dyn Fn(Progress) + Sync)) -> Tree {
    let listing = walk::walk(fs, options);
    progress(Progress::Walked(listing.files.len()));
    let settings = membership::Settings::new(listing.files.iter().map(|(path, _)| path.as_str()));
    let mut tree = Tree { skipped: listing.skipped, ..Tree::default() };
    let mut chosen = Vec::new();
    for (path, size) in &listing.files {
        match choose(path) {
            Choice::Read(role) => chosen.push(Candidate { path, size: *size, role }),
            Choice::Skip(reason) => {
                tree.skipped.push(Skipped { path: path.clone(), reason: reason.into(), code: None })
            }
        }
    }
    chosen.extend(listing.odd.iter().map(|(path, code, reason)| Candidate {
        path,
        size: 0,
        role: Role::Odd(code, reason),
    }));
    chosen.sort_by(|a, b| a.path.cmp(b.path));
    let reader = Reader { fs, options, settings: &settings };
    let total = chosen.len();
    let outcomes: Vec<Outcome> = chosen
        .par_iter()
        .map(|candidate| {
            let outcome = reader.read(candidate);
            progress(Progress::Read { total });
            outcome
        })
        .collect();
    let mut assembly = Assembly { tree, drafts: Vec::new() };
    for (candidate, outcome) in chosen.iter().zip(outcomes) {
        assembly.add(candidate.path, outcome);
    }
    assembly.finish(&listing.files)
}

/// What a file is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role<'a> {
    /// Program text, or a project.
    Source,
    Table,
    /// A project of a tool that keeps it in a form of its own; the text is the way out.
    Binary(&'static str),
    /// Something that the walk found and that cannot be read.
    Odd(&'static Code, &'a str),
}

enum Choice {
    Read(Role<'static>),
    Skip(&'static str),
}

struct Candidate<'a> {
    path: &'a str,
    size: u64,
    role: Role<'a>,
}

/// What to do with the file at `path`, by its name alone.
fn choose(path: &str) -> Choice {
    let extension = paths::extension(path);
    if is_table(path) {
        Choice::Read(Role::Table)
    } else if projects::reads(path) || formats::reads(&extension) || matches!(extension.as_str(), "pro" | "lib") {
        Choice::Read(Role::Source)
    } else if let Some(help) = codes::binary_project(&extension) {
        Choice::Read(Role::Binary(help))
    } else {
        Choice::Skip(codes::skip_reason(&extension))
    }
}

/// Whether `path` is a file of test tables by its name.
#[must_use]
fn is_table(path: &str) -> bool {
    const ENDS: [&str; 9] =
        [".gtt", ".gtt.md", ".gtt.txt", ".gtt.xlsx", ".gtt.xls", ".gtt.ods", ".gtt.csv", ".gtt.xml", ".tt.txt"];
    let name = paths::name(path).to_ascii_lowercase();
    ENDS.iter().any(|end| name.ends_with(end) && name.len() > end.len())
}

/// What became of a file.
enum Outcome {
    Unit {
        text: Arc<str>,
        encoding: Encoding,
        format: &'static dyn Format,
        unwrapped: Unwrapped,
    },
    Project {
        text: Arc<str>,
        encoding: Encoding,
        draft: Draft,
        notes: Vec<Note>,
    },
    Table {
        text: Arc<str>,
        encoding: Encoding,
        bytes: Arc<[u8]>,
    },
    Skipped(&'static str),
    Failed {
        code: &'static Code,
        encoding: Encoding,
        reason: Cow<'static, str>,
        message: String,
        help: Option<&'static str>,
    },
}

struct Reader<'a> {
    fs: &'a dyn FileSystem,
    options: &'a Options,
    settings: &'a membership::Settings,
}

impl Reader<'_> {
    fn read(&self, candidate: &Candidate<'_>) -> Outcome {
        match candidate.role {
            Role::Binary(help) => return binary_project(candidate.path, help),
            Role::Odd(code, reason) => return odd(candidate.path, code, reason),
            Role::Source | Role::Table => {}
        }
        let limit = self.options.max_file_size.min(u64::from(u32::MAX));
        let bytes = if candidate.size > limit { Err(Failure::TooLarge) } else { self.fs.read(candidate.path, limit) };
        match bytes {
            Ok(bytes) => self.decoded(candidate, bytes),
            Err(failure) => unreadable(candidate.path, limit, &failure),
        }
    }

    fn decoded(&self, candidate: &Candidate<'_>, bytes: Vec<u8>) -> Outcome {
        let decoded = decode::decode(&bytes);
        let (text, encoding): (Arc<str>, _) = (decoded.text.into(), decoded.encoding);
        let extension = paths::extension(candidate.path);
        if candidate.role == Role::Table {
            return Outcome::Table { text, encoding, bytes: bytes.into() };
        }
        if bytes.starts_with(b"CoDeSys+") {
            return binary_project(candidate.path, codes::EXPORT_FROM_CODESYS_2);
        }
        drop(bytes);
        if let Encoding::Binary(kind) = encoding {
            return if codes::is_shared(&extension) {
                Outcome::Skipped(codes::NOT_A_PLC_SOURCE)
            } else {
                not_decodable(candidate.path, kind)
            };
        }
        let input = Input { path: candidate.path, text: &text, setting: self.settings.of(candidate.path) };
        if let Some((draft, notes)) = projects::read(&input) {
            return Outcome::Project { text, encoding, draft, notes };
        }
        match formats::claimant(&extension, &input) {
            Some(format) => {
                let unwrapped = format.unwrap(&input);
                Outcome::Unit { text, encoding, format, unwrapped }
            }
            None if formats::plain::is_guarded_chart(&text) => unread_dialect(candidate.path),
            None => Outcome::Skipped(codes::NOT_A_PLC_SOURCE),
        }
    }
}

fn unread_dialect(path: &str) -> Outcome {
    Outcome::Failed {
        code: &codes::UNREAD_DIALECT,
        encoding: Encoding::Binary("not read"),
        reason: "a dialect that is not read".into(),
        message: format!("`{}` is a chart `SFC … END_SFC`, which is not read", paths::name(path)),
        help: Some("write the steps and transitions of IEC 61131-3"),
    }
}

fn binary_project(path: &str, help: &'static str) -> Outcome {
    Outcome::Failed {
        code: &codes::BINARY_PROJECT,
        encoding: Encoding::Binary("binary data"),
        reason: "a project that only its tool can read".into(),
        message: format!("`{}` can only be read by the tool that wrote it", paths::name(path)),
        help: Some(help),
    }
}

fn odd(path: &str, code: &'static Code, reason: &str) -> Outcome {
    Outcome::Failed {
        code,
        encoding: Encoding::Binary("not read"),
        reason: reason.to_owned().into(),
        message: format!("`{path}` was left out: {reason}"),
        help: None,
    }
}

fn not_decodable(path: &str, kind: &'static str) -> Outcome {
    Outcome::Failed {
        code: &codes::NOT_DECODABLE,
        encoding: Encoding::Binary(kind),
        reason: format!("no text, but {kind}").into(),
        message: format!("`{}` is no text, but {kind}", paths::name(path)),
        help: None,
    }
}

fn unreadable(path: &str, limit: u64, failure: &Failure) -> Outcome {
    let name = paths::name(path);
    let encoding = Encoding::Binary("not read");
    match failure {
        Failure::TooLarge => Outcome::Failed {
            code: &codes::FILE_TOO_LARGE,
            encoding,
            reason: "larger than the limit".into(),
            message: format!("`{name}` is larger than the limit of {} MiB and was not read", limit >> 20),
            help: Some("raise the limit, or exclude the file"),
        },
        Failure::Denied(reason) => Outcome::Failed {
            code: &codes::UNREADABLE_PATH,
            encoding,
            reason: format!("not readable: {reason}").into(),
            message: format!("`{name}` cannot be read: {reason}"),
            help: None,
        },
    }
}

/// The tree in the making.
struct Assembly {
    tree: Tree,
    drafts: Vec<(FileId, Draft)>,
}

impl Assembly {
    fn add(&mut self, path: &str, outcome: Outcome) {
        match outcome {
            Outcome::Unit { text, encoding, format, unwrapped } => {
                let mut notes = unwrapped.notes;
                notes.extend(guessed(&encoding));
                let bytes = unwrapped.tables.then(|| Arc::from(text.as_bytes()));
                let file = self.file(path, text, encoding, notes);
                if let Some(bytes) = bytes {
                    self.tree.tables.push(TableFile { file, path: path.to_owned(), bytes });
                }
                self.drafts.extend(unwrapped.project.map(|draft| (file, draft)));
                self.tree.units.push(Unit {
                    file,
                    format: format.name(),
                    vendor: unwrapped.vendor,
                    nested_comments: unwrapped.nested_comments,
                    project: None,
                    objects: unwrapped.objects,
                });
            }
            Outcome::Project { text, encoding, draft, mut notes } => {
                notes.extend(guessed(&encoding));
                let file = self.file(path, text, encoding, notes);
                self.drafts.push((file, draft));
            }
            Outcome::Table { text, encoding, bytes } => {
                let notes = guessed(&encoding).into_iter().collect();
                let file = self.file(path, text, encoding, notes);
                self.tree.tables.push(TableFile { file, path: path.to_owned(), bytes });
            }
            Outcome::Skipped(reason) => {
                self.tree.skipped.push(Skipped { path: path.to_owned(), reason: reason.into(), code: None });
            }
            Outcome::Failed { code, encoding, reason, message, help } => {
                let mut note = Note::of_file(code, message);
                note.help.extend(help.map(str::to_owned));
                self.file(path, "".into(), encoding, vec![note]);
                self.tree.skipped.push(Skipped { path: path.to_owned(), reason, code: Some(code) });
            }
        }
    }

    fn file(&mut self, path: &str, text: Arc<str>, encoding: Encoding, notes: Vec<Note>) -> FileId {
        let file = self.tree.files.add(path, text, encoding);
        self.tree.findings.extend(notes.into_iter().map(|note| note.in_file(file)));
        file
    }

    fn finish(mut self, all: &[(String, u64)]) -> Tree {
        let tree = &mut self.tree;
        membership::join(tree, self.drafts, all);
        tree.skipped.sort_by(|a, b| a.path.cmp(&b.path));
        tree.findings.sort_by(|a, b| (a.place, a.code.name).cmp(&(b.place, b.code.name)));
        self.tree
    }
}

/// A note if the encoding was guessed.
fn guessed(encoding: &Encoding) -> Option<Note> {
    let Encoding::Guessed(name) = encoding else { return None };
    let message = format!("the file is not UTF-8 and was read as {name}");
    Some(Note::of_file(&codes::ENCODING_GUESSED, message).help("save it as UTF-8 to be sure of every character"))
}
