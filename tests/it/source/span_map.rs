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

/// Checks that each run of `fragment` stands in `file` byte for byte, or stands for a part of it.
fn check_runs(fragment: &Fragment, file: &str) {
    let runs = fragment.map.runs();
    for (index, run) in runs.iter().enumerate() {
        let end = runs.get(index + 1).map_or(fragment.text.len(), |next| next.from as usize);
        let text = &fragment.text[run.from as usize..end];
        match run.stands_for {
            None => assert_eq!(Some(text), file.get(run.to as usize..run.to as usize + text.len())),
            Some(length) => assert!(file.get(run.to as usize..(run.to + length) as usize).is_some()),
        }
    }
}

/// Pieces of every format, in any order.
fn rubble() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        "[a-z &;:=<>'\"(){}*@#-]{0,8}",
        "\r?\n",
        prop::sample::select(vec![
            "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">",
            "<pou name=\"p\" pouType=\"function\">",
            "<interface>",
            "<inputVars constant=\"true\">",
            "<variable name=\"v&amp;w\">",
            "<type><array><dimension lower=\"0\" upper=\"n\"/><baseType><INT/>",
            "<documentation><xhtml>\u{e4} doc<br/>\n  more</xhtml></documentation>",
            "<initialValue><arrayValue><value repetitionValue=\"2\"><simpleValue value=\"1\"/>",
            "</variable></inputVars></interface>",
            "<body><ST><xhtml>a &lt; b</xhtml></ST></body></pou>",
            "<data name=\"d\"><InterfaceAsPlainText><xhtml>F</xhtml></InterfaceAsPlainText></data>",
            "<FBType Name=\"F\" Comment=\"c&#10;d\"><InterfaceList>",
            "<EventInputs><Event Name=\"E\"><With Var=\"V\"/></Event></EventInputs>",
            "<InputVars><VarDeclaration Name=\"V\" Type=\"INT\" ArraySize=\"3\" Comment=\"x&#10;y\"/></InputVars>",
            "<ExportFile>",
            "<Single><Single Name=\"MetaObject\"><Single Name=\"Guid\">g</Single><Single Name=\"ParentGuid\">g</Single><Single Name=\"Name\">n</Single></Single>",
            "<Single Name=\"Object\"><Single Name=\"Interface\"><Single Name=\"TextDocument\"><Array Name=\"TextLines\"><Single><Single Name=\"Text\">VAR</Single></Single></Array>",
            "(* @NESTEDCOMMENTS := 'Yes' *)\n",
            "(* @PATH := '\\/a' *)\n",
            "(* @END_DECLARATION := '0' *)\n",
            "(* @OBJECT_END := 'x' *)\n",
            "PROGRAM p\n",
            "ACTION a:\n",
            "END_ACTION\n",
            "END_PROGRAM\n",
            "_LD_BODY\n",
            "FUNCTION_BLOCK \"b\"\n",
            "BEGIN\n",
            "NETWORK\n",
            "END_FUNCTION_BLOCK\n",
            "(*#-#-#---Declaration---#-#*)\n",
            "(*#-#-#---Implementation---#-#*)\n",
            "\u{1F600}\u{e9}",
        ])
        .prop_map(str::to_owned),
    ];
    prop::collection::vec(piece, 0..30).prop_map(|pieces| pieces.concat())
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
    fn rubble_in_any_format_is_read_and_mapped(text in rubble(), lead in "(<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">|<FBType|<ExportFile>|)") {
        const NAMES: [&str; 16] = [
            "a.xml", "a.export", "a.exp", "a.fbt", "a.dtp", "a.gcf", "a.awl", "a.s7dcl", "a.scl", "a.pou", "a.TcPOU", "a.plcproj", "a.lby", "a.iecst", "a.st", "apax.yml",
        ];
        let file = format!("{lead}{text}");
        let memory = NAMES.iter().fold(Memory::new(), |memory, name| memory.with(name, &file));
        let tree = read(&memory);
        for fragment in tree.units.iter().flat_map(fragments) {
            check_runs(fragment, &file);
        }
        for finding in &tree.findings {
            let text = &tree.files.get(finding.place.file).text;
            prop_assert!(text.get(finding.place.span.range()).is_some());
        }
        let read_files = tree.units.len() + tree.projects.iter().filter(|project| tree.units.iter().all(|unit| unit.file != project.file)).count();
        prop_assert_eq!(read_files + tree.skipped.len(), NAMES.len(), "every file is accounted for");
    }

    #[test]
    fn what_roxmltree_accepts_has_no_problem_and_what_has_none_it_accepts(text in "(<a>|</a>|<b/>|<b x=\"1\"/>|<b x='<'/>|<c|/>|&amp;|&|text|<!-- c -->|<!\\[CDATA\\[x\\]\\]>|<\\?p q\\?>){0,12}") {
        let file = format!("<TcPlcObject>{text}<POU Name=\"P\"/></TcPlcObject>");
        let tree = read(&Memory::new().with("P.TcPOU", &file));
        let told = tree.findings.iter().any(|finding| finding.code.name == "malformed-xml");
        prop_assert_eq!(told, roxmltree::Document::parse(&file).is_err());
    }
}
