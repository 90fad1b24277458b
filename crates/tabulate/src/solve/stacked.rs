//! A stack of layers under a sphere: solves it as a film where it is one, by Galerkin's method
//! otherwise.

use interp::{Curve, Material, Normalisation, Quantities};

use crate::Error;
use crate::solve::adaptive_curve::{check_range, curve_of};
use crate::solve::domain::{A_OVER_T, TOLERANCE};
use crate::solve::galerkin;
use crate::solve::layered::LayeredCompliance;
use crate::solve::method::{Method, closed_form, has_closed_form};
use crate::solve::power_law::{self, PowerLaw};
use crate::solve::sampled::SampledCompliance;
use crate::solve::solution::{Solution, solve_power_laws};
use crate::solve::surface::SurfaceCompliance;
use crate::solve::symbol::Symbol;
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
/// ([`MOST_A_OVER_TOP`]); [`Error::StackNotConverged`] where double precision does not allow the
/// tolerance.
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
    StackContact::new(stack, sphere_modulus, a_over_t, Evaluation::Direct)?
        .solve(a_over_t, exponents, tolerance)
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
        |x, tolerance| Ok(contact.solve(x, &[], tolerance)?.0.quantities),
        |reached, a_over_t| Error::StackNotConverged {
            a_over_t,
            tolerance,
            reached,
        },
    )?;
    Ok(curve.of_stack(stack.shape()))
}

/// Accepts contacts with a stack up to `a_over_t`, which are not too wide beside its top layer.
///
/// # Errors
/// [`Error::StackReach`]
pub fn check_reach(stack: &Stack, a_over_t: f64) -> Result<(), Error> {
    let merged = stack.merged();
    let layers = merged.layers().len();
    let thickness_over_top = stack.thickness() / merged.top().thickness;
    let reach = MOST_A_OVER_TOP / thickness_over_top;
    // One layer is solved as a film.
    if layers == 1 || a_over_t <= reach {
        return Ok(());
    }
    Err(Error::StackReach {
        a_over_t,
        reach,
        thickness_over_top,
        layers,
    })
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
        check_reach(stack, a_over_t)?;
        let thickness_over_top = stack.thickness() / merged.top().thickness;
        let form = if layers == 1 {
            Form::Film(of_top)
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

    /// Solves the contact at `a_over_t`, and those of the power laws with the `exponents`.
    fn solve(
        &self,
        a_over_t: f64,
        exponents: &[f64],
        tolerance: f64,
    ) -> Result<(Solution, Vec<PowerLaw>), Error> {
        Error::check("tolerance", tolerance, TOLERANCE)?;
        let x = a_over_t * self.thickness_over_top;
        let not_converged = |reached| Error::StackNotConverged {
            a_over_t,
            tolerance,
            reached,
        };
        let (mut solution, mut power_laws) = match &self.form {
            Form::Film(material) => match solve_power_laws(x, material, exponents, tolerance) {
                Err(Error::NotConverged { reached, .. }) => Err(not_converged(reached)),
                solution => solution,
            }?,
            Form::Layers(symbol) => {
                layered(x, symbol, exponents, tolerance).map_err(not_converged)?
            }
            Form::Sampled(symbol) => {
                layered(x, symbol, exponents, tolerance).map_err(not_converged)?
            }
        };
        let factors = self.surface.to_array();
        let values = solution.quantities.to_array();
        solution.quantities =
            Quantities::from_array(std::array::from_fn(|i| values[i] * factors[i]));
        for power_law in &mut power_laws {
            power_law.pi *= self.surface.pi0;
        }
        Ok((solution, power_laws))
    }
}

/// Solves several layers at `x`, the contact radius over the thickness of the top layer. The error
/// is the estimated error that is reached, where that is more than `tolerance`.
fn layered<C: SurfaceCompliance>(
    x: f64,
    symbol: &Symbol<C>,
    exponents: &[f64],
    tolerance: f64,
) -> Result<(Solution, Vec<PowerLaw>), f64> {
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
