use interp::*;
use std::time::Instant;
fn main() {
    let solid = |y: f64, n: f64| Elastic::new(y, n).unwrap();
    let table = Table::embedded();
    for (name, s) in [
        (
            "paper",
            System {
                sphere_radius: 1e-3,
                sphere_modulus: 2e6,
                film: solid(3.5e6, 0.5),
                film_thickness: 1e-5,
                substrate: solid(2e11, 0.25),
            },
        ),
        (
            "gel",
            System {
                sphere_radius: 10e-6,
                sphere_modulus: f64::INFINITY,
                film: solid(2e4, 0.45),
                film_thickness: 5e-6,
                substrate: solid(7e10, 0.2),
            },
        ),
    ] {
        let _ = table.contact_with_gradient(&s).unwrap();
        let n = 200;
        let t = Instant::now();
        for i in 0..n {
            let mut s = s;
            if s.sphere_modulus.is_finite() {
                s.sphere_modulus *= 1.0 + 1e-4 * i as f64;
            } else {
                s.film = solid(2e4 * (1.0 + 1e-4 * i as f64), 0.45);
            }
            std::hint::black_box(table.contact(&s).unwrap());
        }
        println!(
            "{name} contact {:.1} us",
            t.elapsed().as_secs_f64() / n as f64 * 1e6
        );
        let t = Instant::now();
        for i in 0..n {
            let mut s = s;
            if s.sphere_modulus.is_finite() {
                s.sphere_modulus *= 1.0 + 1e-4 * i as f64;
            } else {
                s.film = solid(2e4 * (1.0 + 1e-4 * i as f64), 0.45);
            }
            std::hint::black_box(table.contact_with_gradient(&s).unwrap());
        }
        println!(
            "{name} gradient {:.1} us",
            t.elapsed().as_secs_f64() / n as f64 * 1e6
        );
        let c = table.contact_with_gradient(&s).unwrap();
        let t = Instant::now();
        for _ in 0..n {
            std::hint::black_box(c.clone());
        }
        println!(
            "{name} clone {:.3} us",
            t.elapsed().as_secs_f64() / n as f64 * 1e6
        );
        let t = Instant::now();
        for _ in 0..n {
            std::hint::black_box(c.equilibria(0.001, Control::Displacement).unwrap());
        }
        println!(
            "{name} equilibria {:.3} us",
            t.elapsed().as_secs_f64() / n as f64 * 1e6
        );
    }
}
