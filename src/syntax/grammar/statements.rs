//! Statements: `stmt_list`, `assign_stmt`, `subprog_ctrl_stmt`, `selection_stmt`, `iteration_stmt`; and the vendors'
//! jumps, labels, `__TRY` and `REGION`.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Marker, Parser};
use super::declarations::at_boundary;
use super::expressions::{
    assigned_value, at_daring_name, expression, opt_assignment_operator, peripheral_follows, range_or_expression,
    variable,
};
use super::names::{any_name, is_name, nth_is_name};
use super::{ENDS, STATEMENT_ENDS, STATEMENT_KEYWORDS, error_token, skip_while};

/// The statements inside a statement; `in_case` says that the label of a branch ends them.
fn list(p: &mut Parser<'_>, in_case: bool) {
    let marker = p.start();
    while !at_end_of_list(p) {
        if in_case && at_case_label(p) {
            break;
        }
        let before = p.position();
        if p.at_any(STATEMENT_ENDS) {
            p.error(format!("{} closes nothing", p.current().describe()));
            error_token(p);
            p.eat(TokenKind::Semicolon);
        } else {
            statement(p);
        }
        if p.position() == before {
            p.expected("a statement");
            error_token(p);
        }
    }
    p.complete(marker, NodeKind::StatementList);
}

fn at_end_of_list(p: &Parser<'_>) -> bool {
    let kind = p.current();
    if kind == TokenKind::Ident {
        return false;
    }
    let waits = match kind {
        TokenKind::Else => p.is_open(TokenKind::EndIf) || p.is_open(TokenKind::EndCase),
        TokenKind::Elsif => p.is_open(TokenKind::EndIf),
        TokenKind::Until => p.is_open(TokenKind::EndRepeat),
        TokenKind::Catch | TokenKind::Finally => p.is_open(TokenKind::EndTry),
        kind => ENDS.contains(kind) && p.is_open(kind),
    };
    waits || at_boundary(p)
}

/// One statement.
pub(super) fn statement(p: &mut Parser<'_>) {
    if p.deeper(any_statement).is_none() {
        skip_in_statement(p, &[]);
        p.eat(TokenKind::Semicolon);
    }
}

fn any_statement(p: &mut Parser<'_>) {
    match p.current() {
        TokenKind::Ident => label_or_expression(p),
        TokenKind::Semicolon => {
            let marker = p.start();
            p.bump();
            p.complete(marker, NodeKind::EmptyStatement);
        }
        TokenKind::If => if_statement(p),
        TokenKind::Case => case_statement(p),
        TokenKind::For => for_statement(p),
        TokenKind::While => while_statement(p),
        TokenKind::Repeat => repeat_statement(p),
        TokenKind::Exit if !at_daring_name(p) => keyword_statement(p, NodeKind::ExitStatement),
        TokenKind::Return => keyword_statement(p, NodeKind::ReturnStatement),
        TokenKind::Continue if !continues_name(p) => keyword_statement(p, NodeKind::ContinueStatement),
        TokenKind::Jmp | TokenKind::Goto if nth_is_name(p, 1) => jump(p),
        TokenKind::Try => try_statement(p),
        TokenKind::Region if !continues_name(p) => region(p),
        _ => label_or_expression(p),
    }
}

/// Whether the next token shows that the current one is a name.
fn continues_name(p: &Parser<'_>) -> bool {
    matches!(
        p.nth(1),
        TokenKind::Assign
            | TokenKind::Dot
            | TokenKind::LBracket
            | TokenKind::Caret
            | TokenKind::LParen
            | TokenKind::Colon
    )
}

fn keyword_statement(p: &mut Parser<'_>, kind: NodeKind) {
    let marker = p.start();
    p.bump();
    end(p);
    p.complete(marker, kind);
}

fn jump(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    any_name(p);
    end(p);
    p.complete(marker, NodeKind::JumpStatement);
}

fn label_or_expression(p: &mut Parser<'_>) {
    let marker = p.start();
    let quoted = p.at(TokenKind::WString) && peripheral_follows(p);
    if is_name(p.current()) && p.nth(1) == TokenKind::Colon && !quoted {
        any_name(p);
        p.bump();
        p.complete(marker, NodeKind::LabelStatement);
        return;
    }
    let before = p.position();
    let mut kind = NodeKind::ExpressionStatement;
    let read = expression(p).is_some();
    if read && opt_assignment_operator(p) {
        kind = NodeKind::AssignStatement;
        assigned_value(p);
    }
    if p.position() == before {
        return recover(p);
    }
    end(p);
    p.complete(marker, kind);
}

