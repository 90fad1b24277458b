//! A stack of layers under a sphere: solves it as a film where it is one, by Galerkin's method
//! otherwise.

use interp::{Curve, Material, Normalisation, Quantities};

use crate::Error;
use crate::solve::adaptive_curve::{check_range, curve_of};
use crate::solve::domain::{A_OVER_T, TOLERANCE};
use crate::solve::estimate::{Estimate, larger};
use crate::solve::galerkin;
use crate::solve::layered::LayeredCompliance;
use crate::solve::method::{Method, closed_form, has_closed_form};
use crate::solve::sampled::SampledCompliance;
use crate::solve::solution::{Solution, solve};
use crate::solve::surface::SurfaceCompliance;
use crate::solve::symbol::Symbol;
use crate::stack::Stack;

/// The largest contact radius over the thickness of the top layer for which a stack is solved.
/// Neighbouring layers of one material count as one.
pub const MOST_A_OVER_TOP: f64 = 1000.0;

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
/// [`solve`]; [`Error::StackReach`] where the contact is too wide beside the top layer
/// ([`MOST_A_OVER_TOP`]); [`Error::StackNotConverged`] where double precision does not allow the
/// tolerance.
pub fn solve_stack(
    a_over_t: f64,
    stack: &Stack,
    sphere_modulus: f64,
    tolerance: f64,
) -> Result<Solution, Error> {
    StackContact::new(stack, sphere_modulus, a_over_t, Evaluation::Direct)?
        .solve(a_over_t, tolerance)
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
    let contact = StackContact::new(stack, sphere_modulus, a_over_t[1], Evaluation::Sampled)?;
    let curve = curve_of(
        &contact.material,
        a_over_t,
        tolerance,
        |x, tolerance| Ok(contact.solve(x, tolerance)?.quantities),
        |reached, a_over_t| Error::StackNotConverged {
            a_over_t,
            tolerance,
            reached,
        },
    )?;
    Ok(curve.of_stack(stack.compressibility()))
}

/// The way in which the compliance of a stack is evaluated.
#[derive(Clone, Copy, PartialEq)]
enum Evaluation {
    /// At every wave number anew.
    Direct,
    /// From samples, if there are many layers.
    Sampled,
}

/// A stack under a sphere, ready to be solved up to some `a/t`.
struct StackContact {
    /// The surface of the stack and its base.
    material: Material,
    /// The thickness of the stack over that of the top layer.
    thickness_over_top: f64,
    form: Form,
    /// The factors of the quantities of the top layer that give those of the surface.
    surface: Quantities,
}

/// What a stack turns out to be.
enum Form {
    /// One film on the base.
    Film(Material),
    /// Several layers.
    Layers(Symbol<LayeredCompliance>),
    /// Many layers, sampled.
    Sampled(Symbol<SampledCompliance>),
}

impl StackContact {
    /// Prepares a stack under a sphere for contacts up to `a_over_t`. Refuses one that is too wide
    /// beside the top layer, before any work with layers too thin for it.
    fn new(
        stack: &Stack,
        sphere_modulus: f64,
        a_over_t: f64,
        evaluation: Evaluation,
    ) -> Result<Self, Error> {
        Error::check("a_over_t", a_over_t, A_OVER_T)?;
        let material = stack.material(sphere_modulus)?;
        let merged = stack.merged();
        let layers = merged.layers().len();
        let of_top = merged.clone().of_top_layer().material(sphere_modulus)?;
        if of_top.normalisation() == Normalisation::Sphere {
            Error::check(
                "E1*/E2*",
                of_top.film_modulus(),
                [f64::MIN_POSITIVE, f64::MAX],
            )?;
        }
        let thickness_over_top = stack.thickness() / merged.top().thickness;
        let reach = MOST_A_OVER_TOP / thickness_over_top;
        let form = if layers == 1 {
            Form::Film(of_top)
        } else if a_over_t > reach {
            return Err(Error::StackReach {
                a_over_t,
                reach,
                thickness_over_top,
                layers,
            });
        } else {
            let compliance = LayeredCompliance::new(&merged);
            if evaluation == Evaluation::Sampled && layers >= MANY_LAYERS {
                let sampled = SampledCompliance::new(compliance);
                Form::Sampled(Symbol::with_compliance(sampled, &of_top))
            } else {
                Form::Layers(Symbol::with_compliance(compliance, &of_top))
            }
        };
        Ok(Self {
            material,
            thickness_over_top,
            form,
            surface: factors(&of_top, &material, stack),
        })
    }

    /// Solves the contact at `a_over_t`.
    fn solve(&self, a_over_t: f64, tolerance: f64) -> Result<Solution, Error> {
        Error::check("tolerance", tolerance, TOLERANCE)?;
        let x = a_over_t * self.thickness_over_top;
        let not_converged = |reached| Error::StackNotConverged {
            a_over_t,
            tolerance,
            reached,
        };
        let solution = match &self.form {
            Form::Film(material) => match solve(x, material, tolerance) {
                Err(Error::NotConverged { reached, .. }) => Err(not_converged(reached)),
                solution => solution,
            }?,
            Form::Layers(symbol) => layered(x, symbol, tolerance).map_err(not_converged)?,
            Form::Sampled(symbol) => layered(x, symbol, tolerance).map_err(not_converged)?,
        };
        let factors = self.surface.to_array();
        let values = solution.quantities.to_array();
        Ok(Solution {
            quantities: Quantities::from_array(std::array::from_fn(|i| values[i] * factors[i])),
            ..solution
        })
    }
}

/// Solves several layers at `x`, the contact radius over the thickness of the top layer. The error
/// is the estimated error that is reached, where that is more than `tolerance`.
fn layered<C: SurfaceCompliance>(
    x: f64,
    symbol: &Symbol<C>,
    tolerance: f64,
) -> Result<Solution, f64> {
    let (method, estimate) = if has_closed_form(symbol, tolerance) {
        (Method::ClosedForm, closed_form(symbol))
    } else {
        (Method::Galerkin, galerkin::solve(x, symbol, tolerance))
    };
    let Estimate {
        quantities,
        error,
        modes,
    } = estimate;
    // A value that underflows has lost its digits.
    let normal = quantities.to_array().into_iter().all(f64::is_normal);
    let error = if normal { error } else { larger(error, 1.0) };
    if error <= tolerance {
        Ok(Solution {
            quantities,
            error,
            modes,
            method,
        })
    } else {
        Err(error)
    }
}

/// Returns the factors that make the quantities of the `top` layer those of the `surface` of the
/// stack; all 1 but for graded films.
///
/// `Gamma` is proportional to the root of the modulus `es` of the crack tip, and under a rigid
/// sphere the modulus of the surface is the unit.
fn factors(top: &Material, surface: &Material, stack: &Stack) -> Quantities {
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
