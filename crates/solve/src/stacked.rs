//! A stack of layers under a sphere: solves it as a film where it is one, by Galerkin's method
//! otherwise.

use std::sync::{Arc, OnceLock};

use interp::{Curve, Material, Normalisation, Quantities};

use crate::Error;
use crate::adaptive_curve::{check_range, curve_of};
use crate::compliance::layered::LayeredCompliance;
use crate::compliance::sampled::SampledCompliance;
use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::domain::{A_OVER_T, TOLERANCE};
use crate::error::OF_STACK;
use crate::galerkin;
use crate::galerkin::operator::Operator;
use crate::method::{Method, closed_form, has_closed_form};
use crate::parallel::try_map;
use crate::power_law::{self, PowerLaw};
use crate::solution::{Solution, solve_power_laws};
use crate::stack::{MOST_A_OVER_TOP, Stack};

/// The number of layers from which on a curve samples the compliance instead of evaluating it at
/// every wave number of every solve.
const MANY_LAYERS: usize = 4;

/// Solves the contact of a sphere of reduced modulus `sphere_modulus` (Pa; infinity is rigid) with
/// a stack, at `a_over_t` (contact radius over the thickness of the whole stack), to the relative
/// `tolerance`.
///
/// The quantities are in units of `E2*`, under a rigid sphere in units of `E1*` of what the sphere
/// touches.
///
/// # Errors
/// [`Error::Domain`] for an `a_over_t`, a `tolerance` or a ratio of moduli outside the domain of
/// [`solve`](crate::solve()); [`Error::StackReach`] where the contact is too wide beside the top layer
/// ([`MOST_A_OVER_TOP`]); [`Error::NotConverged`] where double precision does not allow the
/// tolerance; as [`Stack::material`].
pub fn solve_stack(
    a_over_t: f64,
    stack: &Stack,
    sphere_modulus: f64,
    tolerance: f64,
) -> Result<Solution, Error> {
    solve_stack_power_laws(a_over_t, stack, sphere_modulus, &[], tolerance)
        .map(|(solution, _)| solution)
}

/// Solves the contact of a sphere with a stack, as [`solve_stack`], and those of probes with the
/// profiles `c r^n`, as [`solve_power_laws`].
///
/// # Errors
/// As [`solve_stack`] and [`solve_power_laws`].
pub fn solve_stack_power_laws(
    a_over_t: f64,
    stack: &Stack,
    sphere_modulus: f64,
    exponents: &[f64],
    tolerance: f64,
) -> Result<(Solution, Vec<PowerLaw>), Error> {
    power_law::check(exponents)?;
    Layers::new(stack, a_over_t, usize::MAX)?
        .under(sphere_modulus)?
        .solve(a_over_t, exponents, tolerance)
}

/// Solves the contacts of spheres of the reduced moduli `sphere_moduli` with one stack at one
/// `a_over_t`, on all cores, and returns the quantities in the order of the moduli.
///
/// The spheres share their matrices where these reach `tolerance`; every other contact is solved
/// with `solve_one(i)`, whose argument is the index of its modulus.
///
/// # Errors
/// Those of [`solve_stack`] and `solve_one`; of several, the error of the first modulus.
pub fn solve_stack_under_spheres(
    a_over_t: f64,
    stack: &Stack,
    sphere_moduli: &[f64],
    tolerance: f64,
    solve_one: &(dyn Fn(usize) -> Result<Quantities, Error> + Sync),
) -> Result<Vec<Quantities>, Error> {
    let layers = Layers::new(stack, a_over_t, usize::MAX)?;
    let (Some(compliance), 2..) = (&layers.compliance, sphere_moduli.len()) else {
        return try_map(0..sphere_moduli.len(), solve_one);
    };
    let x = a_over_t * layers.thickness_over_top;
    let operator = OnceLock::new();
    let assemble = || {
        let abscissae = galerkin::shared_abscissae(x, [compliance], tolerance);
        Operator::for_many_spheres(compliance, &abscissae, &abscissae.bessel_values())
    };
    try_map(0..sphere_moduli.len(), |i| {
        let contact = layers.under(sphere_moduli[i])?;
        let symbol = Symbol::with_compliance(compliance.clone(), &contact.of_top);
        if has_closed_form(&symbol, tolerance) {
            return solve_one(i);
        }
        let operator = operator.get_or_init(assemble);
        match operator.solve_to(&symbol, tolerance) {
            Some(solved) => Ok(contact.at_surface(solved.quantities)),
            None => solve_one(i),
        }
    })
}

