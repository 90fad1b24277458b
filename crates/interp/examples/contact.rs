//! The README's program of what a contact answers.
use interp::{Control, Elastic, Hysteresis, Input, System, Table};

fn main() -> Result<(), interp::Error> {
    let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    let system = System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film,
        film_thickness: 1e-5,
        substrate,
    };
    let contact = Table::embedded().contact_with_gradient(&system)?; // without derivatives: `contact`
    let w = 0.040; // work of adhesion, J/m^2

    for control in [
        Control::Load,
        Control::Displacement,
        Control::Spring { stiffness: 50.0 },
    ] {
        let apart = contact.pull_off(w, control)?;
        println!(
            "pull-off, {control:?}: {:.4e} N, a = {:.3e} m",
            apart.load, apart.contact_radius
        );
    }
    let a = contact
        .equilibria(w, Control::Load)?
        .unloading(1e-4)?
        .contact_radius;
    println!(
        "contact radius at 0.1 mN: {a:.4e} m, without a load: {:.4e} m",
        contact.zero_load(w)?.contact_radius
    );
    let measured = contact.energy_release_rate_at_load(70e-6, 1e-5)?;
    println!("energy release rate where 70 um are measured at 10 uN: {measured:.4} J/m^2");

    let gradient = contact.gradient(a, w)?;
    for (input, value) in [
        (Input::SphereModulus, 2e6),
        (Input::FilmModulus, 3.5e6),
        (Input::FilmThickness, 1e-5),
    ] {
        println!(
            "1 % more {} changes the load by {:+.2e} N",
            input.name(),
            0.01 * value * gradient.by(input)?.load
        );
    }

    // To a penetration of 1 um and back: stable branches of 100 states each, and the jumps between
    // them.
    let curve = contact
        .equilibria(w, Control::Displacement)?
        .force_displacement(1e-6, 100)?;
    for jump in &curve.jumps {
        let after = jump.to.map_or(0.0, |to| to.load);
        println!(
            "jump at {:.2e} m from {:.2e} N to {after:.2e} N",
            jump.from.penetration, jump.from.load
        );
    }

    let bias = contact.film_bias(w, [40e-6, 130e-6], 20)?; // of JKR fitted to 20 points at these contact radii
    let [modulus, adhesion] = [bias.modulus, bias.work_of_adhesion].map(|bias| 100.0 * bias);
    println!(
        "JKR without a film errs by {modulus:+.1} % in E*, {adhesion:+.1} % in w; above 3 %: {}",
        bias.exceeds(0.03)
    );
    let (validity, range) = (contact.validity(a)?, contact.adhesion_range(w, 1e-9)?); // attraction over 1 nm
    println!(
        "a/R = {:.3}, Tabor's parameter {:.0}, in the JKR limit: {}",
        validity.a_over_r,
        range.tabor,
        range.is_jkr()
    );

    // A line that gains 0.03 J/m^2 where it advances and costs 0.05 where it recedes.
    let mut line = contact.line(Hysteresis::new(0.03, 0.05)?, 50e-6)?;
    for load in [1e-3, 0.5e-3, -0.1e-3] {
        let radius = line
            .impose(Control::Load, load)?
            .map_or(0.0, |state| state.contact_radius);
        println!("brought to {load:+.1e} N: a = {radius:.3e} m");
    }
    Ok(())
}
