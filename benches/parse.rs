//! How fast text becomes a tree.
//!
//! `RUNGBOOK_CORPUS` names a directory of plain texts (`.st`, `.scl`, `.fun`, `.var`, `.typ`) and of TwinCAT files
//! (`.TcPOU`, `.TcDUT`, `.TcGVL`, `.TcIO`), of which the declarations and bodies are taken; without it, `samples/`
//! and `tests/zoo/` are read.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use divan::Bencher;
use divan::counter::BytesCount;
use rungbook::syntax::{Entry, Options, parse};
use rungbook::text::decode::decode;

fn main() {
    divan::main();
}

#[divan::bench]
fn corpus(bencher: Bencher<'_, '_>) {
    let texts = texts();
    let bytes: usize = texts.iter().map(|(text, _)| text.len()).sum();
    bencher.counter(BytesCount::new(bytes)).bench_local(|| {
        let nodes =
            texts.iter().map(|(text, entry)| parse(text.clone(), *entry, &Options::default()).tree.node_count());
        nodes.sum::<usize>()
    });
}

fn texts() -> Vec<(Arc<str>, Entry)> {
    let roots = match std::env::var_os("RUNGBOOK_CORPUS") {
        Some(root) => vec![PathBuf::from(root)],
        None => ["samples", "tests/zoo"].iter().map(|dir| Path::new(env!("CARGO_MANIFEST_DIR")).join(dir)).collect(),
    };
    roots.iter().flat_map(walkdir::WalkDir::new).flatten().flat_map(|entry| read(entry.path())).collect()
}

#[expect(clippy::disallowed_methods, reason = "a benchmark reads its own input")]
fn read(path: &Path) -> Vec<(Arc<str>, Entry)> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    let text = || std::fs::read(path).map(|bytes| decode(&bytes).text).unwrap_or_default();
    match extension.as_str() {
        "st" | "scl" | "fun" | "var" | "typ" => vec![(text().into(), Entry::File)],
        "tcpou" | "tcdut" | "tcgvl" | "tcio" => {
            let text = text();
            let mut texts = between(&text, "<Declaration><![CDATA[", Entry::Declaration);
            texts.extend(between(&text, "<ST><![CDATA[", Entry::Body));
            texts
        }
        _ => Vec::new(),
    }
}

/// What stands between `open` and the end of its CDATA section, each time.
fn between(text: &str, open: &str, entry: Entry) -> Vec<(Arc<str>, Entry)> {
    let pieces = text.split(open).skip(1).filter_map(|piece| piece.split_once("]]>"));
    pieces.map(|(inner, _)| (inner.into(), entry)).collect()
}
