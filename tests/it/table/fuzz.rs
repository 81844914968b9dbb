//! No input is a crash: every reader on texts made of the words that it knows, in no order.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rungbook::table::automaton::Automaton;
use rungbook::table::read::{self, Options};
use rungbook::table::{Piece, explain, layout, lint, write};
use rungbook::text::FileId;

const WORDS: [&str; 95] = [
    "@gtt ",
    "A",
    " (cycle 10ms",
    ", const K = 3",
    ", global g : INT with [0,",
    ")",
    "(",
    "\n",
    "\n|",
    "|",
    " in X ",
    " out Y ",
    " dur ",
    " repeat ",
    " remark ",
    " # ",
    "---",
    "{ ",
    "} x ",
    "}",
    "-",
    "–",
    "-∞",
    "ω",
    "[1,5]",
    "[",
    "]",
    ", ",
    ">= ",
    "< ",
    "≠",
    "√",
    "^",
    "T",
    "F",
    "1",
    "16#FF",
    "T#5ms",
    "5 ms",
    "TRUE",
    " AND ",
    " OR ",
    "NOT ",
    "if :: ",
    " -> ",
    " fi",
    "X[-1]",
    "X[+1]",
    "SEL(",
    ":=",
    "E#A",
    ".",
    "'",
    "\"",
    "\\|",
    "ä",
    "table T {",
    "relational table R(a, b) {",
    "var input x : INT ",
    "var output ",
    "column output c as ",
    "gvar g : INT with ",
    "timeconst K : 5 ",
    "options { a = 1 }",
    "group ",
    "row ",
    "row a ",
    "omega ",
    "progress ",
    "_p ",
    ">>",
    "x: ",
    "x: 1;",
    "a|>x: ",
    "0::x",
    "\\goto: \\pass(A, a);",
    "\\pause: a ",
    "\\inherit_from T ",
    "function f ",
    "END_FUNCTION",
    "//",
    "/*",
    "*/",
    "(*",
    "*)",
    "\r\n",
    "\t",
    "contract automaton C {",
    "`a b`",
    "#",
    "%",
    "**",
    "&lt;",
    "\u{feff}",
    ";",
];

const XML: [&str; 36] = [
    "<test-table>",
    "</test-table>",
    "<variables>",
    "</variables>",
    "<variable io=\"input\" name=\"a\" data-type=\"INT\"/>",
    "<constraint name=\"p\" constraint=\"&gt;\"/>",
    "<steps>",
    "</steps>",
    "<step>",
    "<step duration=\"[1,-]\">",
    "</step>",
    "<block>",
    "</block>",
    "<cell>",
    "</cell>",
    "1",
    "&lt;",
    "&#x2260;",
    "<![CDATA[ä]]>",
    "<!-- -- -->",
    "<session>",
    "</session>",
    "<specification isConcrete=\"true\">",
    "</specification>",
    "<rows>",
    "</rows>",
    "<row>",
    "</row>",
    "<duration>",
    "</duration>",
    "<cycle>",
    "</cycle>",
    "<tabletestspec>",
    "</tabletestspec>",
    "<testcase><teststeps><teststep><inputs><set var=\"a\" value=\"(\"/></inputs></teststep></teststeps></testcase>",
    "ü",
];

fn everything(text: &str) {
    let piece = Piece::verbatim(FileId(0), text, 7);
    let options = Options { headless: true, ..Options::default() };
    let reads = [
        read::text(&piece, &options),
        read::pipe::read(&piece, &options),
        read::gtt::read(&piece, &options),
        read::xml::read(&piece, &options),
        read::sheet::csv(&piece, "S", &options),
    ];
    for read in reads {
        for finding in &read.findings {
            let end = u32::try_from(text.len()).unwrap_or(u32::MAX) + 7;
            assert!(finding.place.span.start >= 7 && finding.place.span.end <= end, "{finding:?}");
        }
        for table in &read.tables {
            let _ = (layout::layout(table), lint::lint(table), explain::sentences(table), Automaton::build(table));
            let _ =
                (write::pipe(table), write::gtt(table), write::exteta(table), write::stvs(table), write::csv(table));
        }
    }
    assert_eq!(write::format_in_place(&write::format_in_place(text)), write::format_in_place(text), "{text}");
}

#[test]
fn no_text_is_a_crash() {
    let words = |words: &'static [&'static str]| {
        prop::collection::vec(prop::sample::select(words.to_vec()), 0..40).prop_map(|words| words.concat())
    };
    let begun = words(&XML).prop_map(|text| format!("<test-table><variables>{text}</variables></test-table>"));
    let tabled = words(&WORDS).prop_map(|text| format!("@gtt A\n| # | in X | out Y | dur | repeat |\n| {text}"));
    let grouped = words(&WORDS).prop_map(|text| format!("table T {{ var input x : INT group {{ row {{ {text}"));
    let texts = prop_oneof![words(&WORDS), words(&XML), begun, tabled, grouped, ".{0,60}"];
    let config = Config { cases: crate::support::cases(), failure_persistence: None, ..Config::default() };
    if let Err(error) = TestRunner::new(config).run(&texts, |text| {
        everything(&text);
        Ok(())
    }) {
        panic!("{error}");
    }
}

#[test]
fn what_was_found_stays_mended() {
    // A header cell that begins with blanks, as a cell of comma-separated values may, before a sign of several bytes.
    everything(" a);TRUE≠ out Y  OR\nA,B\n");
    everything(" in X \\goto: \\pass(A, a);– (cycle 10msA\r\nA");
    // Text that a reader of comma-separated values made is longer than the file.
    everything("table T { var input x : INT group { row { \r\n in X |");
    everything("x, in, X\n1,2,3\n,,\"in X\n");
    // A column that is declared behind the rows.
    everything("table T { var input x : INT group { row { x : 1 } } column output c as row }");
}
