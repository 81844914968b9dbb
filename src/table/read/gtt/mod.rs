//! `.gtt`, the language of the tool *geteta*: tables with declarations, groups and rows, inheritance of tables and
//! rows, projections, time constants, options, functions, and relational tables over several runs.
//!
//! Read with the meaning of the papers. A group without a duration is there once, and the group round everything
//! leaves no trace if it is there once too. A `//` comment behind the brace of a row is its remark.

mod declaration;
mod lexer;
mod rows;

use super::build::{Builder, word};
use super::{Options, Read};
use crate::diagnostic::Finding;
use crate::table::codes;
use crate::table::model::Word;
use crate::table::piece::Piece;
use crate::text::Place;
use lexer::{Comment, Kind, Token};

/// Reads every table of a `.gtt` file.
#[must_use]
pub fn read(piece: &Piece<'_>, options: &Options) -> Read {
    let (tokens, comments) = lexer::lex(piece.text);
    let mut reader = Reader { piece, tokens, comments, at: 0, depth: 0, options, read: Read::default() };
    reader.file();
    reader.read.sort();
    reader.read
}

/// Words that begin a part of a table.
const MEMBERS: [&str; 9] = ["var", "gvar", "column", "COLUMN", "timeconst", "options", "group", "function", "FUNCTION"];

/// Groups that nest deeper than this are refused.
const MAX_DEPTH: usize = 64;

struct Reader<'a, 'p> {
    piece: &'a Piece<'p>,
    tokens: Vec<Token>,
    comments: Vec<Comment>,
    at: usize,
    depth: usize,
    options: &'a Options,
    read: Read,
}

/// A part that could not be read; the finding has been given.
struct Broken;

type Result<T> = std::result::Result<T, Broken>;

