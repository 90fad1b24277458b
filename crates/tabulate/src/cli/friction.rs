//! The flags of friction, and the numbers of contacts that stick.

use clap::{ValueEnum, ValueHint};
use contact::Contact;
use solve::Error;
use solve::stick::{MOST_OF_TIP, PUNCH_TOLERANCE, StickCurves, Sticking, TIP_TOLERANCE};

use super::bodies::{Bodies, BodiesArguments};
use super::note;
use super::quantity::{force_per_length, length, number};
use super::table_name::{self, TableName};

/// The flags of friction of a solve.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct FrictionArguments {
    /// Friction between the surfaces: none, or stick, where surfaces that have touched never slide
    #[arg(long, value_enum, default_value = "none")]
    friction: Friction,
    /// With --friction stick: Poisson ratio of the sphere [default: 0.5]. A rigid sphere needs none
    #[arg(long, alias = "sphere-poisson-ratio", value_name = "NU2", value_parser = number)]
    nu2: Option<f64>,
}

/// The flags of friction between bodies in SI units, and the work of adhesion of a line that
/// recedes.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct HistoryArguments {
    /// Friction between the surfaces: none, or stick, where surfaces that have touched never slide
    #[arg(long, value_enum, default_value = "none")]
    friction: Friction,
    /// Poisson ratio of the sphere, for --friction stick [default there: 0.5], and for a fit of its
    /// modulus, which then prints Young's modulus E2 = E2* (1 - nu2^2), too. Nothing else needs it
    #[arg(long, visible_alias = "nu2", value_name = "NU", value_parser = poisson_ratio)]
    pub sphere_poisson_ratio: Option<f64>,
    /// With --friction stick: work of adhesion with which the contact recedes, J/m^2. It is at least
    /// --work-of-adhesion, with which the contact has grown. With --work-of-adhesion 0 the contact
    /// has grown by the load alone
    #[arg(long, value_name = "J/m^2", value_parser = force_per_length)]
    pub work_of_adhesion_receding: Option<f64>,
}

/// The flags of a contact: its table, its bodies, and what acts between them.
#[derive(clap::Args)]
#[group(skip)]
pub struct ContactArguments {
    #[arg(
        help = format!("{}. Without a table, contacts are solved directly", table_name::HELP),
        value_hint = ValueHint::FilePath
    )]
    pub table: Option<TableName>,
    #[command(flatten)]
    pub bodies: BodiesArguments,
    /// Distance over which the attraction acts, m: a constant stress, the work of adhesion over
    /// this distance, wherever the gap is smaller (Dugdale's law). Without it the distance is 0 (JKR)
    #[arg(long, value_name = "M", conflicts_with = "table", value_parser = length)]
    pub interaction_range: Option<f64>,
    #[command(flatten)]
    pub history: HistoryArguments,
}

/// Parses the Poisson ratio of a solid.
fn poisson_ratio(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    let allowed = value > -1.0 && value <= 0.5;
    let refused = || format!("{value:?} is not a Poisson ratio: give one above -1 and up to 0.5");
    allowed.then_some(value).ok_or_else(refused)
}

/// The Poisson ratio of a sphere that sticks, if none is given.
const USUAL_POISSON_RATIO: f64 = 0.5;

/// The ends of friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Friction {
    /// The surfaces slide freely
    None,
    /// The surfaces never slide
    Stick,
}

/// The names of the numbers of a contact that sticks.
pub const COLUMNS: &str = "eeq_s gamma_s gamma_t gamma_eff delta_s pi_s gamma_g eeq_g error_s";

/// The estimated relative error up to which a default tolerance yields to rounding.
const LARGEST_ERROR: f64 = 1e-6;

impl FrictionArguments {
    /// Returns the Poisson ratio of the sphere where the contact sticks.
    pub fn sticks(&self) -> Option<f64> {
        let nu2 = self.nu2.unwrap_or(USUAL_POISSON_RATIO);
        (self.friction == Friction::Stick).then_some(nu2)
    }

    /// Refuses a Poisson ratio of the sphere that nothing would use.
    pub fn check(&self) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.friction == Friction::Stick || self.nu2.is_none(),
            "--nu2, the Poisson ratio of the sphere, has no effect without friction; add --friction \
             stick, or leave it out"
        );
        Ok(())
    }
}

