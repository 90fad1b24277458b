//! `tabulate plot`: the data of the figures, and the files.

use std::f64::consts::PI;

use acceptance::{Refused, assert_near, ends, error_at, material, shipped, workdir};
use contact::{ForceDisplacement, Jump, State};
use interp::{Parameter, Probe, Quantity, Table};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Node, Options, Tree};
use solve::stack::Interface;
use tabulate::plot::{error_map, fig4, force_displacement, interface, paper};

/// The width of every figure in pixels.
const WIDTH: u32 = 840;
/// The number of pixels of a PNG, along each side, for a pixel of the figure.
const SCALE: u32 = 2;

/// The figures that need direct solves only.
const OF_THE_PAPER: [&str; 4] = ["fig2", "fig3", "fig4", "force-displacement"];

fn close(value: f64, truth: f64, tolerance: f64, what: &str) {
    let is_close = (value / truth - 1.0).abs() <= tolerance;
    assert!(is_close, "{what}: {value}, not {truth}");
}

#[test]
fn fig2_goes_from_one_published_limit_to_the_other() {
    let (pi0, limits) = paper::line(Quantity::Pi0).unwrap();
    // The substrate is 1e5 times as stiff as the sphere: the paper's 8/3 to 1e-5.
    close(limits[0], 8.0 / 3.0 * 0.7, 1e-14, "thick film");
    close(limits[1], 8.0 / 3.0, 1.1e-5, "thin film");
    let (first, last) = (pi0[0], pi0[pi0.len() - 1]);
    assert_eq!([first[0], last[0]], [1e-3, 1e3]);
    close(first[1], limits[0], 1e-6, "at 0.001");
    close(last[1], limits[1], 1e-3, "at 1000");
    let does_rise = pi0.is_sorted_by(|a, b| a[0] < b[0] && a[1] < b[1]);
    assert!(does_rise, "{pi0:?}");
}

/// From Hertz on a thick film to springs of the stiffness `E1*/t` under one that slides, `(pi/2) (x +
/// 2 c)` with `c = 0.3543`.
#[test]
fn the_interface_matters_between_hertz_and_the_springs_of_a_sliding_film() {
    let lines = interface::data().unwrap();
    assert_eq!(lines.len(), 5);
    for line in &lines {
        close(line[0][1], 8.0 / 3.0, 0.05, "thick film");
        assert!(line.is_sorted_by(|a, b| a[0] < b[0] && a[1] < b[1]));
    }
    let last: Vec<_> = lines.iter().map(|line| line[line.len() - 1]).collect();
    assert!(last.is_sorted_by(|a, b| a[1] > 1.2 * b[1]), "{last:?}");
    let [x, sliding] = last[4];
    close(sliding, PI / 2.0 * (x + 2.0 * 0.3543), 1e-3, "sliding film");
}

#[test]
fn fig3_goes_from_and_to_the_published_limits() {
    let [(eeq, of_eeq), (gamma, of_gamma)] =
        [Quantity::Eeq, Quantity::Gamma].map(|quantity| paper::line(quantity).unwrap());
    let limits = of_eeq.into_iter().chain(of_gamma);
    for (limit, truth) in limits.zip([0.7, 1.0, 0.7, 0.7_f64.sqrt()]) {
        close(limit, truth, 1.1e-5, "limit");
    }
    for (line, to) in [(&eeq, 1.0), (&gamma, 0.7_f64.sqrt())] {
        let (first, last) = (line[0], line[line.len() - 1]);
        assert_eq!([first[0], last[0]], [1e-3, 1e3]);
        close(first[1], 0.7, 1e-3, "at 0.001");
        close(last[1], to, 1e-3, "at 1000");
    }
    // Gamma^2 = es d(x Eeq)/dx, between neighbouring points of the figure: es (x2 Eeq2 - x1 Eeq1)
    // is the mean of Gamma^2.
    for (eeq, gamma) in eeq.windows(2).zip(gamma.windows(2)) {
        let ([x1, e1], [x2, e2]) = (eeq[0], eeq[1]);
        let square = 0.5 * (gamma[0][1].powi(2) + gamma[1][1].powi(2));
        let rate = 0.7 * (x2 * e2 - x1 * e1) / (x2 - x1);
        close(rate, square, 2e-4, "energy release rate");
    }
}

