//! A small catalogue, made without a parser: items and variables with comments in given places.

use std::sync::Arc;

use crate::docs::{Block, Docs, Documentation, Entry, Inline, LinkTarget, Options, read};
use crate::library::names::Names;
use crate::library::{
    Access, Catalogue, Comment, FragmentId, Item, ItemBody, ItemId, ItemKind, Library, LibraryId, Placement, Pragma,
    Section, Source, Target, TypeUse, Variable,
};
use crate::text::{FileId, Fragment, Place, Span};

/// A catalogue in the making; each piece of text is appended to one file.
pub(super) struct Sample {
    pub(super) text: String,
    catalogue: Catalogue,
}

impl Sample {
    pub(super) fn new() -> Self {
        let library = Library { name: "Basics".to_owned(), ..Library::default() };
        Self { text: String::new(), catalogue: Catalogue { libraries: vec![library], ..Catalogue::default() } }
    }

    /// A function block with one comment above it.
    pub(super) fn above(comment: &str) -> Self {
        let mut sample = Self::new();
        let comments = vec![sample.comment(Placement::Above, comment)];
        sample.item(ItemKind::FunctionBlock, "FB_Pump", None, comments);
        sample
    }

    /// Appends text and the comments in it.
    pub(super) fn comment(&mut self, placement: Placement, source: &str) -> Comment {
        let start = self.text.len();
        self.text.push_str(source);
        let spans = tokens(source).into_iter().map(|span| span.shifted(u32::try_from(start).unwrap())).collect();
        Comment { placement, fragment: FragmentId(0), spans }
    }

    pub(super) fn code(&mut self, source: &str) -> Place {
        let start = self.text.len();
        self.text.push_str(source);
        Place::new(FileId(0), Span::from(start..self.text.len()))
    }

    pub(super) fn item(
        &mut self,
        kind: ItemKind,
        name: &str,
        parent: Option<ItemId>,
        comments: Vec<Comment>,
    ) -> ItemId {
        self.code("\n");
        let place = self.code(name);
        self.code("\n");
        let id = ItemId(u32::try_from(self.catalogue.items.len()).unwrap());
        if let Some(parent) = parent {
            self.catalogue.items[parent.0 as usize].children.push(id);
        }
        self.catalogue.items.push(Item {
            kind,
            name: name.to_owned(),
            place,
            parent,
            children: Vec::new(),
            library: LibraryId(0),
            namespace: Vec::new(),
            folder: Vec::new(),
            access: Access::Public,
            is_abstract: false,
            is_final: false,
            is_override: false,
            extends: Vec::new(),
            implements: Vec::new(),
            type_: None,
            variables: Vec::new(),
            pragmas: Vec::new(),
            comments,
            declaration: None,
            body: ItemBody::None,
            properties: Vec::new(),
        });
        id
    }

    pub(super) fn edit(&mut self, id: ItemId) -> &mut Item {
        &mut self.catalogue.items[id.0 as usize]
    }

    pub(super) fn extends(&mut self, id: ItemId, base: ItemId) {
        let use_ = self.type_use(base);
        self.edit(id).extends.push(use_);
    }

    pub(super) fn implements(&mut self, id: ItemId, base: ItemId) {
        let use_ = self.type_use(base);
        self.edit(id).implements.push(use_);
    }

    pub(super) fn type_use(&self, id: ItemId) -> TypeUse {
        let text = self.catalogue.item(id).name.clone();
        TypeUse { names: vec![(Span::from(0..text.len()), Target::Item(id))], place: None, text }
    }

    /// A variable with a comment above it and one behind, each as written, or nothing.
    pub(super) fn variable(&mut self, owner: ItemId, name: &str, above: &str, behind: &str) -> usize {
        let mut comments = Vec::new();
        if !above.is_empty() {
            comments.push(self.comment(Placement::Above, above));
        }
        let place = self.code(name);
        self.code(" : INT; ");
        if !behind.is_empty() {
            comments.push(self.comment(Placement::Trailing, behind));
        }
        self.code("\n");
        let variable = Variable {
            name: name.to_owned(),
            place,
            section: Section::Input,
            constant: false,
            retain: false,
            persistent: false,
            edge: None,
            type_: None,
            initial: None,
            address: None,
            pragmas: Vec::new(),
            comments,
        };
        self.edit(owner).variables.push(variable);
        self.catalogue.item(owner).variables.len() - 1
    }

    pub(super) fn pragma(&mut self, source: &str) -> Pragma {
        Pragma { text: source.to_owned(), place: self.code(source) }
    }

    pub(super) fn catalogue(&self) -> Catalogue {
        let text: Arc<str> = self.text.as_str().into();
        let source = Source { file: FileId(0), fragment: Fragment::verbatim(text, 0), tree: None };
        Catalogue { sources: vec![source], ..self.catalogue.clone() }
    }

    pub(super) fn read_with(&self, options: &Options) -> Docs {
        let catalogue = self.catalogue();
        read(&catalogue, &Names::new(&catalogue), options)
    }

    pub(super) fn read(&self) -> Docs {
        self.read_with(&Options::default())
    }

