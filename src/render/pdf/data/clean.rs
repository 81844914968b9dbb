//! Makes values printable: texts, drawings, links, and prose that nests too deeply.

use serde_json::{Map, Value, json};

use super::super::fonts::Printable;
use super::super::plan::soften;
use super::labels::Labels;
use crate::figure::svg;

/// Objects that lie deeper below an entity are flattened: the typesetter bounds its recursion, and a
/// reader has lost the thread long before.
const DEEPEST: usize = 40;
/// Longer words of prose and names may be broken.
const LONG_WORD: usize = 44;
/// Longer words of code may be broken.
const LONG_CODE: usize = 84;
/// Longer addresses are not linked.
const LONG_URL: usize = 2000;

/// Walks values and mends them.
pub(super) struct Cleaner<'a> {
    /// For texts.
    pub(super) printable: Printable<'a>,
    /// For links.
    pub(super) labels: Labels,
}

impl<'a> Cleaner<'a> {
    pub(super) fn new(printable: Printable<'a>, labels: Labels) -> Self {
        Self { printable, labels }
    }

    /// Cleans a value and all below it.
    pub(super) fn clean(&mut self, value: &mut Value) {
        self.walk(value, 0);
    }

    fn walk(&mut self, value: &mut Value, depth: usize) {
        match value {
            Value::String(text) => *text = soften(&self.printable.text(text), LONG_WORD),
            Value::Array(list) => list.iter_mut().for_each(|each| self.walk(each, depth + 1)),
            Value::Object(object) if depth > DEEPEST && object.contains_key("kind") => {
                let text = plain(value);
                *value = json!({ "kind": "text", "text": text });
                self.walk(value, 0);
            }
            Value::Object(object) => self.object(object, depth),
            Value::Null | Value::Bool(_) | Value::Number(_) => {}
        }
    }

    fn object(&mut self, object: &mut Map<String, Value>, depth: usize) {
        let is_prose_text = object.get("kind").and_then(Value::as_str) == Some("text");
        let is_listing = object.contains_key("language") || object.contains_key("first_line");
        for (key, value) in object.iter_mut() {
            match (key.as_str(), value) {
                ("to", value) => *value = self.target(value),
                ("place", value) => *value = value.as_str().map_or(Value::Null, |label| self.place(label)),
                ("label" | "url" | "anchor" | "key" | "kind", Value::String(_)) => {}
                ("svg", Value::String(svg)) => *svg = self.printable.text(&svg::with_fallbacks(svg)),
                ("signature", Value::String(text)) => *text = soften(&self.printable.text(text), LONG_CODE),
                ("text", Value::String(text)) if is_listing => *text = soften(&self.printable.text(text), LONG_CODE),
                ("text", Value::String(text)) if is_prose_text => {
                    *text = soften(&self.printable.text(text).replace(['\n', '\t'], " "), LONG_WORD);
                }
                (_, value) => self.walk(value, depth + 1),
            }
        }
    }

    /// A link as `{label}` or `{url}`; nothing for one that leads nowhere.
    fn target(&mut self, value: &Value) -> Value {
        let text = |key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default();
        match text("kind") {
            "page" => match self.place(text("label")) {
                Value::Null => Value::Null,
                label => json!({ "label": label }),
            },
            "external" if (1..=LONG_URL).contains(&text("url").len()) => json!({ "url": text("url") }),
            _ => Value::Null,
        }
    }

    /// The label that is printed for a label.
    fn place(&mut self, label: &str) -> Value {
        self.labels.resolve(label).map_or(Value::Null, Value::String)
    }
}

/// All text in a value, without recursion: this is for what is deep.
fn plain(value: &Value) -> String {
    let mut out = String::new();
    let mut stack = vec![value];
    while let Some(value) = stack.pop() {
        match value {
            Value::Object(object) => {
                let texts = ["text", "alt"].iter().filter_map(|key| object.get(*key)).filter_map(Value::as_str);
                texts.for_each(|text| {
                    out.push_str(if out.is_empty() { "" } else { " " });
                    out.push_str(text);
                });
                stack.extend(["items", "rows", "head", "content"].iter().filter_map(|key| object.get(*key)));
            }
            Value::Array(list) => stack.extend(list.iter().rev()),
            _ => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::super::fonts::Fonts;
    use super::*;

    fn clean(mut value: Value) -> Value {
        let fonts = Fonts::new(&[]).expect("the embedded fonts are fonts");
        Cleaner::new(Printable::new(&fonts), Labels::default()).clean(&mut value);
        value
    }

    #[test]
    fn links_to_nowhere_are_taken_out() {
        let page = json!({ "kind": "page", "url": "a.html", "label": "nowhere" });
        let broken = json!({ "kind": "broken", "target": "x" });
        let site = json!({ "kind": "external", "url": "https://example.org" });
        let value = clean(json!([{ "to": page }, { "to": broken }, { "to": site }, { "to": null }]));
        assert_eq!(
            value,
            json!([{ "to": null }, { "to": null }, { "to": { "url": "https://example.org" } }, { "to": null }])
        );
    }

    #[test]
    fn line_breaks_stay_in_code_and_go_in_prose() {
        let value = clean(json!([
            { "kind": "text", "text": "a\nb\tc" },
            { "kind": "code", "language": "st", "text": "a\n\tb" },
        ]));
        assert_eq!(value[0]["text"], "a b c");
        assert_eq!(value[1]["text"], "a\n\tb");
    }

    #[test]
    fn deep_prose_is_flattened_and_loses_no_text() {
        let mut value = json!({ "kind": "text", "text": "bottom" });
        for level in 0..300 {
            value = json!({ "kind": "quote", "content": [{ "kind": "text", "text": level.to_string() }, value] });
        }
        let text = clean(value).to_string();
        let depth = text.chars().scan(0_i32, |depth, each| {
            *depth += i32::from(matches!(each, '{' | '[')) - i32::from(matches!(each, '}' | ']'));
            Some(*depth)
        });
        assert!(depth.max() < Some(60));
        assert!(text.contains("bottom") && text.contains("299"));
        let words: Vec<&str> = text.split(|c: char| !c.is_ascii_digit()).collect();
        assert!((0..300).all(|level| words.contains(&level.to_string().as_str())));
    }
}
