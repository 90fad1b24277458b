//! `tabulate history`

use std::io::{self, Write};
use std::path::PathBuf;

use anyhow::{Context, anyhow, bail, ensure};
use clap::{ValueHint, value_parser};
use contact::{Contact, Control, Course, Hysteresis, Relaxation};
use interp::{Elastic, System};
use solve::stack::{Interface, Layer, Stack};

use super::program;
use super::program::{Imposed, Program};
use super::relaxation::RelaxationArguments;
use crate::cli::bodies::{Bodies, BodiesArguments, note_no_disc};
use crate::cli::friction;
use crate::cli::note;
use crate::cli::output::Output;
use crate::cli::points::{evenly, number};
use crate::cli::quantity::{self, force_per_length};
use crate::cli::system::Value;
use crate::cli::table_name::{self, TableName};

/// Print a contact in time as CSV where the film relaxes, in SI units: approach and retract, holds,
/// creep, any number of cycles
///
/// The columns are time (s), penetration (m), load (N), contact_radius (m) and phase: advancing,
/// resting, receding or separated. Load and radius are 0 while separated. --film-modulus is E_ref:
/// the instantaneous modulus, or under a power law the modulus at --reference-time.
///
/// The effect of the film thickness is exact at any time. Only a receding contact line has adhesion
/// (--work-of-adhesion-receding), after one approach. The surfaces slide freely. Where full friction
/// would stiffen the widest contact by more than 5 %, a note on standard error says so.
///
/// Sphere and substrate do not relax. Where they deform, too, the program estimates the
/// error that this causes, and refuses errors above 2 %. With --all-relax they relax like the film.
///
/// A gel also relaxes by flow of its solvent, and that is no law of the material: its time grows like
/// the square of the contact radius, or of the thickness of a thin film. Measure at two radii: a
/// material has the same relaxation times at both.
///
/// The errors of loads, radii and penetrations are within a --tolerance, each relative to the largest
/// one; the error of the elastic curve adds to it. Without one a comment line on standard error names
/// an estimated error above 1e-8; one above 0.5 ends the command.
///
/// Values that are not given are those of the paper, and a comment line on standard error names
/// them, as in `tabulate curve`; the work of adhesion is 0.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate history --specimen paper --all-relax --relaxation power-law -n 0.2 -p 'load 0:0 1:1uN'",
))]
pub struct Arguments {
    #[arg(
        help = format!("{}. Without a table, the elastic curve is solved directly", table_name::HELP),
        value_hint = ValueHint::FilePath
    )]
    table: Option<TableName>,
    #[command(flatten)]
    bodies: BodiesArguments,
    #[command(flatten)]
    relaxation: RelaxationArguments,
    /// What is imposed: `penetration`, `load` or `height` and points time:value, joined by straight
    /// lines, for example "penetration 0:0 1:1um 2:0"; or a CSV file with the columns time and one of
    /// these, in SI units or with units in cells or headings, time [ms]. The height is minus that of `fit`: the distance by which the base
    /// of the cantilever has moved towards the sample since the first touch, penetration + load/stiffness
    #[arg(short, long, value_name = "TEXT|FILE")]
    program: String,
    /// Stiffness of the cantilever, N/m, for a program of heights
    #[arg(long, value_parser = force_per_length)]
    stiffness: Option<f64>,
    /// Number of times, equally spaced over the program
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u32).range(2..=crate::cli::points::MOST_POINTS))]
    points: u32,
    /// Times to print, s, separated by commas. The last value of the program is held as long as a time
    /// is asked for
    #[arg(long, value_name = "S,...", value_delimiter = ',', conflicts_with = "points", value_parser = quantity::time)]
    at: Vec<f64>,
    /// Work of adhesion of a receding line, J/m^2. The line advances without adhesion
    #[arg(long, value_name = "J/M2", value_parser = force_per_length)]
    work_of_adhesion_receding: Option<f64>,
    /// Take sphere and substrate to relax like the film
    #[arg(long)]
    all_relax: bool,
    /// Tolerance of loads, radii and penetrations, relative to the largest of each [without one: as near to 1e-8 as
    /// possible; to 1e-5 where the contact grows again after a retract, under a load that falls, and for heights]
    #[arg(long, value_parser = quantity::number)]
    tolerance: Option<f64>,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

