//! The effects of a scene: what each one costs, and what the load would be without it.

use std::time::{Duration, Instant};

use interp::{Material, Normalisation, Quantity};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

use super::clock;
use super::deviation::median_and_largest;
use super::table::{Made, grouped, human_bytes};
use crate::Error;
use crate::parallel::try_map;
use crate::solve::solve;
use crate::table::Observer;
use crate::table::{Extent, Scene};

/// Something that a scene can do without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// The film: without it the sphere touches the bare substrate, which is JKR and takes no table.
    Film,
    /// The sphere's compliance: without it `e1_over_e2 = 0`, and all is in units of the film's
    /// modulus.
    SphereCompliance,
    /// The substrate's compliance: without it `e0_over_e2 = inf`.
    SubstrateCompliance,
    /// The film's compressibility: without it `nu1 = 0.5`, with the same Young's modulus.
    FilmCompressibility,
    /// Adhesion: without it `w = 0`, and neither `eeq` nor `gamma` is asked for.
    Adhesion,
    /// The penetration: without it `delta0` is not asked for, and the load stays what it is.
    Penetration,
}

impl Effect {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Film,
        Self::SphereCompliance,
        Self::SubstrateCompliance,
        Self::FilmCompressibility,
        Self::Adhesion,
        Self::Penetration,
    ];

    /// The name in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Film => "film",
            Self::SphereCompliance => "sphere compliance",
            Self::SubstrateCompliance => "substrate compliance",
            Self::FilmCompressibility => "film compressibility",
            Self::Adhesion => "adhesion",
            Self::Penetration => "penetration",
        }
    }

    /// What stands in its place.
    pub const fn instead(self) -> &'static str {
        match self {
            Self::Film => "JKR on the bare substrate",
            Self::SphereCompliance => "e1_over_e2 = 0",
            Self::SubstrateCompliance => "e0_over_e2 = inf",
            Self::FilmCompressibility => "nu1 = 0.5",
            Self::Adhesion => "w = 0",
            Self::Penetration => "no delta0",
        }
    }

    /// Whether a scene has it, and something is left without it: between rigid bodies a film cannot
    /// be left out.
    pub fn is_in(self, scene: &Scene) -> bool {
        let [_, e1, nu1, e0] = scene.extents;
        let held = |quantity| scene.quantities.contains(&quantity);
        match self {
            Self::Film => e1 != Extent::Fixed(0.0) || e0 != Extent::Fixed(f64::INFINITY),
            Self::SphereCompliance => e1 != Extent::Fixed(0.0),
            Self::SubstrateCompliance => e0 != Extent::Fixed(f64::INFINITY),
            Self::FilmCompressibility => nu1 != Extent::Fixed(0.5),
            Self::Adhesion => is_adhesive(scene),
            Self::Penetration => held(Quantity::Delta0),
        }
    }

    /// The scene of the table that is left without the effect; none where a closed form is.
    fn scene_without(self, scene: &Scene) -> Option<Scene> {
        let mut variant = scene.clone();
        let [_, e1, nu1, e0] = &mut variant.extents;
        match self {
            Self::Film => return None,
            Self::SphereCompliance => {
                // E0/E1 of the same films on the same substrates.
                let ([softest, stiffest], [from, to]) = (e1.ends(), e0.ends());
                let [from, to] = [from / stiffest, to / softest];
                *e0 = if from < to {
                    Extent::Range { from, to }
                } else {
                    Extent::Fixed(from)
                };
                *e1 = Extent::Fixed(0.0);
            }
            Self::SubstrateCompliance => *e0 = Extent::Fixed(f64::INFINITY),
            Self::FilmCompressibility => *nu1 = Extent::Fixed(0.5),
            Self::Adhesion => variant
                .quantities
                .retain(|quantity| matches!(quantity, Quantity::Pi0 | Quantity::Delta0)),
            Self::Penetration => variant
                .quantities
                .retain(|&quantity| quantity != Quantity::Delta0),
        }
        Some(variant)
    }

    /// The load without the effect, in the units of [`Load`].
    fn load_without(self, a_over_t: f64, material: &Material, truth: Load) -> Result<Load, Error> {
        let with = |e1, nu1, e0| -> Result<Load, Error> {
            Load::new(
                a_over_t,
                &Material::new(e1, nu1, e0, material.nu0())?,
                film_modulus(material),
            )
        };
        let (e1, nu1, e0) = (material.e1_over_e2(), material.nu1(), material.e0_over_e2());
        match self {
            Self::Film => {
                let modulus =
                    unit(material, film_modulus(material)) * material.sphere_substrate_modulus();
                Ok(Load {
                    pressed: 8.0 / 3.0 * modulus,
                    adhesion: modulus.sqrt(),
                })
            }
            Self::SphereCompliance => with(0.0, nu1, e0 / e1),
            Self::SubstrateCompliance => with(e1, nu1, f64::INFINITY),
            Self::FilmCompressibility => with(e1, 0.5, e0),
            Self::Adhesion => Ok(Load {
                adhesion: 0.0,
                ..truth
            }),
            Self::Penetration => Ok(truth),
        }
    }
}

