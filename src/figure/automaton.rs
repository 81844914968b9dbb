//! The automaton of a test table, drawn from top to bottom as its rows stand.
//!
//! A box is a row. A line at the left leads past what may be left out, a line at the right leads back to what may be repeated, as
//! in a syntax diagram: n rows that may be skipped need n lines, not one for every two of them. The lines consume no cycle; the
//! automaton that is played has their closure.

use super::metrics::{clip, width};
use super::{Anchor, Command, Drawing, Paint, Point, Shape, Style, TextStyle};

/// What is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Automaton {
    /// The table's name.
    pub name: String,
    /// Its rows and blocks, in order.
    pub parts: Vec<Part>,
}

/// A row or a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// A row.
    Row(Step),
    /// A block.
    Block(Step, Vec<Part>),
}

/// What is known of a row or a block.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Step {
    /// The row's name or number; a block needs none.
    pub name: String,
    /// How long, or how often.
    pub duration: String,
    /// What stands beside the duration.
    pub remark: String,
    /// What a pointer over it shows.
    pub title: String,
    /// Whether it may be left out.
    pub skip: bool,
    /// Whether it may be repeated.
    pub again: bool,
    /// Whether it is repeated for ever.
    pub forever: bool,
    /// Whether it is repeated only while the inputs do not fit what follows.
    pub progress: bool,
}

/// The height of a box.
const BOX: f64 = 26.0;
/// The length of an arrow into a box.
const ARROW: f64 = 18.0;
/// What a port takes of the spine.
const PORT: f64 = 9.0;
/// The distance of lines that go past each other.
const LANE: f64 = 12.0;
/// The radius of their corners.
const CORNER: f64 = 5.0;
/// The width of the loop beside a box.
const LOOP: f64 = 16.0;
/// The most characters of a name, and of a remark.
const LIMITS: (usize, usize) = (24, 32);

const NAME: TextStyle = TextStyle::new(12.0, Paint::Ink);
const LABEL: TextStyle = TextStyle::new(12.0, Paint::Ink);
const NOTE: TextStyle = TextStyle::new(11.0, Paint::Muted);

/// Draws an automaton.
#[must_use]
pub fn draw(automaton: &Automaton) -> Drawing {
    let mut sizes = Sizes::default();
    let (left, right) = sizes.measure(&automaton.parts);
    let half = (sizes.name + 20.0).max(44.0) / 2.0;
    let spine = 6.0 + length(left) * LANE + half;
    let labels = spine + half + LOOP + 6.0;
    let mut pen = Pen {
        shapes: Vec::new(),
        spine,
        half,
        labels,
        brackets: labels + sizes.label + 12.0,
        lane: sizes.block + 14.0,
        y: 8.0,
        from: Some(8.0),
    };
    let start = Point::new(spine, 8.0);
    pen.shapes.push(Shape::Circle { center: start, radius: 4.0, style: Style::fill(Paint::Ink) });
    pen.parts(&automaton.parts);
    pen.end();
    let lanes = if right == 0 { 0.0 } else { length(right) * pen.lane + 4.0 };
    Drawing {
        width: pen.brackets + lanes,
        height: pen.y + 6.0,
        alt: format!("Automaton of {}: {} rows", automaton.name, count(&automaton.parts)),
        shapes: pen.shapes,
    }
}

fn count(parts: &[Part]) -> usize {
    parts.iter().map(|part| if let Part::Block(_, inner) = part { count(inner) } else { 1 }).sum()
}

#[expect(clippy::cast_precision_loss, reason = "a table has few lanes")]
const fn length(count: usize) -> f64 {
    count as f64
}

/// How many lanes are needed left of `parts`, and right of them.
fn lanes(parts: &[Part]) -> (usize, usize) {
    let one = |part: &Part| match part {
        Part::Row(step) => (usize::from(step.skip), 0),
        Part::Block(step, inner) => {
            let (left, right) = lanes(inner);
            (left + usize::from(step.skip), right + 1)
        }
    };
    parts.iter().map(one).fold((0, 0), |a, b| (a.0.max(b.0), a.1.max(b.1)))
}

/// The widest of each kind of text.
#[derive(Default)]
struct Sizes {
    name: f64,
    label: f64,
    block: f64,
}

impl Sizes {
    fn measure(&mut self, parts: &[Part]) -> (usize, usize) {
        for part in parts {
            match part {
                Part::Row(step) => {
                    self.name = self.name.max(width(&clip(&step.name, LIMITS.0), NAME.bold()));
                    self.label = self.label.max(beside(step));
                }
                Part::Block(step, inner) => {
                    self.block = self.block.max(width(&step.duration, LABEL));
                    self.measure(inner);
                }
            }
        }
        lanes(parts)
    }
}

/// The width of what stands beside a box.
fn beside(step: &Step) -> f64 {
    let remark = if step.remark.is_empty() { 0.0 } else { 10.0 + width(&clip(&step.remark, LIMITS.1), NOTE) };
    width(&step.duration, LABEL) + remark
}