/// Solves a stack along `a/t` and returns the four quantities as a curve, as
/// [`curve`](crate::curve) does for one film.
///
/// `a_over_t` holds the two ends of the curve. The curve is made for [`Stack::material`]; it has no
/// expansions beyond its ends.
///
/// The compliance of many layers is sampled once.
///
/// # Errors
/// As [`curve`](crate::curve) and [`solve_stack`].
pub fn stack_curve(
    stack: &Stack,
    sphere_modulus: f64,
    a_over_t: [f64; 2],
    tolerance: f64,
) -> Result<Curve, Error> {
    check_range(a_over_t, tolerance)?;
    let layers = Layers::new(stack, a_over_t[1], MANY_LAYERS)?;
    let contact = layers.under(sphere_modulus)?;
    let curve = curve_of(
        &contact.material,
        OF_STACK,
        a_over_t,
        tolerance,
        |x, tolerance| Ok(contact.solve(x, &[], tolerance)?.0.quantities),
    )?;
    Ok(curve.of_stack(stack.shape()))
}

/// Accepts contacts with a stack up to `a_over_t`, which are not too wide beside its top layer.
///
/// # Errors
/// [`Error::StackReach`], for an `a_over_t` beyond the reach by more than the rounding of a ratio of SI values.
pub fn check_reach(stack: &Stack, a_over_t: f64) -> Result<(), Error> {
    /// The largest relative rounding of `a_over_t`: 1 mm over 1 um is more than 1000.
    const ROUNDING: f64 = 1e-12;
    let reach = stack.reach(MOST_A_OVER_TOP);
    if a_over_t <= reach * (1.0 + ROUNDING) {
        return Ok(());
    }
    let merged = stack.merged();
    let layers = match merged.layers().len() {
        1 => "one layer that is not like its base".to_owned(),
        layers => format!("{layers} different layers"),
    };
    let what = format!(
        "this stack of {layers}: its thickness is {:?} times that of its top layer, and the contact radius may be at most {} \
         times that of the top layer; use an a_over_t up to {reach:?}, or leave out a top layer that is too thin to matter",
        stack.thickness() / merged.top().thickness,
        merged.most(MOST_A_OVER_TOP)
    );
    Err(Error::StackReach {
        a_over_t,
        reach,
        what,
    })
}

/// A stack, ready for contacts up to some `a/t` with any sphere.
struct Layers<'a> {
    stack: &'a Stack,
    /// With as few layers as possible, and the solid of the top layer at its surface.
    merged: Stack,
    /// The thickness of the stack over that of the top layer.
    thickness_over_top: f64,
    /// The compliance of the layers, sampled if they are many; none for one film, bonded to the base.
    compliance: Option<Arc<dyn SurfaceCompliance>>,
}

impl<'a> Layers<'a> {
    /// Prepares a stack for contacts up to `a_over_t`. Refuses one that is too wide beside the top
    /// layer, before any work with layers too thin for it. The compliance of `sampled_from` and more
    /// layers is sampled.
    fn new(stack: &'a Stack, a_over_t: f64, sampled_from: usize) -> Result<Self, Error> {
        Error::check("a_over_t", a_over_t, A_OVER_T)?;
        check_reach(stack, a_over_t)?;
        let merged = stack.merged().of_top_layer();
        let compliance = (!merged.is_film()).then(|| -> Arc<dyn SurfaceCompliance> {
            let compliance = LayeredCompliance::new(&merged);
            if merged.layers().len() >= sampled_from {
                Arc::new(SampledCompliance::new(compliance))
            } else {
                Arc::new(compliance)
            }
        });
        Ok(Self {
            stack,
            thickness_over_top: stack.thickness() / merged.top().thickness,
            merged,
            compliance,
        })
    }

    /// Puts the stack under a sphere.
    fn under(&self, sphere_modulus: f64) -> Result<StackContact<'_>, Error> {
        let material = self.stack.material(sphere_modulus)?;
        let of_top = self.merged.material(sphere_modulus)?;
        if of_top.normalisation() == Normalisation::Sphere {
            Error::check(
                "E1*/E2*",
                of_top.film_modulus(),
                [f64::MIN_POSITIVE, f64::MAX],
            )?;
        }
        Ok(StackContact {
            layers: self,
            material,
            of_top,
            factors: factors(&of_top, &material, self.stack),
        })
    }
}

/// A stack under a sphere.
struct StackContact<'a> {
    layers: &'a Layers<'a>,
    /// The surface of the stack and its base.
    material: Material,
    /// The top layer and the base.
    of_top: Material,
    /// The factors of the quantities of the top layer that give those of the surface.
    factors: Quantities,
}

