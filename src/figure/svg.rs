//! A drawing as SVG.
//!
//! Colours are `var(--rb-…, #fallback)` in `style` attributes: a page overrides the properties, for
//! example in the dark. Renderers without CSS variables (usvg, and so typst) drop such a declaration and paint
//! black, so [`with_fallbacks`] puts the fallbacks in their place. No `id` is written: many drawings
//! share a page. Numbers have at most two decimals, so the same drawing is always the same text.

use std::fmt::Write as _;

use super::{Anchor, Command, Drawing, Paint, Point, Shape, Style, TextStyle};

/// The fonts of all text in figures.
const FONTS: &str = "ui-monospace,&quot;DejaVu Sans Mono&quot;,monospace";

/// Writes a drawing as a complete `<svg>` element.
#[must_use]
pub fn write(drawing: &Drawing) -> String {
    let (width, height) = (number(drawing.width), number(drawing.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"rb-figure\" role=\"img\" aria-label=\"{}\" \
         width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         style=\"font-family:{FONTS};font-size:12px\">",
        escape(&drawing.alt)
    );
    shapes(&mut out, &drawing.shapes);
    out.push_str("</svg>");
    out
}

/// Puts the fallbacks of CSS variables in their place, for renderers that know no variables.
///
/// Only `style` attributes are touched: a text that reads `var(--x, y)` stays as it is.
#[must_use]
pub fn with_fallbacks(svg: &str) -> String {
    const OPEN: &str = " style=\"";
    let mut out = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some(start) = rest.find(OPEN) {
        let (before, tail) = rest.split_at(start + OPEN.len());
        out.push_str(before);
        let end = tail.find('"').unwrap_or(tail.len());
        let (value, after) = tail.split_at(end);
        fallbacks(&mut out, value);
        rest = after;
    }
    out.push_str(rest);
    out
}

/// Appends the value of a `style` attribute with its variables replaced.
fn fallbacks(out: &mut String, value: &str) {
    let mut rest = value;
    while let Some(start) = rest.find("var(") {
        let inside = &rest[start..];
        let Some((comma, close)) = inside.find(',').zip(inside.find(')')).filter(|(comma, close)| comma < close) else {
            break;
        };
        out.push_str(&rest[..start]);
        out.push_str(inside[comma + 1..close].trim());
        rest = &inside[close + 1..];
    }
    out.push_str(rest);
}

/// Writes shapes one after the other.
fn shapes(out: &mut String, list: &[Shape]) {
    for each in list {
        shape(out, each);
    }
}

/// Writes a shape.
fn shape(out: &mut String, shape: &Shape) {
    match shape {
        Shape::Rect { at, width, height, radius, style } => {
            out.push_str("<rect");
            attributes(out, &[("x", at.x), ("y", at.y), ("width", *width), ("height", *height)]);
            if *radius > 0.0 {
                attributes(out, &[("rx", *radius)]);
            }
            look(out, style);
        }
        Shape::Line { from, to, style } => {
            out.push_str("<line");
            attributes(out, &[("x1", from.x), ("y1", from.y), ("x2", to.x), ("y2", to.y)]);
            look(out, style);
        }
        Shape::Polyline { points, closed, style } => {
            out.push_str(if *closed { "<polygon points=\"" } else { "<polyline points=\"" });
            let list: Vec<String> = points.iter().copied().map(pair).collect();
            out.push_str(&list.join(" "));
            out.push('"');
            look(out, style);
        }
        Shape::Path { commands, style } => {
            out.push_str("<path d=\"");
            commands.iter().for_each(|command| step(out, command));
            out.push('"');
            look(out, style);
        }
        Shape::Circle { center, radius, style } => {
            out.push_str("<circle");
            attributes(out, &[("cx", center.x), ("cy", center.y), ("r", *radius)]);
            look(out, style);
        }
        Shape::Text { at, text, anchor, style } => line_of_text(out, *at, text, *anchor, style),
        Shape::Group { href, title, shapes } => group(out, href.as_deref(), title.as_deref(), shapes),
    }
}

/// Writes a group, as a link if it leads somewhere.
fn group(out: &mut String, href: Option<&str>, title: Option<&str>, list: &[Shape]) {
    let tag = if href.is_some() { "a" } else { "g" };
    let _ = write!(out, "<{tag}");
    if let Some(href) = href {
        let _ = write!(out, " href=\"{}\"", escape(href));
    }
    out.push('>');
    if let Some(title) = title {
        let _ = write!(out, "<title>{}</title>", escape(title));
    }
    shapes(out, list);
    let _ = write!(out, "</{tag}>");
}

/// Writes a line of text.
fn line_of_text(out: &mut String, at: Point, text: &str, anchor: Anchor, style: &TextStyle) {
    out.push_str("<text");
    attributes(out, &[("x", at.x), ("y", at.y)]);
    match anchor {
        Anchor::Start => {}
        Anchor::Middle => out.push_str(" text-anchor=\"middle\""),
        Anchor::End => out.push_str(" text-anchor=\"end\""),
    }
    let _ = write!(out, " style=\"fill:{}", paint(style.paint));
    if (style.size - 12.0).abs() > 1e-9 {
        let _ = write!(out, ";font-size:{}px", number(style.size));
    }
    out.push_str(if style.bold { ";font-weight:bold" } else { "" });
    out.push_str(if style.italic { ";font-style:italic" } else { "" });
    let _ = write!(out, "\">{}</text>", escape(text));
}

/// Writes a step of a path.
fn step(out: &mut String, command: &Command) {
    match command {
        Command::Move(to) => {
            let _ = write!(out, "M{}", pair(*to));
        }
        Command::Line(to) => {
            let _ = write!(out, "L{}", pair(*to));
        }
        Command::Cubic(first, second, to) => {
            let _ = write!(out, "C{} {} {}", pair(*first), pair(*second), pair(*to));
        }
        Command::Close => out.push('Z'),
    }
}

/// Writes numeric attributes.
fn attributes(out: &mut String, list: &[(&str, f64)]) {
    for (name, value) in list {
        let _ = write!(out, " {name}=\"{}\"", number(*value));
    }
}

/// Writes a look and ends the element.
fn look(out: &mut String, style: &Style) {
    let _ = write!(out, " style=\"fill:{}", paint(style.fill));
    if style.stroke != Paint::None {
        let _ = write!(out, ";stroke:{};stroke-width:{}", paint(style.stroke), number(style.width));
        out.push_str(if style.dashed { ";stroke-dasharray:5 3" } else { "" });
    }
    out.push_str("\"/>");
}

/// A colour with its fallback.
fn paint(paint: Paint) -> &'static str {
    match paint {
        Paint::None => "none",
        Paint::Ink => "var(--rb-ink,#1c2733)",
        Paint::Paper => "var(--rb-paper,#ffffff)",
        Paint::Line => "var(--rb-line,#5a6b7b)",
        Paint::Accent => "var(--rb-accent,#0b5cad)",
        Paint::Muted => "var(--rb-muted,#5f6f7e)",
        Paint::Fill => "var(--rb-fill,#f1f5f9)",
    }
}

