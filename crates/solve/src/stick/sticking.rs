//! A sphere that sticks to a film or to a stack of layers: the flat punch and the growing contact,
//! each to a tolerance.

use interp::{Curve, Material, Quantities, StackShape};

use crate::Error;
use crate::compliance::layered::LayeredCompliance;
use crate::domain;
use crate::error::WITH_STICK;
use crate::estimate::larger;
use crate::galerkin;
use crate::galerkin::quadrature::{PanelWeights, Panels};
use crate::power_law::EXPONENTS;
use crate::stack::Stack;
use crate::stacked::factors;
use crate::stick::bodies::Bodies;
use crate::stick::field::{Field, Waves};
use crate::stick::growth::{Grown, Growth, grow};

/// The largest contact radius over the thickness of the top layer for which the flat punch with
/// stick is solved.
pub const MOST_OF_PUNCH: f64 = 300.0;

/// The largest contact radius over the thickness of the top layer for which a growing contact is
/// solved.
pub const MOST_OF_TIP: f64 = 30.0;

/// The relative tolerances of a punch with stick.
pub const PUNCH_TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// The relative tolerances of a growing contact.
pub const TIP_TOLERANCE: [f64; 2] = [1e-11, 1e-2];

/// The smallest `a/t` of a contact with stick.
const LEAST_A_OVER_T: f64 = 1e-6;

/// The exponents `n` of the profiles `r^n` of growing contacts: below 1 the contact begins too fast
/// for the powers of `sqrt(a)` that it is made of.
pub const TIP_EXPONENTS: [f64; 2] = [1.0, EXPONENTS[1]];

/// A sphere and the film or the stack of layers that it sticks to.
#[derive(Clone, Debug)]
pub struct Sticking {
    bodies: Bodies,
    /// The thickness of the stack over that of the top layer; 1 for a film.
    thickness_over_top: f64,
    /// The factors that make the quantities of the top layer those of the surface.
    factors: Quantities,
    material: Material,
    nu2: f64,
    /// What a curve of a stack holds beside its quantities.
    stack: Option<StackShape>,
}

/// The flat punch with stick, in the unit of the material's quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickPunch {
    /// The stiffness `S_s = 2 a E* Eeq_s`.
    pub eeq_s: f64,
    /// The edge singularity of both fields together, of the energy release rate
    /// `G = (E* delta Gamma_eff)^2/(2 pi a Es*)`.
    pub gamma_eff: f64,
    /// The edge singularities `Gamma_s` of the normal and `Gamma_t` of the tangential field, where
    /// Dundurs' beta of sphere and top layer is 0. Elsewhere they have no meaning of their own.
    pub edge: Option<[f64; 2]>,
    /// Estimated largest relative error; that of `Gamma_t` is relative to `Gamma_eff`.
    pub error: f64,
    /// The number of unknowns.
    pub modes: usize,
}

impl Sticking {
    /// Puts a sphere of Poisson ratio `nu2` on the film of `material`; under a rigid sphere `nu2`
    /// has no effect.
    ///
    /// # Errors
    /// [`Error::Domain`] for a `nu2` outside `(-1, 0.5]` or a ratio of moduli outside the domain of
    /// [`solve`](crate::solve()).
    pub fn on_film(material: &Material, nu2: f64) -> Result<Self, Error> {
        domain::check(1.0, material, 1e-2)?;
        check_poisson(nu2)?;
        Ok(Self {
            bodies: Bodies::new(LayeredCompliance::of_film(material), material, nu2),
            thickness_over_top: 1.0,
            factors: Quantities::from_array([1.0; 4]),
            material: *material,
            nu2,
            stack: None,
        })
    }