impl<'p> Reader<'_, 'p> {
    fn token(&self) -> &Token {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    fn kind(&self) -> Kind {
        self.token().kind
    }

    fn text_at(&self, index: usize) -> &str {
        let token = &self.tokens[index.min(self.tokens.len() - 1)];
        self.piece.text.get(token.range.clone()).unwrap_or("")
    }

    fn text(&self) -> &str {
        self.text_at(self.at)
    }

    fn is(&self, text: &str) -> bool {
        self.text() == text && self.kind() != Kind::Text
    }

    fn eat(&mut self, text: &str) -> bool {
        let found = self.is(text);
        self.at += usize::from(found);
        found
    }

    fn place(&self) -> Place {
        self.piece.at(self.token().range.clone())
    }

    fn end(&self) -> bool {
        self.kind() == Kind::End
    }

    /// The piece from the token `from` to the token before the cursor.
    fn since(&self, from: usize) -> Piece<'p> {
        let start = self.tokens[from.min(self.tokens.len() - 1)].range.start;
        let end = if self.at > from { self.tokens[self.at - 1].range.end } else { start };
        self.piece.part(start..end)
    }

    fn expect(&mut self, builder: &mut Builder<'_>, text: &str) -> Result<()> {
        if self.eat(text) { Ok(()) } else { Err(self.unexpected(builder, &format!("`{text}`"))) }
    }

    fn unexpected(&self, builder: &mut Builder<'_>, wanted: &str) -> Broken {
        let message = if self.end() {
            format!("the file ends where {wanted} was expected")
        } else {
            format!("{wanted} was expected before `{}`", self.text())
        };
        builder.report(Finding::new(&codes::TABLE_SYNTAX, self.place(), message));
        Broken
    }

    /// A name, without backticks.
    fn name(&mut self, builder: &mut Builder<'_>, what: &str) -> Result<Word> {
        if self.kind() != Kind::Word {
            return Err(self.unexpected(builder, what));
        }
        let word = Word { text: self.text().trim_matches('`').to_owned(), place: self.place() };
        self.at += 1;
        Ok(word)
    }

    /// A name or a number, as rows and runs have.
    fn name_or_number(&mut self, builder: &mut Builder<'_>, what: &str) -> Result<Word> {
        let from = self.at;
        if self.is("-") {
            self.at += 1;
        }
        if self.kind() == Kind::Number {
            self.at += 1;
            return Ok(word(&self.since(from)));
        }
        self.at = from;
        self.name(builder, what)
    }

    fn file(&mut self) {
        while !self.end() {
            if self.is("table") || self.is("relational") {
                self.table();
            } else if self.is("contract") {
                self.automaton();
            } else {
                let message = format!("`{}` begins no table", self.text());
                let finding = Finding::new(&codes::TABLE_SYNTAX, self.place(), message);
                self.read.findings.push(finding.help("a table is written `table NAME { … }`"));
                self.at += 1;
                while !self.end() && !["table", "relational", "contract"].contains(&self.text()) {
                    self.at += 1;
                }
            }
        }
    }

    /// A contract automaton: stepped over as a whole.
    fn automaton(&mut self) {
        let message = "contract automata are not read";
        self.read.findings.push(Finding::new(&codes::TABLE_UNSUPPORTED, self.place(), message));
        while !self.end() && !self.is("{") {
            self.at += 1;
        }
        self.skip_braces();
    }

    /// Where the partner of the brace `open` stands, or the end of the file.
    fn partner(&self, open: usize) -> usize {
        let mut depth = 0_usize;
        for (index, token) in self.tokens.iter().enumerate().skip(open) {
            match token.kind {
                Kind::Sign('{') => depth += 1,
                Kind::Sign('}') if depth <= 1 => return index,
                Kind::Sign('}') => depth -= 1,
                _ => {}
            }
        }
        self.tokens.len() - 1
    }

    /// Steps over what stands between the brace at the cursor and its partner.
    fn skip_braces(&mut self) {
        let mut depth = 0_usize;
        while !self.end() {
            match self.kind() {
                Kind::Sign('{') => depth += 1,
                Kind::Sign('}') => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.at += 1;
            if depth == 0 {
                return;
            }
        }
    }

    fn table(&mut self) {
        let from = self.at;
        let relational = self.eat("relational");
        let blank = Word { text: String::new(), place: self.place() };
        let mut builder = Builder::new(blank, self.place(), self.options);
        if self.header(&mut builder, relational).is_ok() {
            self.members(&mut builder);
        } else {
            while !self.end() && !self.is("table") && !self.is("relational") {
                self.at += 1;
            }
        }
        builder.table.place = self.since(from).whole();
        builder.name_rows();
        self.read.take(builder.finish());
    }

    fn header(&mut self, builder: &mut Builder<'_>, relational: bool) -> Result<()> {
        self.expect(builder, "table")?;
        let name = self.name(builder, "the name of the table")?;
        builder.table.name = name.text;
        builder.table.name_place = name.place;
        if relational {
            self.expect(builder, "(")?;
            builder.table.runs = self.list(builder, "the name of a run")?;
            self.expect(builder, ")")?;
            builder.context.relational = true;
        }
        self.expect(builder, "{")
    }

    /// Names or numbers between commas.
    fn list(&mut self, builder: &mut Builder<'_>, what: &str) -> Result<Vec<Word>> {
        let mut out = vec![self.name_or_number(builder, what)?];
        while self.eat(",") {
            out.push(self.name_or_number(builder, what)?);
        }
        Ok(out)
    }

    /// Everything between the braces of a table.
    fn members(&mut self, builder: &mut Builder<'_>) {
        let end = self.partner(self.at - 1);
        while !self.end() && !self.eat("}") {
            let in_group = self.is("group");
            let result = match self.text() {
                "var" => self.variables(builder),
                "gvar" => self.global(builder),
                "column" | "COLUMN" => self.projection(builder),
                "timeconst" => self.time_constant(builder),
                "options" => self.table_options(builder),
                "\\inherit_from" => self.inherit_table(builder),
                "function" | "FUNCTION" => self.function(builder),
                "group" => self.root(builder),
                "row" => Err(self.unexpected(builder, "`group` round the rows")),
                "table" | "relational" => {
                    self.unexpected(builder, "`}` at the end of the table");
                    return;
                }
                _ => Err(self.unexpected(builder, "a declaration or `group`")),
            };
            if result.is_err() && in_group {
                // The braces inside are in doubt: what is left of this table cannot be told apart any more.
                self.at = end.max(self.at);
            } else if result.is_err() {
                self.recover();
            }
        }
    }

    /// Steps to where the next part of the table may begin.
    fn recover(&mut self) {
        self.at += usize::from(!self.is("}"));
        while !self.end() && !self.at_member() {
            if self.is("{") {
                self.skip_braces();
            } else {
                self.at += 1;
            }
        }
    }

    /// Whether the cursor stands at the beginning of a part of the table, or at its end.
    fn at_member(&self) -> bool {
        match self.kind() {
            Kind::Word => MEMBERS.contains(&self.text()) || ["table", "relational"].contains(&self.text()),
            Kind::Sign(sign) => sign == '}',
            Kind::Command => self.is("\\inherit_from"),
            Kind::End => true,
            _ => false,
        }
    }
}
