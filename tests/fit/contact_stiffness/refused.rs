//! Contact stiffnesses that no measurement has, and parameters that they do not tell.

use acceptance::Refused;
use fit::{Direction, Experiment, Kind, Parameter, simulate};
use interp::Table;

use super::{at_radii, fitted, oxide};

#[test]
fn what_is_no_contact_stiffness_is_refused() {
    let good = at_radii(&oxide(), [1e-7, 1e-6], 8);
    let with = |change: fn(&mut Experiment)| {
        let mut wrong = good.clone();
        change(&mut wrong);
        fitted(wrong, [Parameter::FilmModulus])
    };
    with(|one| one.measurement.points[3].ordinate = 0.0).refused("line 4; contact stiffness");
    with(|one| one.measurement.points[2].abscissa = -1e-7).refused("line 3");
    with(|one| one.measurement.points[2].ordinate = f64::NAN).refused("line 3; NaN");
    with(|one| one.indentation.beta = 0.0).refused("beta; 0.5 to 2");
    with(|one| one.indentation.epsilon = -1.0).refused("epsilon; 0 to 2");
    with(|one| one.indentation.thinning = 0.3).refused("thinning; depth");
    with(|one| one.indentation.frame_compliance = -1e-6).refused("frame-compliance; at least 0");
    with(|one| one.indentation.frame_compliance = 0.1).refused("frame; line 1");
    with(|one| one.indentation.phases = vec![0.1; 3]).refused("phases; 8");
    with(|one| one.indentation.phases = vec![2.0; 8]).refused("phase; rad");
    with(|one| one.noise = Some(0.0)).refused("noise");
    let with_loads = |change: &dyn Fn(&mut Experiment)| {
        let mut wrong = good.clone();
        wrong.measurement.kind = Kind::StiffnessLoad;
        change(&mut wrong);
        fitted(wrong, [Parameter::FilmModulus])
    };
    with_loads(&|one| one.indentation.hardness = Some(-1.0)).refused("hardness; positive");
    with_loads(&|one| one.indentation.hardness = Some(0.0)).refused("hardness; positive");
    with_loads(&|one| one.indentation.phases = vec![0.1; 8]).refused("viscous; hardness");
    for load in [-1e-6, 0.0] {
        let refused = with_loads(&|one| {
            one.measurement.points[2].abscissa = load;
            one.abscissa_noise = 1e-6;
        });
        refused.refused("load; line 3; tension");
    }
    with_loads(&|one| one.measurement.points[0].direction = Some(Direction::Retract))
        .refused("unloaded; line 1");
    with(|one| one.measurement.kind = Kind::StiffnessDepth).refused("loads; 8");
    let depths = with(|one| {
        one.measurement.kind = Kind::StiffnessDepth;
        one.indentation.loads = vec![1.0; 8];
    });
    depths.refused("contact depth; line 1");
    // What a fit refuses of the settings, no simulation and no prediction takes.
    for (change, words) in [
        (
            (|one| one.indentation.hardness = Some(-1e9)) as fn(&mut Experiment),
            "hardness; positive",
        ),
        (|one| one.indentation.epsilon = 5.0, "epsilon; 0 to 2"),
        (|one| one.indentation.beta = f64::INFINITY, "beta; 0.5 to 2"),
    ] {
        let mut wrong = good.clone();
        change(&mut wrong);
        simulate(Table::embedded(), &wrong, 0.0, 1).refused(words);
        wrong
            .predictions(Table::embedded(), None, &[])
            .refused(words);
    }
    for (parameter, word) in [
        (Parameter::Hardness, "load"),
        (Parameter::TipRounding, "depth"),
        (Parameter::WorkOfAdhesion, "adhesion"),
        (Parameter::ContactPoint, "tip-rounding"),
        (Parameter::LoadOffset, "contact stiffness"),
        (Parameter::Stiffness, "cantilever"),
    ] {
        fitted(good.clone(), [parameter]).refused(&[word, &*parameter.name()]);
    }
}
