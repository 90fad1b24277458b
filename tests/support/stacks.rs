//! Stacks of layers: as the reference files write them, and at random.

use interp::Elastic;
use solve::stack::{Interface, Layer, Stack};

use crate::Case;

/// Returns the solid of Young's modulus `young` (Pa) and Poisson ratio `poisson`.
pub fn solid(young: f64, poisson: f64) -> Elastic {
    Elastic::new(young, poisson).unwrap_or_else(|e| panic!("{young}, {poisson}: {e}"))
}

/// Returns a layer of Young's modulus `young` (Pa), Poisson ratio `poisson` and `thickness` (m).
pub fn layer(young: f64, poisson: f64, thickness: f64) -> Layer {
    Layer::bonded(solid(young, poisson), thickness)
}

/// Returns the stack of a `base` and `layers` from the base up.
pub fn stack(base: Elastic, layers: &[Layer]) -> Stack {
    Stack::new(base, layers).unwrap_or_else(|e| panic!("{e}"))
}

/// Returns springs of the stiffnesses `tangential` and `normal` (Pa/m).
pub const fn springs(tangential: f64, normal: f64) -> Interface {
    Interface::Springs { tangential, normal }
}

/// Returns the stack of a `base` and `layers` from the base up, each with the interface below it.
pub fn with_interfaces(base: Elastic, layers: &[(Layer, Interface)]) -> Stack {
    let layers: Vec<Layer> = layers
        .iter()
        .map(|&(layer, interface)| Layer { interface, ..layer })
        .collect();
    stack(base, &layers)
}

impl Case<'_> {
    /// Returns the stack in the columns `layers`, `base` and `interfaces` (`bonded`, `sliding` or
    /// `kt:kn`, below each layer, from the base up).
    pub fn stack_with_interfaces(&self) -> Stack {
        let bonded = self.stack();
        let number = |text: &str| text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
        let interfaces = self.text("interfaces").split('|').map(|text| match text {
            "bonded" => Interface::Bonded,
            "sliding" => Interface::Sliding,
            _ => match text.split_once(':') {
                Some((tangential, normal)) => springs(number(tangential), number(normal)),
                None => panic!("{text} is no interface"),
            },
        });
        let layers: Vec<_> = bonded.layers().iter().copied().zip(interfaces).collect();
        assert_eq!(
            layers.len(),
            bonded.layers().len(),
            "an interface for each layer"
        );
        with_interfaces(bonded.base(), &layers)
    }

    /// Returns the stack in the columns `layers` (`E:nu:h|E:nu:h...` from the base up) and `base`
    /// (`rigid` or `E:nu`).
    pub fn stack(&self) -> Stack {
        let numbers = |text: &str| -> Vec<f64> {
            text.split(':')
                .map(|number| number.parse().unwrap_or_else(|e| panic!("{number}: {e}")))
                .collect()
        };
        let base = match self.text("base") {
            "rigid" => solid(f64::INFINITY, 0.25),
            text => {
                let [young, poisson] = numbers(text)[..] else {
                    panic!("{text} is no base")
                };
                solid(young, poisson)
            }
        };
        let layers: Vec<Layer> = self
            .text("layers")
            .split('|')
            .map(|text| {
                let [young, poisson, thickness] = numbers(text)[..] else {
                    panic!("{text} is no layer")
                };
                layer(young, poisson, thickness)
            })
            .collect();
        stack(base, &layers)
    }
}

/// Draws the stack with number `seed` of `data/stacks_mpmath.py`, and a wave number in units of one
/// over the thickness of its top layer.
pub fn random_stack(seed: u64) -> (Stack, f64) {
    let mut draw = Generator::new(seed);
    let count = [1, 2, 3, 4, 5, 8, 13, 40][draw.integer(8) as usize];
    let spread = [1, 4, 12, 28][draw.integer(4) as usize];
    let base = if draw.integer(4) == 0 {
        solid(f64::INFINITY, 0.25)
    } else {
        let young = draw.power(0, spread);
        solid(young, draw.poisson_ratio())
    };
    let mut layers: Vec<Layer> = (0..count)
        .map(|_| {
            let (young, poisson) = (draw.power(0, spread), draw.poisson_ratio());
            layer(young, poisson, draw.power(-13, 13))
        })
        .collect();
    layers[count - 1].thickness = 2.0_f64.powi(draw.integer(13) as i32 - 13);
    (stack(base, &layers), draw.power(-27, 33))
}

/// Knuth's 64-bit linear congruential generator, as in `data/stacks_mpmath.py`.
struct Generator {
    state: u64,
}

impl Generator {
    fn new(seed: u64) -> Self {
        let mut generator = Self { state: seed };
        for _ in 0..4 {
            generator.integer(1);
        }
        generator
    }

    /// Draws an integer from 0 to `below - 1`.
    fn integer(&mut self, below: u64) -> u64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 32) % below
    }

    /// Draws `(1 + u) 2^k` with one of `count` exponents from `first` on.
    fn power(&mut self, first: i32, count: u64) -> f64 {
        let mantissa = 1.0 + self.integer(1 << 16) as f64 / 65536.0;
        mantissa * 2.0_f64.powi(first + self.integer(count) as i32)
    }

    fn poisson_ratio(&mut self) -> f64 {
        const SPECIAL: [f64; 8] = [0.5, 0.499_999, 0.5, 0.25, 0.0, -0.5, -0.9, 0.499_999_999_9];
        if self.integer(2) == 0 {
            return SPECIAL[self.integer(8) as usize];
        }
        0.5 - 1.4 * (self.integer(1 << 16) as f64 / 65536.0)
    }
}
