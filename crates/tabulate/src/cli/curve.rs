//! `tabulate curve`

use std::path::PathBuf;

use anyhow::ensure;
use clap::value_parser;
use contact::{Contact, JkrPoint, Validity};
use interp::{Mechanics, Probe, System};

use super::bodies::{BEYOND, Bodies, note_no_disc};
use super::friction::{self, ContactArguments};
use super::output::Output;
use super::points::{evenly, number};
use super::progress::progress_bar;
use super::quantity::{self, length};
use super::table_name::TableName;
use solve::cohesive::Cohesive;
use solve::parallel::try_map;
use solve::{A_OVER_T, CURVE_TOLERANCE, solve};

/// Print the force curve of one system as CSV, in SI units
///
/// Each row is an equilibrium at one contact radius: contact_radius (m), load (N, positive in
/// compression), penetration (m), and the coordinates of the reduced JKR plot, jkr_abscissa =
/// a^(3/2) / (sqrt(pi) R) and jkr_ordinate = F / (sqrt(6 pi) a^(3/2)). At a small radius or a
/// negative load an equilibrium may be unstable. Under a probe without a radius of curvature
/// jkr_abscissa is NaN; a flat punch has one row.
///
/// Two columns are slopes dF/d delta (N/m): contact_stiffness where the contact line stays, which a
/// small fast oscillation measures, and moving_stiffness where it moves in equilibrium, which the
/// force curve itself has. Without adhesion they are equal; under a flat punch, whose line cannot
/// move, the second is NaN. With --friction stick the first is that of a flat punch that sticks. Where a table does not hold eeq and gamma, a slope that needs them is NaN.
///
/// With --interaction-range the attraction is not that of JKR, and in place of the two slopes there
/// is a column outer_radius (m): the radius within which it acts.
///
/// The surfaces slide freely. Where full friction would stiffen the largest contact by more than 5 %, a
/// note on standard error says so. With --friction stick, surfaces that have touched never slide. The rows are those of a contact that
/// has grown from radius 0 with --work-of-adhesion. With --work-of-adhesion-receding they are those of
/// the same contact while it recedes. Spheres are solved where Dundurs' beta of sphere and film is 0.
///
/// Values that are not given are those of Barthel's Tables 1 and 2, an elastomer sphere of 1 mm on an
/// elastomer film of 1 um on silicon, and a comment line on standard error names them. --specimen
/// paper says that these values are wanted: then there is no such line.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate curve --specimen paper",
    "tabulate curve --specimen paper --film-thickness 10um --points 20 | cut -d, -f1-3",
    "tabulate curve --specimen paper --sphere-modulus inf --film-poisson-ratio 0.4 --to 10um",
    "tabulate curve embedded --specimen paper --work-of-adhesion 100mJ/m^2 -o curve.csv",
    "tabulate curve --specimen paper --stack tables/stacks/primer.toml --from 10um --to 90um --points 9",
    "tabulate curve --specimen paper --sphere-modulus inf --film-thickness 200um --friction stick",
    "tabulate curve --specimen paper --probe rounded-cone --half-angle 70 --sphere-radius 1um --to 5um",
))]
pub struct Arguments {
    #[command(flatten)]
    contact: ContactArguments,
    /// Smallest contact radius, m [default: 1e-6; where --to is not given, or is at most 1e-6, 1/150 of the largest]
    #[arg(long, value_parser = length)]
    from: Option<f64>,
    /// Largest contact radius, m. It must be below the sphere's radius R. The model takes it to be
    /// small beside R: above 0.3 R there is a warning [default: the smallest of 1.5e-4, 0.3 R and, with
    /// --friction stick, 30 times the thickness of the film or top layer, with --interaction-range 108 times,
    /// with --stack or --interface 1000 times]
    #[arg(long, value_parser = length)]
    to: Option<f64>,
    /// Number of contact radii, equally spaced
    #[arg(long, default_value_t = 150, value_parser = value_parser!(u32).range(2..=super::points::MOST_POINTS))]
    points: u32,
    /// Relative tolerance of direct solves, 1e-12 to 1e-2, with --friction stick from 1e-10 [default: 1e-8]
    #[arg(long, conflicts_with_all = ["table", "interaction_range", "half_space"], value_parser = quantity::number)]
    tolerance: Option<f64>,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = &arguments.contact;
    let table = given.table.as_ref().and_then(TableName::path);
    let [stack, profile] = given.bodies.files();
    let output = Output::of_text(arguments.output.as_deref(), &[table, stack, profile])?;
    let (bodies, sticks) = given.read()?;
    let system = &bodies.system;
    let mechanics = Mechanics::new(system)?;
    let punch = system.probe.is_flat_punch();
    ensure!(
        !punch || arguments.from.is_none() && arguments.to.is_none(),
        "--probe flat-punch has one contact radius, --sphere-radius: leave out --from and --to"
    );
    let [from, to] = if punch {
        // The only contact radius of a punch.
        [bodies.sphere_radius; 2]
    } else {
        arguments.radii(&bodies)
    };
    ensure!(
        to > 0.0 && to < f64::INFINITY,
        "--to {to:?} m: the largest contact radius is above 0 and finite"
    );
    let (smallest, least) = (
        arguments.from.unwrap_or(to),
        arguments.least_solved(&bodies),
    );
    ensure!(
        !(smallest > 0.0 && smallest < least),
        "contact radius {smallest:?} m: direct solves begin at a millionth of the thickness of the film or stack, {least:e} m; \
         ask for larger radii, or take so thick a film or top layer as a half-space, --half-space"
    );
    let [from_default, to_default] = [arguments.from, arguments.to].map(|given| match given {
        Some(_) => "",
        None => ", which is not given,",
    });
    ensure!(
        punch || from > 0.0 && to > from && to < f64::INFINITY,
        "contact radii run from above 0 to more than that: --from{from_default} is {from:?} m, and \
         --to{to_default} is {to:?} m"
    );
    if !punch {
        // Refuses too large a radius before any work.
        mechanics.edge_singularity(to, bodies.work_of_adhesion)?;
    }
    let states = States::new(arguments, (&bodies, sticks), [from, to])?;
    let rows: Vec<Vec<f64>> = if punch {
        vec![states.row(to, &mechanics)?]
    } else {
        let bar = progress_bar(arguments.points as usize, "solving");
        let row = |i: u32| {
            let row = states.row(evenly([from, to], i, arguments.points), &mechanics)?;
            bar.inc(1);
            anyhow::Ok(row)
        };
        try_map(0..arguments.points, row)?
    };
    given.bodies.name_example(&[]);
    bodies.note_large_contact(to);
    let contact = match &states.source {
        Source::Curve(contact) => Some(&**contact),
        Source::Solves(slopes) => slopes.as_deref(),
        Source::Range(_) => None,
    };
    bodies.note_validity(contact, to);
    if let Some(contact) = contact {
        note_no_disc(contact, [from, to], states.work_of_adhesion);
    }
    if sticks.is_none() {
        friction::note_size(&bodies, to, true);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let columns = [
        "contact_radius",
        "load",
        "penetration",
        "jkr_abscissa",
        "jkr_ordinate",
    ];
    let further: &[&str] = match states.source {
        Source::Range(_) => &["outer_radius"],
        _ => &["contact_stiffness", "moving_stiffness"],
    };
    writer.write_record(columns.iter().chain(further))?;
    for row in rows {
        writer.write_record(row.into_iter().map(number))?;
    }
    output.write(&writer.into_inner()?)
}

impl Arguments {
    /// Returns the smallest and the largest contact radius (m): those asked for, or those of the
    /// paper's lens, reduced for a smaller sphere or profile and to those that are solved with stick, with an attraction
    /// of finite range, or on layers, and not below a flat end.
    fn radii(&self, bodies: &Bodies) -> [f64; 2] {
        const USUAL: [f64; 2] = [1e-6, 1.5e-4];
        /// The part of a profile beyond which it says little of its shape.
        const OF_PROFILE: f64 = 0.9;
        /// The largest contact radius over that of a flat end, at least.
        const BEYOND_END: f64 = 3.0;
        let least = match &bodies.system.probe {
            Probe::FlatPunch { .. } => 0.0,
            other => other.contact_radii()[0],
        };
        let most = match &bodies.system.probe {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => {
                Validity::WARNING_A_OVER_R * radius
            }
            Probe::Profile(profile) => {
                profile.end() * OF_PROFILE.max(0.5 * (1.0 + profile.flat_end() / profile.end()))
            }
            _ => f64::INFINITY,
        };
        let most = if self.contact.history.is_stuck() {
            most.min(friction::reach(bodies))
        } else if let Some(range) = self.contact.interaction_range {
            most.min(bodies.reach_of_attraction(range))
        } else {
            most.min(bodies.reach_of_layers())
        };
        let to = self
            .to
            .unwrap_or(USUAL[1].max(BEYOND_END * least).min(most));
        let scale = if self.to.is_none() || to <= USUAL[0] {
            to / USUAL[1]
        } else {
            1.0
        };
        let least = if least < to { least } else { 0.0 };
        let least = least.max(self.least_solved(bodies));
        [self.from.unwrap_or((USUAL[0] * scale).max(least)), to]
    }

