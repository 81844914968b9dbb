//! Bodies: statements, the steps of a chart, or instructions.

use super::{AstNode, Expression, Name, Pou, Statement, Transition, ast_nodes, child, children, name_text, own_name};
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::{Node, Token};

ast_nodes! {
    /// What a declaration does.
    Body = Body;
    /// `INITIAL_STEP` or `STEP`.
    Step = Step;
    /// `Motor(N);` in a step.
    ActionAssociation = ActionAssociation;
    /// The instructions of a body in Instruction List.
    InstructionList = InstructionList;
    /// One instruction.
    Instruction = Instruction;
}

/// What stands in a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyItem<'t> {
    /// A statement.
    Statement(Statement<'t>),
    /// A step.
    Step(Step<'t>),
    /// A transition between steps.
    Transition(Transition<'t>),
    /// An action among the steps.
    Action(Pou<'t>),
    /// Instructions; they are then all of the body.
    Instructions(InstructionList<'t>),
}

impl<'t> Body<'t> {
    /// What stands in it, in order.
    pub fn items(self) -> impl Iterator<Item = BodyItem<'t>> {
        self.0.children().filter_map(|child| {
            Some(match child.kind() {
                NodeKind::Step => BodyItem::Step(Step(child)),
                NodeKind::Transition => BodyItem::Transition(Transition::cast(child)?),
                NodeKind::Action => BodyItem::Action(Pou::cast(child)?),
                NodeKind::InstructionList => BodyItem::Instructions(InstructionList(child)),
                _ => BodyItem::Statement(Statement::cast(child)?),
            })
        })
    }

    /// Its statements.
    pub fn statements(self) -> impl Iterator<Item = Statement<'t>> {
        self.0.children().filter_map(Statement::cast)
    }

    /// Its steps.
    pub fn steps(self) -> impl Iterator<Item = Step<'t>> {
        children(self.0)
    }

    /// Its transitions.
    pub fn transitions(self) -> impl Iterator<Item = Transition<'t>> {
        children(self.0)
    }

    /// Its instructions, where it is written in Instruction List.
    #[must_use]
    pub fn instructions(self) -> Option<InstructionList<'t>> {
        child(self.0)
    }

    /// Whether it is a chart.
    #[must_use]
    pub fn is_chart(self) -> bool {
        self.steps().next().is_some() || self.transitions().next().is_some()
    }
}

impl<'t> Step<'t> {
    /// Whether the chart begins here.
    #[must_use]
    pub fn is_initial(self) -> bool {
        self.0.has_token(TokenKind::InitialStep)
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// What it does while it is active.
    pub fn actions(self) -> impl Iterator<Item = ActionAssociation<'t>> {
        children(self.0)
    }
}

impl<'t> ActionAssociation<'t> {
    /// The action's or the variable's name, the parts of a path in their order.
    pub fn names(self) -> impl Iterator<Item = Name<'t>> {
        children(self.0)
    }

    /// `N`, `S`, `L` and so on.
    #[must_use]
    pub fn qualifier(self) -> Option<&'t str> {
        own_name(self.0).map(name_text)
    }

    /// The time, and the variables that tell that the action is done.
    pub fn arguments(self) -> impl Iterator<Item = Expression<'t>> {
        self.0.children().filter_map(Expression::cast)
    }
}

impl<'t> InstructionList<'t> {
    /// The instructions.
    pub fn instructions(self) -> impl Iterator<Item = Instruction<'t>> {
        children(self.0)
    }
}

impl<'t> Instruction<'t> {
    /// The label before it.
    #[must_use]
    pub fn label(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// Its operator's tokens: one word, or the parts of a method's name.
    pub fn operator(self) -> impl Iterator<Item = Token<'t>> {
        self.0.own_tokens().filter(|token| token.kind() == TokenKind::Ident)
    }

    /// Its operands.
    pub fn operands(self) -> impl Iterator<Item = Expression<'t>> {
        self.0.children().filter_map(Expression::cast)
    }

    /// The arguments in its parentheses.
    pub fn arguments(self) -> impl Iterator<Item = super::Argument<'t>> {
        self.0.children().filter(|child| child.kind() == NodeKind::ArgumentList).flat_map(children)
    }

    /// The instructions in its parentheses.
    pub fn nested(self) -> impl Iterator<Item = Instruction<'t>> {
        children(self.0)
    }

    /// Its node.
    #[must_use]
    pub const fn syntax(self) -> Node<'t> {
        self.0
    }
}