impl StackContact<'_> {
    /// Solves the contact at `a_over_t`, and those of the power laws with the `exponents`.
    fn solve(
        &self,
        a_over_t: f64,
        exponents: &[f64],
        tolerance: f64,
    ) -> Result<(Solution, Vec<PowerLaw>), Error> {
        Error::check("tolerance", tolerance, TOLERANCE)?;
        let x = a_over_t * self.layers.thickness_over_top;
        let of_top = &self.of_top;
        let solved = match &self.layers.compliance {
            None => match solve_power_laws(x, of_top, exponents, tolerance) {
                Err(Error::NotConverged { reached, .. }) => Err(reached),
                solution => Ok(solution?),
            },
            Some(layers) => layered(x, layers, of_top, exponents, tolerance),
        };
        let (mut solution, mut power_laws) = solved.map_err(|reached| Error::NotConverged {
            a_over_t,
            of: OF_STACK,
            tolerance,
            reached,
        })?;
        solution.quantities = self.at_surface(solution.quantities);
        for power_law in &mut power_laws {
            power_law.pi *= self.factors.pi0;
        }
        Ok((solution, power_laws))
    }

    /// Changes the quantities of the top layer into those of the surface.
    fn at_surface(&self, of_top: Quantities) -> Quantities {
        let (factors, values) = (self.factors.to_array(), of_top.to_array());
        Quantities::from_array(std::array::from_fn(|i| values[i] * factors[i]))
    }
}

/// Solves several layers at `x`, the contact radius over the thickness of the top layer. The error
/// is the estimated error that is reached, where that is more than `tolerance`.
fn layered(
    x: f64,
    compliance: &Arc<dyn SurfaceCompliance>,
    of_top: &Material,
    exponents: &[f64],
    tolerance: f64,
) -> Result<(Solution, Vec<PowerLaw>), f64> {
    let symbol = &Symbol::with_compliance(compliance.clone(), of_top);
    let (method, estimate) = if has_closed_form(symbol, tolerance) {
        (Method::ClosedForm, closed_form(symbol, exponents))
    } else {
        (
            Method::Galerkin,
            galerkin::solve(x, symbol, exponents, tolerance),
        )
    };
    estimate.accept(method, tolerance)
}

/// Returns the factors that make the quantities of the `top` layer those of the `surface` of the
/// stack; all 1 but for graded films.
///
/// `Gamma` is proportional to the root of the modulus `es` of the crack tip, and under a rigid
/// sphere the modulus of the surface is the unit.
pub fn factors(top: &Material, surface: &Material, stack: &Stack) -> Quantities {
    let unit = match top.normalisation() {
        Normalisation::Sphere => 1.0,
        Normalisation::Film => stack.top().solid.reduced() / stack.surface().reduced(),
    };
    let tip = surface.sphere_film_modulus() / (unit * top.sphere_film_modulus());
    Quantities {
        pi0: unit,
        eeq: unit,
        gamma: unit * tip.sqrt(),
        delta0: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use interp::Elastic;

    use super::*;
    use crate::compliance::layered::tests::random_stack;
    use crate::estimate::{difference, larger};

    /// Rigid, stiff, soft and very soft spheres on layers of moduli over nine decades, half of
    /// which have another solid at the surface than that of the top layer. Measured: 3.6e-11; the
    /// very soft sphere is the only one that is solved alone, in closed form.
    #[test]
    fn shared_matrices_give_the_quantities_of_single_solves() {
        const TOLERANCE: f64 = 1e-9;
        let spheres = [f64::INFINITY, 1e12, 1e6, 1e3, 1.0, 1e-30];
        let (mut worst, mut contacts, alone) = (0.0, 0, AtomicUsize::new(0));
        for seed in 0..40 {
            let mut stack = random_stack(seed);
            if seed % 2 == 0 {
                let surface = Elastic::new(1e4, 0.3).expect("physical");
                stack = stack.with_surface(surface).expect("not rigid");
            }
            let x = [0.01, 1.0, 20.0][seed as usize % 3];
            let a_over_t = x * stack.top().thickness / stack.thickness();
            let solve_one = |i: usize| {
                alone.fetch_add(1, Ordering::Relaxed);
                Ok(solve_stack(a_over_t, &stack, spheres[i], TOLERANCE)?.quantities)
            };
            let shared =
                solve_stack_under_spheres(a_over_t, &stack, &spheres, TOLERANCE, &solve_one)
                    .expect("within reach");
            for (&sphere, shared) in spheres.iter().zip(&shared) {
                let single =
                    solve_stack(a_over_t, &stack, sphere, TOLERANCE).expect("within reach");
                worst = larger(worst, difference(shared, &single.quantities));
                contacts += 1;
            }
        }
        let alone = alone.into_inner();
        println!("{worst:.1e}; {alone} of {contacts} contacts solved alone");
        assert!(worst <= 2.0 * TOLERANCE);
        assert_eq!(alone, contacts / spheres.len());
    }
}
