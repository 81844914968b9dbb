//! Models from files of other tools: AIGER (Biere, *The AIGER And-Inverter Graph (AIG) Format*, 2007; Biere, Heljanko,
//! Wieringa, *AIGER 1.9 and Beyond*, 2011), binary. Outputs count as bad where the file names nothing bad, as in files
//! older than 1.9. Left out: the ASCII form, justice and fairness.

use std::fmt;

use super::aig::{Latch, Lit, Model, through};
use super::write::Names;

/// Why a file is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Malformed {
    /// The byte, from 0, at which it is seen.
    pub at: usize,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at, self.message)
    }
}

impl std::error::Error for Malformed {}

/// The numbers of the header, in its order: the greatest variable, inputs, latches, outputs, conjunctions, bad, constraints.
type Counts = [usize; 7];

/// Most variables of a file that is read.
const MOST: usize = 1 << 26;

struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl<'b> Reader<'b> {
    fn wrong<T>(&self, message: impl Into<String>) -> Result<T, Malformed> {
        Err(Malformed { at: self.at, message: message.into() })
    }

    /// The next line, without its end.
    fn line(&mut self) -> Result<&'b str, Malformed> {
        let rest = &self.bytes[self.at..];
        let Some(end) = rest.iter().position(|byte| *byte == b'\n') else {
            return self.wrong("the file ends in a line");
        };
        let Ok(line) = std::str::from_utf8(&rest[..end]) else { return self.wrong("a line is not UTF-8") };
        self.at += end + 1;
        Ok(line)
    }

    /// The numbers of the next line.
    fn numbers(&mut self) -> Result<Vec<usize>, Malformed> {
        let at = self.at;
        let numbers: Option<Vec<usize>> = self.line()?.split(' ').map(|word| word.parse().ok()).collect();
        numbers.ok_or_else(|| Malformed { at, message: "numbers are expected".to_owned() })
    }

    /// The one literal of the next line.
    fn literal(&mut self, end: usize) -> Result<Lit, Malformed> {
        let at = self.at;
        match self.numbers()?[..] {
            [number] => literal(number, end, at),
            _ => Err(Malformed { at, message: "one literal is expected".to_owned() }),
        }
    }

    fn header(&mut self) -> Result<Counts, Malformed> {
        let line = self.line()?;
        let Some(rest) = line.strip_prefix("aig ") else {
            return Err(Malformed { at: 0, message: "`aig` is expected, the binary form".to_owned() });
        };
        let numbers: Option<Vec<usize>> = rest.split(' ').map(|word| word.parse().ok()).collect();
        let numbers = numbers.filter(|numbers| (5..=9).contains(&numbers.len()));
        let Some(numbers) = numbers else {
            return Err(Malformed { at: 4, message: "5 to 9 numbers are expected".to_owned() });
        };
        if numbers.iter().skip(7).any(|count| *count > 0) {
            return Err(Malformed { at: 4, message: "justice and fairness are not read".to_owned() });
        }
        let mut counts = [0; 7];
        for (count, number) in counts.iter_mut().zip(numbers) {
            *count = number;
        }
        let sum = counts[1].checked_add(counts[2]).and_then(|sum| sum.checked_add(counts[4]));
        if sum != Some(counts[0]) {
            let message = "inputs, latches and conjunctions are not as many as variables";
            return Err(Malformed { at: 4, message: message.to_owned() });
        }
        if counts[0] > MOST {
            return Err(Malformed { at: 4, message: format!("more than {MOST} variables") });
        }
        Ok(counts)
    }

    /// Seven bits a byte, the lowest first; a set eighth bit says that more follow.
    fn delta(&mut self) -> Result<usize, Malformed> {
        let mut value = 0_usize;
        for shift in (0..35).step_by(7) {
            let Some(&byte) = self.bytes.get(self.at) else { return self.wrong("the file ends in a conjunction") };
            self.at += 1;
            value |= usize::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(value);
            }
        }
        self.wrong("a difference is longer than 5 bytes")
    }
}

fn literal(number: usize, end: usize, at: usize) -> Result<Lit, Malformed> {
    match u32::try_from(number) {
        Ok(lit) if number < 2 * end => Ok(Lit(lit)),
        _ => Err(Malformed { at, message: format!("literal {number} is beyond the last variable") }),
    }
}

