//! The forms that hold in the whole box of a table: tables, direct solves, and half-spaces of some
//! modulus.

use interp::{Curve, Material, Parameter, Quantities, Quantity, Table};

use super::linear::{in_table, on_curve};
use super::load::{Errors, loads};
use super::rows::{FURTHER, Family, NEW, Point, Row, SOLVED};
use crate::Measured;
use crate::approximations::{bulk_jkr, film_jkr, gao, hay_crawford};
use crate::clock::Timing;
use crate::deviation::tightest;
use crate::load::Load;
use solve::parallel::try_map;
use solve::{Error, solve};

/// The tolerances of the direct solves.
const TOLERANCES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-9];

/// The number of pieces of the cubic spline of one curve.
const PIECES: usize = 600;

/// Returns the number of solves that [`measure`] reports.
pub const fn solves(points: usize) -> usize {
    points + TOLERANCES.len() * if points < SOLVED { points } else { SOLVED }
}

/// Measures all forms at these points of a table's box.
pub fn measure(
    table: &Table,
    points: &[Point],
    timing: Timing,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Measured<Row>, Error> {
    let truth = solve_all(points, progress, |(x, material)| {
        Ok(tightest(*x, material)?.quantities)
    })?;
    let scene = Scene {
        scope: scope(table),
        truth: loads(points, &truth),
        points,
        timing,
    };
    let (mut rows, mut left_out) = (Vec::new(), Vec::new());
    if table.low_rank().is_some() {
        rows.extend(scene.table("packed table", table)?);
    }
    let dense = table.expand()?;
    rows.extend(scene.table("dense table", &dense)?);
    rows.push(scene.multilinear(&dense));
    if dense.axis(Parameter::AOverT).len() > 1 {
        rows.extend(scene.along_curves(&dense)?);
    } else {
        left_out.push(
            "There is no interpolation along a curve: the table has a single a/t.".to_owned(),
        );
    }
    for tolerance in TOLERANCES {
        rows.push(scene.solve(tolerance, progress)?);
    }
    scene.closed_forms(&mut rows, &mut left_out)?;
    Ok(Measured { rows, left_out })
}

/// Solves every point, on all cores.
fn solve_all(
    points: &[Point],
    progress: &(dyn Fn(usize) + Sync),
    solve: impl Fn(&Point) -> Result<Quantities, Error> + Sync,
) -> Result<Vec<Quantities>, Error> {
    try_map(points, |point| {
        let solved = solve(point);
        progress(1);
        solved
    })
}

/// Returns the box of a table in words, which the rows have as their scope.
fn scope(table: &Table) -> String {
    // Without the star of E2*, as the column of the kept rows.
    let names = ["a/t", "E1/E2", "nu1", "E0/E2"];
    let ranges = Parameter::ALL.into_iter().zip(names);
    let range = |(parameter, name): (Parameter, &str)| {
        let [from, to] = table.range(parameter).map(|value| match parameter {
            Parameter::Nu1 => format!("{value}"),
            _ => format!("{value:e}"),
        });
        if from == to {
            format!("{name} {from}")
        } else {
            format!("{name} {from} to {to}")
        }
    };
    ranges.map(range).collect::<Vec<_>>().join(", ")
}

/// Points with their true loads.
struct Scene<'a> {
    scope: String,
    points: &'a [Point],
    truth: Vec<Load>,
    timing: Timing,
}

