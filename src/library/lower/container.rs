//! Objects of containers: a declaration, a body, and children of their own.

use super::{Lowering, comments};
use crate::library::{Comment, Excerpt, FragmentId, Item, ItemBody, ItemId, ItemKind, Placement};
use crate::syntax::ast::{Declaration, SourceFile, VarSection};
use crate::syntax::{self, Entry, Tree};
use crate::text::{Body, Fragment, Object, ObjectKind, Place, Span};

impl Lowering<'_> {
    /// An object with its children.
    pub(super) fn object(&mut self, object: &Object, parent: Option<ItemId>) {
        if object.kind == ObjectKind::Text {
            if let Some(fragment) = &object.declaration {
                let id = self.parse(fragment, Entry::File, object);
                let tree = self.tree(id);
                let name = object.name.clone().unwrap_or_else(|| self.stem.to_owned());
                tree.iter().for_each(|tree| _ = self.file(tree, id, &name));
            }
            return;
        }
        let id = match &object.declaration {
            Some(fragment) if !fragment.text.trim().is_empty() => self.declared(object, fragment, parent),
            _ => self.undeclared(object, parent),
        };
        self.extras(object, id);
        object.children.iter().for_each(|child| self.object(child, Some(id)));
    }

    fn tree(&self, id: FragmentId) -> Option<std::sync::Arc<Tree>> {
        self.sources[id.0 as usize].tree.clone()
    }

    /// The item that the declaration of `object` declares.
    fn declared(&mut self, object: &Object, fragment: &Fragment, parent: Option<ItemId>) -> ItemId {
        let source = self.parse(fragment, Entry::Declaration, object);
        let Some(tree) = self.tree(source) else { return self.undeclared(object, parent) };
        let first = count_items(self);
        let found = self.lower_declaration(object, &tree, source, parent);
        let id = found.unwrap_or_else(|| self.undeclared(object, parent));
        let alone = count_items(self) == first + 1;
        if alone || found.is_none() {
            self.item_mut(id).declaration = Some(Excerpt { fragment: source, span: trimmed(&fragment.text) });
        }
        id
    }

    fn lower_declaration(
        &mut self,
        object: &Object,
        tree: &Tree,
        source: FragmentId,
        parent: Option<ItemId>,
    ) -> Option<ItemId> {
        let name = object.name.clone().unwrap_or_else(|| self.stem.to_owned());
        let declarations: Vec<Declaration<'_>> = SourceFile::of(tree).declarations().collect();
        let sections: Vec<VarSection<'_>> = declarations
            .iter()
            .filter_map(|declaration| match declaration {
                Declaration::Variables(section) => Some(*section),
                _ => None,
            })
            .collect();
        match object.kind {
            ObjectKind::GlobalVariables => self.globals(tree, source, &name, &sections),
            ObjectKind::Getter | ObjectKind::Setter | ObjectKind::Action | ObjectKind::Transition => {
                let own = declarations.iter().find_map(|declaration| self.member(tree, source, *declaration, parent));
                let id = own.unwrap_or_else(|| self.undeclared(object, parent));
                let variables = self.all(source, &sections);
                self.item_mut(id).variables.extend(variables);
                Some(id)
            }
            _ => {
                let own = declarations.iter().find_map(|declaration| self.member(tree, source, *declaration, parent));
                own.or_else(|| self.file(tree, source, &name))
            }
        }
    }

    fn member(
        &mut self,
        tree: &Tree,
        source: FragmentId,
        declaration: Declaration<'_>,
        parent: Option<ItemId>,
    ) -> Option<ItemId> {
        match declaration {
            Declaration::Pou(pou) => self.pou(tree, source, pou, parent),
            Declaration::Property(property) => self.property(tree, source, property, parent),
            Declaration::Transition(transition) => self.transition(tree, source, transition, parent),
            _ => None,
        }
    }

    /// The item that the container alone tells of.
    fn undeclared(&mut self, object: &Object, parent: Option<ItemId>) -> ItemId {
        let kind = match object.kind {
            ObjectKind::Pou | ObjectKind::Text => ItemKind::FunctionBlock,
            ObjectKind::DataType => ItemKind::Alias,
            ObjectKind::GlobalVariables => ItemKind::GlobalVariables,
            ObjectKind::Interface => ItemKind::Interface,
            ObjectKind::Method => ItemKind::Method,
            ObjectKind::Property => ItemKind::Property,
            ObjectKind::Getter => ItemKind::Getter,
            ObjectKind::Setter => ItemKind::Setter,
            ObjectKind::Action => ItemKind::Action,
            ObjectKind::Transition => ItemKind::Transition,
            ObjectKind::Task => ItemKind::Task,
        };
        let name = match (kind, &object.name) {
            (ItemKind::Getter, _) => "Get",
            (ItemKind::Setter, _) => "Set",
            (_, Some(name)) => name,
            (_, None) => self.stem,
        };
        let item = self.blank(kind, name, Place::new(self.unit.file, object.span), parent);
        self.push(item)
    }

    /// What the container adds: folder, facts, documentation, body.
    fn extras(&mut self, object: &Object, id: ItemId) {
        let mut own: Vec<Comment> = Vec::new();
        if let Some(documentation) = &object.documentation {
            let fragment = self.keep(documentation, None);
            let spans = vec![Span::from(0..documentation.text.len())];
            own.push(Comment { placement: Placement::Container, fragment, spans });
        }
        let body = match &object.body {
            Body::None => None,
            Body::St(fragment) => Some(self.st_body(fragment, object, &mut own)),
            Body::Il(fragment) => {
                let source = self.parse(fragment, Entry::InstructionList, object);
                Some(ItemBody::Il(Excerpt { fragment: source, span: trimmed(&fragment.text) }))
            }
            Body::Other(language, fragment) => {
                let source = self.keep(fragment, None);
                let span = Span::from(0..fragment.text.len());
                Some(ItemBody::Drawn(*language, Excerpt { fragment: source, span }))
            }
        };
        let item: &mut Item = self.item_mut(id);
        item.folder.extend(object.folder.iter().cloned());
        item.properties.extend(object.properties.iter().cloned());
        item.comments.extend(own);
        if let Some(body) = body {
            item.body = body;
        }
    }

    fn st_body(&mut self, fragment: &Fragment, object: &Object, own: &mut Vec<Comment>) -> ItemBody {
        let told = self.findings.len();
        let source = self.parse(fragment, Entry::Body, object);
        if object.kind == ObjectKind::Transition {
            // A transition may be a bare condition.
            let bare = self.findings.split_off(told);
            self.findings.extend(bare.into_iter().filter(|one| one.code != &syntax::codes::MISSING_SEMICOLON));
        }
        if let Some(tree) = self.tree(source) {
            own.extend(comments::after(&tree, source, 0, Placement::FirstInBody));
        }
        let excerpt = Excerpt { fragment: source, span: trimmed(&fragment.text) };
        let tree = self.tree(source);
        let body = tree.as_deref().and_then(|tree| SourceFile::of(tree).body());
        match body.and_then(|body| body.instructions()) {
            Some(_) => ItemBody::Il(excerpt),
            None => ItemBody::St(excerpt),
        }
    }
}

fn count_items(lowering: &Lowering<'_>) -> usize {
    lowering.items.len()
}

/// The range of `text` without blanks at its ends.
fn trimmed(text: &str) -> Span {
    let start = text.len() - text.trim_start().len();
    Span::from(start..start + text.trim().len())
}
