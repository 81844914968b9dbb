//! The typed access: what the accessors find.

use rungbook::syntax::ast::{
    self, ArgumentKind, AssignOperator, AstNode, BinaryOperator, BodyItem, Declaration, Dimension, Expression,
    Modifier, Pou, PouKind, Qualifier, SectionKind, SourceFile, Statement, Type, UnaryOperator, VarDecl,
};
use rungbook::syntax::{Entry, Options, Parse, TokenKind, parse};

fn file(text: &str) -> Parse {
    let parse = parse(text, Entry::File, &Options::default());
    assert_eq!(parse.errors, [], "{text}");
    parse
}

fn body(text: &str) -> Parse {
    let parse = parse(text, Entry::Body, &Options::default());
    assert_eq!(parse.errors, [], "{text}");
    parse
}

fn statements(parse: &Parse) -> Vec<Statement<'_>> {
    SourceFile::of(&parse.tree).body().map(|body| body.statements().collect()).unwrap_or_default()
}

fn first_pou(parse: &Parse) -> Pou<'_> {
    let found = SourceFile::of(&parse.tree).declarations().find_map(|declaration| match declaration {
        Declaration::Pou(pou) => Some(pou),
        _ => None,
    });
    found.expect("a POU")
}

fn variables(parse: &Parse) -> Vec<VarDecl<'_>> {
    SourceFile::of(&parse.tree).variables().collect()
}

fn type_text(kind: Option<Type<'_>>) -> &str {
    kind.map_or("", |kind| kind.node().text())
}

#[test]
fn a_function_block_with_everything() {
    let parse = file(
        "{attribute 'hide'}\nFUNCTION_BLOCK PUBLIC ABSTRACT Motor EXTENDS plant . Drive IMPLEMENTS IRun, INamed\n\
         VAR_INPUT CONSTANT a : INT; END_VAR VAR b : BOOL; END_VAR\n\
         METHOD PROTECTED Run : REAL END_METHOD METHOD Stop END_METHOD\n\
         PROPERTY Speed : REAL GET END_GET SET x := 1; END_SET END_PROPERTY\n\
         ACTION Reset: y := 1; END_ACTION\n z := 1; END_FUNCTION_BLOCK",
    );
    let pou = first_pou(&parse);
    assert_eq!(pou.kind(), PouKind::FunctionBlock);
    assert_eq!(pou.name().map(|name| name.text()), Some("Motor"));
    assert_eq!(pou.modifiers().collect::<Vec<_>>(), [Modifier::Public, Modifier::Abstract]);
    assert_eq!(pou.extends().map(|path| path.text()).collect::<Vec<_>>(), ["plant.Drive"]);
    assert_eq!(pou.implements().map(|path| path.text()).collect::<Vec<_>>(), ["IRun", "INamed"]);
    assert!(pou.header_span().of(parse.tree.text()).ends_with("IRun, INamed"));
    let sections: Vec<_> = pou.var_sections().map(|section| (section.kind(), section.is_constant())).collect();
    assert_eq!(sections, [(SectionKind::Input, true), (SectionKind::Local, false)]);
    let methods: Vec<_> = pou.methods().map(|m| (m.name().map(|n| n.text()), type_text(m.return_type()))).collect();
    assert_eq!(methods, [(Some("Run"), "REAL"), (Some("Stop"), "")]);
    let property = pou.properties().next().expect("a property");
    assert!(property.has_get() && property.has_set() && !property.is_accessor());
    assert_eq!(type_text(property.type_()), "REAL");
    assert_eq!(property.accessors().filter_map(|accessor| accessor.body()).count(), 1);
    assert_eq!(pou.actions().filter_map(|action| action.body()).count(), 1);
    assert_eq!(pou.body().map(|body| body.node().text()), Some("z := 1;"));
    assert_eq!(pou.pragmas().iter().map(|pragma| ast::pragma_text(*pragma)).collect::<Vec<_>>(), ["attribute 'hide'"]);
}

