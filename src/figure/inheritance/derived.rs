//! What derives from the entity, in rows below it.

use super::{Card, Derived, GAP, HEAD, MARGIN, Node, Point, Shape, head, polyline};

/// A row is not wider than this, unless the bases are.
const WIDEST: f64 = 600.0;
/// The boxes that are drawn at most; the rest is counted.
const MOST: usize = 48;
/// The space between the trunk at the left and the boxes.
const TRUNK: f64 = 18.0;
/// The space between two rows.
const BETWEEN: f64 = 24.0;

/// A box with its place in its row.
struct Placed<'a> {
    card: Card<'a>,
    implements: bool,
    x: f64,
}

impl Placed<'_> {
    fn middle(&self) -> f64 {
        self.x + self.card.width() / 2.0
    }
}

/// The rows.
pub(super) struct Grid<'a> {
    rows: Vec<Vec<Placed<'a>>>,
    more: usize,
}

impl<'a> Grid<'a> {
    pub(super) fn new(derived: &'a [Derived], width: f64) -> Self {
        let limit = width.max(WIDEST) - TRUNK;
        let mut out = Self { rows: Vec::new(), more: derived.len().saturating_sub(MOST) };
        let mut x = f64::INFINITY;
        for each in derived.iter().take(MOST) {
            let card = Card::one(&each.node);
            if x + card.width() > limit {
                out.rows.push(Vec::new());
                x = 0.0;
            }
            let next = x + card.width() + GAP;
            if let Some(row) = out.rows.last_mut() {
                row.push(Placed { card, implements: each.implements, x });
            }
            x = next;
        }
        out
    }

    /// The width of the widest row, with the trunk if there is one.
    pub(super) fn width(&self) -> f64 {
        self.rows.iter().map(|row| row_width(row)).fold(0.0, f64::max) + self.trunk()
    }

    fn trunk(&self) -> f64 {
        if self.rows.len() > 1 { TRUNK } else { 0.0 }
    }

    /// Whether every link implements.
    fn dashed(&self) -> bool {
        self.rows.iter().flatten().all(|each| each.implements)
    }

    /// Draws the rows below `foot`, the lower end of the entity's box; returns where they end.
    pub(super) fn draw(&self, shapes: &mut Vec<Shape>, middle: f64, foot: f64) -> f64 {
        if self.rows.is_empty() {
            return foot;
        }
        let left = middle - self.width() / 2.0 + self.trunk();
        let mut bus = foot + HEAD + 10.0;
        let mut bottom = foot;
        shapes.push(polyline(vec![Point::new(middle, foot + HEAD), Point::new(middle, bus)], self.dashed()));
        shapes.push(head(Point::new(middle, foot)));
        let trunk = Point::new(left - self.trunk(), bus);
        for (index, row) in self.rows.iter().enumerate() {
            let from = if self.rows.len() > 1 { trunk.x } else { middle };
            let reach = if index == 0 { middle } else { from };
            bottom = self.draw_row(shapes, row, Point::new(left, bus), (from, reach));
            if index + 1 < self.rows.len() {
                let next = bottom + BETWEEN - 12.0;
                shapes.push(polyline(vec![Point::new(trunk.x, bus), Point::new(trunk.x, next)], self.dashed()));
                bus = next;
            }
        }
        self.draw_more(shapes, Point::new(left, bottom))
    }

    /// Draws a row below its bus, which reaches over these two places; returns where the row ends.
    fn draw_row(&self, shapes: &mut Vec<Shape>, row: &[Placed<'_>], at: Point, reach: (f64, f64)) -> f64 {
        let ends = row.iter().map(|each| at.x + each.middle()).chain([reach.0, reach.1]);
        let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        if high - low > 0.5 {
            shapes.push(polyline(vec![Point::new(low, at.y), Point::new(high, at.y)], self.dashed()));
        }
        let top = at.y + 12.0;
        for each in row {
            let x = at.x + each.middle();
            shapes.push(polyline(vec![Point::new(x, top), Point::new(x, at.y)], each.implements));
            shapes.push(each.card.draw(Point::new(at.x + each.x, top), false));
        }
        top + row.iter().map(|each| each.card.height()).fold(0.0, f64::max)
    }

    /// Says how many are not drawn; returns where that ends.
    fn draw_more(&self, shapes: &mut Vec<Shape>, at: Point) -> f64 {
        if self.more == 0 {
            return at.y;
        }
        let node = Node { name: format!("… {} more", self.more), external: true, ..Node::default() };
        let place = Point::new(at.x.max(MARGIN), at.y + 8.0);
        let card = Card::one(&node);
        shapes.push(card.draw(place, false));
        place.y + card.height()
    }
}

/// The width of a row with its gaps.
fn row_width(row: &[Placed<'_>]) -> f64 {
    row.last().map_or(0.0, |last| last.x + last.card.width())
}