struct Pen {
    shapes: Vec<Shape>,
    /// Where the spine stands, and half the width of a box.
    spine: f64,
    half: f64,
    /// Where labels begin, and behind them the lines that lead back; each takes a lane.
    labels: f64,
    brackets: f64,
    lane: f64,
    y: f64,
    /// Where the line begins that leads on; none behind what lasts for ever.
    from: Option<f64>,
}

impl Pen {
    fn parts(&mut self, parts: &[Part]) {
        for part in parts {
            let skip = match part {
                Part::Row(step) | Part::Block(step, _) => step.skip && self.from.is_some(),
            };
            let leave = self.y + PORT / 2.0;
            if skip {
                self.y += PORT;
            }
            match part {
                Part::Row(step) => self.row(step),
                Part::Block(step, inner) => self.block(step, inner),
            }
            if skip {
                self.y += PORT;
                let lane = lanes(std::slice::from_ref(part)).0;
                let x = self.spine - self.half - length(lane) * LANE + 4.0;
                let join = self.y;
                self.past(x, leave, join, Style::stroke(Paint::Line, 1.2));
                self.from = self.from.or(Some(join));
                self.y += 2.0;
            }
        }
    }

    fn row(&mut self, step: &Step) {
        let top = self.y + ARROW;
        let live = self.on(top);
        let (paint, ink) = if live { (Paint::Line, Paint::Ink) } else { (Paint::Muted, Paint::Muted) };
        let outline = Style::both(Paint::Fill, paint, 1.3);
        let outline = if live { outline } else { outline.dashed() };
        let (middle, right) = (top + BOX / 2.0, self.spine + self.half);
        let at = Point::new(self.spine - self.half, top);
        let mut shapes = vec![
            Shape::Rect { at, width: 2.0 * self.half, height: BOX, radius: 6.0, style: outline },
            Shape::Text {
                at: Point::new(self.spine, middle + 4.0),
                text: clip(&step.name, LIMITS.0),
                anchor: Anchor::Middle,
                style: TextStyle { paint: ink, ..NAME.bold() },
            },
        ];
        if step.again || step.forever {
            let style = repeated(step);
            let (low, high) = (middle + 6.0, middle - 6.0);
            shapes.push(Shape::Path { commands: rounded(right, right + LOOP - 4.0, low, high), style });
            shapes.push(head(Point::new(right, high), Direction::Left, style.stroke));
        }
        let at = Point::new(self.labels, middle + 4.0);
        shapes.push(Shape::Text {
            at,
            text: step.duration.clone(),
            anchor: Anchor::Start,
            style: TextStyle { paint: ink, ..LABEL },
        });
        if !step.remark.is_empty() {
            let at = Point::new(self.labels + width(&step.duration, LABEL) + 10.0, middle + 4.0);
            let text = clip(&step.remark, LIMITS.1);
            shapes.push(Shape::Text { at, text, anchor: Anchor::Start, style: NOTE });
        }
        let title = Some(step.title.clone()).filter(|title| !title.is_empty());
        self.shapes.push(Shape::Group { href: None, title, shapes });
        self.y = top + BOX;
        self.from = (live && !step.forever).then_some(self.y);
    }

    fn block(&mut self, step: &Step, inner: &[Part]) {
        let enter = self.y + PORT;
        self.y += PORT;
        let lane = lanes(inner).1;
        self.parts(inner);
        self.y += PORT;
        if self.from.is_some() && (step.again || step.forever) {
            let x = self.brackets + length(lane) * self.lane;
            let leave = self.y;
            let style = repeated(step);
            self.shapes.push(Shape::Path { commands: rounded(self.spine, x, leave, enter), style });
            self.shapes.push(head(Point::new(self.spine, enter), Direction::Left, style.stroke));
            self.shapes.push(Shape::Text {
                at: Point::new(x + 6.0, f64::midpoint(enter, leave) + 4.0),
                text: step.duration.clone(),
                anchor: Anchor::Start,
                style: LABEL,
            });
            if step.forever {
                self.line_to(leave);
                self.from = None;
            }
        }
        self.y += 2.0;
    }

    /// A line into what stands at `top`; whether there was one to continue.
    fn on(&mut self, top: f64) -> bool {
        let live = self.from.is_some();
        if live {
            self.line_to(top);
            self.shapes.push(head(Point::new(self.spine, top), Direction::Down, Paint::Line));
        }
        live
    }

    fn line_to(&mut self, to: f64) {
        if let Some(from) = self.from {
            let (from, to) = (Point::new(self.spine, from), Point::new(self.spine, to));
            self.shapes.push(Shape::Line { from, to, style: Style::stroke(Paint::Line, 1.2) });
        }
    }

    /// A line from the spine to the left, down and back to it.
    fn past(&mut self, x: f64, leave: f64, join: f64, style: Style) {
        self.shapes.push(Shape::Path { commands: rounded(self.spine, x, leave, join), style });
        self.shapes.push(head(Point::new(self.spine, join), Direction::Right, style.stroke));
    }

