//! The interface of a block, drawn as IEC 61131-3 draws it (third edition, 6.6.1 and 6.6.3.4).
//!
//! A box carries the type's name at its top and the names of the formal parameters inside; the types
//! stand outside beside the pins. Inputs enter at the left, outputs leave at the right, the result of a
//! function at the right on top. An in-out has a pin on both sides and a line between them; a rising edge
//! is a triangle that points in, a falling one a triangle that points out, a negation a small
//! circle. What has no pins (an interface, a structure, an enumeration) has compartments that list its
//! methods, fields or values; a function block may have both.

mod compartments;
mod pins;

use super::metrics::{cells, clip, width};
use super::{Anchor, Drawing, Paint, Point, Shape, Style, TextStyle};
use pins::Row;

/// What to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// The type's name.
    pub name: String,
    /// What it is, set above the name, such as `function block`.
    pub stereotype: Option<String>,
    /// The inputs, in order.
    pub inputs: Vec<Pin>,
    /// The outputs, in order.
    pub outputs: Vec<Pin>,
    /// The in-outs, in order.
    pub in_outs: Vec<Pin>,
    /// The type of the result, for a function or a method that has one.
    pub returns: Option<String>,
    /// Listed below the pins: methods, properties, fields, values.
    pub compartments: Vec<Compartment>,
}

/// A formal parameter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pin {
    /// Its name.
    pub name: String,
    /// Its type as text.
    pub type_: String,
    /// Whether it reacts to an edge.
    pub edge: Option<Edge>,
    /// Whether it is negated.
    pub negated: bool,
    /// Its initial value; empty if none.
    pub default: String,
    /// Where a click on its name leads.
    pub href: Option<String>,
    /// Where a click on its type leads.
    pub type_href: Option<String>,
}

/// The edge that an input reacts to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// `R_EDGE`.
    Rising,
    /// `F_EDGE`.
    Falling,
}

/// A titled list inside a box.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Compartment {
    /// Its title, such as `methods`; empty for none.
    pub title: String,
    /// What it lists.
    pub entries: Vec<Entry>,
}

/// A line of a compartment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// Who may see it.
    pub access: Access,
    /// Its name, perhaps with parentheses.
    pub name: String,
    /// Its type; empty if it has none.
    pub type_: String,
    /// Its value, for a value of an enumeration; empty if it has none.
    pub value: String,
    /// Whether it is abstract, which is set in italics.
    pub abstract_: bool,
    /// Where a click on it leads.
    pub href: Option<String>,
}

/// Who may see an entry; drawn as in UML.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Access {
    /// Nothing is drawn: a field or a value.
    #[default]
    Plain,
    /// `+`
    Public,
    /// `#`
    Protected,
    /// `~`
    Internal,
    /// `-`
    Private,
}

/// The name of the type.
const NAME: TextStyle = TextStyle::new(13.0, Paint::Ink).bold();
/// What stands above it.
const STEREOTYPE: TextStyle = TextStyle::new(10.0, Paint::Muted);
/// The names of pins and entries.
const TEXT: TextStyle = TextStyle::new(12.0, Paint::Ink);
/// Types.
const TYPE: TextStyle = TextStyle::new(11.0, Paint::Muted);
/// The height of a row.
const ROW: f64 = 20.0;
/// The space between a box and the edge of the drawing.
const MARGIN: f64 = 4.0;
/// The space between the box and the text in it.
const PAD: f64 = 10.0;
/// The length of the line between a pin and its type.
const STUB: f64 = 26.0;
/// The space between that line and the type.
const GAP: f64 = 5.0;
/// The longest name that is drawn whole, in cells.
const NAME_CELLS: usize = 40;
/// The longest type that is drawn whole, in cells.
const TYPE_CELLS: usize = 26;
/// The outline of the box.
const OUTLINE: Style = Style::stroke(Paint::Line, 1.4);
/// Lines to pins.
const WIRE: Style = Style::stroke(Paint::Line, 1.2);

/// Where the parts of a block are.
struct Layout {
    /// The box's left side.
    left: f64,
    /// The box's width.
    width: f64,
    /// The height of what carries the name.
    head: f64,
    /// The height of the part with the pins.
    pins: f64,
}