#[test]
fn fig4_shows_the_lines_of_jkr_and_the_published_radii_at_zero_load() {
    let data = fig4::data().unwrap();
    let (sphere, w) = (2e6_f64, 0.04_f64);
    // F / (sqrt(6 pi) a^(3/2)) = 4 E* / (3 sqrt 6) x - sqrt(4 w E* / 3): JKR in the coordinates of
    // eq. 9.
    for (line, modulus) in [
        (&data.sphere, sphere / (1.0 + 1e-5 * 0.9375)),
        (&data.sphere_film, 0.7 * sphere),
    ] {
        for [x, y] in line {
            let jkr = 4.0 * modulus / (3.0 * 6_f64.sqrt()) * x - (4.0 * w * modulus / 3.0).sqrt();
            assert_near(*y, jkr, 1e-9 * sphere.sqrt());
        }
    }
    // The contact radius at zero load, and its published value.
    let crossing = |line: &[[f64; 2]]| {
        let i = line.iter().position(|[_, y]| *y > 0.0).unwrap();
        let ([x1, y1], [x2, y2]) = (line[i - 1], line[i]);
        let abscissa = x1 - y1 * (x2 - x1) / (y2 - y1);
        (abscissa * PI.sqrt() * 1e-3).powf(2.0 / 3.0)
    };
    close(crossing(&data.sphere), 65.63e-6, 1e-4, "no film");
    for (thickness, radius, tolerance) in [
        (1e-6, 65.77e-6, 1e-4),
        (10e-6, 67.06e-6, 1e-4),
        (100e-6, 73.5e-6, 1e-3),
    ] {
        let mut thicknesses = fig4::THICKNESSES.iter();
        let i = thicknesses.position(|t| *t == thickness).unwrap();
        close(crossing(&data.films[i]), radius, tolerance, "a film");
    }
}

#[test]
fn force_curves_jump_at_what_is_imposed_and_separate_where_jkr_does() {
    for film in force_displacement::data(&paper::PROBE, Interface::Bonded).unwrap() {
        let (displacement, load): (&ForceDisplacement, &ForceDisplacement) =
            (&film.displacement, &film.load);
        for jump in &displacement.jumps {
            assert_near(jump.from.penetration, jump.to.unwrap().penetration, 1e-15);
        }
        for Jump { from, to } in &load.jumps {
            assert_near(from.load, to.map_or(from.load, |to| to.load), 1e-13);
        }
        assert_eq!(displacement.jumps[0].from, State::ORIGIN);
        assert_eq!(load.jumps[0].from, State::ORIGIN);
        if film.thickness == 1e-6 {
            let first = load.jumps[0].to.unwrap().contact_radius;
            close(first, 65.77e-6, 1e-4, "first contact without a load");
        }
        // JKR: 3/2 pi w R at any modulus. A film between thin and thick needs a larger pull.
        let separation = load.jumps.last().unwrap().from.load / (PI * 0.04 * 1e-3);
        let extreme = film.thickness == 1e-6 || film.thickness == 300e-6;
        let is_of_jkr = (separation / -1.5 - 1.0).abs() < 0.01;
        let is_so = if extreme {
            is_of_jkr
        } else {
            separation < -1.5
        };
        assert!(is_so, "{}: {separation}", film.thickness);
    }
}

/// Springs that are stiff enough bond the films. Films that slide yield more, the thinnest the most:
/// with the penetration imposed the load is smaller, and the load of separation is another one.
#[test]
fn films_that_slide_are_drawn_as_well() {
    let of = |interface| force_displacement::data(&paper::PROBE, interface).unwrap();
    let stiff = Interface::Springs {
        tangential: 1e25,
        normal: f64::INFINITY,
    };
    let [bonded, stiff, sliding] = [Interface::Bonded, stiff, Interface::Sliding].map(of);
    let separation = |film: &force_displacement::Film| film.load.jumps.last().unwrap().from.load;
    for ((bonded, stiff), sliding) in bonded.iter().zip(&stiff).zip(&sliding) {
        close(separation(stiff), separation(bonded), 1e-6, "stiff springs");
        let change = separation(sliding) / separation(bonded) - 1.0;
        let is_thin = bonded.thickness < 1e-4;
        assert_eq!(change.abs() > 1e-3, is_thin, "{change}");
    }
    let workdir = workdir!();
    let plot = "plot force-displacement --specimen paper -o sliding.svg";
    workdir.answer(format!("{plot} --interface sliding"));
    workdir.answer(format!("{plot} --interface-stiffness 1e13"));
    workdir.refuses(format!(
        "
        2 | {plot} --interface sliding --probe cone | --interface; --probe
        2 | {plot} --interface sliding --interface-stiffness 1e13 | --interface; --interface-stiffness
        1 | {plot} --interface-stiffness=-1 | layer; -1
        "
    ));
}

