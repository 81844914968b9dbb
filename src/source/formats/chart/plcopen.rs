//! Charts of PLCopen XML: elements with numbers, connected from each input back to the output before it.

use std::collections::BTreeMap;

use super::super::xhtml;
use super::{Action, Chart, Facts, Read, Refusal, Step, Transition, Word, trimmed};
use crate::source::fragment::FragmentBuilder;
use crate::source::xml::Element;
use crate::text::{Body, Fragment, Object, ObjectKind};

/// So many combinations of steps may stand before one transition.
const MAX_ALTERNATIVES: usize = 256;

/// The chart in `sfc`.
pub(in super::super) fn read(sfc: Element<'_>) -> Read<Chart> {
    let graph = Graph::new(sfc)?;
    let mut chart = Chart::default();
    for element in sfc.children_named("step") {
        chart.steps.push(step(element)?);
    }
    for block in sfc.children_named("actionBlock") {
        let before = inputs(block).first().and_then(|id| graph.element(id)).filter(|found| found.name() == "step");
        let Some(before) = before else {
            return Err(Refusal::new(block.name_span(), "an action block stands at no step"));
        };
        if block.value("negated").is_some_and(|value| value == "true" || value == "1") {
            return Err(Refusal::new(block.name_span(), "a negated action block"));
        }
        let at = sfc.children_named("step").position(|step| step.span() == before.span()).unwrap_or(0);
        for element in block.children_named("action") {
            let action = action(element, &mut chart)?;
            chart.steps[at].actions.push(action);
        }
    }
    let mut transitions: Vec<Element<'_>> = sfc.children_named("transition").collect();
    // Of transitions that compete, the one farther left comes first; the sort is stable.
    transitions.sort_by_key(|element| column(*element));
    for element in transitions {
        chart.transitions.extend(transition(&graph, element)?);
    }
    Ok(chart)
}

/// Where the element is drawn, from left to right.
fn column(element: Element<'_>) -> i64 {
    let x = element.child("position").and_then(|position| position.value("x"));
    x.and_then(|x| x.trim().parse::<f64>().ok()).map_or(0, |x| x as i64)
}

struct Graph<'x> {
    elements: BTreeMap<String, Element<'x>>,
    /// What is connected to the output of each.
    behind: BTreeMap<String, Vec<Element<'x>>>,
}

impl<'x> Graph<'x> {
    fn new(sfc: Element<'x>) -> Read<Self> {
        let mut graph = Self { elements: BTreeMap::new(), behind: BTreeMap::new() };
        for element in sfc.children() {
            if element.name() == "macroStep" {
                return Err(Refusal::new(element.name_span(), "a macro step"));
            }
            let Some(id) = element.value("localId") else { continue };
            if !matches!(element.name(), "inVariable" | "actionBlock") {
                for before in inputs(element) {
                    graph.behind.entry(before).or_default().push(element);
                }
            }
            if graph.elements.insert(id, element).is_some() {
                return Err(Refusal::new(element.name_span(), "two elements have one number"));
            }
        }
        Ok(graph)
    }

