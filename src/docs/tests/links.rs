//! What names in prose mean.

use super::sample::Sample;
use crate::docs::{LinkTarget, Options};
use crate::library::{ItemId, ItemKind, Placement};

/// Two blocks, one the base of the other, and a variable whose type is the base.
fn tree(comment: &str) -> (Sample, ItemId, ItemId, ItemId) {
    let mut sample = Sample::new();
    let base = sample.item(ItemKind::FunctionBlock, "FB_Base", None, Vec::new());
    let stop = sample.item(ItemKind::Method, "Stop", Some(base), Vec::new());
    sample.variable(base, "bBusy", "", "");
    let comments = vec![sample.comment(Placement::Above, comment)];
    let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, comments);
    sample.variable(block, "fbInner", "", "");
    let type_ = sample.type_use(base);
    sample.edit(block).variables[0].type_ = Some(type_);
    sample.extends(block, base);
    (sample, base, stop, block)
}

fn links(comment: &str) -> Vec<(LinkTarget, String)> {
    let (sample, ..) = tree(comment);
    let docs = sample.read();
    let doc = docs.items[2].doc.as_ref().unwrap();
    doc.links().into_iter().map(|(target, place)| (target.clone(), sample.at(place).to_owned())).collect()
}

#[test]
fn names_are_found_near_first_and_without_regard_to_case() {
    let found =
        links("(* [fb_base.STOP], [Stop], [`bBusy`], [the base](FB_Base), [fbInner.Stop()], [Basics.FB_Base] *)");
    let targets: Vec<&LinkTarget> = found.iter().map(|(target, _)| target).collect();
    let (stop, busy) = (LinkTarget::Item(ItemId(1)), LinkTarget::Variable(ItemId(0), 0));
    let base = LinkTarget::Item(ItemId(0));
    assert_eq!(targets, [&stop, &stop, &busy, &base, &stop, &base]);
    assert_eq!(found[3].1, "[the base](FB_Base)");
}

#[test]
fn units_and_indices_are_text() {
    let text = "(* Length [mm], [0], [1..5], values[bBusy], time [ms], [a, b], [x]. *)";
    assert_eq!(links(text), []);
}

#[test]
fn what_can_only_be_a_name_is_a_broken_link() {
    let found = links("(* [FB_Missing] and [`Gone`] and [Pump.Gone]\n  and [x](Nowhere) but [word] *)");
    let broken: Vec<&str> = found.iter().map(|(_, text)| text.as_str()).collect();
    assert_eq!(broken, ["[FB_Missing]", "[`Gone`]", "[Pump.Gone]", "[x](Nowhere)"]);
    assert!(found.iter().all(|(target, _)| matches!(target, LinkTarget::Broken { .. })));
}

#[test]
fn only_web_addresses_are_external() {
    let found = links(
        "(* [a](https://example.org) [b](javascript:alert(1)) [c](docs/a.md) [d](README.md) <mailto:a@example.org> *)",
    );
    let urls: Vec<LinkTarget> = found.into_iter().map(|(target, _)| target).collect();
    let external = |url: &str| LinkTarget::External(url.to_owned());
    assert_eq!(urls, [external("https://example.org"), external("mailto:a@example.org")]);
}

#[test]
fn a_see_tag_needs_no_brackets() {
    let found = links("/// Pumps.\n/// @see FB_Base.Stop\n/// @see FB_Gone");
    assert_eq!(found[0], (LinkTarget::Item(ItemId(1)), "FB_Base.Stop".to_owned()));
    assert_eq!(found[1], (LinkTarget::Broken { text: "FB_Gone".to_owned() }, "FB_Gone".to_owned()));
}

#[test]
fn inheritance_in_a_circle_ends() {
    let (mut sample, base, _, block) = tree("(* [FB_Pump.Nothing] *)");
    sample.extends(base, block);
    let docs = sample.read_with(&Options::default());
    assert_eq!(docs.items[2].doc.as_ref().unwrap().broken_links().len(), 1);
}

#[test]
fn a_table_knows_its_file() {
    let text = "(*\n  * A pump.\n  *\n  * @gtt Runs (cycle 10ms)\n  * | in A | out B |\n  * |------|-------|\n  * | 1    | 2     |\n  *)";
    let (sample, ..) = tree(text);
    let docs = sample.read();
    let doc = docs.items[2].doc.as_ref().unwrap();
    let table = &doc.tables[0];
    assert_eq!(table.heading, "Runs (cycle 10ms)");
    assert_eq!(table.text.lines().count(), 4);
    let at = table.text.find("out B").unwrap();
    let span = table.map.span(crate::text::Span::from(at..at + 5));
    assert_eq!(span.of(&sample.text), "out B");
    assert!(sample.at(table.place).starts_with("@gtt Runs"));
    assert!(doc.detail.is_empty());
}
