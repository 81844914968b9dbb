//! A fast hasher for small keys of our own making: the multiplicative one of the Rust compiler (`FxHasher`). Nothing here
//! iterates over a hash table, so that no order depends on it.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

const FACTOR: u64 = 0x517c_c1b7_2722_0a95;

/// The hasher.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fast(u64);

/// A table with this hasher.
pub type FastMap<K, V> = HashMap<K, V, BuildHasherDefault<Fast>>;

impl Fast {
    fn mix(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(FACTOR);
    }
}

impl Hasher for Fast {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            self.mix(chunk.iter().fold(0, |value, byte| value << 8 | u64::from(*byte)));
        }
    }

    fn write_u8(&mut self, value: u8) {
        self.mix(u64::from(value));
    }

    fn write_u32(&mut self, value: u32) {
        self.mix(u64::from(value));
    }

    fn write_u64(&mut self, value: u64) {
        self.mix(value);
    }

    fn write_usize(&mut self, value: usize) {
        self.mix(value as u64);
    }

    // The table takes its place from the high bits and the low ones; multiplication mixes upward only.
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }
}