    /// Puts a sphere of reduced modulus `sphere_modulus` (Pa; infinity is rigid) and Poisson ratio
    /// `nu2` on a stack of layers.
    ///
    /// # Errors
    /// As [`Sticking::on_film`] and [`Stack::material`].
    pub fn on_stack(stack: &Stack, sphere_modulus: f64, nu2: f64) -> Result<Self, Error> {
        check_poisson(nu2)?;
        let merged = stack.merged().of_top_layer();
        let of_top = merged.material(sphere_modulus)?;
        let material = stack.material(sphere_modulus)?;
        domain::check(1.0, &of_top, 1e-2)?;
        Ok(Self {
            bodies: Bodies::new(LayeredCompliance::new(&merged), &of_top, nu2),
            thickness_over_top: stack.thickness() / merged.top().thickness,
            factors: factors(&of_top, &material, stack),
            material,
            nu2,
            stack: Some(stack.shape()),
        })
    }

    /// Returns the same bodies without friction: the methods of this page then give the numbers of
    /// the contact without friction.
    #[must_use]
    pub fn without_friction(self) -> Self {
        Self {
            bodies: self.bodies.without_friction(),
            ..self
        }
    }

    /// Returns Dundurs' `beta = es (b1/e1 - b2)` of sphere and top layer.
    pub fn beta(&self) -> f64 {
        self.bodies.beta
    }

    /// Returns the material of the surface and the base.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Marks a curve of a stack as such.
    pub(super) fn mark(&self, curve: Curve) -> Curve {
        match self.stack {
            Some(shape) => curve.of_stack(shape),
            None => curve,
        }
    }

    /// Returns the largest `a_over_t` for which the flat punch is solved: [`MOST_OF_PUNCH`] of the top
    /// layer.
    pub fn most_of_punch(&self) -> f64 {
        MOST_OF_PUNCH / self.thickness_over_top
    }

    /// Returns the load with stick over that without, of a flat punch of radius `a_over_t` at equal
    /// penetration: the factor by which a model without friction underestimates the stiffness.
    ///
    /// Under a sphere that sticks to an incompressible film, the load at equal penetration rises by half
    /// of this where the contact is narrow, and by 0.9 of it at `a/t = 5`.
    ///
    /// # Errors
    /// As [`Sticking::punch`].
    pub fn stiffening(&self, a_over_t: f64, tolerance: f64) -> Result<f64, Error> {
        let sticks = self.punch(a_over_t, tolerance)?;
        let slides = self.clone().without_friction().punch(a_over_t, tolerance)?;
        Ok(sticks.eeq_s / slides.eeq_s)
    }

    /// Solves the flat punch of radius `a_over_t` to the relative `tolerance`.
    ///
    /// Measured (`tests/truth/stick.rs`): every reference row within its stated error.
    ///
    /// # Errors
    /// [`Error::Domain`] for an `a_over_t` or a `tolerance` outside the domain;
    /// [`Error::NotConverged`] where double precision does not allow the tolerance.
    pub fn punch(&self, a_over_t: f64, tolerance: f64) -> Result<StickPunch, Error> {
        Error::check("tolerance", tolerance, PUNCH_TOLERANCE)?;
        Error::check("a_over_t", a_over_t, [LEAST_A_OVER_T, self.most_of_punch()])?;
        let x = a_over_t * self.thickness_over_top;
        let [mut of_modes, mut of_panels] = [tolerance; 2];
        let mut reached = f64::INFINITY;
        for _ in 0..ROUNDS {
            let waves = Waves::new(&self.bodies, self.panels(x, of_panels), x);
            let modes = modes(x, of_modes);
            let field = waves.field(x, modes, false);
            if let Some(field) = &field {
                let error = field.error();
                if error <= tolerance {
                    return Ok(self.punch_of(field, modes));
                }
                reached = larger(0.0, error).min(reached);
                // Refines the larger source of the error, unless that is rounding.
                if field.rounding >= 0.5 * error {
                    break;
                }
                if field.quadrature >= 0.5 * error {
                    of_panels *= 0.03;
                } else {
                    of_modes *= 0.03;
                }
            } else {
                (of_modes, of_panels) = (0.01 * of_modes, 0.1 * of_panels);
            }
            if of_modes.min(of_panels) < FINEST {
                break;
            }
        }
        Err(not_converged(a_over_t, tolerance, reached))
    }

