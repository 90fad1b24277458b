//! The effects summed up as Markdown.

use super::{A_OVER_R, EXPONENT, Effect, Row, STRENGTHS, TABOR, WIDEST};
use crate::clock::human;
use crate::numbers::{grouped, human_bytes};

impl Row {
    /// Returns the solves, the time and the bytes that the effect adds to the scene, in words. A
    /// time is never negative.
    pub fn saved(&self) -> [String; 3] {
        let signed =
            |negative: bool, size: String| if negative { format!("−{size}") } else { size };
        [
            signed(
                self.saved_solves < 0,
                grouped(self.saved_solves.unsigned_abs()),
            ),
            match (self.time_ratio, self.saved_seconds) {
                (Some(ratio), _) => {
                    let what = match self.without {
                        Some(Effect::FiniteRange) => "a pull-off",
                        Some(Effect::Friction) => "a directly solved curve",
                        Some(Effect::Relaxation) => "a curve",
                        _ => "a new material",
                    };
                    format!("{what} takes {ratio:.1} times as long")
                }
                (None, None) => "not measurable".into(),
                (None, Some(seconds)) if seconds < 0.0 => "no time".into(),
                (None, Some(seconds)) => human(seconds),
            },
            signed(
                self.saved_bytes < 0,
                human_bytes(self.saved_bytes.unsigned_abs()),
            ),
        ]
    }

    /// Returns the time that the effect adds, with the reason if that is no time, given the time of
    /// the whole scene.
    fn saved_time(&self, whole: f64) -> String {
        let [_, saved, _] = self.saved();
        let difference = whole - self.seconds;
        match self.saved_seconds {
            None => format!("{saved} ({} is within the noise)", human(difference.abs())),
            Some(seconds) if seconds < 0.0 => {
                format!("{saved} ({} more without it)", human(-seconds))
            }
            Some(_) => saved,
        }
    }
}

/// Returns a table in Markdown: the whole scene, the cost that each effect adds, and the error of
/// the load without it. Names the effects that have no row.
pub fn markdown(rows: &[Row]) -> String {
    let [tolerance, threads, axes, whole] = rows.first().map_or([f64::NAN; 4], |row| {
        [
            row.tolerance,
            row.threads as f64,
            row.axes as f64,
            row.seconds,
        ]
    });
    let mut text = format!(
        "| effect | left out by | axes | solves | time, {threads} threads | .h5 | error of the load, median | worst |\n"
    );
    text += "|---|---|---|---|---|---|---|---|\n";
    for row in rows {
        let Some(effect) = row.without else {
            let (solves, seconds, bytes) = (
                grouped(row.solves),
                human(row.seconds),
                human_bytes(row.bytes),
            );
            text +=
                &format!("| all of the scene | | {axes} | {solves} | {seconds} | {bytes} | | |\n");
            continue;
        };
        let [solves, _, bytes] = row.saved();
        let seconds = row.saved_time(whole);
        let [median, worst] = [row.median_error, row.worst_error].map(|error| {
            if error == 0.0 {
                "none".into()
            } else {
                format!("{error:.0e}")
            }
        });
        text += &format!(
            "| {} | {} | {} | {solves} | {seconds} | {bytes} | {median} | {worst} |\n",
            effect.name(),
            effect.instead(),
            axes - row.axes as f64
        );
    }
    let [weak, strong] = STRENGTHS;
    text += &format!(
        "\nEach effect has the axes, solves, time and bytes that it adds to the table of the scene. Tables have a tolerance of \
         {tolerance:e}; times include planning and certificate (the largest error at sampled points). A time is not measurable \
         where it is the difference of two times and not above their noise. Errors are relative to the adhesionless load at \
         the same contact radius, over random points of the scene where the adhesive part of the load is {weak} to {strong} \
         times that load. Points are even in the coordinates of the axes: where Poisson ratios go from 0 to 0.5, half of the \
         films have one above 0.49.\n"
    );
    let has = |effect| rows.iter().any(|row| row.without == Some(effect));
    let notes = [
        (Effect::Shape, format!(
            "The shape needs no other table. Its errors are those of the adhesionless load under the paraboloid, relative to that \
             under the sphere itself, at a = {A_OVER_R} R. Its time is that in which the embedded table makes the contact of a \
             new material.\n"
        )),
        (Effect::FiniteRange, format!(
            "The finite range needs no other table. Its errors are those of JKR's pull-off load, relative to itself, under a \
             sphere that pulls off at the contact radius, at a Tabor parameter of {TABOR}; they fall with its square. Its time \
             is that of a pull-off load with the correction for the range.\n"
        )),
        (Effect::Friction, format!(
            "Friction needs no other table. Its errors are those of the load of a flat punch without friction, relative to that with \
             full friction, at the a/t of the point or {WIDEST} if that is less. Its time is that of a curve of a sphere up to \
             a/t = 3, solved directly.\n"
        )),
        (Effect::Interface, "The interface needs no table. Its errors are those of the load of a bonded film where the film slides on its \
             substrate, up to a/t of 1000. Its time is that of the curve of a new film that slides, by direct solves to 1e-8 \
             over three decades of a/t, over that in which the embedded table makes the contact of a bonded one.\n".to_owned()),
        (Effect::Relaxation, format!(
            "Relaxation needs no other table. Its errors are the largest of the elastic load on approach and retract at equal speeds to \
             the contact radius, relative to the load at the turn, where all bodies relax by a power law of exponent {EXPONENT}; the \
             elastic curve has the modulus that gives the load at the turn. Its time is that of a history of 1001 points, over \
             that of 1001 points of an elastic curve.\n"
        )),
    ];
    for (effect, note) in notes {
        if has(effect) {
            text += &note;
        }
    }
    let missing: Vec<&str> = Effect::ALL
        .into_iter()
        .filter(|&effect| !has(effect))
        .map(Effect::name)
        .collect();
    if !missing.is_empty() {
        text += &format!("Not in this scene: {}.\n", missing.join(", "));
    }
    text
}
