//! Random typed expressions: evaluated on values, and as terms on the same values.

use proptest::prelude::*;
use rungbook::logic::eval::evaluate as term_value;
use rungbook::logic::term::{Node, Pool, Term};
use rungbook::semantics::encode::encode;
use rungbook::semantics::eval::{FaultAt, Leaves, evaluate};
use rungbook::semantics::expr::{Expr, ExprKind, Op};
use rungbook::semantics::scalar::Scalar;

use super::agree::brief;
use super::choices::{Choices, SCALARS};

/// What an expression may read.
pub(super) trait Vocabulary {
    type Leaf;

    /// A leaf of the type, if there is one.
    fn leaf(&self, choices: &mut Choices<'_>, scalar: Scalar, depth: u32) -> Option<ExprKind<Self::Leaf>>;
}

/// A random expression of the type.
pub(super) fn expression<V: Vocabulary>(
    words: &V,
    choices: &mut Choices<'_>,
    scalar: Scalar,
    depth: u32,
) -> Expr<V::Leaf> {
    let kind = kind(words, choices, scalar, depth);
    Expr { kind, scalar, place: choices.place() }
}

fn kind<V: Vocabulary>(words: &V, choices: &mut Choices<'_>, scalar: Scalar, depth: u32) -> ExprKind<V::Leaf> {
    let simple = depth == 0 || choices.once_in(4);
    if simple || scalar == Scalar::Ref {
        if !choices.once_in(4)
            && let Some(leaf) = words.leaf(choices, scalar, depth)
        {
            return leaf;
        }
        return ExprKind::Const(if scalar == Scalar::Ref { 0 } else { choices.bits(scalar) });
    }
    let make = |choices: &mut Choices<'_>, scalar| Box::new(expression(words, choices, scalar, depth - 1));
    match choices.below(12) {
        0 if scalar == Scalar::Bool => {
            let (left, right) = (make(choices, scalar), make(choices, scalar));
            ExprKind::AndThen(left, right)
        }
        1 if scalar == Scalar::Bool => {
            let (left, right) = (make(choices, scalar), make(choices, scalar));
            ExprKind::OrElse(left, right)
        }
        2 => {
            let condition = make(choices, Scalar::Bool);
            let (then, otherwise) = (make(choices, scalar), make(choices, scalar));
            ExprKind::If(condition, then, otherwise)
        }
        _ => {
            let (op, operands) = operator(choices, scalar);
            let mut terms: Vec<_> = operands.into_iter().map(|scalar| *make(choices, scalar)).collect();
            if op == Op::Bit {
                let number = choices.below(terms[0].scalar.width());
                let scalar = Scalar::Int { signed: true, width: 16 };
                terms.push(Expr { kind: ExprKind::Const(u64::from(number)), scalar, place: None });
            }
            if matches!(op, Op::Div | Op::Mod) && !matches!(scalar, Scalar::Real(_)) && !choices.once_in(4) {
                // Mostly no division by zero.
                let divisor = terms.pop().into_iter().chain([constant(choices, scalar, 1)]).collect();
                terms.push(Expr { kind: ExprKind::Apply(Op::Or, divisor), scalar, place: choices.place() });
            }
            ExprKind::Apply(op, terms)
        }
    }
}

/// A number as a constant.
pub(super) fn constant<L>(choices: &mut Choices<'_>, scalar: Scalar, number: i128) -> Expr<L> {
    Expr { kind: ExprKind::Const(scalar.bits(number)), scalar, place: choices.place() }
}

/// An operator with a result of the type, and the types of its operands.
fn operator(choices: &mut Choices<'_>, scalar: Scalar) -> (Op, Vec<Scalar>) {
    let other = choices.scalar();
    if choices.once_in(5) {
        return (Op::Select, vec![Scalar::Bool, scalar, scalar]);
    }
    if choices.once_in(4) {
        let same: Vec<Scalar> = choices.scalars().iter().copied().filter(|s| s.width() == scalar.width()).collect();
        return match choices.below(3) {
            0 => (Op::Reinterpret, vec![choices.one(&same)]),
            1 if !matches!(scalar, Scalar::Real(_)) && !choices.integers_only => {
                (Op::Trunc, vec![choices.one(&[Scalar::Real(32), Scalar::Real(64)])])
            }
            _ => (Op::Convert, vec![other]),
        };
    }
    match scalar {
        Scalar::Bool => match choices.below(8) {
            0 => (Op::Eq, vec![other; 2]),
            1 => (Op::Lt, vec![other; 2]),
            2 => (Op::Le, vec![other; 2]),
            3 => (Op::Not, vec![scalar]),
            4 => (Op::Or, vec![scalar; 2]),
            5 => (Op::Xor, vec![scalar; 2]),
            6 if !matches!(other, Scalar::Real(_)) => (Op::Bit, vec![other]),
            _ => (Op::And, vec![scalar; 2]),
        },
        Scalar::Real(_) => match choices.below(7) {
            0 => (Op::Add, vec![scalar; 2]),
            1 => (Op::Sub, vec![scalar; 2]),
            2 => (Op::Mul, vec![scalar; 2]),
            3 => (Op::Div, vec![scalar; 2]),
            4 => (Op::Neg, vec![scalar]),
            5 => (Op::Abs, vec![scalar]),
            _ => (Op::Sqrt, vec![scalar]),
        },
        _ => whole_operator(choices, scalar),
    }
}

fn whole_operator(choices: &mut Choices<'_>, scalar: Scalar) -> (Op, Vec<Scalar>) {
    let unary = [Op::Neg, Op::Not, Op::Abs];
    let binary = [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Mod, Op::And, Op::Or, Op::Xor];
    let shifts = [Op::Shl, Op::Shr, Op::Sar, Op::Rol, Op::Ror];
    match choices.below(4) {
        0 => (choices.one(&unary), vec![scalar]),
        1 => {
            let whole: Vec<Scalar> = SCALARS.into_iter().filter(|s| matches!(s, Scalar::Int { .. })).collect();
            (choices.one(&shifts), vec![scalar, choices.one(&whole)])
        }
        _ => (choices.one(&binary), vec![scalar; 2]),
    }
}

/// Leaves by number, each with its type.
struct Numbers;

const LEAVES: u32 = 3;

impl Vocabulary for Numbers {
    type Leaf = (Scalar, u32);