/// The estimated error above which it is told where no tolerance is given.
const TOLD: f64 = 1e-8;
/// The error by bodies that do not relax above which there is a warning.
const UNLIKE: f64 = 1e-3;
/// The stiffness of a relaxing film over that of a relaxing substrate above which there is a
/// warning.
const STIFF_FILM: f64 = 3.0;

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = &arguments.bodies;
    let table = arguments.table.as_ref().and_then(TableName::path);
    let [stack, profile] = given.files();
    let program_file = program::file(&arguments.program);
    let output = Output::of_text(
        arguments.output.as_deref(),
        &[table, stack, profile, program_file],
    )?;
    let law = arguments.relaxation.law()?;
    let program = Program::parse(&arguments.program)?;
    let control = arguments.control(program.imposed)?;
    if let Some(work) = given
        .system
        .given(Value::WorkOfAdhesion)
        .filter(|&work| work != 0.0)
    {
        bail!(
            "--work-of-adhesion {work:?}: how much a growing contact gains from adhesion while the film relaxes \
             depends on the process at the crack tip, for which no law is known here; give \
             --work-of-adhesion-receding, with which the line advances without adhesion and recedes with it"
        );
    }
    let mut bodies = given.read_checked(arguments.work_of_adhesion_receding)?;
    bodies.work_of_adhesion = 0.0;
    ensure!(
        !bodies.system.probe.is_flat_punch(),
        "--probe flat-punch: a history is that of a contact that grows and shrinks, and the contact of a punch does \
         not; choose another --probe"
    );
    let times = arguments.times(&program)?;
    let mut sorted = times.clone();
    sorted.sort_by(f64::total_cmp);
    let (contact, course) = arguments.course(&bodies, &law, control, &program, &sorted)?;
    given.name_example(&[Value::WorkOfAdhesion]);
    let radii = course.states.iter().map(|at| at.state.contact_radius);
    let widest = radii.fold(0.0, f64::max);
    bodies.note_large_contact(widest);
    bodies.note_validity(Some(&contact), widest);
    if widest > 0.0 {
        /// The part of the widest radius from which on contacts are tried.
        const FIRST: f64 = 1e-2;
        // The contact grows from the first touch, without adhesion.
        let [touch, _] = bodies.system.probe.contact_radii();
        note_no_disc(&contact, [touch.max(FIRST * widest), widest], 0.0);
        friction::note_size(&bodies, widest, false);
    }
    arguments.warn(&bodies, &course);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["time", "penetration", "load", "contact_radius", "phase"])?;
    for time in times {
        let at = &course.states[sorted.partition_point(|&earlier| earlier < time)];
        let state = at.state;
        let numbers = [at.time, state.penetration, state.load, state.contact_radius].map(number);
        writer.write_record(numbers.iter().map(String::as_str).chain([at.phase.name()]))?;
    }
    output.write(&writer.into_inner()?)
}

impl Arguments {
    fn control(&self, imposed: Imposed) -> anyhow::Result<Control> {
        Ok(match (imposed, self.stiffness) {
            (Imposed::Penetration, None) => Control::Displacement,
            (Imposed::Load, None) => Control::Load,
            (Imposed::Height, Some(stiffness)) => Control::Spring { stiffness },
            (Imposed::Height, None) => {
                bail!(
                    "a program of heights needs --stiffness, that of the cantilever, for example 0.1N/m"
                )
            }
            _ => bail!(
                "--stiffness is for a program of heights: leave it out, or write height in --program"
            ),
        })
    }

    fn times(&self, program: &Program) -> anyhow::Result<Vec<f64>> {
        if !self.at.is_empty() {
            return Ok(self.at.clone());
        }
        let (Some(first), Some(last)) = (program.points.first(), program.points.last()) else {
            bail!(
                "--program has no points: write time:value after what is imposed, for example penetration 0:0 1:1um 2:0"
            );
        };
        Ok((0..self.points)
            .map(|i| evenly([first.0, last.0], i, self.points))
            .collect())
    }

    /// Follows the program with the elastic curve of a table, or with direct solves in a range of
    /// contact radii that grows until it holds the largest contact. Returns the elastic contact, too.
    fn course(
        &self,
        bodies: &Bodies,
        law: &Relaxation,
        control: Control,
        program: &Program,
        times: &[f64],
    ) -> anyhow::Result<(Contact, Course)> {
        /// The largest `a/t` of the direct solves, one after the other.
        const REACHES: [f64; 8] = [0.01, 0.1, 1.0, 4.0, 16.0, 64.0, 256.0, 1024.0];
        let system = &bodies.system;
        // The contact of a flat end is wider from the first touch on.
        let [flat, _] = system.probe.contact_radii();
        let holds = |reach: &f64| reach * system.film_thickness > 2.0 * flat;
        let rigid = self.rigid(bodies)?;
        let follow = |contact: &Contact, rigid: Option<&Contact>| {
            let mut history = contact.history(law)?;
            if let Some(rigid) = rigid {
                history = history.beside(rigid);
            }
            if let Some(work) = self.work_of_adhesion_receding {
                history = history.receding(Hysteresis::new(0.0, work)?)?;
            }
            history.at(control, &program.points, times, self.tolerance)
        };
        if let Some(name) = &self.table {
            let contact = Contact::in_table(name.read_for_contacts()?.as_ref(), system)?;
            let rigid = rigid.map(|rigid| {
                Contact::in_table(name.read()?.as_ref(), &rigid).map_err(anyhow::Error::from)
            });
            let rigid = rigid.transpose().context("the same film between a rigid probe and a rigid substrate, which tells what the other bodies do")?;
            let course = follow(&contact, rigid.as_ref())?;
            return Ok((contact, course));
        }
        let mut refused = None;
        for reach in REACHES.into_iter().filter(holds) {
            let contact = solved(bodies, system, reach)?;
            let rigid = rigid
                .as_ref()
                .map(|rigid| solved(bodies, rigid, reach))
                .transpose()?;
            match follow(&contact, rigid.as_ref()) {
                Err(
                    error @ contact::Error::OutsideRadii {
                        at_end_of_probe: false,
                        ..
                    },
                ) => refused = Some(error),
                done => return Ok((contact, done?)),
            }
        }
        Err(refused.map_or_else(
            || {
                anyhow!(
                    "the flat end of the probe, {flat:?} m, is more than 512 times as wide as the film is thick, which is \
                     beyond direct solves: give a TABLE whose a_over_t goes beyond it"
                )
            },
            Into::into,
        ))
    }

