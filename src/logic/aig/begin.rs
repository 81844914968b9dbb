//! First values: a cycle before all others that gives them, for tools that know none but 0 and 1, and the way back.

use super::reduce::{identity, substituted, through};
use super::{Gate, Latch, Lit, Model};

impl Model {
    /// The same model with a first value for every latch, for tools that know no others: a cycle that counts for nothing
    /// comes before all others, in which one more input for each latch without a first value gives that. The last latch
    /// remembers that this cycle is over.
    #[must_use]
    pub fn with_first_values(&self) -> Self {
        let mut model = self.clone();
        if self.latches.iter().all(|latch| latch.initial.is_some()) {
            return model;
        }
        let started = model.aig.leaf();
        for latch in &mut model.latches {
            let first = match latch.initial {
                Some(value) => Lit::FALSE.invert_if(value),
                None => {
                    let input = model.aig.leaf();
                    model.inputs.push(input);
                    input
                }
            };
            let (later, before) = (model.aig.and(started, latch.next), model.aig.and(!started, first));
            latch.next = model.aig.or(later, before);
            latch.initial = Some(latch.initial.unwrap_or(false));
        }
        model.latches.push(Latch { lit: started, next: Lit::TRUE, initial: Some(false) });
        model.bad = self.bad.iter().map(|bad| model.aig.and(*bad, started)).collect();
        model.constraints = self.constraints.iter().map(|held| model.aig.or(*held, !started)).collect();
        model
    }

    /// The model without the cycle that [`Self::with_first_values`] or another tool put before all others, and without the
    /// latch that remembers it, at whose place the others move up; its runs are one cycle shorter. The model itself where its first cycle does more than give first values. This is temporal decomposition (Case, Mony,
    /// Baumgartner, Kanzelman, *Enhanced Verification by Temporal Decomposition*, FMCAD 2009) for the one case in which
    /// no logic is needed for it.
    #[must_use]
    pub fn without_first_cycle(self) -> Self {
        let is_begun = |latch: &Latch| latch.initial == Some(false) && latch.next == Lit::TRUE;
        let Some(begun) = self.latches.iter().position(is_begun) else { return self };
        let Some(values) = self.given_first() else { return self };
        let mut substitute = identity(&self);
        substitute[self.latches[begun].lit.node() as usize] = Lit::TRUE;
        let (aig, map) = substituted(&self, &substitute);
        let all = |lits: &[Lit]| lits.iter().map(|lit| through(&map, *lit)).collect::<Vec<Lit>>();
        let latches = self.latches.iter().zip(values).map(|(latch, initial)| Latch {
            lit: through(&map, latch.lit),
            next: through(&map, latch.next),
            initial,
        });
        let mut latches: Vec<Latch> = latches.collect();
        latches.remove(begun);
        let (inputs, constraints, bad) = (all(&self.inputs), all(&self.constraints), all(&self.bad));
        Self { aig, inputs, latches, constraints, bad }
    }

    /// The values after the first cycle, where each is known or an input of its own, and nothing else happens in it.
    fn given_first(&self) -> Option<Vec<Option<bool>>> {
        let mut substitute = identity(self);
        for latch in &self.latches {
            substitute[latch.lit.node() as usize] = Lit::FALSE.invert_if(latch.initial?);
        }
        let (aig, map) = substituted(self, &substitute);
        let is_idle = self.bad.iter().all(|bad| through(&map, *bad) == Lit::FALSE)
            && self.constraints.iter().all(|held| through(&map, *held) == Lit::TRUE);
        let mut used = vec![false; aig.len()];
        let mut value = |latch: &Latch| {
            let next = through(&map, latch.next);
            let (node, inverted) = (next.node(), next.inverted());
            let is_new = node == 0 || !std::mem::replace(&mut used[node as usize], true);
            (is_new && (node == 0 || aig.gate(node) == Gate::Leaf)).then(|| (node == 0).then_some(inverted))
        };
        self.latches.iter().map(&mut value).collect::<Option<Vec<_>>>().filter(|_| is_idle)
    }
}
