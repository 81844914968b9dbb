//! Tests of the PDF: what is in it, that its links lead somewhere, that it grows with what it shows,
//! and that nothing a source tree says is taken for markup.

mod fixture;
mod hostile;
mod structure;

use std::process::Command;

use rungbook::book::view::Book;
use rungbook::render::pdf::{Date, Options, Output, Parts, Standard, render};

/// A moment that does not pass.
const DATE: Date = Date { year: 2026, month: 11, day: 22, hour: 12, minute: 0, second: 0 };

fn options() -> Options {
    Options { date: Some(DATE), ..Options::default() }
}

/// Renders, and takes a warning (above all one about convergence) for an error.
fn manual(book: &Book, options: &Options) -> Output {
    let out = render(book, options).expect("the manual is set");
    assert_eq!(out.warnings, Vec::<String>::new());
    out
}

/// The text of a PDF, or `None` where this machine cannot read one.
fn text_of(out: &Output) -> Option<String> {
    let text = filter("pdftotext", &["-layout", "-enc", "UTF-8"], &out.bytes)?;
    // Places where a long word may be broken are no text.
    Some(String::from_utf8_lossy(&text).replace(['\u{200b}', '\u{2060}'], ""))
}

/// A PDF as plain objects, or `None` where this machine has no qpdf.
fn objects_of(out: &Output) -> Option<String> {
    let plain = filter("qpdf", &["--qdf", "--object-streams=disable"], &out.bytes)?;
    Some(String::from_utf8_lossy(&plain).into_owned())
}

/// Runs a program on a file, from a temporary file to another.
#[expect(clippy::disallowed_methods, reason = "outside programs read and write files")]
fn filter(program: &str, arguments: &[&str], bytes: &[u8]) -> Option<Vec<u8>> {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let (from, to) = (folder.path().join("from.pdf"), folder.path().join("to"));
    std::fs::write(&from, bytes).expect("a temporary file is written");
    match Command::new(program).args(arguments).arg(&from).arg(&to).output() {
        Ok(done) => {
            assert!(done.status.success(), "{program}: {}", String::from_utf8_lossy(&done.stderr));
            Some(std::fs::read(&to).expect("the program wrote its output"))
        }
        Err(error) => {
            skipped(program, &error);
            None
        }
    }
}

#[expect(clippy::print_stderr, reason = "a test that does not run has to say so")]
fn skipped(program: &str, error: &std::io::Error) {
    eprintln!("skipped: `{program}` does not run here ({error})");
}

#[test]
fn everything_of_the_book_is_in_the_text() {
    let out = manual(&fixture::pneumatics(), &options());
    assert!(out.pages > 10, "{} pages", out.pages);
    assert!(out.replaced.is_empty());
    let Some(text) = text_of(&out) else { return };
    let expected = [
        "Cylinders and valves for TwinCAT 3",
        "1a2b3c4d",
        "2026-11-22",
        "Getting started",
        "Red is plus.",
        "Cylinders, valves and what they are mounted on.",
        "Pneumatics/Cylinders/FB_Cylinder.TcPOU:12",
        "FUNCTION_BLOCK ABSTRACT FB_Cylinder EXTENDS FB_Actuator IMPLEMENTS I_Cylinder",
        "A double-acting cylinder with two end positions.",
        "the valve's data sheet",
        "tested in the field",
        "nCount := nCount + 1;",
        "Keep hands off.",
        "320 ms",
        "What moves can be stuck.",
        "the way between the end positions",
        "A longer time hides a leak.",
        "%IX0.3",
        "Whether it began.",
        "Acknowledges an alarm.",
        "Extends in time",
        "[1, ∞]",
        "travelling",
        "is not a value of BOOL",
        "nColumn39",
        "undocumented-member",
        "9:5 ",
        "Old/Broken.TcPOU",
        "not decodable",
        "Tc2_MC2.AXIS_REF",
    ];
    for each in expected {
        assert!(text.contains(each), "`{each}` is missing");
    }
    assert!(!text.contains("sourceListingMark"), "listings are off unless asked for");
    assert!(text.contains("7 / "), "pages are numbered");
}

#[test]
fn parts_can_be_left_out_and_added() {
    let none = Parts {
        chapters: false,
        internals: false,
        tables: false,
        sources: false,
        coverage: false,
        holes: false,
        findings: false,
        index: false,
    };
    let all = Parts { sources: true, holes: true, ..Parts::default() };
    let small = manual(&fixture::pneumatics(), &Options { parts: none, ..options() });
    let large = manual(&fixture::pneumatics(), &Options { parts: all, ..options() });
    assert!(small.pages + 5 < large.pages);
    let (Some(small), Some(large)) = (text_of(&small), text_of(&large)) else { return };
    for each in
        ["sourceListingMark", "fbTimerWhich", "Extends in time", "Red is plus.", "Coverage", "Old/Broken", "Index"]
    {
        assert!(!small.contains(each) && large.contains(each), "{each}");
    }
}

#[test]
fn the_same_book_makes_the_same_bytes() {
    let book = fixture::pneumatics();
    let (first, second) = (manual(&book, &options()), manual(&book, &options()));
    assert!(first.bytes == second.bytes);
    assert!(first.bytes.windows(11).any(|bytes| bytes == b"D:202611221"), "the date is the one that was given");
}

#[test]
fn archives_and_screen_readers_are_served() {
    for standard in [Standard::A1b, Standard::A2b, Standard::A3b, Standard::A3a, Standard::Ua1, Standard::A3aUa1] {
        let out = manual(&fixture::pneumatics(), &Options { standard, ..options() });
        assert!(out.pages > 10, "{standard:?}");
        if let (Standard::A3b | Standard::A3a | Standard::A3aUa1, Some(faults)) =
            (standard, crate::archival::faults(&out.bytes))
        {
            assert_eq!(faults, Vec::<String>::new(), "{standard:?}");
        }
        if let Some(faults) = crate::archival::preflight(&out.bytes, standard == Standard::A1b) {
            assert_eq!(faults, Vec::<String>::new(), "{standard:?}");
        }
    }
}

#[test]
fn an_empty_book_is_a_manual_too() {
    let mut book = fixture::book(Vec::new());
    book.libraries.clear();
    book.chapters.clear();
    book.codes.clear();
    book.findings.clear();
    book.front = rungbook::book::view::Front::default();
    assert!(manual(&book, &options()).pages >= 2);
}

#[test]
fn a_users_template_replaces_an_embedded_one() {
    let mut options = options();
    let front = "#let title-page(book) = [My own title page]\n#let contents() = []\n#let chapter(view) = []\n";
    options.templates.insert("templates/pdf/front.typ".to_owned(), front.to_owned());
    let out = manual(&fixture::pneumatics(), &options);
    if let Some(text) = text_of(&out) {
        assert!(text.contains("My own title page") && !text.contains("1a2b3c4d"));
    }
}

#[test]
fn an_error_in_a_users_template_names_its_place() {
    let mut options = options();
    options
        .templates
        .insert("templates/pdf/front.typ".to_owned(), "\n#let title-page(book) = book.nothing\n".to_owned());
    let error = render(&fixture::pneumatics(), &options).expect_err("two functions are missing").to_string();
    assert!(error.contains("templates/pdf/manual.typ:"), "{error}");
}

#[test]
fn a_font_file_that_is_none_is_an_error() {
    let options = Options { fonts: vec![b"not a font".to_vec()], ..options() };
    let error = render(&fixture::pneumatics(), &options).expect_err("it is no font");
    assert_eq!(error.to_string(), "font file 1 is not a font");
}
