//! Tests of the inheritance drawing.

use super::*;

fn node(name: &str) -> Node {
    Node { name: name.to_owned(), ..Node::default() }
}

fn interface(name: &str) -> Node {
    let stereotype = Some("interface".to_owned());
    Node { name: name.to_owned(), stereotype, interface: true, href: Some(format!("{name}.html")), ..Node::default() }
}

fn extends(from: usize, to: usize) -> Link {
    Link { from, to, implements: false }
}

fn implements(from: usize, to: usize) -> Link {
    Link { from, to, implements: true }
}

fn derived(count: usize) -> Vec<Derived> {
    (0..count).map(|index| Derived { node: node(&format!("FB_Derived{index}")), implements: false }).collect()
}

/// A base with a base, interfaces at two levels, one of which skips a layer.
fn valve() -> Hierarchy {
    Hierarchy {
        nodes: vec![
            node("FB_Valve"),
            node("FB_Actuator"),
            node("FB_Device"),
            interface("I_Valve"),
            interface("I_Device"),
        ],
        links: vec![extends(0, 1), extends(1, 2), implements(0, 3), implements(2, 4), implements(0, 4), extends(3, 4)],
        derived: derived(2),
    }
}

/// The boxes: place and size of every rectangle.
fn boxes(shapes: &[Shape]) -> Vec<(Point, f64, f64)> {
    let mut out = Vec::new();
    for shape in shapes {
        match shape {
            Shape::Rect { at, width, height, .. } => out.push((*at, *width, *height)),
            Shape::Group { shapes, .. } => out.extend(boxes(shapes)),
            _ => {}
        }
    }
    out
}

fn assert_boxes_apart_and_inside(drawing: &Drawing) {
    let list = boxes(&drawing.shapes);
    for (index, (at, width, height)) in list.iter().enumerate() {
        assert!(at.x >= 0.0 && at.y >= 0.0, "{at:?}");
        assert!(
            at.x + width <= drawing.width + 0.01 && at.y + height <= drawing.height + 0.01,
            "{at:?} of {drawing:?}"
        );
        for (other, other_width, other_height) in &list[index + 1..] {
            let apart = at.x + width <= other.x
                || other.x + other_width <= at.x
                || at.y + height <= other.y
                || other.y + other_height <= at.y;
            assert!(apart, "{at:?} and {other:?} overlap");
        }
    }
}

#[test]
fn bases_above_and_derived_below() {
    let drawing = draw(&valve()).expect("there is inheritance");
    assert_boxes_apart_and_inside(&drawing);
    assert_eq!(
        drawing.alt,
        "FB_Valve; extends FB_Actuator; implements I_Valve, I_Device; base of FB_Derived0, FB_Derived1"
    );
    insta::assert_snapshot!(drawing.to_svg().replace("><", ">\n<"));
}

#[test]
fn nothing_to_inherit_is_no_drawing() {
    assert_eq!(draw(&Hierarchy::default()), None);
    assert_eq!(draw(&Hierarchy { nodes: vec![node("FB_Alone")], ..Hierarchy::default() }), None);
}

#[test]
fn a_cycle_and_links_to_nowhere_are_left_out() {
    let nodes = vec![node("FB_A"), node("FB_B"), node("FB_Unreached")];
    let links = vec![extends(0, 1), extends(1, 0), extends(0, 0), extends(0, 9), extends(9, 0)];
    let drawing = draw(&Hierarchy { nodes, links, derived: Vec::new() }).expect("there is inheritance");
    assert_eq!(boxes(&drawing.shapes).len(), 2);
    assert_boxes_apart_and_inside(&drawing);
}

#[test]
fn many_derived_wrap_in_rows_and_the_rest_is_counted() {
    let nodes = vec![node("FB_Base")];
    let drawing = draw(&Hierarchy { nodes, links: Vec::new(), derived: derived(100) }).expect("there is inheritance");
    assert_boxes_apart_and_inside(&drawing);
    assert!(drawing.width < 620.0 && drawing.height > 400.0);
    assert!(drawing.to_svg().contains("… 52 more"));
}

#[test]
fn many_interfaces_share_a_box() {
    let mut nodes = vec![node("FB_Many"), node("FB_Base")];
    nodes.extend((0..12).map(|index| interface(&format!("I_Facet{index}"))));
    let mut links = vec![extends(0, 1)];
    links.extend((2..14).map(|to| implements(0, to)));
    let drawing = draw(&Hierarchy { nodes, links, derived: Vec::new() }).expect("there is inheritance");
    assert_eq!(boxes(&drawing.shapes).len(), 3);
    assert_boxes_apart_and_inside(&drawing);
    assert!(drawing.to_svg().contains("href=\"I_Facet11.html\""));
}
