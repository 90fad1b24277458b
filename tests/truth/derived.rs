//! prototype
use acceptance::table;
use interp::{Material, Quantity};
use tabulate::solve;

#[test]
fn prototype() {
    for tol in [1e-6, 1e-7, 1e-8] {
        for (e1, nu1, e0, nu0) in [
            ("1.75", "0.5", "1e5", 0.25),
            ("0", "0.5", "inf", 0.25),
            ("0", "0.3", "inf", 0.25),
            ("1e3", "0.3", "1e-3", 0.25),
            ("1e-3", "0.5", "1e5", 0.25),
            ("1e3", "0.2", "1e9", 0.25),
            ("1e6", "0.3", "1e-6", 0.25),
            ("1", "0.3", "1", 0.3),
        ] {
            let scene = format!(
                "title='x'\ntolerance={tol:e}\nquantities=['gamma']\nnu0={nu0}\na_over_t={{from=1e-3,to=1e3}}\ne1_over_e2={e1}\nnu1={nu1}\ne0_over_e2={e0}\n"
            );
            let table = table(&scene);
            let material = Material::new(
                e1.parse().unwrap(),
                nu1.parse().unwrap(),
                e0.parse().unwrap(),
                nu0,
            )
            .unwrap();
            let curve = table.curve(&material).unwrap();
            let mut worst = [(0.0_f64, 0.0); 4];
            for i in 0..=1000 {
                let x = 10_f64
                    .powf(-3.0 + 6.0 * f64::from(i) / 1000.0)
                    .clamp(1e-3, 1e3);
                let Ok(s) = solve(x, &material, 1e-11) else {
                    continue;
                };
                for q in Quantity::ALL {
                    let e = match curve.quantity(q, x) {
                        Ok(v) => (v / s.quantities.get(q) - 1.0).abs(),
                        Err(e) => {
                            println!("{e}");
                            9.0
                        }
                    };
                    if e > worst[q as usize].0 {
                        worst[q as usize] = (e, x);
                    }
                }
            }
            println!(
                "{tol:.0e} {e1} {nu1} {e0}: nodes {} cert {:.1e}: {}",
                table.shape()[0],
                table.description().certificate.max_error,
                worst.map(|(e, x)| format!("{e:.1e} at {x:.2e}")).join(", ")
            );
        }
    }
}