/// A point as `x,y`.
fn pair(point: Point) -> String {
    format!("{},{}", number(point.x), number(point.y))
}

/// A number with at most two decimals and no trailing zeros.
fn number(value: f64) -> String {
    let value = if value.is_finite() { value } else { 0.0 };
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text for an element or an attribute; characters that XML does not allow become U+FFFD.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\r' | '\t' => out.push(' '),
            '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(shapes: Vec<Shape>) -> Drawing {
        Drawing { width: 10.0, height: 20.5, alt: "a \"b\" <c>".to_owned(), shapes }
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let written: Vec<String> = [1.0, -0.001, 2.346, 100.0, f64::NAN, -3.5].into_iter().map(number).collect();
        assert_eq!(written, ["1", "0", "2.35", "100", "0", "-3.5"]);
    }

    #[test]
    fn every_text_is_escaped() {
        let text = Shape::Text {
            at: Point::new(1.0, 2.0),
            text: "</text><script>&\u{0}".to_owned(),
            anchor: Anchor::End,
            style: TextStyle::new(12.0, Paint::Ink).bold(),
        };
        let href = Some("a\"onload=\"x".to_owned());
        let svg = drawing(vec![Shape::Group { href, title: Some("<t>".to_owned()), shapes: vec![text] }]).to_svg();
        assert!(svg.contains("&lt;/text&gt;&lt;script&gt;&amp;\u{fffd}"));
        assert!(svg.contains("href=\"a&quot;onload=&quot;x\"") && svg.contains("<title>&lt;t&gt;</title>"));
        assert!(svg.contains("aria-label=\"a &quot;b&quot; &lt;c&gt;\""));
        roxmltree::Document::parse(&svg).expect("what is written is well formed");
    }

    #[test]
    fn fallbacks_replace_variables_in_styles_only() {
        let text = Shape::Text {
            at: Point::new(0.0, 0.0),
            text: "style=\"fill:var(--rb-ink,#000)\"".to_owned(),
            anchor: Anchor::Start,
            style: TextStyle::new(9.0, Paint::Accent),
        };
        let rect = Shape::Rect {
            at: Point::new(0.0, 0.0),
            width: 1.0,
            height: 1.0,
            radius: 2.0,
            style: Style::both(Paint::Fill, Paint::Line, 1.0).dashed(),
        };
        let svg = with_fallbacks(&drawing(vec![text, rect]).to_svg());
        assert!(svg.contains("style=\"fill:#f1f5f9;stroke:#5a6b7b;stroke-width:1;stroke-dasharray:5 3\""));
        assert!(svg.contains("fill:#0b5cad;font-size:9px"));
        assert!(svg.contains("fill:var(--rb-ink,#000)"), "the text stays: {svg}");
        assert_eq!(with_fallbacks("<a style=\"x:var(--y\""), "<a style=\"x:var(--y\"");
    }
}
