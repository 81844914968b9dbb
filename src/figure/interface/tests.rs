//! Tests of the drawn block.

use super::*;

fn pin(name: &str, type_: &str) -> Pin {
    Pin { name: name.to_owned(), type_: type_.to_owned(), ..Pin::default() }
}

/// A block with every kind of pin.
fn cylinder() -> Block {
    let mut start = pin("bStart", "BOOL");
    start.edge = Some(Edge::Rising);
    let mut stop = pin("bStop", "BOOL");
    stop.edge = Some(Edge::Falling);
    let mut enable = pin("bInhibit", "BOOL");
    enable.negated = true;
    let mut timeout = pin("tTimeout", "TIME");
    timeout.default = "T#2s".to_owned();
    let entry = |name: &str, type_: &str, access| Entry {
        access,
        name: name.to_owned(),
        type_: type_.to_owned(),
        ..Entry::default()
    };
    Block {
        name: "FB_Cylinder".to_owned(),
        stereotype: Some("function block".to_owned()),
        inputs: vec![start, stop, enable, timeout],
        outputs: vec![pin("bExtended", "BOOL"), pin("eState", "E_CylinderState")],
        in_outs: vec![pin("stAxis", "ST_Axis")],
        returns: None,
        compartments: vec![Compartment {
            title: "methods".to_owned(),
            entries: vec![entry("Extend()", "BOOL", Access::Public), entry("Check()", "", Access::Protected)],
        }],
    }
}

fn texts(shapes: &[Shape], out: &mut Vec<(String, Point, Anchor, f64)>) {
    for shape in shapes {
        match shape {
            Shape::Text { at, text, anchor, style } => out.push((text.clone(), *at, *anchor, width(text, *style))),
            Shape::Group { shapes, .. } => texts(shapes, out),
            _ => {}
        }
    }
}

/// Horizontal extent of every text.
fn extents(drawing: &Drawing) -> Vec<(String, f64, f64, f64)> {
    let mut list = Vec::new();
    texts(&drawing.shapes, &mut list);
    let extent = |(text, at, anchor, width): (String, Point, Anchor, f64)| {
        let left = match anchor {
            Anchor::Start => at.x,
            Anchor::Middle => at.x - width / 2.0,
            Anchor::End => at.x - width,
        };
        (text, left, left + width, at.y)
    };
    list.into_iter().map(extent).collect()
}

fn assert_no_overlap(drawing: &Drawing) {
    let list = extents(drawing);
    for (text, left, right, y) in &list {
        assert!(*left >= 0.0 && *right <= drawing.width && *y <= drawing.height, "`{text}` leaves the drawing");
    }
    for (index, first) in list.iter().enumerate() {
        for second in &list[index + 1..] {
            let same_line = (first.3 - second.3).abs() < 8.0;
            let apart = first.2 <= second.1 || second.2 <= first.1;
            assert!(!same_line || apart, "`{}` and `{}` overlap", first.0, second.0);
        }
    }
}

#[test]
fn a_block_with_every_kind_of_pin() {
    let drawing = draw(&cylinder());
    assert_no_overlap(&drawing);
    insta::assert_snapshot!(drawing.to_svg().replace("><", ">\n<"));
}

#[test]
fn the_words_name_every_pin() {
    let words = draw(&cylinder()).alt;
    assert_eq!(
        words,
        "function block FB_Cylinder; inputs: bStart : BOOL, bStop : BOOL, bInhibit : BOOL, tTimeout : TIME := T#2s; \
         outputs: bExtended : BOOL, eState : E_CylinderState; in-outs: stAxis : ST_Axis; methods: Extend(), Check()"
    );
}

#[test]
fn sixty_pins_with_long_names_stay_apart_and_inside() {
    let long = |index: usize| {
        let name = format!("{index}_aVeryLongParameterNameThatGoesOnAndOnAndOn");
        pin(&name, "ARRAY [1..100] OF ST_SomethingWithALongName")
    };
    let block = Block {
        name: "FB_Huge".to_owned(),
        inputs: (0..60).map(long).collect(),
        outputs: (60..100).map(long).collect(),
        in_outs: (100..104).map(long).collect(),
        returns: Some("REFERENCE TO INTERFACE_WITH_A_LONG_NAME".to_owned()),
        ..Block::default()
    };
    let drawing = draw(&block);
    assert_no_overlap(&drawing);
    let svg = drawing.to_svg();
    assert!(svg.contains("<title>59_aVeryLongParameterNameThatGoesOnAndOnAndOn : ARRAY [1..100] OF"));
    assert!(svg.contains("…</text>"));
}

#[test]
fn the_result_of_a_function_is_the_first_pin_at_the_right() {
    let block = Block {
        name: "F_Scale".to_owned(),
        inputs: vec![pin("fValue", "LREAL")],
        outputs: vec![pin("bError", "BOOL")],
        returns: Some("DINT".to_owned()),
        ..Block::default()
    };
    let list = extents(&draw(&block));
    let line = |text: &str| list.iter().find(|each| each.0 == text).map(|each| each.3);
    assert_eq!(line("DINT"), line("fValue"));
    assert!(line("bError") > line("DINT"));
}

#[test]
fn a_box_without_pins_has_no_room_for_them() {
    let entry = |name: &str, value: &str| Entry { name: name.to_owned(), value: value.to_owned(), ..Entry::default() };
    let block = Block {
        name: "E_State".to_owned(),
        stereotype: Some("enum".to_owned()),
        compartments: vec![Compartment {
            title: String::new(),
            entries: (0..50).map(|index| entry(&format!("Value{index}"), &index.to_string())).collect(),
        }],
        ..Block::default()
    };
    let drawing = draw(&block);
    assert_no_overlap(&drawing);
    assert!(drawing.width < 200.0);
    assert!(drawing.to_svg().contains("… 10 more"));
}

#[test]
fn names_that_are_markup_stay_text() {
    let block =
        Block { name: "<script>alert(1)</script>".to_owned(), inputs: vec![pin("a&b", "\"\u{1}")], ..Block::default() };
    let svg = draw(&block).to_svg();
    assert!(!svg.contains("<script"));
    roxmltree::Document::parse(&svg).expect("what is written is well formed");
}
