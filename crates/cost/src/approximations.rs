//! The closed forms that are in use instead of a solve, each as its authors published it.
//!
//! There are two kinds. The first replaces film and substrate by one half-space. Its compound
//! modulus `E` with the sphere stands for the film at a given contact radius, and JKR follows:
//! `F = 4 E a^3/(3R) - sqrt(8 pi w E a^3)`. This is [`Quantities::homogeneous`] of `E`, with `E` at
//! the crack tip, too. The second is a factor on Hertz's load at a given penetration, for a rigid
//! sphere on a layer bonded to a rigid base.
//!
//! `tests/truth/approximations.rs` compares them with direct solves in their limits,
//! `tabulate cost lookup` measures their errors elsewhere.
//!
//! [`Quantities::homogeneous`]: interp::Quantities::homogeneous

use std::f64::consts::PI;

use interp::Material;

use solve::{A_OVER_T, Error};

/// Returns the modulus of the sphere on the bare substrate, without the film: `E = 1/(1 + 1/e0)`
/// (Johnson, Kendall and Roberts, Proc. R. Soc. Lond. A 324, 301, 1971).
///
/// Load and stiffness are exact as `a/t -> inf`. In the units of [`Material::normalisation`];
/// infinite between rigid bodies.
pub fn bulk_jkr(material: &Material) -> f64 {
    material.sphere_substrate_modulus()
}

/// Returns the modulus of the sphere on a half-space of film, without the substrate:
/// `E = 1/(1 + 1/e1)` (Johnson, Kendall and Roberts 1971, see [`bulk_jkr`]).
///
/// Exact as `a/t -> 0`. In the units of [`Material::normalisation`].
pub fn film_jkr(material: &Material) -> f64 {
    material.sphere_film_modulus()
}

/// Returns the modulus of film and substrate, weighted after Gao, Chiu and Lee (Int. J. Solids
/// Struct. 29, 2471, 1992), in series with the sphere.
///
/// The weights follow from the energy of a flat punch on two materials that hardly differ, with
/// `y = t/a`:
///
/// ```text
/// mu = mu0 + (mu1 - mu0) I0(y)      I0 = 2/pi atan y + [(1 - 2 nu) y ln(1 + 1/y^2) - y/(1 + y^2)] / (2 pi (1 - nu))
/// nu = nu0 + (nu1 - nu0) I1(y)      I1 = 2/pi atan y + y/pi ln(1 + 1/y^2)
/// 1/E = 1 + (1 - nu)/(2 mu)
/// ```
///
/// The shear moduli `mu` are in the units of [`Material::normalisation`]. Under a rigid sphere,
/// `1/E` has 0 in place of 1. Both weights are 1 for thick films and 0 for thin ones. The stiffness
/// is exact to first order in the differences of `mu` and of `nu`. The `nu` in `I0` does not matter
/// to that order; here it is the weighted one. On a rigid substrate `mu` is infinite and the film
/// has no effect.
///
/// # Errors
/// [`Error::Domain`] for an `a_over_t` outside [`A_OVER_T`].
pub fn gao(a_over_t: f64, material: &Material) -> Result<f64, Error> {
    let weighted = Weighted::new(a_over_t, material)?;
    let [mu1, mu0] = weighted.shear_moduli;
    Ok(weighted.compound(mu0 * (1.0 - weighted.share) + mu1 * weighted.share))
}

/// Returns the modulus with the weights of [`gao`] on compliances instead of moduli, as Hay and
/// Crawford fitted it to finite elements (J. Mater. Res. 26, 727, 2011, after Song and Pharr):
///
/// ```text
/// 1/mu = (1 - I0)/(mu0 + 0.0626 I0 mu1) + I0/mu1
/// ```
///
/// with `I0`, `nu` and `E` of [`gao`]. The formula was found in one place only, the manual of an
/// indenter. That the Poisson ratios are weighted as in [`gao`] is an assumption. Without the
/// number 0.0626 the stiffness would be exact to first order, as that of [`gao`]. The number makes
/// the stiffness of a film on a substrate of its own material too large by up to 1.5 %, at
/// `I0 = 1/2`.
///
/// # Errors
/// Those of [`gao`].
pub fn hay_crawford(a_over_t: f64, material: &Material) -> Result<f64, Error> {
    /// Fitted by Hay and Crawford.
    const PARALLEL: f64 = 0.0626;
    let weighted = Weighted::new(a_over_t, material)?;
    let ([mu1, mu0], share) = (weighted.shear_moduli, weighted.share);
    Ok(weighted.compound(1.0 / ((1.0 - share) / (mu0 + PARALLEL * share * mu1) + share / mu1)))
}

/// Returns the modulus of film and substrate as springs in series under a punch, whose stress spreads
/// in the film (Mercier, Mandrillon, Verdier and Brechet, Mater. Tech. 99, 169, 2011), in series with
/// the sphere:
///
/// ```text
/// 1/E = 1 + s/e1 + (1 - s)/e0      s = y/(1 + y), y = 2 t/(pi a)
/// ```
///
/// Both limits are exact, and so is a film of the substrate's material. In the units of
/// [`Material::normalisation`].
///
/// # Errors
/// [`Error::Domain`] for an `a_over_t` outside [`A_OVER_T`].
pub fn springs_in_series(a_over_t: f64, material: &Material) -> Result<f64, Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)?;
    let share = 1.0 / (1.0 + 0.5 * PI * a_over_t);
    let compliance = share / film_jkr(material) + (1.0 - share) / bulk_jkr(material);
    Ok(1.0 / compliance)
}

