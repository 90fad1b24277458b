//! Scenes with fewer axes or quantities: their values are those of the full table, and nothing else
//! is computed or kept.

use std::sync::atomic::{AtomicUsize, Ordering};

use acceptance::{assert_matches, assert_names, larger, material, shipped};
use interp::{Parameter, Quantity};
use tabulate::table::{Extent, Plan, Scene, Values, sweep};

const FULL: &str = "\
title = 'Everything'
tolerance = 1e-6
a_over_t = { from = 1e-2, to = 1e2, nodes = 7 }
e1_over_e2 = { from = 1e-2, to = 1e2, nodes = 5 }
nu1 = { from = 0.2, to = 0.5, nodes = 3 }
e0_over_e2 = { from = 1, to = 1e4, nodes = 3 }
";
const A_OVER_T: (&str, &str) = (
    "a_over_t = { from = 1e-2, to = 1e2, nodes = 7 }",
    "a_over_t = 1",
);
const E1: (&str, &str) = (
    "e1_over_e2 = { from = 1e-2, to = 1e2, nodes = 5 }",
    "e1_over_e2 = 1",
);
const NU1: (&str, &str) = ("nu1 = { from = 0.2, to = 0.5, nodes = 3 }", "nu1 = 0.5");
const E0: (&str, &str) = (
    "e0_over_e2 = { from = 1, to = 1e4, nodes = 3 }",
    "e0_over_e2 = 1e4",
);

/// Solves a scene. Returns its axes and values, and the number of contacts solved.
fn solved(text: &str) -> (Scene, [Vec<f64>; 4], Values, usize) {
    let scene = Scene::parse(text, None).expect("a sound scene");
    let plan = Plan::new(&scene).expect("its nodes are stated");
    let axes = plan.axes(&scene);
    let count = AtomicUsize::new(0);
    let values = sweep(&scene, &axes, &|points| {
        count.fetch_add(points, Ordering::Relaxed);
    });
    let values = values.expect("within reach");
    let nodes = axes.map(|(_, nodes)| nodes);
    (scene, nodes, values, count.into_inner())
}

/// The values are those of the solve, also of a rigid sphere and a rigid substrate: limits, which no
/// range holds.
#[test]
fn what_is_settled_costs_nothing_and_changes_nothing() {
    const RIGID_SPHERE: (&str, &str) = (E1.0, "e1_over_e2 = 0");
    const RIGID_SUBSTRATE: (&str, &str) = (E0.0, "e0_over_e2 = inf");
    let mut worst = 0.0;
    for (changes, points) in [
        (&[NU1][..], 7 * 5 * 3),
        (&[E0], 7 * 5 * 3),
        (&[E1], 7 * 3 * 3),
        (&[A_OVER_T], 5 * 3 * 3),
        (&[NU1, E0], 7 * 5),
        (&[E1, NU1, E0], 7),
        (&[A_OVER_T, E1, NU1, E0], 1),
        (&[RIGID_SUBSTRATE], 7 * 5 * 3),
        (&[RIGID_SPHERE], 7 * 3 * 3),
        (&[RIGID_SPHERE, RIGID_SUBSTRATE], 7 * 3),
    ] {
        let fixed = |text: String, (range, fixed): &(&str, &str)| text.replace(range, fixed);
        let text = changes.iter().fold(FULL.to_owned(), fixed);
        let (scene, [xs, e1s, nu1s, e0s], values, count) = solved(&text);
        assert_eq!(count, points, "{text}");
        let values = values.map(|values| values.expect("asked for"));
        assert!(values.iter().all(|values| values.len() == points), "{text}");
        let mut nodes = 0..points;
        for &x in &xs {
            for &e1 in &e1s {
                for &nu1 in &nu1s {
                    for &e0 in &e0s {
                        let own = material([e1, nu1, e0, scene.nu0.under(nu1)]);
                        let truth = acceptance::solved(x, &own, 1e-9);
                        let node = nodes.next().expect("as many as values");
                        for quantity in Quantity::ALL {
                            let value = values[quantity as usize][node];
                            worst = larger(worst, (value / truth.get(quantity) - 1.0).abs());
                        }
                    }
                }
            }
        }
    }
    println!("settled parameters: largest difference {worst:.1e}");
    // Panels are chosen for all materials of a sweep together, and at a/t above 10 one sphere on a
    // film is solved by the Wiener-Hopf method, many by Galerkin's. Measured: 1.4e-10, where solves
    // to 1e-8 are asked for.
    assert!(worst <= 1e-9);
}

