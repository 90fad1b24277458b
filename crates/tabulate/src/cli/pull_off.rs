//! `tabulate pull-off`

use clap::{ValueEnum, ValueHint};
use interp::{Contact, Control};

use super::bodies::{AttractingArguments, Bodies};
use super::points::number;
use super::print;
use super::quantity::force_per_length;
use super::table_name::{self, TableName};
use crate::cohesive::CohesiveState;
use crate::solve::curve;

/// Print the last stable state of a separation: load (N), contact radius (m), outer radius of the
/// attraction (m) and penetration (m)
///
/// Without --interaction-range the attraction has no range (JKR), and the outer radius is the
/// contact radius. With it, a constant stress attracts the sphere wherever the gap is below the
/// range (Dugdale's law), from DMT to JKR. Under a long range and an imposed displacement the last
/// stable state may have no contact: its contact radius is 0.
///
/// Values of the bodies that are not given are those of the paper, and a comment line on standard
/// error names them, as in `tabulate curve`.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate pull-off embedded --specimen paper",
    "tabulate pull-off --specimen paper --sphere-radius 10um --interaction-range 5nm --json",
    "tabulate pull-off --specimen paper --control spring --stiffness 40N/m --film-thickness 10um",
    "tabulate pull-off --specimen paper --stack tables/stacks/primer.toml --sphere-radius 100um",
))]
pub struct Arguments {
    #[arg(
        help = format!("{}. Without a table, the system is solved directly", table_name::HELP),
        value_hint = ValueHint::FilePath
    )]
    table: Option<TableName>,
    #[command(flatten)]
    attracting: AttractingArguments,
    /// What the machine imposes: a dead weight, the displacement, or the far end of a spring
    #[arg(long, value_enum, default_value = "load")]
    control: ControlName,
    /// Stiffness of the spring, N/m
    #[arg(
        long,
        required_if_eq("control", "spring"),
        value_parser = force_per_length,
        allow_hyphen_values = true
    )]
    stiffness: Option<f64>,
    /// Print one JSON object with load, contact_radius, outer_radius and penetration
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
    let attracting = &arguments.attracting;
    let bodies = attracting.bodies.read_checked()?;
    let state = match attracting.interaction_range {
        Some(range) => bodies.cohesive(range)?.pull_off(control)?,
        None => jkr(arguments, &bodies, control)?,
    };
    let values = [
        ("load", state.load),
        ("contact_radius", state.contact_radius),
        ("outer_radius", state.outer_radius),
        ("penetration", state.penetration),
    ];
    let text = if arguments.json {
        let object: serde_json::Map<String, serde_json::Value> = values
            .into_iter()
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect();
        format!("{}\n", serde_json::Value::Object(object))
    } else {
        values
            .into_iter()
            .map(|(name, value)| format!("{name:14} = {}\n", number(value)))
            .collect()
    };
    attracting.bodies.name_example();
    print(text.as_bytes())
}

/// Finds the pull-off of an attraction without range.
fn jkr(arguments: &Arguments, bodies: &Bodies, control: Control) -> anyhow::Result<CohesiveState> {
    /// The range of `a/t` that is solved, and the relative tolerance.
    const RANGE: [f64; 2] = [1e-3, 1e3];
    const TOLERANCE: f64 = 1e-9;
    /// The contact radius over the thickness of the top layer up to which a stack is solved. Wider
    /// contacts take much longer.
    const OVER_TOP: f64 = 300.0;
    let system = &bodies.system;
    let contact = match (&arguments.table, &bodies.stack) {
        (Some(name), _) => name.read()?.contact(system)?,
        (None, Some(layers)) => {
            let stack = layers.stack();
            let top = stack.top().thickness / stack.thickness();
            let range = [RANGE[0], RANGE[1].min(OVER_TOP * top)];
            Contact::new(
                system,
                layers.curve(system.sphere_modulus, range, TOLERANCE)?,
            )?
        }
        (None, None) => Contact::new(system, curve(&system.material()?, RANGE, TOLERANCE)?)?,
    };
    let state = contact.pull_off(bodies.work_of_adhesion, control)?;
    Ok(CohesiveState {
        contact_radius: state.contact_radius,
        outer_radius: state.contact_radius,
        load: state.load,
        penetration: state.penetration,
    })
}
