//! Changes of interfaces, and whether a program that used the old one still compiles and links against the new one.
//!
//! The rules are those of CODESYS: blocks are called by the names of their parameters, functions and methods also by position; an
//! input may be left out of a call where it has an initial value, and always in a call of a block; an in-out never; who implements
//! an interface implements all of it; a value of an enumeration without a number of its own is one more than the one before.

use serde::Serialize;

use super::{by_name, fold, types};
use crate::evidence::snapshot::{Entity, Snapshot, Variable};

/// A change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// The entity.
    pub entity: String,
    /// What changed in it, in a few words.
    pub what: String,
    /// Whether a user may have to change something.
    pub breaking: bool,
    /// Why, or why not.
    pub why: &'static str,
}

/// All changes, by entity.
#[must_use]
pub fn compare(old: &Snapshot, new: &Snapshot) -> Vec<Change> {
    let (before, after) = (by_name(old), by_name(new));
    let mut out = Vec::new();
    for (name, entity) in &before {
        match after.get(name) {
            None if visible(entity) => removed(entity, &after, &mut out),
            Some(now) if visible(entity) => Pair { old: entity, new: now, out: &mut out }.compare(),
            _ => {}
        }
    }
    for (name, entity) in &after {
        let appears = before.get(name).is_none_or(|was| !visible(was));
        if appears && visible(entity) {
            added(entity, &before, &mut out);
        }
    }
    out.sort_by(|a, b| (&a.entity, !a.breaking).cmp(&(&b.entity, !b.breaking)));
    out
}

/// Whether users of the library can name it.
fn visible(entity: &Entity) -> bool {
    matches!(entity.access.as_str(), "public" | "protected")
}

type Names<'a> = std::collections::BTreeMap<String, &'a Entity>;

fn removed(entity: &Entity, after: &Names<'_>, out: &mut Vec<Change>) {
    if !entity.owner.is_empty() && !after.contains_key(&fold(&entity.owner)) {
        return;
    }
    let what = format!("{} removed", entity.kind);
    out.push(Change { entity: entity.name.clone(), what, breaking: true, why: "who used it cannot any more" });
}

fn added(entity: &Entity, before: &Names<'_>, out: &mut Vec<Change>) {
    let owner = before.get(&fold(&entity.owner));
    if !entity.owner.is_empty() && owner.is_none() {
        return;
    }
    let (breaking, why) = match owner {
        Some(owner) if owner.kind == "interface" => (true, "who implements the interface has to implement it"),
        Some(_) if entity.is_abstract => (true, "who extends the block has to implement it"),
        _ => (false, "nothing used it"),
    };
    out.push(Change { entity: entity.name.clone(), what: format!("{} added", entity.kind), breaking, why });
}

/// An entity of both releases.
struct Pair<'a> {
    old: &'a Entity,
    new: &'a Entity,
    out: &'a mut Vec<Change>,
}

