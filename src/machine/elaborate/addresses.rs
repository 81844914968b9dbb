//! Direct addresses, IEC 61131-3 §6.5.5: which of them lie on the same bits.
//!
//! Each address is a variable of its own here, which is right as long as no two of them overlap: two that do are refused. Vendors count
//! differently: in `%IW1` the number is that of a word (CODESYS, unless set otherwise), or that of a byte (TwinCAT, Siemens). Addresses of one
//! size are taken to be apart where either way of counting keeps them apart, as a program has only one; those of different sizes must be apart
//! in both.

use std::ops::Range;

use super::access::Spot;
use super::{Elaborator, Lowered};
use crate::semantics::typing::Type;
use crate::syntax::Node;

/// An address, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Address {
    area: char,
    /// Bytes of its size; 0 for a bit.
    size: u64,
    /// What stands before the number, as in `%IW3.7`.
    path: Vec<u64>,
    number: u64,
    bit: u64,
}

/// The parts of `%IX3.7`, `%QW12`, `%MD2.0.4`, in capitals; `None` for what is no such thing.
fn parse(text: &str) -> Option<Address> {
    let rest = text.strip_prefix('%')?;
    let area = rest.chars().next()?;
    let rest = rest.get(area.len_utf8()..)?;
    let digits = rest.find(|c: char| c.is_ascii_digit())?;
    let size = match &rest[..digits] {
        "" | "X" => 0,
        "B" => 1,
        "W" => 2,
        "D" => 4,
        "L" => 8,
        _ => return None,
    };
    let mut path = rest[digits..].split('.').map(|part| part.parse().ok()).collect::<Option<Vec<u64>>>()?;
    let last = path.pop()?;
    // Of a bit, the last number is the bit, and the one before it that of the byte.
    let (number, bit) = if size == 0 { path.pop().map_or((0, last), |number| (number, last)) } else { (last, 0) };
    Some(Address { area, size, path, number, bit })
}

/// How the number of an address counts.
#[derive(Clone, Copy)]
enum Counting {
    /// Bytes.
    Bytes,
    /// Things of the address's own size; bits in words where there are more than eight.
    Own,
}

impl Address {
    /// Its bits, where it holds a value of `bytes` bytes.
    fn bits(&self, bytes: u64, counting: Counting) -> Range<u64> {
        let unit = match (counting, self.size) {
            (Counting::Own, 0) if self.bit > 7 => 2,
            (Counting::Bytes, _) | (_, 0) => 1,
            (Counting::Own, size) => size,
        };
        let start = self.number.saturating_mul(unit).saturating_mul(8).saturating_add(self.bit);
        let length = if self.size == 0 && bytes <= 1 { 1 } else { bytes.max(self.size).saturating_mul(8) };
        start..start.saturating_add(length)
    }

    fn overlaps(&self, own: u64, other: &Self, others: u64) -> bool {
        if self.area != other.area || self.path != other.path {
            return false;
        }
        let overlap = |counting| {
            let (a, b) = (self.bits(own, counting), other.bits(others, counting));
            a.start < b.end && b.start < a.end
        };
        let (bytes, units) = (overlap(Counting::Bytes), overlap(Counting::Own));
        if self.size == other.size { bytes && units } else { bytes || units }
    }
}

impl<'c> Elaborator<'c> {
    /// Refuses an address that lies on the bits of another one.
    pub(super) fn overlapping(&mut self, key: &str, type_: &Type, node: Node<'c>) -> Lowered<()> {
        let Some(own) = parse(key) else { return Ok(()) };
        let bytes = self.bytes(type_)?.map_or(0, |(bytes, _)| bytes);
        let known: Vec<(String, Spot)> = self.addresses.iter().map(|(key, spot)| (key.clone(), spot.clone())).collect();
        for (other, spot) in known {
            let Some(parsed) = parse(&other) else { continue };
            let others = self.bytes(&spot.type_)?.map_or(0, |(bytes, _)| bytes);
            if own.overlaps(bytes, &parsed, others) {
                let message = format!("`{key}` and `{other}` lie on the same bits, and are not modelled as one");
                let error = self.unsupported("addresses that overlap", node, message);
                return Err(error.help("use one of them, and take its bits out with `.0`, `.1`, …"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    fn overlap(one: (&str, u64), other: (&str, u64)) -> bool {
        let (a, b) = (parse(one.0).expect("an address"), parse(other.0).expect("an address"));
        assert_eq!(a.overlaps(one.1, &b, other.1), b.overlaps(other.1, &a, one.1));
        a.overlaps(one.1, &b, other.1)
    }

    #[test]
    fn bits_and_words_of_the_same_place_overlap() {
        assert!(overlap(("%IW0", 2), ("%IX0.0", 1)));
        assert!(overlap(("%IW0", 2), ("%IX1.7", 1)));
        assert!(overlap(("%IW0", 2), ("%IB1", 1)));
        assert!(overlap(("%QD0", 4), ("%QW1", 2)));
        assert!(overlap(("%MW1", 2), ("%MB1", 1)), "where words count bytes");
        assert!(overlap(("%MW1", 2), ("%MB2", 1)), "where words count words");
        assert!(overlap(("%IW0", 8), ("%IW3", 2)), "an array of four words, as words count");
        assert!(overlap(("%IX0.12", 1), ("%IW0", 2)), "a bit of a word");
    }

    #[test]
    fn neighbours_do_not() {
        assert!(!overlap(("%IW0", 2), ("%IW1", 2)));
        assert!(!overlap(("%IX0.0", 1), ("%IX0.1", 1)));
        assert!(!overlap(("%IX0.7", 1), ("%IX1.0", 1)));
        assert!(!overlap(("%IW0", 2), ("%QW0", 2)));
        assert!(!overlap(("%IW0", 2), ("%IX2.0", 1)));
        assert!(!overlap(("%IW2.0", 2), ("%IX3.0.0", 1)), "of another module");
        assert!(parse("%IW*").is_none() && parse("%I*").is_none());
    }
}
