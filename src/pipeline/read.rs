//! From a file system to a [`Project`].

use std::collections::BTreeMap;

use super::{Asked, Event, Events, Project, libraries, overrides, tables};
use crate::audit::{self, Context};
use crate::book::view::finding::ReadingView;
use crate::config::Settings;
use crate::diagnostic::Finding;
use crate::docs;
use crate::library::relations::Relations;
use crate::library::{lower, resolve};
use crate::source::{FileSystem, Progress, Tree, read_tree};
use crate::text::Object;

/// Reads the tree below `fs`, whose folder is called `name`.
pub fn read(fs: &dyn FileSystem, name: &str, settings: &Settings, events: &Events<'_>) -> Project {
    let mut tree = walk(fs, settings, events);
    events(Event::Stage { name: "parsing", total: tree.units.len() });
    let mut libraries = libraries::of(&tree, name);
    overrides::descriptions(fs, &mut libraries.list);
    let units: Vec<_> = tree.units.iter().zip(libraries.of_unit.iter().copied()).collect();
    let lowered = lower::units(&units, libraries.list, &tree.files, &|n| events(Event::Advance(n)));
    let (mut catalogue, mut findings) = (lowered.catalogue, lowered.findings);
    let names = resolve::resolve(&mut catalogue);
    let relations = Relations::new(&catalogue, &names);

    events(Event::Stage { name: "comments", total: 0 });
    let docs = docs::read(&catalogue, &names, &settings.docs);
    let tables = tables::attach(&tree, &catalogue, &names, &docs, &settings.tables);
    findings.append(&mut tree.findings);
    findings.extend(tables.findings);
    let (asked, missing) = asked(fs, settings);
    for (name, path, why) in missing {
        let file = tree.files.add(&path, "", crate::text::Encoding::Utf8);
        let message = format!("the stub of `{name}` cannot be read: {why}");
        findings.push(Finding::of_file(&crate::source::codes::UNREADABLE_PATH, file, message));
    }

    events(Event::Stage { name: "audit", total: 0 });
    let context = Context { catalogue: &catalogue, docs: &docs, tables: &tables.tables, answers: &[] };
    findings.extend(audit::check(&context, |code, default| settings.levels.runs(code, default)));
    let findings = in_order(findings, settings);

    let (skipped, other_files) = skipped(&tree);
    let readings = readings(&tree);
    Project {
        name: name.to_owned(),
        source_files: tree.units.len(),
        files: tree.files,
        catalogue,
        names,
        relations,
        docs,
        tables: tables.tables,
        findings,
        allowed: Vec::new(),
        beside: super::evidence::Beside::default(),
        readings,
        skipped,
        other_files,
        answers: Vec::new(),
        asked,
        narratives: overrides::narratives(fs, &settings.manual),
        overrides: overrides::read(fs),
    }
}

/// Takes what is known of each table, and lets the rules about verdicts speak again.
pub fn know(project: &mut Project, settings: &Settings, answers: Vec<crate::evidence::record::Answer>) {
    use crate::audit::rules::{proves_nothing, unverified_table, violated_table};
    let codes = [proves_nothing::CODE.name, unverified_table::CODE.name, violated_table::CODE.name];
    let about = |name: &str| codes.contains(&name);
    project.answers = answers;
    let Project { catalogue, docs, tables, answers, .. } = project;
    let context = Context { catalogue, docs, tables, answers };
    let new = audit::check(&context, |code, default| about(code) && settings.levels.runs(code, default));
    let mut findings = std::mem::take(&mut project.findings);
    findings.retain(|finding| !about(finding.code.name));
    // Those that are kept have their configured severities already, and keep them.
    let allowed = |one: &Finding| {
        project.allowed.iter().any(|a| a.finding.code.name == one.code.name && a.finding.place == one.place)
    };
    findings.extend(new.into_iter().filter(|one| !allowed(one)));
    project.findings = in_order(findings, settings);
}

/// A block, the path of its stub, and why that cannot be read.
type MissingStub = (String, String, String);

/// What is asked of proofs. A stub whose file cannot be read is left out and told, and what needs it is *unsupported*.
fn asked(fs: &dyn FileSystem, settings: &Settings) -> (Asked, Vec<MissingStub>) {
    let text = |path: &str| {
        let bytes = fs.read(path, settings.source.max_file_size).map_err(|error| error.to_string())?;
        String::from_utf8(bytes).map_err(|_| "it is not encoded in UTF-8".to_owned())
    };
    let (mut stubs, mut missing) = (Vec::new(), Vec::new());
    for (name, value) in &settings.verify.stubs {
        match if value == "arbitrary" { Ok(value.clone()) } else { text(value) } {
            Ok(text) => stubs.push((name.clone(), super::stub(name, &text))),
            Err(why) => missing.push((name.clone(), value.clone(), why)),
        }
    }
    let constants = settings.tables.all.constants.iter();
    let asked = Asked {
        cycle: settings.tables.all.cycle,
        constants: constants.map(|(name, value)| (name.clone(), format!("{value:?}"))).collect(),
        strict: settings.verify.options.strict,
        loop_limit: settings.verify.loop_limit,
        fixed: settings.verify.fixed,
        stubs: stubs.into_iter().collect(),
    };
    (asked, missing)
}

fn walk(fs: &dyn FileSystem, settings: &Settings, events: &Events<'_>) -> Tree {
    events(Event::Stage { name: "reading", total: 0 });
    let first = std::sync::Once::new();
    read_tree(fs, &settings.source, &|progress| match progress {
        Progress::Walked(_) => {}
        Progress::Read { total } => {
            first.call_once(|| events(Event::Stage { name: "reading", total }));
            events(Event::Advance(1));
        }
    })
}

/// With their configured severities, by file and place; equal ones once.
pub(super) fn in_order(findings: Vec<Finding>, settings: &Settings) -> Vec<Finding> {
    let mut findings: Vec<Finding> =
        findings.into_iter().filter_map(|finding| settings.levels.apply(finding)).collect();
    findings.sort_by(|a, b| {
        (a.place.file, a.place.span, a.code.name, &a.message).cmp(&(
            b.place.file,
            b.place.span,
            b.code.name,
            &b.message,
        ))
    });
    findings.dedup();
    findings
}

/// How the files of program text were read, each way with their number.
fn readings(tree: &Tree) -> Vec<ReadingView> {
    let mut counts: BTreeMap<(&str, &str, &'static str), usize> = BTreeMap::new();
    for unit in &tree.units {
        let own = |object: &Object| object.properties.iter().any(|(key, _)| key == "nested_comments");
        let nest = match unit.nested_comments {
            Some(true) => "yes",
            Some(false) => "no",
            None if unit.objects.iter().any(own) => "as each object says",
            None => "open",
        };
        *counts.entry((unit.format, tree.files.get(unit.file).encoding.name(), nest)).or_default() += 1;
    }
    let reading = |((format, encoding, comments_nest), files): ((&str, &str, &'static str), usize)| ReadingView {
        format: format.to_owned(),
        encoding: encoding.to_owned(),
        comments_nest,
        files,
    };
    counts.into_iter().map(reading).collect()
}

/// The files that a manual should hold and does not, and the number of those that it need not.
fn skipped(tree: &Tree) -> (Vec<(String, String)>, usize) {
    let (ours, other): (Vec<_>, Vec<_>) = tree.skipped.iter().partition(|skipped| skipped.code.is_some());
    let ours = ours.into_iter().map(|skipped| (skipped.path.clone(), skipped.reason.to_string())).collect();
    let files = other.into_iter().filter(|skipped| !skipped.path.ends_with('/'));
    (ours, files.count())
}
