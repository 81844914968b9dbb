//! Whatever a comment holds, nothing panics, places stay in it, and no word of prose is lost.

use proptest::prelude::*;

use super::sample::Sample;
use crate::docs::comment::chunks;
use crate::library::{ItemKind, Placement};
use crate::text::Span;

/// Text made of what comments are made of.
fn text() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        "[a-zA-Z_äß]{1,8}",
        "[0-9]{1,3}",
        Just(" ".to_owned()),
        Just("\n".to_owned()),
        Just("\r\n  ".to_owned()),
        Just("\n\n\t".to_owned()),
        "[-=*#_+~|]{1,5}",
        "[.,;:!?<>\\[\\](){}`'\"$&@\\\\/]{1,3}",
        prop::sample::select(vec![
            "@param ",
            "@gtt x\n| a |\n",
            "\\return ",
            "<summary>",
            "</summary>",
            "<c>",
            "</c>",
            "<note type=\"warning\">",
            "</note>",
            "<see cref=\"FB_Pump.x\"/>",
            ":var_in INT a: ",
            ".. note:: ",
            "``",
            "```",
            "```gtt\n",
            "[FB_Pump]",
            "[x](y)",
            "version 1.0\nprogrammer x\n",
            "Description: ",
            "Author: ",
            "Copyright (c) 2020",
            "x := 1;\n",
            "- ",
            "1. ",
            "> ",
            "{@link x}",
            "$FB_Pump",
            "https://a.b/c_d ",
            "revision history\n1.0 ",
            "<table>",
            "<tr>",
            "</tr>",
            "</table>",
            "<ul>",
            "<li>",
            "&lt;",
            "<inheritdoc/>",
            "{@inheritDoc}",
            "@copydoc ",
            "> [!NOTE]\n",
            "TODO: ",
            "[^1]",
            "\u{feff}",
        ])
        .prop_map(str::to_owned),
    ];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

/// The comment as a block, or line by line.
fn comment() -> impl Strategy<Value = String> {
    let open = prop::sample::select(vec!["(*", "(**", "(*!", "(*~", "/**", "//", "///", "//!"]);
    (open, text()).prop_map(|(open, text)| match open {
        // `(*)` opens and does not close.
        "(*" | "(**" | "(*!" | "/**" if text.starts_with([')', '/']) => {
            let close = if open == "/**" { "*/" } else { "*)" };
            format!("{open} {}{close}", text.replace('*', " "))
        }
        "(*~" => format!("(*~{}~*)", text.replace("*)", "* )")),
        open if open.starts_with("(*") => format!("{open}{}*)", text.replace("*)", "* )")),
        open if open.starts_with("/*") => format!("{open}{}*/", text.replace("*/", "* /")),
        open => text.lines().map(|line| format!("{open} {line}\n")).collect(),
    })
}

fn words(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn places_lie_within_the_comment(comment in comment()) {
        let sample = Sample::above(&comment);
        let whole = Span::from(0..comment.len());
        let docs = sample.read();
        let entry = &docs.items[0];
        for considered in &entry.considered {
            prop_assert!(whole.contains(considered.place.span));
        }
        if let Some(doc) = &entry.doc {
            for (_, place) in doc.links() {
                prop_assert!(whole.contains(place.span));
            }
            for param in &doc.tags.params {
                prop_assert_eq!(sample.at(param.place), param.name.as_str());
            }
            for (id, place) in &doc.tags.requirements {
                prop_assert_eq!(sample.at(*place), id.as_str());
            }
            for table in &doc.tables {
                prop_assert!(whole.contains(table.place.span));
                for (at, c) in table.text.char_indices().filter(|(_, c)| !c.is_whitespace()) {
                    let span = table.map.span(Span::from(at..at + c.len_utf8()));
                    prop_assert_eq!(span.of(&sample.text), c.to_string());
                }
            }
        }
    }

    #[test]
    fn cleaning_keeps_every_word(comment in comment()) {
        let sample = Sample::above(&comment);
        let catalogue = sample.catalogue();
        let read: Vec<String> = chunks(&catalogue, &catalogue.items[0].comments[0])
            .iter()
            .flat_map(|chunk| words(chunk.text.as_str()))
            .collect();
        prop_assert_eq!(read, words(&comment));
    }

    #[test]
    fn reading_twice_gives_the_same(a in comment(), b in comment()) {
        let mut sample = Sample::new();
        let comments = vec![sample.comment(Placement::Above, &a)];
        let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, comments);
        sample.variable(block, "x", &format!("{b}\n"), "// behind");
        prop_assert_eq!(sample.read(), sample.read());
    }
}

#[test]
fn deep_nesting_is_no_stack_overflow() {
    for text in
        [">".repeat(20_000), "- ".repeat(5_000), "[".repeat(5_000), "<ul><li>".repeat(3_000), "*a ".repeat(20_000)]
    {
        let docs = Sample::above(&format!("(* {text} *)")).read();
        assert_eq!(docs.items.len(), 1);
    }
}