impl Scene<'_> {
    fn row(&self, family: Family, form: &str, what: &str, seconds: f64, errors: &Errors) -> Row {
        errors.row(family, form, what, seconds, &self.scope, "contact radius")
    }

    /// Measures a table's own splines.
    fn table(&self, form: &str, table: &Table) -> Result<Vec<Row>, Error> {
        let found = self
            .points
            .iter()
            .map(|(x, material)| table.curve(material)?.quantities(*x));
        let found = found.collect::<Result<Vec<_>, _>>()?;
        let errors = Errors::of_loads(&loads(self.points, &found), &self.truth);

        let (_, material) = self.points[0];
        let curve = table.curve(&material)?;
        let radii: Vec<f64> = self.points.iter().map(|point| point.0).collect();
        let timing = self.timing;
        let times = [
            (
                NEW,
                timing.of_new_ones(self.points, |(x, material)| {
                    table
                        .curve(material)
                        .and_then(|curve| curve.quantity(Quantity::Pi0, *x))
                }),
            ),
            (
                FURTHER,
                timing.per_one(&radii, |&x| {
                    curve.quantity(Quantity::Pi0, x).unwrap_or(f64::NAN)
                }),
            ),
        ];
        Ok(times
            .map(|(what, seconds)| self.row(Family::Table, form, what, seconds, &errors))
            .into())
    }

    /// Measures linear interpolation between the nodes in all parameters at once.
    fn multilinear(&self, table: &Table) -> Row {
        let grids = Quantity::ALL.map(|quantity| in_table(table, quantity));
        let found: Vec<Quantities> = self
            .points
            .iter()
            .map(|(x, material)| {
                Quantities::from_array(grids.each_ref().map(|grid| grid(*x, material)))
            })
            .collect();
        let errors = Errors::of_loads(&loads(self.points, &found), &self.truth);
        let seconds = self
            .timing
            .per_one(self.points, |(x, material)| grids[0](*x, material));
        self.row(
            Family::Table,
            "linear in 4-D, same nodes",
            NEW,
            seconds,
            &errors,
        )
    }

    /// Measures other interpolation along the curve of one material.
    fn along_curves(&self, table: &Table) -> Result<Vec<Row>, Error> {
        let nodes = table.axis(Parameter::AOverT);
        let (mut linear, mut cubic) = (Vec::new(), Vec::new());
        for (x, material) in self.points {
            let curve = table.curve(material)?;
            let (mut by_linear, mut by_cubic) = ([0.0; 4], [0.0; 4]);
            for quantity in Quantity::ALL {
                by_linear[quantity as usize] = on_curve(&curve, quantity, nodes)?(*x);
                by_cubic[quantity as usize] = spline(&curve, quantity)?(*x);
            }
            linear.push(Quantities::from_array(by_linear));
            cubic.push(Quantities::from_array(by_cubic));
        }
        let row = |form: &str, found: &[Quantities], at: &dyn Fn(f64) -> f64| {
            let errors = Errors::of_loads(&loads(self.points, found), &self.truth);
            self.row(
                Family::Table,
                form,
                FURTHER,
                self.timing.per_one(self.points, |(x, _)| at(*x)),
                &errors,
            )
        };
        let curve = table.curve(&self.points[0].1)?;
        let (line, cubics) = (
            on_curve(&curve, Quantity::Pi0, nodes)?,
            spline(&curve, Quantity::Pi0)?,
        );
        Ok(vec![
            row("linear along a curve, same nodes", &linear, &line),
            row(
                &format!("cubic along a curve, {PIECES} pieces"),
                &cubic,
                &cubics,
            ),
        ])
    }

    /// Measures solves to a tolerance.
    fn solve(&self, tolerance: f64, progress: &(dyn Fn(usize) + Sync)) -> Result<Row, Error> {
        let points = &self.points[..self.points.len().min(SOLVED)];
        let solve = |(x, material): &Point| Ok(solve(*x, material, tolerance)?.quantities);
        let found = solve_all(points, progress, solve)?;
        let errors = Errors::of_loads(&loads(points, &found), &self.truth[..points.len()]);
        let form = format!("direct solve to {tolerance:e}");
        let seconds = self.timing.of_solves(points, solve);
        Ok(self.row(Family::Solve, &form, NEW, seconds, &errors))
    }

    /// Measures half-spaces of some modulus.
    fn closed_forms(&self, rows: &mut Vec<Row>, left_out: &mut Vec<String>) -> Result<(), Error> {
        type Form = (&'static str, fn(f64, &Material) -> Result<f64, Error>);
        const FORMS: [Form; 4] = [
            ("bulk JKR, film ignored", |_, material| {
                Ok(bulk_jkr(material))
            }),
            ("film JKR, substrate ignored", |_, material| {
                Ok(film_jkr(material))
            }),
            ("Gao 1992", gao),
            ("Hay and Crawford 2011", hay_crawford),
        ];
        for (name, form) in FORMS {
            let found = self
                .points
                .iter()
                .map(|(x, material)| form(*x, material).map(Load::of_half_space));
            let found = found.collect::<Result<Vec<_>, _>>()?;
            if found.iter().all(|load| load.press.is_finite()) {
                let errors = Errors::of_loads(&found, &self.truth);
                let seconds = self.timing.per_one(self.points, |(x, material)| {
                    form(*x, material).unwrap_or(f64::NAN)
                });
                rows.push(self.row(Family::ClosedForm, name, NEW, seconds, &errors));
            } else {
                left_out.push(format!(
                    "{name} has no row: between rigid bodies its load is infinite."
                ));
            }
        }
        Ok(())
    }
}

/// Returns the cubic spline of a quantity on a curve.
fn spline(curve: &Curve, quantity: Quantity) -> Result<impl Fn(f64) -> f64, Error> {
    let spline = curve.spline(quantity, PIECES)?;
    Ok(move |x: f64| {
        spline
            .clamped_sample(Parameter::AOverT.coordinate(x))
            .expect("the spline has keys")
    })
}