    /// The end, where one can be reached.
    fn end(&mut self) {
        let center = Point::new(self.spine, self.y + ARROW + 8.0);
        if self.on(center.y - 8.0) {
            let ring = Style::both(Paint::Paper, Paint::Line, 1.3);
            self.shapes.push(Shape::Circle { center, radius: 8.0, style: ring });
            self.shapes.push(Shape::Circle { center, radius: 4.5, style: Style::fill(Paint::Ink) });
            let at = Point::new(self.labels, center.y + 4.0);
            self.shapes.push(Shape::Text { at, text: "end".to_owned(), anchor: Anchor::Start, style: NOTE });
            self.y = center.y + 8.0;
        }
    }
}

const fn repeated(step: &Step) -> Style {
    if step.progress { Style::stroke(Paint::Accent, 1.5).dashed() } else { Style::stroke(Paint::Line, 1.2) }
}

/// From (`from`, `start`) sideways to `x`, up or down, and back to (`from`, `end`), with round corners.
fn rounded(from: f64, x: f64, start: f64, end: f64) -> Vec<Command> {
    let radius = CORNER.min((end - start).abs() / 2.0).min((x - from).abs() / 2.0);
    let (side, way) = (radius * (x - from).signum(), radius * (end - start).signum());
    vec![
        Command::Move(Point::new(from, start)),
        Command::Line(Point::new(x - side, start)),
        Command::Cubic(Point::new(x, start), Point::new(x, start), Point::new(x, start + way)),
        Command::Line(Point::new(x, end - way)),
        Command::Cubic(Point::new(x, end), Point::new(x, end), Point::new(x - side, end)),
        Command::Line(Point::new(from, end)),
    ]
}

#[derive(Clone, Copy)]
enum Direction {
    Down,
    Left,
    Right,
}

/// The head of an arrow whose point is at `at`.
fn head(at: Point, direction: Direction, paint: Paint) -> Shape {
    let (long, wide) = (7.0, 3.5);
    let points = match direction {
        Direction::Down => vec![at, Point::new(at.x - wide, at.y - long), Point::new(at.x + wide, at.y - long)],
        Direction::Left => vec![at, Point::new(at.x + long, at.y - wide), Point::new(at.x + long, at.y + wide)],
        Direction::Right => vec![at, Point::new(at.x - long, at.y - wide), Point::new(at.x - long, at.y + wide)],
    };
    Shape::Polyline { points, closed: true, style: Style::fill(paint) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, skip: bool, again: bool) -> Part {
        Part::Row(Step { name: name.to_owned(), duration: "[1, 3]".to_owned(), skip, again, ..Step::default() })
    }

    fn heads(drawing: &Drawing) -> usize {
        fn within(shapes: &[Shape]) -> usize {
            let one = |shape: &Shape| match shape {
                Shape::Group { shapes, .. } => within(shapes),
                Shape::Polyline { closed: true, .. } => 1,
                _ => 0,
            };
            shapes.iter().map(one).sum()
        }
        within(&drawing.shapes)
    }

    #[test]
    fn each_way_has_one_arrow() {
        let parts = vec![row("1", false, false), row("2", true, true), row("3", false, true)];
        let drawing = draw(&Automaton { name: "T".to_owned(), parts });
        // Three into rows, one into the end, one past row 2, two loops.
        assert_eq!(heads(&drawing), 7);
        assert_eq!(drawing.alt, "Automaton of T: 3 rows");
    }

    #[test]
    fn nothing_leads_out_of_what_lasts_for_ever() {
        let forever = Step { name: "2".to_owned(), forever: true, ..Step::default() };
        let parts = vec![row("1", false, false), Part::Row(forever), row("3", false, false)];
        let drawing = draw(&Automaton { name: "T".to_owned(), parts });
        assert_eq!(heads(&drawing), 3, "into rows 1 and 2, and the loop of row 2");
        assert!(!drawing.to_svg().contains(">end<"));
    }

    #[test]
    fn a_block_leads_back_and_everything_stays_inside() {
        let block = Step { duration: "[0, 5]".to_owned(), skip: true, again: true, ..Step::default() };
        let inner = vec![row("1", true, true), Part::Block(block.clone(), vec![row("a longer name", true, false)])];
        let drawing = draw(&Automaton { name: "T".to_owned(), parts: vec![Part::Block(block, inner)] });
        let mut places = Vec::new();
        fn collect(shapes: &[Shape], out: &mut Vec<Point>) {
            for shape in shapes {
                match shape {
                    Shape::Group { shapes, .. } => collect(shapes, out),
                    Shape::Path { commands, .. } => out.extend(commands.iter().filter_map(|command| match command {
                        Command::Move(at) | Command::Line(at) | Command::Cubic(_, _, at) => Some(*at),
                        Command::Close => None,
                    })),
                    Shape::Text { at, .. } => out.push(*at),
                    _ => {}
                }
            }
        }
        collect(&drawing.shapes, &mut places);
        assert!(places.iter().all(|at| at.x > 0.0 && at.x < drawing.width && at.y > 0.0 && at.y < drawing.height));
        assert_eq!(drawing.to_svg().matches(">[0, 5]<").count(), 2);
    }
}
