//! Rows of pins: the names inside the box, the types outside, and the marks between.

use super::{
    Anchor, Block, Edge, GAP, Layout, MARGIN, NAME_CELLS, PAD, Paint, Pin, Point, ROW, STUB, Shape, Style, TEXT, TYPE,
    TYPE_CELLS, WIRE, cells, clip, grouped, label, width,
};

/// The space between the names of the two sides.
const MIDDLE: f64 = 26.0;
/// The radius of the circle of a negation.
const BUBBLE: f64 = 3.5;

/// A row of the box: what enters at its left and leaves at its right.
pub(super) struct Row<'a> {
    /// At the left.
    pub(super) left: Option<Side<'a>>,
    /// At the right.
    pub(super) right: Option<Side<'a>>,
    /// Whether both are one parameter.
    through: bool,
}

/// One side of a row.
pub(super) struct Side<'a> {
    /// The parameter; `None` for the result of a function, which has no name.
    pin: Option<&'a Pin>,
    /// The type in full.
    type_: &'a str,
    /// The name as drawn.
    shown: String,
    /// The type as drawn.
    shown_type: String,
}

impl<'a> Side<'a> {
    fn of(pin: &'a Pin, limit: usize) -> Self {
        let (shown, shown_type) = (clip(&pin.name, limit), clip(&pin.type_, TYPE_CELLS));
        Self { pin: Some(pin), type_: &pin.type_, shown, shown_type }
    }

    fn result(type_: &'a str) -> Self {
        Self { pin: None, type_, shown: String::new(), shown_type: clip(type_, TYPE_CELLS) }
    }

    /// The width of its name and of the marks before it.
    fn inner(&self) -> f64 {
        let mark = if self.edge().is_some() { 8.0 } else { 0.0 };
        width(&self.shown, TEXT) + mark
    }

    fn edge(&self) -> Option<Edge> {
        self.pin.and_then(|pin| pin.edge)
    }

    fn negated(&self) -> bool {
        self.pin.is_some_and(|pin| pin.negated)
    }
}

/// Pairs inputs with outputs; in-outs follow in rows of their own.
pub(super) fn rows(block: &Block) -> Vec<Row<'_>> {
    let result = block.returns.as_deref().map(Side::result);
    let mut right: Vec<Side<'_>> = result.into_iter().collect();
    right.extend(block.outputs.iter().map(|pin| Side::of(pin, NAME_CELLS)));
    let mut left = block.inputs.iter().map(|pin| Side::of(pin, NAME_CELLS));
    let mut right = right.into_iter();
    let mut rows = Vec::new();
    loop {
        let row = Row { left: left.next(), right: right.next(), through: false };
        if row.left.is_none() && row.right.is_none() {
            break;
        }
        rows.push(row);
    }
    let limit = NAME_CELLS * 2 / 3;
    let both = |pin| Row { left: Some(Side::of(pin, limit)), right: Some(Side::of(pin, limit)), through: true };
    rows.extend(block.in_outs.iter().map(both));
    rows
}

/// The space that a side needs outside the box.
pub(super) fn margin<'r, 'a: 'r>(rows: &'r [Row<'a>], side: impl Fn(&'r Row<'a>) -> Option<&'r Side<'a>>) -> f64 {
    let needed = |side: &Side<'_>| {
        let text = width(&side.shown_type, TYPE);
        MARGIN + STUB + if text > 0.0 { text + GAP } else { 0.0 }
    };
    rows.iter().filter_map(side).map(needed).fold(MARGIN, f64::max).ceil()
}

