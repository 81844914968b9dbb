//! Drives the site in Chromium where the machine has one, and says so where it has none.
//!
//! The checks themselves are in `tests/browser/site.mjs`; it needs node, Chromium and `npm ci` in that folder.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{fixture, site};

/// Where the machine has its browser.
fn chromium() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    named.or_else(|| Some(PathBuf::from("/usr/bin/chromium"))).filter(|path| path.exists())
}

/// What the machine lacks for these tests.
fn missing(folder: &Path) -> Option<&'static str> {
    let node = Command::new("node").arg("--version").output();
    if !node.is_ok_and(|output| output.status.success()) {
        return Some("no node");
    }
    if chromium().is_none() {
        return Some("no Chromium at /usr/bin/chromium, and CHROMIUM names none");
    }
    let modules = ["playwright-core", "axe-core"].map(|name| folder.join("node_modules").join(name));
    modules.iter().any(|module| !module.exists()).then_some("run `npm ci` in tests/browser")
}

/// Writes a site below `root`.
fn write(root: &Path, pages: &[rungbook::render::html::Page]) {
    for page in pages {
        let path = root.join(&page.path);
        let folder = path.parent().expect("a page lies below the root");
        #[expect(clippy::disallowed_methods, reason = "a browser needs files")]
        std::fs::create_dir_all(folder).expect("the folder can be made");
        #[expect(clippy::disallowed_methods, reason = "a browser needs files")]
        std::fs::write(path, &page.bytes).expect("the page can be written");
    }
}

#[test]
fn the_site_works_in_a_browser() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/browser");
    if let Some(reason) = missing(&folder) {
        // Past the capture of the test harness, so that it is seen.
        let _ = writeln!(std::io::stderr(), "skipped: the site works in a browser ({reason})");
        return;
    }
    let root = tempfile::tempdir().unwrap();
    write(root.path(), &site(&fixture::book()));
    let chromium = chromium().unwrap_or_default();
    let output =
        Command::new("node").arg("site.mjs").arg(root.path()).current_dir(folder).env("CHROMIUM", chromium).output();
    let output = output.unwrap();
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "\n{report}{}", String::from_utf8_lossy(&output.stderr));
    assert!(report.lines().filter(|line| line.starts_with("ok ")).count() >= 15, "\n{report}");
}

/// A site for looking at: `RUNGBOOK_SITE=folder cargo test --test it write_the_fixture -- --ignored`; with
/// `RUNGBOOK_COPIES=430` a large one.
#[test]
#[ignore = "needs RUNGBOOK_SITE, the folder to write to"]
fn write_the_fixture() {
    let root = std::env::var("RUNGBOOK_SITE").expect("RUNGBOOK_SITE names the folder to write to");
    let copies = std::env::var("RUNGBOOK_COPIES").ok().and_then(|copies| copies.parse().ok());
    let book = copies.map_or_else(fixture::book, fixture::large);
    write(Path::new(&root), &site(&book));
}
