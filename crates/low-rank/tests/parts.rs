//! The parts of a train, and what is refused.

use low_rank::{IntegerTrain, Malformed};

const ORDER: [usize; 3] = [3, 1, 2];
const TERMS: [usize; 4] = [1, 3, 2, 2];
const DEGREES: [f64; 4] = [40.0, 20.0, 2.0, 20.0];
const STEP: f64 = 0.5;

/// The weights 1/2, 1/4, 2 and 1.
fn weights() -> [Vec<i8>; 3] {
    [vec![-1], vec![-2], vec![1, 0]]
}

fn cores() -> [Vec<i64>; 4] {
    [
        vec![2],
        vec![1, 2, -1],
        vec![10, 20, 30, -5],
        vec![1, 2, 3, 4, 5, 6, 7, 8],
    ]
}

fn new(
    order: [usize; 3],
    terms: [usize; 4],
    weights: [Vec<i8>; 3],
    step: f64,
    cores: [Vec<i64>; 4],
) -> Result<IntegerTrain, Malformed> {
    IntegerTrain::new(2, order, DEGREES, terms, weights, step, cores)
}

fn sound() -> IntegerTrain {
    new(ORDER, TERMS, weights(), STEP, cores()).expect("sound")
}

#[test]
fn a_train_of_code_is_the_train_that_was_coded() {
    let train = sound();
    assert_eq!(
        (train.ranks(), train.terms(), train.functions()),
        ([1, 1, 2], TERMS, 2)
    );
    let of = |code: &[u8]| IntegerTrain::of_code(2, ORDER, DEGREES, TERMS, weights(), STEP, code);
    let code = train.coded_integers();
    assert_eq!(of(&code), Ok(train));
    for wrong in [&code[..code.len() - 1], &[], &[&code[..], &[0]].concat()] {
        assert!(of(wrong).is_err(), "{wrong:?}");
    }
}

#[test]
fn parts_that_contradict_each_other_are_malformed() {
    let with_core = |i: usize, core: Vec<i64>| {
        let mut cores = cores();
        cores[i] = core;
        new(ORDER, TERMS, weights(), STEP, cores)
    };
    let with_weights = |weights| new(ORDER, TERMS, weights, STEP, cores());
    let with_degree = |degree| {
        let degrees = [40.0, degree, 2.0, 20.0];
        IntegerTrain::new(2, ORDER, degrees, TERMS, weights(), STEP, cores())
    };
    let wrong = [
        IntegerTrain::new(0, ORDER, DEGREES, TERMS, weights(), STEP, cores()),
        IntegerTrain::new(3, ORDER, DEGREES, TERMS, weights(), STEP, cores()),
        with_degree(0.0),
        with_degree(-1.0),
        with_degree(f64::NAN),
        new([3, 1, 1], TERMS, weights(), STEP, cores()),
        new([0, 1, 2], TERMS, weights(), STEP, cores()),
        new(ORDER, [1, 3, 2, 1], weights(), STEP, cores()),
        new(ORDER, [0, 3, 2, 2], weights(), STEP, cores()),
        new(ORDER, [1, usize::MAX, 2, 2], weights(), STEP, cores()),
        with_weights([vec![-1], vec![], vec![1, 0]]),
        with_weights([vec![-1], vec![-2], vec![1, 0, 0]]),
        with_weights([vec![100], vec![-2], vec![1, 0]]),
        with_weights([vec![i8::MIN], vec![-2], vec![1, 0]]),
        // Two values of an index from a single term.
        new(
            ORDER,
            TERMS,
            [vec![-1, -1], vec![-2], vec![1, 0]],
            STEP,
            [
                vec![2, 2],
                vec![1, 2, -1, 3, 1, 1],
                vec![10, 20, 30, -5],
                vec![1; 8],
            ],
        ),
        with_core(0, vec![]),
        with_core(2, vec![10, 20, 30]),
        with_core(3, vec![1, 2, 3, 4, 5, 6]),
        with_core(1, vec![1, 2, i64::MIN]),
        with_core(1, vec![1, 2, (1 << 53) + 1]),
        new(ORDER, TERMS, weights(), 0.0, cores()),
        new(ORDER, TERMS, weights(), f64::NAN, cores()),
        new(ORDER, TERMS, weights(), f64::INFINITY, cores()),
        // In steps of this, one integer is more than anything is.
        new(ORDER, TERMS, weights(), 1e29, cores()),
    ];
    for (i, wrong) in wrong.iter().enumerate() {
        assert!(wrong.is_err(), "{i}: {wrong:?}");
    }
}
