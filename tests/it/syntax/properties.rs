//! What holds for any text: nothing is lost, the tree is a tree, and depth is bounded.

use proptest::prelude::*;
use rungbook::syntax::{Entry, Node, NodeKind, Options, Parse, TokenKind, parse};

use super::zoo;

const ENTRIES: [Entry; 5] = [Entry::File, Entry::Declaration, Entry::Body, Entry::InstructionList, Entry::Expression];

/// Far above what the limits on rules and on operators in a row can add up to.
const DEEPEST: usize = 1500;

fn check(text: &str, entry: Entry, options: &Options) -> Parse {
    let parse = parse(text, entry, options);
    let tree = &parse.tree;
    let joined: String = tree.tokens().map(|token| token.text()).collect();
    assert_eq!(joined, text, "the tokens are the text");
    assert!(tree.tokens().all(|token| !token.text().is_empty() && token.kind() != TokenKind::Eof));
    assert_eq!(tree.root().descendants().count(), tree.node_count(), "the root holds every node");
    check_nodes(tree.root());
    for error in &parse.errors {
        assert!(text.is_char_boundary(error.span.start as usize) && text.is_char_boundary(error.span.end as usize));
        assert!(!error.message.is_empty() && !error.message.ends_with('.'));
    }
    let skipped = tree.root().descendants().any(|node| node.kind() == NodeKind::Error);
    assert!(!skipped || !parse.errors.is_empty(), "nothing is skipped in silence");
    parse
}

/// Children lie in their parents, one after the other.
fn check_nodes(root: Node<'_>) {
    let mut open = vec![(root, 0)];
    while let Some((node, depth)) = open.pop() {
        assert!(depth < DEEPEST, "depth {depth}");
        let mut reached = node.first_token();
        for child in node.children() {
            assert!(child.first_token() >= reached, "{child:?} overlaps in {node:?}");
            assert!(child.end_token() <= node.end_token(), "{child:?} leaves {node:?}");
            reached = child.end_token();
            open.push((child, depth + 1));
        }
        if node != root && node.first_token() < node.end_token() {
            let tree = node.tree();
            let is_trivia = |index| tree.token(index).is_none_or(|token| token.kind().is_trivia());
            assert!(!is_trivia(node.first_token()) && !is_trivia(node.end_token() - 1), "{node:?} has loose ends");
        }
    }
}

fn options() -> impl Strategy<Value = Options> {
    (any::<Option<bool>>(), any::<bool>())
        .prop_map(|(nested_comments, quoted_names)| Options { nested_comments, quoted_names })
}

/// Words of the language in no order.
fn soup() -> impl Strategy<Value = String> {
    let words: Vec<&'static str> = zoo::ALL.iter().flat_map(|(_, text, _)| text.split_inclusive(' ')).collect();
    prop::collection::vec(prop::sample::select(words), 0..60).prop_map(|words| words.concat())
}