/// The `;` of a statement.
fn end(p: &mut Parser<'_>) {
    if p.eat(TokenKind::Semicolon) {
        return;
    }
    if p.at_any(ENDS) || at_boundary(p) || at_new_statement(p) {
        return p.missing_semicolon();
    }
    p.expected("`;`");
    recover(p);
}

/// Whether a statement begins here beyond doubt.
fn at_new_statement(p: &Parser<'_>) -> bool {
    if p.at_any(STATEMENT_KEYWORDS) {
        return true;
    }
    let continued = || {
        matches!(
            p.nth(1),
            TokenKind::Assign | TokenKind::LParen | TokenKind::Dot | TokenKind::Caret | TokenKind::LBracket
        ) || matches!(p.nth(1), TokenKind::Semicolon | TokenKind::Colon)
    };
    p.begins_line() && nth_is_name(p, 0) && (p.at(TokenKind::Hash) || continued())
}

/// Skips to behind the next `;`, or to where a statement begins or ends.
fn recover(p: &mut Parser<'_>) {
    let start = p.position();
    skip_while(p, |p| {
        let stop = p.position() > start && at_new_statement(p);
        !stop && !p.at(TokenKind::Semicolon) && !p.at_any(ENDS) && !at_boundary(p)
    });
    p.eat(TokenKind::Semicolon);
}

/// Skips to one of `stops`, or to where the statement must have ended.
pub(super) fn skip_in_statement(p: &mut Parser<'_>, stops: &[TokenKind]) {
    skip_while(p, |p| {
        !stops.contains(&p.current())
            && !p.at(TokenKind::Semicolon)
            && !p.at_any(ENDS)
            && !p.at_any(STATEMENT_KEYWORDS)
            && !matches!(p.current(), TokenKind::Then | TokenKind::Do)
            && !at_boundary(p)
    });
}

/// Takes the closing keyword of a statement, or says that it is missing.
fn close(p: &mut Parser<'_>, marker: Marker, end: TokenKind) {
    if p.eat(end) {
        p.eat(TokenKind::Semicolon);
    } else {
        p.missing_end(marker, end);
    }
}

/// A condition and the keyword behind it.
fn condition(p: &mut Parser<'_>, keyword: TokenKind) {
    assigned_value(p);
    if !p.eat(keyword) {
        p.expected(keyword.describe());
        let line = p.position();
        skip_while(p, |p| {
            let new_line = p.position() > line && p.begins_line();
            p.current() != keyword
                && !new_line
                && !p.begins_line()
                && !p.at(TokenKind::Semicolon)
                && !p.at_any(ENDS)
                && !at_boundary(p)
        });
        p.eat(keyword);
    }
}

/// `IF … THEN … ELSIF … ELSE … END_IF`.
fn if_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndIf, |p| {
        condition(p, TokenKind::Then);
        list(p, false);
        while p.at(TokenKind::Elsif) {
            let clause = p.start();
            p.bump();
            condition(p, TokenKind::Then);
            list(p, false);
            p.complete(clause, NodeKind::ElsifClause);
        }
        opt_else(p);
    });
    close(p, marker, TokenKind::EndIf);
    p.complete(marker, NodeKind::IfStatement);
}

fn opt_else(p: &mut Parser<'_>) {
    if !p.at(TokenKind::Else) {
        return;
    }
    let clause = p.start();
    p.bump();
    p.eat(TokenKind::Colon);
    list(p, false);
    p.complete(clause, NodeKind::ElseClause);
}

/// `CASE … OF labels: … ELSE … END_CASE`.
fn case_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndCase, |p| {
        condition(p, TokenKind::Of);
        while at_case_label(p) {
            case_branch(p);
        }
        if !p.at(TokenKind::Else) && !p.at(TokenKind::EndCase) {
            p.expected("the label of a branch");
            list(p, true);
            while at_case_label(p) {
                case_branch(p);
            }
        }
        opt_else(p);
    });
    close(p, marker, TokenKind::EndCase);
    p.complete(marker, NodeKind::CaseStatement);
}

