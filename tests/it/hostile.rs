//! Bad input: what nests without end, what is huge, what expands, and names that mean something elsewhere. Every target
//! of the fuzzer takes each, in bounded time and on the stack of a test's thread.

use std::time::Instant;

use rungbook::source::Memory;
use rungbook::{pipeline, source};

use super::fuzz::targets;
use super::html::crawl;
use super::support::settings;

/// Runs `text` through every target whose name `wanted` admits; the first byte of `text` may choose a variant.
fn all(text: &[u8], wanted: impl Fn(&str) -> bool) {
    for (name, target) in targets::ALL.iter().filter(|(name, _)| wanted(name)) {
        let start = Instant::now();
        target(text);
        let shown = String::from_utf8_lossy(&text[..text.len().min(40)]).into_owned();
        assert!(start.elapsed().as_secs() < 20, "{name} took {:?} for {shown:?}", start.elapsed());
    }
}

#[test]
fn comments_that_nest_without_end_are_cut() {
    for opener in
        ["> ", "- ", "1. ", "**", "*a ", "[", "![", "](", "`", "<b>", "<summary>", "{@link ", "| ", "(* ", "<!--"]
    {
        all(format!("\0{}", opener.repeat(5000)).as_bytes(), |name| name == "docs");
        all(format!("\0{}x", format!("{opener}\n").repeat(2000)).as_bytes(), |name| name == "docs");
    }
}

#[test]
fn tables_that_nest_without_end_are_cut() {
    let is_table = |name: &str| ["pipe_table", "gtt", "table_xml", "csv"].contains(&name);
    let inner =
        ["(", "-", "NOT ", "1 + ", "1 -> ", "[", "[1, ", "^", "if :: ", "a[", "f(", "1 AND ", "a.", "X[-1] + ", "{ "];
    for piece in inner {
        let cell = piece.repeat(5000);
        all(
            format!("@gtt A\n| # | in X : INT | out Y | dur | repeat |\n|---|\n| 1 | {cell} | {cell} | 1 | {cell} |\n")
                .as_bytes(),
            is_table,
        );
        all(
            format!("table T {{ var input x : INT with {cell} group {{ row {{ x : {cell} }} }} }}").as_bytes(),
            is_table,
        );
        all(format!("#,in X,out Y,dur\n1,\"{cell}\",1,\"{cell}\"\n").as_bytes(), is_table);
    }
    for piece in ["group { ", "group a [1,2] { row { ", "table T { ", "row ", "{", "| 1 ", "|\n"] {
        all(piece.repeat(5000).as_bytes(), is_table);
        all(format!("table T {{ var input x : INT {}", piece.repeat(5000)).as_bytes(), is_table);
    }
    for piece in ["<block>", "<step>", "<a>", "<rows><row>", "<!--", "<![CDATA[", "&lt;"] {
        let steps = format!(
            "<test-table name=\"a\"><variables><variable io=\"input\" name=\"a\" data-type=\"INT\"/></variables><steps>{}",
            piece.repeat(20_000)
        );
        all(steps.as_bytes(), is_table);
        all(format!("{steps}</steps></test-table>").as_bytes(), is_table);
    }
    let nested = format!(
        "<test-table name=\"a\"><variables><variable io=\"input\" name=\"a\" data-type=\"INT\"/></variables><steps>{}<step><cell>1</cell></step>{}</steps></test-table>",
        "<block>".repeat(20_000),
        "</block>".repeat(20_000)
    );
    all(nested.as_bytes(), is_table);
}

#[test]
fn containers_that_nest_without_end_are_cut() {
    let is_format = |name: &str| !["syntax", "docs", "chain", "workbook"].contains(&name);
    for piece in [
        "<a>",
        "<project><types><pous><pou name=\"a\">",
        "<FBType Name=\"a\">",
        "<Single Name=\"a\">",
        "(* @",
        "&amp;",
        "<a b=\"",
        "]]>",
    ] {
        all(format!("\0{}", piece.repeat(20_000)).as_bytes(), is_format);
        all(piece.repeat(20_000).as_bytes(), is_format);
    }
}

