//! The fuzz targets on their finds and on the zoo: what was found stays mended.
//!
//! `tests/fuzz/finds/TARGET/` holds the finds; `tests/fuzz/README.md` says how fuzzing is run.

use std::fs;
use std::path::Path;

use super::html::crawl;
use super::syntax::zoo;

#[path = "../fuzz/src/targets.rs"]
#[allow(unreachable_pub, reason = "the crate of the fuzz targets calls them")]
pub(super) mod targets;

#[test]
fn what_was_found_stays_mended() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/finds");
    let mut run = 0;
    for folder in fs::read_dir(&root).expect("finds").flatten().map(|entry| entry.path()) {
        let name = folder.file_name().expect("a name").to_string_lossy().into_owned();
        let (_, target) = targets::ALL.iter().find(|(target, _)| *target == name).expect("a folder for each target");
        for find in fs::read_dir(&folder).expect("a folder").flatten() {
            target(&fs::read(find.path()).expect("a find"));
            run += 1;
        }
    }
    assert!(run > 0, "there are finds");
}

#[test]
fn the_zoo_harms_no_target() {
    for (_, text, _) in zoo::ALL {
        for (_, target) in targets::ALL.iter().filter(|(name, _)| *name != "chain") {
            target(text.as_bytes());
        }
    }
}

#[test]
fn every_target_has_a_program() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz");
    let manifest = fs::read_to_string(root.join("Cargo.toml")).expect("a manifest");
    for (name, _) in targets::ALL {
        assert!(root.join(format!("fuzz_targets/{name}.rs")).is_file(), "{name}");
        assert!(manifest.contains(&format!("path = \"fuzz_targets/{name}.rs\"")), "{name}");
    }
}
