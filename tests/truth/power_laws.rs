//! Probes with the profile `c r^n` against values in 80-bit arithmetic, identities and limits.

use acceptance::{
    Contacts, Data, larger, layer, material, slopes, solid, springs, with_interfaces,
};
use interp::Material;
use solve::stack::Interface;
use solve::{Error, PowerLaw, Solution, solve_power_laws, solve_stack_power_laws};

/// Returns the largest relative difference of load and penetration.
fn error(power_law: PowerLaw, pi: f64, delta: f64) -> f64 {
    larger(
        (power_law.pi / pi - 1.0).abs(),
        (power_law.delta / delta - 1.0).abs(),
    )
}

/// Measured at 1e-10: 9.2e-12.
#[test]
fn power_laws_agree_with_reference_values_within_the_stated_error() {
    let data = Data::read("shapes");
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let (mut worst, mut share, mut count) = (0.0, 0.0, 0);
        for case in data.cases() {
            let (x, n) = (case.get("a_over_t"), case.get("n"));
            let (solution, power_laws) = solve_power_laws(x, &case.material(), &[n], tolerance)
                .unwrap_or_else(|e| panic!("n = {n}: {e}"));
            let error = error(power_laws[0], case.get("pi_n"), case.get("delta_n"));
            assert!(
                error <= solution.error,
                "{error:.1e} > {:.1e}: n = {n}, a/t = {x}, {:?}, {:?}",
                solution.error,
                case.material(),
                solution.method,
            );
            worst = larger(worst, error);
            share = larger(share, error / solution.error);
            count += 1;
        }
        println!("{count} {tolerance:e} {worst:.1e} {share:.2}");
        assert!(count >= 60);
    }
}

/// Contacts whose last modes nearly vanish by chance, and wide stiff plates under high powers, with
/// the loose tolerances that need few modes. The error is the difference from a solve to 1e-11, which
/// has more modes. Measured: at most 0.23 of the stated error.
#[test]
fn the_error_of_few_modes_bounds_the_true_one() {
    type Solved = Result<(Solution, Vec<PowerLaw>), Error>;
    let mut share = 0.0;
    let mut check = |tolerance: f64, solve: &dyn Fn(f64) -> Solved| {
        let at = |tolerance| solve(tolerance).expect("within reach");
        let ((solution, found), (_, truth)) = (at(tolerance), at(1e-11));
        for (found, truth) in found.into_iter().zip(truth) {
            share = larger(share, error(found, truth.pi, truth.delta) / solution.error);
        }
    };
    for (tolerance, n, x, bodies) in [
        (3e-5, 9.82, 3.07409, [51071.6, 0.4999996, 1971.02, 0.2199]),
        (
            2e-3,
            6.0,
            3.312247,
            [227.1932, 0.214322, 2.12941e-5, -0.567839],
        ),
        (5e-7, 0.5672, 1.09070, [277892.0, 0.250184, 3973.41, 0.5]),
        (6e-4, 6.0, 19.96442, [17906.3, 0.5, 0.00775350, 0.264188]),
    ] {
        let material = material(bodies);
        check(tolerance, &|tolerance| {
            solve_power_laws(x, &material, &[n], tolerance)
        });
    }
    let sliding = with_interfaces(
        solid(3.8043, 0.499735),
        &[
            (layer(1.2708, 0.5, 0.33822), Interface::Bonded),
            (layer(57.094, 0.499999, 0.19456), Interface::Sliding),
        ],
    );
    let on_springs = with_interfaces(
        solid(f64::INFINITY, 0.0),
        &[
            (layer(177.58885, 0.48961837, 0.81028520), Interface::Bonded),
            (layer(114.12697, -0.17454183, 0.64058969), Interface::Bonded),
            (
                layer(3609463.3, 0.49418573, 0.080228529),
                springs(5.6446e-5, 4.8e9),
            ),
        ],
    );
    for (tolerance, n, a_over_t, stack) in [
        (2.3e-5, 10.577, 16.535, sliding),
        (6e-4, 1.0, 0.12880864, on_springs),
    ] {
        check(tolerance, &|tolerance| {
            solve_stack_power_laws(a_over_t, &stack, f64::INFINITY, &[n], tolerance)
        });
    }
    println!("at most {share:.2} of the stated error");
    assert!(share <= 1.0);
}

/// Returns the numbers at `x`, and their derivatives with respect to `ln x`.
fn with_rates(x: f64, material: &Material, exponent: f64) -> ([f64; 4], [f64; 4]) {
    let values = |log: f64| {
        let (solution, power_laws) = solve_power_laws(x * log.exp(), material, &[exponent], 1e-11)
            .unwrap_or_else(|e| panic!("n = {exponent}: {e}"));
        let q = solution.quantities;
        [power_laws[0].pi, power_laws[0].delta, q.eeq, q.gamma]
    };
    (values(0.0), slopes(0.05, values))
}

