//! Texts that hold any number of declarations.

use super::Lowering;
use crate::library::{FragmentId, ItemId, ItemKind};
use crate::syntax::Tree;
use crate::syntax::ast::{AstNode, Configuration, Declaration, Resource, SourceFile, Task, VarSection};

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
            let added = match declaration {
                Declaration::Pou(pou) => self.pou(tree, fragment, *pou, None),
                Declaration::Property(property) => self.property(tree, fragment, *property, None),
                Declaration::Transition(transition) => self.transition(tree, fragment, *transition, None),
                Declaration::Types(block) => self.types(tree, fragment, *block).first().copied(),
                Declaration::Variables(section) => {
                    bare.push(*section);
                    None
                }
                Declaration::Namespace(namespace) => {
                    let parts: Vec<String> = namespace
                        .path()
                        .into_iter()
                        .flat_map(|path| path.segments().map(|s| s.text.to_owned()).collect::<Vec<_>>())
                        .collect();
                    let depth = self.namespace.len();
                    self.namespace.extend(parts);
                    let inner: Vec<Declaration<'_>> = namespace.declarations().collect();
                    let added = self.declarations(tree, fragment, &inner, name);
                    self.namespace.truncate(depth);
                    added
                }
                Declaration::Configuration(configuration) => self.configuration(tree, fragment, *configuration),
                Declaration::Resource(resource) => self.resource(tree, fragment, *resource),
                Declaration::Using(_) | Declaration::Body(_) => None,
            };
            first = first.or(added);
        }
        first.or(self.globals(tree, fragment, name, &bare))
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
