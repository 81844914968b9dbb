//! A broken construct costs itself and nothing else.

use rungbook::syntax::ast::{AstNode, Declaration, Pou, SourceFile, VarDecl};
use rungbook::syntax::{Entry, NodeKind, Options, Parse, parse};

const PROGRAM: &str = "\
FUNCTION_BLOCK Motor EXTENDS Drive
VAR_INPUT
    start : BOOL;
    speed : ARRAY[1..3] OF REAL := [1.0, 2(0.5)];
END_VAR
METHOD PUBLIC Run : BOOL
VAR_INPUT
    limit : REAL;
END_VAR
IF speed[1] > limit THEN
    Run := FALSE;
END_IF
END_METHOD
CASE state OF
    1: timer(IN := start, Q => done);
ELSE
    done := TRUE;
END_CASE
END_FUNCTION_BLOCK

TYPE
    Colour : (Red, Green := 5) UINT;
    Box : STRUCT
        width : REAL;
        height : REAL;
    END_STRUCT;
END_TYPE

VAR_GLOBAL
    first : INT;
    second : INT;
END_VAR

FUNCTION Twice : INT
VAR_INPUT
    number : INT;
END_VAR
Twice := 2 * number;
END_FUNCTION
";

fn read(text: &str) -> Parse {
    parse(text, Entry::File, &Options::default())
}

/// The names of everything that is declared, in order.
fn declared(parse: &Parse) -> Vec<String> {
    let named = |kind| {
        matches!(kind, NodeKind::FunctionBlock | NodeKind::Function | NodeKind::Method | NodeKind::TypeDecl)
            || matches!(kind, NodeKind::VarDecl | NodeKind::Field | NodeKind::EnumValue)
    };
    let owners = parse.tree.root().descendants().filter(|node| named(node.kind()));
    let names = owners.flat_map(|node| node.children().filter(|child| child.kind() == NodeKind::Name));
    names.map(|name| name.text().to_owned()).collect()
}

#[test]
fn without_any_one_token_little_is_lost() {
    let whole = read(PROGRAM);
    assert_eq!(whole.errors, []);
    let names = declared(&whole);
    assert_eq!(names.len(), 15);
    for token in whole.tree.tokens().filter(|token| !token.kind().is_trivia()) {
        let span = token.span().range();
        let text = format!("{}{}", &PROGRAM[..span.start], &PROGRAM[span.end..]);
        let left = declared(&read(&text));
        let lost: Vec<&String> = names.iter().filter(|name| !left.contains(name)).collect();
        // A section or a type that has lost its opening keyword loses what is in it.
        let opens = ["VAR_INPUT", "VAR_GLOBAL", "TYPE", "STRUCT", "("].contains(&token.text());
        let most = if opens { 6 } else { 1 };
        assert!(lost.len() <= most, "without {token:?} at {}: {lost:?}", span.start);
    }
}

#[test]
fn with_any_keyword_too_much_little_is_lost() {
    let whole = read(PROGRAM);
    let names = declared(&whole);
    let words = ["END_IF", "END_VAR", "THEN", ")", "(", ";", ":=", "ELSE", "x", "END_CASE", "]", "OF", "§", "1"];
    for token in whole.tree.tokens().filter(|token| !token.kind().is_trivia()) {
        for word in words {
            let at = token.span().start as usize;
            let text = format!("{}{word} {}", &PROGRAM[..at], &PROGRAM[at..]);
            let left = declared(&read(&text));
            let lost: Vec<&String> = names.iter().filter(|name| !left.contains(name)).collect();
            // `TYPE :=` looks like an assignment to a variable of that name.
            let hidden = word == ":=" && PROGRAM[..at].trim_end().ends_with("\nTYPE");
            let most = if hidden { 6 } else { 3 };
            assert!(lost.len() <= most, "with {word} before {token:?} at {at}: {lost:?}");
        }
    }
}

#[test]
fn every_broken_program_has_an_error() {
    for (text, code) in [
        ("PROGRAM P VAR a : INT; END_VAR", "missing-end"),
        ("PROGRAM P a := 1 END_PROGRAM", "missing-semicolon"),
        ("PROGRAM P a := 'x; END_PROGRAM", "unterminated-string"),
        ("PROGRAM P END_PROGRAM (* ", "unterminated-comment"),
        ("PROGRAM P END_PROGRAM { ", "unterminated-comment"),
        ("PROGRAM P a b c; END_PROGRAM", "unreadable-construct"),
        ("PROGRAM P IF a THEN END_PROGRAM", "missing-end"),
    ] {
        let errors = read(text).errors;
        assert!(errors.iter().any(|error| error.code.name == code), "{text}: {errors:?}");
    }
}

#[test]
fn a_declaration_needs_no_end_where_its_container_ends_it() {
    let text = "FUNCTION_BLOCK A VAR a : INT; END_VAR";
    assert_eq!(parse(text, Entry::Declaration, &Options::default()).errors, []);
    assert_eq!(read(text).errors.len(), 1);
}

#[test]
fn statements_after_a_broken_one_are_read() {
    let text = "a := (1 + ;\nb := 2;\nIF c THEN d := ; e := 1; END_IF\nf(x, ;\ng := 3;";
    let parse = parse(text, Entry::Body, &Options::default());
    let body = SourceFile::of(&parse.tree).body().expect("a body");
    let texts: Vec<&str> =
        body.node().descendants().filter(|n| n.kind() == NodeKind::AssignStatement).map(|n| n.text()).collect();
    for whole in ["b := 2;", "e := 1;", "g := 3;"] {
        assert!(texts.contains(&whole), "{whole} in {texts:?}");
    }
}

#[test]
fn the_number_of_errors_is_bounded() {
    let parse = read(&") § ".repeat(20_000));
    assert!(!parse.errors.is_empty() && parse.errors.len() <= 1000);
}

#[test]
fn handles_survive_missing_parts() {
    let parse = read("FUNCTION_BLOCK\nVAR_INPUT : ; x : ; END_VAR END_FUNCTION_BLOCK FUNCTION END_FUNCTION");
    let pous: Vec<Pou<'_>> = parse.tree.root().descendants().filter_map(Pou::cast).collect();
    assert_eq!(pous.len(), 2);
    assert!(pous.iter().all(|pou| pou.name().is_none() && pou.return_type().is_none() && pou.body().is_none()));
    let variables: Vec<VarDecl<'_>> = parse.tree.root().descendants().filter_map(VarDecl::cast).collect();
    assert!(variables.iter().all(|variable| variable.type_().is_none() && variable.initial().is_none()));
    assert!(matches!(SourceFile::of(&parse.tree).declarations().next(), Some(Declaration::Pou(_))));
}
