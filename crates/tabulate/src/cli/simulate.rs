//! `tabulate simulate`

use std::path::PathBuf;

use ::fit::data::{Role, roles};
use ::fit::report::{self, UnitOf};
use ::fit::{
    Combination, Direction, Experiment, Forecast, Kind, Measurement, Numbering, Point, forecast,
    simulate,
};
use anyhow::{Context, bail, ensure};
use clap::builder::TypedValueParser;
use clap::{ValueHint, value_parser};
use serde_json::{Value, json};
use units::{Dimension, Quantity};

use super::command_line::command_line;
use super::fit::experiments::{KnownArguments, forget_shapes};
use super::fit::free::FreeArguments;
use super::fit::indentation::{self, Noise, abscissa_noise};
use super::fit::object::{estimates, fixed_value, matrix, warning};
use super::fit::reading::doubted;
use super::fit::setting::{check_units, unit_of};
use super::fit::{kinds, one_of};
use super::json;
use super::output::Output;
use super::points::{evenly, number};
use super::quantity::{self, any, number as decimal};
use super::table_name::{self, TableName};
use super::{allow, note};
use crate::table::scene::created_by;

/// Make the data that an experiment would give, or the errors that its fit would have
///
/// Prints a table of the two quantities in SI units, with normal noise, that `tabulate fit` reads.
/// An approach goes from --from to --to, a retract goes back. The contact follows the branch that
/// an experiment follows: it jumps into contact and off at the end of the branch. Zeros of the
/// instrument are set by --value, such as --value load-offset=1e-6; a hysteresis of adhesion is
/// --value work-of-adhesion-receding=0.1.
///
/// Values of the bodies that are not given are those of the paper, and a comment line on standard
/// error names them, as in `tabulate curve`.
///
/// With --sample-interval and --value doubling-speed=1um/s --value speed-exponent=0.5 the adhesion of contact radii depends
/// on the speed of the contact line.
///
/// With --relaxation and --sample-interval the film relaxes; an approach from before the contact, a
/// --hold and a retract have a column of times.
///
/// With --expect it prints the standard errors that a fit of these data would find, and what 1 % of each value that
/// is not free and of each calibration would do, before any measurement: change --points, --from, --to and --noise until they are small enough. Where the force
/// jumps, a fit leaves out points near the jump, and its errors are larger.
///
/// Either way, contacts outside the assumptions of the model are named: wide ones, large strains, and with --expect
/// friction that would change a modulus by more than its error.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate simulate --specimen paper --kind load-radius --from 40um --to 130um --noise 5uN -o a.csv",
    "tabulate simulate --specimen paper --kind load-radius --from 40um --to 130um --noise 5uN --expect",
    "tabulate simulate --specimen paper --kind load-penetration --from -1um --to 1um --noise 1uN",
))]
pub struct Arguments {
    /// The two quantities that are measured
    #[arg(long, value_parser = kinds())]
    kind: Kind,
    /// First abscissa: of the contact radii, penetrations or heights (m), or loads (N)
    #[arg(long, value_parser = any)]
    from: Quantity,
    /// Last abscissa, where an approach ends and a retract begins
    #[arg(long, value_parser = any)]
    to: Quantity,
    /// Number of points, equally spaced; of a cycle, on each way
    #[arg(long, default_value_t = 40, value_parser = value_parser!(u32).range(2..=10_000_000))]
    points: u32,
    /// The ways measured: approach, retract, both (cycle), or points without a direction (none)
    /// [default: cycle for load-penetration and force-height, none otherwise]
    #[arg(long, value_parser = ways())]
    segments: Option<&'static [Option<Direction>]>,
    /// Time for which the last abscissa of the approach is held, s: a whole number of times the --sample-interval
    #[arg(long, value_name = "S", requires = "sample_interval", value_parser = quantity::time)]
    hold: Option<f64>,
    /// Standard deviation of a load (N) or penetration (m), or of a contact stiffness in per cent (1%)
    #[arg(long, value_parser = indentation::noise, allow_hyphen_values = true)]
    noise: Noise,
    /// Standard deviation of the abscissa, a contact radius, penetration or height (m), or of a contact stiffness at
    /// loads a load (N); `tabulate fit` takes the same flag [default: exact]
    #[arg(long, visible_alias = "radius-noise", value_name = "S", value_parser = any)]
    abscissa_noise: Option<Quantity>,
    /// Loss tangent of the film or top layer, 0 to 1, of a contact stiffness: the stiffness is then
    /// the storage part, and a column of phases is added, with the noise --noise in rad
    #[arg(long, value_name = "TANGENT", default_value_t = 0.0, value_parser = decimal, conflicts_with = "expect")]
    loss_tangent: f64,
    /// Seed of the noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    known: KnownArguments,
    /// Print the standard errors expected of a fit of the parameters --free
    #[arg(long)]
    expect: bool,
    #[command(flatten)]
    free: FreeArguments,
    #[arg(
        long,
        default_value = "embedded",
        help = table_name::HELP,
        value_hint = ValueHint::FilePath
    )]
    table: TableName,
    /// Units of the expected errors: film-modulus=MPa [default: such that numbers are above 1]
    #[arg(
        long,
        value_name = "NAME=UNIT,...",
        value_parser = unit_of,
        value_delimiter = ',',
        requires = "expect",
        conflicts_with_all = ["loss_tangent", "json"]
    )]
    units: Vec<UnitOf>,
    /// Print the expected errors as a JSON object in SI units: {"parameters": {"film_modulus":
    /// {"value", "stderr", "unit"}, ...}, "correlation": [[...]], "undetermined": [what the data do not
    /// determine], "fixed_values": as of `fit`, "warnings": [{"kind", "text"}]}. An infinite number is the text "inf" or "-inf", and one
    /// that is not known null
    #[arg(long, requires = "expect", conflicts_with = "loss_tangent")]
    json: bool,
    /// Write here instead of to standard output
    #[arg(short, long, value_name = "DATA.csv", conflicts_with = "json")]
    output: Option<PathBuf>,
}