    fn leaf(&self, choices: &mut Choices<'_>, scalar: Scalar, _: u32) -> Option<ExprKind<Self::Leaf>> {
        Some(ExprKind::Read((scalar, choices.below(LEAVES))))
    }
}

/// The values of the leaves.
struct Given(Vec<u64>);

fn slot((scalar, number): &(Scalar, u32)) -> usize {
    let at = SCALARS.iter().position(|other| other == scalar).expect("a type of the list");
    at * LEAVES as usize + *number as usize
}

impl Leaves<(Scalar, u32)> for Given {
    fn read(&mut self, leaf: &(Scalar, u32)) -> Result<u64, FaultAt> {
        Ok(self.0[slot(leaf)])
    }

    fn address(&mut self, leaf: &(Scalar, u32)) -> Result<u64, FaultAt> {
        Ok(slot(leaf) as u64 + 1)
    }
}

fn agree(stream: &[u32]) -> Result<(), TestCaseError> {
    let mut choices = Choices::new(stream);
    let scalar = choices.scalar();
    let tree = expression(&Numbers, &mut choices, scalar, 5);
    let mut pool = Pool::default();
    let leaves: Vec<Term> = SCALARS
        .iter()
        .flat_map(|scalar| (0..LEAVES).map(|number| (*scalar, number)))
        .map(|(scalar, number)| pool.variable(scalar.width(), format!("{scalar:?} {number}")))
        .collect();
    let encoded = encode(&mut pool, &tree, &mut |_, leaf| leaves[slot(leaf)])
        .map_err(|error| TestCaseError::fail(format!("{error:?}")))?;
    for _ in 0..4 {
        let values: Vec<u64> =
            SCALARS.iter().flat_map(|scalar| [*scalar; LEAVES as usize]).map(|scalar| choices.bits(scalar)).collect();
        let value = |term: Term| {
            term_value(&pool, term, |var| {
                let at = leaves.iter().position(|leaf| pool.node(*leaf) == Node::Var(var));
                values[at.expect("the variable of a leaf")]
            })
        };
        let fault = encoded.faults.iter().find(|fault| value(fault.condition) == 1);
        match evaluate(&tree, &mut Given(values.clone())) {
            Ok(expected) => {
                prop_assert_eq!(fault, None, "{}", brief(&tree));
                prop_assert_eq!(value(encoded.value), expected, "{} on {:?}", brief(&tree), values);
            }
            Err(at) => {
                prop_assert_eq!(
                    fault.map(|fault| (fault.fault, fault.place)),
                    Some((at.fault, at.place)),
                    "{:#?}",
                    tree
                );
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: super::agree::cases(2_000), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn expressions_mean_the_same_on_values_and_as_terms(stream in prop::collection::vec(any::<u32>(), 0..400)) {
        agree(&stream)?;
    }
}
