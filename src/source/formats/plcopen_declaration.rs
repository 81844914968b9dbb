//! Writes the declarations of PLCopen XML as Structured Text.
//!
//! Names, types and values stand in the file as attributes or element names and are taken from there byte for byte; the words
//! between them stand for the element that asks for them. So an error in a type points at that type.

use super::xhtml;
use crate::source::fragment::FragmentBuilder;
use crate::source::xml::Element;
use crate::text::{Fragment, ObjectKind, Span};

/// The declaration of the object in `element`; `None` for what declares nothing.
pub(super) fn of(kind: ObjectKind, element: Element<'_>) -> Option<Fragment> {
    let mut writer = Writer { out: FragmentBuilder::new() };
    match kind {
        ObjectKind::DataType => writer.data_type(element),
        ObjectKind::GlobalVariables => writer.section("VAR_GLOBAL", element),
        ObjectKind::Action | ObjectKind::Transition | ObjectKind::Task | ObjectKind::Text => return None,
        ObjectKind::Getter | ObjectKind::Setter => writer.sections(element.child("interface")?),
        ObjectKind::Pou | ObjectKind::Interface | ObjectKind::Method | ObjectKind::Property => {
            writer.unit(kind, element)
        }
    }
    Some(writer.out.finish(element.span().start))
}

struct Writer {
    out: FragmentBuilder,
}

impl Writer {
    /// Adds `text`, which stands for `span`.
    fn word(&mut self, text: &str, span: Span) {
        self.out.standing_for(text, span);
    }

    /// Adds the value of an attribute as it stands in the file; whether there is one.
    fn attribute(&mut self, element: Element<'_>, name: &str) -> bool {
        match element.attribute_fragment(name) {
            Some(value) if !value.text.is_empty() => {
                self.out.fragment(&value);
                true
            }
            _ => false,
        }
    }

    fn unit(&mut self, kind: ObjectKind, element: Element<'_>) {
        let span = element.name_span();
        self.attributes(element);
        let keyword = match kind {
            ObjectKind::Interface => "INTERFACE ",
            ObjectKind::Method => "METHOD ",
            ObjectKind::Property => "PROPERTY ",
            _ => match element.value("pouType").as_deref() {
                Some("function") => "FUNCTION ",
                Some("program") => "PROGRAM ",
                _ => "FUNCTION_BLOCK ",
            },
        };
        self.word(keyword, element.attribute("pouType").map_or(span, |kind| kind.span));
        self.attribute(element, "name");
        let Some(interface) = element.child("interface") else { return self.word("\n", span) };
        if let Some(result) = interface.child("returnType").and_then(|result| result.children().next()) {
            self.word(" : ", result.name_span());
            self.type_of(result);
        }
        self.word("\n", span);
        self.sections(interface);
    }

    fn sections(&mut self, interface: Element<'_>) {
        for list in interface.children() {
            let keyword = match list.name() {
                "inputVars" => "VAR_INPUT",
                "outputVars" => "VAR_OUTPUT",
                "inOutVars" => "VAR_IN_OUT",
                "localVars" => "VAR",
                "tempVars" => "VAR_TEMP",
                "externalVars" => "VAR_EXTERNAL",
                "globalVars" => "VAR_GLOBAL",
                "accessVars" => "VAR_ACCESS",
                _ => continue,
            };
            self.section(keyword, list);
        }
    }

    fn section(&mut self, keyword: &str, list: Element<'_>) {
        let span = list.name_span();
        self.attributes(list);
        self.word(keyword, span);
        for (flag, word) in [
            ("constant", " CONSTANT"),
            ("retain", " RETAIN"),
            ("nonretain", " NON_RETAIN"),
            ("persistent", " PERSISTENT"),
        ] {
            if let Some(value) = list.attribute(flag).filter(|value| value.value == "true") {
                self.word(word, value.span);
            }
        }
        self.word("\n", span);
        for variable in list.children_named("variable") {
            self.variable(variable);
        }
        self.word("END_VAR\n", span);
    }

    fn variable(&mut self, variable: Element<'_>) {
        let span = variable.name_span();
        self.comment(variable);
        self.attributes(variable);
        self.word("\t", span);
        self.attribute(variable, "name");
        if let Some(address) = variable.attribute("address").filter(|address| !address.value.is_empty()) {
            self.word(" AT ", address.span);
            self.attribute(variable, "address");
        }
        self.word(" : ", span);
        if let Some(kind) = variable.child("type").and_then(|kind| kind.children().next()) {
            self.type_of(kind);
        }
        self.initial(variable);
        self.word(";\n", span);
    }

    /// The documentation of a variable as comments before it.
    fn comment(&mut self, element: Element<'_>) {
        let Some(text) = element.child("documentation").and_then(xhtml::markdown) else { return };
        let span = element.child("documentation").map_or(element.name_span(), |doc| doc.name_span());
        let mut at = 0;
        for line in text.text.split_inclusive('\n') {
            let content = line.trim();
            if !content.is_empty() {
                let lead = line.len() - line.trim_start().len();
                self.word("\t// ", span);
                self.out.piece(&text, at + lead, at + lead + content.len());
                self.word("\n", span);
            }
            at += line.len();
        }
    }

