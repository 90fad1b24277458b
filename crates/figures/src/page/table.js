// The quantities of a material, from the tensor trains of the constant `TABLE` (integer_train.rs of the crate low-rank).

const clamped = (value, [from, to]) => Math.min(Math.max(value, from), to);

/** The hash of Fowler, Noll and Vo of a text, which finds damage. */
const hashOf = (text) => new TextEncoder().encode(text).reduce((hash, byte) => Math.imul(hash ^ byte, 16777619) >>> 0, 2166136261);

/** The coordinate of a parameter in which the quantities are polynomials (parameter.rs). */
function coordinate(parameter, value) {
    if (parameter === "nu1") return -((1 - 2 * value + 1e-6) ** 0.125);
    const [low, high] = { e1s_over_einfs: [1e-10, 0], e0s_over_e2s: [1e-11, 1e-11] }[parameter] ?? [0, 0];
    // Both forms are equal, and exact at their end.
    return value < 1 ? Math.log((value + low) / (1 + high * value)) : Math.log((1 + low / value) / (1 / value + high));
}

/** The polynomials of a core at `u`: Chebyshev's between the ends of the box, with their factors. */
function polynomials({ axis, terms }, ends, u) {
    const [from, to] = ends[axis], t = to > from ? (u - from - (to - u)) / (to - from) : 0, values = [1, t];
    for (let k = 2; k < terms; k += 1) values.push(2 * t * values[k - 1] - values[k - 2]);
    const factor = (k) => (k === 0 ? 1 : Math.SQRT2 / Math.hypot(k / TABLE.smoothDegrees[axis], 1));
    return values.slice(0, terms).map((value, k) => value * factor(k));
}

/** Returns a function of a/t, the quantities of a material in units of Es*. One that the table does not answer is 1. */
function quantitiesOf(material) {
    const places = [0, ...TABLE.parameters.map(({ name, ends }) => coordinate(name, clamped(material[name], ends)))];
    const outside = ({ ends }) => [1, 3].some((axis) => places[axis] < ends[axis][0] - 1e-9 || places[axis] > ends[axis][1] + 1e-9);
    const { ends, cores, weights, step } = TABLE.trains.find((train) => !outside(train));
    /** Multiplies a vector by a core, a matrix with a row of `width` for each entry of the vector and each of the `values`. */
    const product = (vector, values, { begins: at }, width) => {
        const sums = new Float64Array(width);
        for (const entry of vector) {
            for (const value of values) for (let i = 0; i < width; i += 1, at += 1) sums[i] += entry * value * step * INTEGERS[at];
        }
        return sums;
    };
    const vector = cores.slice(0, 3).reduce((before, core, i) => (
        product(before, polynomials(core, ends, places[core.axis]), core, core.after).map((sum, k) => sum / weights[i][k])), [1]);
    const last = cores[3], count = TABLE.held.length, coefficients = product(vector, [1], last, last.terms * count);
    const held = (x) => {
        const values = polynomials(last, ends, clamped(Math.log(x), ends[0]));
        const logarithm = (q) => values.reduce((sum, value, k) => sum + value * coefficients[k * count + q], 0);
        return { pi0: 1, eeq: 1, gamma: 1, delta0: 1, ...Object.fromEntries(TABLE.held.map((name, q) => [name, Math.exp(logarithm(q))])) };
    };
    return TABLE.derives ? derived((x) => held(x).gamma) : held;
}