/// The weighted quantities that [`gao`] and [`hay_crawford`] share.
struct Weighted {
    /// The shear moduli of film and substrate.
    shear_moduli: [f64; 2],
    /// `I0`, the film's share of the shear modulus.
    share: f64,
    poisson_ratio: f64,
    sphere_compliance: f64,
}

impl Weighted {
    fn new(a_over_t: f64, material: &Material) -> Result<Self, Error> {
        Error::check("a_over_t", a_over_t, A_OVER_T)?;
        let y = 1.0 / a_over_t;
        let arctangent = 2.0 / PI * y.atan();
        let logarithm = y * (a_over_t * a_over_t).ln_1p();
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let nu = nu0 + (nu1 - nu0) * (arctangent + logarithm / PI);
        let share = arctangent
            + ((1.0 - 2.0 * nu) * logarithm - y / (1.0 + y * y)) / (2.0 * PI * (1.0 - nu));
        Ok(Self {
            shear_moduli: [
                0.5 * (1.0 - nu1) * material.film_modulus(),
                0.5 * (1.0 - nu0) * material.substrate_modulus(),
            ],
            share,
            poisson_ratio: nu,
            sphere_compliance: material.sphere_compliance(),
        })
    }

    /// Returns the compound modulus of the sphere and a half-space of this shear modulus.
    fn compound(&self, shear_modulus: f64) -> f64 {
        1.0 / (self.sphere_compliance + (1.0 - self.poisson_ratio) / (2.0 * shear_modulus))
    }
}

/// Returns the factor on Hertz's load by Dimitriadis, Horkay, Maresca, Kachar and Chadwick
/// (Biophys. J. 82, 2798, 2002, eq. 10).
///
/// Hertz's load is `4/3 E1* sqrt(R) delta^{3/2}` at the penetration `delta` of a rigid sphere into
/// a layer of thickness `t` and Poisson ratio `nu`, bonded to a rigid base. With
/// `chi = sqrt(R delta)/t`, the factor is
///
/// ```text
/// 1 - 2 alpha/pi chi + 4 alpha^2/pi^2 chi^2 - 8/pi^3 (alpha^3 + 4 pi^2/15 beta) chi^3
///   + 16 alpha/pi^4 (alpha^3 + 3 pi^2/5 beta) chi^4
/// alpha = -(1.2876 - 1.4678 nu + 1.3442 nu^2)/(1 - nu),   beta = (0.6387 - 1.0277 nu + 1.5164 nu^2)/(1 - nu)
/// ```
///
/// It is a series about Hertz. Only its first term is exact, as far as the fit `alpha` is: `alpha`
/// differs from the exact `int_0^inf (X(q) - 1) dq` by 0.5 % at `nu = 0.5`, 0.5 % at `nu = 0.3` and
/// 6 % at `nu = 0`. The second coefficient should be `14/3 alpha^2/pi^2` (see [`garcia`]). At
/// `nu = 0.5` the first three coefficients are those of [`dimitriadis_incompressible`]; the fourth
/// is its 0.0975 with the other sign. These numbers, and `alpha` beside that of the exact kernel,
/// confirm the formula. For other `nu` no second print of it was at hand.
///
/// # Errors
/// [`Error::Domain`] unless `chi` is in `[0, 1e6]` and `nu` in `[0, 0.5]`.
pub fn dimitriadis(chi: f64, nu: f64) -> Result<f64, Error> {
    Error::check("nu1", nu, [0.0, 0.5])?;
    let alpha = -(1.2876 - nu * (1.4678 - nu * 1.3442)) / (1.0 - nu) / PI;
    let beta = (0.6387 - nu * (1.0277 - nu * 1.5164)) / (1.0 - nu) / PI;
    let cube = alpha * alpha * alpha;
    let third = -8.0 * (cube + 4.0 / 15.0 * beta);
    let fourth = 16.0 * alpha * (cube + 3.0 / 5.0 * beta);
    series(chi, [-2.0 * alpha, 4.0 * alpha * alpha, third, fourth])
}

/// Returns the factor of [`dimitriadis`] for an incompressible layer, `nu = 0.5`, with the numbers
/// that are in use (Dimitriadis et al. 2002, eq. 12):
///
/// ```text
/// 1 + 1.133 chi + 1.283 chi^2 + 0.769 chi^3 + 0.0975 chi^4
/// ```
///
/// # Errors
/// [`Error::Domain`] unless `chi` is in `[0, 1e6]`.
pub fn dimitriadis_incompressible(chi: f64) -> Result<f64, Error> {
    series(chi, [1.133, 1.283, 0.769, 0.0975])
}

/// Returns the factor on Hertz's load by Garcia and Garcia (Biophys. J. 114, 2923, 2018, their
/// sphere on an incompressible layer), with `chi` of [`dimitriadis`]:
///
/// ```text
/// 1 + 1.133 chi + 1.497 chi^2 + 1.469 chi^3 + 0.755 chi^4
/// ```
///
/// The coefficients of the exact series are 1.127, 1.482, 1.470 and 1.005.
///
/// # Errors
/// [`Error::Domain`] unless `chi` is in `[0, 1e6]`.
pub fn garcia(chi: f64) -> Result<f64, Error> {
    series(chi, [1.133, 1.497, 1.469, 0.755])
}

/// Returns `1 + c1 chi + c2 chi^2 + c3 chi^3 + c4 chi^4`.
fn series(chi: f64, [c1, c2, c3, c4]: [f64; 4]) -> Result<f64, Error> {
    Error::check("chi", chi, [0.0, 1e6])?;
    Ok(1.0 + chi * (c1 + chi * (c2 + chi * (c3 + chi * c4))))
}
