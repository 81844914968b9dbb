//! Which comment is taken, and why the others are not.

use super::sample::{Sample, show};
use crate::docs::{Convention, Options, Reason, Verdict};
use crate::library::{ItemKind, Placement};

/// The brief of the first variable of a block, whose variables are given as (name, above, behind).
fn briefs(variables: &[(&str, &str, &str)]) -> Vec<String> {
    let mut sample = Sample::new();
    let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, Vec::new());
    for (name, above, behind) in variables {
        sample.variable(block, name, above, behind);
    }
    let docs = sample.read();
    docs.variables[0].iter().map(|entry| entry.doc.as_ref().map_or(String::new(), |doc| doc.brief_text())).collect()
}

fn item(kind: ItemKind, comments: &[(Placement, &str)]) -> String {
    let mut sample = Sample::new();
    let mut all = Vec::new();
    for (placement, source) in comments {
        all.push(sample.comment(*placement, source));
        sample.code("\nVAR_INPUT\n");
    }
    sample.item(kind, "FB_Pump", None, all);
    show(&sample.read().items[0])
}

#[test]
fn the_first_place_in_the_order_wins() {
    let text = item(
        ItemKind::FunctionBlock,
        &[
            (Placement::AfterSections, "(* late *)"),
            (Placement::BelowHeader, "// below"),
            (Placement::Above, "// above"),
        ],
    );
    insta::assert_snapshot!(text, @r"
    brief: above
    = AfterSections Rejected(OtherPlacement(Above))
    = BelowHeader Rejected(OtherPlacement(Above))
    = Above Taken(Markdown)
    ");
}

#[test]
fn a_licence_above_leaves_the_place_to_the_comment_below() {
    let licence = "(* Copyright (c) 2024 A. Author\n   Permission is hereby granted, free of charge, to anybody. *)";
    let text = item(ItemKind::FunctionBlock, &[(Placement::Above, licence), (Placement::BelowHeader, "(* A pump. *)")]);
    insta::assert_snapshot!(text, @r"
    brief: A pump.
    = Above Rejected(Licence)
    = BelowHeader Taken(Markdown)
    ");
}

#[test]
fn a_licence_and_documentation_in_one_run() {
    let run =
        "// Pumps\n// Copyright (C) 2024 A. Author\n\n// This program is free software: you can share it.\n/// A pump.";
    insta::assert_snapshot!(item(ItemKind::FunctionBlock, &[(Placement::Above, run)]), @r"
    brief: A pump.
    = Above Rejected(Licence)
    = Above Rejected(Licence)
    = Above Taken(Markdown)
    ");
}

#[test]
fn the_body_documents_actions_and_only_tells_of_others() {
    let first = [(Placement::FirstInBody, "// starts the pump")];
    insta::assert_snapshot!(item(ItemKind::Action, &first), @r"
    brief: starts the pump
    = FirstInBody Taken(Markdown)
    ");
    insta::assert_snapshot!(item(ItemKind::Method, &first), @r"
    = FirstInBody Rejected(Statement)
    ");
}

#[test]
fn code_and_placeholders_are_no_documentation() {
    let run = "// A pump.\n// bRun := TRUE;\n// bOn := bRun;";
    insta::assert_snapshot!(item(ItemKind::FunctionBlock, &[(Placement::Above, run)]), @r"
    brief: A pump.
    = Above Taken(Markdown)
    = Above Rejected(Code)
    ");
    let todo = "(* TODO: Add your comment here *)";
    insta::assert_snapshot!(item(ItemKind::FunctionBlock, &[(Placement::Above, todo)]), @r"
    = Above Rejected(Placeholder)
    ");
}

#[test]
fn a_mark_goes_before_the_order() {
    let text =
        item(ItemKind::FunctionBlock, &[(Placement::Above, "// plain"), (Placement::AfterSections, "(** marked *)")]);
    insta::assert_snapshot!(text, @r"
    brief: marked
    = Above Rejected(Unmarked)
    = AfterSections Taken(Markdown)
    ");
}

#[test]
fn scattered_blocks_are_one() {
    let text = item(
        ItemKind::FunctionBlock,
        &[(Placement::Above, "//! @summary A pump."), (Placement::AfterSections, "(*! @param bStart edge *)")],
    );
    insta::assert_snapshot!(text, @r"
    brief: A pump.
    param bStart [] None
      p edge
    = Above Taken(Te1030)
    = AfterSections Taken(Te1030)
    ");
}

#[test]
fn variables_above_and_behind() {
    assert_eq!(briefs(&[("a", "// above\n", ""), ("b", "", "// behind")]), ["above", "behind"]);
    // Both: above first, then what stands behind.
    assert_eq!(briefs(&[("a", "// above\n", "// behind"), ("b", "// above\n", "")]), ["above", "above"]);
    // A group's heading, as its neighbours show.
    assert_eq!(briefs(&[("a", "// Group\n", "// one"), ("b", "", "// two"), ("c", "", "// three")])[0], "one");
}

#[test]
fn headings_between_variables_document_nothing() {
    assert_eq!(briefs(&[("a", "// --- Inputs ---\n", ""), ("b", "// Valves\n\n", "")]), ["", ""]);
    assert_eq!(briefs(&[("a", "// Valves\n\n// the first\n", "")]), ["the first"]);
}

#[test]
fn a_tag_of_the_block_documents_its_variable() {
    let mut sample = Sample::new();
    let comments = vec![sample.comment(Placement::Above, "/// A pump.\n/// @param BSTART the edge\n/// @param gone x")];
    let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, comments);
    sample.variable(block, "bStart", "", "");
    let docs = sample.read();
    let doc = docs.variables[0][0].doc.as_ref().unwrap();
    assert_eq!(doc.brief_text(), "the edge");
    let params = &docs.items[0].doc.as_ref().unwrap().tags.params;
    assert_eq!((params[0].target, params[1].target), (Some((block, 0)), None));
    assert_eq!(sample.at(params[1].place), "gone");
}

#[test]
fn documentation_is_inherited() {
    let mut sample = Sample::new();
    let interface = sample.item(ItemKind::Interface, "I_Pump", None, Vec::new());
    let comments = vec![sample.comment(Placement::Above, "// Starts it.")];
    let start = sample.item(ItemKind::Method, "Start", Some(interface), comments);
    sample.variable(start, "nSpeed", "", "// rpm");
    let base = sample.item(ItemKind::FunctionBlock, "FB_Base", None, Vec::new());
    sample.implements(base, interface);
    let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, Vec::new());
    sample.extends(block, base);
    let own = sample.item(ItemKind::Method, "START", Some(block), Vec::new());
    sample.variable(own, "nSpeed", "", "");
    let docs = sample.read();
    let entry = docs.item(own);
    assert_eq!(entry.doc.as_ref().unwrap().brief_text(), "Starts it.");
    assert_eq!(entry.inherited_from, Some(start));
    assert_eq!(docs.variable(own, 0).unwrap().inherited_from, Some(start));
    assert_eq!(docs.item(block).doc, None);
}

#[test]
fn a_copy_takes_the_prose_and_keeps_its_tags() {
    let mut sample = Sample::new();
    let comments = vec![sample.comment(Placement::Above, "/// Starts it.\n/// @return TRUE")];
    let block = sample.item(ItemKind::FunctionBlock, "FB_Pump", None, Vec::new());
    let start = sample.item(ItemKind::Method, "Start", Some(block), comments);
    let other = sample.item(ItemKind::FunctionBlock, "FB_Other", None, Vec::new());
    let copy = vec![sample.comment(Placement::Above, "/// \\copydoc Basics.FB_Pump#Start\n/// @since 1.2")];
    let go = sample.item(ItemKind::Method, "Go", Some(other), copy);
    let docs = sample.read();
    assert_eq!(docs.item(go).inherited_from, Some(start));
    insta::assert_snapshot!(show(docs.item(go)), @r"
    brief: Starts it.
    returns
      p TRUE
    since
      p 1.2
    see
      p [Basics.FB_Pump#Start](item 1)
    = Above Taken(Javadoc)
    ");
}

#[test]
fn lines_below_go_on_with_the_comment_behind() {
    let mut sample = Sample::new();
    let block = sample.item(ItemKind::Struct, "ST_Pump", None, Vec::new());
    sample.variable(block, "nSpeed", "", "// the speed of the pump,");
    let below = sample.comment(Placement::Below, "  // in revolutions a minute\n");
    sample.edit(block).variables[0].comments.push(below);
    let docs = sample.read();
    let doc = docs.variables[0][0].doc.as_ref().unwrap();
    assert_eq!(doc.brief_text(), "the speed of the pump, in revolutions a minute");
    assert_eq!(doc.places.len(), 1);
}

#[test]
fn marked_only_asks_for_marks() {
    let sample = Sample::above("// plain");
    let options = Options { marked_only: true, ..Options::default() };
    let entry = &sample.read_with(&options).items[0];
    assert_eq!(entry.considered[0].verdict, Verdict::Rejected(Reason::NotAsked));
    assert_eq!(Convention::ALL.map(|c| Convention::from_key(c.key())), Convention::ALL.map(Some));
}

#[test]
fn what_stands_above_a_statement_speaks_of_it() {
    let mut sample = Sample::new();
    let first = sample.comment(Placement::BelowHeader, "\n// call all actions\n");
    sample.code("Run();\n");
    sample.item(ItemKind::Program, "MAIN", None, vec![first]);
    let second = sample.comment(Placement::AfterSections, "(* A pump.\n   It pumps. *)\n\n");
    sample.code("Run();\n");
    sample.item(ItemKind::Program, "MAIN", None, vec![second]);
    let docs = sample.read();
    insta::assert_snapshot!(show(&docs.items[0]), @r"
    = BelowHeader Rejected(Statement)
    ");
    insta::assert_snapshot!(show(&docs.items[1]), @r"
    brief: A pump.
      p It pumps.
    = AfterSections Taken(Markdown)
    ");
}

#[test]
fn a_line_above_a_declaration_with_its_own_comment_heads_a_group() {
    let text = item(
        ItemKind::Function,
        &[(Placement::Above, "(*BOOL_TO_ functions*)"), (Placement::Trailing, "(*converts*)")],
    );
    insta::assert_snapshot!(text, @r"
    brief: converts
    = Above Rejected(Heading)
    = Trailing Taken(Markdown)
    ");
}

#[test]
fn a_note_to_oneself_is_no_brief() {
    insta::assert_snapshot!(item(ItemKind::Function, &[(Placement::Above, "// ToDo after the next release")]), @r"
    brief: 
    todo
      p after the next release
    = Above Taken(Markdown)
    ");
}