    /// Returns the film between a rigid probe and a rigid substrate if one of them deforms and does
    /// not relax. The layers of a stack relax all.
    fn rigid(&self, bodies: &Bodies) -> anyhow::Result<Option<System>> {
        let system = &bodies.system;
        let deforms = system.sphere_modulus < f64::INFINITY
            || !bodies.half_space && system.substrate.young() < f64::INFINITY;
        if self.all_relax || !deforms {
            return Ok(None);
        }
        ensure!(
            bodies.stack.is_none(),
            "layers, and a film with an interface, relax all by one law, and so must the sphere and the base: give \
             --all-relax, or a rigid sphere (--sphere-modulus inf) and a rigid base (--substrate-modulus inf, or young_modulus = \
             inf in the stack file), or use one bonded film"
        );
        Ok(Some(System {
            sphere_modulus: f64::INFINITY,
            substrate: Elastic::new(f64::INFINITY, system.substrate.poisson())?,
            ..system.clone()
        }))
    }

    /// Says what is doubtful, and how exact the numbers are.
    fn warn(&self, bodies: &Bodies, course: &Course) {
        let system = &bodies.system;
        if course.error > self.tolerance.unwrap_or(TOLD) {
            // `eprintln` panics where standard error is closed.
            let _ = writeln!(
                io::stderr(),
                "# estimated error: {:.1e} of the largest load, contact radius and penetration",
                course.error
            );
        }
        if course.unlike_bodies > UNLIKE {
            note(&format!(
                "warning: sphere or substrate deform beside the film and do not relax: the loads, or the penetrations where \
                 loads are imposed, may be wrong by {:.1e} of the largest, and contact radii by more",
                course.unlike_bodies
            ));
        }
        let alike = bodies
            .stack
            .as_ref()
            .is_none_or(|layers| is_one_body(layers.stack()));
        if !self.all_relax && !alike {
            note(
                "warning: all layers, and springs between them, relax by one law, as with --all-relax; where the top film \
                 relaxes alone, the contact is stiffer",
            );
        }
        if self.all_relax && system.film.young() > STIFF_FILM * system.substrate.young() {
            note(
                "warning: a film more than 3 times as stiff as a substrate that relaxes with it may pull at the probe inside \
                 the contact, which is not modelled",
            );
        }
    }
}

/// Tells whether a stack is one solid on its base, without springs.
fn is_one_body(stack: &Stack) -> bool {
    let layers = stack.layers();
    let has_springs = |layer: &Layer| matches!(layer.interface.plain(), Interface::Springs { .. });
    layers
        .iter()
        .all(|layer| layer.solid == layers[0].solid && !has_springs(layer))
}

/// Makes the contact from solves of its material up to an `a/t`.
fn solved(bodies: &Bodies, system: &System, reach: f64) -> anyhow::Result<Contact> {
    /// The relative tolerances of the solves: the second one where the first is out of reach.
    const TOLERANCES: [f64; 2] = [1e-10, 1e-8];
    /// The smallest contact radius, over the largest one or the thickness of the film or top layer.
    const BEGIN: f64 = 1e-4;
    // The contact of a flat end is the first one.
    let [end, _] = system
        .probe
        .contact_radii()
        .map(|a| a / system.film_thickness);
    let begin = BEGIN * reach.min(bodies.top_thickness() / system.film_thickness);
    let begin = if end > 0.0 { begin.min(end) } else { begin };
    let range = [begin, reach];
    let [first, second] = TOLERANCES;
    let contact = bodies.contact(system, range, first);
    Ok(contact.or_else(|_| bodies.contact(system, range, second))?)
}
