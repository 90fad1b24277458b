//! The series for thin layers, where they apply: a rigid sphere without adhesion on a layer bonded
//! to a rigid base.

use interp::Material;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::load::Errors;
use super::{Family, NEW, Row};
use crate::approximations::{dimitriadis, dimitriadis_incompressible, garcia};
use crate::clock::Timing;
use crate::deviation::tightest;
use solve::Error;
use solve::parallel::try_map;

/// The load of a layer at a penetration.
struct Layer {
    /// `sqrt(R delta)/t`.
    chi: f64,
    /// The Poisson ratio.
    nu: f64,
    /// The load over Hertz's.
    factor: f64,
}

/// A form: its name, and its factor on Hertz's load at `chi` and a Poisson ratio.
type Form = (&'static str, fn(f64, f64) -> Result<f64, Error>);

const HERTZ: Form = ("Hertz on the film alone", |_, _| Ok(1.0));
const DIMITRIADIS: Form = ("Dimitriadis 2002, eq. 12", |chi, _| {
    dimitriadis_incompressible(chi)
});
const DIMITRIADIS_ANY: Form = ("Dimitriadis 2002, eq. 10", dimitriadis);
const GARCIA: Form = ("Garcia 2018", |chi, _| garcia(chi));

/// The scopes of the comparison: the ranges of `a/t` and of the Poisson ratio, and the forms.
const SCOPES: [([f64; 2], [f64; 2], &[Form]); 3] = [
    ([1e-3, 1.0], [0.5, 0.5], &[HERTZ, DIMITRIADIS, GARCIA]),
    ([1.0, 10.0], [0.5, 0.5], &[HERTZ, DIMITRIADIS, GARCIA]),
    ([1e-3, 1.0], [0.0, 0.5], &[HERTZ, DIMITRIADIS_ANY]),
];

/// Returns the number of solves that [`measure`] reports.
pub const fn solves(points: usize) -> usize {
    SCOPES.len() * points
}

/// Measures the series at `points` random points of each scope.
pub fn measure(
    points: usize,
    timing: Timing,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    for (x, nu, forms) in SCOPES {
        let layers = layers(x, nu, points, progress)?;
        let poisson_ratio = if nu[0] == nu[1] {
            format!("{}", nu[0])
        } else {
            format!("{} to {}", nu[0], nu[1])
        };
        let scope = format!(
            "rigid sphere, rigid substrate, nu1 {poisson_ratio}, a/t {:e} to {:e}",
            x[0], x[1]
        );
        for (name, form) in forms {
            let found = layers
                .iter()
                .map(|layer| form(layer.chi, layer.nu))
                .collect::<Result<Vec<_>, _>>()?;
            let ratios = found
                .iter()
                .zip(&layers)
                .map(|(found, layer)| found / layer.factor);
            let seconds = timing.per_one(&layers, |layer| {
                form(layer.chi, layer.nu).unwrap_or(f64::NAN)
            });
            let errors = Errors::of_ratios(ratios.collect());
            rows.push(errors.row(
                Family::ClosedForm,
                name,
                NEW,
                seconds,
                &scope,
                "penetration",
            ));
        }
    }
    Ok(rows)
}

/// Solves layers at random points, evenly distributed in `ln(a/t)` and in the Poisson ratio.
fn layers(
    x: [f64; 2],
    nu: [f64; 2],
    points: usize,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Layer>, Error> {
    let mut random = Pcg64Mcg::seed_from_u64(2);
    let mut between = |from: f64, to: f64| from + (to - from) * random.random_range(0.0..1.0);
    let places: Vec<[f64; 2]> = (0..points)
        .map(|_| [between(x[0].ln(), x[1].ln()).exp(), between(nu[0], nu[1])])
        .collect();
    try_map(places, |[x, nu]| {
        let solved = tightest(x, &Material::new(0.0, nu, f64::INFINITY, 0.25)?)?.quantities;
        progress(1);
        // `F = a^3 E1* pi0/(2 R)` at `delta = a^2 delta0/R`, over `4/3 E1* sqrt(R) delta^{3/2}`.
        let factor = 0.375 * solved.pi0 / (solved.delta0 * solved.delta0.sqrt());
        Ok(Layer {
            chi: x * solved.delta0.sqrt(),
            nu,
            factor,
        })
    })
}
