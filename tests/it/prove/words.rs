//! Words over a graph, least significant bit first: enough to write down systems as PLC programs have them.

use rungbook::logic::aig::{Latch, Lit, Model};

pub(crate) type Word = Vec<Lit>;

/// A model under construction.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) model: Model,
    /// The latched words, for engines that reason on words.
    pub(crate) words: Vec<Word>,
}

impl Builder {
    pub(crate) fn input(&mut self, width: usize) -> Word {
        let word: Word = (0..width).map(|_| self.model.aig.leaf()).collect();
        self.model.inputs.extend(&word);
        word
    }

    pub(crate) fn bit(&mut self) -> Lit {
        self.input(1)[0]
    }

    /// A latched word; its next value is set by `latch`.
    pub(crate) fn state(&mut self, width: usize) -> Word {
        let word: Word = (0..width).map(|_| self.model.aig.leaf()).collect();
        if width > 1 {
            self.words.push(word.clone());
        }
        word
    }

    pub(crate) fn latch(&mut self, word: &[Lit], next: &[Lit], initial: Option<u64>) {
        for (i, (&lit, &next)) in word.iter().zip(next).enumerate() {
            let initial = initial.map(|v| v >> i & 1 == 1);
            self.model.latches.push(Latch { lit, next, initial });
        }
    }

    pub(crate) fn constant(width: usize, value: u64) -> Word {
        (0..width).map(|i| Lit::FALSE.invert_if(value >> i & 1 == 1)).collect()
    }

    pub(crate) fn add(&mut self, a: &[Lit], b: &[Lit], carry: Lit) -> (Word, Lit) {
        let g = &mut self.model.aig;
        let mut carry = carry;
        let mut out = Vec::new();
        for (&x, &y) in a.iter().zip(b) {
            let half = g.xor(x, y);
            out.push(g.xor(half, carry));
            let (both, through) = (g.and(x, y), g.and(half, carry));
            carry = g.or(both, through);
        }
        (out, carry)
    }

    pub(crate) fn increment(&mut self, a: &[Lit], by: u64) -> Word {
        self.add(a, &Self::constant(a.len(), by), Lit::FALSE).0
    }

    pub(crate) fn equal(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let mut all = Lit::TRUE;
        for (&x, &y) in a.iter().zip(b) {
            let differ = self.model.aig.xor(x, y);
            all = self.model.aig.and(all, !differ);
        }
        all
    }

    pub(crate) fn equals(&mut self, a: &[Lit], value: u64) -> Lit {
        self.equal(a, &Self::constant(a.len(), value))
    }

    /// Unsigned.
    pub(crate) fn below(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        // b + (2^n - 1 - a) carries exactly if b > a
        let inverted: Word = a.iter().map(|&l| !l).collect();
        self.add(b, &inverted, Lit::FALSE).1
    }

    /// Signed.
    pub(crate) fn less(&mut self, a: &[Lit], b: &[Lit]) -> Lit {
        let flip = |w: &[Lit]| {
            let mut w = w.to_vec();
            let last = w.len() - 1;
            w[last] = !w[last];
            w
        };
        self.below(&flip(a), &flip(b))
    }

    pub(crate) fn choose(&mut self, c: Lit, t: &[Lit], e: &[Lit]) -> Word {
        t.iter().zip(e).map(|(&t, &e)| self.model.aig.ite(c, t, e)).collect()
    }

    pub(crate) fn multiply(&mut self, a: &[Lit], b: &[Lit]) -> Word {
        let width = a.len();
        let mut sum = Self::constant(width, 0);
        for (i, &bit) in b.iter().enumerate() {
            let mut row = Self::constant(width, 0);
            for j in 0..width - i {
                row[i + j] = self.model.aig.and(a[j], bit);
            }
            sum = self.add(&sum, &row, Lit::FALSE).0;
        }
        sum
    }
}
