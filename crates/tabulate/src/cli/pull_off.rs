//! `tabulate pull-off`

use anyhow::{Context as _, anyhow, bail, ensure};
use clap::ValueEnum;
use contact::magnitude::Magnitude;
use contact::{Contact, Control, Error, State, work_of_adhesion_at_pull_off};
use interp::Error::{BeyondProbe, BeyondSphere, OutsideTable};
use interp::Table;

use super::allow;
use super::bodies::Bodies;
use super::friction::{self, ContactArguments};
use super::points::number;
use super::print;
use super::quantity::{force, force_per_length};
use super::system::Value;
use super::table_name::TableName;
use solve::A_OVER_T;
use solve::cohesive::CohesiveState;
use solve::stack::MOST_A_OVER_TOP;

/// Print the last stable state of a separation: load (N), contact radius (m), outer radius of the
/// attraction (m) and penetration (m)
///
/// Without --interaction-range the attraction has no range (JKR), and the outer radius is the
/// contact radius. With it, a constant stress attracts the sphere wherever the gap is below the
/// range (Dugdale's law), from DMT to JKR. Under a long range and an imposed displacement the last
/// stable state may have no contact: its contact radius is 0.
///
/// With --load, a measured pull-off load, the work of adhesion is found: that with which the last stable state has
/// this load. All other values are then needed, or --specimen paper. The largest tension of a measured curve is the load
/// of --control load, whatever the machine imposes. Three or more loads at measured contact radii or penetrations tell
/// more (`tabulate fit`).
///
/// The surfaces slide freely. Where full friction would stiffen the contact by more than 5 %, a note on
/// standard error says so. With --friction stick, surfaces that have touched never slide. The contact has grown from radius 0
/// with --work-of-adhesion, and recedes with --work-of-adhesion-receding, or with the same.
///
/// Values of the bodies that are not given are those of the paper, and a comment line on standard
/// error names them, as in `tabulate curve`.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate pull-off embedded --specimen paper",
    "tabulate pull-off --specimen paper --sphere-radius 10um --load -2uN",
    "tabulate pull-off --specimen paper --half-space --sphere-radius 10um",
    "tabulate pull-off --specimen paper --sphere-radius 10um --interaction-range 5nm --json",
    "tabulate pull-off --specimen paper --control spring --stiffness 40N/m --film-thickness 10um",
    "tabulate pull-off --specimen paper --stack tables/stacks/primer.toml --sphere-radius 100um",
    "tabulate pull-off --specimen paper --sphere-modulus inf --film-thickness 50um --friction stick",
))]
pub struct Arguments {
    #[command(flatten)]
    contact: ContactArguments,
    /// What the machine imposes: a dead weight, the displacement, or the far end of a spring
    #[arg(long, value_enum, default_value = "load")]
    control: ControlName,
    /// Stiffness of the spring, N/m, of --control spring
    #[arg(long, required_if_eq("control", "spring"), value_parser = force_per_length)]
    stiffness: Option<f64>,
    /// Measured pull-off load, N, below 0: find the work of adhesion
    #[arg(
        long,
        value_name = "N",
        value_parser = force,
        conflicts_with_all = ["work_of_adhesion", "work_of_adhesion_receding"]
    )]
    load: Option<f64>,
    /// Print one JSON object with load, contact_radius, outer_radius and penetration, and with --load with
    /// work_of_adhesion
    #[arg(long)]
    json: bool,
}

