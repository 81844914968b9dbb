//! Rows, pages, links and the outline.

use super::{fixture, manual, objects_of, options, text_of};
use rungbook::render::pdf::Options;

/// A book whose only content is a table with this many columns and rows.
fn with_table(columns: usize, rows: usize) -> rungbook::book::view::Book {
    let mut entity = fixture::entity(fixture::core("function-block", "Function block", "FB_Tested", "Tested."));
    entity.tables = vec![fixture::big_table("Big", columns, rows)];
    fixture::book(vec![entity])
}

#[test]
fn pages_grow_with_the_rows_and_no_row_is_lost() {
    let (few, many) = (manual(&with_table(4, 20), &options()), manual(&with_table(4, 500), &options()));
    assert!(many.pages >= few.pages + 8, "{} and {} pages", few.pages, many.pages);
    let Some(text) = text_of(&many) else { return };
    let words: std::collections::BTreeSet<&str> = text.split_whitespace().collect();
    for row in 0..500 {
        assert!(words.contains(format!("R{row}").as_str()), "row {row} is lost");
        assert!(words.contains(format!("remark{row}").as_str()), "the remark of row {row} is lost");
    }
    let headers = text.matches("nColumn3").count();
    assert!(headers >= 8, "the header is repeated on each page, not {headers} times");
}

#[test]
fn a_parameter_table_breaks_over_pages_and_loses_nothing() {
    let variable = |index: usize| fixture::variable(&format!("nValue{index}"), "INT", "0", &format!("meaning{index}"));
    let mut core = fixture::core("gvl", "Global variables", "GVL_Many", "Many.");
    core.sections = vec![fixture::section("global", "Globals", (0..400).map(variable).collect())];
    let out = manual(&fixture::book(vec![fixture::entity(core)]), &options());
    let Some(text) = text_of(&out) else { return };
    let words: std::collections::BTreeSet<&str> = text.split_whitespace().collect();
    for index in 0..400 {
        assert!(
            words.contains(format!("nValue{index}").as_str()) && words.contains(format!("meaning{index}").as_str())
        );
    }
}

#[test]
fn every_column_of_a_wide_table_is_there_and_inside_the_page() {
    let out = manual(&with_table(40, 3), &options());
    let Some(text) = text_of(&out) else { return };
    for column in 0..40 {
        assert!(text.contains(&format!("nColumn{column}")), "column {column}");
        assert!(text.contains(&format!("{}", 2 * 3 + column)), "cell of column {column}");
    }
    assert!(text.contains("Part 2 of"));
}

#[test]
fn links_lead_to_places_and_the_outline_names_the_entities() {
    let out = manual(&fixture::pneumatics(), &options());
    let Some(objects) = objects_of(&out) else { return };
    let links = objects.matches("/Subtype /Link").count();
    assert!(links > 30, "{links} links");
    assert!(objects.contains("(https://example.org/valves?a=1#b)"));
    let inner = objects.matches("/Dest ").count() + objects.matches("/S /GoTo").count();
    assert!(inner > 25, "{inner} links inside");
    assert!(objects.contains("/Outlines"));
    for title in ["Contents", "Cylinders", "FB_Cylinder", "Extend", "E_CylinderState", "Coverage", "Findings", "Index"]
    {
        assert!(objects.contains(&format!("/Title ({title})")), "the outline lacks `{title}`");
    }
}

#[test]
fn labels_that_are_missing_or_claimed_twice_do_no_harm() {
    let mut book = fixture::pneumatics();
    let again = book.entities[0].clone();
    book.entities.push(again);
    book.entities[2].core.label.clear();
    book.index[0].label = "nowhere".to_owned();
    book.libraries[0].folders[0].entities[0].link.to = Some(fixture::page("nowhere"));
    manual(&book, &options());
}

#[test]
fn an_entity_of_a_library_that_is_not_there_is_left_out() {
    let mut book = fixture::pneumatics();
    book.entities[0].library = 7;
    manual(&book, &options());
}

#[test]
fn tags_carry_the_words_of_the_drawings() {
    let out = manual(&fixture::pneumatics(), &Options { tagged: true, ..options() });
    let Some(objects) = objects_of(&out) else { return };
    assert!(objects.contains("/StructTreeRoot") && objects.contains("/Alt"));
}

#[test]
fn a_manual_of_many_blocks_settles() {
    let out = manual(&fixture::large(16), &options());
    assert!(out.pages > 50, "{} pages", out.pages);
    let Some(text) = text_of(&out) else { return };
    assert!((0..16).all(|index| text.contains(&format!("FB_Block{index}"))));
    assert_eq!(text.matches("FUNCTION BLOCK").count(), 16);
}

#[test]
#[ignore = "takes a minute and several gigabytes; for a release build"]
fn a_manual_of_very_many_blocks_settles() {
    assert!(manual(&fixture::large(1500), &options()).pages > 5000);
}

#[test]
fn the_run_of_a_violation_and_what_a_proof_covered_are_printed() {
    let mut entity = fixture::entity(fixture::core("function-block", "Function block", "FB_Tested", "Tested."));
    let (violated, vacuous) = (fixture::violated(), fixture::proves_nothing());
    entity.tables = vec![violated, vacuous];
    let out = manual(&fixture::book(vec![entity]), &options());
    let Some(text) = text_of(&out) else { return };
    for expected in [
        "nColumn1 is 7 where 1 is expected",
        "The last 8 cycles of 12",
        "unchanged: nColumn0 = 3",
        "Lines executed in cycle 12",
        "FB_Tested.st:9",
        "nColumn1 := 7;",
        "Proves nothing: no row that a run reaches constrains an output.",
        "rows 1/2",
        "not reached in 9 cycles",
    ] {
        assert!(text.contains(expected), "{expected} is not in:\n{text}");
    }
}
