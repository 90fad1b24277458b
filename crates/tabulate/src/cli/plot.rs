//! `tabulate plot`

use std::path::PathBuf;

use clap::{Args, Subcommand};
use interp::Table;
use serde::de::DeserializeOwned;

use super::{cost, progress_bar, read_table, write_text};
use crate::cost::read_csv;
use crate::plot::chart;
use crate::plot::picture::Format;
use crate::plot::{
    effects, error_map, fig2, fig3, fig4, force_displacement, lookup_cost, table_cost,
    work_precision,
};
use crate::{Error, output};

/// Draw a figure as SVG or PNG
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    figure: Figure,
}

#[derive(Subcommand)]
enum Figure {
    /// Fig. 2 of the paper: Pi0 against a/t, with both limits
    Fig2(Output),
    /// Fig. 3 of the paper: Eeq and Gamma against a/t, with their limits
    Fig3(Output),
    /// Fig. 4 of the paper: JKR plots for films of 1 to 100 um, with the lines of JKR without a
    /// film and without a substrate
    Fig4(Output),
    /// Load against penetration of the paper's system for several films, with the jumps
    ForceDisplacement(Output),
    /// What a table differs from direct solves, over a/t and E1/E2, at the worst nu1 and E0/E2
    ErrorMap {
        /// The table, HDF5 or packed [default: the one that is compiled in]
        table: Option<PathBuf>,
        #[command(flatten)]
        output: Output,
    },
    /// The cost of a table and its break-even, as `tabulate cost table` measures them
    TableCost {
        #[command(flatten)]
        rows: Rows,
        #[command(flatten)]
        output: Output,
    },
    /// What each effect costs, and what the load is without it, as `tabulate cost effects` measures
    /// it
    Effects {
        #[command(flatten)]
        rows: Rows,
        #[command(flatten)]
        output: Output,
    },
    /// Error against time of one solve, as `tabulate cost solve` measures it
    WorkPrecision {
        #[command(flatten)]
        rows: Rows,
        #[command(flatten)]
        output: Output,
    },
    /// Error against nanoseconds of one lookup, as `tabulate cost lookup` measures it
    LookupCost {
        #[command(flatten)]
        rows: Rows,
        #[command(flatten)]
        output: Output,
    },
}

/// Where the rows of a figure of costs come from.
#[derive(Args)]
struct Rows {
    /// What `tabulate cost` has written [default: measure it now]
    #[arg(long = "data", value_name = "COST.csv")]
    path: Option<PathBuf>,
}

impl Rows {
    /// Reads them or measures them.
    fn get<R: DeserializeOwned>(
        &self,
        measure: impl FnOnce() -> anyhow::Result<Vec<R>>,
    ) -> anyhow::Result<Vec<R>> {
        self.path
            .as_deref()
            .map_or_else(measure, |path| Ok(read_csv(path)?))
    }
}

/// Where a picture goes.
#[derive(Args)]
struct Output {
    /// The picture: SVG or PNG by the ending of its name
    #[arg(id = "output", short, long, value_name = "FILE.svg|FILE.png", value_parser = picture)]
    path: PathBuf,
}

impl Output {
    /// Makes a figure, and then its file.
    fn write(&self, figure: impl FnOnce() -> anyhow::Result<chart::Figure>) -> anyhow::Result<()> {
        output::check(Some(&self.path), None)?;
        let picture = figure()?.picture()?.encode(Format::of(&self.path)?)?;
        write_text(Some(&self.path), &picture)
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.figure {
        Figure::Fig2(output) => output.write(|| Ok(fig2::figure(&fig2::data()?))),
        Figure::Fig3(output) => output.write(|| Ok(fig3::figure(&fig3::data()?))),
        Figure::Fig4(output) => output.write(|| Ok(fig4::figure(&fig4::data()?))),
        Figure::ForceDisplacement(output) => {
            output.write(|| Ok(force_displacement::figure(&force_displacement::data()?)))
        }
        Figure::ErrorMap { table, output } => output.write(|| {
            let read = table.as_deref().map(read_table).transpose()?;
            let table = read.as_ref().unwrap_or_else(|| Table::embedded());
            let bar = progress_bar(error_map::CELLS[0] * error_map::CELLS[1], "comparing");
            let data = error_map::data(table, &|count| bar.inc(count as u64))?;
            bar.finish_and_clear();
            Ok(error_map::figure(&data))
        }),
        Figure::TableCost { rows, output } => {
            output.write(|| Ok(table_cost::figure(&rows.get(cost::measure_table)?)))
        }
        Figure::Effects { rows, output } => {
            output.write(|| Ok(effects::figure(&rows.get(cost::measure_effects)?)?))
        }
        Figure::WorkPrecision { rows, output } => output.write(|| {
            Ok(work_precision::figure(
                &rows.get(|| Ok(cost::measure_solve()))?,
            )?)
        }),
        Figure::LookupCost { rows, output } => {
            output.write(|| Ok(lookup_cost::figure(&rows.get(cost::measure_lookup)?)?))
        }
    }
}

/// The name of a picture that can be written.
fn picture(name: &str) -> Result<PathBuf, Error> {
    let path = PathBuf::from(name);
    Format::of(&path).map(|_| path)
}
