//! Lists a tree: every file once, ordered by path.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::tree::Skipped;
use super::{EntryKind, Failure, FileSystem, Options, codes, paths};
use crate::diagnostic::Code;

/// Folders may nest so deep; a tree of files made by people does not.
const MAX_DEPTH: usize = 128;

/// What lies in a tree.
#[derive(Debug, Default)]
pub(super) struct Listing {
    /// The files with their sizes, ordered by path.
    pub(super) files: Vec<(String, u64)>,
    /// What was not entered or was not chosen.
    pub(super) skipped: Vec<Skipped>,
    /// What should have been read and cannot be, and why; a folder's path ends in `/`.
    pub(super) odd: Vec<(String, &'static Code, Cow<'static, str>)>,
}

impl Listing {
    fn skip(&mut self, path: String, reason: &'static str) {
        self.skipped.push(Skipped { path, reason: reason.into(), code: None });
    }

    fn odd(&mut self, path: String, code: &'static Code, reason: impl Into<Cow<'static, str>>) {
        self.odd.push((path, code, reason.into()));
    }
}

/// Lists everything below the root of `fs`.
pub(super) fn walk(fs: &dyn FileSystem, options: &Options) -> Listing {
    let mut listing = Listing::default();
    let mut outside = BTreeSet::new();
    let mut pending = vec![String::new()];
    while let Some(folder) = pending.pop() {
        visit(fs, options, &folder, &mut listing, &mut pending, &mut outside);
    }
    listing.files.sort();
    listing
}

fn visit(
    fs: &dyn FileSystem,
    options: &Options,
    folder: &str,
    listing: &mut Listing,
    pending: &mut Vec<String>,
    outside: &mut BTreeSet<String>,
) {
    let mut entries = match fs.entries(folder) {
        Ok(entries) => entries,
        Err(Failure::Denied(reason)) => {
            return listing.odd(format!("{folder}/"), &codes::UNREADABLE_PATH, format!("not readable: {reason}"));
        }
        Err(Failure::TooLarge) => return,
    };
    entries.sort_by(|a, b| a.name.cmp(&b.name));
    let cache = entries.iter().any(|entry| entry.name == "CACHEDIR.TAG");
    if cache && !folder.is_empty() {
        return listing.skip(format!("{folder}/"), "a folder of build products");
    }
    let first = pending.len();
    for entry in entries {
        let path = paths::join(folder, &entry.name);
        match entry.kind {
            EntryKind::File(_) if !options.filter.takes_file(&path) => {
                listing.skip(path, "not chosen by the configuration")
            }
            EntryKind::File(size) => listing.files.push((path, size)),
            EntryKind::Folder => enter(options, path, &entry.name, listing, pending),
            EntryKind::OutsideFolder(identity) => {
                let nested = outside.iter().any(|seen| paths::is_below(&identity, seen) || identity == *seen);
                if nested {
                    listing.skip(format!("{path}/"), "a link to a folder that is read already");
                } else {
                    outside.insert(identity);
                    enter(options, path, &entry.name, listing, pending);
                }
            }
            EntryKind::InsideLink => listing.skip(path, "a link into the same tree"),
            EntryKind::Loop => {
                listing.odd(path, &codes::LINK_LOOP, "a link to a folder that holds it");
            }
            EntryKind::Odd(reason) => listing.odd(path, &codes::UNREADABLE_PATH, reason),
        }
    }
    // The folders wait on a stack, so the first of them goes on top.
    pending[first..].reverse();
}

fn enter(options: &Options, path: String, name: &str, listing: &mut Listing, pending: &mut Vec<String>) {
    let output = options.output.as_deref().is_some_and(|output| output.trim_end_matches('/') == path);
    let reason = match name {
        _ if output => "the folder of the manual",
        "node_modules" => "a folder of packages",
        _ if name.starts_with('.') => "a hidden folder",
        _ if !options.filter.enters_folder(&path) => "not chosen by the configuration",
        _ if path.matches('/').count() >= MAX_DEPTH => {
            return listing.odd(format!("{path}/"), &codes::UNREADABLE_PATH, "folders nest too deep");
        }
        _ => return pending.push(path),
    };
    listing.skip(format!("{path}/"), reason);
}
