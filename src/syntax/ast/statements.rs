//! Statements.

use super::{AstNode, Expression, Name, Range, ast_nodes, child};
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::Node;

ast_nodes! {
    /// The statements inside a statement.
    StatementList = StatementList;
    /// `a := b;`.
    AssignStatement = AssignStatement;
    /// `IF`.
    IfStatement = IfStatement;
    /// `CASE`.
    CaseStatement = CaseStatement;
    /// One branch of it.
    CaseBranch = CaseBranch;
    /// `FOR`.
    ForStatement = ForStatement;
    /// `WHILE` or `REPEAT`.
    LoopStatement = WhileStatement | RepeatStatement;
    /// `__TRY`.
    TryStatement = TryStatement;
    /// `__CATCH(e)`.
    CatchClause = CatchClause;
}

/// Any statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statement<'t> {
    /// `a := b;`.
    Assign(AssignStatement<'t>),
    /// A call, or an expression without effect.
    Expression(Expression<'t>, Node<'t>),
    /// `IF`.
    If(IfStatement<'t>),
    /// `CASE`.
    Case(CaseStatement<'t>),
    /// `FOR`.
    For(ForStatement<'t>),
    /// `WHILE`.
    While(LoopStatement<'t>),
    /// `REPEAT`.
    Repeat(LoopStatement<'t>),
    /// `EXIT;`.
    Exit(Node<'t>),
    /// `CONTINUE;`.
    Continue(Node<'t>),
    /// `RETURN;`.
    Return(Node<'t>),
    /// `JMP label;`.
    Jump(Node<'t>),
    /// `label:`.
    Label(Node<'t>),
    /// `__TRY`.
    Try(TryStatement<'t>),
    /// `REGION`; the node holds a list of statements.
    Region(Node<'t>),
    /// `;`.
    Empty(Node<'t>),
}

impl<'t> Statement<'t> {
    /// The statement that `node` is.
    #[must_use]
    pub fn cast(node: Node<'t>) -> Option<Self> {
        Some(match node.kind() {
            NodeKind::AssignStatement => Self::Assign(AssignStatement(node)),
            NodeKind::ExpressionStatement => Self::Expression(node.children().find_map(Expression::cast)?, node),
            NodeKind::IfStatement => Self::If(IfStatement(node)),
            NodeKind::CaseStatement => Self::Case(CaseStatement(node)),
            NodeKind::ForStatement => Self::For(ForStatement(node)),
            NodeKind::WhileStatement => Self::While(LoopStatement(node)),
            NodeKind::RepeatStatement => Self::Repeat(LoopStatement(node)),
            NodeKind::ExitStatement => Self::Exit(node),
            NodeKind::ContinueStatement => Self::Continue(node),
            NodeKind::ReturnStatement => Self::Return(node),
            NodeKind::JumpStatement => Self::Jump(node),
            NodeKind::LabelStatement => Self::Label(node),
            NodeKind::TryStatement => Self::Try(TryStatement(node)),
            NodeKind::RegionStatement => Self::Region(node),
            NodeKind::EmptyStatement => Self::Empty(node),
            _ => return None,
        })
    }

    /// Its node.
    #[must_use]
    pub fn node(self) -> Node<'t> {
        match self {
            Self::Assign(it) => it.0,
            Self::If(it) => it.0,
            Self::Case(it) => it.0,
            Self::For(it) => it.0,
            Self::While(it) | Self::Repeat(it) => it.0,
            Self::Try(it) => it.0,
            Self::Expression(_, node)
            | Self::Exit(node)
            | Self::Continue(node)
            | Self::Return(node)
            | Self::Jump(node)
            | Self::Label(node)
            | Self::Region(node)
            | Self::Empty(node) => node,
        }
    }

    /// The name of a label, or of the one that is jumped to.
    #[must_use]
    pub fn label(self) -> Option<Name<'t>> {
        match self {
            Self::Label(node) | Self::Jump(node) => child(node),
            _ => None,
        }
    }

    /// The statements in a region.
    #[must_use]
    pub fn region_statements(self) -> Option<StatementList<'t>> {
        match self {
            Self::Region(node) => child(node),
            _ => None,
        }
    }
}

impl<'t> StatementList<'t> {
    /// The statements.
    pub fn statements(self) -> impl Iterator<Item = Statement<'t>> {
        self.0.children().filter_map(Statement::cast)
    }
}

/// How an assignment assigns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AssignOperator {
    /// `:=`.
    Assign,
    /// `REF=`.
    Reference,
    /// `S=`: sets where the value is true.
    Set,
    /// `R=`: resets where the value is true.
    Reset,
    /// `?=`: assigns where the types allow it at run time.
    Try,
    /// `+=`.
    Add,
    /// `-=`.
    Subtract,
    /// `*=`.
    Multiply,
    /// `/=`.
    Divide,
}

impl AssignOperator {
    /// The operator among the own tokens of `node`.
    pub(super) fn of(node: Node<'_>) -> Option<Self> {
        node.own_tokens().find_map(|token| {
            Some(match token.kind() {
                TokenKind::Assign => Self::Assign,
                TokenKind::Ref => Self::Reference,
                TokenKind::S => Self::Set,
                TokenKind::R => Self::Reset,
                TokenKind::TryAssign => Self::Try,
                TokenKind::PlusAssign => Self::Add,
                TokenKind::MinusAssign => Self::Subtract,
                TokenKind::StarAssign => Self::Multiply,
                TokenKind::SlashAssign => Self::Divide,
                _ => return None,
            })
        })
    }
}

/// The `n`th expression among the children of `node`.
fn expression<'t>(node: Node<'t>, n: usize) -> Option<Expression<'t>> {
    node.children().filter_map(Expression::cast).nth(n)
}

impl<'t> AssignStatement<'t> {
    /// What is assigned to.
    #[must_use]
    pub fn target(self) -> Option<Expression<'t>> {
        expression(self.0, 0)
    }

    /// The operator.
    #[must_use]
    pub fn operator(self) -> Option<AssignOperator> {
        AssignOperator::of(self.0)
    }

    /// What is assigned; in `a := b := c`, the assignment of `c` to `b`.
    #[must_use]
    pub fn value(self) -> Option<Expression<'t>> {
        expression(self.0, 1)
    }
}

/// `IF` or `ELSIF` with its condition and statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IfBranch<'t> {
    /// The condition.
    pub condition: Option<Expression<'t>>,
    /// The statements.
    pub statements: Option<StatementList<'t>>,
}

impl<'t> IfBranch<'t> {
    fn of(node: Node<'t>) -> Self {
        Self { condition: expression(node, 0), statements: child(node) }
    }
}

/// The statements of the `ELSE` of `node`.
fn otherwise<'t>(node: Node<'t>) -> Option<StatementList<'t>> {
    node.child(NodeKind::ElseClause).and_then(child)
}

impl<'t> IfStatement<'t> {
    /// The `IF` and every `ELSIF`, in order.
    pub fn branches(self) -> impl Iterator<Item = IfBranch<'t>> {
        let others = self.0.children().filter(|child| child.kind() == NodeKind::ElsifClause);
        std::iter::once(self.0).chain(others).map(IfBranch::of)
    }

    /// The statements of the `ELSE`.
    #[must_use]
    pub fn otherwise(self) -> Option<StatementList<'t>> {
        otherwise(self.0)
    }
}

