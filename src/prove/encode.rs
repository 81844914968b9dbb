//! A graph as clauses: each node a variable of the same number, with conjunctions over several levels taken together and
//! multiplexers (exclusive disjunctions among them) encoded as such. After Eén, Mishchenko and Sörensson, "Applying logic
//! synthesis for speeding up SAT" (SAT 2007), without the mapping to lookup tables.

use crate::logic::aig::{Aig, Gate, Lit};

/// Clauses of a graph, and which variables each one's meaning rests on.
#[derive(Debug)]
pub(crate) struct Encoding {
    /// How many variables: one a node.
    pub(crate) variables: usize,
    ends: Vec<u32>,
    lits: Vec<Lit>,
    below: Vec<u32>,
    starts: Vec<u32>,
}

/// What a node is taken as.
enum Shape {
    Leaf,
    All(Vec<Lit>),
    /// Condition, then, else, of the node inverted.
    Choice(Lit, Lit, Lit),
}

impl Encoding {
    /// The clauses of everything below `roots`.
    pub(crate) fn new(aig: &Aig, roots: &[Lit]) -> Self {
        let uses = count_uses(aig, roots);
        let mut shown = vec![false; aig.len()];
        let mut shapes: Vec<Option<Shape>> = (0..aig.len()).map(|_| None).collect();
        for root in roots {
            shown[root.node() as usize] = true;
        }
        for node in (0..aig.len() as u32).rev() {
            if !shown[node as usize] {
                continue;
            }
            let shape = shape(aig, node, &uses);
            match &shape {
                Shape::Leaf => {}
                Shape::All(lits) => lits.iter().for_each(|l| shown[l.node() as usize] = true),
                Shape::Choice(c, t, e) => [c, t, e].iter().for_each(|l| shown[l.node() as usize] = true),
            }
            shapes[node as usize] = Some(shape);
        }
        let mut encoding =
            Self { variables: aig.len(), ends: Vec::new(), lits: Vec::new(), below: Vec::new(), starts: vec![0] };
        encoding.clause(&[Lit::TRUE]);
        for (node, shape) in shapes.into_iter().enumerate() {
            encoding.emit(Lit::of(node as u32), shape.unwrap_or(Shape::Leaf));
        }
        encoding
    }

    fn clause(&mut self, lits: &[Lit]) {
        self.lits.extend_from_slice(lits);
        self.ends.push(self.lits.len() as u32);
    }

    fn emit(&mut self, out: Lit, shape: Shape) {
        match shape {
            Shape::Leaf => {}
            Shape::All(lits) => {
                let mut long = vec![out];
                for &lit in &lits {
                    self.clause(&[!out, lit]);
                    long.push(!lit);
                }
                self.clause(&long);
                self.below.extend(lits.iter().map(|l| l.node()));
            }
            Shape::Choice(c, t, e) => {
                self.clause(&[!c, t, out]);
                self.clause(&[!c, !t, !out]);
                self.clause(&[c, e, out]);
                self.clause(&[c, !e, !out]);
                if t.node() == e.node() {
                    self.below.extend([c.node(), t.node()]);
                } else {
                    self.clause(&[t, e, out]);
                    self.clause(&[!t, !e, !out]);
                    self.below.extend([c.node(), t.node(), e.node()]);
                }
            }
        }
        self.starts.push(self.below.len() as u32);
    }

    /// The clauses.
    pub(crate) fn clauses(&self) -> impl Iterator<Item = &[Lit]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let clause = &self.lits[start..end as usize];
            start = end as usize;
            clause
        })
    }

    /// Variables that `variable` is a function of, directly.
    pub(crate) fn below(&self, variable: u32) -> &[u32] {
        let at = variable as usize;
        if at + 1 >= self.starts.len() {
            return &[];
        }
        &self.below[self.starts[at] as usize..self.starts[at + 1] as usize]
    }

    /// Adds to `domain` everything below `roots` that `marked` does not hold yet, and marks it.
    pub(crate) fn close(&self, roots: impl Iterator<Item = u32>, domain: &mut Vec<u32>, marked: &mut [bool]) {
        let mut next = domain.len();
        for root in roots {
            if !std::mem::replace(&mut marked[root as usize], true) {
                domain.push(root);
            }
        }
        while next < domain.len() {
            for &variable in self.below(domain[next]) {
                if !std::mem::replace(&mut marked[variable as usize], true) {
                    domain.push(variable);
                }
            }
            next += 1;
        }
    }
}

fn count_uses(aig: &Aig, roots: &[Lit]) -> Vec<u32> {
    let mut uses = vec![0; aig.len()];
    for root in roots {
        uses[root.node() as usize] += 2;
    }
    for node in (0..aig.len() as u32).rev() {
        if uses[node as usize] > 0
            && let Gate::And(a, b) = aig.gate(node)
        {
            uses[a.node() as usize] += 1;
            uses[b.node() as usize] += 1;
        }
    }
    uses
}

/// `node` as a multiplexer: it is not x and not y, with x = c and t, y = not c and e, and is so the inverse of `c ? t : e`.
fn choice(aig: &Aig, node: u32, uses: &[u32]) -> Option<(Lit, Lit, Lit)> {
    let Gate::And(x, y) = aig.gate(node) else { return None };
    if !x.inverted() || !y.inverted() || uses[x.node() as usize] > 1 || uses[y.node() as usize] > 1 {
        return None;
    }
    let (Gate::And(a, b), Gate::And(c, d)) = (aig.gate(x.node()), aig.gate(y.node())) else { return None };
    for (p, t) in [(a, b), (b, a)] {
        for (q, e) in [(c, d), (d, c)] {
            if p == !q {
                return Some((p, t, e));
            }
        }
    }
    None
}

fn shape(aig: &Aig, node: u32, uses: &[u32]) -> Shape {
    let Gate::And(a, b) = aig.gate(node) else { return Shape::Leaf };
    if let Some((c, t, e)) = choice(aig, node, uses) {
        return Shape::Choice(c, t, e);
    }
    let (mut lits, mut open) = (Vec::new(), vec![a, b]);
    while let Some(lit) = open.pop() {
        match aig.gate(lit.node()) {
            Gate::And(a, b)
                if !lit.inverted() && uses[lit.node() as usize] == 1 && choice(aig, lit.node(), uses).is_none() =>
            {
                open.extend([a, b]);
            }
            _ => lits.push(lit),
        }
    }
    lits.sort_unstable();
    lits.dedup();
    Shape::All(lits)
}
