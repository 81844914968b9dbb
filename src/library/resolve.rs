//! Gives names their meaning: types of variables, bases, interfaces.

use std::mem::take;

use super::names::{Names, Scope};
use super::{Catalogue, Item, TypeUse};

/// Resolves every type in `catalogue`, bases first, since members are looked up through them.
#[must_use]
pub fn resolve(catalogue: &mut Catalogue) -> Names {
    let names = Names::new(catalogue);
    pass(catalogue, &names, |item, with| {
        item.extends.iter_mut().chain(&mut item.implements).for_each(with);
    });
    pass(catalogue, &names, |item, with| {
        let variables = item.variables.iter_mut().filter_map(|variable| variable.type_.as_mut());
        item.type_.iter_mut().chain(variables).for_each(with);
    });
    names
}

fn pass(catalogue: &mut Catalogue, names: &Names, types: impl Fn(&mut Item, &mut dyn FnMut(&mut TypeUse))) {
    for i in 0..catalogue.items.len() {
        // Taken out, so that the rest of the catalogue can be read meanwhile.
        let mut work: Vec<TypeUse> = Vec::new();
        types(&mut catalogue.items[i], &mut |use_| work.push(take(use_)));
        let item = &catalogue.items[i];
        let (library, namespace) = (item.library, item.namespace.clone());
        let scope = Scope { library, namespace: &namespace };
        work.iter_mut().for_each(|use_| use_.resolve(catalogue, names, scope));
        let mut done = work.into_iter();
        types(&mut catalogue.items[i], &mut |use_| *use_ = done.next().unwrap_or_default());
    }
}
