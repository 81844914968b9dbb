//! Eclipse 4diac (IEC 61499): block types, adapters, subapplications, functions, data types, global constants.
//!
//! Interfaces are XML. They are written as Structured Text, names and types byte for byte from their attributes. Events have no
//! counterpart in IEC 61131-3; they are properties of the object and a list in its documentation. Algorithms
//! are actions; a control chart or a network is kept as it stands.

use super::keyword::{skip_trivia, word_at};
use super::{Claim, Format, Input, Unwrapped, note_if_empty, xml_notes};
use crate::source::fragment::FragmentBuilder;
use crate::source::xml::{Element, Xml};
use crate::text::{Body, Fragment, Language, Object, ObjectKind, Span, Vendor};

/// 4diac types.
#[derive(Debug)]
pub(super) struct FourDiac;

impl Format for FourDiac {
    fn name(&self) -> &'static str {
        "4diac"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["fbt", "adp", "sub", "dtp", "gcf", "fct"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        const ROOTS: [&str; 6] =
            ["<FBType", "<AdapterType", "<SubAppType", "<FunctionFBType", "<DataType", "<GlobalConstants"];
        if ROOTS.iter().any(|root| input.text.contains(root)) { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let xml = Xml::parse(input.text, &["ST", "OriginalSource"]);
        let objects: Vec<Object> = xml.roots().filter_map(top).collect();
        let mut notes = xml_notes(&xml);
        notes.extend(note_if_empty(&objects, "4diac type"));
        Unwrapped { objects, vendor: Vendor::FourDiac, notes, ..Unwrapped::default() }
    }
}

fn top(root: Element<'_>) -> Option<Object> {
    let (kind, keyword) = match root.name() {
        "FBType" | "SubAppType" | "AdapterType" => (ObjectKind::Pou, "FUNCTION_BLOCK "),
        "FunctionFBType" => (ObjectKind::Pou, "FUNCTION "),
        "DataType" => (ObjectKind::DataType, "TYPE "),
        "GlobalConstants" => (ObjectKind::GlobalVariables, ""),
        _ => return None,
    };
    let mut object = named(kind, root);
    object.properties.push(("type".to_owned(), root.name().to_owned()));
    versions(root, &mut object);
    let source = root.descendants().find(|element| element.name() == "OriginalSource");
    let mut writer = Writer { out: FragmentBuilder::new() };
    match kind {
        ObjectKind::DataType => writer.data_type(root),
        ObjectKind::GlobalVariables => {
            writer.section("VAR_GLOBAL CONSTANT", root.child("GlobalConstants").unwrap_or(root))
        }
        _ => writer.interface(keyword, root),
    }
    let written = writer.out.finish(root.span().start);
    object.declaration = Some(source.filter(|_| kind == ObjectKind::GlobalVariables).map_or(written, Element::text));
    object.documentation = documentation(root, &mut object);
    object.body = body(root);
    object.children = algorithms(root);
    Some(object)
}

fn named(kind: ObjectKind, element: Element<'_>) -> Object {
    let name = element.attribute("Name");
    let span = name.as_ref().map_or(element.name_span(), |name| name.span);
    Object::new(kind, name.map(|name| name.value.into_owned()), span)
}

/// The newest version, as properties.
fn versions(root: Element<'_>, object: &mut Object) {
    if let Some(latest) = root.children_named("VersionInfo").last() {
        for (attribute, key) in
            [("Version", "version"), ("Author", "author"), ("Date", "date"), ("Organization", "company")]
        {
            if let Some(value) = latest.value(attribute).filter(|value| !value.is_empty()) {
                object.properties.push((key.to_owned(), value));
            }
        }
    }
    if let Some(package) =
        root.child("CompilerInfo").and_then(|info| info.value("packageName")).filter(|name| !name.is_empty())
    {
        object.folder = package.split("::").map(str::to_owned).collect();
    }
}

fn interface(root: Element<'_>) -> Option<Element<'_>> {
    root.child("InterfaceList").or_else(|| root.child("SubAppInterfaceList"))
}

/// The comment, the description, and the events with what they carry; the events become properties too.
fn documentation(root: Element<'_>, object: &mut Object) -> Option<Fragment> {
    let mut out = FragmentBuilder::new();
    let described = root.child("Identification").map(|about| (about, "Description"));
    for (element, attribute) in [Some((root, "Comment")), described].into_iter().flatten() {
        if let Some(text) = element.attribute_fragment(attribute).filter(|text| !text.text.trim().is_empty()) {
            if !out.is_empty() {
                out.standing_for("\n\n", element.name_span());
            }
            out.fragment(&text);
        }
    }
    for list in interface(root).into_iter().flat_map(Element::children) {
        let (title, key) = match list.name() {
            "EventInputs" | "SubAppEventInputs" => ("Event inputs:", "event_input"),
            "EventOutputs" | "SubAppEventOutputs" => ("Event outputs:", "event_output"),
            _ => continue,
        };
        let events = list.children().filter(|event| matches!(event.name(), "Event" | "SubAppEvent"));
        for (index, event) in events.enumerate() {
            if index == 0 {
                let lead = if out.is_empty() { "" } else { "\n\n" };
                out.standing_for(&format!("{lead}{title}\n"), list.name_span());
            }
            one_event(event, &mut out);
            object.properties.push((key.to_owned(), event_property(event)));
        }
    }
    let fragment = out.finish(root.span().start);
    (!fragment.text.is_empty()).then_some(fragment)
}

fn one_event(event: Element<'_>, out: &mut FragmentBuilder) {
    let span = event.name_span();
    let attribute = |element: Element<'_>, name: &str, out: &mut FragmentBuilder| {
        if let Some(value) = element.attribute_fragment(name) {
            out.fragment(&value);
        }
    };
    out.standing_for("\n- `", span);
    attribute(event, "Name", out);
    out.standing_for("`", span);
    for (index, with) in event.children_named("With").enumerate() {
        out.standing_for(if index == 0 { " with `" } else { ", `" }, with.name_span());
        attribute(with, "Var", out);
        out.standing_for("`", with.name_span());
    }
    if event.value("Comment").is_some_and(|comment| !comment.is_empty()) {
        out.standing_for(": ", span);
        attribute(event, "Comment", out);
    }
}

/// `NAME` or `NAME WITH A, B`.
fn event_property(event: Element<'_>) -> String {
    let name = event.value("Name").unwrap_or_default();
    let with: Vec<String> = event.children_named("With").filter_map(|with| with.value("Var")).collect();
    if with.is_empty() { name } else { format!("{name} WITH {}", with.join(", ")) }
}

fn body(root: Element<'_>) -> Body {
    let basic = root.child("BasicFB").and_then(|basic| basic.child("ECC"));
    let network = root.child("FBNetwork").or_else(|| root.child("SubAppNetwork"));
    match basic.or(network) {
        Some(chart) => Body::Other(Language::Ecc, chart.raw()),
        None => Body::None,
    }
}

/// The algorithms and methods of a basic or simple block, and the body of a function.
fn algorithms(root: Element<'_>) -> Vec<Object> {
    let holders = root.children().filter(|child| matches!(child.name(), "BasicFB" | "SimpleFB"));
    let algorithms = holders.flat_map(|holder| holder.children());
    let kind = |element: Element<'_>| match element.name() {
        "Algorithm" => Some(ObjectKind::Action),
        "Method" => Some(ObjectKind::Method),
        _ => None,
    };
    algorithms
        .filter_map(|element| Some((kind(element)?, element)))
        .map(|(kind, element)| algorithm(kind, element))
        .collect()
}