#[test]
fn other_probes_separate_from_the_thickest_film_as_from_a_half_space() {
    let (w, modulus) = (0.04_f64, 1.4e6_f64);
    let half_angle = 70_f64.to_radians();
    let slope = half_angle.tan().recip();
    let radius = 1e-6_f64;
    // The least load of `F = pi/2 slope E* a^2 - sqrt(8 pi w E* a^3)` (Maugis and Barquins), and the
    // load at which a punch separates (Kendall). The film is 240 and 300 contact radii thick.
    let cases = [
        (
            Probe::Cone { half_angle },
            -54.0 * w * w / (PI * slope.powi(3) * modulus),
        ),
        (
            Probe::FlatPunch { radius },
            -(8.0 * PI * w * modulus * radius.powi(3)).sqrt(),
        ),
    ];
    for (probe, truth) in cases {
        let films = force_displacement::data(&probe, Interface::Bonded).unwrap();
        let [thin, .., thick] = &films[..] else {
            panic!("{} films", films.len());
        };
        let separation =
            |film: &force_displacement::Film| film.load.jumps.last().unwrap().from.load;
        close(separation(thick), truth, 0.01, probe.name());
        // The stiff substrate is near under the thin film.
        let change = separation(thin) / truth - 1.0;
        assert!(change.abs() > 0.02, "{}: {change}", probe.name());
    }
    let workdir = workdir!();
    let rounded = "--probe rounded-cone --half-angle 70 --sphere-radius 1e-6";
    let plot = "plot force-displacement -o tip.svg";
    assert_eq!(workdir.succeed(format!("{plot} {rounded}")), "");
    let tree = Tree::from_data(&workdir.read("tip.svg"), &Options::default()).unwrap();
    assert_eq!(tree.size().to_int_size().width(), WIDTH);
    workdir.refuses(format!(
        "1 | {plot} --probe cone | --probe cone needs --half-angle\n\
         1 | {plot} --sphere-radius 100mm | films of 1, 30 and 300 um; dimensions of the probe; `tabulate curve`\n\
         1 | {plot} --probe cone --half-angle 89.99 | films of 1, 30 and 300 um; dimensions of the probe\n\
         1 | {plot} --probe sphere --sphere-radius 1um | films of 1, 30 and 300 um; dimensions of the probe"
    ));
}

#[test]
fn the_error_map_finds_what_direct_solves_find() {
    let table = Table::read(shipped("paper.bin")).unwrap();
    let data = error_map::data(&table, &|_| {}).unwrap();
    let [columns, rows] = error_map::CELLS;
    assert_eq!((data.errors.len(), data.errors[0].len()), (rows, columns));
    let parameters = [Parameter::AOverT, Parameter::E1OverE2];
    for (borders, parameter) in data.borders.iter().zip(parameters) {
        let (first, last) = ends(&table, parameter);
        close(borders[0], first, 1e-12, parameter.name());
        close(borders[borders.len() - 1], last, 1e-12, parameter.name());
        assert!(borders.is_sorted_by(|a, b| a < b));
    }
    let errors = data.errors.concat();
    let largest = errors.iter().copied().fold(0.0, f64::max);
    let kept = |error: &f64| (0.0..=data.tolerance).contains(error);
    assert!(errors.iter().all(kept), "{largest:e}");
    // As in `tabulate check`: other random points change the largest error by less than a factor of
    // 3.
    let ratio = largest / data.certified;
    assert!(ratio > 1.0 / 3.0 && ratio < 3.0, "{ratio}");
    // At the middle of a cell the table cannot be much worse than at the worst of many points
    // around it.
    let middle = |k: usize, i: usize| (data.borders[k][i] * data.borders[k][i + 1]).sqrt();
    for (row, column) in [(5, 7), (20, 36), (30, 60), (40, 70)] {
        let material = material([middle(1, row), 0.5, 1e5, 0.25]);
        let error = error_at(&table, middle(0, column), &material);
        let found = data.errors[row][column];
        assert!(error <= 2.0 * found + 1e-11, "{error:e}, {found:e}");
    }
}

