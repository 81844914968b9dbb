//! Sequential function charts in text: their steps, transitions and actions become a [`chart`], whose statements are the body.
//!
//! A step's action is an action of the block, or else a Boolean variable. The variables that tell when an action is done
//! (`indicators`) are left alone, as IEC 61131-3 leaves it to the action to set them.

use std::collections::BTreeMap;

use super::access::{Designated, Spot};
use super::classes::LayoutKey;
use super::world::Code;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind};
use crate::machine::chart::{self, Action, Association, Chart, Outline, Qualifier, Step, Target, Transition};
use crate::machine::program::{Location, Statement};
use crate::semantics::expr::Expr;
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Type, converted};
use crate::syntax::ast::{self, ActionAssociation, AstNode, Body};

const CHART: &str = "a part of a sequential function chart";

/// Whether the field of this key is a clock of a chart.
pub(super) fn is_clock(key: &str) -> bool {
    key.ends_with("$clock") || key.starts_with("clock$")
}

/// The associations of a body, by the folded name of the action, in the order in which the actions are named first.
fn associations<'c>(body: Body<'c>) -> Vec<(String, Vec<(usize, ActionAssociation<'c>)>)> {
    let mut order: Vec<(String, Vec<(usize, ActionAssociation<'c>)>)> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for (number, step) in body.steps().enumerate() {
        for association in step.actions() {
            let Some(name) = association.name() else { continue };
            let key = fold(name.text());
            let at = *known.entry(key.clone()).or_insert(order.len());
            if at == order.len() {
                order.push((key, Vec::new()));
            }
            order[at].1.push((number, association));
        }
    }
    order
}

/// The qualifier of an association; without one it is `N`.
fn qualifier(association: ActionAssociation<'_>) -> Option<Qualifier> {
    association.qualifier().map_or(Some(Qualifier::NonStored), Qualifier::named)
}

fn outline(body: Body<'_>) -> Outline {
    let qualifiers = |list: Vec<(usize, ActionAssociation<'_>)>| {
        list.into_iter().filter_map(|(_, association)| qualifier(association)).collect()
    };
    Outline {
        steps: body.steps().filter_map(|step| step.name()).map(|name| name.text().to_owned()).collect(),
        transitions: body.transitions().count(),
        actions: associations(body).into_iter().map(|(_, list)| qualifiers(list)).collect(),
    }
}

impl<'c> Elaborator<'c> {
    /// The variables that a chart adds to the instances of its block, by folded names.
    pub(super) fn chart_fields(&mut self, item: ItemId) -> Lowered<Vec<(String, Type)>> {
        let Code::Text(bodies) = self.world.code(item) else { return Ok(Vec::new()) };
        let charts = bodies.into_iter().filter(|body| body.is_chart());
        let hidden = charts.flat_map(|body| outline(body).hidden());
        Ok(hidden.map(|hidden| (hidden.key, Type::Scalar(hidden.scalar))).collect())
    }

    /// `Step.X` and `Step.T`.
    pub(super) fn step_field(&mut self, path: &[String], field: &str) -> Lowered<Option<Designated>> {
        let ([step], Some(class)) = (path, self.body.class) else { return Ok(None) };
        let key = match field.to_ascii_uppercase().as_str() {
            "X" => chart::active_key(step),
            "T" => chart::time_key(step),
            _ => return Ok(None),
        };
        let layout = self.layout(LayoutKey::Class(class))?;
        let this = Spot::this(self.instance_type(class));
        let found = layout.fields.iter().find(|field| field.key == key && field.decl.is_none());
        Ok(found.map(|field| Designated::Spot(Spot { constant: true, ..this.field(field) })))
    }

    /// The statements of a chart.
    pub(super) fn chart(&mut self, body: Body<'c>) -> Lowered<()> {
        let item = self.body.item;
        let Some(class) = self.body.class.filter(|_| self.world.parent(item).is_none()) else {
            return Err(self.unsupported(CHART, body.node(), "a chart that is not the body of a block"));
        };
        let layout = self.layout(LayoutKey::Class(class))?;
        let this = Spot::this(self.instance_type(class));
        let own = layout.fields.iter().filter(|field| field.owner == item && field.decl.is_none());
        let memory: BTreeMap<String, Location> =
            own.map(|field| (field.key.clone(), this.field(field).location)).collect();
        let lowered = Chart {
            steps: self.chart_steps(body)?,
            transitions: self.chart_transitions(body)?,
            actions: self.chart_actions(body)?,
        };
        let missing = lowered.outline().hidden().into_iter().any(|hidden| !memory.contains_key(&hidden.key));
        if missing {
            return Err(self.unsupported(CHART, body.node(), "two charts in one block"));
        }
        let statements: Vec<Statement> = chart::statements(&lowered, &|key| memory[key].clone());
        self.body.out.extend(statements);
        Ok(())
    }

    fn chart_steps(&mut self, body: Body<'c>) -> Lowered<Vec<Step>> {
        let mut steps: Vec<Step> = Vec::new();
        for step in body.steps() {
            let name = step.name().ok_or_else(|| self.incomplete(step.node()))?.text().to_owned();
            if steps.iter().any(|other| fold(&other.name) == fold(&name)) {
                return Err(self.unsupported(CHART, step.node(), format!("there are two steps `{name}`")));
            }
            steps.push(Step { name, initial: step.is_initial(), place: self.place(step.node()) });
        }
        match steps.iter().filter(|step| step.initial).count() {
            1 => Ok(steps),
            count => Err(self.unsupported(CHART, body.node(), format!("the chart has {count} initial steps"))),
        }
    }

    fn chart_transitions(&mut self, body: Body<'c>) -> Lowered<Vec<Transition>> {
        let names: Vec<String> = body.steps().filter_map(|step| step.name()).map(|name| fold(name.text())).collect();
        let mut transitions = Vec::new();
        for transition in body.transitions() {
            let node = transition.node();
            let step = |this: &Self, name: ast::Name<'c>| {
                let found = names.iter().position(|other| *other == fold(name.text()));
                found.ok_or_else(|| this.unsupported(CHART, name.node(), format!("there is no step `{}`", name.text())))
            };
            let from: Vec<usize> = transition.from().map(|name| step(self, name)).collect::<Lowered<_>>()?;
            let to: Vec<usize> = transition.to().map(|name| step(self, name)).collect::<Lowered<_>>()?;
            if from.is_empty() || to.is_empty() {
                return Err(self.unsupported(CHART, node, "a transition that does not say its steps"));
            }
            let priority = match transition.priority() {
                Some(priority) => self.constant_number(priority, self.body.item)?,
                None => 0,
            };
            let Some(condition) = transition.condition() else {
                return Err(self.unsupported(CHART, node, "a transition whose condition is no expression"));
            };
            let mut value = None;
            let before = self.block(|this| {
                value = Some(this.condition(condition)?);
                Ok(())
            })?;
            let condition = value.ok_or_else(|| self.incomplete(node))?;
            transitions.push(Transition { from, to, priority, before, condition, place: self.place(node) });
        }
        Ok(transitions)
    }

    fn chart_actions(&mut self, body: Body<'c>) -> Lowered<Vec<Action>> {
        let mut actions = Vec::new();
        for (name, list) in associations(body) {
            let Some((_, first)) = list.first() else { continue };
            let target = self.chart_target(*first)?;
            let mut associations = Vec::new();
            for (step, association) in list {
                associations.push(self.chart_association(step, association)?);
            }
            actions.push(Action { name, target, associations });
        }
        Ok(actions)
    }

    /// An action of the block, or a Boolean variable.
    fn chart_target(&mut self, association: ActionAssociation<'c>) -> Lowered<Target> {
        let node = association.node();
        let name = association.name().ok_or_else(|| self.incomplete(node))?.text();
        match self.lookup(name, node)? {
            Some(Designated::Member { this, item, .. }) if self.world.item(item).kind == ItemKind::Action => {
                let body = self.block(|me| {
                    me.call_action(&this, item);
                    Ok(())
                })?;
                Ok(Target::Body(body))
            }
            Some(Designated::Spot(spot)) if spot.type_.scalar() == Some(Scalar::Bool) && !spot.constant => {
                let spot = self.followed(spot);
                Ok(Target::Variable(spot.location))
            }
            _ => Err(self.unsupported(CHART, node, format!("`{name}` is neither an action nor a Boolean variable"))),
        }
    }

    fn chart_association(&mut self, step: usize, association: ActionAssociation<'c>) -> Lowered<Association> {
        let node = association.node();
        let Some(qualifier) = qualifier(association) else {
            let name = association.qualifier().unwrap_or_default();
            return Err(self.unsupported(CHART, node, format!("`{name}` is no action qualifier")));
        };
        let time = match association.arguments().next().filter(|_| qualifier.is_timed()) {
            Some(time) => Some(self.chart_time(time)?),
            None if qualifier.is_timed() => {
                return Err(self.unsupported(CHART, node, "a qualifier that needs a time and has none"));
            }
            None => None,
        };
        Ok(Association { step, qualifier, time, place: self.place(node) })
    }

    fn chart_time(&mut self, time: ast::Expression<'c>) -> Lowered<Expr<Location>> {
        let node = time.node();
        let mut value = None;
        let before = self.block(|this| {
            value = Some(this.operand(time)?);
            Ok(())
        })?;
        let operand = value.ok_or_else(|| self.incomplete(node))?;
        let (expr, _) = operand.settled().map_err(Unsupported::from)?;
        match expr.scalar {
            _ if !before.is_empty() => Err(self.unsupported(CHART, node, "a time that is calculated by a call")),
            Scalar::Time(32) => Ok(expr),
            Scalar::Time(_) => Ok(converted(expr, Scalar::Time(32))),
            _ => Err(self.unsupported(CHART, node, "a time that is no `TIME`")),
        }
    }
}