#[test]
fn a_variable_with_everything() {
    let parse = file(
        "VAR_GLOBAL RETAIN PERSISTENT\n a, b AT %QX0.1 : BOOL := TRUE;\n\
         {attribute 'one'} {attribute 'two'}\n c : ARRAY[1..3, *] OF POINTER TO STRING[80]; {info 'c'}\n\
         d : plant.Motor(1, name := 'm'); e : BOOL R_EDGE; f : REFERENCE TO INT REF= x; END_VAR",
    );
    let all = variables(&parse);
    assert_eq!(all.len(), 5);
    assert_eq!(all[0].names().map(|name| name.text()).collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(all[0].address().map(|address| address.text()), Some("%QX0.1"));
    assert_eq!((all[0].address_of(0), all[0].address_of(1).map(|a| a.text())), (None, Some("%QX0.1")));
    assert_eq!(all[0].initial().map(|value| value.node().text()), Some("TRUE"));
    assert_eq!(all[1].pragmas().len(), 2);
    assert_eq!(all[2].pragmas(), [], "a pragma behind a declaration belongs to it");
    let Some(Type::Array(array)) = all[1].type_() else { panic!("an array") };
    let dimensions: Vec<Dimension<'_>> = array.dimensions().collect();
    let Dimension::Range(range) = dimensions[0] else { panic!("a range") };
    assert_eq!((range.low().map(|e| e.node().text()), range.high().map(|e| e.node().text())), (Some("1"), Some("3")));
    assert_eq!(dimensions[1], Dimension::Open);
    let pointed = array.element().and_then(Type::target);
    assert!(matches!(pointed, Some(Type::String(string)) if string.length().is_some() && !string.is_wide()));
    let arguments: Vec<_> = all[2].constructor_arguments().map(|a| (a.kind(), a.name().map(|n| n.text()))).collect();
    assert_eq!(arguments, [(ArgumentKind::Positional, None), (ArgumentKind::Input, Some("name"))]);
    assert!(all[3].has_rising_edge() && !all[3].has_falling_edge());
    assert!(all[4].is_reference_assignment() && all[4].initial().is_some());
    let Some(Declaration::Variables(section)) = SourceFile::of(&parse.tree).declarations().next() else { panic!() };
    assert!(section.has(Qualifier::Retain) && section.has(Qualifier::Persistent) && !section.is_constant());
}

#[test]
fn types_of_every_kind() {
    let parse = file(
        "TYPE\n A : (X, Y := 2) UINT := Y;\n B : INT(0..9);\n C EXTENDS D : STRUCT u, v : REAL; END_STRUCT;\n\
         E : UNION w : WORD; END_UNION;\n F : plant.G;\nEND_TYPE",
    );
    let Some(Declaration::Types(block)) = SourceFile::of(&parse.tree).declarations().next() else { panic!() };
    let types: Vec<_> = block.types().collect();
    let Some(Type::Enum(colours)) = types[0].type_() else { panic!("an enumeration") };
    let values: Vec<_> =
        colours.values().map(|value| (value.name().map(|n| n.text()), value.value().is_some())).collect();
    assert_eq!(values, [(Some("X"), false), (Some("Y"), true)]);
    assert_eq!(colours.base().and_then(|base| base.path()).map(|path| path.text()).as_deref(), Some("UINT"));
    assert_eq!(types[0].initial().map(|value| value.node().text()), Some("Y"));
    assert!(
        matches!(types[1].type_(), Some(Type::Subrange(range)) if range.base().is_some() && range.range().is_some())
    );
    assert_eq!(types[2].extends().map(|path| path.text()).collect::<Vec<_>>(), ["D"]);
    assert!(matches!(types[2].type_(), Some(Type::Struct(s)) if !s.is_union() && s.fields().count() == 1));
    assert!(matches!(types[3].type_(), Some(Type::Struct(s)) if s.is_union()));
    let Some(Type::Named(named)) = types[4].type_() else { panic!("a name") };
    let last = named.path().and_then(|path| path.last()).expect("a name");
    assert_eq!((last.text, last.span.of(parse.tree.text())), ("G", "G"));
}

#[test]
fn statements_of_every_kind() {
    let parse = body(
        "IF a THEN x; ELSIF b THEN ELSE y; END_IF CASE c OF 1, 3..5: x; ELSE y; END_CASE\n\
         FOR i := 1 TO 9 BY 2 DO x; END_FOR FOR i := 1 TO 9 DO END_FOR WHILE a DO x; END_WHILE REPEAT x; UNTIL b END_REPEAT\n\
         EXIT; CONTINUE; RETURN; again: JMP again; __TRY x; __CATCH(e) y; __FINALLY z; __ENDTRY; ;",
    );
    let all = statements(&parse);
    assert_eq!(all.len(), 13);
    let Statement::If(choice) = all[0] else { panic!("IF") };
    let branches: Vec<_> =
        choice.branches().map(|b| b.statements.map_or(0, |list| list.statements().count())).collect();
    assert_eq!(branches, [1, 0]);
    assert!(choice.branches().all(|branch| branch.condition.is_some()) && choice.otherwise().is_some());
    let Statement::Case(case) = all[1] else { panic!("CASE") };
    let labels: Vec<&str> = case.branches().flat_map(|branch| branch.labels()).map(|label| label.text()).collect();
    assert_eq!(labels, ["1", "3..5"]);
    assert!(case.selector().is_some() && case.otherwise().is_some());
    let Statement::For(counted) = all[2] else { panic!("FOR") };
    let parts = [counted.variable(), counted.from(), counted.to(), counted.by()];
    assert_eq!(parts.map(|part| part.map_or("", |e| e.node().text())), ["i", "1", "9", "2"]);
    assert!(matches!(all[3], Statement::For(plain) if plain.by().is_none() && plain.statements().is_some()));
    assert!(matches!(all[4], Statement::While(it) if it.condition().is_some() && it.statements().is_some()));
    assert!(matches!(all[5], Statement::Repeat(it) if it.condition().is_some() && it.statements().is_some()));
    assert!(matches!((all[6], all[7], all[8]), (Statement::Exit(_), Statement::Continue(_), Statement::Return(_))));
    assert_eq!(all[9].label().map(|name| name.text()), Some("again"));
    assert_eq!(all[10].label().map(|name| name.text()), Some("again"));
    let Statement::Try(attempt) = all[11] else { panic!("__TRY") };
    assert!(attempt.catches().all(|clause| clause.variable().is_some() && clause.statements().is_some()));
    assert!(attempt.statements().is_some() && attempt.finally().is_some());
    assert!(matches!(all[12], Statement::Empty(_)));
}

#[test]
fn assignments_of_every_kind() {
    let parse = body("a := b; a REF= b; a S= b; a R= b; a ?= b; a += b; a -= b; a *= b; a /= b; a := b := c;");
    let found: Vec<_> = statements(&parse)
        .iter()
        .map(|statement| match statement {
            Statement::Assign(it) if it.target().is_some() && it.value().is_some() => it.operator(),
            _ => None,
        })
        .collect();
    let wanted = [
        AssignOperator::Assign,
        AssignOperator::Reference,
        AssignOperator::Set,
        AssignOperator::Reset,
        AssignOperator::Try,
        AssignOperator::Add,
        AssignOperator::Subtract,
        AssignOperator::Multiply,
        AssignOperator::Divide,
        AssignOperator::Assign,
    ];
    assert_eq!(found, wanted.map(Some));
    let Some(Statement::Assign(chain)) = statements(&parse).last().copied() else { panic!() };
    assert!(matches!(chain.value(), Some(Expression::Assign(inner)) if inner.value().is_some()));
}

/// A small evaluator shape: every expression as a fully parenthesised text.
fn spell(expression: Option<Expression<'_>>) -> String {
    let Some(expression) = expression else { return "?".to_owned() };
    match expression {
        Expression::Name(it) => it.text().to_owned(),
        Expression::Field(it) => format!("{}.{}", spell(it.base()), it.field()),
        Expression::Bit(it) => format!("{}.bit{}", spell(it.base()), it.selector().map_or("", |t| t.text())),
        Expression::Index(it) => {
            format!("{}{:?}", spell(it.base()), it.indices().map(|i| spell(Some(i))).collect::<Vec<_>>())
        }
        Expression::Deref(_) => format!("{}^", spell(expression.inner())),
        Expression::Call(it) => {
            let arguments = it.arguments().map(|argument| {
                let name = argument.name().map_or("", |name| name.text());
                format!("{name}{:?}{}", argument.kind(), argument.value().map_or(String::new(), |v| spell(Some(v))))
            });
            format!("{}({})", spell(it.callee()), arguments.collect::<Vec<_>>().join(" "))
        }
        Expression::Unary(it) => {
            format!("({:?} {})", it.operator().unwrap_or(UnaryOperator::Plus), spell(it.operand()))
        }
        Expression::Binary(it) => {
            format!("({} {:?} {})", spell(it.left()), it.operator().unwrap_or(BinaryOperator::Or), spell(it.right()))
        }
        Expression::Paren(_) => spell(expression.inner()),
        Expression::Assign(it) => format!("({} := {})", spell(it.target()), spell(it.value())),
        Expression::Literal(it) => {
            let minus = if it.is_negative() { "-" } else { "" };
            format!("{}{minus}{}", it.type_prefix().unwrap_or(""), it.value().map_or("", |token| token.text()))
        }
        Expression::EnumLiteral(it) => format!("{}#{}", it.type_name(), it.value()),
        Expression::Address(token, _) => token.text().to_owned(),
        Expression::This(_) => "this".to_owned(),
        Expression::Super(_) => "super".to_owned(),
        Expression::Array(it) => format!("{:?}", it.elements().map(|e| spell(Some(e))).collect::<Vec<_>>()),
        Expression::Struct(it) => {
            let fields = it.fields().map(|f| format!("{}={}", f.name().map_or("", |n| n.text()), spell(f.value())));
            format!("{{{}}}", fields.collect::<Vec<_>>().join(" "))
        }
        Expression::Repeat(it) => {
            format!("{}*{:?}", spell(it.count()), it.values().map(|e| spell(Some(e))).collect::<Vec<_>>())
        }
    }
}

#[test]
fn expressions_of_every_kind() {
    for (text, wanted) in [
        ("a.b^.c[1, i].3", r#"a.b^.c["1", "i"].bit3"#),
        ("a.%X3", "a.bit%X3"),
        ("THIS^.x + SUPER^.f()", "(this^.x Add super^.f())"),
        ("f(1, b := 2, c => d, NOT e => f, g :=)", "f(Positional1 bInput2 cOutputd eNegatedOutputf gInput)"),
        ("f(, 2)", "f(Positional Positional2)"),
        ("-a ** 2", "((Negate a) Power 2)"),
        ("NOT a AND b", "((Not a) And b)"),
        ("a OR b AND c XOR d", "(a Or ((b And c) Xor d))"),
        ("a + b * c - d", "((a Add (b Multiply c)) Subtract d)"),
        ("a < b = (c >= d)", "((a Less b) Equal (c GreaterEqual d))"),
        ("a AND_THEN b OR_ELSE c", "((a AndThen b) OrElse c)"),
        ("a MOD b / c", "((a Modulo b) Divide c)"),
        ("INT#-5", "INT-5"),
        ("Colour#Red", "Colour#Red"),
        ("plant.Colour#Red", "Colour#Red"),
        ("T#1.5s", "T#1.5s"),
        ("%IX0.1", "%IX0.1"),
        ("[1, 2(0, 1), (a := 1)]", r#"["1", "2*[\"0\", \"1\"]", "{a=1}"]"#),
        ("(a := 1, b := (c := 2))", "{a=1 b={c=2}}"),
        ("(a := b)", "(a := b)"),
        ("#local", "local"),
        ("\"a b\".c", "a b.c"),
        (".global", "global"),
        ("NULL", "NULL"),
    ] {
        let parse = parse(text, Entry::Expression, &Options::default());
        assert_eq!(parse.errors, [], "{text}");
        assert_eq!(spell(SourceFile::of(&parse.tree).expression()), wanted, "{text}");
    }
}

#[test]
fn charts_and_instructions() {
    let parse = body(
        "INITIAL_STEP a: x(N); y(L, T#1s); END_STEP STEP b: END_STEP\n\
         TRANSITION t (PRIORITY := 2) FROM (a, b) TO a := c; END_TRANSITION ACTION x: z := 1; END_ACTION",
    );
    let chart = SourceFile::of(&parse.tree).body().expect("a body");
    assert!(chart.is_chart() && chart.items().count() == 4);
    let step = chart.steps().next().expect("a step");
    assert!(step.is_initial() && step.name().map(|name| name.text()) == Some("a"));
    let actions: Vec<_> =
        step.actions().map(|a| (a.names().next().map(|n| n.text()), a.qualifier(), a.arguments().count())).collect();
    assert_eq!(actions, [(Some("x"), Some("N"), 0), (Some("y"), Some("L"), 1)]);
    let transition = chart.transitions().next().expect("a transition");
    assert_eq!(transition.from().map(|name| name.text()).collect::<Vec<_>>(), ["a", "b"]);
    assert_eq!(transition.to().map(|name| name.text()).collect::<Vec<_>>(), ["a"]);
    assert_eq!(transition.priority().map(|e| e.node().text()), Some("2"));
    assert_eq!(transition.condition().map(|e| e.node().text()), Some("c"));

    let parse = body("start: LD a\nAND( b\nOR c\n)\nCAL t(IN := a)\nST d");
    let Some(BodyItem::Instructions(list)) = SourceFile::of(&parse.tree).body().and_then(|b| b.items().next()) else {
        panic!("instructions")
    };
    let all: Vec<_> = list.instructions().collect();
    let operators: Vec<&str> = all.iter().flat_map(|i| i.operator()).map(|token| token.text()).collect();
    assert_eq!(operators, ["LD", "AND", "CAL", "ST"]);
    assert_eq!(all[0].label().map(|name| name.text()), Some("start"));
    assert_eq!((all[1].operands().count(), all[1].nested().count()), (1, 1));
}

#[test]
fn comments_can_be_found_around_a_declaration() {
    let text = "VAR_GLOBAL\n    // before\n    a : INT; // behind\n    (* next *) b : INT;\nEND_VAR";
    let parse = file(text);
    let tree = &parse.tree;
    let a = variables(&parse)[0].node();
    let comment = |kind: TokenKind| kind.is_comment();
    let before: Vec<&str> =
        tree.trivia_before(a.first_token()).filter(|t| comment(t.kind())).map(|t| t.text()).collect();
    let line = tree.trivia_after(a.end_token()).take_while(|t| t.kind() != TokenKind::Newline);
    let behind: Vec<&str> = line.filter(|t| comment(t.kind())).map(|t| t.text()).collect();
    assert_eq!((before, behind), (vec!["// before"], vec!["// behind"]));
    assert_eq!(a.text(), "a : INT;");
    assert_eq!(tree.innermost(a.span().start).text(), "a");
    assert_eq!(tree.token_at(0).map(|token| token.text()), Some("VAR_GLOBAL"));
    assert_eq!(tree.node(a.id()), Some(a));
}

#[test]
fn configurations_and_namespaces() {
    let parse = file(
        "CONFIGURATION c RESOURCE r ON cpu TASK t(INTERVAL := T#1s); PROGRAM p WITH t : Main; END_RESOURCE END_CONFIGURATION\n\
         NAMESPACE a.b USING c; FUNCTION f : INT END_FUNCTION END_NAMESPACE",
    );
    let all: Vec<Declaration<'_>> = SourceFile::of(&parse.tree).declarations().collect();
    let Declaration::Configuration(configuration) = all[0] else { panic!("a configuration") };
    let resource = configuration.resources().next().expect("a resource");
    assert_eq!(resource.on().map(|path| path.text()).as_deref(), Some("cpu"));
    assert_eq!(resource.tasks().next().map(|task| task.arguments().count()), Some(1));
    let program = resource.programs().next().expect("a program");
    assert_eq!(program.task().map(|name| name.text()), Some("t"));
    assert_eq!(type_text(program.type_()), "Main");
    let Declaration::Namespace(namespace) = all[1] else { panic!("a namespace") };
    assert_eq!(namespace.path().map(|path| path.text()).as_deref(), Some("a.b"));
    assert_eq!(namespace.declarations().count(), 2);
}

#[test]
fn actions_apart_from_their_pou() {
    let parse = file("PROGRAM p END_PROGRAM ACTIONS p ACTION a x := 1; END_ACTION END_ACTIONS ACTION p.b: END_ACTION");
    let declarations: Vec<Declaration<'_>> = SourceFile::of(&parse.tree).declarations().collect();
    let [Declaration::Pou(program), Declaration::Actions(block), Declaration::Pou(alone)] = declarations[..] else {
        panic!("{declarations:?}")
    };
    assert_eq!((program.kind(), block.pou().map(|name| name.text())), (PouKind::Program, Some("p")));
    assert_eq!(block.actions().filter_map(|action| action.name()).map(|name| name.text()).collect::<Vec<_>>(), ["a"]);
    assert_eq!((alone.kind(), alone.name().map(|name| name.text())), (PouKind::Action, Some("p.b")));
}

#[test]
fn a_tree_can_be_shared_between_threads() {
    fn shared<T: Send + Sync + 'static>(_: &T) {}
    shared(&file("VAR a : INT; END_VAR"));
}
