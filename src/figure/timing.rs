//! A timing diagram: levels as steps, other values as boxes, cycles from left to right. Where nothing is asked of a signal, its lane
//! has a dashed line halfway up.

use super::metrics::cells;
use super::{Anchor, Drawing, Paint, Point, Shape, Style, TextStyle};
use crate::machine::trace::lane::{Axis, Lane, Span};

/// What a timing diagram shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timing {
    /// What has run.
    pub name: String,
    /// The lanes, from top to bottom; a span without a text is free.
    pub lanes: Vec<Lane>,
    /// A cycle that is marked, from 0: where a run is lost.
    pub mark: Option<usize>,
}

/// The width of a column of the axis.
const COLUMN: f64 = 8.0;
/// The height of a lane.
const LANE: f64 = 26.0;
/// How high a level is above the ground of its lane.
const LEVEL: f64 = 16.0;
/// The height of the ruler.
const RULER: f64 = 18.0;
/// The width of a character.
const CHARACTER: f64 = 7.3;
/// The size of values and of the ruler.
const SMALL: f64 = 10.0;
/// The most columns of a stretch without a change, and of a value.
const LIMITS: (usize, usize) = (8, 16);

/// Draws a timing diagram.
#[must_use]
pub fn draw(timing: &Timing) -> Drawing {
    let axis = Axis::new(&timing.lanes, LIMITS.0, LIMITS.1);
    let left = left(timing);
    let x = |cycle: usize| left + length(axis.column(cycle)) * COLUMN;
    let bottom = RULER + length(timing.lanes.len()) * LANE;
    let mut shapes = Vec::new();
    marked(&mut shapes, timing.mark, &x, bottom);
    ruler(&mut shapes, &axis, &x, bottom);
    for (index, lane) in timing.lanes.iter().enumerate() {
        let ground = RULER + length(index + 1) * LANE - 5.0;
        let at = Point::new(left - 8.0, ground - 3.0);
        let style = TextStyle::new(12.0, Paint::Ink);
        shapes.push(Shape::Text { at, text: lane.name.clone(), anchor: Anchor::End, style });
        for spans in lane.spans.chunk_by(|a, b| a.text.is_empty() == b.text.is_empty()) {
            match spans.first() {
                Some(span) if span.text.is_empty() => spans.iter().for_each(|span| shapes.push(free(span, &x, ground))),
                _ if lane.is_level => shapes.push(level(spans, &x, ground)),
                _ => spans.iter().for_each(|span| value(&mut shapes, span, &x, ground)),
            }
        }
    }
    let cycles = axis_end(&timing.lanes);
    let alt = format!("Timing diagram of {}: {} signals over {cycles} cycles", timing.name, timing.lanes.len());
    Drawing { width: x(cycles) + 4.0, height: bottom + 4.0, alt, shapes }
}

/// Where each cycle begins in the drawing, and where the last one ends.
#[must_use]
pub fn edges(timing: &Timing) -> Vec<f64> {
    let axis = Axis::new(&timing.lanes, LIMITS.0, LIMITS.1);
    let left = left(timing);
    (0..=axis_end(&timing.lanes)).map(|cycle| left + length(axis.column(cycle)) * COLUMN).collect()
}

/// The room for the names.
fn left(timing: &Timing) -> f64 {
    let names = timing.lanes.iter().map(|lane| cells(&lane.name)).max().unwrap_or(0);
    length(names) * CHARACTER + 12.0
}

#[expect(clippy::cast_precision_loss, reason = "columns and lanes are far below 2^52")]
const fn length(count: usize) -> f64 {
    count as f64
}

fn axis_end(lanes: &[Lane]) -> usize {
    lanes.iter().filter_map(|lane| lane.spans.last()).map(|span| span.to).max().unwrap_or(0)
}

fn marked(shapes: &mut Vec<Shape>, mark: Option<usize>, x: &dyn Fn(usize) -> f64, bottom: f64) {
    if let Some(cycle) = mark {
        let at = Point::new(x(cycle), RULER);
        let width = (x(cycle + 1) - at.x).max(2.0);
        let style = Style::both(Paint::Fill, Paint::Accent, 1.0);
        shapes.push(Shape::Rect { at, width, height: bottom - RULER, radius: 1.0, style });
    }
}

