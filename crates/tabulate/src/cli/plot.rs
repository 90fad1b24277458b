//! `tabulate plot`

use std::path::{Path, PathBuf};

use ::cost::Measurement;
use ::cost::clock::Timing;
use clap::{Args, Subcommand, ValueHint};
use figures::chart;
use figures::picture::Format;

use super::interface::{self, Word};
use super::output::Output;
use super::progress::progress_bar;
use super::sized_probe::SizedProbeArguments;
use super::system::{self, Specimen};
use super::table_name::{self, TableName};
use super::{cost, default_table};
use crate::measure::read_csv;
use crate::plot::{
    contact_stiffness, effects, error_map, fig2, fig3, fig4, force_displacement, friction,
    lookup_cost, pull_off, relaxation, table_cost, work_precision,
};
use crate::printable;

/// Draw a figure as SVG or PNG
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate plot fig4 -o fig4.svg",
    "tabulate plot force-displacement --specimen paper -o curves.png",
    "tabulate plot error-map tables/paper.h5 -o errors.svg",
    "tabulate plot table-cost --data tables/figures/table.csv -o cost.svg",
))]
pub struct Arguments {
    #[command(subcommand)]
    figure: Figure,
}

/// The arguments of a probe that is no paraboloid.
const OF_PROBE: [&str; 5] = ["probe", "half_angle", "exponent", "coefficient", "profile"];

#[derive(Subcommand)]
enum Figure {
    /// Fig. 2 of the paper: Pi0 against a/t, with both limits
    #[command(after_help = super::examples!("tabulate plot fig2 -o fig2.svg"))]
    Fig2(Picture),
    /// Fig. 3 of the paper: Eeq and Gamma against a/t, with their limits
    #[command(after_help = super::examples!("tabulate plot fig3 -o fig3.svg"))]
    Fig3(Picture),
    /// Fig. 4 of the paper: JKR plots for films of 1 to 100 um, with the straight lines of JKR for
    /// the substrate alone and for the film alone
    #[command(after_help = super::examples!("tabulate plot fig4 -o fig4.png"))]
    Fig4(Picture),
    /// Load against penetration of the paper's system for several films, with the jumps, under any
    /// probe, or on films that slide
    #[command(after_help = super::examples!(
        "tabulate plot force-displacement --specimen paper -o curves.svg",
        "tabulate plot force-displacement --specimen paper --interface sliding -o sliding.svg",
        "tabulate plot force-displacement --specimen paper --probe cone --half-angle 70 -o cone.svg",
    ))]
    ForceDisplacement {
        #[command(flatten)]
        probe: SizedProbeArguments,
        /// The specimen. Without it a comment line on standard error names the values of the paper
        #[arg(long, value_enum)]
        specimen: Option<Specimen>,
        /// What joins the films to the substrate, under a paraboloid [default: bonded]. A film that
        /// slides has no friction there and is held by tension: one that lifts off is not modelled
        #[arg(long, value_enum, conflicts_with_all = OF_PROBE, conflicts_with = "interface_stiffness")]
        interface: Option<Word>,
        /// Springs between films and substrate, Pa/m, under a paraboloid: the tangential stiffness,
        /// and optionally the normal one [default: inf]. 0 slides, inf is bonded
        #[arg(
            long,
            value_name = "KT[,KN]",
            conflicts_with_all = OF_PROBE,
            value_parser = interface::springs
        )]
        interface_stiffness: Option<[f64; 2]>,
        #[command(flatten)]
        output: Picture,
    },
    /// Pull-off load against Tabor's parameter, from DMT to JKR, on a half-space and on two films
    #[command(after_help = super::examples!("tabulate plot pull-off -o pull-off.svg"))]
    PullOff(Picture),
    /// Contact stiffness of an oxide on silicon under diamond against a/t: exact, film and substrate
    /// as springs in series, and the closed form of Gao, Chiu and Lee
    #[command(after_help = super::examples!(
        "tabulate plot contact-stiffness -o contact-stiffness.svg",
    ))]
    ContactStiffness(Picture),
    /// Change of stiffness, load and pull-off load by full friction in the paper's system, against
    /// the film's thickness
    #[command(after_help = super::examples!("tabulate plot friction -o friction.svg"))]
    Friction(Picture),
    /// Load in time on gels of three thicknesses that relax, with the load on a half-space times the
    /// elastic effect of the thickness (`tabulate history`)
    #[command(after_help = super::examples!("tabulate plot relaxation -o relaxation.svg"))]
    Relaxation(Picture),
    /// Load against a/t of an incompressible film on a rigid base that is bonded, joined by springs,
    /// or slides
    #[command(after_help = super::examples!("tabulate plot interface -o interface.svg"))]
    Interface(Picture),
    /// Largest difference of a table from direct solves, over a/t and E1/E2*, at the worst nu1 and
    /// E0/E2*
    #[command(after_help = super::examples!("tabulate plot error-map tables/paper.h5 -o errors.svg"))]
    ErrorMap {
        #[arg(
            help = format!(
                "{}. Its axes must be those of a scene with e1_over_e2, which those of the embedded \
                 table are not {}",
                table_name::HELP,
                default_table::HELP
            ),
            value_hint = ValueHint::FilePath
        )]
        table: Option<TableName>,
        #[command(flatten)]
        output: Picture,
    },
    /// Cost of a table, and the number of evaluations from which on it is faster than direct solves
    /// (`tabulate cost table`)
    #[command(after_help = super::examples!(
        "tabulate plot table-cost --data tables/figures/table.csv -o table-cost.svg",
    ))]
    TableCost(OfCosts),
    /// Cost of each effect, and error of the load without it (`tabulate cost effects`)
    #[command(after_help = super::examples!(
        "tabulate plot effects --data tables/figures/effects.csv -o effects.svg",
    ))]
    Effects(OfCosts),
    /// Error against time of one solve (`tabulate cost solve`)
    #[command(after_help = super::examples!(
        "tabulate plot work-precision --data tables/figures/solve.csv -o work-precision.svg",
    ))]
    WorkPrecision(OfCosts),
    /// Error against nanoseconds of one lookup (`tabulate cost lookup`)
    #[command(after_help = super::examples!(
        "tabulate plot lookup-cost --data tables/figures/lookup.csv -o lookup-cost.svg",
    ))]
    LookupCost(OfCosts),
}

