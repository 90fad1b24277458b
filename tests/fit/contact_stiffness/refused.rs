//! Contact stiffnesses that no measurement has, and parameters that they do not tell.

use fit::{AreaFunction, Direction, Experiment, Kind, Parameter};

use super::{at_radii, fitted, oxide};

#[test]
fn what_is_no_contact_stiffness_is_refused() {
    let good = at_radii(&oxide(), [1e-7, 1e-6], 8);
    let refused = |change: &dyn Fn(&mut Experiment), words: &[&str]| {
        let mut wrong = good.clone();
        change(&mut wrong);
        let error = fitted(wrong, [Parameter::FilmModulus]);
        let error = error.expect_err("refused").to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
        assert!(!error.contains("--"), "{error}");
    };
    refused(
        &|one| one.measurement.points[3].ordinate = 0.0,
        &["line 4", "contact stiffness"],
    );
    refused(
        &|one| one.measurement.points[2].abscissa = -1e-7,
        &["line 3"],
    );
    refused(
        &|one| one.measurement.points[2].ordinate = f64::NAN,
        &["line 3", "NaN"],
    );
    refused(&|one| one.indentation.beta = 0.0, &["beta", "0.5 to 2"]);
    refused(
        &|one| one.indentation.epsilon = -1.0,
        &["epsilon", "0 to 2"],
    );
    refused(
        &|one| one.indentation.thinning = 0.3,
        &["thinning", "depth"],
    );
    refused(
        &|one| one.indentation.frame_compliance = -1e-6,
        &["frame-compliance", "at least 0"],
    );
    refused(
        &|one| one.indentation.frame_compliance = 0.1,
        &["frame", "line 1"],
    );
    refused(
        &|one| one.indentation.phases = vec![0.1; 3],
        &["phases", "8"],
    );
    refused(
        &|one| one.indentation.phases = vec![2.0; 8],
        &["phase", "rad"],
    );
    refused(&|one| one.noise = Some(0.0), &["noise"]);
    for hardness in [-1.0, 0.0] {
        refused(
            &|one| {
                one.measurement.kind = Kind::StiffnessLoad;
                one.indentation.hardness = Some(hardness);
            },
            &["hardness", "positive"],
        );
    }
    refused(
        &|one| {
            one.measurement.kind = Kind::StiffnessLoad;
            one.indentation.phases = vec![0.1; 8];
        },
        &["phases", "elasticity"],
    );
    refused(
        &|one| {
            one.measurement.kind = Kind::StiffnessLoad;
            one.measurement.points[0].direction = Some(Direction::Retract);
        },
        &["unloaded", "line 1"],
    );
    refused(
        &|one| one.measurement.kind = Kind::StiffnessDepth,
        &["loads", "8"],
    );
    refused(
        &|one| {
            one.measurement.kind = Kind::StiffnessDepth;
            one.indentation.loads = vec![1.0; 8];
        },
        &["contact depth", "line 1"],
    );
    for (parameter, word) in [
        (Parameter::Hardness, "load"),
        (Parameter::TipRounding, "depth"),
        (Parameter::WorkOfAdhesion, "adhesion"),
        (Parameter::ContactPoint, "tip-rounding"),
        (Parameter::LoadOffset, "contact stiffness"),
        (Parameter::Stiffness, "cantilever"),
    ] {
        let error = fitted(good.clone(), [parameter]);
        let error = error.expect_err("refused").to_string();
        assert!(
            error.contains(word) && error.contains(&*parameter.name()),
            "{error}"
        );
    }
    for coefficients in [&[][..], &[0.0], &[1.0; 10]] {
        assert!(AreaFunction::new(coefficients).is_err());
    }
}