fn algorithm(kind: ObjectKind, element: Element<'_>) -> Object {
    let mut object = named(kind, element);
    object.documentation = element.attribute_fragment("Comment").filter(|text| !text.text.trim().is_empty());
    if kind == ObjectKind::Method {
        let mut writer = Writer { out: FragmentBuilder::new() };
        writer.interface("METHOD ", element);
        object.declaration = Some(writer.out.finish(element.span().start));
    }
    object.body = match element.children().find(|child| matches!(child.name(), "ST" | "Other" | "FBD" | "LD")) {
        Some(st) if st.name() == "ST" && is_declared(&source(st)) => {
            object.declaration = Some(source(st));
            Body::None
        }
        Some(st) if st.name() == "ST" => Body::St(source(st)),
        Some(other) => Body::Other(Language::Unknown, other.raw()),
        None => Body::None,
    };
    object
}

/// Whether the text is `ALGORITHM … END_ALGORITHM` or `METHOD … END_METHOD`, as 4diac writes it since version 2.
fn is_declared(text: &Fragment) -> bool {
    let word = word_at(&text.text, skip_trivia(&text.text, 0));
    word.eq_ignore_ascii_case("ALGORITHM") || word.eq_ignore_ascii_case("METHOD")
}

/// Old files keep the text in an attribute.
fn source(st: Element<'_>) -> Fragment {
    st.attribute_fragment("Text").unwrap_or_else(|| st.text())
}

struct Writer {
    out: FragmentBuilder,
}

impl Writer {
    fn word(&mut self, text: &str, span: Span) {
        self.out.standing_for(text, span);
    }

    fn attribute(&mut self, element: Element<'_>, name: &str) -> bool {
        match element.attribute_fragment(name) {
            Some(value) if !value.text.is_empty() => {
                self.out.fragment(&value);
                true
            }
            _ => false,
        }
    }