/// The longest hold, in intervals between points.
const MOST_HELD: f64 = 1e6;
const NONE: &[Option<Direction>] = &[None];
const APPROACH: &[Option<Direction>] = &[Some(Direction::Approach)];
const RETRACT: &[Option<Direction>] = &[Some(Direction::Retract)];
const CYCLE: &[Option<Direction>] = &[Some(Direction::Approach), Some(Direction::Retract)];

/// Parses the ways measured.
fn ways() -> impl TypedValueParser<Value = &'static [Option<Direction>]> {
    one_of([
        ("none", NONE),
        ("approach", APPROACH),
        ("retract", RETRACT),
        ("cycle", CYCLE),
    ])
}

impl Arguments {
    /// Returns the ways measured.
    fn ways(&self) -> &'static [Option<Direction>] {
        let usual = match self.kind {
            Kind::LoadPenetration | Kind::ForceHeight => CYCLE,
            _ => NONE,
        };
        self.segments.unwrap_or(usual)
    }

    /// Tells whether the probe moves away from the first abscissa to the last one.
    fn recedes(&self, [from, to]: [f64; 2]) -> bool {
        if self.kind == Kind::ForceHeight {
            to > from
        } else {
            to < from
        }
    }

    /// Returns the first and the last abscissa, lengths or loads.
    fn ends(&self) -> anyhow::Result<[f64; 2]> {
        let dimension: Dimension = roles(self.kind)[0].dimension();
        let end = |quantity: &Quantity| quantity.of(Some(dimension));
        Ok([
            end(&self.from).context("--from")?,
            end(&self.to).context("--to")?,
        ])
    }
}

/// The range of data whose noise hides them, over the noise: that of a million normal numbers is 10.
const WITHIN: f64 = 12.0;

/// Returns the largest less the smallest ordinate.
fn range_of_ordinates(of: &Experiment) -> f64 {
    let ordinates = of.measurement.points.iter().map(|point| point.ordinate);
    let [least, most] = ordinates.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], y| {
        [least.min(y), most.max(y)]
    });
    most - least
}

