//! The text of a duration.

use super::{Amount, Bounds, Duration, DurationError, Flag, Term};
use crate::table::cell::literal;
use crate::table::model::Quantity;
use crate::table::piece::Piece;
use crate::text::Span;

/// Reads a duration; `unit` is what a bare number counts (nanoseconds, where the header says so), else cycles.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn parse(piece: &Piece<'_>, unit: Option<i128>) -> Result<Duration, DurationError> {
    let mut parser = Parser { piece, at: 0, unit };
    let duration = parser.duration()?;
    parser.space();
    if parser.at < piece.text.len() {
        return Err(parser.error("nothing was expected here any more"));
    }
    Ok(duration)
}

struct Parser<'a> {
    piece: &'a Piece<'a>,
    at: usize,
    unit: Option<i128>,
}

const FLAGS: [(&str, Flag); 5] = [
    ("progress", Flag::Progress),
    ("hold", Flag::Hold),
    (">>", Flag::Progress),
    ("_p", Flag::Progress),
    ("p", Flag::Progress),
];

impl Parser<'_> {
    fn rest(&self) -> &str {
        self.piece.text.get(self.at..).unwrap_or("")
    }

    fn space(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    fn error(&self, message: impl Into<String>) -> DurationError {
        let span = self.piece.span(Span::from(self.at.min(self.piece.text.len())..self.piece.text.len()));
        let help = "write `5`, `[1, 5]`, `[1, ∞]`, `>= 5`, `-`, `200 ms`, or `-∞` for ever".to_owned();
        DurationError { span, message: message.into(), help: Some(help) }
    }

    fn eat(&mut self, words: &[&str]) -> bool {
        self.space();
        let found = words.iter().find(|word| self.rest().starts_with(**word)).map(|word| word.len());
        self.at += found.unwrap_or(0);
        found.is_some()
    }

    /// Eats one of `words` where no letter follows it.
    fn eat_word(&mut self, words: &[&str]) -> bool {
        self.space();
        let rest = self.rest();
        let found = words.iter().find(|word| {
            rest.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
                && !rest[word.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
        });
        let len = found.map(|word| word.len());
        self.at += len.unwrap_or(0);
        len.is_some()
    }

    fn flag(&mut self) -> Option<Flag> {
        self.space();
        for (word, flag) in FLAGS {
            let found = if word == ">>" { self.eat(&[word]) } else { self.eat_word(&[word]) };
            if found {
                // geteta: `progress input`; the flag looks at the inputs in any case.
                self.eat_word(&["input"]);
                return Some(flag);
            }
        }
        None
    }

    fn duration(&mut self) -> Result<Duration, DurationError> {
        self.space();
        if self.rest().is_empty() {
            return Ok(Duration::exactly(1));
        }
        if self.eat(&["-∞", "–∞", "—∞", "−∞", "ω"]) || self.eat_word(&["omega", "-inf"]) {
            return Ok(Duration::omega());
        }
        if self.eat(&["¬p"]) {
            return Ok(Duration { flag: Some(Flag::Progress), ..Duration::any() });
        }
        if self.eat_word(&["wait"]) {
            // exteta: leave as soon as a successor can.
            return Ok(Duration { flag: Some(Flag::Progress), ..Duration::any() });
        }
        let bounds = self.bounds()?;
        Ok(Duration { bounds, flag: self.flag() })
    }

    fn bounds(&mut self) -> Result<Bounds, DurationError> {
        if self.eat(&[">=", "≥"]) {
            return Ok(Bounds::Between(self.amount()?, None));
        }
        if self.eat(&["<=", "≤"]) {
            return Ok(Bounds::Between(Amount::cycles(0), Some(self.amount()?)));
        }
        if !self.rest().starts_with(">>") && self.eat(&[">"]) {
            return Ok(Bounds::Between(self.amount()?.plus(1), None));
        }
        if self.eat(&["<"]) {
            return Ok(Bounds::Between(Amount::cycles(0), Some(self.amount()?.plus(-1))));
        }
        if self.eat(&["["]) {
            return self.interval();
        }
        if self.eat(&["=", "=="]) {
            return Ok(Bounds::Exactly(self.amount()?));
        }
        if self.eat(&["-", "–", "—", "*"]) {
            return Ok(Bounds::Between(Amount::cycles(0), None));
        }
        Ok(Bounds::Exactly(self.amount()?))
    }

    fn interval(&mut self) -> Result<Bounds, DurationError> {
        let low = self.amount()?;
        if !self.eat(&[","]) {
            return Err(self.error("`,` was expected between the two bounds"));
        }
        let open = self.eat(&["∞", "+∞", "*", "-", "–", "—"]);
        let high = if open { None } else { Some(self.amount()?) };
        if !self.eat(&["]"]) {
            return Err(self.error("`]` was expected at the end of the interval"));
        }
        Ok(if high.as_ref() == Some(&low) { Bounds::Exactly(low) } else { Bounds::Between(low, high) })
    }

    fn amount(&mut self) -> Result<Amount, DurationError> {
        let mut terms = vec![(false, self.term()?)];
        loop {
            self.space();
            let rest = self.rest();
            // `-p` behind a number is a flag, not a constant named `p`.
            let minus = rest.starts_with(['-', '−']) && !rest.trim_start_matches(['-', '−']).starts_with('∞');
            if !minus && !rest.starts_with('+') {
                return Ok(Amount { terms });
            }
            self.at += rest.chars().next().map_or(0, char::len_utf8);
            terms.push((minus, self.term()?));
        }
    }

    fn term(&mut self) -> Result<Term, DurationError> {
        self.space();
        let rest = self.rest();
        let len = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '.').unwrap_or(rest.len());
        let word = rest.get(..len).unwrap_or("").to_owned();
        if word.is_empty() {
            return Err(self.error("a number of cycles or a time was expected"));
        }
        if rest[len..].starts_with('#') {
            return self.typed_time(&word, len);
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            return self.number();
        }
        self.at += len;
        Ok(Term::Constant(word))
    }

    fn typed_time(&mut self, prefix: &str, len: usize) -> Result<Term, DurationError> {
        if !["T", "TIME", "LT", "LTIME"].contains(&prefix.to_ascii_uppercase().as_str()) {
            return Err(self.error(format!("`{prefix}#` begins no time")));
        }
        self.at += len + 1;
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '.').unwrap_or(rest.len());
        let text = rest.get(..end).unwrap_or("").to_owned();
        let nanos = literal::time(&text).ok_or_else(|| self.error(format!("`{text}` is no time")))?;
        self.at += end;
        Ok(Term::Quantity(Quantity::Nanos(nanos)))
    }

    /// `5`, `200 ms`, `1s500ms`, `5 cycles`.
    fn number(&mut self) -> Result<Term, DurationError> {
        let start = self.at;
        let mut end = start;
        loop {
            self.take(|c| c.is_ascii_digit() || c == '_' || c == '.');
            let digits_end = self.at;
            self.space();
            let word_at = self.at;
            self.take(|c| c.is_alphabetic());
            let word = self.piece.text.get(word_at..self.at).unwrap_or("").to_owned();
            if literal::unit(&word).is_none() {
                let nothing = end == start;
                self.at = if nothing { digits_end } else { end };
                return if nothing { self.bare(start, &word, word_at) } else { self.time(start, end) };
            }
            end = self.at;
            self.eat_underscore();
            self.space();
            if !self.rest().starts_with(|c: char| c.is_ascii_digit()) {
                self.at = end;
                return self.time(start, end);
            }
        }
    }

    fn eat_underscore(&mut self) {
        if self.rest().starts_with('_') && self.rest()[1..].starts_with(|c: char| c.is_ascii_digit()) {
            self.at += 1;
        }
    }

    fn take(&mut self, accept: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !accept(c)).unwrap_or(rest.len());
    }

    fn bare(&mut self, start: usize, word: &str, word_at: usize) -> Result<Term, DurationError> {
        let text: String = self.piece.text[start..self.at].chars().filter(|c| *c != '_').collect();
        let cycles = ["cycle", "cycles"].contains(&word.to_ascii_lowercase().as_str());
        if cycles {
            self.at = word_at + word.len();
        }
        let quantity = match self.unit {
            Some(_) if !cycles => literal::time(&format!("{text}ns")).and_then(|n| n.checked_mul(self.unit?)),
            _ => text.parse().ok(),
        };
        let Some(value) = quantity.filter(|value| *value <= i128::from(u64::MAX)) else {
            self.at = start;
            return Err(self.error(format!("`{text}` is no whole number of cycles")));
        };
        let nanos = self.unit.is_some() && !cycles;
        Ok(Term::Quantity(if nanos { Quantity::Nanos(value) } else { Quantity::Cycles(value) }))
    }

    fn time(&mut self, start: usize, end: usize) -> Result<Term, DurationError> {
        let text = self.piece.text.get(start..end).unwrap_or("");
        match literal::time(text) {
            Some(nanos) => Ok(Term::Quantity(Quantity::Nanos(nanos))),
            None => {
                let message = format!("`{text}` is no time");
                self.at = start;
                Err(self.error(message))
            }
        }
    }
}
