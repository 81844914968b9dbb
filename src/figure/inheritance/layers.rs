//! The entity and its bases in layers.

use super::{Card, GAP, HEAD, Hierarchy, Link, MARGIN, Point, Shape, head, polyline};

/// More interfaces than this without bases of their own share one box.
const SEPARATE: usize = 3;
/// The distance between two tracks.
const TRACK: f64 = 9.0;
/// The width of the place that a link takes in a layer that it skips.
const SKIP: f64 = 10.0;

/// A place in a layer.
struct Cell<'a> {
    /// The box; `None` where a link passes.
    card: Option<Card<'a>>,
    /// Cells of the next layer (above) that it is linked to, and whether it implements them.
    up: Vec<(usize, bool)>,
    /// The left side, from the middle of the drawing.
    x: f64,
    /// For a stable order: where it came from.
    origin: usize,
}

impl Cell<'_> {
    fn width(&self) -> f64 {
        self.card.as_ref().map_or(SKIP, Card::width)
    }

    fn middle(&self) -> f64 {
        self.x + self.width() / 2.0
    }
}

/// The layers, the entity's own first.
pub(super) struct Layers<'a> {
    layers: Vec<Vec<Cell<'a>>>,
}

impl<'a> Layers<'a> {
    pub(super) fn new(hierarchy: &'a Hierarchy) -> Self {
        let links = acyclic(hierarchy);
        let depth = depths(hierarchy.nodes.len(), &links);
        let mut out = Self { layers: Vec::new() };
        let place = out.place(hierarchy, &links, &depth);
        out.connect(&links, &place);
        out.order();
        out.spread();
        out
    }

    /// Whether there is nothing but the entity.
    pub(super) fn is_single(&self) -> bool {
        self.layers.len() <= 1
    }

    /// Puts every node into a cell; returns each node's layer and cell.
    fn place(
        &mut self,
        hierarchy: &'a Hierarchy,
        links: &[Link],
        depth: &[Option<usize>],
    ) -> Vec<Option<(usize, usize)>> {
        let shared = shared(hierarchy, links);
        let mut place = vec![None; hierarchy.nodes.len()];
        let mut list: Option<(usize, usize)> = None;
        for (index, node) in hierarchy.nodes.iter().enumerate() {
            let Some(layer) = depth.get(index).copied().flatten() else { continue };
            self.layers.resize_with(self.layers.len().max(layer + 1), Vec::new);
            if let (true, Some((layer, cell))) = (shared.contains(&index), list) {
                if let Some(card) = &mut self.layers[layer][cell].card {
                    card.nodes.push(node);
                }
                place[index] = list;
                continue;
            }
            let mut card = Card::one(node);
            let at = (layer, self.layers[layer].len());
            if shared.contains(&index) {
                card.stereotype = Some("interfaces".to_owned());
                list = Some(at);
            }
            self.layers[layer].push(Cell { card: Some(card), up: Vec::new(), x: 0.0, origin: index });
            place[index] = Some(at);
        }
        place
    }

    /// Adds the links, with a cell in every layer that one skips.
    fn connect(&mut self, links: &[Link], place: &[Option<(usize, usize)>]) {
        for link in links {
            let (Some((mut layer, mut cell)), Some((top, target))) = (place[link.from], place[link.to]) else {
                continue;
            };
            while layer + 1 < top {
                let next = self.layers[layer + 1].len();
                self.layers[layer + 1].push(Cell { card: None, up: Vec::new(), x: 0.0, origin: link.to });
                self.layers[layer][cell].up.push((next, link.implements));
                (layer, cell) = (layer + 1, next);
            }
            let up = &mut self.layers[layer][cell].up;
            if !up.iter().any(|&(known, _)| known == target) {
                up.push((target, link.implements));
            }
        }
    }

    /// Orders each layer by the mean place of what it is linked to below.
    fn order(&mut self) {
        for index in 1..self.layers.len() {
            let mean = means(&self.layers[index - 1], self.layers[index].len());
            let mut order: Vec<usize> = (0..mean.len()).collect();
            let origin = |cell: usize| self.layers[index][cell].origin;
            order.sort_by(|&a, &b| mean[a].total_cmp(&mean[b]).then(origin(a).cmp(&origin(b))).then(a.cmp(&b)));
            self.reorder(index, &order);
        }
    }

    /// Puts the cells of a layer into an order and mends the links to them.
    fn reorder(&mut self, layer: usize, order: &[usize]) {
        let mut to = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            to[old] = new;
        }
        let mut cells: Vec<(usize, Cell<'a>)> = std::mem::take(&mut self.layers[layer])
            .into_iter()
            .enumerate()
            .map(|(old, cell)| (to[old], cell))
            .collect();
        cells.sort_by_key(|(new, _)| *new);
        self.layers[layer] = cells.into_iter().map(|(_, cell)| cell).collect();
        for (up, _) in self.layers[layer - 1].iter_mut().flat_map(|cell| &mut cell.up) {
            *up = to[*up];
        }
    }