/// The next values and first values of latches, in literals of the file.
fn latches(reader: &mut Reader<'_>, counts: &Counts) -> Result<Vec<(Lit, Option<bool>)>, Malformed> {
    let (end, from) = (counts[0] + 1, counts[1] + 1);
    let mut latches = Vec::new();
    for own in from..from + counts[2] {
        let at = reader.at;
        let (next, initial) = match reader.numbers()?[..] {
            [next] | [next, 0] => (next, Some(false)),
            [next, 1] => (next, Some(true)),
            [next, first] if first == 2 * own => (next, None),
            _ => {
                let message = "a latch has a next value and a first one: 0, 1 or itself";
                return Err(Malformed { at, message: message.to_owned() });
            }
        };
        latches.push((literal(next, end, at)?, initial));
    }
    Ok(latches)
}

/// The conjunctions, into the graph: what each variable of the file is there.
fn conjunctions(reader: &mut Reader<'_>, counts: &Counts, model: &mut Model) -> Result<Vec<Lit>, Malformed> {
    let mut nodes = vec![Lit::FALSE];
    nodes.extend((0..counts[1] + counts[2]).map(|_| model.aig.leaf()));
    for own in nodes.len()..=counts[0] {
        let (at, first) = (reader.at, reader.delta()?);
        let second = reader.delta()?;
        let left = (2 * own).checked_sub(first).filter(|_| first > 0);
        let operands = left.and_then(|left| Some((left, left.checked_sub(second)?)));
        let Some((left, right)) = operands else {
            return Err(Malformed { at, message: "a conjunction comes before its operands".to_owned() });
        };
        let (left, right) = (literal(left, own, at)?, literal(right, own, at)?);
        let node = model.aig.and(through(&nodes, left), through(&nodes, right));
        nodes.push(node);
    }
    Ok(nodes)
}

/// The symbol table, up to the comment.
fn symbols(reader: &mut Reader<'_>, counts: &Counts) -> Result<Names, Malformed> {
    let [_, inputs, latches, mut outputs, _, bad, constraints] = counts.map(|count| vec![String::new(); count]);
    let mut names = Names { inputs, latches, bad, constraints };
    while reader.at < reader.bytes.len() {
        let at = reader.at;
        let line = reader.line()?;
        if line == "c" {
            break;
        }
        let wrong = || Malformed { at, message: format!("`{line}` names nothing") };
        let (place, name) = line.split_once(' ').ok_or_else(wrong)?;
        let mut characters = place.chars();
        let list = match characters.next() {
            Some('i') => &mut names.inputs,
            Some('l') => &mut names.latches,
            Some('o') => &mut outputs,
            Some('b') => &mut names.bad,
            Some('c') => &mut names.constraints,
            _ => return Err(wrong()),
        };
        let index: usize = characters.as_str().parse().map_err(|_| wrong())?;
        name.clone_into(list.get_mut(index).ok_or_else(wrong)?);
    }
    if names.bad.is_empty() {
        names.bad = outputs;
    }
    Ok(names)
}

/// The model in a file of the binary form, `.aig`, with its names.
///
/// # Errors
/// The byte at which the file is not AIGER, or is of a kind that is left out.
pub fn aiger(bytes: &[u8]) -> Result<(Model, Names), Malformed> {
    let mut reader = Reader { bytes, at: 0 };
    let counts = reader.header()?;
    let [most, inputs, _, outputs, _, bad, constraints] = counts;
    let latches = latches(&mut reader, &counts)?;
    let mut list = |count: usize| (0..count).map(|_| reader.literal(most + 1)).collect::<Result<Vec<Lit>, Malformed>>();
    let (outputs, bad, constraints) = (list(outputs)?, list(bad)?, list(constraints)?);
    let mut model = Model::default();
    let nodes = conjunctions(&mut reader, &counts, &mut model)?;
    let translated = |lits: Vec<Lit>| -> Vec<Lit> { lits.into_iter().map(|lit| through(&nodes, lit)).collect() };
    model.inputs = nodes[1..=inputs].to_vec();
    let own = nodes[inputs + 1..].iter().zip(latches);
    model.latches =
        own.map(|(lit, (next, initial))| Latch { lit: *lit, next: through(&nodes, next), initial }).collect();
    model.bad = translated(if bad.is_empty() { outputs } else { bad });
    model.constraints = translated(constraints);
    let names = symbols(&mut reader, &counts)?;
    Ok((model, names))
}
