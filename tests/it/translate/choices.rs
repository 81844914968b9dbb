//! A stream of numbers from which everything random is chosen; behind its end all are zero, the simplest choice, so that a
//! shorter stream is a simpler case.

use rungbook::semantics::scalar::{DateKind, Scalar};
use rungbook::text::{FileId, Place, Span};

pub(super) struct Choices<'a> {
    stream: &'a [u32],
    at: usize,
    places: u32,
    /// Neither `REAL` nor strings.
    pub(super) integers_only: bool,
}

/// The scalar types, in order of simplicity.
pub(super) const SCALARS: [Scalar; 23] = [
    Scalar::Bool,
    int(true, 16),
    int(false, 8),
    int(true, 8),
    int(false, 16),
    int(true, 32),
    int(false, 32),
    int(true, 64),
    int(false, 64),
    Scalar::Bits(8),
    Scalar::Bits(16),
    Scalar::Bits(32),
    Scalar::Bits(64),
    Scalar::Time(32),
    Scalar::Time(64),
    Scalar::Date(DateKind::Date, 32),
    Scalar::Date(DateKind::TimeOfDay, 32),
    Scalar::Date(DateKind::DateAndTime, 32),
    Scalar::Date(DateKind::Date, 64),
    Scalar::Date(DateKind::TimeOfDay, 64),
    Scalar::Date(DateKind::DateAndTime, 64),
    Scalar::Real(32),
    Scalar::Real(64),
];

pub(super) const fn int(signed: bool, width: u32) -> Scalar {
    Scalar::Int { signed, width }
}

const REALS: [f64; 12] = [0.0, 1.0, -1.0, 0.5, 2.5, -0.0, 0.1, 1e10, -3e38, f64::INFINITY, f64::NAN, f64::MIN_POSITIVE];

impl<'a> Choices<'a> {
    pub(super) const fn new(stream: &'a [u32]) -> Self {
        Self { stream, at: 0, places: 0, integers_only: false }
    }

    pub(super) const fn integers(stream: &'a [u32]) -> Self {
        Self { integers_only: true, ..Self::new(stream) }
    }

    /// The types to choose from.
    pub(super) fn scalars(&self) -> &'static [Scalar] {
        if self.integers_only { &SCALARS[..SCALARS.len() - 2] } else { &SCALARS }
    }

    pub(super) fn next(&mut self) -> u32 {
        self.at += 1;
        self.stream.get(self.at - 1).copied().unwrap_or(0)
    }

    /// A number below `count`.
    pub(super) fn below(&mut self, count: u32) -> u32 {
        self.next() % count.max(1)
    }

    /// One of some things.
    pub(super) fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u32) as usize]
    }

    /// True once in `of` times.
    pub(super) fn once_in(&mut self, of: u32) -> bool {
        self.below(of) == of - 1
    }

    pub(super) fn scalar(&mut self) -> Scalar {
        self.one(self.scalars())
    }

    /// A place that nothing else has.
    pub(super) fn place(&mut self) -> Option<Place> {
        self.places += 1;
        Some(Place::new(FileId(0), Span::at(self.places)))
    }

    /// Bits of a type, often those where something happens.
    pub(super) fn bits(&mut self, scalar: Scalar) -> u64 {
        let width = scalar.width();
        let all = u64::MAX >> (64 - width);
        let wide = |choices: &mut Self| u64::from(choices.next()) << 32 | u64::from(choices.next());
        if let Scalar::Real(format) = scalar {
            return match self.below(4) {
                0 | 1 => {
                    let number = self.one(&REALS);
                    if format == 32 { u64::from((number as f32).to_bits()) } else { number.to_bits() }
                }
                2 => {
                    let number = f64::from(self.next() as i32) / 64.0;
                    if format == 32 { u64::from((number as f32).to_bits()) } else { number.to_bits() }
                }
                _ => wide(self) & all,
            };
        }
        let value = match self.below(8) {
            0 | 1 => u64::from(self.below(4)),
            2 => all,
            3 => all >> 1,
            4 => 1 << (width - 1),
            5 => u64::from(self.below(100)),
            6 => u64::from(self.below(100)).wrapping_neg(),
            _ => wide(self),
        };
        value & all
    }
}

/// A stream from a seed (SplitMix64: Steele, Lea and Flood, *Fast splittable pseudorandom number generators*, 2014).
pub(super) fn stream(seed: u64, length: usize) -> Vec<u32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as u32
    };
    (0..length).map(|_| next()).collect()
}
