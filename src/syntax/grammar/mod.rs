//! What follows what: recursive descent, one file an area.
//!
//! A rule is a function that takes the parser. One whose name begins with `opt_` may take nothing and then says
//! so; every other one takes at least a token or records an error. Every loop either takes a token in each round
//! or ends. A rule that meets something it cannot read leaves it to its caller, whose recovery skips to the next
//! place at which reading can go on; what was skipped becomes an `Error` node.

mod configuration;
mod declarations;
mod events;
mod expressions;
mod il;
mod initializers;
mod names;
mod sfc;
mod siemens;
mod statements;
mod types;
mod variables;

use super::Entry;
use super::kind::{NodeKind, TokenKind};
use super::parser::Parser;
use super::set::TokenSet;

/// Reads the whole text as `entry`.
pub(super) fn root(p: &mut Parser<'_>, entry: Entry) {
    let marker = p.start();
    match entry {
        Entry::File => declarations::file(p),
        Entry::Declaration => {
            p.needs_end = false;
            declarations::file(p);
        }
        Entry::Body => body_text(p),
        Entry::InstructionList => {
            let body = p.start();
            il::instruction_list(p, true);
            p.complete(body, NodeKind::Body);
            rest(p);
        }
        Entry::Expression => {
            expressions::expression(p);
            rest(p);
        }
    }
    p.complete(marker, NodeKind::SourceFile);
}

/// A text that is a body: whatever would end a body elsewhere is wrong here, and is skipped.
fn body_text(p: &mut Parser<'_>) {
    let body = p.start();
    while !p.at(TokenKind::Eof) {
        let before = p.position();
        declarations::body_elements(p);
        if p.position() == before {
            p.error("unexpected keyword in a body");
            error_token(p);
        }
    }
    p.complete(body, NodeKind::Body);
}

/// Whatever is left, as an error.
fn rest(p: &mut Parser<'_>) {
    if !p.at(TokenKind::Eof) {
        p.expected("the end of the text");
        skip_while(p, |_| true);
    }
}

/// Skips the current token.
fn error_token(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.complete(marker, NodeKind::Error);
}

/// Skips tokens while `go_on` says so; at least none.
fn skip_while(p: &mut Parser<'_>, go_on: impl Fn(&Parser<'_>) -> bool) {
    if p.at(TokenKind::Eof) || !go_on(p) {
        return;
    }
    let marker = p.start();
    while !p.at(TokenKind::Eof) && go_on(p) {
        p.bump();
    }
    p.complete(marker, NodeKind::Error);
}

/// Keywords that begin a section of variables.
const VAR_KEYWORDS: TokenSet = TokenSet::new(&[
    TokenKind::Var,
    TokenKind::VarInput,
    TokenKind::VarOutput,
    TokenKind::VarInOut,
    TokenKind::VarTemp,
    TokenKind::VarStat,
    TokenKind::VarInst,
    TokenKind::VarExternal,
    TokenKind::VarGlobal,
    TokenKind::VarConfig,
    TokenKind::VarAccess,
    TokenKind::VarGeneric,
]);

/// Keywords that close a declaration.
const DECLARATION_ENDS: TokenSet = TokenSet::new(&[
    TokenKind::EndFunctionBlock,
    TokenKind::EndFunction,
    TokenKind::EndProgram,
    TokenKind::EndInterface,
    TokenKind::EndClass,
    TokenKind::EndMethod,
    TokenKind::EndProperty,
    TokenKind::EndPropertyGet,
    TokenKind::EndPropertySet,
    TokenKind::EndGet,
    TokenKind::EndSet,
    TokenKind::EndAction,
    TokenKind::EndAlgorithm,
    TokenKind::EndActions,
    TokenKind::EndTransition,
    TokenKind::EndStep,
    TokenKind::EndType,
    TokenKind::EndStruct,
    TokenKind::EndUnion,
    TokenKind::EndNamespace,
    TokenKind::EndConfiguration,
    TokenKind::EndResource,
    TokenKind::EndOrganizationBlock,
    TokenKind::EndDataBlock,
    TokenKind::EndVar,
    TokenKind::EndConst,
    TokenKind::EndLabel,
]);

/// Keywords that close a statement or a part of one.
const STATEMENT_ENDS: TokenSet = TokenSet::new(&[
    TokenKind::EndIf,
    TokenKind::EndCase,
    TokenKind::EndFor,
    TokenKind::EndWhile,
    TokenKind::EndRepeat,
    TokenKind::EndRegion,
    TokenKind::EndTry,
    TokenKind::Else,
    TokenKind::Elsif,
    TokenKind::Until,
    TokenKind::Catch,
    TokenKind::Finally,
]);

/// Keywords that close anything.
const ENDS: TokenSet = DECLARATION_ENDS.union(STATEMENT_ENDS);

/// Keywords that begin a statement and nothing else.
const STATEMENT_KEYWORDS: TokenSet = TokenSet::new(&[
    TokenKind::If,
    TokenKind::Case,
    TokenKind::For,
    TokenKind::While,
    TokenKind::Repeat,
    TokenKind::Exit,
    TokenKind::Return,
    TokenKind::Try,
]);
