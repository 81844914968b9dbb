//! Sequential function charts, in text or drawn and written as text: their steps, transitions and actions become a [`chart`], whose statements are the body.
//!
//! A step's action is an action of the block, or else a Boolean variable. The variables that tell when an action is done
//! (`indicators`) are left alone, as IEC 61131-3 leaves it to the action to set them. A chart is the body of a block, or of one of its
//! actions; its state belongs to the block's instance.

use std::collections::BTreeMap;

use super::access::{Designated, Spot};
use super::classes::LayoutKey;
use super::world::{Code, World};
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind};
use crate::machine::chart::{self, Action, Association, Chart, Outline, Qualifier, Step, Target, Transition};
use crate::machine::program::{Location, Statement, StatementKind};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Type, converted};
use crate::syntax::ast::{self, ActionAssociation, AstNode, Body};

const CHART: &str = "a part of a sequential function chart";

/// Variables by which CODESYS and TwinCAT let a block steer and watch its chart,
/// that are not modelled; `SFCInit` and `SFCReset` are.
const STEERING: [&str; 7] =
    ["sfcpause", "sfctip", "sfctipmode", "sfcerror", "sfcenablelimit", "sfcquiterror", "sfctrans"];

/// Whether the field of this key is a clock of a chart.
pub(super) fn is_clock(key: &str) -> bool {
    let key = key.rsplit('/').next().unwrap_or(key);
    key.ends_with("$clock") || key.starts_with("clock$")
}

/// An action of a body: its name, its associations and their steps.
type Associated<'c> = (String, Vec<(usize, ActionAssociation<'c>)>);