impl<'t> CaseStatement<'t> {
    /// What is looked at.
    #[must_use]
    pub fn selector(self) -> Option<Expression<'t>> {
        expression(self.0, 0)
    }

    /// The branches.
    pub fn branches(self) -> impl Iterator<Item = CaseBranch<'t>> {
        super::children(self.0)
    }

    /// The statements of the `ELSE`.
    #[must_use]
    pub fn otherwise(self) -> Option<StatementList<'t>> {
        otherwise(self.0)
    }
}

impl<'t> CaseBranch<'t> {
    /// Its labels: an expression, or a [`Range`] (to be had with [`Range::cast`]).
    pub fn labels(self) -> impl Iterator<Item = Node<'t>> {
        self.0.children().filter(|child| Range::cast(*child).is_some() || Expression::cast(*child).is_some())
    }

    /// Its statements.
    #[must_use]
    pub fn statements(self) -> Option<StatementList<'t>> {
        child(self.0)
    }
}

impl<'t> ForStatement<'t> {
    /// The variable that counts.
    #[must_use]
    pub fn variable(self) -> Option<Expression<'t>> {
        expression(self.0, 0)
    }

    /// Its first value.
    #[must_use]
    pub fn from(self) -> Option<Expression<'t>> {
        expression(self.0, 1)
    }

    /// Its last value.
    #[must_use]
    pub fn to(self) -> Option<Expression<'t>> {
        expression(self.0, 2)
    }

    /// Its step.
    #[must_use]
    pub fn by(self) -> Option<Expression<'t>> {
        self.0.has_token(TokenKind::By).then(|| expression(self.0, 3)).flatten()
    }

    /// The statements.
    #[must_use]
    pub fn statements(self) -> Option<StatementList<'t>> {
        child(self.0)
    }
}

impl<'t> LoopStatement<'t> {
    /// The condition: of `WHILE`, to go on; of `REPEAT`, to end.
    #[must_use]
    pub fn condition(self) -> Option<Expression<'t>> {
        expression(self.0, 0)
    }

    /// The statements.
    #[must_use]
    pub fn statements(self) -> Option<StatementList<'t>> {
        child(self.0)
    }
}

impl<'t> TryStatement<'t> {
    /// The statements that are tried.
    #[must_use]
    pub fn statements(self) -> Option<StatementList<'t>> {
        child(self.0)
    }

    /// What catches.
    pub fn catches(self) -> impl Iterator<Item = CatchClause<'t>> {
        super::children(self.0)
    }

    /// The statements of `__FINALLY`.
    #[must_use]
    pub fn finally(self) -> Option<StatementList<'t>> {
        self.0.child(NodeKind::FinallyClause).and_then(child)
    }
}

impl<'t> CatchClause<'t> {
    /// The variable that takes the exception.
    #[must_use]
    pub fn variable(self) -> Option<Expression<'t>> {
        expression(self.0, 0)
    }

    /// The statements.
    #[must_use]
    pub fn statements(self) -> Option<StatementList<'t>> {
        child(self.0)
    }
}
