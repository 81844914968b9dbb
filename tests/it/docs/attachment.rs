//! Which comment documents what, held against labels read by hand in trees of others.
//!
//! Ignored unless asked for: `RUNGBOOK_CORPORA=DIR cargo test --test it docs -- --ignored --nocapture`.
//! `tests/labels/attachment.tsv` says how the labels were sampled.

use std::collections::BTreeMap;
use std::path::Path;

use rungbook::docs::{Entry, Verdict};
use rungbook::pipeline::Project;
use rungbook::source::Disk;
use rungbook::text::{Place, Span};

use crate::support::settings;

const LABELS: &str = include_str!("../../labels/attachment.tsv");

/// A declaration and the lines of the comment that documents it.
struct Label {
    repository: &'static str,
    path: &'static str,
    line: u32,
    is_item: bool,
    name: &'static str,
    placement: &'static str,
    lines: Option<(u32, u32)>,
}

fn labels() -> Vec<Label> {
    let label = |row: &'static str| {
        let cells: Vec<&str> = row.split('\t').collect();
        let number = |i: usize| cells[i].parse::<u32>().ok();
        Label {
            repository: cells[0],
            path: cells[1],
            line: number(2).expect("a line is a number"),
            is_item: cells[3] == "item",
            name: cells[4],
            placement: cells[5],
            lines: number(6).zip(number(7)),
        }
    };
    LABELS.lines().filter(|row| !row.starts_with('#')).map(label).collect()
}

/// The line of `offset`, counted by line feeds as most editors do, also in files with `\r\r\n`.
fn line(text: &str, offset: u32) -> u32 {
    let before = text.get(..offset as usize).unwrap_or(text);
    u32::try_from(before.matches('\n').count() + 1).unwrap_or(u32::MAX)
}

/// The lines of the comments that were taken.
fn taken(project: &Project, entry: &Entry) -> Option<(u32, u32)> {
    let lines = entry.considered.iter().filter(|considered| matches!(considered.verdict, Verdict::Taken(_)));
    let lines = lines.map(|considered| {
        let file = project.files.get(considered.place.file);
        let Span { start, end } = considered.place.span;
        // A line comment may hold its line break.
        let text = considered.place.span.of(&file.text);
        let end = end.saturating_sub(u32::try_from(text.len() - text.trim_end().len()).unwrap_or(0));
        (line(&file.text, start), line(&file.text, end.saturating_sub(1)))
    });
    lines.reduce(|all, next| (all.0.min(next.0), all.1.max(next.1)))
}

/// The entry of the declaration that a label means: of this name, the nearest to its line.
fn find<'p>(project: &'p Project, label: &Label) -> Option<&'p Entry> {
    let distance = |place: Place| {
        let file = project.files.get(place.file);
        (file.path == label.path).then(|| line(&file.text, place.span.start).abs_diff(label.line))
    };
    let mut found: Vec<(u32, &Entry)> = Vec::new();
    for (id, item) in project.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor()) {
        if label.is_item && item.name == label.name {
            found.extend(distance(item.place).map(|distance| (distance, project.docs.item(id))));
        } else if !label.is_item {
            let named =
                item.variables.iter().enumerate().filter(|(_, v)| v.name == label.name && distance(v.place) == Some(0));
            found.extend(named.filter_map(|(i, _)| project.docs.variable(id, i)).map(|entry| (0, entry)));
        }
    }
    found.into_iter().min_by_key(|(distance, _)| *distance).map(|(_, entry)| entry)
}

#[test]
#[ignore = "needs the trees of others; set RUNGBOOK_CORPORA"]
fn comments_are_attached_as_people_read_them() {
    let root = std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names the folder of the trees");
    let labels = labels();
    let mut projects: BTreeMap<&str, Project> = BTreeMap::new();
    let (mut right, mut report) = (0, String::new());
    for label in &labels {
        let project = projects.entry(label.repository).or_insert_with(|| {
            let disk = Disk::new(Path::new(&root).join(label.repository)).expect("the tree is there");
            rungbook::pipeline::read(&disk, label.repository, &settings(""), &|_| {})
        });
        let Label { repository, path, line, name, placement, lines, .. } = label;
        match find(project, label) {
            None => report += &format!("not found: {repository}/{path}:{line} {name}\n"),
            Some(entry) if taken(project, entry) == *lines => right += 1,
            Some(entry) => {
                let got = taken(project, entry);
                report += &format!(
                    "{repository}/{path}:{line} {name}: {placement} {lines:?}, but taken {got:?}; {:?}\n",
                    entry.considered.iter().map(|c| (c.placement, c.verdict)).collect::<Vec<_>>()
                );
            }
        }
    }
    let share = f64::from(right) / labels.len() as f64;
    assert!(share >= 0.98, "{right} of {} agree\n{report}", labels.len());
}
