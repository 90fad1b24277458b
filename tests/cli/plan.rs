//! `tabulate generate --plan`: the size that it expects of the file.

use std::thread;

use acceptance::{json, number, workdir};

use crate::TWO_QUANTITIES;

/// Three planned axes, a few hundred kB.
const MIDDLE: &str = "
    title      = 'Incompressible films'
    tolerance  = 1e-5
    a_over_t   = { from = 1e-2, to = 1e2 }
    e1_over_e2 = { from = 0.1, to = 10 }
    nu1        = 0.5
    e0_over_e2 = { from = 1, to = 1e6 }
";
const ONE_QUANTITY: &str = "
    title      = 'One quantity'
    tolerance  = 1e-1
    quantities = ['eeq']
    a_over_t   = { from = 0.1, to = 10, nodes = 4 }
    e1_over_e2 = 1
    nu1        = 0.5
    e0_over_e2 = inf
";

#[test]
fn the_size_of_a_plan_is_that_of_the_file() {
    /// The largest factor between them, either way.
    const FACTOR: f64 = 1.15;
    let workdir = workdir!();
    for scene in [ONE_QUANTITY, TWO_QUANTITIES, MIDDLE] {
        workdir.write("scene.toml", scene);
        let plan = workdir.json("generate scene.toml --plan --json");
        let expected = number(&plan, "bytes");
        let text = workdir.succeed("generate scene.toml --plan");
        let size = format!("{:15} about {:.0} kB\n", "size", expected / 1e3);
        assert!(text.contains(&size), "{text}{size}");
        // Nodes that the scene states are not changed.
        let may_be_made_again = text.contains("is made again with more nodes");
        assert_eq!(may_be_made_again, scene == MIDDLE, "{text}");

        let made = workdir.run("generate scene.toml --certificate-points 20 --json");
        let made = json(&made.stdout);
        let bytes = number(&made, "bytes");
        let are_near = bytes <= FACTOR * expected && expected <= FACTOR * bytes;
        assert!(are_near, "{bytes} bytes, {expected} planned: {scene}");
        assert_eq!(plan["axes"], made["axes"]);
        // The curves of a million points of a certificate count 300 s of one thread, whatever the solves take.
        let planned =
            workdir.json("generate scene.toml --plan --json --certificate-points 1000000");
        let seconds = number(&planned, "seconds") - number(&plan, "seconds");
        let threads = thread::available_parallelism().expect("a number").get();
        assert!(seconds * threads as f64 > 200.0, "{planned}");
        assert_eq!(plan["points"], made["points_solved"]);
    }
}