/// Whether a scene asks for what adhesion takes.
fn is_adhesive(scene: &Scene) -> bool {
    [Quantity::Eeq, Quantity::Gamma]
        .iter()
        .all(|quantity| scene.quantities.contains(quantity))
}

/// The parts of the load of eq. 9 at one contact radius, `2 R F/a^3 = pressed - h adhesion` with
/// `h = 2 R (8 pi w/a^3)^{1/2}`, in units of a modulus that does not depend on what is left out:
/// `E2*`, or `E1` under a rigid sphere.
#[derive(Clone, Copy, Debug)]
struct Load {
    /// `U Pi0`, with the modulus `U` that normalises the quantities.
    pressed: f64,
    /// `(U es)^{1/2} Eeq/Gamma`.
    adhesion: f64,
}

impl Load {
    /// Relative tolerance of the solves behind errors.
    const TOLERANCE: f64 = 1e-8;

    fn new(a_over_t: f64, material: &Material, film_modulus: f64) -> Result<Self, Error> {
        let quantities = solve(a_over_t, material, Self::TOLERANCE)?.quantities;
        let unit = unit(material, film_modulus);
        let adhesion =
            (unit * material.sphere_film_modulus()).sqrt() * quantities.eeq / quantities.gamma;
        Ok(Self {
            pressed: unit * quantities.pi0,
            adhesion,
        })
    }
}

/// The film's Young's modulus in the unit of [`Load`].
const fn film_modulus(material: &Material) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => material.e1_over_e2(),
        Normalisation::Film => 1.0,
    }
}

/// The modulus that normalises a material's quantities in the unit of [`Load`], given the film's
/// Young's modulus.
fn unit(material: &Material, film_modulus: f64) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => 1.0,
        Normalisation::Film => film_modulus / ((1.0 - material.nu1()) * (1.0 + material.nu1())),
    }
}

/// The strengths of adhesion that errors are measured at: the adhesive part of the load over the
/// adhesionless load `F0` at the same contact radius. From where adhesion is 1 % of the load, to
/// JKR's pull-off under a load (1 where there is no load).
pub const STRENGTHS: [f64; 2] = [0.01, 2.0];

