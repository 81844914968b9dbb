//! An entity's page as values for its template.

use tera::{Context, Value};

use super::context::Place;
use super::highlight::Links;
use super::listing;
use super::prose::Prose;
use super::site::Site;
use super::value::{list, markup, record, strings};
use super::{lists, table};
use crate::book::view::entity::{
    CoreView, Diagram, EntityView, Fact, InheritedView, MemberView, Relation, SectionView, SourceView, VariableView,
};
use crate::book::view::prose::Href;

/// Writes what one entity's page shows.
pub(super) struct Writer<'a> {
    pub(super) site: &'a Site<'a>,
    pub(super) entity: &'a EntityView,
    pub(super) place: &'a Place,
    pub(super) prose: Prose<'a>,
}

impl Writer<'_> {
    /// Fills `context` with the whole page.
    pub(super) fn fill(&self, context: &mut Context) {
        let entity = self.entity;
        context.insert_value("core", self.core(&entity.core, 3));
        context.insert_value("library", self.library());
        context.insert_value("namespace", Value::from(entity.namespace.join(".")));
        context.insert_value("folder", Value::from(entity.folder.join("/")));
        context.insert_value("relations", list(&entity.relations, |r| self.relation(r)));
        context.insert_value("inheritance", self.diagram(entity.inheritance.as_ref()));
        context.insert_value("groups", self.member_groups());
        context.insert_value("inherited", list(&entity.inherited, |i| self.inherited(i)));
        context.insert_value("tables", list(&entity.tables, |t| self.table(t)));
        context.insert_value("sources", self.sources());
        context.insert_value("findings", list(&entity.findings, |f| self.finding(f)));
        context.insert_value("siblings", self.siblings());
    }

    fn library(&self) -> Value {
        let library = self.site.book.libraries.get(self.entity.library);
        record! {
            name: self.entity.library_name.as_str(),
            href: library.map(|library| self.place.href(&library.url)),
            folder_href: self.site.folder_of(self.entity).map(|folder| self.place.href(&folder.url)),
        }
    }

    /// What stands beside it in its folder.
    fn siblings(&self) -> Value {
        let entries = self.site.folder_of(self.entity).map_or(&[][..], |folder| &folder.entities);
        lists::siblings(entries, self.place, &self.entity.core.url)
    }

    fn core(&self, core: &CoreView, top: u8) -> Value {
        let links = self.links(core);
        record! {
            kind: core.kind,
            kind_label: core.kind_label,
            kind_short: lists::kind_short(core.kind),
            name: core.name.as_str(),
            qualified_name: core.qualified_name.as_str(),
            anchor: core.anchor.as_str(),
            file: core.file.as_str(),
            line: core.line,
            line_href: self.line_href(&core.file, core.line),
            documented: core.documented,
            badges: strings(&core.badges),
            brief: markup(&self.prose.inlines(&core.brief)),
            detail: markup(&self.prose.blocks(&core.detail, top)),
            facts: list(&core.facts, |fact| self.fact(fact, top)),
            documentation_from: core.documentation_from.as_ref().map(|link| self.place.link(link)),
            signature: markup(&self.site.highlighter.highlight(core.signature.trim_end(), &links)),
            signature_lines: core.signature.trim_end().lines().count(),
            diagram: self.diagram(core.diagram.as_ref()),
            type_label: core.type_label,
            type: self.place.type_(&core.type_),
            returns: markup(&self.prose.inlines(&core.returns)),
            sections: list(&core.sections, |section| self.section(section, core)),
            pragmas: strings(&core.pragmas),
        }
    }

    /// The names that a signature mentions and this manual describes.
    fn links(&self, core: &CoreView) -> Links {
        let mut links = Links::new();
        let mut add = |name: &str, to: Option<&Href>| {
            if let Some(Href::Page { url, .. }) = to {
                links.insert(name.to_lowercase(), self.place.href(url));
            }
        };
        let variables = core.sections.iter().flat_map(|section| &section.variables);
        for part in core.type_.iter().chain(variables.flat_map(|variable| &variable.type_)) {
            add(&part.text, part.to.as_ref());
        }
        let bases = self.entity.relations.iter().filter(|r| matches!(r.key, "extends" | "implements"));
        for link in bases.flat_map(|relation| &relation.links) {
            add(&link.name, link.to.as_ref());
        }
        links.remove(&core.name.to_lowercase());
        links
    }

    fn line_href(&self, file: &str, line: u32) -> Option<String> {
        listing::find_line(&self.entity.sources, file, line).map(|anchor| format!("#{anchor}"))
    }

    fn diagram(&self, diagram: Option<&Diagram>) -> Value {
        Value::from(diagram.map(|d| {
            let svg = self.place.drawing(&d.svg);
            record! { svg: markup(&svg), alt: d.alt.as_str(), width: d.width, height: d.height }
        }))
    }

    fn fact(&self, fact: &Fact, top: u8) -> Value {
        record! { title: fact.title.as_str(), content: markup(&self.prose.blocks(&fact.content, top + 1)) }
    }

    fn relation(&self, relation: &Relation) -> Value {
        record! {
            key: relation.key,
            title: relation.title,
            links: list(&relation.links, |link| self.place.link(link)),
        }
    }

    fn section(&self, section: &SectionView, owner: &CoreView) -> Value {
        let any = |test: fn(&VariableView) -> bool| section.variables.iter().any(test);
        let prefix = if owner.anchor.is_empty() { String::new() } else { format!("-{}", owner.anchor) };
        record! {
            key: section.key,
            id: format!("rb-{}{prefix}", section.key),
            title: section.title.as_str(),
            public: section.public,
            has_type: any(|v| !v.type_.is_empty()),
            has_initial: any(|v| !v.initial.is_empty()),
            has_address: any(|v| !v.address.is_empty()),
            variables: list(&section.variables, |variable| self.variable(variable, &owner.file)),
        }
    }

    fn variable(&self, variable: &VariableView, file: &str) -> Value {
        record! {
            name: variable.name.as_str(),
            anchor: variable.anchor.as_str(),
            type: self.place.type_(&variable.type_),
            initial: variable.initial.as_str(),
            address: variable.address.as_str(),
            badges: strings(&variable.badges),
            brief: markup(&self.prose.inlines(&variable.brief)),
            detail: markup(&self.prose.blocks(&variable.detail, 6)),
            pragmas: strings(&variable.pragmas),
            line: variable.line,
            line_href: self.line_href(file, variable.line),
            inherited_from: variable.inherited_from.as_ref().map(|link| self.place.link(link)),
        }
    }

    /// Its members, grouped by kind; they come in the order of the kinds.
    fn member_groups(&self) -> Value {
        let groups: Vec<Value> = self
            .entity
            .members
            .chunk_by(|a, b| a.core.kind == b.core.kind)
            .map(|members| {
                let kind = members.first().map_or("", |member| member.core.kind);
                record! {
                    key: kind,
                    title: member_title(kind),
                    members: list(members, |member| self.member(member)),
                }
            })
            .collect();
        Value::from(groups)
    }

    fn member(&self, member: &MemberView) -> Value {
        record! {
            core: self.core(&member.core, 4),
            overrides: list(&member.overrides, |link| self.place.link(link)),
            access: member.access,
        }
    }

    fn inherited(&self, inherited: &InheritedView) -> Value {
        record! {
            link: self.place.link(&inherited.link),
            kind_label: inherited.kind_label,
            from: self.place.link(&inherited.from),
            brief: markup(&self.prose.inlines(&inherited.brief)),
        }
    }

    fn table(&self, view: &crate::book::view::table::TableView) -> Value {
        table::value(view, &self.prose, self.line_href(&view.file, view.line))
    }

    fn sources(&self) -> Value {
        let source = |(index, source): (usize, &SourceView)| {
            record! {
                title: source.title.as_str(),
                anchor: source.anchor.as_str(),
                file: source.file.as_str(),
                first_line: source.first_line,
                lines: listing::line_count(source),
                note: source.note.as_deref(),
                listing: markup(&listing::lines(source, index, self.place)),
            }
        };
        Value::from(self.entity.sources.iter().enumerate().map(source).collect::<Vec<_>>())
    }

    fn finding(&self, finding: &crate::book::view::finding::FindingView) -> Value {
        self.site.finding(finding, self.place, self.line_href(&finding.file, finding.line), None)
    }
}

fn member_title(kind: &str) -> &'static str {
    match kind {
        "method" => "Methods",
        "property" => "Properties",
        "action" => "Actions",
        "transition" => "Transitions",
        _ => "Members",
    }
}
