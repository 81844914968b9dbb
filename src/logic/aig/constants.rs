//! Latches that never leave their first value, by three-valued simulation: begin with the first values and unknown inputs,
//! and give up each latch whose next value may differ, until none does.

use super::reduce::{LatchClause, Reduced, cone, identity, rebuild};
use super::{Gate, Lit, Model};

/// The model without them. The facts are their values.
#[must_use]
pub fn constants(model: &Model) -> Reduced {
    let known = fixed_point(model);
    let (mut substitute, mut facts) = (identity(model), Vec::<LatchClause>::new());
    for (index, value) in known.iter().enumerate() {
        if let Some(value) = value {
            substitute[model.latches[index].lit.node() as usize] = Lit::FALSE.invert_if(*value);
            facts.push(vec![(index, *value)]);
        }
    }
    rebuild(model, &substitute, facts).then(cone)
}

/// For each latch, the value that it keeps.
fn fixed_point(model: &Model) -> Vec<Option<bool>> {
    let mut known: Vec<Option<bool>> = model.latches.iter().map(|latch| latch.initial).collect();
    let mut values = vec![None; model.aig.len()];
    loop {
        for (latch, value) in model.latches.iter().zip(&known) {
            values[latch.lit.node() as usize] = *value;
        }
        for node in (0_u32..).take(model.aig.len()) {
            match model.aig.gate(node) {
                Gate::False => values[0] = Some(false),
                Gate::Leaf => {}
                Gate::And(a, b) => values[node as usize] = both(ternary(&values, a), ternary(&values, b)),
            }
        }
        let mut changed = false;
        for (latch, value) in model.latches.iter().zip(&mut known) {
            if value.is_some() && ternary(&values, latch.next) != *value {
                (*value, changed) = (None, true);
            }
        }
        if !changed {
            return known;
        }
    }
}

fn ternary(values: &[Option<bool>], lit: Lit) -> Option<bool> {
    values[lit.node() as usize].map(|value| value != lit.inverted())
}

fn both(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}
