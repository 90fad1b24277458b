//! The error map of a table: its largest difference from direct solves over `a/t` and `E1/E2*`, at
//! the worst of many `nu1` and `E0/E2*`.

use interp::{Parameter, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::Error;
use crate::table::{SampledAxis, sample};
use figures::axis::Axis;
use figures::chart::{BLACK, Colour, Figure, Panel, Side};
use figures::picture::legible;
use solve::larger;
use solve::parallel::try_map;

/// The numbers of cells along `a/t` and `E1/E2*`.
pub const CELLS: [usize; 2] = [72, 42];

/// The number of random points in each cell. All but those on faces of the box are off the nodes.
pub const POINTS: usize = 32;

/// The data of the figure.
#[derive(Clone, Debug)]
pub struct Data {
    /// The table's title.
    pub title: String,
    /// The table's tolerance.
    pub tolerance: f64,
    /// The certificate of the table: its largest error at sampled points.
    pub certified: f64,
    /// The borders of the cells along `a/t` and `E1/E2*`.
    pub borders: [Vec<f64>; 2],
    /// The largest relative error of any quantity at the points of each cell: `errors[row][column]`
    /// is the cell at number `row` of `E1/E2*` and number `column` of `a/t`.
    pub errors: Vec<Vec<f64>>,
}

/// Returns the name and the value of the parameter of the map that the table fixes: none if the
/// table has a map.
pub fn fixed(table: &Table) -> Option<(&'static str, f64)> {
    let [a_over_t, film, ..] = table.parameters();
    [a_over_t, film]
        .into_iter()
        .find_map(|parameter| match table.axis(parameter) {
            [only] => Some((parameter.name(), *only)),
            _ => None,
        })
}

/// Returns whether a table has the two axes of a map.
pub fn is_possible(table: &Table) -> bool {
    table.parameters()[1] == Parameter::E1OverE2 && fixed(table).is_none()
}

/// Compares a table with [`POINTS`] direct solves in each cell, and calls `progress` with the
/// number of cells done.
///
/// The data does not depend on the number of threads.
///
/// # Errors
/// [`figures::Error`] for a table that fixes `a/t` or `E1/E2*`; those of the solve.
pub fn data(table: &Table, progress: &(dyn Fn(usize) + Sync)) -> Result<Data, Error> {
    if table.parameters()[1] != Parameter::E1OverE2 {
        let what = "the map is over a/t and E1/E2*, and the table has other axes; give a table with \
                    e1_over_e2, or none for that of the default scene";
        return Err(figures::Error(what.to_owned()).into());
    }
    if let Some((name, only)) = fixed(table) {
        let what = format!(
            "the map is over a/t and the film's modulus, but the table fixes {name} = {only}"
        );
        return Err(figures::Error(what).into());
    }
    let axes = table
        .parameters()
        .map(|parameter| SampledAxis::new(parameter, table.axis(parameter)));
    let share = |k: usize, i: usize| i as f64 / CELLS[k] as f64;
    let largest = |[column, row]: [usize; 2]| {
        let mut random = Pcg64Mcg::seed_from_u64((row * CELLS[0] + column) as u64);
        let mut worst = 0.0;
        for _ in 0..POINTS {
            let [a_over_t, e1] = [(0, column), (1, row)]
                .map(|(k, i)| axes[k].at(random.random_range(share(k, i)..share(k, i + 1))));
            let point = [
                a_over_t,
                e1,
                axes[2].anywhere(&mut random),
                axes[3].anywhere(&mut random),
            ];
            worst = larger(worst, sample(table, point)?.error);
        }
        progress(1);
        Ok(worst)
    };
    let row = |row: usize| try_map(0..CELLS[0], |column| largest([column, row]));
    let errors = (0..CELLS[1]).map(row).collect::<Result<_, Error>>()?;
    let description = table.description();
    Ok(Data {
        title: description.title.clone(),
        tolerance: description.tolerance,
        certified: description.certificate.max_error,
        borders: [0, 1].map(|k| (0..=CELLS[k]).map(|i| axes[k].at(share(k, i))).collect()),
        errors,
    })
}

/// The number of colours for each decade of error.
const STEPS: f64 = 4.0;

/// Draws the map and the scale of its colours.
pub fn figure(data: &Data) -> Figure {
    let [x, y] = &data.borders;
    let ends = |borders: &[f64]| [borders[0], borders[borders.len() - 1]];
    let title = format!(
        "{}, tolerance {:e}",
        shortened(&legible(&data.title)),
        data.tolerance
    );
    let x_axis = Axis::logarithmic("contact radius / film thickness, a/t", ends(x));
    let mut map = Panel::new(
        title,
        x_axis,
        Axis::logarithmic("film modulus, E_{1}/E_{2}*", ends(y)),
    );
    let scale = Scale::new(data);
    for (row, errors) in data.errors.iter().enumerate() {
        // Neighbours of one colour are one cell. Each cell reaches to the far corner of the map,
        // under the cells that follow: otherwise the paper would shine through between them.
        let mut column = 0;
        for cells in errors.chunk_by(|a, b| scale.step(*a) == scale.step(*b)) {
            map.cell(
                [x[column], ends(x)[1]],
                [y[row], ends(y)[1]],
                scale.colour(scale.step(cells[0])),
            );
            column += cells.len();
        }
    }
    let mut bar = Panel::new(
        "",
        Axis::hidden(),
        Axis::logarithmic(
            "largest relative error over ν_{1}, E_{0}/E_{2}*",
            scale.range(),
        ),
    )
    .share(0.3)
    .margin(96);
    for step in 0..scale.steps {
        bar.cell(
            [0.0, 1.0],
            [step, step + 1].map(|step| scale.value(step)),
            scale.colour(step),
        );
    }
    for (error, name) in [(data.tolerance, "tolerance"), (data.certified, "certified")] {
        bar.line([[0.0, error], [1.2, error]], BLACK)
            .label([1.0, error], name, BLACK, Side::Right);
    }
    Figure::new(460, [map, bar])
}

/// Cuts a title after 53 characters.
fn shortened(title: &str) -> String {
    const MOST: usize = 54;
    if title.chars().count() <= MOST {
        title.to_owned()
    } else {
        title.chars().take(MOST - 1).chain(['…']).collect()
    }
}

/// The colours of errors: equal steps of the logarithm.
struct Scale {
    /// The decimal logarithm of the upper end of the lowest step's errors, less one step.
    from: f64,
    steps: u32,
}

impl Scale {
    /// Makes a scale from a hundredth of the median to the largest error or the tolerance.
    fn new(data: &Data) -> Self {
        let mut errors: Vec<f64> = data.errors.iter().flatten().copied().collect();
        errors.sort_by(f64::total_cmp);
        let largest = errors
            .iter()
            .rev()
            .find(|error| error.is_finite())
            .map_or(data.tolerance, |e| e.max(data.tolerance));
        let median = errors[errors.len() / 2].max(1e-16);
        let (from, to) = (
            (median.log10() - 2.0).floor(),
            (STEPS * largest.log10()).ceil() / STEPS,
        );
        Self {
            from,
            steps: (STEPS * (to - from)) as u32,
        }
    }

    fn range(&self) -> [f64; 2] {
        [0, self.steps].map(|step| self.value(step))
    }

    /// Returns the smallest error of a step.
    fn value(&self, step: u32) -> f64 {
        10_f64.powf(self.from + f64::from(step) / STEPS)
    }

    fn step(&self, error: f64) -> u32 {
        let step = STEPS * (error.log10() - self.from);
        // NaN counts as the largest error.
        if step.is_nan() {
            self.steps - 1
        } else {
            step.clamp(0.0, f64::from(self.steps - 1)) as u32
        }
    }

    fn colour(&self, step: u32) -> Colour {
        viridis(f64::from(step) / f64::from((self.steps - 1).max(1)))
    }
}

/// Returns a colour of the map viridis of van der Walt and Smith (2015), whose steps look equal to
/// colour-blind people too, and in grey.
fn viridis(part: f64) -> Colour {
    const STOPS: [[u8; 3]; 9] = [
        [68, 1, 84],
        [71, 45, 123],
        [59, 82, 139],
        [44, 114, 142],
        [33, 145, 140],
        [40, 174, 128],
        [94, 201, 98],
        [173, 220, 48],
        [253, 231, 37],
    ];
    let place = part.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let below = (place as usize).min(STOPS.len() - 2);
    let [r, g, b] = [0, 1, 2].map(|k| {
        let [low, high] = [below, below + 1].map(|i| f64::from(STOPS[i][k]));
        (low + (high - low) * (place - below as f64)).round() as u8
    });
    Colour(r, g, b)
}