/// Solves the numbers of [`COLUMNS`], and tells why those of a sphere are missing, if they are.
///
/// Without a `tolerance` it is 1e-10, or what rounding allows up to 1e-6.
pub fn numbers(
    sticking: &Sticking,
    a_over_t: f64,
    tolerance: Option<f64>,
) -> Result<([Option<f64>; 9], Option<Error>), Error> {
    let wanted = tolerance.unwrap_or(1e-10);
    let punch = within(tolerance, wanted.max(PUNCH_TOLERANCE[0]), |tolerance| {
        sticking.punch(a_over_t, tolerance)
    })?;
    let tip = within(
        tolerance,
        wanted.max(10.0 * TIP_TOLERANCE[0]),
        |tolerance| sticking.tip(a_over_t, 2.0, tolerance),
    );
    let (tip, missing) = match tip {
        Ok(tip) => (Some(tip), None),
        Err(error @ (Error::Coupled { .. } | Error::Domain { .. })) => (None, Some(error)),
        Err(error) => return Err(error),
    };
    let of_tip = |value: fn(&solve::stick::Grown) -> f64| tip.as_ref().map(|(tip, _)| value(tip));
    let error = tip.map_or(punch.error, |(_, error)| punch.error.max(error));
    let [gamma_s, gamma_t] = [0, 1].map(|i| punch.edge.map(|edge| edge[i]));
    let numbers = [
        Some(punch.eeq_s),
        gamma_s,
        gamma_t,
        Some(punch.gamma_eff),
        of_tip(|tip| tip.delta_s),
        of_tip(|tip| tip.pi_s),
        of_tip(|tip| tip.gamma_g),
        of_tip(|tip| tip.eeq_g),
        Some(error),
    ];
    Ok((numbers, missing))
}

/// Solves to a tolerance that was `given`, or to a usual one, which yields to rounding.
pub fn within<T>(
    given: Option<f64>,
    tolerance: f64,
    solve: impl Fn(f64) -> Result<T, Error>,
) -> Result<T, Error> {
    match solve(tolerance) {
        Err(Error::NotConverged { reached, .. })
            if given.is_none() && 2.0 * reached <= LARGEST_ERROR =>
        {
            within(given, 2.0 * reached, solve)
        }
        result => result,
    }
}

impl HistoryArguments {
    /// Tells whether the contact sticks.
    pub fn is_stuck(&self) -> bool {
        self.friction == Friction::Stick
    }

    /// Refuses a second work of adhesion without stick, and a half-space with it, and returns the Poisson ratio of the sphere
    /// where the contact sticks.
    pub fn sticks(&self, half_space: bool) -> anyhow::Result<Option<f64>> {
        let sticks = self.is_stuck();
        anyhow::ensure!(
            !(sticks && half_space),
            "--friction stick is for films and stacks: on a half-space of Poisson ratio 0.5 friction \
             has no effect, and for other ones it is not solved; leave out --half-space or \
             --friction"
        );
        anyhow::ensure!(
            sticks || self.work_of_adhesion_receding.is_none(),
            "--work-of-adhesion-receding goes with --friction stick here; without friction give \
             --value work-of-adhesion-receding=.. to `tabulate simulate` and `tabulate fit`"
        );
        let nu2 = self.sphere_poisson_ratio.unwrap_or(USUAL_POISSON_RATIO);
        Ok(sticks.then_some(nu2))
    }

    /// Refuses a Poisson ratio of the sphere without friction, which nothing but a fit would use.
    pub fn needs_poisson_ratio(&self) -> anyhow::Result<()> {
        anyhow::ensure!(
            self.is_stuck() || self.sphere_poisson_ratio.is_none(),
            "--sphere-poisson-ratio has no effect without friction: the sphere is given by its reduced \
             modulus E2* = E2/(1 - nu2^2), --sphere-modulus; add --friction stick, or leave it out"
        );
        Ok(())
    }

    /// Returns the work of adhesion with which the contact recedes, and the ratio to it of
    /// `advancing`, with which it has grown.
    pub fn works(&self, advancing: f64) -> anyhow::Result<(f64, f64)> {
        let receding = self.work_of_adhesion_receding.unwrap_or(advancing);
        anyhow::ensure!(
            receding >= advancing && receding < f64::INFINITY,
            "--work-of-adhesion-receding {receding:?} J/m^2 is less than --work-of-adhesion \
             {advancing:?} J/m^2, with which the contact grows: a line that recedes at a smaller energy \
             than it advances with is not solved; exchange the two"
        );
        let ratio = if receding == 0.0 {
            1.0
        } else {
            advancing / receding
        };
        Ok((receding, ratio))
    }

