//! Real trees: nothing that a search for keywords finds is lost.
//!
//! Ignored unless asked for: `RUNGBOOK_CORPORA=DIR cargo test --release --test it corpora -- --ignored --nocapture`
//! reads every folder of `DIR`. The search shares no code with the tool: it takes the comments and strings out of the
//! declarations of a file by hand and looks at the first word of each line.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use rungbook::book::model;
use rungbook::diagnostic::{Finding, Severity};
use rungbook::source::Disk;
use rungbook::syntax::{Node, NodeKind, codes};

use crate::support::{book, settings};

/// Keyword and the kinds that it may be.
const KEYWORDS: [(&str, &[&str]); 8] = [
    ("FUNCTION_BLOCK", &["function-block"]),
    ("FUNCTION", &["function"]),
    ("PROGRAM", &["program"]),
    ("INTERFACE", &["interface"]),
    ("CLASS", &["class"]),
    ("ORGANIZATION_BLOCK", &["program"]),
    ("METHOD", &["method"]),
    ("PROPERTY", &["property"]),
];

const MODIFIERS: [&str; 8] =
    ["PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL", "ABSTRACT", "FINAL", "OVERRIDE", "EXTERNAL"];

/// The text without comments, strings and pragmas; line breaks stay.
fn bare(text: &str) -> String {
    let bytes: Vec<char> = text.chars().collect();
    let mut out = String::new();
    let mut at = 0;
    let starts = |at: usize, what: &str| what.chars().enumerate().all(|(i, c)| bytes.get(at + i) == Some(&c));
    while at < bytes.len() {
        let close = if starts(at, "(*") {
            "*)"
        } else if starts(at, "//") {
            "\n"
        } else if starts(at, "{") {
            "}"
        } else if starts(at, "'") {
            "'"
        } else {
            out.push(bytes[at]);
            at += 1;
            continue;
        };
        at += if close == "*)" { 2 } else { 1 };
        let mut depth = 1;
        while at < bytes.len() {
            if close == "*)" && starts(at, "(*") {
                depth += 1;
                at += 2;
            } else if starts(at, close) {
                depth -= 1;
                at += close.len();
                if depth == 0 {
                    break;
                }
            } else {
                if bytes[at] == '\n' {
                    out.push('\n');
                }
                at += 1;
            }
        }
        if close == "\n" {
            out.push('\n');
        }
    }
    out
}

/// What the declarations of a file declare: kind and name in lower case.
fn headers(text: &str) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    for line in bare(text.trim_start_matches('\u{feff}')).lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let Some(first) = words.first() else { continue };
        // `PROGRAM instance WITH task : type` in a configuration declares an instance, no program.
        if words.iter().any(|word| word.eq_ignore_ascii_case("WITH")) {
            continue;
        }
        let Some((keyword, _)) = KEYWORDS.iter().find(|(keyword, _)| keyword.eq_ignore_ascii_case(first)) else {
            continue;
        };
        let name = words[1..].iter().find(|word| !MODIFIERS.contains(&word.to_uppercase().as_str()));
        let Some(name) = name else { continue };
        let quoted = name.starts_with('"').then(|| line.split('"').nth(1)).flatten();
        let plain = || name.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let name: String = quoted.map_or_else(plain, str::to_owned);
        if !name.is_empty() {
            found.push((*keyword, name.to_lowercase()));
        }
    }
    found
}

/// The texts in which a file declares things.
fn declarations(path: &str, text: &str) -> Vec<String> {
    let extension = path.rsplit('.').next().unwrap_or("").to_lowercase();
    match extension.as_str() {
        "tcpou" | "tcio" | "tcdut" | "tcgvl" => {
            let parts =
                text.split("<Declaration>").skip(1).map(|part| part.split("</Declaration>").next().unwrap_or(""));
            parts.map(|part| part.replace("<![CDATA[", "").replace("]]>", "")).collect()
        }
        "st" | "iecst" | "pou" | "itf" | "fun" | "scl" => vec![text.to_owned()],
        _ => Vec::new(),
    }
}

/// What the elements of a file of PLCopen XML declare.
fn elements(path: &str, text: &str) -> Vec<(&'static str, String)> {
    if !path.to_lowercase().ends_with(".xml") || !text.contains("plcopen.org/xml/tc6") {
        return Vec::new();
    }
    let attribute = |tag: &str, name: &str| {
        let rest = tag.split_once(&format!(" {name}=\""))?.1;
        Some(rest.split('"').next().unwrap_or("").to_lowercase())
    };
    let declared = text.split("<pou ").skip(1).filter_map(|piece| {
        let tag = format!(" {}", piece.split('>').next().unwrap_or(""));
        let keyword = match attribute(&tag, "pouType")?.as_str() {
            "functionblock" => "FUNCTION_BLOCK",
            "function" => "FUNCTION",
            _ => "PROGRAM",
        };
        Some((keyword, attribute(&tag, "name")?))
    });
    declared.collect()
}

fn files(folder: &Path, root: &Path, out: &mut Vec<(String, String)>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.is_dir() && !hidden {
            files(&path, root, out);
        } else if let Ok(bytes) = fs::read(&path) {
            let name = path.strip_prefix(root).expect("below").to_string_lossy().replace('\\', "/");
            out.push((name, String::from_utf8_lossy(&bytes).into_owned()));
        }
    }
}

