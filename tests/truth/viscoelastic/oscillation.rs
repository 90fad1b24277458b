//! Small oscillations about a state.

use std::f64::consts::PI;

use acceptance::modified_power_law;

use super::{PARABOLOID, half_space, power_law, solid_law};

/// A small oscillation sees the stiffness times the complex modulus; that of a power law has the
/// loss tangent `tan(pi alpha/2)` at every frequency.
#[test]
fn complex_stiffness() {
    let contact = half_space(PARABOLOID);
    let stiffness = contact.stiffness(0.1).expect("a stiffness");
    for omega in [1e-2, 1.0, 1e4] {
        let complex = |law| {
            let complex = contact.complex_stiffness(0.1, &law, omega);
            complex.expect("a stiffness")
        };
        let [storage, loss] = complex(power_law(0.3));
        assert!((loss / storage - (0.15 * PI).tan()).abs() < 1e-13);
        let [storage, loss] = complex(solid_law());
        let x = omega * 0.6;
        assert!((storage / stiffness - (0.3 + 0.7 * x * x / (1.0 + x * x))).abs() < 1e-14);
        assert!((loss / stiffness - 0.7 * x / (1.0 + x * x)).abs() < 1e-14);
        // Both laws tend to the Debye form, Gamma-weighted: the modified law with a large time is constant.
        let [storage, loss] = complex(modified_power_law(0.0, 0.5, 1e12));
        assert!(
            (storage / stiffness - 1.0).abs() < 1e-6 && loss < 1e-6 * stiffness,
            "{storage} {loss}"
        );
    }
    // Slow oscillations of a modified power law: Gamma(1-n) (i omega)^n - i omega/(1-n).
    let of = |law| {
        contact
            .complex_stiffness(0.1, &law, 1e-16)
            .expect("a stiffness")
    };
    let [storage, loss] = of(modified_power_law(0.0, 0.9, 1.0));
    let exact = of(power_law(0.9));
    assert!(
        (storage / exact[0] - 1.0).abs() < 1e-9,
        "{storage} {exact:?}"
    );
    let exact = exact[1] - stiffness * 1e-15;
    assert!((loss / exact - 1.0).abs() < 1e-9, "{loss} {exact}");
}
