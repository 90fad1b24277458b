//! Doubts about interfaces: stiffnesses that the data only bound, and films that are taken as
//! bonded.

use solve::solve_stack;
use solve::stack::{Interface, Layer, Stack};

use crate::estimate::minima::minimum::Minimum;
use crate::estimate::minima::profile::with_fixed;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Bodies, LayerQuantity, Parameter, Warning, WarningKind};

/// The factor by which a stiffness is changed until the layer is as good as bonded, or slides.
const AS_GOOD_AS: f64 = 1e6;
/// The most evaluations over the number of parameters + 1 of one fit.
const PATIENCE: usize = 30;
/// The growth of the sum of squares, in squares of standard errors, below which the data do not
/// rule out a value: two standard errors.
const RULED_OUT: f64 = 4.0;
/// The relative tolerance of the solves, and the widest contact that is solved for a doubt, over the
/// thickness of the top layer. A wider one takes longer than the fit.
const TOLERANCE: f64 = 1e-5;
const WIDEST: f64 = 100.0;
/// The smallest change of a modulus that is told.
const LEAST: f64 = 1e-3;

pub(crate) fn add(warnings: &mut Vec<Warning>, found: &Minimum<'_>, uncertainty: &Uncertainty) {
    not_seen(warnings, found, uncertainty);
    assumes_bonding(warnings, found, uncertainty);
}

/// Warns of stiffnesses of interfaces that the data do not tell from 0 or from infinity.
fn not_seen(warnings: &mut Vec<Warning>, found: &Minimum<'_>, uncertainty: &Uncertainty) {
    let problem = &found.problem;
    for (i, slot) in problem.slots.iter().enumerate() {
        let Parameter::Layer(name, LayerQuantity::InterfaceStiffness) = slot.parameter else {
            continue;
        };
        let Some(layer) = problem.experiments().find_map(|one| one.bodies.layer(name)) else {
            continue;
        };
        let (own, value) = (layer.own_stiffness(), problem.value(i));
        // The growth of the sum of squares, the other values being fitted again.
        let growth = |stiffness: f64| {
            let misfit = with_fixed(&mut problem.clone(), i, stiffness, PATIENCE)?;
            Some((misfit - problem.misfit()) / uncertainty.growth.powi(2))
        };
        let open = |stiffness: f64| growth(stiffness).filter(|growth| *growth < RULED_OUT);
        let slides = open(value.min(own) / AS_GOOD_AS);
        let bonded = open(value.max(own) * AS_GOOD_AS);
        let parameter = slot.parameter;
        let text = match (slides, bonded) {
            (None, None) => continue,
            (Some(_), Some(_)) => format!(
                "{parameter} is not told by these data: a layer {name} that slides and one that is \
                 bonded fit as well; measure contacts that are wider beside the layer, or fix it"
            ),
            (Some(growth), None) => format!(
                "{parameter} has no lower bound in these data: if layer {name} slid, chi^2 would \
                 grow by {:.1} only; take the value as an upper bound, or take the layer as sliding",
                growth.max(0.0)
            ),
            (None, Some(growth)) => format!(
                "{parameter} has no upper bound in these data: if layer {name} were bonded, chi^2 \
                 would grow by {:.1} only; take the value as a lower bound, or take the layer as \
                 bonded",
                growth.max(0.0)
            ),
        };
        warnings.push(WarningKind::InterfaceNotSeen.with(text));
    }
}

/// Warns of a modulus that would be another one if the film slid on what lies below.
fn assumes_bonding(warnings: &mut Vec<Warning>, found: &Minimum<'_>, uncertainty: &Uncertainty) {
    let problem = &found.problem;
    // The widest contact feels the interface most.
    let wide = (0..problem.assigned.len())
        .filter_map(|e| {
            let bodies = &problem.assigned[e].experiment.bodies;
            let (top, _) = layers(bodies)?;
            Some((e, problem.contact_radii(e)?[1] / top.thickness))
        })
        .max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((e, over_top)) = wide.filter(|(_, over_top)| *over_top > 0.0) else {
        return;
    };
    let bodies = &problem.assigned[e].experiment.bodies;
    let moduli = [Parameter::SphereModulus, bodies.modulus_of_top()];
    let is_modulus = |slot: &usize| moduli.contains(&problem.slots[*slot].parameter);
    let slots = problem.slots_of(e);
    for slot in slots.into_iter().filter(is_modulus) {
        let parameter = problem.slots[slot].parameter;
        let over_top = over_top.min(WIDEST);
        let Some(factor) = if_sliding(bodies, parameter, problem.value(slot), over_top) else {
            continue;
        };
        let change = (factor - 1.0).abs();
        if change > LEAST.max(uncertainty.relative_error(slot)) {
            warnings.push(WarningKind::AssumesBonding.with(format!(
                "{parameter} takes the film as bonded to what lies below it: if it slid, the \
                 stiffness of a contact of {over_top:.2} times the thickness of the film would need \
                 a modulus {factor:.3} times as large, which is more than the standard error; a fit as a film that \
                 slides tells what changes here, if it may slide"
            )));
        }
    }
}

/// Returns the top layer and the stack of bodies that are all bonded; `None` of others.
fn layers(bodies: &Bodies) -> Option<(Layer, Stack)> {
    let stack = bodies.stack_or_on_rigid().filter(Stack::is_bonded)?;
    Some((*stack.layers().last()?, stack))
}

/// Returns the stiffness of a contact of a radius `over_top` times the thickness of the top layer,
/// over this radius, Pa.
fn stiffness(bodies: &Bodies, over_top: f64, interface: Interface) -> Option<f64> {
    let (top, stack) = layers(bodies)?;
    let mut all = stack.layers().to_vec();
    all.last_mut()?.interface = interface;
    let stack = Stack::new(stack.base(), all).ok()?;
    let sphere = bodies.sphere_modulus;
    let unit = if sphere == f64::INFINITY {
        stack.surface().reduced()
    } else {
        sphere
    };
    let a_over_t = over_top * top.thickness / stack.thickness();
    let solution = solve_stack(a_over_t, &stack, sphere, TOLERANCE).ok()?;
    Some(unit * solution.quantities.eeq)
}

/// Returns the factor by which a modulus would be larger if the top layer slid, for the same
/// stiffness of the contact: to the first order in its logarithm. `None` where the stiffness hardly
/// changes, or hardly tells the modulus.
fn if_sliding(bodies: &Bodies, parameter: Parameter, value: f64, over_top: f64) -> Option<f64> {
    /// The smallest exponent of the stiffness as a power of the modulus.
    const LEAST_EXPONENT: f64 = 0.05;
    let bonded = stiffness(bodies, over_top, Interface::Bonded)?;
    let sliding = stiffness(bodies, over_top, Interface::Sliding)?;
    let ratio = bonded / sliding;
    if (ratio - 1.0).abs() < LEAST {
        return None;
    }
    let mut stiffer = bodies.clone();
    stiffer.replace(parameter, ratio * value).ok()?;
    let there = stiffness(&stiffer, over_top, Interface::Sliding)?;
    let exponent = (there / sliding).ln() / ratio.ln();
    (exponent >= LEAST_EXPONENT).then(|| ratio.powf(exponent.recip()))
}
