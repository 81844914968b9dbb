//! Texts that hold any number of declarations.

use super::Lowering;
use crate::library::{FragmentId, Item, ItemId, ItemKind};
use crate::syntax::Tree;
use crate::syntax::ast::{
    AstNode, Configuration, Declaration, Name, Namespace, PouKind, Resource, SourceFile, Task, VarSection,
};

impl Lowering<'_> {
    /// What stands in a text: all of its declarations, in order. Gives the first item.
    pub(super) fn file(&mut self, tree: &Tree, fragment: FragmentId, name: &str) -> Option<ItemId> {
        let declarations: Vec<Declaration<'_>> = SourceFile::of(tree).declarations().collect();
        self.declarations(tree, fragment, &declarations, name)
    }

    fn declarations(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        declarations: &[Declaration<'_>],
        name: &str,
    ) -> Option<ItemId> {
        let mut first = None;
        let mut bare: Vec<VarSection<'_>> = Vec::new();
        for declaration in declarations {
            if let Declaration::Variables(section) = declaration {
                bare.push(*section);
            }
            let added = self.declaration_of(tree, fragment, *declaration, name);
            first = first.or(added);
        }
        let globals = self.globals(tree, fragment, name, &bare);
        first.or(globals)
    }

    fn declaration_of(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        declaration: Declaration<'_>,
        name: &str,
    ) -> Option<ItemId> {
        match declaration {
            Declaration::Pou(pou) => {
                let alone = pou.kind() == PouKind::Action && !pou.name().is_some_and(|name| name.text().contains('.'));
                let parent = if alone { self.owner(None) } else { None };
                self.pou(tree, fragment, pou, parent)
            }
            Declaration::Property(property) => self.property(tree, fragment, property, None),
            Declaration::Actions(actions) => {
                let parent = self.owner(actions.pou().map(Name::text));
                let added = actions.actions().filter_map(|action| self.pou(tree, fragment, action, parent));
                added.collect::<Vec<_>>().first().copied()
            }
            Declaration::Transition(transition) => {
                let parent = self.owner(None);
                self.transition(tree, fragment, transition, parent)
            }
            Declaration::Types(block) => self.types(tree, fragment, block).first().copied(),
            Declaration::Namespace(namespace) => self.namespace(tree, fragment, namespace, name),
            Declaration::Configuration(configuration) => self.configuration(tree, fragment, configuration),
            Declaration::Resource(resource) => self.resource(tree, fragment, resource),
            Declaration::Variables(_) | Declaration::Using(_) | Declaration::Body(_) => None,
        }
    }

    /// The block of this unit that a member standing alone belongs to: the one called `name`, or the last one.
    fn owner(&self, name: Option<&str>) -> Option<ItemId> {
        let blocks = [ItemKind::FunctionBlock, ItemKind::Program, ItemKind::Function, ItemKind::Class];
        let fits = |item: &Item| {
            let called = name.is_none_or(|name| item.name.eq_ignore_ascii_case(name));
            item.parent.is_none() && blocks.contains(&item.kind) && called
        };
        self.items.iter().rposition(fits).map(|i| ItemId(super::count(i)))
    }

    fn namespace(&mut self, tree: &Tree, fragment: FragmentId, namespace: Namespace<'_>, name: &str) -> Option<ItemId> {
        let depth = self.namespace.len();
        if let Some(path) = namespace.path() {
            self.namespace.extend(path.segments().map(|segment| segment.text.to_owned()));
        }
        let inner: Vec<Declaration<'_>> = namespace.declarations().collect();
        let added = self.declarations(tree, fragment, &inner, name);
        self.namespace.truncate(depth);
        added
    }

    fn configuration(&mut self, tree: &Tree, fragment: FragmentId, from: Configuration<'_>) -> Option<ItemId> {
        let name = from.name().map_or("CONFIGURATION", |name| name.text()).to_owned();
        let sections: Vec<VarSection<'_>> = from.var_sections().collect();
        let mut first = self.globals(tree, fragment, &name, &sections);
        for resource in from.resources() {
            first = first.or(self.resource(tree, fragment, resource));
        }
        from.tasks().for_each(|task| first = first.or(self.task(fragment, task)));
        first
    }

    fn resource(&mut self, tree: &Tree, fragment: FragmentId, from: Resource<'_>) -> Option<ItemId> {
        let name = from.name().map_or("RESOURCE", |name| name.text()).to_owned();
        let sections: Vec<VarSection<'_>> = from.var_sections().collect();
        let mut first = self.globals(tree, fragment, &name, &sections);
        from.tasks().for_each(|task| first = first.or(self.task(fragment, task)));
        first
    }

    fn task(&mut self, fragment: FragmentId, task: Task<'_>) -> Option<ItemId> {
        let name = task.name()?;
        let place = self.place(fragment, name.span());
        let mut item = self.blank(ItemKind::Task, name.text(), place, None);
        item.declaration = Some(crate::library::Excerpt { fragment, span: task.span() });
        Some(self.push(item))
    }
}
