//! Configurations, their resources, tasks and programs.

use super::{Argument, Name, Path, Type, VarSection, ast_nodes, child, children};
use crate::syntax::kind::{NodeKind, TokenKind};

ast_nodes! {
    /// `CONFIGURATION … END_CONFIGURATION`.
    Configuration = Configuration;
    /// `RESOURCE … END_RESOURCE`.
    Resource = Resource;
    /// `TASK t(…);`.
    Task = Task;
    /// `PROGRAM p WITH t : P;`.
    ProgramConfiguration = ProgramConfiguration;
}

impl<'t> Configuration<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// Its resources.
    pub fn resources(self) -> impl Iterator<Item = Resource<'t>> {
        children(self.0)
    }

    /// Its tasks, where it has no resource.
    pub fn tasks(self) -> impl Iterator<Item = Task<'t>> {
        children(self.0)
    }

    /// Its programs, where it has no resource.
    pub fn programs(self) -> impl Iterator<Item = ProgramConfiguration<'t>> {
        children(self.0)
    }

    /// Its sections of variables.
    pub fn var_sections(self) -> impl Iterator<Item = VarSection<'t>> {
        children(self.0)
    }
}

impl<'t> Resource<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// What it runs on.
    #[must_use]
    pub fn on(self) -> Option<Path<'t>> {
        child(self.0)
    }

    /// Its tasks.
    pub fn tasks(self) -> impl Iterator<Item = Task<'t>> {
        children(self.0)
    }

    /// Its programs.
    pub fn programs(self) -> impl Iterator<Item = ProgramConfiguration<'t>> {
        children(self.0)
    }

    /// Its sections of variables.
    pub fn var_sections(self) -> impl Iterator<Item = VarSection<'t>> {
        children(self.0)
    }
}

impl<'t> Task<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// Its settings: `INTERVAL`, `SINGLE`, `PRIORITY`.
    pub fn arguments(self) -> impl Iterator<Item = Argument<'t>> {
        self.0.children().filter(|child| child.kind() == NodeKind::ArgumentList).flat_map(children)
    }
}

impl<'t> ProgramConfiguration<'t> {
    /// The instance's name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The task that runs it.
    #[must_use]
    pub fn task(self) -> Option<Name<'t>> {
        self.0.has_token(TokenKind::With).then(|| children(self.0).nth(1)).flatten()
    }

    /// The program, with the connections of its variables as arguments.
    #[must_use]
    pub fn type_(self) -> Option<Type<'t>> {
        self.0.children().find_map(Type::cast)
    }
}
