//! The signature of an item, written anew: header and interface, aligned, without comments.

use crate::library::{Access, Item, ItemKind, Section, TypeUse, Variable};

/// How many variables a section shows before it is cut.
const SHOWN: usize = 40;

/// The signature as Structured Text.
pub(crate) fn signature(item: &Item, accessors: &[&Item]) -> String {
    match item.kind {
        ItemKind::Struct | ItemKind::Union => structure(item),
        ItemKind::Enum => enumeration(item),
        ItemKind::Alias | ItemKind::Subrange => {
            format!("TYPE {} : {};\nEND_TYPE", item.name, text(item.type_.as_ref()))
        }
        ItemKind::GlobalVariables => sections(item).trim_end().to_owned(),
        ItemKind::Task => format!("TASK {}", item.name),
        ItemKind::Property => property(item, accessors),
        _ => [header(item), sections(item)].concat().trim_end().to_owned(),
    }
}

fn text(type_: Option<&TypeUse>) -> &str {
    type_.map_or("", |t| t.text.as_str())
}

fn keyword(kind: ItemKind) -> &'static str {
    match kind {
        ItemKind::FunctionBlock => "FUNCTION_BLOCK",
        ItemKind::Class => "CLASS",
        ItemKind::Function => "FUNCTION",
        ItemKind::Program => "PROGRAM",
        ItemKind::Interface => "INTERFACE",
        ItemKind::Method => "METHOD",
        ItemKind::Property => "PROPERTY",
        ItemKind::Action => "ACTION",
        ItemKind::Transition => "TRANSITION",
        ItemKind::Getter => "GET",
        ItemKind::Setter => "SET",
        _ => "",
    }
}

fn header(item: &Item) -> String {
    let mut out = keyword(item.kind).to_owned();
    let access = (item.access != Access::Public).then(|| item.access.name().to_uppercase());
    let flags = [(item.is_abstract, "ABSTRACT"), (item.is_final, "FINAL"), (item.is_override, "OVERRIDE")];
    let flags = flags.into_iter().filter(|(is, _)| *is).map(|(_, word)| word.to_owned());
    for word in access.into_iter().chain(flags) {
        out.push(' ');
        out.push_str(&word);
    }
    out.push(' ');
    out.push_str(&item.name);
    for (word, types) in [("EXTENDS", &item.extends), ("IMPLEMENTS", &item.implements)] {
        if !types.is_empty() {
            let names: Vec<&str> = types.iter().map(|t| t.text.as_str()).collect();
            out.push_str(&format!(" {word} {}", names.join(", ")));
        }
    }
    if let Some(type_) = &item.type_ {
        out.push_str(&format!(" : {}", type_.text));
    }
    out.push('\n');
    out
}

fn property(item: &Item, accessors: &[&Item]) -> String {
    let mut out = header(item);
    for accessor in accessors {
        out.push_str(&format!("    {}\n", keyword(accessor.kind)));
    }
    out.trim_end().to_owned()
}

/// The interface sections, in the order of the source; neighbours with the same words are one.
fn sections(item: &Item) -> String {
    let shown: Vec<&Variable> =
        item.variables.iter().filter(|v| v.section.is_interface() && v.section != Section::Field).collect();
    let mut out = String::new();
    for group in shown.chunk_by(|a, b| opening(a) == opening(b)) {
        out.push_str(&opening(group[0]));
        out.push('\n');
        declarations(group, &mut out);
        out.push_str("END_VAR\n");
    }
    out
}

fn opening(variable: &Variable) -> String {
    let mut out = match variable.section {
        Section::Input => "VAR_INPUT",
        Section::Output => "VAR_OUTPUT",
        Section::InOut => "VAR_IN_OUT",
        Section::Global => "VAR_GLOBAL",
        _ => "VAR",
    }
    .to_owned();
    let words = [(variable.constant, " CONSTANT"), (variable.retain, " RETAIN"), (variable.persistent, " PERSISTENT")];
    words.into_iter().filter(|(is, _)| *is).for_each(|(_, word)| out.push_str(word));
    out
}

fn declarations(variables: &[&Variable], out: &mut String) {
    let shown = &variables[..variables.len().min(SHOWN)];
    let width = shown.iter().map(|v| v.name.chars().count()).max().unwrap_or(0).min(32);
    for variable in shown {
        let address = variable.address.as_ref().map_or(String::new(), |a| format!(" AT {a}"));
        let initial = variable.initial.as_ref().map_or(String::new(), |i| format!(" := {}", folded(i)));
        let edge = variable.edge.map_or(String::new(), |e| format!(" {}", e.to_uppercase()));
        let type_ = text(variable.type_.as_ref());
        out.push_str(&format!("    {:width$}{address} : {type_}{edge}{initial};\n", variable.name));
    }
    if variables.len() > SHOWN {
        out.push_str(&format!("    // … and {} more\n", variables.len() - SHOWN));
    }
}

/// On one line, and not too long.
fn folded(text: &str) -> String {
    let line: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() <= 60 {
        return line;
    }
    let cut: String = line.chars().take(57).collect();
    format!("{cut}…")
}

fn structure(item: &Item) -> String {
    let word = if item.kind == ItemKind::Union { "UNION" } else { "STRUCT" };
    let extends = item.extends.first().map_or(String::new(), |base| format!(" EXTENDS {}", base.text));
    let mut out = format!("TYPE {}{extends} :\n{word}\n", item.name);
    let fields: Vec<&Variable> = item.variables.iter().collect();
    declarations(&fields, &mut out);
    out.push_str(&format!("END_{word}\nEND_TYPE"));
    out
}

fn enumeration(item: &Item) -> String {
    let mut out = format!("TYPE {} :\n(\n", item.name);
    let shown = item.variables.len().min(SHOWN);
    for (i, value) in item.variables.iter().take(shown).enumerate() {
        let initial = value.initial.as_ref().map_or(String::new(), |v| format!(" := {}", folded(v)));
        let comma = if i + 1 < item.variables.len() { "," } else { "" };
        out.push_str(&format!("    {}{initial}{comma}\n", value.name));
    }
    if item.variables.len() > shown {
        out.push_str(&format!("    // … and {} more\n", item.variables.len() - shown));
    }
    out.push(')');
    if let Some(base) = &item.type_ {
        out.push_str(&format!(" {}", base.text));
    }
    out.push_str(";\nEND_TYPE");
    out
}
