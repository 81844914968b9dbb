//! Compartments: lists of methods, properties, fields or values below the name of a box.

use super::{
    Access, Anchor, Compartment, Entry, Layout, NAME_CELLS, PAD, Paint, Point, Shape, Style, TEXT, TYPE, TYPE_CELLS,
    TextStyle, cells, clip, grouped, label, width,
};

/// The height of a line.
const LINE: f64 = 18.0;
/// The height of a compartment's title.
const TITLE: f64 = 15.0;
/// The space above and below the lines.
const EDGE: f64 = 5.0;
/// The lines that are drawn at most; the rest is counted.
const MOST: usize = 40;
/// The look of a title.
const CAPTION: TextStyle = TextStyle::new(9.5, Paint::Muted).italic();
/// The space between a name and its type.
const BETWEEN: f64 = 18.0;

/// The height of all compartments.
pub(super) fn height(list: &[Compartment]) -> f64 {
    list.iter().map(height_of).sum()
}

/// The height of a compartment.
#[expect(clippy::cast_precision_loss, reason = "at most MOST lines are drawn")]
fn height_of(compartment: &Compartment) -> f64 {
    let lines = compartment.entries.len().min(MOST) + usize::from(compartment.entries.len() > MOST);
    let title = if compartment.title.is_empty() { 0.0 } else { TITLE };
    lines as f64 * LINE + title + 2.0 * EDGE
}

/// The width that the lines need inside the box.
pub(super) fn inner(list: &[Compartment]) -> f64 {
    let entry = |entry: &Entry| {
        let type_ = width(&tail(entry), TYPE);
        2.0 * PAD + width(&name(entry), TEXT) + if type_ > 0.0 { type_ + BETWEEN } else { 0.0 }
    };
    let compartment = |each: &Compartment| {
        let title = width(&each.title, CAPTION) + 2.0 * PAD;
        each.entries.iter().take(MOST).map(entry).fold(title, f64::max)
    };
    list.iter().map(compartment).fold(0.0, f64::max)
}

/// Draws all compartments below `top`.
pub(super) fn draw(shapes: &mut Vec<Shape>, list: &[Compartment], layout: &Layout, top: f64) {
    let mut y = top;
    for compartment in list {
        let (from, to) = (Point::new(layout.left, y), Point::new(layout.right(), y));
        shapes.push(Shape::Line { from, to, style: Style::stroke(Paint::Line, 1.0) });
        lines(shapes, compartment, layout, y + EDGE);
        y += height_of(compartment);
    }
}

/// Draws the title and the lines of a compartment.
fn lines(shapes: &mut Vec<Shape>, compartment: &Compartment, layout: &Layout, top: f64) {
    let mut y = top;
    let left = layout.left + PAD;
    if !compartment.title.is_empty() {
        shapes.push(label(Point::new(left, y + 10.0), compartment.title.clone(), Anchor::Start, CAPTION));
        y += TITLE;
    }
    for entry in compartment.entries.iter().take(MOST) {
        shapes.push(line(entry, left, layout.right() - PAD, y + 13.0));
        y += LINE;
    }
    let more = compartment.entries.len().saturating_sub(MOST);
    if more > 0 {
        shapes.push(label(Point::new(left, y + 13.0), format!("… {more} more"), Anchor::Start, CAPTION));
    }
}

/// An entry as a line of text.
fn line(entry: &Entry, left: f64, right: f64, base: f64) -> Shape {
    let style = if entry.abstract_ { TEXT.italic() } else { TEXT };
    let mut parts = vec![label(Point::new(left, base), name(entry), Anchor::Start, style)];
    let tail = tail(entry);
    if !tail.is_empty() {
        parts.push(label(Point::new(right, base), tail, Anchor::End, TYPE));
    }
    let long = cells(&entry.name) > NAME_CELLS || cells(&whole_tail(entry)) > TYPE_CELLS;
    let title = long.then(|| format!("{} {}", entry.name, whole_tail(entry)).trim_end().to_owned());
    grouped(entry.href.clone(), title, parts)
}

/// Access and name as drawn.
fn name(entry: &Entry) -> String {
    let mark = match entry.access {
        Access::Plain => "",
        Access::Public => "+ ",
        Access::Protected => "# ",
        Access::Internal => "~ ",
        Access::Private => "- ",
    };
    format!("{mark}{}", clip(&entry.name, NAME_CELLS))
}

/// Type and value as drawn.
fn tail(entry: &Entry) -> String {
    clip(&whole_tail(entry), TYPE_CELLS)
}

/// Type and value in full.
fn whole_tail(entry: &Entry) -> String {
    match (entry.type_.is_empty(), entry.value.is_empty()) {
        (_, true) => entry.type_.clone(),
        (true, false) => format!("= {}", entry.value),
        (false, false) => format!("{} = {}", entry.type_, entry.value),
    }
}