/// What leaving out each of some effects does to the load at one contact radius, relative to the
/// adhesionless load there, which never vanishes: `|F' - F|/F0`, from direct solves to 1e-8. The
/// strength of adhesion is its part of the load over `F0`, see [`STRENGTHS`]; contact radius,
/// sphere and work of adhesion are the same without the effect.
///
/// # Errors
/// Those of the solve.
pub fn errors(
    effects: &[Effect],
    a_over_t: f64,
    material: &Material,
    strength: f64,
) -> Result<Vec<f64>, Error> {
    let truth = Load::new(a_over_t, material, film_modulus(material))?;
    let error = |&effect: &Effect| {
        let without = effect.load_without(a_over_t, material, truth)?;
        let (pressed, adhesion) = (
            without.pressed / truth.pressed - 1.0,
            without.adhesion / truth.adhesion - 1.0,
        );
        Ok((pressed - strength * adhesion).abs())
    };
    effects.iter().map(error).collect()
}

/// What a scene takes without an effect, what that saves, and what it does to the load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What is left out; nothing in the first row.
    pub without: Option<Effect>,
    /// Relative tolerance of the tables.
    pub tolerance: f64,
    /// Axes of the table that is left.
    pub axes: u64,
    /// Contacts solved for its nodes.
    pub solves: u64,
    /// Threads that made it.
    pub threads: u64,
    /// Time until the HDF5 file was there, planning and certificate included.
    pub seconds: f64,
    /// Size of the HDF5 file.
    pub bytes: u64,
    /// Solves of the whole scene over that.
    pub saved_solves: i64,
    /// Time of the whole scene over that.
    pub saved_seconds: f64,
    /// Size of the whole scene's file over that.
    pub saved_bytes: i64,
    /// Median over the scene of the error of the load, see [`errors`].
    pub median_error: f64,
    /// The largest one.
    pub worst_error: f64,
}

impl Row {
    /// What the effect adds to the scene, in words: solves, time, bytes.
    pub fn saved(&self) -> [String; 3] {
        let signed =
            |negative: bool, size: String| if negative { format!("−{size}") } else { size };
        [
            signed(
                self.saved_solves < 0,
                grouped(self.saved_solves.unsigned_abs()),
            ),
            signed(
                self.saved_seconds < 0.0,
                clock::human(self.saved_seconds.abs()),
            ),
            signed(
                self.saved_bytes < 0,
                human_bytes(self.saved_bytes.unsigned_abs()),
            ),
        ]
    }
}

/// Seed of the points that errors are measured at.
const SEED: u64 = 6;
/// Of the runs that begin within this time the fastest counts.
const PATIENCE: Duration = Duration::from_millis(500);

/// Makes the tables of a scene with everything and without each of its effects, and compares the
/// loads at `points` random points, evenly distributed in the axes' coordinates, with a strength of
/// adhesion that is evenly distributed in its logarithm, see [`STRENGTHS`], or 0 in a scene without
/// adhesion.
///
/// # Errors
/// [`Error::Table`] for a scene without `pi0`, which has no load; those of
/// [`generate`](crate::table::generate) and of the solve.
///
/// # Panics
/// If there is no point.
pub fn measure(scene: &Scene, points: usize, observer: &dyn Observer) -> Result<Vec<Row>, Error> {
    if !scene.quantities.contains(&Quantity::Pi0) {
        return Err(interp::Error::MissingQuantity(Quantity::Pi0.name()).into());
    }
    let effects: Vec<Effect> = Effect::ALL
        .into_iter()
        .filter(|effect| effect.is_in(scene))
        .collect();
    let errors = errors_over(scene, &effects, points, observer)?;
    let whole = fastest(scene, observer)?;
    let mut rows = vec![whole.clone()];
    for (effect, [median_error, worst_error]) in effects.into_iter().zip(errors) {
        let left = match effect.scene_without(scene) {
            Some(variant) => fastest(&variant, observer)?,
            None => Row {
                axes: 0,
                solves: 0,
                seconds: 0.0,
                bytes: 0,
                ..whole.clone()
            },
        };
        rows.push(Row {
            without: Some(effect),
            saved_solves: whole.solves.cast_signed() - left.solves.cast_signed(),
            saved_seconds: whole.seconds - left.seconds,
            saved_bytes: whole.bytes.cast_signed() - left.bytes.cast_signed(),
            median_error,
            worst_error,
            ..left
        });
    }
    Ok(rows)
}