    /// Makes the contact that recedes, of `bodies` that stick, over the contact radii (m) `radii`,
    /// and returns it with the work of adhesion of its states. Without a `tolerance` it is 1e-8, or what
    /// rounding allows up to 1e-6.
    pub fn contact(
        &self,
        bodies: &Bodies,
        nu2: f64,
        [from, to]: [f64; 2],
        tolerance: Option<f64>,
    ) -> anyhow::Result<(Contact, f64)> {
        /// The relative tolerance where none is given.
        const TOLERANCE: f64 = 1e-8;
        let system = &bodies.system;
        let (receding, ratio) = self.works(bodies.work_of_adhesion)?;
        let reach = reach(bodies);
        let sticking = sticking(bodies, nu2)?;
        anyhow::ensure!(
            to <= reach * (1.0 + f64::EPSILON),
            "contact radius = {to:?} m: with --friction stick contacts are solved up to {MOST_OF_TIP} times the thickness of \
             the film or top layer; give --to {reach:?} or less"
        );
        let range = [from, to].map(|a| a / system.film_thickness);
        let curves = within(tolerance, tolerance.unwrap_or(TOLERANCE), |tolerance| {
            StickCurves::new(&sticking, range, tolerance)
        })?;
        let contact = Contact::new(system, curves.receding(ratio)?)?;
        Ok((contact, receding))
    }
}

impl ContactArguments {
    /// Returns the bodies, with the values of the paper where none are given, and the Poisson ratio of the sphere where the
    /// contact sticks. An error names the file, the body or the flag.
    pub fn read(&self) -> anyhow::Result<(Bodies, Option<f64>)> {
        let receding = self.history.work_of_adhesion_receding;
        let bodies = self.bodies.read_checked(receding)?;
        self.history.needs_poisson_ratio()?;
        let sticks = self.history.sticks(bodies.half_space)?;
        anyhow::ensure!(
            sticks.is_none() || self.table.is_none() && self.interaction_range.is_none(),
            "--friction stick is solved directly, and without a range of the attraction: leave out the \
             table and --interaction-range"
        );
        Ok((bodies, sticks))
    }
}

pub fn sticking(bodies: &Bodies, nu2: f64) -> anyhow::Result<Sticking> {
    anyhow::ensure!(
        bodies.system.probe.is_paraboloid(),
        "--friction stick takes --probe paraboloid only; `tabulate solve --friction stick` answers for \
         a flat punch (eeq_s, gamma_eff)"
    );
    with_any_probe(bodies, nu2)
}

/// Returns the bodies that stick, as flat punches of any radius have them.
fn with_any_probe(bodies: &Bodies, nu2: f64) -> anyhow::Result<Sticking> {
    Ok(match &bodies.stack {
        Some(layers) => Sticking::on_stack(layers.stack(), bodies.system.sphere_modulus, nu2)?,
        None => Sticking::on_film(&bodies.system.material()?, nu2)?,
    })
}

/// Notes on standard error by how much full friction would stiffen a contact of `bodies` without
/// friction, of radius `a` (m), where that is much. It says nothing where the punch is not solved, and recommends a
/// contact with friction where the command `solves` one.
pub fn note_size(bodies: &Bodies, a: f64, solves: bool) {
    /// The part of the stiffness that is worth a note. Half of it, the part of the load under a narrow
    /// sphere, is as much as a paraboloid in place of a wide sphere changes.
    const MUCH: f64 = 0.05;
    const TOLERANCE: f64 = 1e-4;
    let found = with_any_probe(bodies, USUAL_POISSON_RATIO).and_then(|sticking| {
        // Of a wider contact than is solved, the widest that is.
        let a_over_t = (a / bodies.system.film_thickness).min(sticking.most_of_punch());
        let ratio = sticking.stiffening(a_over_t, TOLERANCE)?;
        let is_solved = sticking.beta() == 0.0 && bodies.system.probe.is_paraboloid();
        Ok((a_over_t * bodies.system.film_thickness, ratio, is_solved))
    });
    if let Ok((a, ratio, is_solved)) = found
        && ratio > 1.0 + MUCH
    {
        let recommended = if solves && is_solved && a <= reach(bodies) {
            " --friction stick solves contacts with full friction, without a table and without --interaction-range."
        } else {
            ""
        };
        note(&format!(
            "The model takes the surfaces to slide freely. With full friction, a flat punch of the contact \
             radius {a:.3e} m would be stiffer by {:.0} %.{recommended}",
            1e2 * (ratio - 1.0)
        ));
    }
}

/// Returns the largest contact radius (m) up to which a contact of `bodies` that sticks is solved.
pub fn reach(bodies: &Bodies) -> f64 {
    MOST_OF_TIP * bodies.top_thickness()
}