    /// Gives every cell its place in its layer: near what it is linked to, with the entity's middle at 0.
    fn spread(&mut self) {
        for layer in &mut self.layers {
            let mut x = -layer_width(layer) / 2.0;
            for cell in layer {
                cell.x = x;
                x += cell.width() + GAP;
            }
        }
        for _ in 0..3 {
            for index in (0..self.layers.len()).rev().skip(1) {
                let wanted = self.wanted(index, false);
                settle(&mut self.layers[index], &wanted);
            }
            for index in 1..self.layers.len() {
                let wanted = self.wanted(index, true);
                settle(&mut self.layers[index], &wanted);
            }
        }
        let middle = self.layers.first().and_then(|layer| layer.first()).map_or(0.0, Cell::middle);
        self.layers.iter_mut().flatten().for_each(|cell| cell.x = (cell.x - middle).round());
    }

    /// Where the middle of each cell of a layer would best be: at the mean of its neighbours below or above.
    #[expect(clippy::cast_precision_loss, reason = "a layer has few cells")]
    fn wanted(&self, index: usize, from_below: bool) -> Vec<f64> {
        let layer = &self.layers[index];
        let neighbours = |cell: usize| -> Vec<f64> {
            if from_below {
                let linked = |below: &&Cell<'_>| below.up.iter().any(|&(up, _)| up == cell);
                self.layers[index - 1].iter().filter(linked).map(Cell::middle).collect()
            } else {
                layer[cell].up.iter().map(|&(up, _)| self.layers[index + 1][up].middle()).collect()
            }
        };
        let mean = |cell: usize| {
            let list = neighbours(cell);
            if list.is_empty() { layer[cell].middle() } else { list.iter().sum::<f64>() / list.len() as f64 }
        };
        (0..layer.len()).map(mean).collect()
    }

    /// How far the layers reach to the left and to the right of the entity's middle.
    pub(super) fn reach(&self) -> (f64, f64) {
        let cells = self.layers.iter().flatten();
        cells.fold((0.0, 0.0), |(left, right): (f64, f64), cell| (left.max(-cell.x), right.max(cell.x + cell.width())))
    }

    /// Draws the layers from the top; returns where the entity's box ends.
    pub(super) fn draw(&self, shapes: &mut Vec<Shape>, middle: f64) -> f64 {
        let mut top = MARGIN;
        let mut foot = top;
        for index in (0..self.layers.len()).rev() {
            let height = layer_height(&self.layers[index]);
            for cell in &self.layers[index] {
                self.draw_cell(shapes, cell, middle, (top, height), index == 0);
            }
            foot = top + height;
            if let Some(below) = index.checked_sub(1) {
                top = self.draw_links(shapes, below, middle, foot);
            }
        }
        foot
    }

    /// Draws a box at the foot of its layer, or the link that passes.
    fn draw_cell(&self, shapes: &mut Vec<Shape>, cell: &Cell<'_>, middle: f64, (top, height): (f64, f64), focus: bool) {
        match &cell.card {
            Some(card) => shapes.push(card.draw(Point::new(middle + cell.x, top + height - card.height()), focus)),
            None => {
                let x = middle + cell.middle();
                let dashed = cell.up.iter().all(|&(_, implements)| implements);
                shapes.push(polyline(vec![Point::new(x, top), Point::new(x, top + height)], dashed));
            }
        }
    }

    /// Draws the links from a layer to the one above, which ends at `y`; returns where the layer begins.
    #[expect(clippy::cast_precision_loss, reason = "a layer has few cells")]
    fn draw_links(&self, shapes: &mut Vec<Shape>, below: usize, middle: f64, y: f64) -> f64 {
        let above = &self.layers[below + 1];
        let targets: Vec<usize> = (0..above.len()).collect();
        let bottom = y + HEAD + 8.0 + TRACK * targets.len() as f64 + 6.0;
        let foot = layer_height(&self.layers[below]);
        for cell in &self.layers[below] {
            let mut up = cell.up.clone();
            up.sort_by_key(|&(target, _)| target);
            let end = bottom + cell.card.as_ref().map_or(0.0, |card| foot - card.height());
            for (port, &(target, implements)) in up.iter().enumerate() {
                let share = (port as f64 + 1.0) / (up.len() as f64 + 1.0);
                let from = middle + cell.x + cell.width() * share;
                let to = middle + above[target].middle();
                let is_box = above[target].card.is_some();
                let tip = if is_box { y + HEAD } else { y };
                let track = y + HEAD + 8.0 + TRACK * target as f64;
                let bend = [Point::new(from, track), Point::new(to, track)];
                let mut points = vec![Point::new(from, end)];
                points.extend(bend.into_iter().filter(|_| (from - to).abs() > 0.5));
                points.push(Point::new(to, tip));
                shapes.push(polyline(points, implements));
            }
        }
        let linked = |target: &usize| above[*target].card.is_some();
        shapes.extend(
            targets
                .iter()
                .filter(|target| linked(target))
                .map(|&target| head(Point::new(middle + above[target].middle(), y))),
        );
        bottom
    }
}