    /// The text at a place.
    pub(super) fn at(&self, place: Place) -> &str {
        place.span.of(&self.text)
    }
}

/// The spans of the comments in `source`, which holds nothing else.
fn tokens(source: &str) -> Vec<Span> {
    let mut out = Vec::new();
    let mut at = 0;
    while at < source.len() {
        let rest = &source[at..];
        let space = rest.len() - rest.trim_start().len();
        if space > 0 {
            at += space;
            continue;
        }
        let len = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("(*") {
            rest.find("*)").map_or(rest.len(), |end| end + 2)
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else {
            rest.len()
        };
        out.push(Span::from(at..at + len));
        at += len;
    }
    out
}

/// Documentation as a short text, for snapshots.
pub(super) fn show(entry: &Entry) -> String {
    let mut out = String::new();
    if let Some(doc) = &entry.doc {
        show_doc(doc, &mut out);
    }
    for considered in &entry.considered {
        out.push_str(&format!("= {:?} {:?}\n", considered.placement, considered.verdict));
    }
    out
}

fn show_doc(doc: &Documentation, out: &mut String) {
    out.push_str(&format!("brief: {}\n", inlines(&doc.brief)));
    blocks(&doc.detail, "  ", out);
    for param in &doc.tags.params {
        out.push_str(&format!("param {} [{}] {:?}\n", param.name, param.note, param.target.map(|t| t.1)));
        blocks(&param.content, "  ", out);
    }
    let tags = &doc.tags;
    let single = [
        ("returns", &tags.returns),
        ("since", &tags.since),
        ("deprecated", &tags.deprecated),
        ("version", &tags.version),
    ];
    for (name, tag) in single {
        if let Some(tag) = tag {
            out.push_str(&format!("{name}\n"));
            blocks(&tag.content, "  ", out);
        }
    }
    for (name, list) in
        [("see", &tags.see), ("example", &tags.examples), ("todo", &tags.todos), ("author", &tags.authors)]
    {
        for tag in list {
            out.push_str(&format!("{name}\n"));
            blocks(&tag.content, "  ", out);
        }
    }
    if tags.internal {
        out.push_str("internal\n");
    }
    for (id, _) in &tags.requirements {
        out.push_str(&format!("req {id}\n"));
    }
    for fact in &tags.facts {
        out.push_str(&format!("fact {}: {}\n", fact.key, fact.value));
    }
    if !tags.history.is_empty() {
        out.push_str("history\n");
        blocks(&tags.history, "  ", out);
    }
    for table in &doc.tables {
        out.push_str(&format!("table {:?}\n", table.heading));
    }
}

fn blocks(list: &[Block], indent: &str, out: &mut String) {
    let deeper = format!("{indent}  ");
    for block in list {
        match block {
            Block::Paragraph(content) => out.push_str(&format!("{indent}p {}\n", inlines(content))),
            Block::Heading(level, content) => out.push_str(&format!("{indent}h{level} {}\n", inlines(content))),
            Block::List { start, items } => {
                out.push_str(&format!("{indent}list {start:?}\n"));
                for item in items {
                    out.push_str(&format!("{indent}- {:?}\n", item.checked));
                    blocks(&item.content, &deeper, out);
                }
            }
            Block::Code { language, text } => out.push_str(&format!("{indent}code {language} {text:?}\n")),
            Block::Quote(content) => {
                out.push_str(&format!("{indent}quote\n"));
                blocks(content, &deeper, out);
            }
            Block::Note { style, title, content } => {
                out.push_str(&format!("{indent}note {style} {title}\n"));
                blocks(content, &deeper, out);
            }
            Block::Table { head, rows, .. } => {
                for row in std::iter::once(head).chain(rows) {
                    let cells: Vec<String> = row.iter().map(|cell| inlines(cell)).collect();
                    out.push_str(&format!("{indent}| {}\n", cells.join(" | ")));
                }
            }
            Block::Definitions(_) => out.push_str(&format!("{indent}definitions\n")),
            Block::Rule => out.push_str(&format!("{indent}rule\n")),
        }
    }
}

fn inlines(list: &[Inline]) -> String {
    let mut out = String::new();
    for inline in list {
        match inline {
            Inline::Text(text) => out.push_str(text),
            Inline::Code(text) => out.push_str(&format!("`{text}`")),
            Inline::Emph(content) => out.push_str(&format!("*{}*", inlines(content))),
            Inline::Strong(content) => out.push_str(&format!("**{}**", inlines(content))),
            Inline::Strike(content) => out.push_str(&format!("~~{}~~", inlines(content))),
            Inline::Link { target, content, .. } => {
                let to = match target {
                    LinkTarget::Item(id) => format!("item {}", id.0),
                    LinkTarget::Variable(id, i) => format!("variable {}.{i}", id.0),
                    LinkTarget::External(url) => url.clone(),
                    LinkTarget::Broken { text } => format!("broken {text}"),
                };
                out.push_str(&format!("[{}]({to})", inlines(content)));
            }
            Inline::Image { source, alt } => out.push_str(&format!("![{alt}]({source})")),
            Inline::Break => out.push('⏎'),
        }
    }
    out
}
