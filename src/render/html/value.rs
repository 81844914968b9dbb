//! Values for templates: made by hand rather than serialised, so that markup of this room's own making is marked as
//! such and all else is escaped.

use tera::Value;

/// A map from the named fields.
macro_rules! record {
    ($($key:ident : $value:expr),* $(,)?) => {
        tera::Value::from(std::collections::BTreeMap::from([
            $( (stringify!($key), tera::Value::from($value)), )*
        ]))
    };
}
pub(super) use record;

/// Markup.
pub(super) fn markup(html: &str) -> Value {
    Value::safe_string(html)
}

/// An array from what `make` makes of each item.
pub(super) fn list<'a, T: 'a>(items: impl IntoIterator<Item = &'a T>, make: impl FnMut(&'a T) -> Value) -> Value {
    Value::from(items.into_iter().map(make).collect::<Vec<_>>())
}

/// An array of strings.
pub(super) fn strings(items: &[String]) -> Value {
    list(items, |item| Value::from(item.as_str()))
}