    /// Returns the smallest contact radius that direct solves reach (m), or 0 where none are made.
    fn least_solved(&self, bodies: &Bodies) -> f64 {
        if self.contact.table.is_some() || bodies.half_space {
            0.0
        } else {
            A_OVER_T[0] * bodies.system.film_thickness
        }
    }
}

/// What answers for the state at a contact radius.
enum Source {
    /// A solve for each radius; with adhesion a curve tells the slopes of the quantities.
    Solves(Option<Box<Contact>>),
    /// A curve, from a table or from solves of one material.
    Curve(Box<Contact>),
    /// Solves with an attraction of finite range.
    Range(Box<Cohesive>),
}

/// The states of one system.
struct States<'a> {
    source: Source,
    system: &'a System,
    work_of_adhesion: f64,
    tolerance: f64,
}

impl<'a> States<'a> {
    fn new(
        arguments: &Arguments,
        (bodies, sticks): (&'a Bodies, Option<f64>),
        [from, to]: [f64; 2],
    ) -> anyhow::Result<Self> {
        /// The relative tolerance of solves where none is given.
        const TOLERANCE: f64 = 1e-8;
        /// The smallest one of a curve of which the slopes are wanted, which lose digits to it.
        const LEAST_OF_SLOPES: f64 = 1e-10;
        /// The largest contact radius, over the thickness of the film or top layer, from which on a shape is integrated
        /// over the curve.
        const BEGIN: f64 = 1e-3;
        let given = &arguments.contact;
        let tolerance = arguments.tolerance.unwrap_or(TOLERANCE);
        let system = &bodies.system;
        let over_thickness = |a: f64| a / system.film_thickness;
        let solved = |range, tolerance| bodies.contact(system, range, tolerance).map(Box::new);
        let integrated = |top: f64| {
            let [from, to] = [from, BEYOND * to].map(over_thickness);
            let begin = from.min(BEGIN * top).max(A_OVER_T[0]);
            [begin, to.max(10.0 * begin)]
        };
        let mut work_of_adhesion = bodies.work_of_adhesion;
        let source = if let Some(nu2) = sticks {
            let history = &given.history;
            let (contact, receding) =
                history.contact(bodies, nu2, [from, to], arguments.tolerance)?;
            work_of_adhesion = receding;
            Source::Curve(Box::new(contact))
        } else if let Some(range) = given.interaction_range {
            Source::Range(Box::new(bodies.cohesive(range)?))
        } else if bodies.half_space {
            Source::Curve(solved([from, to], tolerance)?)
        } else if let Some(name) = &given.table {
            Source::Curve(Box::new(Contact::in_table(
                name.read_for_contacts()?.as_ref(),
                system,
            )?))
        } else if let Some(layers) = &bodies.stack {
            ensure!(
                arguments.tolerance.is_none() || layers.table.is_none(),
                "--tolerance is of direct solves, and --stack names a table, which is looked up: \
                 leave out --tolerance, or name a stack file"
            );
            let reach = bodies.reach_of_layers();
            ensure!(
                to <= reach * (1.0 + f64::EPSILON),
                "contact radius = {to:?} m: contacts of this probe with these layers are solved up to {:.0} times the \
                 thickness of the top layer; give --to, or the radius of a punch, of {reach:?} or less, or leave out a top \
                 layer that is too thin to matter",
                reach / bodies.top_thickness()
            );
            let range = if bodies.is_integrated() {
                integrated(layers.stack().shape().top)
            } else {
                // The single radius of a punch is the end of a short curve.
                [from.min(0.9 * to), to].map(over_thickness)
            };
            Source::Curve(solved(range, tolerance)?)
        } else if system.probe.is_paraboloid() {
            // Single solves reach a smaller one.
            solve::Error::check("tolerance", tolerance, CURVE_TOLERANCE)?;
            let range = [from, to].map(over_thickness);
            let slopes = || solved(range, tolerance.max(LEAST_OF_SLOPES));
            let slopes = (bodies.work_of_adhesion > 0.0).then(slopes);
            Source::Solves(slopes.transpose()?)
        } else {
            Source::Curve(solved(integrated(1.0), tolerance)?)
        };
        Ok(Self {
            source,
            system,
            work_of_adhesion,
            tolerance,
        })
    }

    /// Computes the row of a contact radius.
    fn row(&self, a: f64, mechanics: &Mechanics) -> anyhow::Result<Vec<f64>> {
        let w = self.work_of_adhesion;
        let (load, penetration, further) = match &self.source {
            Source::Range(cohesive) => {
                let state = cohesive.state(a)?;
                (state.load, state.penetration, vec![state.outer_radius])
            }
            Source::Curve(contact) => {
                let (load, penetration) = contact.load_and_penetration(a, w)?;
                let moving = match self.system.probe {
                    Probe::FlatPunch { .. } => f64::NAN,
                    _ => where_held(contact.moving_stiffness(a, w))?,
                };
                let pinned = where_held(contact.stiffness(a))?;
                (load, penetration, vec![pinned, moving])
            }
            Source::Solves(slopes) => {
                let edge = mechanics.edge_singularity(a, w)?;
                let material = self.system.material()?;
                let solution = solve(a / self.system.film_thickness, &material, self.tolerance)?;
                let (load, penetration) =
                    mechanics.load_and_penetration(a, edge, &solution.quantities);
                let pinned = mechanics.stiffness(a, solution.quantities.eeq);
                let moving = match slopes {
                    Some(contact) => contact.moving_stiffness(a, w)?,
                    None => pinned,
                };
                (load, penetration, vec![pinned, moving])
            }
        };
        let jkr = JkrPoint::new(a, load, mechanics.sphere_radius());
        let row = [a, load, penetration, jkr.abscissa, jkr.ordinate];
        Ok(row.into_iter().chain(further).collect())
    }
}

/// Returns a stiffness; NaN where the table does not hold what it needs.
fn where_held(stiffness: Result<f64, contact::Error>) -> Result<f64, contact::Error> {
    use interp::Error::{BeginsTooLate, MissingQuantity};
    match stiffness {
        Err(contact::Error::Table(MissingQuantity(_) | BeginsTooLate { .. })) => Ok(f64::NAN),
        stiffness => stiffness,
    }
}
