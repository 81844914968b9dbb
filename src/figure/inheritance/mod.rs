//! A small inheritance drawing: bases above, the entity in the middle, what derives from it below.
//!
//! The bases are layered after Sugiyama, Tagawa and Toda (1981) in the small: links that would close a
//! cycle are left out, a base stands above everything that inherits from it (longest path), a link that
//! skips layers gets a place in each, and the layers are ordered by the mean of their neighbours. All
//! links to one base share a horizontal track. What derives is a plain grid, since its own descendants
//! are not drawn; a trunk at the left connects its rows. The optimisation of coordinates is dropped: the
//! drawings have a dozen boxes.

mod derived;
mod layers;

use super::metrics::{clip, width};
use super::{Anchor, Drawing, Paint, Point, Shape, Style, TextStyle};

/// What to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hierarchy {
    /// The entity first, then its bases and theirs, in any order.
    pub nodes: Vec<Node>,
    /// Who inherits from whom; a link with an index that is not there is left out.
    pub links: Vec<Link>,
    /// What inherits from the entity directly, in order.
    pub derived: Vec<Derived>,
}

/// An entity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// What it is, set above the name, such as `interface`.
    pub stereotype: Option<String>,
    /// Whether it is an interface, which is drawn dashed.
    pub interface: bool,
    /// Whether it is abstract, which is set in italics.
    pub abstract_: bool,
    /// Whether it is not in this tree, which is drawn pale.
    pub external: bool,
    /// Where a click on it leads.
    pub href: Option<String>,
}

/// That one node inherits from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// Who inherits.
    pub from: usize,
    /// From whom.
    pub to: usize,
    /// Whether it implements and does not extend.
    pub implements: bool,
}

/// What inherits from the entity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Derived {
    /// It.
    pub node: Node,
    /// Whether it implements and does not extend.
    pub implements: bool,
}

/// The names.
const NAME: TextStyle = TextStyle::new(12.0, Paint::Ink);
/// What stands above them.
const STEREOTYPE: TextStyle = TextStyle::new(9.5, Paint::Muted);
/// The longest name that is drawn whole, in cells.
const NAME_CELLS: usize = 30;
/// The space between the edge of the drawing and its boxes.
const MARGIN: f64 = 4.0;
/// The space between boxes.
const GAP: f64 = 24.0;
/// The height of a line in a box.
const LINE: f64 = 18.0;
/// The height of an arrow head.
const HEAD: f64 = 10.0;

/// Draws a hierarchy; `None` where there is no inheritance to show.
#[must_use]
pub fn draw(hierarchy: &Hierarchy) -> Option<Drawing> {
    let focus = hierarchy.nodes.first()?;
    let layers = layers::Layers::new(hierarchy);
    if layers.is_single() && hierarchy.derived.is_empty() {
        return None;
    }
    let (left, right) = layers.reach();
    let grid = derived::Grid::new(&hierarchy.derived, left + right);
    let half = grid.width() / 2.0;
    let middle = MARGIN + left.max(half);
    let mut shapes = Vec::new();
    let foot = layers.draw(&mut shapes, middle);
    let bottom = grid.draw(&mut shapes, middle, foot);
    let height = bottom + MARGIN;
    Some(Drawing { width: middle + right.max(half) + MARGIN, height, alt: alt(hierarchy, focus), shapes })
}

/// A box with one or more entities in it.
struct Card<'a> {
    nodes: Vec<&'a Node>,
    stereotype: Option<String>,
}

impl<'a> Card<'a> {
    fn one(node: &'a Node) -> Self {
        Self { nodes: vec![node], stereotype: node.stereotype.clone() }
    }

    fn width(&self) -> f64 {
        let title = self.stereotype.as_deref().map_or(0.0, |text| width(text, STEREOTYPE) + 12.0);
        let widest = self.nodes.iter().map(|node| width(&clip(&node.name, NAME_CELLS), NAME)).fold(title, f64::max);
        (widest + 24.0).max(72.0).ceil()
    }

    #[expect(clippy::cast_precision_loss, reason = "a box has few lines")]
    fn height(&self) -> f64 {
        let title = if self.stereotype.is_some() { 12.0 } else { 0.0 };
        self.nodes.len() as f64 * LINE + title + 10.0
    }

    /// Draws it with its upper left corner at this place.
    fn draw(&self, at: Point, focus: bool) -> Shape {
        let first = self.nodes.first();
        let pale = self.nodes.iter().all(|node| node.external);
        let stroke = if pale { Paint::Muted } else { Paint::Line };
        let mut style = Style::both(Paint::Paper, stroke, 1.2);
        if focus {
            style = Style::both(Paint::Fill, Paint::Accent, 2.0);
        }
        style.dashed = first.is_some_and(|node| node.interface);
        let (width, height) = (self.width(), self.height());
        let mut shapes = vec![Shape::Rect { at, width, height, radius: 3.0, style }];
        let middle = at.x + width / 2.0;
        let mut base = at.y + 18.0;
        if let Some(title) = &self.stereotype {
            let text = format!("«{title}»");
            let at = Point::new(middle, at.y + 14.0);
            shapes.push(Shape::Text { at, text, anchor: Anchor::Middle, style: STEREOTYPE });
            base += 11.0;
        }
        for node in &self.nodes {
            shapes.push(line(node, Point::new(middle, base), focus));
            base += LINE;
        }
        Shape::Group { href: None, title: None, shapes }
    }
}

/// The name of an entity as a line of its box.
fn line(node: &Node, at: Point, focus: bool) -> Shape {
    let paint = if node.external { Paint::Muted } else { Paint::Ink };
    let style = TextStyle { size: NAME.size, paint, bold: focus, italic: node.abstract_ };
    let shown = clip(&node.name, NAME_CELLS);
    let title = (shown != node.name).then(|| node.name.clone());
    let text = Shape::Text { at, text: shown, anchor: Anchor::Middle, style };
    Shape::Group { href: node.href.clone(), title, shapes: vec![text] }
}

/// The line style of a link.
fn wire(implements: bool) -> Style {
    let style = Style::stroke(Paint::Line, 1.2);
    if implements { style.dashed() } else { style }
}

/// The hollow arrow head of UML's generalisation, with its tip at this place.
fn head(tip: Point) -> Shape {
    let points = vec![tip, Point::new(tip.x - 6.0, tip.y + HEAD), Point::new(tip.x + 6.0, tip.y + HEAD)];
    Shape::Polyline { points, closed: true, style: Style::both(Paint::Paper, Paint::Line, 1.2) }
}

/// A line through these places.
fn polyline(points: Vec<Point>, implements: bool) -> Shape {
    Shape::Polyline { points, closed: false, style: wire(implements) }
}

/// The hierarchy in words.
fn alt(hierarchy: &Hierarchy, focus: &Node) -> String {
    let mut out = focus.name.clone();
    let mut part = |verb: &str, names: Vec<&str>| {
        if !names.is_empty() {
            out.push_str(&format!("; {verb} {}", names.join(", ")));
        }
    };
    let bases = |implements: bool| {
        let direct =
            hierarchy.links.iter().filter(|link| link.from == 0 && link.to != 0 && link.implements == implements);
        direct.filter_map(|link| hierarchy.nodes.get(link.to)).map(|node| node.name.as_str()).collect::<Vec<_>>()
    };
    part("extends", bases(false));
    part("implements", bases(true));
    part("base of", hierarchy.derived.iter().map(|each| each.node.name.as_str()).collect());
    out
}

#[cfg(test)]
mod tests;
