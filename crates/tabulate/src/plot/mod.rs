//! The figures of the program, drawn by the crate `figures`.
//!
//! Each figure is a module of its own: `figure` describes it as panels of a chart, and `data`, where there is one,
//! computes its data. [`paper`] holds the system that several figures show.

pub(crate) mod contact_stiffness;
pub(crate) mod effects;
pub mod error_map;
pub mod fig2;
pub mod fig3;
pub mod fig4;
pub(crate) mod fit;
pub mod force_displacement;
pub(crate) mod friction;
pub mod interface;
pub(crate) mod line_speed;
pub(crate) mod lookup_cost;
pub mod paper;
pub(crate) mod pull_off;
pub(crate) mod relaxation;
pub(crate) mod table_cost;
pub(crate) mod work_precision;

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::{
        effects, fig2, fig3, fig4, force_displacement, friction, interface, lookup_cost, pull_off,
        relaxation, table_cost, work_precision,
    };
    use crate::hostile::each_damaged;
    use crate::measure::{read_csv, rows};
    use cost::Measurement;
    use csv::{ReaderBuilder, StringRecord};
    use figures::Error;
    use figures::chart::Figure;
    use figures::picture::Format;
    use interp::Probe;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;
    use solve::stack::Interface;

    /// Replaces each number in a row of shipped measurements by numbers that no measurement gives. The
    /// summary and the figure show it, or it is named. Those in `outside` are refused by the range of
    /// their column.
    fn assert_shown_or_named<R: Measurement>(
        name: &str,
        figure: fn(&[R]) -> Result<Figure, Error>,
        summary: fn(&[R]) -> String,
        outside: &[&str],
    ) {
        let sound = fs::read(path(name)).expect("shipped");
        let sound: Vec<StringRecord> = ReaderBuilder::new()
            .has_headers(false)
            .from_reader(&*sound)
            .records()
            .collect::<Result<_, _>>()
            .expect("sound");
        let mut refused = Vec::new();
        for (column, name) in sound[0].iter().enumerate() {
            let is_number = sound[2][column].parse::<f64>().is_ok();
            let values = ["0", "inf", "-1", "1e300", "NaN"];
            for value in values.into_iter().take(if is_number { 5 } else { 1 }) {
                let mut writer = csv::Writer::from_writer(Vec::new());
                for (i, record) in sound.iter().enumerate() {
                    let field = |(k, field)| if (i, k) == (2, column) { value } else { field };
                    let fields = record.iter().enumerate().map(field);
                    writer.write_record(fields).expect("in memory");
                }
                let bytes = writer.into_inner().expect("in memory");
                let (message, words) = match rows::<R>(&*bytes) {
                    Err(error) => (error.to_string(), &["line 3"][..]),
                    Ok(rows) => {
                        summary(&rows);
                        let Err(error) = figure(&rows).and_then(|figure| figure.picture()) else {
                            continue;
                        };
                        (
                            error.to_string(),
                            &["there is no row", "each row must save"][..],
                        )
                    }
                };
                let is_named = words.iter().any(|words| message.contains(words));
                assert!(is_named, "{name} = {value}: {message}");
                refused.push(message);
            }
        }
        assert!(refused.len() > 25, "{name}: {refused:?}");
        for number in outside {
            let words = format!("line 3: {number} is outside");
            let is_refused = refused.iter().any(|message| message.contains(&words));
            assert!(is_refused, "{words}: {refused:?}");
        }
    }

    /// Damages shipped measurements, reads them, and draws every 50th of those that are accepted.
    fn damage<R: Measurement>(name: &str, figure: fn(&[R]) -> Result<Figure, Error>) {
        const WORDS: &str = ",|\"|\n|0|-|inf|-inf|nan|1e300|1e-300|e29|e-11|18446744073709551615|\
             999999999999999|\u{1b}[2J|é";
        let sound = fs::read(path(name)).expect("shipped");
        let (mut refused, mut accepted, mut drawn) = (0, 0, 0);
        each_damaged(&sound, WORDS, 5, |_, bytes| {
            let Ok(rows) = rows::<R>(bytes) else {
                refused += 1;
                return;
            };
            accepted += 1;
            if accepted % 50 == 0 {
                let picture = figure(&rows).and_then(|figure| figure.picture());
                drawn += usize::from(picture.is_ok_and(|p| p.encode(Format::Svg).is_ok()));
            }
        });
        println!("{name}: {refused} refused, {accepted} accepted, {drawn} drawn");
        assert!(refused > 0 && drawn > 0);
    }

    /// Asserts that no text of a figure collides with a line, a marker, another text or the edge.
    fn assert_clear(name: &str, figure: &Figure) {
        let (_, colliding) = figure.drawn().expect("a picture");
        assert!(colliding.is_empty(), "{name}: {colliding:?}");
    }

    /// Returns the path of shipped measurements.
    fn path(name: &str) -> PathBuf {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tables/figures");
        folder.join(name)
    }

    fn shipped<R: Measurement>(name: &str) -> Vec<R> {
        read_csv(&path(name)).expect("shipped")
    }

    #[test]
    fn the_texts_of_the_shipped_figures_collide_with_nothing() {
        let probe = Probe::Paraboloid { radius: 1e-3 };
        let films = force_displacement::data(&probe, Interface::Bonded).expect("within reach");
        assert_clear(
            "force-displacement",
            &force_displacement::figure(&films, &probe, Interface::Bonded),
        );
        let lookup = lookup_cost::figure(&shipped("lookup.csv")).expect("rows");
        assert_clear("lookup-cost", &lookup);
        let solve = work_precision::figure(&shipped("solve.csv")).expect("rows");
        assert_clear("work-precision", &solve);
        assert_clear("table-cost", &table_cost::figure(&shipped("table.csv")));
        let effects = effects::figure(&shipped("effects.csv")).expect("rows");
        assert_clear("effects", &effects);
        assert_clear("fig2", &fig2::figure().expect("within reach"));
        assert_clear("fig3", &fig3::figure().expect("within reach"));
        assert_clear("fig4", &fig4::figure().expect("within reach"));
        assert_clear("friction", &friction::figure().expect("within reach"));
        assert_clear("pull-off", &pull_off::figure().expect("within reach"));
        assert_clear("relaxation", &relaxation::figure().expect("within reach"));
        assert_clear("interface", &interface::figure().expect("within reach"));
    }

    /// Asserts that the texts collide with nothing in figures of other times, as another run of the
    /// measurements would find them: each is multiplied by a number from 0.6 to 1.
    fn assert_clear_at_other_times<R: Measurement + Clone>(
        name: &str,
        times: fn(&mut R) -> Vec<&mut f64>,
        figure: fn(&[R]) -> Result<Figure, Error>,
    ) {
        let shipped = shipped::<R>(&format!("{name}.csv"));
        let mut random = Pcg64::seed_from_u64(1);
        for draw in 0..4 {
            let mut rows = shipped.clone();
            for time in rows.iter_mut().flat_map(times) {
                *time *= random.random_range(0.6..1.0);
            }
            assert_clear(&format!("{name} {draw}"), &figure(&rows).expect("rows"));
        }
    }

    #[test]
    fn the_texts_collide_with_nothing_if_a_run_measures_other_times() {
        assert_clear_at_other_times(
            "lookup",
            |row: &mut cost::lookup::Row| vec![&mut row.seconds],
            lookup_cost::figure,
        );
        assert_clear_at_other_times(
            "solve",
            |row: &mut cost::solve::Row| vec![&mut row.seconds],
            work_precision::figure,
        );
        assert_clear_at_other_times(
            "table",
            |row: &mut cost::table::Row| {
                vec![
                    &mut row.seconds,
                    &mut row.pack_seconds,
                    &mut row.solve_seconds,
                    &mut row.curve_seconds,
                ]
            },
            |rows| Ok(table_cost::figure(rows)),
        );
        assert_clear_at_other_times(
            "effects",
            |row: &mut cost::effects::Row| row.saved_seconds.iter_mut().collect(),
            effects::figure,
        );
    }

    #[test]
    fn damaged_measurements_are_refused_or_drawn() {
        damage("table.csv", |rows| Ok(table_cost::figure(rows)));
        damage("effects.csv", effects::figure);
        damage("lookup.csv", lookup_cost::figure);
        damage("solve.csv", work_precision::figure);
    }

    #[test]
    fn a_measurement_that_cannot_be_shown_is_named() {
        let table = |rows: &[cost::table::Row]| Ok(table_cost::figure(rows));
        let numbers = &["solve_seconds = 0"];
        assert_shown_or_named("table.csv", table, cost::table::markdown, numbers);
        let (figure, markdown) = (effects::figure, cost::effects::markdown);
        assert_shown_or_named("effects.csv", figure, markdown, &["worst_error = inf"]);
        let numbers = &["seconds = 0", "seconds = inf", "max_error = 1e300"];
        assert_shown_or_named(
            "lookup.csv",
            lookup_cost::figure,
            cost::lookup::markdown,
            numbers,
        );
        let (figure, markdown) = (work_precision::figure, cost::solve::markdown);
        assert_shown_or_named("solve.csv", figure, markdown, &["tolerance = 0"]);
    }
}