/// `labels: statements`, where [`at_case_label`] has found the labels and their colon.
fn case_branch(p: &mut Parser<'_>) {
    let marker = p.start();
    let start = p.position();
    loop {
        if range_or_expression(p).is_none() || !p.eat(TokenKind::Comma) {
            break;
        }
    }
    if p.position() == start {
        // It only looks like a label, as `# 1:` does; a branch that takes no token would be read for ever.
        skip_while(p, |p| !p.at(TokenKind::Colon));
    }
    p.expect(TokenKind::Colon);
    list(p, true);
    p.complete(marker, NodeKind::CaseBranch);
}

/// Whether a list of labels and a colon begin here: operands between commas, dots, `..` and signs.
///
/// A search that fails at some token fails there from every later start as well, so no token is looked at by more
/// than one search that fails.
fn at_case_label(p: &mut Parser<'_>) -> bool {
    if p.position() < p.no_label_before {
        return false;
    }
    let mut n = 0;
    loop {
        while matches!(p.nth(n), TokenKind::Minus | TokenKind::Plus | TokenKind::TypePrefix | TokenKind::Hash) {
            n += 1;
        }
        let after_dot = n > 0 && p.nth(n - 1) == TokenKind::Dot;
        if !label_operand(p.nth(n), after_dot) {
            break;
        }
        n += 1;
        match p.nth(n) {
            TokenKind::Colon => return true,
            TokenKind::Comma
            | TokenKind::Dot
            | TokenKind::DotDot
            | TokenKind::Plus
            | TokenKind::Minus
            | TokenKind::Star
            | TokenKind::Slash => n += 1,
            _ => break,
        }
    }
    p.no_label_before = p.position() + n;
    false
}

fn label_operand(kind: TokenKind, after_dot: bool) -> bool {
    is_name(kind) || kind.is_literal() || (after_dot && kind.is_keyword())
}

/// `FOR i := a TO b BY c DO … END_FOR`.
fn for_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndFor, |p| {
        variable(p);
        p.expect(TokenKind::Assign);
        expression(p);
        p.expect(TokenKind::To);
        expression(p);
        if p.eat(TokenKind::By) {
            expression(p);
        }
        if !p.eat(TokenKind::Do) {
            p.expected(TokenKind::Do.describe());
            skip_while(p, |p| !p.begins_line() && !p.at(TokenKind::Do) && !p.at_any(ENDS) && !at_boundary(p));
            p.eat(TokenKind::Do);
        }
        list(p, false);
    });
    close(p, marker, TokenKind::EndFor);
    p.complete(marker, NodeKind::ForStatement);
}

/// `WHILE … DO … END_WHILE`.
fn while_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndWhile, |p| {
        condition(p, TokenKind::Do);
        list(p, false);
    });
    close(p, marker, TokenKind::EndWhile);
    p.complete(marker, NodeKind::WhileStatement);
}

/// `REPEAT … UNTIL … END_REPEAT`.
fn repeat_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndRepeat, |p| {
        list(p, false);
        if p.expect(TokenKind::Until) {
            assigned_value(p);
            p.eat(TokenKind::Semicolon);
        }
    });
    close(p, marker, TokenKind::EndRepeat);
    p.complete(marker, NodeKind::RepeatStatement);
}

/// `__TRY … __CATCH(e) … __FINALLY … __ENDTRY`.
fn try_statement(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndTry, |p| {
        list(p, false);
        while p.at(TokenKind::Catch) {
            let clause = p.start();
            p.bump();
            if p.eat(TokenKind::LParen) {
                if !p.at(TokenKind::RParen) {
                    expression(p);
                }
                p.expect(TokenKind::RParen);
            }
            list(p, false);
            p.complete(clause, NodeKind::CatchClause);
        }
        if p.at(TokenKind::Finally) {
            let clause = p.start();
            p.bump();
            list(p, false);
            p.complete(clause, NodeKind::FinallyClause);
        }
    });
    close(p, marker, TokenKind::EndTry);
    p.complete(marker, NodeKind::TryStatement);
}

/// `REGION any words`, statements, `END_REGION`.
fn region(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    while !p.at(TokenKind::Eof) && !p.begins_line() {
        p.bump();
    }
    p.within(TokenKind::EndRegion, |p| list(p, false));
    close(p, marker, TokenKind::EndRegion);
    // The words behind `END_REGION` repeat its name.
    while !p.at(TokenKind::Eof) && !p.begins_line() {
        p.bump();
    }
    p.complete(marker, NodeKind::RegionStatement);
}
