//! Operations on strings.

use super::build::{INT, at, number, once, program, statement};
use crate::machine::program::{StatementKind, Text, TextOperation, TextOrder, Value};
use crate::semantics::scalar::Scalar;

const CHAR: Scalar = Scalar::Bits(8);

/// The source at slot 0 (`STRING(6)`), another at 7 (`STRING(3)`), the target at 11 (`STRING(5)`), a number at 17.
fn run(first: &str, second: &str, operation: TextOperation) -> Vec<u64> {
    let literal = |text: Text, value: &str| {
        statement(StatementKind::Text(Box::new(TextOperation::Literal(text, value.encode_utf16().collect()))))
    };
    let mut scalars = vec![CHAR; 17];
    scalars.push(INT);
    let cycle = vec![
        literal(target(), "#####"),
        literal(one(), first),
        literal(two(), second),
        statement(StatementKind::Text(Box::new(operation))),
    ];
    once(&program(&scalars, cycle)).expect("no fault")
}

fn text(slot: u32, capacity: u32) -> Text {
    Text { location: at(slot), capacity }
}

fn one() -> Text {
    text(0, 6)
}

fn two() -> Text {
    text(7, 3)
}

fn target() -> Text {
    text(11, 5)
}

fn int(value: i128) -> Value {
    number(INT, value)
}

/// What the target holds; behind its end there are only zeros.
fn made(first: &str, second: &str, operation: TextOperation) -> String {
    let memory = run(first, second, operation);
    let characters = &memory[11..17];
    let end = characters.iter().position(|c| *c == 0).expect("closed by a zero");
    assert!(characters[end..].iter().all(|c| *c == 0), "{characters:?}");
    characters[..end].iter().map(|c| char::from(u8::try_from(*c).expect("a byte"))).collect()
}

fn measured(first: &str, second: &str, operation: TextOperation) -> i128 {
    INT.number(run(first, second, operation)[17])
}

#[test]
fn results_are_cut_to_their_target() {
    assert_eq!(made("abc", "", TextOperation::Assign(target(), one())), "abc");
    assert_eq!(made("abcdef", "", TextOperation::Assign(target(), one())), "abcde");
    assert_eq!(made("abcdefgh", "", TextOperation::Assign(target(), one())), "abcde");
    assert_eq!(made("abc", "xyz", TextOperation::Concat(target(), one(), two())), "abcxy");
    assert_eq!(made("", "", TextOperation::Concat(target(), one(), two())), "");
}

#[test]
fn parts_of_a_text() {
    let left = |count| made("abcd", "", TextOperation::Left(target(), one(), int(count)));
    assert_eq!([left(2), left(9), left(0), left(-1)], ["ab", "abcd", "", ""]);
    let right = |count| made("abcd", "", TextOperation::Right(target(), one(), int(count)));
    assert_eq!([right(2), right(9), right(0), right(-1)], ["cd", "abcd", "", ""]);
    let mid = |count, at| made("abcd", "", TextOperation::Mid(target(), one(), int(count), int(at)));
    assert_eq!([mid(2, 2), mid(9, 3), mid(1, 5), mid(2, 0), mid(-1, 1)], ["bc", "cd", "", "", ""]);
}

#[test]
fn texts_are_changed() {
    let insert = |at| made("abc", "XY", TextOperation::Insert(target(), one(), two(), int(at)));
    assert_eq!([insert(0), insert(1), insert(3), insert(4)], ["XYabc", "aXYbc", "abcXY", "abc"]);
    let delete = |count, at| made("abcd", "", TextOperation::Delete(target(), one(), int(count), int(at)));
    assert_eq!([delete(2, 2), delete(9, 3), delete(1, 5), delete(0, 1)], ["ad", "ab", "abcd", "abcd"]);
    let replace = |count, at| made("abcd", "XY", TextOperation::Replace(target(), one(), two(), int(count), int(at)));
    assert_eq!([replace(3, 2), replace(0, 1), replace(1, 9)], ["aXY", "XYabc", "abcd"]);
}

#[test]
fn texts_are_measured() {
    let number = || at(17);
    assert_eq!(measured("abcd", "", TextOperation::Length(number(), INT, one())), 4);
    let find = |text, part| measured(text, part, TextOperation::Find(number(), INT, one(), two()));
    assert_eq!([find("abcbc", "bc"), find("abc", "x"), find("abc", ""), find("", "a")], [2, 0, 0, 0]);
    let compare = |order, left, right| {
        measured(left, right, TextOperation::Compare { target: number(), order, left: one(), right: two() })
    };
    assert_eq!(compare(TextOrder::Equal, "ab", "ab"), 1);
    assert_eq!(compare(TextOrder::Equal, "ab", "abc"), 0);
    assert_eq!(compare(TextOrder::Less, "ab", "abc"), 1);
    assert_eq!(compare(TextOrder::Less, "b", "abc"), 0);
    assert_eq!(compare(TextOrder::LessOrEqual, "abc", "abc"), 1);
}