/// The width that the names need inside the box.
pub(super) fn inner(rows: &[Row<'_>]) -> f64 {
    // Names of different rows may overlap horizontally; only those of one row must not.
    let of = |side: &Option<Side<'_>>| side.as_ref().map_or(0.0, |side| side.inner() + PAD);
    rows.iter().map(|row| of(&row.left) + of(&row.right) + MIDDLE).fold(0.0, f64::max)
}

/// The height of all rows.
#[expect(clippy::cast_precision_loss, reason = "a block has fewer than 2^52 pins")]
pub(super) fn height(rows: &[Row<'_>]) -> f64 {
    if rows.is_empty() { 0.0 } else { rows.len() as f64 * ROW + 8.0 }
}

/// A parameter as it is declared.
pub(super) fn declaration(pin: &Pin) -> String {
    let mut out = pin.name.clone();
    if !pin.type_.is_empty() {
        out.push_str(" : ");
        out.push_str(&pin.type_);
    }
    if !pin.default.is_empty() {
        out.push_str(" := ");
        out.push_str(&pin.default);
    }
    out
}

/// Draws all rows below `top`.
pub(super) fn draw(shapes: &mut Vec<Shape>, rows: &[Row<'_>], layout: &Layout, top: f64) {
    let mut y = top + 4.0 + ROW / 2.0;
    for row in rows {
        if let Some(side) = &row.left {
            draw_side(shapes, side, layout.left, y, -1.0);
        }
        if let Some(side) = &row.right {
            draw_side(shapes, side, layout.right(), y, 1.0);
        }
        if let (true, Some(left), Some(right)) = (row.through, &row.left, &row.right) {
            let from = layout.left + PAD + left.inner() + 5.0;
            through(shapes, from, layout.right() - PAD - right.inner() - 5.0, y);
        }
        y += ROW;
    }
}

/// Draws one side: `out` is -1 at the left and 1 at the right.
fn draw_side(shapes: &mut Vec<Shape>, side: &Side<'_>, edge: f64, y: f64, out: f64) {
    let outward = if out < 0.0 { Anchor::End } else { Anchor::Start };
    let inward = if out < 0.0 { Anchor::Start } else { Anchor::End };
    let end = edge + out * STUB;
    let begin = if side.negated() { edge + out * 2.0 * BUBBLE } else { edge };
    shapes.push(Shape::Line { from: Point::new(begin, y), to: Point::new(end, y), style: WIRE });
    if side.negated() {
        let center = Point::new(edge + out * BUBBLE, y);
        shapes.push(Shape::Circle { center, radius: BUBBLE, style: Style::both(Paint::Paper, Paint::Line, 1.2) });
    }
    let mark = side.edge().map_or(0.0, |kind| triangle(shapes, kind, edge, y, out));
    let text = label(Point::new(end + out * GAP, y + 4.0), side.shown_type.clone(), outward, TYPE);
    let href = side.pin.and_then(|pin| pin.type_href.clone());
    let full = (cells(side.type_) > TYPE_CELLS).then(|| side.type_.to_owned());
    shapes.push(grouped(href, full, vec![text]));
    if let Some(pin) = side.pin {
        let at = Point::new(edge - out * (PAD + mark), y + 4.0);
        shapes.push(grouped(
            pin.href.clone(),
            Some(declaration(pin)),
            vec![label(at, side.shown.clone(), inward, TEXT)],
        ));
    }
}

/// Draws the mark of an edge inside the box; returns the space it takes.
fn triangle(shapes: &mut Vec<Shape>, edge: Edge, x: f64, y: f64, out: f64) -> f64 {
    let (base, apex) = match edge {
        Edge::Rising => (x, x - out * 9.0),
        Edge::Falling => (x - out * 9.0, x),
    };
    let points = vec![Point::new(base, y - 5.0), Point::new(apex, y), Point::new(base, y + 5.0)];
    shapes.push(Shape::Polyline { points, closed: edge == Edge::Falling, style: WIRE });
    8.0
}

/// Draws the line of an in-out, with an arrow at both ends.
fn through(shapes: &mut Vec<Shape>, from: f64, to: f64, y: f64) {
    let style = Style::stroke(Paint::Muted, 1.0);
    shapes.push(Shape::Line { from: Point::new(from, y), to: Point::new(to, y), style });
    for (tip, back) in [(from, 5.0), (to, -5.0)] {
        let points = vec![Point::new(tip + back, y - 3.0), Point::new(tip, y), Point::new(tip + back, y + 3.0)];
        shapes.push(Shape::Polyline { points, closed: true, style: Style::fill(Paint::Muted) });
    }
}