/// True if anything in the picture is text.
fn has_text(group: &resvg::usvg::Group) -> bool {
    group.children().iter().any(|node| match node {
        Node::Text(_) => true,
        Node::Group(group) => has_text(group),
        Node::Path(_) | Node::Image(_) => false,
    })
}

#[test]
fn pictures_are_outlines_of_one_size_and_the_same_every_time() {
    let workdir = workdir!();
    for figure in OF_THE_PAPER {
        for name in ["a.svg", "b.svg", "a.png", "b.png"] {
            assert_eq!(workdir.succeed(format!("plot {figure} -o {name}")), "");
        }
        for [a, b] in [["a.svg", "b.svg"], ["a.png", "b.png"]] {
            assert!(workdir.read(a) == workdir.read(b), "{figure} varies");
        }

        let svg = workdir.text("a.svg");
        let holds_text = svg.contains("<text") || svg.contains("font");
        assert!(!holds_text, "{figure}");
        // Well-formed, as wide as a README, and drawn without a font: the parser has none.
        let tree = Tree::from_str(&svg, &Options::default()).unwrap();
        assert!(!has_text(tree.root()));
        let size = tree.size().to_int_size();
        assert_eq!(size.width(), WIDTH, "{figure}");

        // SVG and PNG are equal pictures, to the rounding of coordinates.
        let png = Pixmap::decode_png(&workdir.read("a.png")).unwrap();
        let expected = [SCALE * WIDTH, SCALE * size.height()];
        assert_eq!([png.width(), png.height()], expected, "{figure}");
        let mut pixels = Pixmap::new(png.width(), png.height()).unwrap();
        let scale = Transform::from_scale(SCALE as f32, SCALE as f32);
        resvg::render(&tree, scale, &mut pixels.as_mut());
        let pairs = png.data().iter().zip(pixels.data());
        let apart = pairs.filter(|(a, b)| a.abs_diff(**b) > 32).count();
        assert!(apart * 1000 < png.data().len(), "{figure}: {apart}");
        let pixels = png.pixels().iter();
        let dark = pixels.filter(|pixel| pixel.red() < 128).count();
        assert!(dark > 5000, "{figure} is almost white: {dark} pixels");
    }
}

#[test]
fn the_error_map_is_drawn_of_a_table_given() {
    let workdir = workdir!();
    let table = shipped("paper.h5");
    workdir.succeed(format!("plot error-map {} -o map.svg", table.display()));
    let tree = Tree::from_data(&workdir.read("map.svg"), &Options::default()).unwrap();
    assert_eq!(tree.size().to_int_size().width(), WIDTH);
}

#[test]
fn what_cannot_be_drawn_says_why() {
    let workdir = workdir!();
    workdir.write("no.h5", "no table");
    workdir.refuses(
        "
        2 | plot fig2 -o fig2.pdf | fig2.pdf; .svg or .png
        2 | plot fig2 -o fig2 | fig2; .svg or .png
        2 | plot fig2 -o fig2.SVG.gz | fig2.SVG.gz; .svg or .png
        2 | plot fig5 -o a.svg | fig5
        2 | plot fig2 | --output
        2 | plot fig2 table.h5 -o a.svg | table.h5
        1 | plot fig2 -o nowhere/a.svg | nowhere
        1 | plot error-map none.h5 -o a.svg | none.h5
        1 | plot error-map no.h5 -o a.svg | no.h5
        ",
    );
    assert_eq!(workdir.files(), ["no.h5"]);
}

#[test]
fn a_map_of_what_the_table_fixes_is_refused() {
    let table = acceptance::table(
        "
        title      = 'One film'
        tolerance  = 1e-2
        quantities = ['eeq']
        a_over_t   = { from = 0.1, to = 10, nodes = 9 }
        e1_over_e2 = 1.75
        nu1        = 0.5
        e0_over_e2 = inf
        nu0        = 0.1
        ",
    );
    error_map::data(&table, &|_| {}).refused("e1_over_e2; 1.75");
}
