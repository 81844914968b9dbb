//! A crawler over a rendered site: every link must lead to a page and an anchor, every resource to a file of the
//! site, every `id` must be unique on its page.

use std::collections::{BTreeMap, BTreeSet};

/// What is wrong with the site, as lines to read; empty if nothing is. Files come as path and bytes.
pub(crate) fn faults<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> Vec<String> {
    let files: BTreeMap<&str, &[u8]> = files.into_iter().collect();
    let mut faults = Vec::new();
    let mut pages = BTreeMap::new();
    for (path, bytes) in &files {
        if path.ends_with(".html") {
            pages.insert(*path, Page::read(path, &String::from_utf8_lossy(bytes), &mut faults));
        }
    }
    for (path, page) in &pages {
        for (target, resource) in &page.targets {
            check(path, target, *resource, &files, &pages, &mut faults);
        }
    }
    faults
}

/// What a page offers and wants.
struct Page {
    ids: BTreeSet<String>,
    /// Addresses, and whether the page loads them by itself.
    targets: BTreeSet<(String, bool)>,
}

impl Page {
    fn read(path: &str, html: &str, faults: &mut Vec<String>) -> Self {
        let mut page = Self { ids: BTreeSet::new(), targets: BTreeSet::new() };
        for (tag, name, value) in attributes(html) {
            match (tag, name) {
                (_, "id") if !page.ids.insert(value.clone()) => {
                    faults.push(format!("{path}: the id `{value}` occurs twice"));
                }
                ("link" | "use", "href") | (_, "src" | "srcset" | "data" | "poster") => {
                    page.targets.insert((value, true));
                }
                (_, "href" | "action") => {
                    page.targets.insert((value, false));
                }
                (_, name) if name.starts_with("on") => faults.push(format!("{path}: a handler `{name}` in <{tag}>")),
                _ => {}
            }
        }
        page
    }
}

fn check(
    from: &str,
    target: &str,
    resource: bool,
    files: &BTreeMap<&str, &[u8]>,
    pages: &BTreeMap<&str, Page>,
    faults: &mut Vec<String>,
) {
    let lower = target.to_ascii_lowercase();
    if ["https://", "http://", "mailto:"].iter().any(|scheme| lower.starts_with(scheme)) {
        if resource {
            faults.push(format!("{from}: loads `{target}` from elsewhere"));
        }
        return;
    }
    let (path, anchor) = target.split_once('#').map_or((target, None), |(path, anchor)| (path, Some(anchor)));
    if path.split('/').next().is_some_and(|first| first.contains(':')) {
        faults.push(format!("{from}: the scheme of `{target}` is not admitted"));
        return;
    }
    let path = resolve(from, path);
    if !files.contains_key(path.as_str()) {
        faults.push(format!("{from}: `{target}` leads to no file (`{path}`)"));
    } else if let (Some(anchor), Some(page)) = (anchor, pages.get(path.as_str()))
        && !page.ids.contains(anchor)
    {
        faults.push(format!("{from}: `{target}` leads to no anchor"));
    }
}

/// The path that `target` means on the page `from`.
fn resolve(from: &str, target: &str) -> String {
    if target.is_empty() {
        return from.to_owned();
    }
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in target.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Tag, name and value of every attribute of a page.
pub(crate) fn attributes(html: &str) -> Vec<(&str, &str, String)> {
    let mut found = Vec::new();
    let mut rest = html;
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        let name_end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let (tag, mut inside) = rest.split_at(name_end);
        if tag.is_empty() {
            continue;
        }
        loop {
            inside = inside.trim_start();
            let end = inside.find(|c: char| c.is_whitespace() || matches!(c, '=' | '>' | '/')).unwrap_or(inside.len());
            let name = &inside[..end];
            inside = &inside[end..];
            if let Some(value) = inside.strip_prefix("=\"") {
                let close = value.find('"').unwrap_or(value.len());
                found.push((tag, name, unescape(&value[..close])));
                inside = value.get(close + 1..).unwrap_or_default();
            } else if let Some(after) = inside.strip_prefix('/') {
                inside = after;
            } else if name.is_empty() {
                break;
            }
        }
        rest = inside;
    }
    found
}

fn unescape(text: &str) -> String {
    let named = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
    named.replace("&#39;", "'").replace("&#x27;", "'").replace("&#x2F;", "/").replace("&amp;", "&")
}