    fn element(&self, id: &str) -> Option<Element<'x>> {
        self.elements.get(id).copied()
    }

    fn behind(&self, element: Element<'x>) -> &[Element<'x>] {
        element.value("localId").and_then(|id| self.behind.get(&id)).map_or(&[], Vec::as_slice)
    }

    /// The steps before `element`: alternatives, each of them steps that must all be active.
    fn before(&self, element: Element<'x>, depth: usize) -> Read<Vec<Vec<Fragment>>> {
        let span = element.name_span();
        let mut each = Vec::new();
        for id in inputs(element) {
            let Some(found) = self.element(&id) else {
                return Err(Refusal::new(span, format!("a connection to the element {id}, which is missing")));
            };
            each.push((found, self.ending(found, depth)?));
        }
        let simultaneous = element.name() == "simultaneousConvergence";
        if simultaneous && each.iter().any(|(found, _)| found.name() == "jumpStep") {
            return Err(Refusal::new(span, "a parallel branch ends in a jump"));
        }
        if !simultaneous {
            return Ok(each.into_iter().flat_map(|(_, alternatives)| alternatives).collect());
        }
        let mut joined: Vec<Vec<Fragment>> = vec![Vec::new()];
        for (_, alternatives) in each {
            let longer = |left: &Vec<Fragment>| {
                let left = left.clone();
                alternatives.iter().map(move |right| left.iter().chain(right).cloned().collect()).collect::<Vec<_>>()
            };
            joined = joined.iter().flat_map(longer).collect();
            if joined.len() > MAX_ALTERNATIVES {
                return Err(Refusal::new(span, "too many combinations of steps before a transition"));
            }
        }
        Ok(joined)
    }

    /// The steps that stand behind a transition through its connection to `found`.
    fn ending(&self, found: Element<'x>, depth: usize) -> Read<Vec<Vec<Fragment>>> {
        match found.name() {
            "step" => Ok(vec![vec![named(found, "name")?]]),
            "jumpStep" => Ok(Vec::new()),
            "selectionDivergence" | "selectionConvergence" | "simultaneousConvergence"
                if depth <= self.elements.len() =>
            {
                self.before(found, depth + 1)
            }
            other => Err(Refusal::new(found.name_span(), format!("a transition follows a `{other}`"))),
        }
    }

    /// Adds the steps that are entered through the output of `element`.
    fn after(&self, element: Element<'x>, depth: usize, out: &mut Vec<Fragment>) -> Read<()> {
        let behind = self.behind(element);
        if behind.is_empty() {
            return Err(Refusal::new(element.name_span(), "a transition leads nowhere"));
        }
        if behind.len() > 1 && element.name() != "simultaneousDivergence" {
            return Err(Refusal::new(element.name_span(), "a transition leads to several places"));
        }
        for next in behind {
            match next.name() {
                "step" => out.push(named(*next, "name")?),
                "jumpStep" => out.push(named(*next, "targetName")?),
                "simultaneousDivergence" | "selectionConvergence" if depth <= self.elements.len() => {
                    self.after(*next, depth + 1, out)?;
                }
                other => {
                    return Err(Refusal::new(next.name_span(), format!("a transition leads to a `{other}`")));
                }
            }
        }
        Ok(())
    }
}

/// The numbers of the elements that the inputs of `element` are connected to.
fn inputs(element: Element<'_>) -> Vec<String> {
    let points = element.children_named("connectionPointIn");
    points.flat_map(|point| point.children_named("connection")).filter_map(|to| to.value("refLocalId")).collect()
}

fn named(element: Element<'_>, attribute: &str) -> Read<Fragment> {
    let name = element.attribute_fragment(attribute).filter(|name| !name.text.trim().is_empty());
    name.ok_or_else(|| Refusal::new(element.name_span(), format!("a `{}` without a name", element.name())))
}

/// What CODESYS adds to an element.
fn facts(element: Element<'_>) -> Facts {
    let data = element.child("addData").into_iter().flat_map(|added| added.children_named("data"));
    let lists = data.filter_map(|data| data.child("attributes"));
    let each = lists.flat_map(|list| list.children_named("attribute"));
    let fact = |each: Element<'_>| Some((each.value("guid")?.to_lowercase(), trimmed(&each.text())?));
    Facts(each.filter_map(fact).collect())
}

fn step(element: Element<'_>) -> Read<Step> {
    let facts = facts(element);
    facts.check(element)?;
    let initial = element.value("initialStep").is_some_and(|value| value == "true" || value == "1");
    let span = element.name_span();
    Ok(Step { name: named(element, "name")?, span, initial, actions: facts.actions(span) })
}

