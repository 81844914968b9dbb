//! Paths below the root of a tree, as text with `/` between their parts.

/// The folder of `path`; empty for a file at the root.
#[must_use]
pub fn folder(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// The last part of `path`.
#[must_use]
pub fn name(path: &str) -> &str {
    path.rsplit_once('/').map_or(path, |(_, name)| name)
}

/// The name of `path` up to its last dot.
#[must_use]
pub fn stem(path: &str) -> &str {
    let name = name(path);
    match name.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => name,
    }
}

/// What follows the last dot of the name, in lower case; empty where there is no dot, or only a leading one.
#[must_use]
pub fn extension(path: &str) -> String {
    match name(path).rsplit_once('.') {
        Some((stem, extension)) if !stem.is_empty() => extension.to_ascii_lowercase(),
        _ => String::new(),
    }
}

/// `name` in `folder`.
#[must_use]
pub fn join(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") }
}

/// Whether `path` lies in `folder` or below it.
#[must_use]
pub fn is_below(path: &str, folder: &str) -> bool {
    folder.is_empty() || path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'))
}

/// `path`, written with `\` or `/` and seen from `folder`, as a path below the root; `None` if it leads out of the tree.
#[must_use]
pub fn resolve(folder: &str, path: &str) -> Option<String> {
    let path = path.replace('\\', "/");
    let absolute = path.starts_with('/') || path.as_bytes().get(1) == Some(&b':');
    if absolute {
        return None;
    }
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_of_a_project_file_is_resolved_from_its_folder() {
        assert_eq!(resolve("a/b", r"POUs\X.TcPOU").as_deref(), Some("a/b/POUs/X.TcPOU"));
        assert_eq!(resolve("a/b", r"..\..\X.TcPOU").as_deref(), Some("X.TcPOU"));
        assert_eq!(resolve("a", r"..\..\X.TcPOU"), None);
        assert_eq!(resolve("a", r"C:\X.TcPOU"), None);
        assert_eq!(resolve("", r".\.\X").as_deref(), Some("X"));
    }

    #[test]
    fn the_parts_of_a_path() {
        assert_eq!((folder("a/b.st"), name("a/b.st"), stem("a/b.c.ST")), ("a", "b.st", "b.c"));
        assert_eq!(
            (extension("a/b.ST").as_str(), extension(".st").as_str(), extension("a.b/c").as_str()),
            ("st", "", "")
        );
        assert!(is_below("a/b", "a") && is_below("a", "") && !is_below("ab/c", "a"));
    }
}