/// A text of the zoo with pieces cut out, doubled or moved.
fn mutated() -> impl Strategy<Value = String> {
    let edits = prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..3), 1..6);
    (prop::sample::select(zoo::ALL), edits).prop_map(|((_, text, _), edits)| {
        let mut chars: Vec<char> = text.chars().collect();
        for (from, to, edit) in edits {
            let (a, b) = (from.index(chars.len() + 1), to.index(chars.len() + 1));
            let (a, b) = (a.min(b), a.max(b).min(a.min(b) + 40));
            let piece: Vec<char> = chars[a..b].to_vec();
            match edit {
                0 => drop(chars.drain(a..b)),
                1 => drop(chars.splice(b..b, piece)),
                _ => {
                    chars.drain(a..b);
                    let at = chars.len() / 2;
                    chars.splice(at..at, piece);
                }
            }
        }
        chars.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_characters(text in any::<String>(), entry in prop::sample::select(&ENTRIES), options in options()) {
        check(&text, entry, &options);
    }

    #[test]
    fn any_words(text in soup(), entry in prop::sample::select(&ENTRIES), options in options()) {
        check(&text, entry, &options);
    }

    #[test]
    fn mutated_programs(text in mutated(), entry in prop::sample::select(&ENTRIES), options in options()) {
        check(&text, entry, &options);
    }

    #[test]
    fn broken_ends_of_characters(text in "[$'\"({*äß€\u{1F600}\\n\\r]{0,12}", options in options()) {
        check(&text, Entry::File, &options);
    }
}

#[test]
fn every_prefix_of_the_zoo() {
    for (name, text, entry) in zoo::ALL {
        let options = Options { nested_comments: None, quoted_names: name.starts_with("scl") };
        for (end, _) in text.char_indices() {
            check(&text[..end], *entry, &options);
        }
    }
}

#[test]
fn deep_nesting_is_cut_off() {
    let openers = [
        "(",
        "[",
        "f(",
        "a[",
        "-",
        "NOT ",
        "a := ",
        "a.",
        "a + ",
        "a ** ",
        "IF a THEN ",
        "CASE a OF 1: ",
        "REPEAT ",
        "FOR i := 1 TO 2 DO ",
        "WHILE a DO ",
        "__TRY ",
        "REGION r\n",
        "NAMESPACE n ",
        "FUNCTION_BLOCK f ",
        "METHOD m ",
        "PROPERTY p ",
        "GET ",
        "VAR x : ARRAY[1..2] OF ",
        "VAR x : STRUCT y : ",
        "TYPE t : STRUCT x : ",
        "POINTER TO ",
        "VAR x : t := (a := ",
        "VAR x : t := [",
        "VAR x : t := 1(",
        "(*",
        "LD a\nAND(",
        "ACTIONS a ",
        "CONFIGURATION c ",
        "RESOURCE r ",
        "STEP s: ",
        "TRANSITION FROM a TO b := ",
        "x : (",
    ];
    for opener in openers {
        let text = opener.repeat(3000);
        for entry in ENTRIES {
            check(&text, entry, &Options::default());
        }
        let inner = &opener[opener.find(": ").map_or(0, |at| at + 2)..];
        check(&format!("{opener}{}", inner.repeat(3000)), Entry::File, &Options::default());
    }
}

#[test]
fn a_deep_expression_says_so() {
    let text = format!("x := {}1{};\ny := 2;", "(".repeat(1000), ")".repeat(1000));
    let parse = check(&text, Entry::Body, &Options::default());
    assert!(parse.errors.iter().any(|error| error.code.name == "nesting-too-deep"));
    let last = parse.tree.root().descendants().filter(|node| node.kind() == NodeKind::AssignStatement).last();
    assert_eq!(last.map(Node::text), Some("y := 2;"), "the next statement is read");
}

/// What takes quadratic time needs minutes for these texts; what takes linear time, a fraction of a second.
#[test]
fn hostile_texts_take_linear_time() {
    let pieces = [
        "(*",
        "(* (* *)",
        "{",
        "{'}'\n",
        "{ '\n",
        "'",
        "\"",
        "a,\n",
        "CASE x OF a,\n",
        "IF ",
        "ELSE ",
        "END_VAR ",
        "VAR ",
        "x : ",
        "(a := ",
        "1(",
        "a := b ",
        "#",
        "§",
        "T#",
        "STEP a: ",
        "GET\n",
        "LD a OR(",
        "a: ",
        "METHOD a\n",
    ];
    for piece in pieces {
        let text: std::sync::Arc<str> = piece.repeat(40_000).into();
        let start = std::time::Instant::now();
        for entry in [Entry::File, Entry::Body] {
            let _ = parse(text.clone(), entry, &Options::default());
        }
        assert!(start.elapsed().as_secs() < 15, "{piece:?}: {:?}", start.elapsed());
    }
}
