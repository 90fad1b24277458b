//! A train in fewer and smaller integers, where a larger error is enough.

use crate::{IntegerTrain, Malformed};

/// Returns a train whose integers are those of `train` over `factor`, rounded, with a step `factor`
/// times as large. Indices of bonds and polynomials of the highest degrees that have only zeros are
/// left out.
///
/// The error of a train by the rounding of its integers grows with the step.
///
/// # Errors
/// [`Malformed`] if the factor is so large that too little is left for a train.
///
/// # Panics
/// If `factor` is not positive.
pub fn coarser(train: &IntegerTrain, factor: i64) -> Result<IntegerTrain, Malformed> {
    assert!(factor > 0, "a factor of {factor}");
    let mut shapes = train.shapes();
    let rounded = |&n: &i64| (n as f64 / factor as f64).round() as i64;
    let mut cores = train
        .cores()
        .each_ref()
        .map(|core| core.iter().map(rounded).collect::<Vec<i64>>());
    let mut exponents = train.exponents().clone();
    for bond in 0..3 {
        let [before, terms, width] = shapes[bond];
        let length = cores[bond + 1].len() / width;
        let counts = |&j: &usize| {
            let mut column = cores[bond][j..].iter().step_by(width);
            let row = &cores[bond + 1][j * length..][..length];
            column.any(|&n| n != 0) && row.iter().any(|&n| n != 0)
        };
        let mut kept: Vec<usize> = (0..width).filter(counts).collect();
        if kept.is_empty() {
            kept.push(0);
        }
        let rows = cores[bond].chunks_exact(width);
        cores[bond] = rows.flat_map(|row| kept.iter().map(|&j| row[j])).collect();
        let next = kept
            .iter()
            .flat_map(|&j| &cores[bond + 1][j * length..][..length]);
        cores[bond + 1] = next.copied().collect();
        exponents[bond] = kept.iter().map(|&j| exponents[bond][j]).collect();
        shapes[bond] = [before, terms, kept.len()];
        shapes[bond + 1][0] = kept.len();
    }
    for (core, [before, terms, after]) in cores.iter_mut().zip(&mut shapes) {
        let filled = core.chunks_exact(*after).enumerate();
        let degrees = filled
            .filter(|(_, row)| row.iter().any(|&n| n != 0))
            .map(|(i, _)| i % *terms + 1);
        // A bond is at most as long as the rows before it are many.
        let least = after.div_ceil(*before).min(*terms);
        let count = degrees.max().unwrap_or(1).max(least);
        let rows = core.chunks_exact(*terms * *after);
        *core = rows
            .flat_map(|row| &row[..count * *after])
            .copied()
            .collect();
        *terms = count;
    }
    IntegerTrain::new(
        train.functions(),
        train.order(),
        train.smooth_degrees(),
        shapes.map(|[_, count, _]| count),
        exponents,
        train.step() * factor as f64,
        cores,
    )
}