/// The names of [`Control`].
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ControlName {
    Load,
    Displacement,
    Spring,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let control = match (arguments.control, arguments.stiffness) {
        (ControlName::Load, _) => Control::Load,
        (ControlName::Displacement, _) => Control::Displacement,
        (ControlName::Spring, stiffness) => Control::Spring {
            stiffness: stiffness.expect("clap requires it"),
        },
    };
    ensure!(
        arguments.stiffness.is_none() || matches!(control, Control::Spring { .. }),
        "--stiffness is that of a spring: add --control spring, or leave it out"
    );
    let given = &arguments.contact;
    let (bodies, sticks) = given.read()?;
    let table = given.table.as_ref();
    let table = table.map(TableName::read_for_contacts).transpose()?;
    let table = table.as_deref();
    let found = |load: f64| {
        if load > 0.0 {
            bail!(
                "--load {load:?}: a pull-off load is below 0, because the probe is pulled; give --load=-{load:?}"
            );
        }
        ensure!(
            load < 0.0 && load.is_finite(),
            "--load {load:?}: a measured pull-off load is a number below 0; without one leave out --load"
        );
        let system = &given.bodies.system;
        let mut missing = given.bodies.missing();
        missing.retain(|value| *value != Value::WorkOfAdhesion);
        let flags: Vec<String> = missing.into_iter().map(Value::flag).collect();
        ensure!(
            flags.is_empty() || system.specimen.is_some(),
            "--load is measured, and what was measured on is missing: give {}; --specimen paper takes what is not given from \
             the paper's example",
            flags.join(", ")
        );
        let at = |work_of_adhesion| {
            let bodies = Bodies {
                work_of_adhesion,
                ..bodies.clone()
            };
            Ok::<_, anyhow::Error>(pull_off(arguments, table, &bodies, control)?.1.load)
        };
        work_of_adhesion_at_pull_off(load, bodies.system.probe.radius(), at)
            .with_context(|| format!("--load {load:?} N"))
    };
    let work = arguments.load.map(found).transpose()?;
    let bodies = Bodies {
        work_of_adhesion: work.unwrap_or(bodies.work_of_adhesion),
        ..bodies.clone()
    };
    let receding = given.history.work_of_adhesion_receding;
    given.bodies.check(&bodies, receding)?;
    let stiffness = arguments.stiffness.and_then(Magnitude::stiffness);
    allow::magnitudes(stiffness.as_slice(), &given.bodies.allow)?;
    let (contact, state) = pull_off(arguments, table, &bodies, control)?;
    let of_state = [
        ("load", state.load),
        ("contact_radius", state.contact_radius),
        ("outer_radius", state.outer_radius),
        ("penetration", state.penetration),
    ];
    let values = work.map(|work| ("work_of_adhesion", work)).into_iter();
    let values = values.chain(of_state);
    let text = if arguments.json {
        format!("{}\n", values.collect::<serde_json::Value>())
    } else {
        values
            .map(|(name, value)| format!("{name:14} = {}\n", number(value)))
            .collect()
    };
    if work.is_none() {
        given.bodies.name_example(&[]);
    }
    bodies.note_large_contact(state.contact_radius);
    if state.contact_radius > 0.0 {
        bodies.note_validity(contact.as_ref(), state.contact_radius);
        if sticks.is_none() {
            friction::note_size(&bodies, state.contact_radius, true);
        }
    }
    print(text.as_bytes())
}

/// Finds the pull-off of bodies, with their contact where the attraction has no range.
fn pull_off(
    arguments: &Arguments,
    table: Option<&Table>,
    bodies: &Bodies,
    control: Control,
) -> anyhow::Result<(Option<Contact>, CohesiveState)> {
    if let Some(range) = arguments.contact.interaction_range {
        return Ok((None, bodies.cohesive(range)?.pull_off(control)?));
    }
    let (contact, state) = match arguments.contact.history.sticks(bodies.half_space)? {
        Some(nu2) => sticking(arguments, bodies, nu2, control)?,
        None => jkr(table, bodies, control)?,
    };
    let state = CohesiveState {
        contact_radius: state.contact_radius,
        outer_radius: state.contact_radius,
        load: state.load,
        penetration: state.penetration,
    };
    Ok((Some(contact), state))
}

type PullOff = (Contact, State);

/// Finds the pull-off of an attraction without range.
fn jkr(table: Option<&Table>, bodies: &Bodies, control: Control) -> anyhow::Result<PullOff> {
    let Some(table) = table else {
        return solved(bodies, control);
    };
    let contact = Contact::in_table(table, &bodies.system)?;
    match contact.pull_off(bodies.work_of_adhesion, control) {
        Err(
            error @ Error::OutsideRadii {
                at_end_of_probe: false,
                ..
            },
        ) => Err(anyhow!(
            "{error}; without a table `tabulate pull-off` solves more contacts"
        )),
        state => Ok((contact, state?)),
    }
}

