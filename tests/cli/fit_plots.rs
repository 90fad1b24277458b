//! The pictures of `tabulate fit --plot`.

use acceptance::{Workdir, assert_names, workdir};

/// A lens on a half-space, which is a straight line in the reduced JKR plot.
const BODIES: &str = "--half-space --sphere-radius 1e-3 --sphere-modulus inf --film-modulus 1.5e6 \
     --film-poisson-ratio 0.5 --work-of-adhesion 0.04";
/// The blue of the approach and the vermilion of the retract.
pub const COLOURS: [&str; 2] = ["#0072b2", "#d55e00"];
/// The grey of the points that are left out or far off.
const GREY: &str = "#5a5a5a";

/// Writes `lens.csv` with both directions, whose loads are wrong by an offset.
fn simulate(workdir: &Workdir) {
    let plan = "simulate --kind load-radius --from 4.2e-5 --to 1.3e-4 --segments cycle --points 30 \
         --noise 1e-9 --value load-offset=2e-5 -o lens.csv";
    workdir.succeed(format!("{plan} {BODIES}"));
}

fn fit(workdir: &Workdir, more: &str) {
    let free = "--free film-modulus,work-of-adhesion,load-offset";
    workdir.succeed(format!("fit lens.csv {BODIES} {free} {more}"));
}

/// Returns where the outlines of the markers of a colour begin, at the right of each: a tenth of a
/// pixel is 1.
pub fn markers(svg: &str, colour: &str) -> Vec<[f64; 2]> {
    let stroke = format!("stroke=\"{colour}\"");
    svg.split("<path")
        .filter(|path| path.contains(&stroke) && path.contains(" C "))
        .map(|path| {
            let (_, outline) = path.split_once(" d=\"M ").expect("an outline");
            let mut numbers = outline.split(' ').map(str::parse::<f64>);
            [(); 2].map(|()| numbers.next().expect("two numbers").expect("a number"))
        })
        .collect()
}

#[test]
fn a_half_space_is_a_straight_line_of_the_jkr_plot() {
    let workdir = workdir!();
    simulate(&workdir);
    fit(&workdir, "--plot jkr.svg --plot-kind jkr");
    let svg = workdir.text("jkr.svg");
    let [points, back] = COLOURS.map(|colour| markers(&svg, colour));
    assert_eq!([points.len(), back.len()], [30; 2]);
    let [[x0, y0], [x1, y1]] = [points[0], points[29]];
    assert!((x1 - x0).abs() > 3000.0 && (y0 - y1).abs() > 2000.0);
    for [x, y] in points {
        let line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
        assert!((y - line).abs() < 15.0, "{y} beside {line}");
    }
    // The measured data are drawn beside their residuals.
    fit(&workdir, "--plot data.svg --plot-kind data");
    fit(&workdir, "--plot default.svg");
    assert!(workdir.read("data.svg") == workdir.read("default.svg"));
    let svg = workdir.text("data.svg");
    assert_eq!(COLOURS.map(|colour| markers(&svg, colour).len()), [60; 2]);
}

/// Of thousands of points a part is drawn, but all that are far off, since a label names them.
#[test]
fn no_point_that_is_far_off_is_missing_among_thousands() {
    let workdir = workdir!();
    let plan = "simulate --kind load-radius --from 4.2e-5 --to 1.3e-4 --points 4000 --noise 1e-6";
    let data = workdir.succeed(format!("{plan} {BODIES}"));
    let mut lines: Vec<String> = data.lines().map(str::to_owned).collect();
    for line in [500, 1501, 3332] {
        let (radius, _) = lines[line].split_once(',').expect("two columns");
        lines[line] = format!("{radius},0.5");
    }
    workdir.write("lens.csv", lines.join("\n"));
    let run = workdir.run(format!(
        "fit lens.csv {BODIES} --free film-modulus,work-of-adhesion --robust soft-l1 --plot data.svg"
    ));
    assert_names(&run.stdout, "3 of 4000 points; 501, 1502, 3333");
    let svg = workdir.text("data.svg");
    // In the panel of the data and in that of the residuals.
    assert_eq!(markers(&svg, GREY).len(), 2 * 3);
}

#[test]
fn what_has_no_jkr_plot_is_refused_before_anything_is_written() {
    let workdir = workdir!();
    let plan =
        "simulate --kind penetration-radius --from 4.2e-5 --to 1.3e-4 --noise 1e-9 -o depth.csv";
    workdir.succeed(format!("{plan} {BODIES}"));
    let fit = "fit depth.csv --csv points.csv --plot jkr.svg";
    workdir.refuses(format!(
        "
        1 | {fit} {BODIES} --plot-kind jkr | --plot-kind jkr; depth.csv; contact radii
        2 | fit depth.csv --plot-kind jkr | --plot
        1 | {fit} {BODIES} --plot-kind speed | --plot-kind speed; depth.csv; does not depend on the speed
        2 | fit depth.csv --plot a.svg --plot-kind line | data; jkr; speed
        "
    ));
    assert_eq!(workdir.files(), ["depth.csv"]);
}