#[test]
#[ignore = "needs RUNGBOOK_CORPORA, a folder of source trees"]
fn no_header_is_lost() {
    let root = std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names a folder of trees");
    let mut trees: Vec<_> = fs::read_dir(root).expect("a folder").flatten().map(|entry| entry.path()).collect();
    trees.sort();
    let mut lost_in_all = 0;
    for tree in trees {
        let fs = Disk::new(&tree).expect("a folder");
        let project = rungbook::pipeline::read(&fs, "tree", &settings(""), &|_| {});
        let model: serde_json::Value = serde_json::from_str(&model::render(&book(&project))).expect("JSON");
        let mut entities: BTreeMap<(String, String), usize> = BTreeMap::new();
        let mut here = 0;
        for entity in model["entities"].as_array().expect("a list") {
            let text = |key: &str| entity[key].as_str().unwrap_or("").to_lowercase();
            *entities.entry((format!("{} {}", text("file"), text("kind")), text("name"))).or_default() += 1;
            here += usize::from(KEYWORDS.iter().any(|(_, kinds)| kinds.contains(&text("kind").as_str())));
        }
        let mut all = Vec::new();
        files(&tree, &tree, &mut all);
        all.sort();
        let (mut found, mut lost) = (0, Vec::new());
        for (path, text) in &all {
            let texts = declarations(path, text);
            for (keyword, name) in texts.iter().flat_map(|text| headers(text)).chain(elements(path, text)) {
                found += 1;
                let kinds = KEYWORDS.iter().find(|(word, _)| *word == keyword).expect("a keyword").1;
                let file = path.to_lowercase();
                let keys = kinds.iter().map(|kind| (format!("{file} {kind}"), name.clone()));
                let key = keys.into_iter().find(|key| entities.get(key).is_some_and(|count| *count > 0));
                match key.and_then(|key| entities.get_mut(&key)) {
                    Some(count) => *count -= 1,
                    None => lost.push(format!("{path}: {keyword} {name}")),
                }
            }
        }
        let errors = project.findings.iter().filter(|f| f.severity == rungbook::diagnostic::Severity::Error).count();
        println!(
            "{}: {found} headers by search, {here} entities of these kinds, {} lost; {} entities, {} files, {} skipped, {errors} errors",
            tree.file_name().expect("a name").to_string_lossy(),
            lost.len(),
            model["totals"]["entities"],
            model["totals"]["files"],
            model["totals"]["files_skipped"],
        );
        lost.iter().take(40).for_each(|line| println!("    {line}"));
        lost_in_all += lost.len();
    }
    assert_eq!(lost_in_all, 0);
}

/// The outermost bodies below `node` that hold statements or a chart, without those of Instruction List.
fn bodies<'t>(node: Node<'t>, out: &mut Vec<Node<'t>>) {
    for child in node.children() {
        let listed = child.children().any(|inner| inner.kind() == NodeKind::InstructionList);
        if child.kind() != NodeKind::Body {
            bodies(child, out);
        } else if !listed {
            out.push(child);
        }
    }
}

/// How many bodies a tree has, and how many of them hold an error finding; each error with its place.
#[test]
#[ignore = "needs RUNGBOOK_CORPORA, a folder of source trees"]
fn bodies_are_read() {
    let root = std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names a folder of trees");
    let mut trees: Vec<_> = fs::read_dir(root).expect("a folder").flatten().map(|entry| entry.path()).collect();
    trees.sort();
    let (mut all, mut broken) = (0, 0);
    for tree in trees {
        let fs = Disk::new(&tree).expect("a folder");
        let project = rungbook::pipeline::read(&fs, "tree", &settings(""), &|_| {});
        let syntax = |finding: &&Finding| {
            finding.severity == Severity::Error && codes::ALL.iter().any(|code| code.name == finding.code.name)
        };
        let errors: Vec<&Finding> = project.findings.iter().filter(syntax).collect();
        let mut of_bodies = vec![false; errors.len()];
        let (mut here, mut broken_here) = (0, 0);
        for source in &project.catalogue.sources {
            let mut found = Vec::new();
            source.tree.iter().for_each(|tree| bodies(tree.root(), &mut found));
            for body in found {
                let span = source.fragment.map.span(body.span());
                let text = &project.files.get(source.file).text;
                // What is missing at the end of a body is told where the next word stands, or the text ends.
                let reach = |end: u32| {
                    let rest = text.get(end as usize..).unwrap_or_default();
                    end as usize + rest.len() - rest.trim_start().len()
                };
                let reach = reach(span.end);
                let inside = |error: &Finding| {
                    let at = error.place.span.start;
                    error.place.file == source.file && at >= span.start && at as usize <= reach
                };
                let mut any = false;
                for (error, of_body) in errors.iter().zip(&mut of_bodies) {
                    let inside = inside(error);
                    *of_body |= inside;
                    any |= inside;
                }
                here += 1;
                broken_here += usize::from(any);
            }
        }
        println!("{}: {here} bodies, {broken_here} with errors", tree.file_name().expect("a name").to_string_lossy());
        for (error, of_body) in errors.iter().zip(of_bodies) {
            let at = project.files.line_column(error.place);
            let path = &project.files.get(error.place.file).path;
            println!(
                "    {}{path}:{}:{}: {}",
                if of_body { "" } else { "(no body) " },
                at.line,
                at.column,
                error.message
            );
        }
        all += here;
        broken += broken_here;
    }
    println!("all: {all} bodies, {broken} with errors");
    assert!(broken * 1000 <= all * 5, "at least 99.5 % of the bodies are read");
}