impl Layout {
    fn right(&self) -> f64 {
        self.left + self.width
    }
}

/// Draws a block.
#[must_use]
pub fn draw(block: &Block) -> Drawing {
    let rows = pins::rows(block);
    let layout = layout(block, &rows);
    let top = MARGIN + layout.head;
    let below = top + layout.pins;
    let height = below + compartments::height(&block.compartments) - MARGIN;
    let at = Point::new(layout.left, MARGIN);
    let body = |height, radius, style| Shape::Rect { at, width: layout.width, height, radius, style };
    let mut shapes =
        vec![body(height, 3.0, Style::fill(Paint::Paper)), body(layout.head, 3.0, Style::fill(Paint::Fill))];
    head(&mut shapes, block, &layout);
    pins::draw(&mut shapes, &rows, &layout, top);
    compartments::draw(&mut shapes, &block.compartments, &layout, below);
    shapes.push(body(height, 3.0, OUTLINE));
    Drawing {
        width: layout.right() + pins::margin(&rows, |row| row.right.as_ref()),
        height: height + 2.0 * MARGIN,
        alt: alt(block),
        shapes,
    }
}

/// Finds the sizes.
fn layout(block: &Block, rows: &[Row<'_>]) -> Layout {
    let name = width(&clip(&block.name, 2 * NAME_CELLS), NAME);
    let stereotype = block.stereotype.as_deref().map_or(0.0, |text| width(&guillemets(text), STEREOTYPE));
    let inside =
        [name + 2.0 * PAD, stereotype + 2.0 * PAD, pins::inner(rows), compartments::inner(&block.compartments)];
    Layout {
        left: pins::margin(rows, |row| row.left.as_ref()),
        width: inside.into_iter().fold(96.0, f64::max).ceil(),
        head: if block.stereotype.is_some() { 40.0 } else { 28.0 },
        pins: pins::height(rows),
    }
}

/// Draws stereotype and name.
fn head(shapes: &mut Vec<Shape>, block: &Block, layout: &Layout) {
    let middle = layout.left + layout.width / 2.0;
    let mut base = MARGIN + 19.0;
    if let Some(stereotype) = &block.stereotype {
        shapes.push(label(Point::new(middle, MARGIN + 15.0), guillemets(stereotype), Anchor::Middle, STEREOTYPE));
        base = MARGIN + 31.0;
    }
    let shown = clip(&block.name, 2 * NAME_CELLS);
    let title = (shown != block.name).then(|| block.name.clone());
    shapes.push(grouped(None, title, vec![label(Point::new(middle, base), shown, Anchor::Middle, NAME)]));
}

/// A stereotype as UML writes it.
fn guillemets(text: &str) -> String {
    format!("«{text}»")
}

/// A text.
fn label(at: Point, text: String, anchor: Anchor, style: TextStyle) -> Shape {
    Shape::Text { at, text, anchor, style }
}

/// A group, or the shape itself where a group would say nothing.
fn grouped(href: Option<String>, title: Option<String>, mut shapes: Vec<Shape>) -> Shape {
    match (href, title, shapes.pop()) {
        (None, None, Some(only)) if shapes.is_empty() => only,
        (href, title, last) => {
            shapes.extend(last);
            Shape::Group { href, title, shapes }
        }
    }
}

/// The block in words.
fn alt(block: &Block) -> String {
    let mut out = match &block.stereotype {
        Some(stereotype) => format!("{stereotype} {}", block.name),
        None => block.name.clone(),
    };
    let mut part = |title: &str, list: Vec<String>| {
        if !list.is_empty() {
            out.push_str(&format!("; {title}: {}", list.join(", ")));
        }
    };
    let pins = |list: &[Pin]| list.iter().map(pins::declaration).collect::<Vec<_>>();
    part("inputs", pins(&block.inputs));
    part("outputs", pins(&block.outputs));
    part("in-outs", pins(&block.in_outs));
    part("result", block.returns.iter().cloned().collect());
    for each in &block.compartments {
        let title = if each.title.is_empty() { "members" } else { &each.title };
        part(title, each.entries.iter().map(|entry| entry.name.clone()).collect());
    }
    out
}

#[cfg(test)]
mod tests;
