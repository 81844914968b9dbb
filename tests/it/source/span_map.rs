//! Every byte of a fragment stands where its map says, over generated containers.

use proptest::prelude::*;
use rungbook::source::Memory;
use rungbook::text::{Fragment, Span, Unit};

use super::{fragments, read};

/// Checks `fragment` byte by byte: each stands in `file` at its place, or its place is a reference to its character.
pub(super) fn check(fragment: &Fragment, file: &str) {
    for (at, character) in fragment.text.char_indices() {
        let (at, len) = (at as u32, character.len_utf8() as u32);
        let there = fragment.map.span(Span::new(at, at + len)).of(file);
        let written = there.chars().eq([character]);
        let decoded = roxmltree::Document::parse(&format!("<a>{there}</a>"))
            .ok()
            .and_then(|xml| xml.root_element().text().map(str::to_owned));
        assert!(
            written || decoded.is_some_and(|text| text.chars().eq([character])),
            "{character:?} at {at} maps to {there:?}"
        );
    }
}

fn check_unit(unit: &Unit, file: &str) {
    for fragment in fragments(unit) {
        check(fragment, file);
    }
}

/// Text as a piece of an element's content: what it says, and how it is written.
fn piece() -> impl Strategy<Value = (String, String)> {
    let text = "[a-zA-Z0-9 äß€𝄞;:=\\[\\]>\r\n\t'$&<]{0,12}";
    let section = text.prop_filter_map("a section holds no end of one", |text| {
        (!text.contains("]]>")).then(|| (text.clone(), format!("<![CDATA[{text}]]>")))
    });
    let escaped = text.prop_map(|text| {
        let written = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&#x3E;").replace('ä', "&#228;");
        (text, written)
    });
    let comment = "[a-z <&>]{0,6}".prop_map(|text| (String::new(), format!("<!--{text}-->")));
    prop_oneof![4 => section, 4 => escaped, 1 => comment]
}

proptest! {
    #[test]
    fn every_byte_maps_back(declaration in prop::collection::vec(piece(), 0..6), body in prop::collection::vec(piece(), 0..6)) {
        let said = |pieces: &[(String, String)]| pieces.iter().map(|(said, _)| said.as_str()).collect::<String>();
        let written = |pieces: &[(String, String)]| pieces.iter().map(|(_, written)| written.as_str()).collect::<String>();
        let file = format!(
            "<TcPlcObject><POU Name=\"P\"><Declaration>{}</Declaration><Implementation><ST>{}</ST></Implementation></POU></TcPlcObject>",
            written(&declaration),
            written(&body)
        );
        let tree = read(&Memory::new().with("P.TcPOU", &file));
        prop_assert!(tree.findings.is_empty(), "{:?}", tree.findings);
        let unit = &tree.units[0];
        let texts: Vec<String> = fragments(unit).iter().map(|fragment| fragment.text.to_string()).collect();
        prop_assert_eq!(texts, [said(&declaration), said(&body)]);
        check_unit(unit, &file);
        // roxmltree is the oracle; it folds line ends, as the XML standard asks.
        let oracle = roxmltree::Document::parse(&file).expect("the file is sound");
        let node = oracle.descendants().find(|node| node.has_tag_name("ST")).expect("it is there");
        let theirs: String = node.children().filter_map(|child| child.text().filter(|_| child.is_text())).collect();
        let folded = |text: &str| text.replace(['\r', '\n'], "");
        prop_assert_eq!(folded(&theirs), folded(&said(&body)));
    }

    #[test]
    fn any_text_at_all_is_read_and_mapped(text in "(<[A-Za-z/!\\[\\]=\"'&;?-]{0,8}|<!\\[CDATA\\[|\\]\\]>|<POU Name=\"a\">|</POU>|<Declaration>|</Declaration>|<ST>|[a&;<>\"\\]é ]){0,40}") {
        let file = format!("<TcPlcObject>{text}");
        let tree = read(&Memory::new().with("P.TcPOU", &file));
        for unit in &tree.units {
            check_unit(unit, &file);
        }
        for finding in &tree.findings {
            prop_assert!(file.get(finding.place.span.range()).is_some());
        }
    }

    #[test]
    fn what_roxmltree_accepts_has_no_problem_and_what_has_none_it_accepts(text in "(<a>|</a>|<b/>|<b x=\"1\"/>|<b x='<'/>|<c|/>|&amp;|&|text|<!-- c -->|<!\\[CDATA\\[x\\]\\]>|<\\?p q\\?>){0,12}") {
        let file = format!("<TcPlcObject>{text}<POU Name=\"P\"/></TcPlcObject>");
        let tree = read(&Memory::new().with("P.TcPOU", &file));
        let told = tree.findings.iter().any(|finding| finding.code.name == "malformed-xml");
        prop_assert_eq!(told, roxmltree::Document::parse(&file).is_err());
    }
}