/// The numbers of the cycles at which something changes, where they have room, with a thin line below.
fn ruler(shapes: &mut Vec<Shape>, axis: &Axis, x: &dyn Fn(usize) -> f64, bottom: f64) {
    let mut free = 0.0;
    for cycle in &axis.changes {
        let at = x(*cycle);
        if at < free {
            continue;
        }
        let text = (cycle + 1).to_string();
        free = at + length(text.len() + 1) * CHARACTER;
        let line = Style::stroke(Paint::Line, 0.5).dashed();
        shapes.push(Shape::Line { from: Point::new(at, RULER - 4.0), to: Point::new(at, bottom), style: line });
        let style = TextStyle::new(SMALL, Paint::Muted);
        shapes.push(Shape::Text { at: Point::new(at, SMALL), text, anchor: Anchor::Start, style });
    }
}

fn level(spans: &[Span], x: &dyn Fn(usize) -> f64, ground: f64) -> Shape {
    let height = |span: &Span| if span.high { ground - LEVEL } else { ground };
    let points = spans.iter().flat_map(|span| {
        let y = height(span);
        [Point::new(x(span.from), y), Point::new(x(span.to), y)]
    });
    Shape::Polyline { points: points.collect(), closed: false, style: Style::stroke(Paint::Ink, 1.5) }
}

fn free(span: &Span, x: &dyn Fn(usize) -> f64, ground: f64) -> Shape {
    let y = ground - LEVEL / 2.0;
    let (from, to) = (Point::new(x(span.from), y), Point::new(x(span.to), y));
    let line = Shape::Line { from, to, style: Style::stroke(Paint::Muted, 1.0).dashed() };
    Shape::Group { href: None, title: Some("anything".to_owned()), shapes: vec![line] }
}

/// A box with its value, which a pointer shows whole where it has no room.
fn value(shapes: &mut Vec<Shape>, span: &Span, x: &dyn Fn(usize) -> f64, ground: f64) {
    let (from, to) = (x(span.from), x(span.to));
    let style = Style::both(Paint::Fill, Paint::Ink, 1.0);
    let at = Point::new(from, ground - LEVEL);
    let mut group = vec![Shape::Rect { at, width: to - from, height: LEVEL, radius: 2.0, style }];
    if length(cells(&span.text)) * CHARACTER * (SMALL / 12.0) + 4.0 <= to - from {
        let style = TextStyle::new(SMALL, Paint::Ink);
        let at = Point::new(f64::midpoint(from, to), ground - 4.0);
        group.push(Shape::Text { at, text: span.text.clone(), anchor: Anchor::Middle, style });
    }
    shapes.push(Shape::Group { href: None, title: Some(span.text.clone()), shapes: group });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::program::Role;

    fn span(from: usize, to: usize, text: &str) -> Span {
        Span { from, to, high: text == "TRUE", text: text.to_owned() }
    }

    fn lane(name: &str, is_level: bool, spans: Vec<Span>) -> Lane {
        Lane { name: name.to_owned(), role: Role::Output, is_level, spans }
    }

    #[test]
    fn levels_are_steps_and_values_are_boxes() {
        let timing = Timing {
            name: "Pump".to_owned(),
            lanes: vec![
                lane("Start", true, vec![span(0, 3, "FALSE"), span(3, 20, "TRUE")]),
                lane("Level", false, vec![span(0, 19, "5"), span(19, 20, "123456")]),
            ],
            mark: Some(19),
        };
        let drawing = draw(&timing);
        let steps = drawing.shapes.iter().find_map(|shape| match shape {
            Shape::Polyline { points, .. } => Some(points.clone()),
            _ => None,
        });
        let steps = steps.expect("a level");
        assert_eq!(steps.len(), 4);
        assert!(steps[2].y < steps[1].y && (steps[2].x - steps[1].x).abs() < 1e-9, "up at cycle 3: {steps:?}");
        let svg = drawing.to_svg();
        assert!(svg.contains(">5</text>") && svg.contains("<title>123456</title>"), "{svg}");
        assert!(!svg.contains(">123456</text>"), "no room for it");
        let free = lane("Stop", true, vec![span(0, 5, ""), span(5, 20, "TRUE")]);
        let with_free = draw(&Timing { lanes: vec![free], ..timing.clone() }).to_svg();
        assert_eq!(with_free.matches("<title>anything</title>").count(), 1, "{with_free}");
        assert_eq!(with_free.matches("<polyline").count(), 1, "{with_free}");
        assert_eq!(drawing.alt, "Timing diagram of Pump: 2 signals over 20 cycles");
    }
}