    fn interface(&mut self, keyword: &str, root: Element<'_>) {
        self.word(keyword, root.name_span());
        self.attribute(root, "Name");
        self.word("\n", root.name_span());
        for list in interface(root).into_iter().flat_map(Element::children) {
            match list.name() {
                "InputVars" => self.section("VAR_INPUT", list),
                "OutputVars" => self.section("VAR_OUTPUT", list),
                "InOutVars" => self.section("VAR_IN_OUT", list),
                _ => {}
            }
        }
        let basic = root.children().filter(|child| matches!(child.name(), "BasicFB" | "SimpleFB"));
        for list in basic.flat_map(Element::children) {
            match list.name() {
                "InternalVars" => self.section("VAR", list),
                "InternalConstVars" => self.section("VAR CONSTANT", list),
                _ => {}
            }
        }
    }

    fn section(&mut self, keyword: &str, list: Element<'_>) {
        let variables: Vec<_> = list.children_named("VarDeclaration").collect();
        if variables.is_empty() {
            return;
        }
        self.word(keyword, list.name_span());
        self.word("\n", list.name_span());
        variables.into_iter().for_each(|variable| self.variable(variable));
        self.word("END_VAR\n", list.name_span());
    }

    fn variable(&mut self, variable: Element<'_>) {
        let span = variable.name_span();
        self.comment(variable);
        self.word("\t", span);
        self.attribute(variable, "Name");
        self.word(" : ", span);
        self.array_size(variable);
        self.attribute(variable, "Type");
        self.initial(variable);
        self.word(";\n", span);
    }

    /// `ArraySize` is a number of elements, or ranges as in `0..3`.
    fn array_size(&mut self, variable: Element<'_>) {
        let Some(size) = variable.attribute("ArraySize").filter(|size| !size.value.trim().is_empty()) else { return };
        let is_count = size.value.trim().parse::<u32>();
        match is_count {
            Ok(count) => self.word(&format!("ARRAY [0..{}] OF ", i64::from(count) - 1), size.span),
            Err(_) => {
                self.word("ARRAY [", size.span);
                self.attribute(variable, "ArraySize");
                self.word("] OF ", size.span);
            }
        }
    }

    fn initial(&mut self, element: Element<'_>) {
        if let Some(value) = element.attribute("InitialValue").filter(|value| !value.value.is_empty()) {
            self.word(" := ", value.span);
            self.attribute(element, "InitialValue");
        }
    }

    fn comment(&mut self, element: Element<'_>) {
        let Some(text) = element.attribute_fragment("Comment").filter(|text| !text.text.trim().is_empty()) else {
            return;
        };
        let span = element.name_span();
        let mut at = 0;
        for line in text.text.split_inclusive('\n') {
            let content = line.trim_end();
            self.word("\t// ", span);
            self.out.piece(&text, at, at + content.len());
            self.word("\n", span);
            at += line.len();
        }
    }

    fn data_type(&mut self, root: Element<'_>) {
        let span = root.name_span();
        self.word("TYPE ", span);
        self.attribute(root, "Name");
        self.word(" :\n", span);
        for definition in root.children() {
            match definition.name() {
                "StructuredType" => {
                    self.word("STRUCT\n", definition.name_span());
                    definition.children_named("VarDeclaration").for_each(|member| self.variable(member));
                    self.word("END_STRUCT;\n", definition.name_span());
                }
                "EnumeratedType" => self.enumeration(definition),
                "DirectlyDerivedType" => {
                    self.attribute(definition, "BaseType");
                    self.initial(definition);
                    self.word(";\n", definition.name_span());
                }
                "SubrangeType" => self.ranged(definition, "", "(", ")"),
                "ArrayType" => self.ranged(definition, "ARRAY ", "[", "]"),
                _ => {}
            }
        }
        self.word("END_TYPE\n", span);
    }

    fn enumeration(&mut self, definition: Element<'_>) {
        self.word("(\n", definition.name_span());
        for (index, value) in definition.children_named("EnumeratedValue").enumerate() {
            self.word(if index == 0 { "" } else { ",\n" }, value.name_span());
            self.comment(value);
            self.word("\t", value.name_span());
            self.attribute(value, "Name");
        }
        self.word("\n);\n", definition.name_span());
    }

    /// A subrange (`INT (0..9)`), or an array (`ARRAY [0..9] OF INT`).
    fn ranged(&mut self, definition: Element<'_>, keyword: &str, open: &str, close: &str) {
        let span = definition.name_span();
        let is_array = !keyword.is_empty();
        if !is_array {
            self.attribute(definition, "BaseType");
            self.word(" ", span);
        }
        self.word(keyword, span);
        self.word(open, span);
        for (index, range) in definition.children_named("Subrange").enumerate() {
            self.word(if index == 0 { "" } else { ", " }, range.name_span());
            self.attribute(range, "LowerLimit");
            self.word("..", range.name_span());
            self.attribute(range, "UpperLimit");
        }
        self.word(close, span);
        if is_array {
            self.word(" OF ", span);
            self.attribute(definition, "BaseType");
        }
        self.initial(definition);
        self.word(";\n", span);
    }
}