#[test]
fn quantities_that_are_not_asked_for_are_not_kept_and_the_others_are_the_same() {
    let (_, _, full, all) = solved(FULL);
    assert_eq!(all, 7 * 5 * 3 * 3);
    for quantities in [
        &[Quantity::Pi0, Quantity::Delta0][..],
        &[Quantity::Pi0, Quantity::Eeq, Quantity::Gamma],
        &[Quantity::Eeq],
    ] {
        let names: Vec<&str> = quantities.iter().map(|quantity| quantity.name()).collect();
        let (scene, _, values, count) = solved(&format!("quantities = {names:?}\n{FULL}"));
        assert_eq!((scene.quantities.as_slice(), count), (quantities, all));
        for quantity in Quantity::ALL {
            let [all, found] = [&full, &values].map(|of| of[quantity as usize].as_ref());
            let expected = all.filter(|_| quantities.contains(&quantity));
            assert_eq!(found, expected, "{}", quantity.name());
        }
    }
}

#[test]
fn the_shipped_scenes_settle_what_their_names_say() {
    use Parameter::{AOverT, E0OverE2, E1OverE2, Nu1};
    for (name, fixed, quantities) in [
        ("paper", &[(Nu1, 0.5), (E0OverE2, 1e5)][..], 4),
        ("default", &[], 4),
        ("incompressible", &[(Nu1, 0.5)], 4),
        ("rigid-substrate", &[(E0OverE2, f64::INFINITY)], 4),
        ("rigid-sphere", &[(E1OverE2, 0.0)], 4),
        ("adhesionless", &[], 2),
    ] {
        let scene = Scene::read(&shipped(&format!("{name}.toml")), None).expect("a sound scene");
        assert_eq!(scene.quantities.len(), quantities, "{name}");
        for parameter in [AOverT, E1OverE2, Nu1, E0OverE2] {
            let settled = fixed.iter().find(|(settled, _)| *settled == parameter);
            let found = scene.extents[parameter as usize];
            match settled {
                Some(&(_, value)) => assert_eq!(found, Extent::Fixed(value), "{name}"),
                None => assert_matches!(found, Extent::Range { .. }),
            }
        }
        assert_names(&scene.text, &["title", "tolerance"]);
    }
}

#[test]
fn a_plan_obeys_stated_nodes_and_asks_for_more_where_the_tolerance_is_smaller() {
    let scene = |tolerance: &str| {
        let text = "title = 'x'\ntolerance = T\na_over_t = { from = 1e-2, to = 1e2 }\ne1_over_e2 = { from = 0.1, to = 10, nodes_per_decade = 4 }\n\
                    nu1 = { from = 0.3, to = 0.5, nodes = 6 }\ne0_over_e2 = inf\n";
        Scene::parse(&text.replace('T', tolerance), None).expect("a sound scene")
    };
    let shape = |tolerance| Plan::new(&scene(tolerance)).expect("within reach").nodes;
    let shapes = ["1e-3", "1e-5", "1e-7"].map(shape);
    println!("{shapes:?}");
    assert!(shapes.iter().all(|shape| shape[1..] == [9, 6, 1]));
    assert!(shapes.is_sorted_by(|a, b| a[0] < b[0]));
    // The plan does not depend on the number of threads.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    assert_eq!(pool.install(|| shape("1e-5")), shapes[1]);
    let scene = scene("1e-5");
    let [_, (_, e1), ..] = Plan::new(&scene).expect("within reach").axes(&scene);
    assert!(
        (e1[4] - 1.0).abs() <= 1e-15 && (e1[0], e1[8]) == (0.1, 10.0),
        "{e1:?}"
    );
}
