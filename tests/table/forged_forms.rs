//! Low-rank forms that do not belong to their table. `tests/hostile/packed.rs` forges the
//! files of both forms.

use interp::{Error, Quantity, Table, Tile};
use low_rank::IntegerTrain;

use crate::low_rank::FOUR_AXES;

#[test]
fn a_train_of_other_functions_than_the_table_holds_is_malformed() {
    let table = &*FOUR_AXES;
    let train = |functions, smooth_degrees| {
        let cores = [vec![1], vec![1], vec![1], vec![1; functions]];
        let weights = [vec![0], vec![0], vec![0]];
        IntegerTrain::new(
            functions,
            [1, 2, 3],
            smooth_degrees,
            [1; 4],
            weights,
            1e-3,
            cores,
        )
    };
    let of = |quantities: &[Quantity], form: Result<IntegerTrain, _>| {
        let tile = Tile {
            film: [0, table.shape()[1] - 1],
            substrate: [0, table.shape()[3] - 1],
            form: form.expect("sound"),
        };
        let description = table.description().clone();
        Table::from_low_rank(description, table.axes(), quantities.to_vec(), vec![tile])
    };
    let held = [Quantity::Pi0, Quantity::Eeq];
    let degrees = Tile::SMOOTH_DEGREES;
    of(&held, train(2, degrees)).expect("two of two");
    let wrong = [
        of(&held, train(3, degrees)),
        of(&held, train(2, [40.0; 4])),
        of(&[], train(0, degrees).or(train(1, degrees))),
        of(&[Quantity::Eeq, Quantity::Pi0], train(2, degrees)),
        of(&[Quantity::Eeq; 2], train(2, degrees)),
    ];
    for (i, wrong) in wrong.iter().enumerate() {
        assert!(matches!(wrong, Err(Error::Malformed(_))), "{i}: {wrong:?}");
    }
}