    /// The pragmas that CODESYS keeps beside an element.
    fn attributes(&mut self, element: Element<'_>) {
        let data = element.child("addData").into_iter().flat_map(|added| added.children_named("data"));
        for attribute in
            data.filter_map(|data| data.child("Attributes")).flat_map(|list| list.children_named("Attribute"))
        {
            let span = attribute.name_span();
            self.word("{attribute '", span);
            self.attribute(attribute, "Name");
            if attribute.value("Value").is_some_and(|value| !value.is_empty()) {
                self.word("' := '", span);
                self.attribute(attribute, "Value");
            }
            self.word("'}\n", span);
        }
    }

    fn type_of(&mut self, kind: Element<'_>) {
        let span = kind.name_span();
        match kind.name() {
            "derived" => {
                self.attribute(kind, "name");
            }
            "string" | "wstring" => {
                self.word(if kind.name() == "string" { "STRING" } else { "WSTRING" }, span);
                if kind.value("length").is_some_and(|length| !length.is_empty()) {
                    self.word("(", span);
                    self.attribute(kind, "length");
                    self.word(")", span);
                }
            }
            "array" => self.array(kind),
            "pointer" => {
                self.word("POINTER TO ", span);
                self.base(kind);
            }
            "subrangeSigned" | "subrangeUnsigned" => {
                self.base(kind);
                self.word("(", span);
                kind.child("range").into_iter().for_each(|range| self.range(range));
                self.word(")", span);
            }
            "enum" => self.enumeration(kind),
            "struct" => {
                self.word("STRUCT\n", span);
                kind.children_named("variable").for_each(|member| self.variable(member));
                self.word("END_STRUCT", span);
            }
            name => {
                // The element's own name is the type; a prefix may stand before it.
                self.out.placed(name, span.end - u32::try_from(name.len()).unwrap_or(0));
            }
        }
    }

    fn base(&mut self, kind: Element<'_>) {
        if let Some(base) = kind.child("baseType").and_then(|base| base.children().next()) {
            self.type_of(base);
        }
    }

    fn range(&mut self, range: Element<'_>) {
        self.attribute(range, "lower");
        self.word("..", range.name_span());
        self.attribute(range, "upper");
    }

    fn array(&mut self, kind: Element<'_>) {
        self.word("ARRAY [", kind.name_span());
        for (index, dimension) in kind.children_named("dimension").enumerate() {
            if index > 0 {
                self.word(", ", dimension.name_span());
            }
            self.range(dimension);
        }
        self.word("] OF ", kind.name_span());
        self.base(kind);
    }

    fn enumeration(&mut self, kind: Element<'_>) {
        let span = kind.name_span();
        self.word("(\n", span);
        let values: Vec<_> = kind.children_named("values").flat_map(|values| values.children_named("value")).collect();
        for (index, value) in values.iter().enumerate() {
            self.comment(*value);
            self.word("\t", value.name_span());
            self.attribute(*value, "name");
            if value.value("value").is_some_and(|number| !number.is_empty()) {
                self.word(" := ", value.name_span());
                self.attribute(*value, "value");
            }
            self.word(if index + 1 < values.len() { ",\n" } else { "\n" }, value.name_span());
        }
        self.word(")", span);
        if kind.child("baseType").is_some() {
            self.word(" ", span);
            self.base(kind);
        }
    }

    fn initial(&mut self, element: Element<'_>) {
        if let Some(value) = element.child("initialValue").and_then(|value| value.children().next()) {
            self.word(" := ", value.name_span());
            self.value(value);
        }
    }

    fn value(&mut self, value: Element<'_>) {
        let span = value.name_span();
        match value.name() {
            "simpleValue" => {
                self.attribute(value, "value");
            }
            "arrayValue" => self.values(value, "[", "]"),
            "structValue" => self.values(value, "(", ")"),
            _ => self.word("0", span),
        }
    }

    fn values(&mut self, list: Element<'_>, open: &str, close: &str) {
        self.word(open, list.name_span());
        for (index, item) in list.children_named("value").enumerate() {
            let span = item.name_span();
            if index > 0 {
                self.word(", ", span);
            }
            if self.attribute(item, "member") {
                self.word(" := ", span);
            }
            let repeated = self.attribute(item, "repetitionValue");
            self.word(if repeated { "(" } else { "" }, span);
            item.children().take(1).for_each(|inner| self.value(inner));
            self.word(if repeated { ")" } else { "" }, span);
        }
        self.word(close, list.name_span());
    }

    fn data_type(&mut self, element: Element<'_>) {
        let span = element.name_span();
        self.attributes(element);
        self.word("TYPE ", span);
        self.attribute(element, "name");
        self.word(" :\n", span);
        let kind = element.child("baseType").and_then(|base| base.children().next());
        if let Some(kind) = kind {
            self.type_of(kind);
        }
        self.initial(element);
        let is_struct = kind.is_some_and(|kind| kind.name() == "struct");
        self.word(if is_struct { "\nEND_TYPE\n" } else { ";\nEND_TYPE\n" }, span);
    }
}
