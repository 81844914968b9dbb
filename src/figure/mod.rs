//! Drawings as primitives, then SVG.
//!
//! A [`Drawing`] is a list of [`Shape`]s in user units (CSS pixels at the natural size), painted with
//! named [`Paint`]s and not with colours, so that one drawing serves a light page, a dark page and
//! paper. Each figure has a struct of its own that says what to draw ([`interface::Block`],
//! [`inheritance::Hierarchy`], [`bars::Bar`]) and a function that draws it; [`svg`] writes the result.
//! Nothing here reads a library: whoever makes pages fills the structs.

pub mod automaton;
pub mod bars;
pub mod inheritance;
pub mod interface;
mod metrics;
pub mod svg;
pub mod timing;

/// A finished drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Width in user units.
    pub width: f64,
    /// Height in user units.
    pub height: f64,
    /// What it shows, for those who cannot see it.
    pub alt: String,
    /// The shapes, the hindmost first.
    pub shapes: Vec<Shape>,
}

impl Drawing {
    /// Natural width and height in points: a user unit is a CSS pixel, three quarters of a point.
    #[must_use]
    pub fn points(&self) -> (f64, f64) {
        (self.width * 0.75, self.height * 0.75)
    }

    /// The drawing as a complete `<svg>` element, with colours that a page may theme.
    #[must_use]
    pub fn to_svg(&self) -> String {
        svg::write(self)
    }
}

/// A place in a drawing; `y` grows downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// From the left.
    pub x: f64,
    /// From the top.
    pub y: f64,
}

impl Point {
    /// A place.
    #[must_use]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }
}

/// A primitive of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle.
    Rect {
        /// The upper left corner.
        at: Point,
        /// Its width.
        width: f64,
        /// Its height.
        height: f64,
        /// The radius of its corners.
        radius: f64,
        /// Its look.
        style: Style,
    },
    /// A straight line.
    Line {
        /// From here.
        from: Point,
        /// To there.
        to: Point,
        /// Its look.
        style: Style,
    },
    /// Straight lines through these points.
    Polyline {
        /// The points.
        points: Vec<Point>,
        /// Whether it returns to the first.
        closed: bool,
        /// Its look.
        style: Style,
    },
    /// A curve.
    Path {
        /// Its commands.
        commands: Vec<Command>,
        /// Its look.
        style: Style,
    },
    /// A circle.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
        /// Its look.
        style: Style,
    },
    /// A line of text.
    Text {
        /// The point on the base line that `anchor` means.
        at: Point,
        /// The text.
        text: String,
        /// What of the text is at that point.
        anchor: Anchor,
        /// Its look.
        style: TextStyle,
    },
    /// Shapes that belong together.
    Group {
        /// Where a click on them leads.
        href: Option<String>,
        /// What a pointer over them shows.
        title: Option<String>,
        /// The shapes.
        shapes: Vec<Shape>,
    },
}

/// A step of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Begin here.
    Move(Point),
    /// A straight line.
    Line(Point),
    /// A cubic curve: two control points and the end.
    Cubic(Point, Point, Point),
    /// A straight line to the beginning.
    Close,
}

/// What of a text is at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// A role of colour. Each is a CSS custom property with a fallback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// Nothing is painted.
    None,
    /// Text and what matters: `--rb-ink`.
    Ink,
    /// The ground: `--rb-paper`.
    Paper,
    /// Outlines: `--rb-line`.
    Line,
    /// What is pointed at: `--rb-accent`.
    Accent,
    /// What stands back: `--rb-muted`.
    Muted,
    /// The inside of a box: `--rb-fill`.
    Fill,
}

/// The look of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Inside.
    pub fill: Paint,
    /// Outline.
    pub stroke: Paint,
    /// Width of the outline.
    pub width: f64,
    /// Whether the outline is dashed.
    pub dashed: bool,
}

impl Style {
    /// An outline without an inside.
    #[must_use]
    pub const fn stroke(stroke: Paint, width: f64) -> Self {
        Self { fill: Paint::None, stroke, width, dashed: false }
    }

    /// An inside without an outline.
    #[must_use]
    pub const fn fill(fill: Paint) -> Self {
        Self { fill, stroke: Paint::None, width: 0.0, dashed: false }
    }

    /// Both.
    #[must_use]
    pub const fn both(fill: Paint, stroke: Paint, width: f64) -> Self {
        Self { fill, stroke, width, dashed: false }
    }

    /// The same, dashed.
    #[must_use]
    pub const fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }
}

/// The look of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// The size of its font in user units.
    pub size: f64,
    /// Its colour.
    pub paint: Paint,
    /// Whether it is bold.
    pub bold: bool,
    /// Whether it is italic.
    pub italic: bool,
}

impl TextStyle {
    /// Upright and of normal weight.
    #[must_use]
    pub const fn new(size: f64, paint: Paint) -> Self {
        Self { size, paint, bold: false, italic: false }
    }

    /// The same, bold.
    #[must_use]
    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same, italic.
    #[must_use]
    pub const fn italic(self) -> Self {
        Self { italic: true, ..self }
    }
}