    /// Takes the numbers of a field.
    fn punch_of(&self, field: &Field, modes: usize) -> StickPunch {
        let es = self.bodies.modulus;
        let gamma = es * self.factors.gamma;
        StickPunch {
            eeq_s: es * self.factors.eeq * field.eeq,
            gamma_eff: gamma * field.edge.sqrt(),
            edge: field.parts.map(|parts| parts.map(|part| gamma * part)),
            error: field.error(),
            modes,
        }
    }

    /// Solves the contact of a probe with the profile `r^exponent` that has grown to `a_over_t`
    /// with stick, to the relative `tolerance`. The exponent 2 is a sphere.
    ///
    /// # Errors
    /// As [`Sticking::grown`].
    pub fn tip(&self, a_over_t: f64, exponent: f64, tolerance: f64) -> Result<(Grown, f64), Error> {
        let grown = self.grown(a_over_t, exponent, tolerance)?;
        Ok((grown.evaluate(a_over_t), grown.error()))
    }

    /// Solves the growing contact of a probe with the profile `r^exponent` from 0 to `a_over_t`.
    ///
    /// # Errors
    /// [`Error::Domain`] for an argument outside the domain; [`Error::Coupled`] where Dundurs' beta
    /// of sphere and top layer is not 0; [`Error::NotConverged`] where double precision does
    /// not allow the tolerance.
    pub fn grown(
        &self,
        a_over_t: f64,
        exponent: f64,
        tolerance: f64,
    ) -> Result<GrownContact, Error> {
        Error::check("tolerance", tolerance, TIP_TOLERANCE)?;
        Error::check("exponent", exponent, TIP_EXPONENTS)?;
        if self.bodies.beta != 0.0 {
            return Err(Error::Coupled {
                beta: self.bodies.beta,
                factor: self.bodies.beta.atanh() / self.bodies.beta,
                nu1: self.material.nu1(),
                nu2: self.nu2,
            });
        }
        let most = MOST_OF_TIP / self.thickness_over_top;
        // A quotient of lengths is rounded.
        let is_end = a_over_t > most && a_over_t <= most * (1.0 + 4.0 * f64::EPSILON);
        let a_over_t = if is_end { most } else { a_over_t };
        Error::check("a_over_t", a_over_t, [LEAST_A_OVER_T, most])?;
        let x = a_over_t * self.thickness_over_top;
        let not_converged = |reached| not_converged(a_over_t, tolerance, reached);
        // Errors of the punches grow where the equation differentiates them, and with the compliance of
        // long waves, which is large where a stiff film lies on a soft base.
        let of_long_waves = self.bodies.film * self.bodies.surface.x(LONG_WAVES / x);
        let of_punches = SHARE_OF_PUNCHES * tolerance / larger(1.0, of_long_waves);
        let of_punches = of_punches.max(FINEST);
        let waves = Waves::new(&self.bodies, self.panels(x, 0.1 * of_punches), x);
        let grow = |count: usize| {
            grow(&waves, x, exponent, count, |x| modes(x, of_punches))
                .ok_or_else(|| not_converged(f64::INFINITY))
        };
        let digits = -tolerance.log10();
        let mut count = ((12.0 + 5.0 * x) * (0.4 + 0.09 * digits)).ceil() as usize;
        let mut coarse = grow(count)?;
        let mut reached = f64::INFINITY;
        while count < MOST_POINTS {
            count += 2 + 7 * count / 20;
            let fine = grow(count)?;
            let ratio = fine.points.at.len() as f64 / coarse.points.at.len() as f64;
            let change = coarse.difference(&fine);
            let extrapolated = EXTRAPOLATION * change.powf(ratio);
            let error = larger(extrapolated, LEAST_SHARE * change) + fine.error_of_punches;
            if error <= tolerance {
                return Ok(GrownContact {
                    largest: a_over_t,
                    growth: fine,
                    sticking: self.clone(),
                    error,
                });
            }
            // Where only rounding is left, more points do not help. Large estimates mean nothing.
            let stalled = reached < RESOLVED && error > STALLED * reached;
            if fine.error_of_punches > tolerance || stalled {
                reached = reached.min(error);
                break;
            }
            reached = larger(0.0, error);
            coarse = fine;
        }
        Err(not_converged(reached))
    }