fn action(element: Element<'_>, chart: &mut Chart) -> Read<Action> {
    let span = element.name_span();
    facts(element).check(element)?;
    let name = match (element.child("reference"), element.child("inline")) {
        (Some(reference), _) => named(reference, "name")?,
        (None, Some(inline)) => inner(inline, chart)?,
        (None, None) => return Err(Refusal::new(span, "an action without a name")),
    };
    let given = |attribute: &str| element.attribute_fragment(attribute).as_ref().and_then(trimmed);
    let qualifier = given("qualifier").map_or(Word::Ours("N"), Word::Theirs);
    Ok(Action { name, span, qualifier, arguments: ["duration", "indicator"].into_iter().filter_map(given).collect() })
}

/// An action that is written where it is used: one of the block, with a name of ours.
fn inner(inline: Element<'_>, chart: &mut Chart) -> Read<Fragment> {
    let Some(code) = inline.child("ST") else {
        return Err(Refusal::new(inline.name_span(), "an action in a drawn language inside of the chart"));
    };
    let name = format!("Inner_{}", chart.inner.len() + 1);
    let mut object = Object::new(ObjectKind::Action, Some(name.clone()), inline.name_span());
    object.body = Body::St(xhtml::code(code.child("xhtml").unwrap_or(code)));
    chart.inner.push(object);
    let mut out = FragmentBuilder::new();
    out.standing_for(&name, inline.name_span());
    Ok(out.finish(inline.span().start))
}

/// A transition for each alternative of steps before it.
fn transition(graph: &Graph<'_>, element: Element<'_>) -> Read<Vec<Transition>> {
    let span = element.name_span();
    facts(element).check(element)?;
    let before = graph.before(element, 0)?;
    if before.is_empty() || before.iter().any(Vec::is_empty) {
        return Err(Refusal::new(span, "a transition that no step stands before"));
    }
    let mut to = Vec::new();
    graph.after(element, 0, &mut to)?;
    let (condition, negated) = condition(graph, element)?;
    let priority = element.attribute_fragment("priority").as_ref().and_then(trimmed);
    let one = |from| Transition {
        from,
        to: to.clone(),
        priority: priority.clone(),
        condition: Some(condition.clone()),
        negated,
        span,
    };
    Ok(before.into_iter().map(one).collect())
}

/// The condition, and whether it is negated.
fn condition(graph: &Graph<'_>, transition: Element<'_>) -> Read<(Fragment, bool)> {
    let span = transition.name_span();
    let none = || Refusal::new(span, "a transition without a condition");
    let condition = transition.child("condition").ok_or_else(none)?;
    let yes = |element: Element<'_>| element.value("negated").is_some_and(|value| value == "true" || value == "1");
    let mut negated = yes(condition);
    if let Some(reference) = condition.child("reference") {
        return Ok((named(reference, "name")?, negated));
    }
    if let Some(inline) = condition.child("inline") {
        let code = inline.child("ST");
        let drawn = || Refusal::new(inline.name_span(), "a condition in a drawn language");
        let code = code.ok_or_else(drawn)?;
        let text = xhtml::code(code.child("xhtml").unwrap_or(code));
        return Ok((trimmed(&text).ok_or_else(none)?, negated));
    }
    let wires = [Some(condition), condition.child("connectionPointIn")];
    let wires = wires.into_iter().flatten().flat_map(|point| point.children_named("connection"));
    let from: Vec<String> = wires.filter_map(|wire| wire.value("refLocalId")).collect();
    let from = if from.is_empty() { inputs(condition) } else { from };
    let [id] = from.as_slice() else { return Err(none()) };
    let Some(source) = graph.element(id).filter(|source| source.name() == "inVariable") else {
        return Err(Refusal::new(span, "a condition that is drawn"));
    };
    negated ^= yes(source);
    let text = source.child("expression").and_then(|expression| trimmed(&expression.text()));
    Ok((text.ok_or_else(none)?, negated))
}