impl Pair<'_> {
    fn push(&mut self, what: impl Into<String>, breaking: bool, why: &'static str) {
        self.out.push(Change { entity: self.new.name.clone(), what: what.into(), breaking, why });
    }

    fn compare(&mut self) {
        if self.old.kind != self.new.kind {
            let what = format!("{} became {}", self.old.kind, self.new.kind);
            return self.push(what, true, "it is used in another way");
        }
        self.modifiers();
        self.bases();
        self.result();
        self.variables();
    }

    fn modifiers(&mut self) {
        let rank =
            |access: &str| ["private", "protected", "internal", "public"].iter().position(|word| *word == access);
        let (was, is) = (rank(&self.old.access), rank(&self.new.access));
        if was != is {
            let what = format!("{} became {}", self.old.access, self.new.access);
            let narrower = is < was || self.new.access == "internal";
            let why = if narrower { "not everybody who used it still may" } else { "more may use it" };
            self.push(what, narrower, why);
        }
        match (self.old.is_abstract, self.new.is_abstract) {
            (false, true) => self.push("became abstract", true, "it cannot be instantiated or called any more"),
            (true, false) => self.push("no longer abstract", false, "more can be done with it"),
            _ => {}
        }
        match (self.old.is_final, self.new.is_final) {
            (false, true) => self.push("became final", true, "nothing can extend or override it any more"),
            (true, false) => self.push("no longer final", false, "more can be done with it"),
            _ => {}
        }
    }

    fn bases(&mut self) {
        let (old, new) = (self.old, self.new);
        for (was, is, word) in
            [(&old.extends, &new.extends, "extends"), (&old.implements, &new.implements, "implements")]
        {
            let has = |list: &[String], name: &str| list.iter().any(|other| fold(other) == fold(name));
            for gone in was.iter().filter(|name| !has(is, name)) {
                self.push(format!("no longer {word} `{gone}`"), true, "it cannot stand for one any more");
            }
            for more in is.iter().filter(|name| !has(was, name)) {
                self.push(format!("{word} `{more}`"), false, "it can stand for one more");
            }
        }
    }

    fn result(&mut self) {
        let (old, new) = (self.old, self.new);
        if types::same(&old.type_, &new.type_) {
            return;
        }
        let what = format!("type `{}` became `{}`", old.type_, new.type_);
        match (old.type_.is_empty(), new.type_.is_empty()) {
            (true, _) => self.push(what, false, "a result may be ignored"),
            (_, true) => self.push(what, true, "there is no result any more"),
            _ if matches!(new.kind.as_str(), "function" | "method") && types::converts(&new.type_, &old.type_) => {
                self.push(what, false, "every value of the new type is one of the old");
            }
            _ => self.push(what, true, "it is another type"),
        }
    }

    fn variables(&mut self) {
        let (old, new) = (self.old, self.new);
        let find = |list: &'_ [Variable], name: &str| list.iter().position(|other| fold(&other.name) == fold(name));
        for variable in &old.variables {
            match find(&new.variables, &variable.name) {
                None => {
                    let what = format!("{} `{}` removed", variable.section, variable.name);
                    self.push(what, true, "who named it cannot any more");
                }
                Some(index) => self.variable(variable, &new.variables[index]),
            }
        }
        for (index, variable) in new.variables.iter().enumerate() {
            if find(&old.variables, &variable.name).is_none() {
                self.added(index, variable);
            }
        }
        self.order();
    }

    fn added(&mut self, index: usize, variable: &Variable) {
        let what = format!("{} `{}` added", variable.section, variable.name);
        let called = matches!(self.new.kind.as_str(), "function" | "method");
        let last = self.new.variables[index + 1..].iter().all(|other| other.section != variable.section);
        let (breaking, why) = match variable.section.as_str() {
            "in-out" => (true, "every call has to give it"),
            "input" if self.new.owner_is_interface() => (true, "who implements the interface has to take it"),
            "input" if called && variable.initial.is_empty() => {
                (true, "every call has to give it, for it has no initial value")
            }
            "input" if called && !last => (true, "calls by position shift"),
            "value" if !last && variable.initial.is_empty() => (true, "the numbers of the values behind it move"),
            "field" => (false, "values are laid out anew: stored and transmitted ones are read as before only by name"),
            _ => (false, "nothing used it"),
        };
        self.push(what, breaking, why);
    }

    fn variable(&mut self, was: &Variable, is: &Variable) {
        let name = &is.name;
        if was.section != is.section {
            return self.push(
                format!("`{name}`: {} became {}", was.section, is.section),
                true,
                "it is given in another way",
            );
        }
        if !types::same(&was.type_, &is.type_) {
            let what = format!("{} `{name}`: type `{}` became `{}`", is.section, was.type_, is.type_);
            let (breaking, why) = match is.section.as_str() {
                "input" if types::converts(&was.type_, &is.type_) => {
                    (false, "every value of the old type is one of the new")
                }
                "output" if types::converts(&is.type_, &was.type_) => {
                    (false, "every value of the new type is one of the old")
                }
                _ => (true, "it is another type"),
            };
            self.push(what, breaking, why);
        }
        if was.constant != is.constant {
            let what = format!("`{name}`: {}", if is.constant { "became constant" } else { "no longer constant" });
            let why =
                if is.constant { "it cannot be written any more" } else { "it is no constant expression any more" };
            self.push(what, true, why);
        }
        if was.initial != is.initial {
            self.initial(was, is);
        }
    }

    fn initial(&mut self, was: &Variable, is: &Variable) {
        let show = |text: &str| if text.is_empty() { "none".to_owned() } else { format!("`{text}`") };
        let what =
            format!("{} `{}`: initial value {} became {}", is.section, is.name, show(&was.initial), show(&is.initial));
        let called = matches!(self.new.kind.as_str(), "function" | "method");
        let (breaking, why) = match is.section.as_str() {
            "value" => (true, "the number of the value changes"),
            "input" if called && is.initial.is_empty() => (true, "calls that left it out have to give it"),
            "global" if is.constant => (false, "whoever is compiled anew has the new value"),
            _ => (false, "calls that leave it out behave differently"),
        };
        self.push(what, breaking, why);
    }

    /// Whether variables of both releases stand in another order.
    fn order(&mut self) {
        let (old, new) = (self.old, self.new);
        let mut sections: Vec<&str> = new.variables.iter().map(|variable| variable.section.as_str()).collect();
        sections.sort_unstable();
        sections.dedup();
        for section in sections {
            let names = |list: &[Variable], other: &[Variable]| -> Vec<String> {
                let both =
                    |v: &&Variable| other.iter().any(|o| fold(&o.name) == fold(&v.name) && o.section == v.section);
                list.iter().filter(|v| v.section == section).filter(both).map(|v| fold(&v.name)).collect()
            };
            if names(&old.variables, &new.variables) == names(&new.variables, &old.variables) {
                continue;
            }
            let (breaking, why) = match (section, new.kind.as_str()) {
                ("input" | "in-out" | "output", "function" | "method") => (true, "calls by position get other values"),
                ("value", _) if new.variables.iter().any(|v| v.initial.is_empty()) => {
                    (true, "the numbers of the values move")
                }
                ("field", _) => {
                    (false, "values are laid out anew: stored and transmitted ones are read as before only by name")
                }
                _ => (false, "they are called by name"),
            };
            self.push(format!("{section}: other order"), breaking, why);
        }
    }
}

impl Entity {
    /// Whether it is a member of an interface: its name alone does not tell, its kind and owner do.
    fn owner_is_interface(&self) -> bool {
        self.kind == "method" && !self.owner.is_empty() && self.is_abstract
    }
}