/// The actions of a body: each of a step's own ones alone, in their order; then the others with all of their associations, in the order in
/// which they are named first.
fn associations(body: Body<'_>) -> Vec<Associated<'_>> {
    let mut own: [Vec<Associated<'_>>; 3] = Default::default();
    let mut order: Vec<Associated<'_>> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for (number, step) in body.steps().enumerate() {
        for association in step.actions() {
            let key = fold(&path(association));
            if key.is_empty() {
                continue;
            }
            if let Some(phase) = qualifier(association).and_then(Qualifier::own) {
                own[phase].push((key, vec![(number, association)]));
                continue;
            }
            let at = *known.entry(key.clone()).or_insert(order.len());
            if at == order.len() {
                order.push((key, Vec::new()));
            }
            order[at].1.push((number, association));
        }
    }
    own.into_iter().flatten().chain(order).collect()
}

/// The name of what a step does, as it is written.
fn path(association: ActionAssociation<'_>) -> String {
    association.names().map(ast::Name::text).collect::<Vec<_>>().join(".")
}

/// What the keys of a chart's variables begin with: nothing for a block's own one, the action's name for one of its actions.
fn prefix(world: &World<'_>, item: ItemId) -> String {
    if world.item(item).kind == ItemKind::Action { format!("{}/", fold(&world.item(item).name)) } else { String::new() }
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

fn truth(target: Location, value: bool) -> Statement {
    let value = Expr { kind: ExprKind::Const(value.into()), scalar: Scalar::Bool, place: None };
    Statement { kind: StatementKind::Assign { target, value, range: None }, place: None }
}

/// Makes a chart's own variables what they are before its first call; the clocks are set when they are needed.
fn fresh(chart: &Chart, memory: &BTreeMap<String, Location>) -> Vec<Statement> {
    let hidden = chart.outline().hidden().into_iter().filter(|hidden| hidden.scalar == Scalar::Bool);
    hidden.map(|hidden| truth(memory[&hidden.key].clone(), false)).collect()
}

impl<'c> Elaborator<'c> {
    /// The variables that the charts of a block and its actions add to its instances: what has the chart, their keys, their types.
    pub(super) fn chart_fields(&mut self, block: ItemId) -> Vec<(ItemId, String, Type)> {
        let actions = self.world.children(block).filter(|id| self.world.item(*id).kind == ItemKind::Action);
        let items: Vec<ItemId> = std::iter::once(block).chain(actions).collect();
        let mut fields = Vec::new();
        for item in items {
            let Code::Text(bodies) = self.world.code(item) else { continue };
            let prefix = prefix(&self.world, item);
            let charts = bodies.into_iter().filter(|body| body.is_chart());
            let hidden = charts.flat_map(|body| outline(body).hidden());
            fields.extend(hidden.map(|one| (item, format!("{prefix}{}", one.key), Type::Scalar(one.scalar))));
        }
        fields
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
        // The chart of the action that the name stands in comes first, then the block's, then those of what it extends.
        let item = self.body.item;
        let scopes = std::iter::once(item).chain(self.world.lineage(self.owner(item)));
        let mut found = scopes.filter_map(|scope| {
            let key = format!("{}{key}", prefix(&self.world, scope));
            layout.fields.iter().find(|field| field.owner == scope && field.key == key && field.decl.is_none())
        });
        Ok(found.next().map(|field| Designated::Spot(Spot { constant: true, ..this.field(field) })))
    }

    /// The statements of a chart.
    pub(super) fn chart(&mut self, body: Body<'c>) -> Lowered<()> {
        let item = self.body.item;
        let holds = self.world.parent(item).is_none() || self.world.item(item).kind == ItemKind::Action;
        let Some(class) = self.body.class.filter(|_| holds) else {
            return Err(self.unsupported(CHART, body.node(), "a chart that is not the body of a block or action"));
        };
        self.steered(body)?;
        let layout = self.layout(LayoutKey::Class(class))?;
        let this = Spot::this(self.instance_type(class));
        let prefix = prefix(&self.world, item);
        let own = layout.fields.iter().filter(|field| field.owner == item && field.decl.is_none());
        let own =
            own.filter_map(|field| Some((field.key.strip_prefix(&prefix)?.to_owned(), this.field(field).location)));
        let memory: BTreeMap<String, Location> = own.collect();
        let lowered = Chart {
            steps: self.chart_steps(body)?,
            transitions: self.chart_transitions(body)?,
            actions: self.chart_actions(body)?,
        };
        let missing = lowered.outline().hidden().into_iter().any(|hidden| !memory.contains_key(&hidden.key));
        if missing {
            return Err(self.unsupported(CHART, body.node(), "two charts in one block"));
        }
        let (reset, init) = (self.steering("SFCReset", body)?, self.steering("SFCInit", body)?);
        let mut statements: Vec<Statement> = chart::statements(&lowered, &|key| memory[key].clone());
        let fresh = fresh(&lowered, &memory);
        if let Some(condition) = reset {
            self.assumptions.insert("`SFCReset` starts a chart anew in each call that finds it TRUE".to_owned());
            let kind = StatementKind::If { condition, then: fresh.clone(), otherwise: Vec::new() };
            statements.insert(0, Statement { kind, place: None });
        }
        if let Some(condition) = init {
            self.assumptions.insert(
                "while `SFCInit` is TRUE, a chart stands at its initial step and drives nothing; its outputs stay"
                    .to_owned(),
            );
            let mut then = fresh;
            let initial = lowered.steps.iter().filter(|step| step.initial);
            then.extend(initial.map(|step| truth(memory[&chart::active_key(&step.name)].clone(), true)));
            statements =
                vec![Statement { kind: StatementKind::If { condition, then, otherwise: statements }, place: None }];
        }
        self.body.out.extend(statements);
        Ok(())
    }

    /// A variable by which CODESYS and TwinCAT let a block steer its chart, if it declares that.
    fn steering(&mut self, name: &str, body: Body<'c>) -> Lowered<Option<Expr<Location>>> {
        let lineage = self.world.lineage(self.owner(self.body.item));
        let mut declared = lineage.iter().flat_map(|id| &self.world.item(*id).variables);
        if !declared.any(|variable| fold(&variable.name) == fold(name)) {
            return Ok(None);
        }
        match self.lookup(name, body.node())? {
            Some(Designated::Spot(spot)) if spot.type_.scalar() == Some(Scalar::Bool) => {
                Ok(Some(self.followed(spot).read()))
            }
            _ => Err(self.unsupported(CHART, body.node(), format!("`{name}`, which is no Boolean variable"))),
        }
    }

    /// Refuses a block that steers its chart by the variables that CODESYS and TwinCAT have for that.
    fn steered(&self, body: Body<'c>) -> Lowered<()> {
        let lineage = self.world.lineage(self.owner(self.body.item));
        let mut names = lineage.iter().flat_map(|id| &self.world.item(*id).variables).map(|variable| &variable.name);
        match names.find(|name| STEERING.contains(&fold(name).as_str())) {
            Some(name) => {
                let message = format!("`{name}`, by which CODESYS and TwinCAT let a block steer or watch its chart");
                Err(self.unsupported(CHART, body.node(), message))
            }
            None => Ok(()),
        }
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
            let condition = self.named_condition(condition)?;
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

    /// The expression behind the name of a transition that is declared beside the chart; others stand for themselves.
    fn named_condition(&mut self, condition: ast::Expression<'c>) -> Lowered<ast::Expression<'c>> {
        let ast::Expression::Name(name) = condition else { return Ok(condition) };
        let text = name.text();
        let lineage = self.world.lineage(self.owner(self.body.item));
        let mut declared = lineage.into_iter().filter_map(|at| self.world.child(at, text, &[ItemKind::Transition]));
        let Some(item) = declared.next() else { return Ok(condition) };
        let node = condition.node();
        let drawn =
            || self.unsupported(CHART, node, format!("the transition `{text}` is no single expression in text"));
        let inside = self.world.node(item).and_then(ast::Transition::cast).and_then(ast::Transition::condition);
        if let Some(inside) = inside {
            return Ok(inside);
        }
        let Code::Text(bodies) = self.world.code(item) else { return Err(drawn()) };
        let mut statements = bodies.into_iter().flat_map(ast::Body::statements);
        match (statements.next(), statements.next()) {
            (Some(ast::Statement::Expression(value, _)), None) => Ok(value),
            (Some(ast::Statement::Assign(assign)), None) => {
                let to_itself = match assign.target() {
                    Some(ast::Expression::Name(to)) => fold(to.text()) == fold(text),
                    _ => false,
                };
                assign.value().filter(|_| to_itself).ok_or_else(drawn)
            }
            _ => Err(drawn()),
        }
    }

    fn chart_actions(&mut self, body: Body<'c>) -> Lowered<Vec<Action>> {
        let mut actions = Vec::new();
        for (name, list) in associations(body) {
            let Some((_, first)) = list.first() else { continue };
            let target = self.chart_target(*first)?;
            let own = qualifier(*first).and_then(Qualifier::own).is_some();
            if own && !matches!(target, Target::Body(_)) {
                return Err(self.unsupported(CHART, first.node(), format!("`{name}` is no action of the block")));
            }
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
        let name = path(association);
        let mut names = association.names().map(ast::Name::text);
        let first = names.next().ok_or_else(|| self.incomplete(node))?;
        let mut found = self.lookup(first, node)?;
        for field in names {
            let base = found.unwrap_or_else(|| Designated::Path(vec![first.to_owned()]));
            found = Some(self.field_of_designated(base, field, node)?);
        }
        match found {
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