/// The arguments of a figure of costs.
#[derive(Args)]
struct OfCosts {
    /// The CSV that `tabulate cost` has written [default: measure now]
    #[arg(long, value_name = "COST.csv")]
    data: Option<PathBuf>,
    #[command(flatten)]
    output: Picture,
}

impl OfCosts {
    /// Draws the rows of the file, or measures them without one.
    fn draw<R: Measurement>(
        &self,
        measure: impl FnOnce() -> anyhow::Result<Vec<R>>,
        figure: fn(&[R]) -> Result<chart::Figure, figures::Error>,
    ) -> anyhow::Result<()> {
        let data = self.data.as_deref();
        self.output.write(data, || {
            let rows = data.map_or_else(measure, |path| Ok(read_csv(path)?))?;
            Ok(figure(&rows)?)
        })
    }
}

/// The file of a picture.
#[derive(Args)]
struct Picture {
    /// The picture: SVG or PNG by the ending of its name
    #[arg(id = "output", short, long, value_name = "FILE.svg|FILE.png", value_parser = picture)]
    path: PathBuf,
}

impl Picture {
    /// Checks the output, which is not to replace the `input`, makes the figure and writes it.
    fn write(
        &self,
        input: Option<&Path>,
        figure: impl FnOnce() -> anyhow::Result<chart::Figure>,
    ) -> anyhow::Result<()> {
        let output = Output::new(Some(&self.path), &[input])?;
        let picture = figure()?.picture()?.encode(format(&self.path)?)?;
        output.write(&picture)
    }
}

/// Says of contacts that are not solved for the picture of force against displacement what its user can change.
fn in_picture(error: crate::Error) -> anyhow::Error {
    use crate::Error::Contact;
    use contact::Error::OutsideRadii;
    match error {
        Contact(OutsideRadii { from, to, .. }) => anyhow::anyhow!(
            "under this probe the contacts of the picture, on films of 1, 30 and 300 um, reach beyond the radii that are solved on one of \
             the films, {from:.1e} m to {to:.1e} m: give other dimensions of the probe; `tabulate curve` solves single films"
        ),
        error => error.into(),
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.figure {
        Figure::Fig2(output) => output.write(None, || Ok(fig2::figure()?)),
        Figure::Fig3(output) => output.write(None, || Ok(fig3::figure()?)),
        Figure::Fig4(output) => output.write(None, || Ok(fig4::figure()?)),
        Figure::ForceDisplacement {
            probe,
            specimen,
            interface,
            interface_stiffness,
            output,
        } => output.write(probe.shape.profile.as_deref(), || {
            if specimen.is_none() {
                system::name_example(&probe.missing());
            }
            let probe = probe.probe()?;
            let joined = interface::interface(*interface, *interface_stiffness);
            let films = force_displacement::data(&probe, joined).map_err(in_picture)?;
            Ok(force_displacement::figure(&films, &probe, joined))
        }),
        Figure::PullOff(output) => output.write(None, || Ok(pull_off::figure()?)),
        Figure::ContactStiffness(output) => output.write(None, || Ok(contact_stiffness::figure()?)),
        Figure::Friction(output) => output.write(None, || Ok(friction::figure()?)),
        Figure::Relaxation(output) => output.write(None, || Ok(relaxation::figure()?)),
        Figure::Interface(output) => output.write(None, || Ok(crate::plot::interface::figure()?)),
        Figure::ErrorMap { table, output } => {
            output.write(table.as_ref().and_then(TableName::path), || {
                let table = default_table::read_or_make(table.as_ref())?;
                let bar = progress_bar(error_map::CELLS[0] * error_map::CELLS[1], "comparing");
                let data = error_map::data(&table, &|count| bar.inc(count as u64))?;
                bar.finish_and_clear();
                Ok(error_map::figure(&data))
            })
        }
        Figure::TableCost(of) => of.draw(cost::measure_table, |rows| Ok(table_cost::figure(rows))),
        Figure::Effects(of) => of.draw(cost::measure_effects, effects::figure),
        Figure::WorkPrecision(of) => of.draw(
            || Ok(cost::measure_solve(Timing::Thorough)),
            work_precision::figure,
        ),
        Figure::LookupCost(of) => of.draw(cost::measure_lookup, lookup_cost::figure),
    }
}

/// Parses the name of a picture: its ending is that of a format that can be written.
pub fn picture(name: &str) -> Result<PathBuf, figures::Error> {
    let path = PathBuf::from(name);
    format(&path).map(|_| path)
}

/// Returns the format of a picture by the ending of its name.
pub fn format(path: &Path) -> Result<Format, figures::Error> {
    Format::of(path).ok_or_else(|| {
        figures::Error(format!(
            "the name of a picture ends in .svg or .png, but this is {}",
            printable::path(path)
        ))
    })
}
