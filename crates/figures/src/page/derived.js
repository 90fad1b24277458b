// The quantities from gamma alone (derived.rs), which begin with those of a thick film (thick_film.rs).

/** The largest first a/t at which a film is thick. */
const LARGEST_FIRST = 0.4;
/** The largest step in ln(a/t) of the integrals. Half of it changes no quantity by more than 1e-9, relative. */
const DERIVED_STEP = 0.05;

/** The points, the integrals up to the points and the integral to the end, of Gauss' rule with three points on a step of length 1. */
const ROOT = Math.sqrt(15);
const GAUSS = {
    points: [0.5 - ROOT / 10, 0.5, 0.5 + ROOT / 10],
    inner: [
        [5 / 36, 2 / 9 - ROOT / 15, 5 / 36 - ROOT / 30],
        [5 / 36 + ROOT / 24, 2 / 9, 5 / 36 - ROOT / 24],
        [5 / 36 + ROOT / 30, 2 / 9 + ROOT / 15, 5 / 36],
    ],
    whole: [5 / 18, 4 / 9, 5 / 18],
};
const weighted = (weights, values) => weights.reduce((sum, weight, i) => sum + weight * values[i], 0);

/** True if the integrals can begin at the first a/t of a range. */
function derivable([first, last]) {
    return first <= LARGEST_FIRST && 4 * first <= last;
}

/**
 * The quantities of one material from its gamma. In units of Es*, with x = a/t and a prime for d/dx:
 *
 *     (x eeq)' = gamma²     (x² delta0)' = 2 x eeq/gamma²     (x³ pi0)' = 8 (x eeq)²/gamma²
 */
class DerivedCurve {
    constructor(curve, [first, last]) {
        this.curve = curve;
        this.ends = [first, last].map(Math.log);
        const [from, to] = this.ends, count = Math.ceil((to - from) / DERIVED_STEP);
        this.step = (to - from) / count;
        const { error, eeq, delta0, pi0 } = this.thickFilm(first);
        /** The estimated relative error with which the quantities begin. */
        this.error = error;
        /** x eeq, x² delta0 and x³ pi0 at the beginning of each step. */
        this.integrals = [[first * eeq, first ** 2 * delta0, first ** 3 * pi0]];
        for (let i = 1; i < count; i += 1) this.integrals.push(this.advance(this.integrals[i - 1], from + (i - 1) * this.step, this.step));
    }

    gamma(x) {
        return this.curve.at(x).gamma;
    }

    /** The quantities at the first a/t, from gamma at this a/t and at twice it; four times it gives the estimate of their error. */
    thickFilm(x) {
        const [one, two, four] = [x, 2 * x, 4 * x].map((place) => 1 / this.gamma(place).value);
        const u = (two - 2 * one + 1) / (14 * one - 2), alpha = one / (1 + u) - 1 - u;
        const expected = (1 + 4 * alpha + 64 * u) * (1 + 64 * u);
        return {
            eeq: 1 / (1 + alpha + u),
            delta0: 1 + (2 / 3) * alpha * (1 + u) + 1.2 * u,
            pi0: (8 / 3) * (1 + u),
            error: 0.02 * Math.abs(expected / four - 1),
        };
    }

    /** Returns the integrals at ln x = `from + step`, from those at `from`. */
    advance([stiffness, penetration, load], from, step) {
        const x = GAUSS.points.map((point) => Math.exp(from + point * step));
        const square = x.map((place) => this.gamma(place).value ** 2);
        const rates = x.map((place, i) => step * place * square[i]);
        const inside = GAUSS.inner.map((weights) => stiffness + weighted(weights, rates));
        return [
            stiffness + weighted(GAUSS.whole, rates),
            penetration + weighted(GAUSS.whole, x.map((place, i) => (2 * step * place * inside[i]) / square[i])),
            load + weighted(GAUSS.whole, x.map((place, i) => (8 * step * place * inside[i] ** 2) / square[i])),
        ];
    }

    /** Returns the value of each quantity and its logarithmic slope d ln Q / d ln(a/t). */
    at(x) {
        const [from, to] = this.ends, u = Math.min(Math.max(Math.log(x), from), to), place = Math.exp(u);
        const i = Math.min(Math.floor((u - from) / this.step), this.integrals.length - 1), start = from + i * this.step;
        const [stiffness, penetration, load] = this.advance(this.integrals[i], start, u - start);
        const { gamma } = this.curve.at(place), square = gamma.value ** 2;
        return {
            pi0: { value: load / place ** 3, slope: (8 * place * stiffness ** 2) / (square * load) - 3 },
            eeq: { value: stiffness / place, slope: (place * square) / stiffness - 1 },
            gamma,
            delta0: { value: penetration / place ** 2, slope: (2 * place * stiffness) / (square * penetration) - 2 },
        };
    }
}