    /// Returns panels for punches up to `x` to a relative `tolerance`.
    fn panels(&self, x: f64, tolerance: f64) -> Panels {
        Panels::new(
            x,
            [&self.bodies.surface],
            PanelWeights::Waves,
            tolerance.max(FINEST),
        )
    }
}

/// A contact that has grown with stick from 0 to some radius.
pub struct GrownContact {
    largest: f64,
    growth: Growth,
    pub(super) sticking: Sticking,
    error: f64,
}

impl GrownContact {
    /// Returns the numbers at a radius up to the largest.
    ///
    /// # Errors
    /// [`Error::Domain`] for an `a_over_t` that is not positive, or above the largest.
    pub fn at(&self, a_over_t: f64) -> Result<Grown, Error> {
        Error::check("a_over_t", a_over_t, [f64::MIN_POSITIVE, self.largest])?;
        Ok(self.evaluate(a_over_t))
    }

    /// Returns the numbers at a radius, which is not checked.
    pub(super) fn evaluate(&self, a_over_t: f64) -> Grown {
        let of_top = self.growth.at(a_over_t * self.sticking.thickness_over_top);
        let Quantities {
            pi0, eeq, gamma, ..
        } = self.sticking.factors;
        Grown {
            a_over_t,
            eeq_s: eeq * of_top.eeq_s,
            gamma_s: gamma * of_top.gamma_s,
            gamma_t: gamma * of_top.gamma_t,
            pi_s: pi0 * of_top.pi_s,
            delta_s: of_top.delta_s,
            gamma_g: gamma * of_top.gamma_g,
            eeq_g: eeq * of_top.eeq_g,
        }
    }

    /// Returns the estimated largest relative error.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// The number of times that a punch is refined.
const ROUNDS: usize = 12;

/// The smallest tolerance of truncation and quadrature that is of use.
const FINEST: f64 = 1e-15;

/// The largest number of punches of a growing contact.
const MOST_POINTS: usize = 500;

/// The factor that brings the extrapolated error of a growing contact above the true one.
const EXTRAPOLATION: f64 = 10.0;

/// The part of the change by the last refinement that the error is taken to be at least.
const LEAST_SHARE: f64 = 0.5;

/// The share of the tolerance of a growing contact for its punches. Its equation magnifies their errors: on an
/// incompressible film by more than 100 at the largest radius. Smaller punches cost less than further points.
const SHARE_OF_PUNCHES: f64 = 1e-4;

/// The product of wave number and contact radius of waves that are long beside the contact.
const LONG_WAVES: f64 = 1e-2;

/// The estimated error below which a growing contact is resolved, so that refinements have to help.
const RESOLVED: f64 = 1e-5;

/// The part of the error of the round before above which a refinement has not helped.
const STALLED: f64 = 0.7;

/// The error of a contact with stick whose tolerance is not reached.
pub(super) fn not_converged(a_over_t: f64, tolerance: f64, reached: f64) -> Error {
    Error::NotConverged {
        a_over_t,
        of: WITH_STICK,
        tolerance,
        reached,
    }
}

/// Returns the number of modes for a punch of radius `x`: twice that of the contact without
/// friction.
fn modes(x: f64, tolerance: f64) -> usize {
    2 * galerkin::modes(x, tolerance)
}

/// Accepts a Poisson ratio of the sphere.
fn check_poisson(nu2: f64) -> Result<(), Error> {
    if nu2 > -1.0 && nu2 <= 0.5 {
        Ok(())
    } else {
        Err(Error::Domain {
            name: "nu2",
            value: nu2,
            from: -1.0,
            to: 0.5,
        })
    }
}