/// The load follows from the penetration, `dF0 = S d(delta0)`, and `Delta_{n+2}` from
/// `mu_n = Delta_n Eeq - Pi_n/4`, at random contacts and random exponents.
///
/// ```text
/// (n+1) Pi_n + x Pi_n' = 4 Eeq (n Delta_n + x Delta_n')
/// (n+2) Delta_{n+2} + x Delta_{n+2}' = (n+2)(n+1) es mu_n/Gamma^2
/// ```
#[test]
fn the_identities_hold_for_random_exponents() {
    let mut contacts = Contacts::new(31);
    let [mut load, mut ladder] = [0.0; 2];
    for round in 0..60 {
        let material = contacts.material([1e-2, 1e3], [1e-2, 1e6]);
        let x = contacts.log_uniform(1e-2, 100.0);
        let n = [1.0, 2.0, 3.0, contacts.uniform(0.3, 4.0)][round % 4];
        let ([pi, delta, eeq, gamma], [pi_rate, delta_rate, ..]) = with_rates(x, &material, n);
        let work = 4.0 * eeq * (n * delta + delta_rate);
        load = larger(load, (((n + 1.0) * pi + pi_rate) / work - 1.0).abs());

        let ([_, next, ..], [_, next_rate, ..]) = with_rates(x, &material, n + 2.0);
        let mean = delta * eeq - 0.25 * pi;
        let source =
            (n + 2.0) * (n + 1.0) * material.sphere_film_modulus() * mean / (gamma * gamma);
        ladder = larger(
            ladder,
            (((n + 2.0) * next + next_rate) / source - 1.0).abs(),
        );
    }
    println!("load {load:.1e}, ladder {ladder:.1e}");
    assert!(load < 1e-8 && ladder < 1e-8, "{load}, {ladder}");
}

/// On a thick film `Delta_n = 1 + c n/(n+1)` with `c = es/Eeq - 1`, and the load is Sneddon's.
#[test]
fn thick_films_approach_the_half_space_at_every_exponent() {
    for parameters in [
        [1.75, 0.5, 1e5, 0.25],
        [10.0, 0.0, 1.0, 0.5],
        [0.0, 0.3, 0.5, 0.25],
    ] {
        let material = material(parameters);
        for n in [0.1, 0.5, 1.0, 2.5, 4.0, 7.0, 12.0, 20.0] {
            let (thick, power_laws) = solve_power_laws(1e-4, &material, &[n], 1e-10)
                .unwrap_or_else(|e| panic!("n = {n}: {e}"));
            let es = material.sphere_film_modulus();
            let share = es / thick.quantities.eeq - 1.0;
            let expected = 1.0 + share * n / (n + 1.0);
            let [delta, pi] = [
                power_laws[0].delta / expected,
                power_laws[0].pi * (n + 1.0) / (4.0 * n * es),
            ];
            // The next terms are of order `x^3`.
            assert!((delta - 1.0).abs() < 1e-10, "n = {n}: {delta}");
            assert!((pi - 1.0).abs() < 1e-10, "n = {n}: {pi}");
        }
    }
}

/// On a thin film `Delta_n -> 1`, and the load is Sneddon's with the compound modulus of the
/// substrate: `x (1 - Delta_n)/n` is `A (ln x - ln 2 - psi((n+1)/2)) + C`, so that its value at
/// `n = 1` less that at `n = 3` is `A (psi(2) - psi(1)) = A`, and at 3 less that at 5 `A/2`.
#[test]
fn thin_films_approach_the_half_space_of_the_substrate() {
    const X: f64 = 1e5;
    for parameters in [[1.75, 0.3, 1e5, 0.25], [0.3, 0.2, 1.0, 0.3]] {
        let material = material(parameters);
        let exponents = [1.0, 3.0, 5.0];
        let (solution, power_laws) =
            solve_power_laws(X, &material, &exponents, 1e-10).expect("solved");
        let logs: Vec<f64> = power_laws
            .iter()
            .map(|power_law| X * (1.0 - power_law.delta) / power_law.exponent)
            .collect();
        let ratio = (logs[0] - logs[1]) / (logs[1] - logs[2]);
        assert!((ratio / 2.0 - 1.0).abs() < 2e-3, "{ratio}");
        let einf = material.sphere_substrate_modulus();
        for power_law in &power_laws {
            let n = power_law.exponent;
            let load = power_law.pi * (n + 1.0) / (4.0 * n * einf);
            assert!((load - 1.0).abs() < 2e-3, "n = {n}: {load}");
        }
        assert!((solution.quantities.eeq / einf - 1.0).abs() < 2e-3);
    }
}
