//! Charts of TwinCAT 3: an archive of nested lists. A list holds steps, transitions, jumps and branches in the order of drawing; a
//! branch holds a list for each of its legs.
//!
//! ```text
//! SFCSegment: SFCStep  SFCTransition  SFCBranch[ SFCSegment … ]  SFCJump
//! ```
//!
//! A transition leads to what follows it in its list, from what stands before. A parallel branch stands behind a transition and its
//! legs begin and end with steps; an alternative one stands behind a step and its legs begin and end with transitions.

use super::{Action, Chart, Facts, Read, Refusal, Step, Transition, Word, between, fact};
use crate::source::xml::Element;
use crate::text::Fragment;

/// So many combinations of steps may stand before one transition.
const MAX_ALTERNATIVES: usize = 256;

/// What the next element of a list joins on to.
#[derive(Clone, Debug)]
enum Open {
    /// The beginning of the chart.
    Start,
    /// Steps that a transition may leave: alternatives of steps that are all active.
    Steps(Vec<Vec<Fragment>>),
    /// Transitions that lead to what comes next, as indices.
    Transitions(Vec<usize>),
    /// A jump has ended the list.
    Closed,
}

/// The chart in `sfc`.
pub(in super::super) fn read(sfc: Element<'_>) -> Read<Chart> {
    let root = sfc.descendants().find(|element| element.value("n").as_deref() == Some("Root"));
    let root = root.ok_or_else(|| Refusal::new(sfc.name_span(), "its archive has no root"))?;
    let mut chart = Chart::default();
    match list(root, Open::Start, &mut chart)? {
        Open::Transitions(_) => Err(Refusal::new(sfc.name_span(), "a transition leads nowhere")),
        _ => Ok(chart),
    }
}

/// The child that the archive names so.
fn member<'x>(element: Element<'x>, name: &str) -> Option<Element<'x>> {
    element.children().find(|child| child.value("n").as_deref() == Some(name))
}

/// The elements of a list, each with its type.
fn items<'x>(element: Element<'x>) -> Vec<(String, Element<'x>)> {
    let inner = member(element, "ElementList").and_then(|list| member(list, "InnerList"));
    let Some(inner) = inner else { return Vec::new() };
    let common = inner.value("cet").unwrap_or_default();
    inner.children().map(|child| (child.value("t").unwrap_or_else(|| common.clone()), child)).collect()
}

/// The facts of an element; their values stand in quotes.
fn facts(element: Element<'_>) -> Read<Facts> {
    let mut facts = Vec::new();
    let lists = element.children().filter(|child| child.value("n").as_deref() == Some("Attributes"));
    for each in lists.flat_map(|list| list.children().collect::<Vec<_>>()) {
        let identity = member(each, "AttributeId").and_then(|id| id.trimmed());
        let value = member(each, "Value").and_then(|value| member(value, "Value"));
        let (Some(identity), Some(value)) = (identity, value) else { continue };
        let identity = identity.trim_matches(|c| c == '{' || c == '}').to_lowercase();
        if let Some(text) = unquoted(value)? {
            facts.push((identity, text));
        }
    }
    Ok(Facts(facts))
}

fn unquoted(value: Element<'_>) -> Read<Option<Fragment>> {
    let fragment = value.text();
    let text: &str = &fragment.text;
    let lead = text.len() - text.trim_start().len();
    let Some(inner) = text.trim().strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) else { return Ok(None) };
    if inner.contains(['"', '\\']) {
        return Err(Refusal::new(value.name_span(), "a text with a quotation mark or a backslash"));
    }
    let start = lead + 1 + (inner.len() - inner.trim_start().len());
    Ok(between(&fragment, start, start + inner.trim().len()))
}

fn name(facts: &Facts, element: Element<'_>, what: &str) -> Read<Fragment> {
    let found = facts.get(fact::NAME).cloned();
    found.ok_or_else(|| Refusal::new(element.name_span(), format!("{what} without a name")))
}

/// Reads a list; what its end joins on to.
fn list(segment: Element<'_>, before: Open, chart: &mut Chart) -> Read<Open> {
    let mut open = before;
    for (kind, element) in items(segment) {
        let facts = facts(element)?;
        facts.check(element)?;
        open = match kind.as_str() {
            "SFCStep" => step(element, &facts, open, chart)?,
            "SFCTransition" => transition(element, &facts, open, chart)?,
            "SFCJump" => jump(element, &facts, &open, chart)?,
            "SFCBranch" if facts.holds(fact::PARALLEL) => parallel(element, &open, chart)?,
            "SFCBranch" => alternative(element, &open, chart)?,
            other => return Err(Refusal::new(element.name_span(), format!("an element of the kind `{other}`"))),
        };
    }
    Ok(open)
}

