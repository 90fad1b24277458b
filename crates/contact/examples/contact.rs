//! Shows the results that a contact gives: pull-off, equilibria, energy release rates, derivatives,
//! force-displacement curves, the effect of the film on a JKR fit, the validity of the model, and a
//! contact line with hysteresis: `cargo run --release -p coated-contact-contact --example contact`.
use contact::{Contact, Control, Hysteresis, Input};
use interp::{Elastic, Probe, System, Table};

fn main() -> Result<(), contact::Error> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film: Elastic::new(3.5e6, 0.5)?,
        film_thickness: 1e-5,
        substrate: Elastic::new(2e11, 0.25)?,
    };
    // Without derivatives, `contact` is enough.
    let contact = Contact::in_table_with_gradient(Table::embedded(), &system)?;
    let w = 0.040; // work of adhesion, J/m^2
    let mut report = String::new();

    let spring = Control::Spring { stiffness: 50.0 };
    for control in [Control::Load, Control::Displacement, spring] {
        let pull_off = contact.pull_off(w, control)?;
        let (load, radius) = (pull_off.load, pull_off.contact_radius);
        report += &format!("pull-off, {control:?}: {load:.4e} N, a = {radius:.3e} m\n");
    }
    let equilibria = contact.equilibria(w, Control::Load)?;
    let a = equilibria.unloading(1e-4)?.contact_radius;
    let a0 = contact.zero_load(w)?.contact_radius;
    report += &format!("contact radius at 0.1 mN: {a:.4e} m, without a load: {a0:.4e} m\n");
    let g = contact.energy_release_rate_at_load(70e-6, 1e-5)?;
    report += &format!("energy release rate where 70 um are measured at 10 uN: {g:.4} J/m^2\n");

    let gradient = contact.gradient(a, w)?;
    for (input, value) in [
        (Input::SphereModulus, 2e6),
        (Input::FilmModulus, 3.5e6),
        (Input::FilmThickness, 1e-5),
    ] {
        let (name, change) = (input.name(), 0.01 * value * gradient.by(input)?.load);
        report += &format!("1 % more {name} changes the load by {change:+.2e} N\n");
    }

    // To a penetration of 1 um and back: stable branches of 100 states each, with the jumps.
    let equilibria = contact.equilibria(w, Control::Displacement)?;
    for jump in equilibria.force_displacement(1e-6, 100)?.jumps {
        let (before, after) = (jump.from, jump.to.map_or(0.0, |to| to.load));
        let (penetration, load) = (before.penetration, before.load);
        report += &format!("jump at {penetration:.2e} m from {load:.2e} N to {after:.2e} N\n");
    }

    // A fit of JKR, which ignores the film, to 20 points between these contact radii.
    let bias = contact.film_bias(w, [40e-6, 130e-6], 20)?;
    let [modulus, adhesion] = [bias.modulus, bias.work_of_adhesion].map(|bias| 100.0 * bias);
    let large = bias.exceeds(0.03);
    report += &format!("JKR without a film errs by {modulus:+.1} % in E*, {adhesion:+.1} % in w; ");
    report += &format!("above 3 %: {large}\n");
    // An attraction over 1 nm.
    let range = contact.zone_size(w, 1e-9)?;
    let (ratio, tabor) = (contact.validity(a)?.a_over_r, range.tabor);
    let jkr = range.is_jkr();
    report += &format!("a/R = {ratio:.3}, Tabor's parameter {tabor:.0}, in the JKR limit: {jkr}\n");

    // A line that gains 0.03 J/m^2 where it advances and costs 0.05 J/m^2 where it recedes.
    let mut line = contact.line(Hysteresis::new(0.03, 0.05)?, 50e-6)?;
    for load in [1e-3, 0.5e-3, -0.1e-3] {
        let state = line.impose(Control::Load, load)?;
        let radius = state.map_or(0.0, |state| state.contact_radius);
        report += &format!("brought to {load:+.1e} N: a = {radius:.3e} m\n");
    }
    // Printed at once, because a reader such as `head` may close the pipe after some lines.
    print!("{report}");
    Ok(())
}
