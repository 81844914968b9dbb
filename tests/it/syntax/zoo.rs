//! The zoo of dialects: one small file for each quirk, with the tree that it must give.
//!
//! The files stand in `tests/zoo/`, each beside its tree. A file whose name begins with `scl` is read with names in
//! double quotes.

use rungbook::diagnostic::Severity;
use rungbook::syntax::{Entry, Options, Parse, dump, parse};
use rungbook::text::LineIndex;

/// The tree and the errors of `text`, as the snapshots hold them.
fn show(text: &str, parse: &Parse) -> String {
    let lines = LineIndex::new(text);
    let mut out = dump::dump(&parse.tree);
    for error in &parse.errors {
        let at = lines.line_column(text, error.span.start);
        out.push_str(&format!("{}:{} {}: {}\n", at.line, at.column, error.code.name, error.message));
    }
    out
}

fn check(name: &str, text: &str, entry: Entry) {
    let options = Options { nested_comments: None, quoted_names: name.starts_with("scl") };
    let shown = show(text, &parse(text, entry, &options));
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../zoo");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, shown));
}

macro_rules! zoo {
    ($($name:ident: $entry:ident,)*) => {
        /// Every text of the zoo, with what it is read as.
        pub(crate) const ALL: &[(&str, &str, Entry)] = &[
            $((stringify!($name), include_str!(concat!("../../zoo/", stringify!($name), ".st")), Entry::$entry),)*
        ];

        $(
            #[test]
            fn $name() {
                let text = include_str!(concat!("../../zoo/", stringify!($name), ".st"));
                check(stringify!($name), text, Entry::$entry);
            }
        )*
    };
}

zoo! {
    actions: File,
    body_addresses: Body,
    body_assignments: Body,
    body_calls: Body,
    body_case_nested: Body,
    body_control: Body,
    body_jumps: Body,
    body_keywords_as_names: Body,
    body_literals: Body,
    body_precedence: Body,
    broken_ends: File,
    broken_statements: File,
    broken_variables: File,
    comment_open: File,
    comments_flat: File,
    comments_nested: File,
    configuration: File,
    decl_function_block: Declaration,
    decl_globals: Declaration,
    decl_method: Declaration,
    decl_property: Declaration,
    decl_with_body: Declaration,
    event_blocks_broken: File,
    expr_chain: Expression,
    foreign_operators_broken: File,
    il: File,
    il_bare: Body,
    names_like_keywords: File,
    namespaces: File,
    pous: File,
    pragma_open: File,
    pragmas: File,
    scl_blocks: File,
    scl_data: File,
    scl_pointers: File,
    sfc: File,
    stray_characters: File,
    string_open: File,
    strings: File,
    types: File,
    types_lengths: File,
    var_config: File,
    var_declarations: File,
    var_sections: File,
}

#[test]
fn only_the_broken_ones_have_errors() {
    for (name, text, entry) in ALL {
        let mut errors = parse(*text, *entry, &Options::default()).errors;
        errors.retain(|error| error.code.severity != Severity::Info);
        let broken = ["broken", "_open", "stray"].iter().any(|part| name.contains(part));
        assert_eq!(!errors.is_empty(), broken, "{name}: {errors:?}");
    }
}