/// What the table of a scene takes.
fn fastest(scene: &Scene, observer: &dyn Observer) -> Result<Row, Error> {
    let begin = Instant::now();
    let mut made = Made::new(scene, None, observer)?;
    while begin.elapsed() < PATIENCE {
        made.seconds = made.seconds.min(Made::new(scene, None, observer)?.seconds);
    }
    Ok(Row {
        without: None,
        tolerance: scene.tolerance,
        axes: scene.axes() as u64,
        solves: made.solves,
        threads: rayon::current_num_threads() as u64,
        seconds: made.seconds,
        bytes: made.bytes,
        saved_solves: 0,
        saved_seconds: 0.0,
        saved_bytes: 0,
        median_error: 0.0,
        worst_error: 0.0,
    })
}

/// The median and the largest error of each effect over a scene.
fn errors_over(
    scene: &Scene,
    effects: &[Effect],
    points: usize,
    observer: &dyn Observer,
) -> Result<Vec<[f64; 2]>, Error> {
    let [weak, strong] = STRENGTHS.map(f64::ln);
    let mut random = Pcg64Mcg::seed_from_u64(SEED);
    let mut strength = || {
        if is_adhesive(scene) {
            random.random_range(weak..strong).exp()
        } else {
            0.0
        }
    };
    let places: Vec<([f64; 4], f64)> = scene
        .random_points(points, SEED)
        .into_iter()
        .map(|point| (point, strength()))
        .collect();
    observer.begin("comparing", points, 0);
    let found = try_map(places, |([a_over_t, e1, nu1, e0], strength)| {
        let found = errors(effects, a_over_t, &scene.material([e1, nu1, e0])?, strength);
        observer.advance(1);
        found
    })?;
    Ok((0..effects.len())
        .map(|i| median_and_largest(found.iter().map(|errors| errors[i]).collect()))
        .collect())
}

/// The rows as a table of the README: of the whole scene, and of each effect what it adds to that
/// and what the load is without it.
pub fn markdown(rows: &[Row]) -> String {
    let [tolerance, threads, axes] = rows.first().map_or([f64::NAN; 3], |row| {
        [row.tolerance, row.threads as f64, row.axes as f64]
    });
    let mut text = format!(
        "| effect | left out by | axes | solves | time, {threads} threads | .h5 | error of the load, median | worst |\n"
    );
    text += "|---|---|---|---|---|---|---|---|\n";
    for row in rows {
        let Some(effect) = row.without else {
            let (solves, seconds, bytes) = (
                grouped(row.solves),
                clock::human(row.seconds),
                human_bytes(row.bytes),
            );
            text +=
                &format!("| all of the scene | | {axes} | {solves} | {seconds} | {bytes} | | |\n");
            continue;
        };
        let [solves, seconds, bytes] = row.saved();
        let [median, worst] = [row.median_error, row.worst_error].map(|error| {
            if error == 0.0 {
                "none".into()
            } else {
                format!("{error:.0e}")
            }
        });
        text += &format!(
            "| {} | {} | {} | {solves} | {seconds} | {bytes} | {median} | {worst} |\n",
            effect.name(),
            effect.instead(),
            axes - row.axes as f64
        );
    }
    let [weak, strong] = STRENGTHS;
    text += &format!(
        "\nTables to {tolerance:e}, planning and certificate included. Errors are relative to the adhesionless load at the same \
         contact radius, over random points of the scene where adhesion takes {weak} to {strong} times that load away.\n"
    );
    let missing: Vec<&str> = Effect::ALL
        .into_iter()
        .filter(|&effect| rows.iter().all(|row| row.without != Some(effect)))
        .map(Effect::name)
        .collect();
    if !missing.is_empty() {
        text += &format!("Not in this scene: {}.\n", missing.join(", "));
    }
    text
}
