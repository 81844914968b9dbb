//! Models as binary AIGER 1.9 files, for comparison with other checkers. Constraints are folded into the bad literal.

use rungbook::logic::aig::{Gate, Latch, Lit, Model};

fn number(out: &mut Vec<u8>, mut value: u32) {
    while value >= 0x80 {
        out.push((value & 0x7F) as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

/// The file.
pub(crate) fn write(model: &Model) -> Vec<u8> {
    let model = model.folded();
    let mut place = vec![0u32; model.aig.len()];
    let leaves = model.inputs.iter().copied().chain(model.latches.iter().map(|l| l.lit));
    let mut count = 0;
    for leaf in leaves {
        count += 1;
        place[leaf.node() as usize] = 2 * count;
    }
    let base = count;
    for node in 0..model.aig.len() as u32 {
        if let Gate::And(..) = model.aig.gate(node) {
            count += 1;
            place[node as usize] = 2 * count;
        }
    }
    let at = |l: Lit| place[l.node() as usize] ^ u32::from(l.inverted());
    let (inputs, latches) = (model.inputs.len(), model.latches.len());
    let mut out = format!("aig {count} {inputs} {latches} 1 {}\n", count - base).into_bytes();
    for latch in &model.latches {
        let line = match latch.initial {
            Some(false) => format!("{}\n", at(latch.next)),
            Some(true) => format!("{} 1\n", at(latch.next)),
            None => format!("{} {}\n", at(latch.next), at(latch.lit)),
        };
        out.extend(line.bytes());
    }
    out.extend(format!("{}\n", at(model.bad[0])).bytes());
    for node in 0..model.aig.len() as u32 {
        if let Gate::And(a, b) = model.aig.gate(node) {
            let (a, b) = (at(a).max(at(b)), at(a).min(at(b)));
            number(&mut out, place[node as usize] - a);
            number(&mut out, a - b);
        }
    }
    out
}

/// Reads what `write` writes: no constraints, one output, which is bad.
pub(crate) fn read(file: &[u8]) -> Model {
    let mut rest = file;
    let mut line = || {
        let end = rest.iter().position(|&b| b == b'\n').expect("a line");
        let text = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[end + 1..];
        text.split(' ').filter_map(|n| n.parse::<u32>().ok()).collect::<Vec<_>>()
    };
    let head = line();
    let (inputs, latches, gates) = (head[1], head[2], head[4]);
    let states: Vec<Vec<u32>> = (0..latches).map(|_| line()).collect();
    let bad = line()[0];
    let mut model = Model::default();
    model.inputs = (0..inputs).map(|_| model.aig.leaf()).collect();
    let leaves: Vec<Lit> = (0..latches).map(|_| model.aig.leaf()).collect();
    let mut known = vec![Lit::FALSE];
    known.extend(model.inputs.iter().chain(&leaves));
    let mut bytes = rest.iter();
    let mut delta = || {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = *bytes.next().expect("a byte");
            value |= u32::from(byte & 0x7F) << shift;
            shift += 7;
            if byte & 0x80 == 0 {
                return value;
            }
        }
    };
    let at = |known: &[Lit], l: u32| known[(l / 2) as usize].invert_if(l % 2 == 1);
    for gate in 0..gates {
        let a = 2 * (inputs + latches + 1 + gate) - delta();
        let b = a - delta();
        let lit = model.aig.and(at(&known, a), at(&known, b));
        known.push(lit);
    }
    for (state, &lit) in states.iter().zip(&leaves) {
        let initial = match state.get(1) {
            None | Some(0) => Some(false),
            Some(1) => Some(true),
            Some(_) => None,
        };
        model.latches.push(Latch { lit, next: at(&known, state[0]), initial });
    }
    model.bad = vec![at(&known, bad)];
    model
}