/// Says that noise hides the data: its unit is probably wrong.
fn note_large_noise(exact: &Experiment, noise: f64) {
    if exact.measurement.kind.is_stiffness() {
        // This noise is in per cent.
        return;
    }
    let range = range_of_ordinates(exact);
    if noise > range {
        let [_, ordinate] = exact.measurement.kind.names();
        note(&format!(
            "--noise {noise:?} (SI units) is larger than the range of the {ordinate}, {range:.1e}, and hides it: check \
             the unit of --noise, such as 1nN or 5nm"
        ));
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let [stack, profile] = arguments.known.bodies.files();
    let inputs = [arguments.table.path(), stack, profile];
    let output = Output::of_text(arguments.output.as_deref(), &inputs)?;
    let mut experiments = [experiment(arguments, way(arguments)?)?];
    let free = if arguments.expect {
        arguments
            .free
            .of(&experiments, &[], &arguments.known.bodies.system)?
    } else {
        Vec::new()
    };
    let given = arguments.known.values.iter();
    let given: Vec<_> = given.filter_map(|one| one.quantity.parameter()).collect();
    arguments.known.relaxing.ask(&experiments[0], &given)?;
    forget_shapes(&mut experiments, &free);
    allow::magnitudes(&experiments[0].magnitudes(), &arguments.known.bodies.allow)?;
    let table = arguments.table.read_for_contacts()?;
    if arguments.expect {
        check_units(&arguments.units, &free)?;
        let expected = forecast(&table, &experiments, &free)?;
        arguments.known.name_example(&experiments[0]);
        return if arguments.json {
            json::print(&object(&expected))
        } else {
            output.write(report::expected(&expected, &experiments, &arguments.units).as_bytes())
        };
    }
    ensure!(
        arguments.free.is_empty(),
        "--free, --bounds, --prior, --own and --shared are for --expect; add it"
    );
    let [experiment] = experiments;
    let simulated = |noise| {
        simulate(&table, &experiment, noise, arguments.seed)
            .map_err(|error| doubted(error, &[], &[]))
    };
    let noise = arguments.noise.of(arguments.kind)?;
    let made = simulated(noise)?;
    let text = csv(&made)?;
    arguments.known.name_example(&experiment);
    output.write(&text)?;
    if range_of_ordinates(&made) < WITHIN * noise {
        note_large_noise(&simulated(0.0)?, noise);
    }
    for warning in made.broken_assumptions(&table)? {
        note(&warning.text);
    }
    Ok(())
}

/// Returns the ends of the abscissae, which suit the ways and the hold.
fn way(arguments: &Arguments) -> anyhow::Result<[f64; 2]> {
    let [from, to] = arguments.ends()?;
    ensure!(
        from.is_finite() && to.is_finite() && from != to,
        "--from {from:?} and --to {to:?} must be two different numbers"
    );
    let approaches = |way: &Option<Direction>| way.is_some();
    if arguments.ways().iter().any(approaches) && arguments.recedes([from, to]) {
        bail!(
            "--from {from:?} to --to {to:?} (SI units) moves away: an approach ends at --to and a retract begins there, \
             closer to the sample, where the {} is {}; exchange the two",
            roles(arguments.kind)[0].name().replace('_', " "),
            if arguments.kind == Kind::ForceHeight {
                "smaller"
            } else {
                "larger"
            }
        );
    }
    ensure!(
        !arguments.kind.is_stiffness() || !arguments.ways().contains(&Some(Direction::Retract)),
        "--segments: a contact stiffness is measured on the way to the larger contact: leave it out, or give \
         --segments approach"
    );
    ensure!(
        arguments.hold.is_none() || arguments.ways() != RETRACT,
        "--hold follows an approach, and there is none: leave it out, or give --segments cycle"
    );
    if let Some((hold, interval)) = arguments.hold.zip(arguments.known.relaxing.sample_interval) {
        let points = hold / interval;
        ensure!(
            (0.0..=MOST_HELD).contains(&points) && (points - points.round()).abs() < 1e-6,
            "--hold {hold:?}: a hold takes from 0 to {MOST_HELD} whole intervals between points; --sample-interval is \
             {interval:?} s: give another --hold"
        );
    }
    Ok([from, to])
}

/// Returns the experiment to be made, without ordinates.
fn experiment(arguments: &Arguments, ends: [f64; 2]) -> anyhow::Result<Experiment> {
    let measurement = plan(arguments, ends);
    arguments.known.history.needs_poisson_ratio()?;
    let mut experiment = arguments
        .known
        .experiments(vec![measurement], &[])?
        .remove(0);
    ensure!(
        arguments.kind != Kind::ForceHeight || experiment.stiffness.is_some(),
        "--kind force-height needs --stiffness, that of the cantilever, for example 0.1N/m"
    );
    ensure!(
        arguments.kind == Kind::ForceHeight || arguments.known.stiffness.is_none(),
        "--stiffness is that of a cantilever, of --kind force-height: leave it out"
    );
    ensure!(
        arguments.kind != Kind::StiffnessDepth || experiment.indentation.hardness.is_some(),
        "--kind stiffness-depth needs --hardness, which tells the loads, for example 10GPa"
    );
    ensure!(
        experiment.work_of_adhesion_receding.is_none()
            || arguments.ways().contains(&Some(Direction::Retract)),
        "work-of-adhesion-receding is that of unloading, and there is none: leave it out, or give --segments cycle"
    );
    experiment.noise = Some(arguments.noise.of(arguments.kind)?);
    if let Some(noise) = &arguments.abscissa_noise {
        experiment.abscissa_noise = abscissa_noise(noise, arguments.kind)?;
    }
    ensure!(
        arguments.loss_tangent == 0.0 || arguments.kind.is_stiffness(),
        "--loss-tangent is for a contact stiffness, and {} is measured: leave it out, or give --kind \
         stiffness-radius, stiffness-load or stiffness-depth",
        arguments.kind.name()
    );
    experiment.indentation.loss_tangent = arguments.loss_tangent;
    Ok(experiment)
}

/// Returns the measurement to be made, without ordinates.
fn plan(arguments: &Arguments, [from, to]: [f64; 2]) -> Measurement {
    let Arguments { kind, points, .. } = *arguments;
    let interval = arguments.known.relaxing.sample_interval;
    let held = arguments.hold.zip(interval);
    let held = held.map_or(0, |(hold, interval)| (hold / interval).round() as usize);
    let way = |&direction: &Option<Direction>| {
        let back = direction == Some(Direction::Retract);
        let ends = if back { [to, from] } else { [from, to] };
        let held = if back { 0 } else { held };
        let evenly = (0..points).map(move |i| evenly(ends, i, points));
        let abscissae = evenly.chain(std::iter::repeat_n(to, held));
        abscissae.map(move |abscissa| Point {
            line: 0,
            abscissa,
            ordinate: 0.0,
            direction,
        })
    };
    Measurement {
        name: "the experiment".into(),
        kind,
        numbering: Numbering::Lines,
        points: arguments.ways().iter().flat_map(way).collect(),
    }
}

/// Writes a measurement as a table that `tabulate fit` reads.
fn csv(made: &Experiment) -> anyhow::Result<Vec<u8>> {
    let (measurement, of) = (&made.measurement, &made.indentation);
    let mut writer = csv::Writer::from_writer(Vec::new());
    let (by, command) = (created_by(), command_line());
    let note = format!("# Synthetic, not measured, by {by}. SI units.\n# {command}\n");
    let has_segments = measurement
        .points
        .iter()
        .any(|point| point.direction.is_some());
    let time = (!made.times.is_empty()).then_some(Role::Time.name());
    let names = roles(measurement.kind).map(Role::name);
    let load = (!of.loads.is_empty()).then_some(Role::Load.name());
    let phase = (!of.phases.is_empty()).then_some(Role::PhaseShift.name());
    let segment = has_segments.then_some(Role::Segment.name());
    let names = time.into_iter().chain(names);
    writer.write_record(names.chain(load).chain(phase).chain(segment))?;
    for (i, point) in measurement.points.iter().enumerate() {
        let numbers = made.times.get(i).copied().into_iter();
        let numbers = numbers.chain([point.abscissa, point.ordinate]);
        let beside = [of.loads.get(i), of.phases.get(i)].into_iter().flatten();
        let numbers = numbers.chain(beside.copied()).map(number);
        let direction = point.direction.map(|direction| direction.name().to_owned());
        writer.write_record(numbers.chain(direction))?;
    }
    let mut bytes = note.into_bytes();
    bytes.extend(writer.into_inner()?);
    Ok(bytes)
}

/// Returns the JSON object of expected errors.
fn object(expected: &Forecast) -> Value {
    json!({
        "parameters": estimates(&expected.estimates, 1),
        "correlation": matrix(&expected.correlation),
        // The parameters that the data would not determine, alone or apart from one another.
        "undetermined": Combination::texts(&expected.undetermined),
        "fixed_values": expected.fixed_values.iter().map(fixed_value).collect::<Value>(),
        "warnings": expected.warnings.iter().map(warning).collect::<Value>(),
    })
}