/// Moves the cells of a layer as near as they can be to where they want their middles, in order and
/// apart: the mean of pushing to the right and of pushing to the left.
fn settle(layer: &mut [Cell<'_>], wanted: &[f64]) {
    let widths: Vec<f64> = layer.iter().map(Cell::width).collect();
    let mut right: Vec<f64> = wanted.iter().zip(&widths).map(|(middle, width)| middle - width / 2.0).collect();
    let mut left = right.clone();
    for index in 1..right.len() {
        right[index] = right[index].max(right[index - 1] + widths[index - 1] + GAP);
    }
    for index in (0..left.len().saturating_sub(1)).rev() {
        left[index] = left[index].min(left[index + 1] - widths[index] - GAP);
    }
    for (index, cell) in layer.iter_mut().enumerate() {
        cell.x = f64::midpoint(left[index], right[index]);
    }
}

/// The width of a layer with its gaps.
#[expect(clippy::cast_precision_loss, reason = "a layer has few cells")]
fn layer_width(layer: &[Cell<'_>]) -> f64 {
    layer.iter().map(Cell::width).sum::<f64>() + GAP * layer.len().saturating_sub(1) as f64
}

/// The height of the highest box of a layer.
fn layer_height(layer: &[Cell<'_>]) -> f64 {
    layer.iter().filter_map(|cell| cell.card.as_ref()).map(Card::height).fold(0.0, f64::max)
}

/// For each cell of the layer above: the mean place of the cells below that are linked to it.
#[expect(clippy::cast_precision_loss, reason = "a layer has few cells")]
fn means(below: &[Cell<'_>], above: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); above];
    for (index, cell) in below.iter().enumerate() {
        for &(up, _) in &cell.up {
            sums[up].0 += index as f64;
            sums[up].1 += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count): (f64, f64)| if count > 0.0 { sum / count } else { 0.0 }).collect()
}

/// The links that are reached from the entity, without those that would close a cycle.
fn acyclic(hierarchy: &Hierarchy) -> Vec<Link> {
    let count = hierarchy.nodes.len();
    let mut out = Vec::new();
    // 0: not seen, 1: on the path, 2: done.
    let mut state = vec![0_u8; count];
    let mut path = vec![(0_usize, 0_usize)];
    while let Some((node, next)) = path.pop() {
        state[node] = 1;
        let found =
            hierarchy.links.iter().enumerate().skip(next).find(|(_, link)| link.from == node && link.to < count);
        let Some((index, link)) = found else {
            state[node] = 2;
            continue;
        };
        path.push((node, index + 1));
        if state[link.to] != 1 {
            out.push(*link);
        }
        if state[link.to] == 0 {
            path.push((link.to, 0));
        }
    }
    out
}

/// Each node's layer: the length of the longest way to it; `None` for what is not reached.
fn depths(count: usize, links: &[Link]) -> Vec<Option<usize>> {
    let mut depth = vec![None; count];
    if let Some(focus) = depth.first_mut() {
        *focus = Some(0);
    }
    // Without cycles this settles after as many rounds as there are nodes.
    for _ in 0..count {
        for link in links {
            if let Some(from) = depth[link.from] {
                depth[link.to] = depth[link.to].max(Some(from + 1));
            }
        }
    }
    depth
}

/// The interfaces that share a box: those without bases that only the entity implements, if they are many.
fn shared(hierarchy: &Hierarchy, links: &[Link]) -> Vec<usize> {
    let alone = |index: &usize| {
        let node = &hierarchy.nodes[*index];
        let above = links.iter().any(|link| link.from == *index);
        let mut below = links.iter().filter(|link| link.to == *index);
        *index > 0 && node.interface && !above && below.all(|link| link.from == 0 && link.implements)
    };
    let list: Vec<usize> = (0..hierarchy.nodes.len()).filter(alone).collect();
    if list.len() > SEPARATE { list } else { Vec::new() }
}
