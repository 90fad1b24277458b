// Integrals over ln(a/t): all quantities from gamma (derived.rs), and the sphere itself (even_powers/mod.rs of the crate contact).

/** The values of x = a/t in even steps of ln x. */
class Grid {
    constructor(range) {
        const [from, to] = range.map(Math.log), count = Math.max(4, Math.ceil((to - from) / 0.02));
        Object.assign(this, { from, step: (to - from) / count });
        this.x = Array.from({ length: count + 1 }, (_, i) => Math.exp(from + i * this.step));
    }

    /** The integrals of positive rates over ln x, from a value at the first x on: those of cubics through four rates. */
    integrals(rates, start) {
        // Beyond the ends the rates go on as powers of x. High powers of a small x are 0.
        const beyond = (end, next) => (next === 0 ? 0 : end * (end / next));
        const all = [beyond(rates[0], rates[1]), ...rates, beyond(rates.at(-1), rates.at(-2))];
        let sum = start;
        return rates.map((_, i) => (i === 0 ? sum : sum += (this.step / 24) * (13 * (all[i] + all[i + 1]) - all[i - 1] - all[i + 2])));
    }

    /** Returns the function of x through positive values: cubics through the logarithms of four. */
    between(values) {
        const logarithms = values.map(Math.log), last = values.length - 1;
        return (x) => {
            const place = clamped((Math.log(x) - this.from) / this.step, [0, last]), i = clamped(Math.floor(place) - 1, [0, last - 3]);
            const [t, p, q, r] = [0, 1, 2, 3].map((k) => place - i - k), [a, b, c, d] = logarithms.slice(i, i + 4);
            return Math.exp((3 * t * r * (q * b - p * c) + p * q * (t * d - r * a)) / 6);
        };
    }
}

/** Returns the quantities of a material, in units of Es*, from its gamma by the integrals of derived.rs. */
function derived(gamma) {
    const grid = new Grid(TABLE.range), squares = grid.x.map((x) => gamma(x) ** 2);
    // The integrals begin with a thick film (thick_film.rs).
    const [first] = grid.x, [one, two] = [1, 2].map((multiple) => 1 / gamma(multiple * first));
    const u = (two - 2 * one + 1) / (14 * one - 2), alpha = one / (1 + u) - 1 - u;
    const integrals = (rate, start) => grid.integrals(grid.x.map((x, i) => x * rate(squares[i], i)), start);
    const stiffness = integrals((square) => square, first / (1 + alpha + u));
    const penetration = integrals((square, i) => (2 * stiffness[i]) / square, first ** 2 * (1 + (2 / 3) * alpha * (1 + u) + 1.2 * u));
    const load = integrals((square, i) => (8 * stiffness[i] ** 2) / square, (8 / 3) * first ** 3 * (1 + u));
    const [eeq, delta0, pi0] = [stiffness, penetration, load].map((values) => grid.between(values));
    return (x) => ({ gamma: gamma(x), eeq: eeq(x) / x, delta0: delta0(x) / x ** 2, pi0: pi0(x) / x ** 3 });
}

/**
 * Returns the quantities with pi0 and delta0 of a sphere: those of the paraboloid that would have its load and penetration.
 * `radius` is that of the sphere over the film thickness. The sphere is the sum of the even powers y^2k/(2k - 1) of y = a/R,
 * whose penetrations y^2k Delta_2k and moments y^(2k+1) mu_2k are those of the ladder in even_powers/mod.rs.
 */
function ofSphere(quantities, radius) {
    const grid = new Grid([TABLE.range[0], Math.min(TABLE.range[1], LARGEST.sphere * radius)]);
    const nodes = grid.x.map((x) => ({ y: x / radius, ...quantities(x) }));
    const stiffness = nodes.map(({ y, eeq }) => y * eeq);
    let penetrations = nodes.map(({ y, delta0 }) => y * y * delta0);
    let moments = nodes.map(({ y, pi0 }, i) => penetrations[i] * stiffness[i] - 0.25 * y ** 3 * pi0);
    let [penetration, moment] = [penetrations, moments];
    // The powers left out change the sums by 1e-5.
    for (let k = 2; k <= 20; k += 1) {
        const lower = moments, integrals = (rates, power) => grid.integrals(rates, rates[0] / power);
        penetrations = integrals(nodes.map(({ y, gamma }, i) => (2 * k * (2 * k - 1) * y * lower[i]) / gamma ** 2), 2 * k);
        moments = integrals(nodes.map(({ y, gamma }, i) => y * gamma ** 2 * penetrations[i]), 2 * k + 1);
        [penetration, moment] = [[penetration, penetrations], [moment, moments]]
            .map(([sum, terms]) => sum.map((value, i) => value + terms[i] / (2 * k - 1)));
    }
    const pi0 = grid.between(penetration.map((value, i) => 4 * (value * stiffness[i] - moment[i]))), delta0 = grid.between(penetration);
    return (x) => ({ ...quantities(x), pi0: pi0(x) / (x / radius) ** 3, delta0: delta0(x) / (x / radius) ** 2 });
}
