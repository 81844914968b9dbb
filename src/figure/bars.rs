//! A bar that shows a share of a whole, such as the documented part of a library.

use super::{Drawing, Paint, Point, Shape, Style};

/// How wide a bar is.
const WIDTH: f64 = 120.0;
/// How high a bar is.
const HEIGHT: f64 = 8.0;

/// What a bar shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bar {
    /// What is counted, such as `documented`.
    pub what: String,
    /// How many there are of it.
    pub part: usize,
    /// How many there could be.
    pub whole: usize,
}

/// Draws a bar.
#[must_use]
pub fn draw(bar: &Bar) -> Drawing {
    let share = share(bar.part, bar.whole);
    let piece = |width: f64, paint: Paint| Shape::Rect {
        at: Point::new(0.0, 0.0),
        width,
        height: HEIGHT,
        radius: 2.0,
        style: Style::fill(paint),
    };
    let mut shapes = vec![piece(WIDTH, Paint::Fill)];
    if share > 0.0 {
        shapes.push(piece((share * WIDTH).max(2.0), Paint::Accent));
    }
    let alt = format!("{} of {} {}", bar.part, bar.whole, bar.what);
    Drawing { width: WIDTH, height: HEIGHT, alt, shapes }
}

/// The share, 0 to 1; a whole of nothing is complete.
#[expect(clippy::cast_precision_loss, reason = "counts of entities are far below 2^52")]
fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 1.0 } else { part.min(whole) as f64 / whole as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inner_width(part: usize, whole: usize) -> Option<f64> {
        match draw(&Bar { what: "documented".to_owned(), part, whole }).shapes.get(1) {
            Some(Shape::Rect { width, .. }) => Some(*width),
            _ => None,
        }
    }

    #[test]
    fn the_bar_is_as_long_as_the_share() {
        assert_eq!(inner_width(0, 4), None);
        assert_eq!(inner_width(1, 4), Some(30.0));
        assert_eq!(inner_width(9, 4), Some(WIDTH));
        assert_eq!(inner_width(0, 0), Some(WIDTH));
        assert_eq!(inner_width(1, 100_000), Some(2.0));
    }
}
