//! Text that would be markup, or cannot be printed at all.

use super::{fixture, manual, options, text_of};
use rungbook::book::view::entity::{Relation, TypePart};
use rungbook::book::view::prose::{Block, Inline, ListItem};

/// What a comment might say to get out of its string.
const HOSTILE: &[&str] = &[
    "#panic()",
    "#{panic(\"x\")}",
    "]#panic()[",
    "*bold* _emph_ `raw` ```",
    "$ x^2 $",
    "@label <label>",
    "\\ \\u{41} \\",
    "// not a comment /* nor this */",
    "</text><script>alert(1)</script>",
    "\"quoted\" 'single' {braces}",
    "= heading",
    "- item\n+ item\n/ term: x",
    "https://example.org/#x",
    "~ -- --- ... -?",
];

/// The same text in every place that takes text.
pub(super) fn book_of(evil: &str) -> rungbook::book::view::Book {
    let mut book = fixture::pneumatics();
    for field in [&mut book.front.title, &mut book.front.subtitle, &mut book.front.version, &mut book.front.author] {
        *field = evil.to_owned();
    }
    book.chapters[0].title = evil.to_owned();
    book.libraries[0].name = evil.to_owned();
    book.libraries[0].references = vec![evil.to_owned()];
    book.externals = vec![(evil.to_owned(), 1)];
    book.findings[0].message = evil.to_owned();
    book.skipped[0].reason = evil.to_owned();
    book.index[0].name = evil.to_owned();
    let entity = &mut book.entities[1];
    entity.folder = vec![evil.to_owned()];
    entity.relations.push(Relation { key: "uses", title: "Uses", links: vec![fixture::link(evil, "x", "nowhere")] });
    let core = &mut entity.core;
    core.name = evil.to_owned();
    core.qualified_name = format!("{evil}.{evil}");
    core.file = evil.to_owned();
    core.signature = evil.to_owned();
    core.badges = vec![evil.to_owned()];
    core.pragmas = vec![evil.to_owned()];
    core.brief = fixture::text(evil);
    core.detail = vec![
        fixture::paragraph(evil),
        Block::Code { language: "#panic()".to_owned(), text: evil.to_owned() },
        Block::Heading { level: 1, anchor: String::new(), content: fixture::text(evil) },
        Block::Note { style: evil.to_owned(), title: evil.to_owned(), content: Vec::new() },
        Block::Table {
            align: vec!["left"],
            head: vec![fixture::text(evil)],
            rows: vec![vec![fixture::text(evil), Vec::new()], Vec::new()],
        },
    ];
    core.type_label = Some("Type");
    core.type_ = vec![TypePart { text: evil.to_owned(), to: None }];
    let variable = &mut core.sections[0].variables[0];
    (variable.name, variable.initial, variable.address) = (evil.to_owned(), evil.to_owned(), evil.to_owned());
    let table = &mut entity.tables[0];
    table.name = evil.to_owned();
    table.facts = vec![(evil.to_owned(), evil.to_owned())];
    table.rows[0].seq = evil.to_owned();
    table.rows[0].duration = evil.to_owned();
    table.rows[0].remark = fixture::text(evil);
    table.rows[0].cells[0].text = evil.to_owned();
    table.rows[1].cells.truncate(1);
    table.columns[0].name = evil.to_owned();
    table.brackets[0].label = evil.to_owned();
    book
}

#[test]
fn text_is_text_wherever_it_stands() {
    let all = HOSTILE.join(" ");
    let out = manual(&book_of(&all), &options());
    let Some(text) = text_of(&out) else { return };
    let text: String = text.split_whitespace().collect();
    for each in HOSTILE {
        let each: String = each.split_whitespace().collect();
        assert!(text.contains(&each), "`{each}` was not printed as it stands");
    }
}

#[test]
fn what_cannot_be_printed_is_replaced_and_counted() {
    let evil = "a\u{0}b\u{7}c\u{1b}[31m\u{202e}d\u{feff}ef 温度 😀 \u{10ffff}";
    let out = manual(&book_of(evil), &options());
    for character in ['\u{0}', '\u{1b}', '\u{10ffff}', '温'] {
        assert!(out.replaced.get(&character) >= Some(&10), "{character:?}: {:?}", out.replaced);
    }
    assert!(!out.replaced.contains_key(&'\u{202e}'), "what only steers is dropped");
}

#[test]
fn names_without_an_end_stay_on_the_page() {
    let long = "a_VeryLong.Name".repeat(60);
    let out = manual(&book_of(&long), &options());
    assert!(out.pages < 80, "{} pages", out.pages);
    assert!(out.replaced.is_empty());
}

#[test]
fn empty_texts_are_harmless() {
    manual(&book_of(""), &options());
}

#[test]
fn prose_without_a_bottom_is_flattened() {
    let mut block = fixture::paragraph("the bottom");
    let mut inline = Inline::text("the inner bottom");
    for level in 0..150 {
        block = match level % 3 {
            0 => Block::Quote { content: vec![block] },
            1 => Block::List { start: None, items: vec![ListItem { checked: Some(true), content: vec![block] }] },
            _ => Block::Note { style: "note".to_owned(), title: "Note".to_owned(), content: vec![block] },
        };
        inline = if level % 2 == 0 {
            Inline::Emph { content: vec![inline] }
        } else {
            Inline::Strong { content: vec![inline] }
        };
    }
    let mut book = fixture::pneumatics();
    book.entities[1].members[0].core.detail = vec![block, Block::Paragraph { content: vec![inline] }];
    let out = manual(&book, &options());
    let Some(text) = text_of(&out) else { return };
    assert!(text.contains("the bottom") && text.contains("the inner bottom"));
}