/// Finds the pull-off of a contact that sticks, up to the widest contact that is solved.
fn sticking(
    arguments: &Arguments,
    bodies: &Bodies,
    nu2: f64,
    control: Control,
) -> anyhow::Result<PullOff> {
    /// The narrowest contact over the widest.
    const NARROWEST: f64 = 3e-5;
    let widest = friction::reach(bodies);
    // A narrow range takes much less time than a wide one.
    for share in [0.1, 1.0] {
        let radii = [NARROWEST * widest, share * widest];
        let (contact, receding) = arguments
            .contact
            .history
            .contact(bodies, nu2, radii, None)?;
        match contact.pull_off(receding, control) {
            Err(Error::OutsideRadii { .. }) => {}
            state => return Ok((contact, state?)),
        }
    }
    Err(anyhow!(
        "the pull-off has a contact radius that is not solved with --friction stick: on this film or stack radii \
         from {:.3e} m to {widest:.3e} m are; without --friction stick others are solved",
        NARROWEST * widest
    ))
}

/// Finds the pull-off of an attraction without range by direct solves, in a range of contact radii
/// that grows until the pull-off is inside.
fn solved(bodies: &Bodies, control: Control) -> anyhow::Result<PullOff> {
    /// The ranges of `a/t` that are solved, one after the other, and the contact radius over the thickness of
    /// the top layer up to which a stack is. Wider contacts take much longer.
    const RANGES: [([f64; 2], f64); 3] = [
        ([1e-3, 1e3], 300.0),
        ([A_OVER_T[0], 1e3], 300.0),
        (A_OVER_T, MOST_A_OVER_TOP),
    ];
    /// The relative tolerance, and that where rounding does not let a solve reach it: on confined incompressible films.
    const TOLERANCE: f64 = 1e-9;
    const OF_CONFINED: f64 = 1e-7;
    /// The smallest radius that is solved, over that of the sphere, from which on a pull-off may be
    /// smaller.
    const THICK: f64 = 1e-2;
    let system = &bodies.system;
    if bodies.half_space {
        let contact = bodies.contact(system, A_OVER_T, TOLERANCE)?;
        let state = contact.pull_off(bodies.work_of_adhesion, control)?;
        return Ok((contact, state));
    }
    let mut refused = None;
    for ([from, to], over_top) in RANGES {
        let range = match &bodies.stack {
            Some(layers) => {
                let reach = layers.stack().reach(over_top);
                [from.min(1e-3 * reach).max(A_OVER_T[0]), to.min(reach)]
            }
            None => [from, to],
        };
        let contact = match bodies.contact(system, range, TOLERANCE) {
            Err(crate::Error::Solve(solve::Error::NotConverged { .. })) => {
                bodies.contact(system, range, OF_CONFINED)
            }
            contact => contact,
        };
        let found = match (contact, refused) {
            (
                Err(crate::Error::Contact(
                    error @ Error::Table(OutsideTable { .. } | BeyondProbe { .. }),
                )),
                _,
            ) => Err(error),
            // A wider range may be out of reach where a narrower one is not.
            (Err(_), Some(refused)) => return Err(refused),
            (contact, _) => {
                let contact = contact?;
                let state = contact.pull_off(bodies.work_of_adhesion, control);
                state.map(|state| (contact, state))
            }
        };
        let least = from * system.film_thickness;
        refused = match found {
            Err(
                Error::OutsideRadii { .. } | Error::Table(BeyondProbe { .. } | BeyondSphere { .. }),
            ) if least > THICK * system.probe.radius().unwrap_or(f64::INFINITY) => Some(anyhow!(
                "the film is so thick beside the sphere that the pull-off has a contact radius below {least:e} m, the smallest that is \
                 solved; a film of up to {:e} times the radius of the sphere is solved, and a thicker one has the same pull-off to three \
                 digits",
                THICK / from
            )),
            Err(Error::OutsideRadii {
                from,
                to,
                at_end_of_probe: false,
                ..
            }) => Some(anyhow!(
                "the pull-off has a contact radius outside {from:.3e} m to {to:.3e} m, which are solved on this film or \
                 stack; with a smaller sphere or a smaller work of adhesion it is smaller"
            )),
            Err(error @ Error::OutsideRadii { .. }) => Some(error.into()),
            // A probe with a flat end has no smaller contact than this end.
            Err(Error::Table(OutsideTable {
                value, from, to, ..
            })) => Some(anyhow!(
                "the contact radius = {:.3e} m of the flat end is outside {:.3e} m to {:.3e} m, which are solved on this \
                 film or stack; give another radius, or leave out a top layer that is too thin to matter",
                value * system.film_thickness,
                from * system.film_thickness,
                to * system.film_thickness
            )),
            found => return Ok(found?),
        };
    }
    Err(refused.expect("there are ranges"))
}
