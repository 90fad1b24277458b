//! The values of a train on a grid, by hand.

use low_rank::IntegerTrain;

/// By hand, where the variable 1 is in the middle of the box, `T1 = 0` and `T2 = -1`, the variable 2
/// at its end, `T1 = 1`, and the variable 0 at its beginning, `T1 = -1`.
#[test]
fn values_are_those_of_the_formula() {
    let root = |square: f64| 2_f64.sqrt() / (1.0 + square).sqrt();
    let [first, second, last] = [-root(0.01), root(0.25), -root(1.0 / 1600.0)];
    let vector = [10.0 + 30.0 * second, 20.0 - 5.0 * second];
    let step = 0.5;
    let before = 2.0 * step / 0.5 * (step * (1.0 - first) / 0.25);
    let expected = [
        [1.0 + 3.0 * last, 5.0 + 7.0 * last],
        [2.0 + 4.0 * last, 6.0 + 8.0 * last],
    ]
    .map(|of| before * step * step * (vector[0] / 2.0 * of[0] + vector[1] * of[1]));
    let ends = [[-1.0, 1.0], [2.0, 4.0], [0.0, 1.0], [7.0, 7.0]];
    let weights = [vec![-1], vec![-2], vec![1, 0]];
    let cores = [
        vec![2],
        vec![1, 2, -1],
        vec![10, 20, 30, -5],
        vec![1, 2, 3, 4, 5, 6, 7, 8],
    ];
    let degrees = [40.0, 20.0, 2.0, 20.0];
    let train = IntegerTrain::new(2, [3, 1, 2], degrees, [1, 3, 2, 2], weights, step, cores);
    let found = train
        .expect("sound")
        .values(ends, [&[-1.0], &[3.0], &[1.0], &[7.0]]);
    assert_eq!(found.len(), 2);
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() < 1e-14,
            "{found}, not {expected}"
        );
    }
}