/// Entities that a document type declares are never expanded, in containers as in tables.
#[test]
fn entities_do_not_expand() {
    let mut bomb = String::from("<!DOCTYPE a [<!ENTITY e0 \"0123456789\">");
    for i in 1..10 {
        bomb.push_str(&format!("<!ENTITY e{i} \"{}\">", format!("&e{};", i - 1).repeat(10)));
    }
    bomb.push_str("]>");
    for root in [
        "<test-table name=\"&e9;\"><variables>&e9;</variables></test-table>",
        "<session xmlns=\"http://formal.iti.kit.edu/stvs/io/1.0/\"><code><plaintext>&e9;</plaintext></code></session>",
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\">&e9;</project>",
        "<TcPlcObject><POU Name=\"P\"><Declaration>&e9;</Declaration></POU></TcPlcObject>",
        "<FBType Name=\"&e9;\" Comment=\"&e9;\"/>",
    ] {
        all(format!("{bomb}{root}").as_bytes(), |name| !["syntax", "docs", "workbook"].contains(&name));
    }
}

/// Names that leave the folder, that a shell or a page would run, or that a page's address would end at.
#[test]
fn hostile_names_stay_names() {
    let names = [
        "..\\..\\up.st",
        "it's \"odd\".st",
        "<script>alert(1)</script>.st",
        "a#b?c%2e%2e%2f.st",
        "%2e%2e/x.st",
        "con.st",
        "javascript:alert(1).st",
        "&lt;b&gt;.st",
        "\u{202e}ts.st",
    ];
    let mut fs = Memory::new();
    for (i, name) in names.iter().enumerate() {
        fs = fs.with(name, format!("// {name}\nFUNCTION_BLOCK FB_{i}\nEND_FUNCTION_BLOCK\nx := ;\n"));
    }
    fs = fs.with(
        "p/a.plcproj",
        "<Project><PropertyGroup><Name>../../&lt;script&gt;</Name></PropertyGroup><ItemGroup><Compile Include=\"..\\..\\..\\etc\\passwd.TcPOU\"/></ItemGroup></Project>",
    );
    let project = pipeline::read(&fs, "../<script>", &settings(""), &|_| {});
    let book = pipeline::book(&project, &settings(""), &pipeline::Stamp::default());
    assert_eq!(project.catalogue.iter().count(), names.len());
    let pages = pipeline::html(&project, &book, &|_| {}).expect("a site");
    for page in &pages {
        let inside = page
            .path
            .split('/')
            .all(|part| !matches!(part, "" | "." | "..") && !part.contains(['\\', '<', '"', ':', '?', '#']));
        assert!(inside, "{}", page.path);
    }
    let faults = crawl::faults(pages.iter().map(|page| (page.path.as_str(), page.bytes.as_slice())));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// 100 MB of source are read in bounded time; more than the limit is a finding. Takes a minute unoptimised.
#[test]
#[ignore = "needs a gigabyte of memory and, unoptimised, a minute"]
fn a_hundred_megabytes() {
    let piece = "// Adds.\nFUNCTION F_Add : INT\nVAR_INPUT a : INT; END_VAR\nF_Add := a + 1;\nEND_FUNCTION\n";
    let one = format!("x := '{}';\n", "a".repeat(100 << 20));
    for text in [piece.repeat((100 << 20) / piece.len()), one, "(".repeat(100 << 20), "\n".repeat(100 << 20)] {
        let start = Instant::now();
        let tree =
            source::read_tree(&Memory::new().with("a.st", text.as_bytes()), &source::Options::default(), &|_| {});
        assert_eq!(tree.units.len(), 1);
        let text = tree.units[0].objects[0].declaration.as_ref().expect("text").text.clone();
        drop(tree);
        let parse = rungbook::syntax::parse(text, rungbook::syntax::Entry::File, &rungbook::syntax::Options::default());
        assert!(parse.errors.len() <= 1000 && start.elapsed().as_secs() < 300, "{:?}", start.elapsed());
        println!("100 MB: {:?}, {} nodes", start.elapsed(), parse.tree.node_count());
    }
    let above = vec![b' '; (128 << 20) + 1];
    let tree = source::read_tree(&Memory::new().with("a.st", above), &source::Options::default(), &|_| {});
    assert_eq!(tree.findings[0].code.name, "file-too-large");
}
