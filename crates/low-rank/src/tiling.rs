//! Boxes of nodes of two variables, each with a train of its own.

/// Returns whether boxes cover every interval between the nodes of two variables once.
///
/// A box holds the first and the last node of each variable, and `counts` the numbers of nodes. The only
/// node of a variable counts as an interval.
pub fn cover_once(boxes: &[[[usize; 2]; 2]], counts: [usize; 2]) -> bool {
    let is_box = |sides: &[[usize; 2]; 2]| {
        let mut sides = sides.iter().zip(counts);
        sides.all(|([first, last], count)| *last < count && (first < last || count == 1))
    };
    let area = |sides: &[[usize; 2]; 2]| -> usize {
        sides
            .iter()
            .map(|[first, last]| (last - first).max(1))
            .product()
    };
    let overlap = |one: &[[usize; 2]; 2], other: &[[usize; 2]; 2]| {
        let mut sides = one.iter().zip(other).zip(counts);
        sides.all(|((one, other), count)| count == 1 || one[0].max(other[0]) < one[1].min(other[1]))
    };
    let mut pairs = boxes
        .iter()
        .enumerate()
        .flat_map(|(i, one)| boxes[..i].iter().map(move |other| (one, other)));
    let whole: usize = counts.map(|count| (count - 1).max(1)).into_iter().product();
    boxes.iter().all(is_box)
        && boxes.iter().map(area).sum::<usize>() == whole
        && !pairs.any(|(one, other)| overlap(one, other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_must_cover_everything_once() {
        let whole = [[0, 5], [0, 3]];
        let sound: [&[[[usize; 2]; 2]]; 4] = [
            &[whole],
            &[[[0, 2], [0, 3]], [[2, 5], [0, 3]]],
            &[[[0, 5], [1, 3]], [[0, 5], [0, 1]]],
            // Five boxes around a middle one.
            &[
                [[0, 3], [0, 1]],
                [[3, 5], [0, 2]],
                [[2, 5], [2, 3]],
                [[0, 2], [1, 3]],
                [[2, 3], [1, 2]],
            ],
        ];
        for boxes in sound {
            assert!(cover_once(boxes, [6, 4]), "{boxes:?}");
        }
        let wrong: [&[[[usize; 2]; 2]]; 9] = [
            &[],
            &[[[0, 5], [0, 2]]],
            &[[[0, 5], [0, 4]]],
            &[[[5, 0], [0, 3]]],
            &[[[0, 2], [0, 3]], [[3, 5], [0, 3]]],
            &[[[0, 3], [0, 3]], [[2, 5], [0, 3]]],
            &[whole, whole],
            &[whole, [[2, 2], [0, 3]]],
            // As large as the whole, with a gap and an overlap.
            &[[[0, 3], [0, 3]], [[2, 4], [0, 3]]],
        ];
        for boxes in wrong {
            assert!(!cover_once(boxes, [6, 4]), "{boxes:?}");
        }
    }

    #[test]
    fn the_only_node_of_a_variable_is_an_interval() {
        assert!(cover_once(&[[[0, 0], [0, 2]], [[0, 0], [2, 3]]], [1, 4]));
        assert!(cover_once(&[[[0, 0], [0, 0]]], [1, 1]));
        assert!(!cover_once(&[[[0, 0], [0, 0]]; 2], [1, 1]));
    }
}
