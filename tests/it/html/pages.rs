//! What the pages say, how they hang together, and that nothing from a tree becomes markup.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use rungbook::render::html::{Error, Options, Page, render, steps};

use super::fixture::{self, HOSTILE};
use super::{crawl, site, text};

fn faults(pages: &[Page]) -> Vec<String> {
    crawl::faults(pages.iter().map(|page| (page.path.as_str(), page.bytes.as_slice())))
}

#[test]
fn an_entity_page() {
    let pages = site(&fixture::book());
    insta::assert_snapshot!(text(&pages, "handling/drives/fb_cylinder.html"));
}

#[test]
fn every_link_and_anchor_leads_somewhere() {
    let faults = faults(&site(&fixture::book()));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_large_book_is_cut_into_pages_and_still_hangs_together() {
    let pages = site(&fixture::large(300));
    assert!(pages.iter().any(|page| page.path == "names-f.html"));
    let faults = faults(&pages);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_crawler_sees_what_is_wrong() {
    let html = "<p id=\"a\" id=\"b\"><i id=\"a\"></i><a href=\"#c\">x</a><a href=\"no.html\">y</a>\
                <script src=\"https://x/y.js\"></script><a href=\"javascript:1\" onclick=\"2\">z</a>";
    let found = crawl::faults([("d/p.html", html.as_bytes())]);
    let expected = [
        "d/p.html: the id `a` occurs twice",
        "d/p.html: a handler `onclick` in <a>",
        "d/p.html: `#c` leads to no anchor",
        "d/p.html: loads `https://x/y.js` from elsewhere",
        "d/p.html: the scheme of `javascript:1` is not admitted",
        "d/p.html: `no.html` leads to no file (`d/no.html`)",
    ];
    assert_eq!(found, expected);
}

/// For a tree rendered by hand: `RUNGBOOK_SITE=out/html cargo test --test it crawl_a_directory -- --ignored`.
#[test]
#[ignore = "needs RUNGBOOK_SITE, the folder of a rendered site"]
fn crawl_a_directory() {
    let root = std::env::var("RUNGBOOK_SITE").expect("RUNGBOOK_SITE names the folder of a rendered site");
    let root = Path::new(&root);
    let files: BTreeMap<String, Vec<u8>> = walkdir::WalkDir::new(root)
        .into_iter()
        .filter_map(Result::ok)
        .filter(|entry| entry.file_type().is_file())
        .map(|entry| {
            let path = entry.path().strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
            #[expect(clippy::disallowed_methods, reason = "the test reads what a build wrote")]
            let bytes = std::fs::read(entry.path()).unwrap();
            (path, bytes)
        })
        .collect();
    let faults = crawl::faults(files.iter().map(|(path, bytes)| (path.as_str(), bytes.as_slice())));
    assert!(faults.is_empty(), "{} faults, among them\n{}", faults.len(), faults[..faults.len().min(40)].join("\n"));
}

#[test]
fn the_same_book_gives_the_same_bytes() {
    assert_eq!(site(&fixture::book()), site(&fixture::book()));
}

#[test]
fn progress_counts_every_page() {
    let book = fixture::book();
    let done = AtomicUsize::new(0);
    render(&book, &Options::default(), &|n| {
        done.fetch_add(n, Ordering::Relaxed);
    })
    .unwrap();
    assert_eq!(done.into_inner(), steps(&book));
}

#[test]
fn hostile_text_stays_text() {
    let pages = site(&fixture::book());
    let admitted = ["early.js", "nav.js", "search.js", "rungbook.js"];
    for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
        let html = std::str::from_utf8(&page.bytes).unwrap();
        assert_eq!(html.matches("<script").count(), admitted.len(), "{}", page.path);
        for (tag, name, value) in crawl::attributes(html) {
            assert!(!name.starts_with("on"), "{}: {name}", page.path);
            let is_asset = || admitted.iter().any(|script| value.ends_with(script));
            assert!(tag != "img" && (name != "src" || is_asset()), "{}: <{tag} {name}>", page.path);
            assert!(name != "href" || !value.trim().to_lowercase().starts_with("javascript:"), "{}", page.path);
        }
        assert!(!html.contains('\0'));
    }
    let html = text(&pages, "handling/hostile.html");
    assert!(html.contains("&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;"));
    assert!(html.contains("{{ 7*7 }}"), "text is no template");
}

#[test]
fn hostile_names_cannot_leave_the_data_of_scripts() {
    let pages = site(&fixture::book());
    for path in ["assets/search-index.js", "assets/nav.js"] {
        let script = text(&pages, path);
        assert!(script.contains("onerror"), "the name is in {path}");
        assert!(!script.contains('<') && !script.contains('\u{2028}'), "{path}");
        let json = script.split_once('=').unwrap().1.trim().trim_end_matches(';');
        let value: serde_json::Value = serde_json::from_str(json).unwrap();
        assert!(value.to_string().contains("alert(1)"));
    }
    let index = text(&pages, "assets/search-index.js");
    let json = index.split_once('=').unwrap().1.trim().trim_end_matches(';');
    let value: serde_json::Value = serde_json::from_str(json).unwrap();
    let names: Vec<&str> = value["entries"].as_array().unwrap().iter().filter_map(|e| e[0].as_str()).collect();
    assert!(names.contains(&HOSTILE) && names.contains(&"FB_Cylinder"));
}

#[test]
fn nothing_is_asked_of_another_host() {
    for page in site(&fixture::book()) {
        let text = String::from_utf8(page.bytes).unwrap();
        if page.path.ends_with(".html") {
            assert!(text.contains("default-src 'none'"), "{}", page.path);
        } else {
            let text = text.replace("http://www.w3.org/2000/svg", "");
            assert!(!text.contains("://") || text.contains("file://"), "{}", page.path);
            assert!(!text.contains("http") && !text.contains("@import"), "{}", page.path);
        }
    }
}

#[test]
fn a_users_template_replaces_the_embedded_one() {
    let overrides = [
        ("templates/html/kind.html", "{% include \"mine.html\" %}"),
        ("templates/html/mine.html", "<p>{{ title }}</p>"),
        ("themes/style.css", "p { color: red }"),
        ("themes/logo.svg", "<svg/>"),
    ];
    let options = Options { overrides: overrides.map(|(n, t)| (n.to_owned(), t.to_owned())).into() };
    let pages = render(&fixture::book(), &options, &|_| {}).unwrap();
    assert_eq!(text(&pages, "types.html"), "<p>Types</p>");
    assert_eq!(text(&pages, "assets/style.css"), "p { color: red }");
    assert_eq!(text(&pages, "assets/logo.svg"), "<svg/>");
}

fn error_of(name: &str, content: &str) -> Error {
    let options = Options { overrides: [(name.to_owned(), content.to_owned())].into() };
    render(&fixture::book(), &options, &|_| {}).expect_err("the file is wrong")
}

#[test]
fn an_error_in_a_users_template_names_file_and_line() {
    let error = error_of("templates/html/kind.html", "<p>\n{% if %}").to_string();
    assert!(error.starts_with("templates/html/kind.html:2:"), "{error}");
    let error = error_of("templates/html/entity.html", "a\nb\n{{ nothing.at.all }}").to_string();
    assert!(error.starts_with("templates/html/entity.html:3:"), "{error}");
    let error = error_of("templates/html/kind.html", "{% extends \"gone.html\" %}").to_string();
    assert!(error.starts_with("templates/html/kind.html") && error.contains("gone.html"), "{error}");
    let error = error_of("themes/syntax/structured-text.sublime-syntax", "a: [").to_string();
    assert!(error.starts_with("themes/syntax/structured-text.sublime-syntax: "), "{error}");
}

#[test]
fn two_pages_at_one_path_are_refused() {
    let mut book = fixture::book();
    book.entities[0].core.url = "Handling/MAIN.html".to_owned();
    let error = render(&book, &Options::default(), &|_| {}).unwrap_err();
    assert_eq!(error, Error::Collision { path: "handling/main.html".to_owned() });
}

#[test]
fn an_empty_book_is_a_site() {
    let mut book = fixture::book();
    book.entities.clear();
    book.libraries.clear();
    book.kinds.clear();
    book.index.clear();
    book.findings.clear();
    book.codes.clear();
    book.chapters.clear();
    book.explanations.clear();
    book.coverage = Default::default();
    book.front = Default::default();
    let faults = faults(&site(&book));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// `cargo test --release --no-default-features --test it a_large_book_is_quick -- --ignored --nocapture`.
#[test]
#[ignore = "measures; means something in release mode on a quiet machine only"]
fn a_large_book_is_quick() {
    let book = fixture::large(430);
    let start = std::time::Instant::now();
    let pages = site(&book);
    let elapsed = start.elapsed();
    let bytes: usize = pages.iter().map(|page| page.bytes.len()).sum();
    assert!(elapsed.as_millis() < 1000, "{} pages, {} kB took {elapsed:?}", pages.len(), bytes / 1024);
}