/// Refuses actions and conditions that are drawn inside of the element.
fn embedded(element: Element<'_>) -> Read<()> {
    let drawn = element
        .children()
        .find(|child| child.name() == "o" && child.value("n").is_some_and(|name| name.starts_with("Embedded")));
    drawn.map_or(Ok(()), |drawn| Err(Refusal::new(drawn.name_span(), "code that is embedded in one of its elements")))
}

fn step(element: Element<'_>, facts: &Facts, open: Open, chart: &mut Chart) -> Read<Open> {
    embedded(element)?;
    let span = element.name_span();
    let name = name(facts, element, "a step")?;
    match open {
        Open::Start => {}
        Open::Transitions(transitions) => lead(&transitions, &name, chart),
        Open::Steps(_) | Open::Closed => {
            return Err(Refusal::new(span, format!("no transition leads to the step `{}`", name.text)));
        }
    }
    let mut actions = facts.actions(span);
    for (_, item) in items(element) {
        actions.push(action(item)?);
    }
    chart.steps.push(Step { name: name.clone(), span, initial: facts.holds(fact::INITIAL), actions });
    Ok(Open::Steps(vec![vec![name]]))
}

/// An action at a step: its name and `N`, `D T#2s` or the like.
fn action(element: Element<'_>) -> Read<Action> {
    let facts = facts(element)?;
    facts.check(element)?;
    embedded(element)?;
    let name = name(&facts, element, "an action")?;
    let Some(given) = facts.get(fact::QUALIFIER) else {
        return Err(Refusal::new(element.name_span(), "an action without a qualifier"));
    };
    let text: &str = &given.text;
    let length = text.find(char::is_whitespace).unwrap_or(text.len());
    let rest = text.len() - text[length..].trim_start().len();
    let qualifier = between(given, 0, length).map_or(Word::Ours("N"), Word::Theirs);
    let arguments = between(given, rest, text.len()).into_iter().collect();
    Ok(Action { name, span: element.name_span(), qualifier, arguments })
}

fn lead(transitions: &[usize], name: &Fragment, chart: &mut Chart) {
    for index in transitions {
        chart.transitions[*index].to.push(name.clone());
    }
}

fn transition(element: Element<'_>, facts: &Facts, open: Open, chart: &mut Chart) -> Read<Open> {
    embedded(element)?;
    let span = element.name_span();
    let condition = facts.get(fact::NAME).cloned();
    let condition = condition.ok_or_else(|| Refusal::new(span, "a transition without a condition"))?;
    let Open::Steps(alternatives) = open else {
        return Err(Refusal::new(span, "a transition that no step stands before"));
    };
    let first = chart.transitions.len();
    for from in alternatives {
        let condition = Some(condition.clone());
        chart.transitions.push(Transition { from, condition, span, ..Transition::default() });
    }
    Ok(Open::Transitions((first..chart.transitions.len()).collect()))
}

fn jump(element: Element<'_>, facts: &Facts, open: &Open, chart: &mut Chart) -> Read<Open> {
    let Open::Transitions(transitions) = open else {
        return Err(Refusal::new(element.name_span(), "a jump that no transition leads to"));
    };
    let target = name(facts, element, "a jump")?;
    lead(transitions, &target, chart);
    Ok(Open::Closed)
}

fn parallel(element: Element<'_>, open: &Open, chart: &mut Chart) -> Read<Open> {
    let span = element.name_span();
    let Open::Transitions(_) = open else {
        return Err(Refusal::new(span, "a parallel branch that does not follow a transition"));
    };
    let mut joined: Vec<Vec<Fragment>> = vec![Vec::new()];
    for (_, leg) in items(element) {
        let Open::Steps(ends) = list(leg, open.clone(), chart)? else {
            return Err(Refusal::new(span, "a parallel branch that does not end with a step"));
        };
        let longer = |left: &Vec<Fragment>| {
            let left = left.clone();
            ends.iter().map(move |right| left.iter().chain(right).cloned().collect()).collect::<Vec<Vec<Fragment>>>()
        };
        joined = joined.iter().flat_map(longer).collect();
        if joined.len() > MAX_ALTERNATIVES {
            return Err(Refusal::new(span, "too many combinations of steps behind a parallel branch"));
        }
    }
    Ok(Open::Steps(joined))
}

fn alternative(element: Element<'_>, open: &Open, chart: &mut Chart) -> Read<Open> {
    let span = element.name_span();
    let Open::Steps(_) = open else {
        return Err(Refusal::new(span, "an alternative branch that does not follow a step"));
    };
    let mut ends = Vec::new();
    for (_, leg) in items(element) {
        match list(leg, open.clone(), chart)? {
            Open::Transitions(transitions) => ends.extend(transitions),
            Open::Closed => {}
            Open::Start | Open::Steps(_) => {
                return Err(Refusal::new(span, "an alternative branch that does not end with a transition"));
            }
        }
    }
    Ok(if ends.is_empty() { Open::Closed } else { Open::Transitions(ends) })
}
