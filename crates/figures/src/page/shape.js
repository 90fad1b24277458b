// Other probes than the paraboloid: the sphere itself (even_powers/mod.rs) and the flat punch.

/** The largest contact radius under the sphere itself that is computed, over the radius of the sphere. */
const LARGEST_UNDER_SPHERE = 0.8;
/** The largest step in ln(a/t) of the integrals of the sphere, and of the splines between them. */
const SPHERE_STEP = 0.025;
/** The relative size of the terms of the sphere's series that are left out. */
const LEFT_OUT = 1e-10;

/** The moments and penetrations of a thick film, whose kernel is alpha + beta (rho² + s²), from its pi0 and eeq. */
function thickFilm({ pi0, eeq }) {
    const u = 0.375 * pi0.value - 1, alpha = 1 / eeq.value - 1 - u, beta = 1.5 * u;
    const [a, b, c, d] = [1 + alpha + beta / 3, beta, alpha / 3 + beta / 5, 1 + beta / 3], determinant = a * d - b * c;
    /** The moments of order 0 and 2 of the solution for the right-hand side rho^n. */
    const solve = (n) => {
        const [f0, f2] = [1 / (n + 1), 1 / (n + 3)];
        return [(d * f0 - b * f2) / determinant, (a * f2 - c * f0) / determinant];
    };
    const edge = (n) => {
        const [m0, m2] = solve(n);
        return 1 - (alpha + beta) * m0 - beta * m2;
    };
    const [m0, m2] = solve(0);
    return {
        penetration: (n) => edge(n) / edge(0),
        moment: (n) => (1 - alpha * m0 - beta * m2) / (n + 1) - (beta * m0) / (n + 3),
    };
}

/**
 * The quantities of one material, with pi0 and delta0 of a sphere: those of the paraboloid that would have its load and
 * penetration. The sphere is the sum of the even powers y^2k/(2k - 1), with y = a/R, and for each of them
 *
 *     (y^2k Delta_2k)' = 2k (2k - 1) y^(2k-1) mu_(2k-2)/gamma²     (y^(2k+1) mu_2k)' = y^2k gamma² Delta_2k
 *
 * in units of Es*, from mu_0 = eeq and Delta_2 = delta0.
 */
class SphereCurve {
    /** `radius` is that of the sphere over the film thickness. */
    constructor(curve, [first, last], radius) {
        Object.assign(this, { curve, radius });
        const end = Math.min(last, LARGEST_UNDER_SPHERE * radius);
        this.ends = [first, end].map(Math.log);
        const [from, to] = this.ends, count = Math.ceil((to - from) / SPHERE_STEP);
        this.step = (to - from) / count;
        const terms = Math.max(2, Math.ceil(Math.log(LEFT_OUT) / (2 * Math.log(end / radius))));
        const thick = thickFilm(curve.at(first)), y = first / radius;
        /** y^2k Delta_2k and y^(2k+1) mu_2k, k = 0, 1, 2 .., at the place that the integrals have reached. */
        const penetrations = Float64Array.from({ length: terms + 1 }, (_, k) => y ** (2 * k) * thick.penetration(2 * k));
        const moments = Float64Array.from({ length: terms + 1 }, (_, k) => y ** (2 * k + 1) * thick.moment(2 * k));
        /** The logarithms of pi0 and delta0 and their slopes, at the ends of the steps. */
        this.nodes = [this.node(from, penetrations, moments)];
        for (let i = 0; i < count; i += 1) {
            this.advance(from + i * this.step, penetrations, moments);
            this.nodes.push(this.node(from + (i + 1) * this.step, penetrations, moments));
        }
    }

    /** Takes the integrals from ln x = `from` to the end of the step. */
    advance(from, penetrations, moments) {
        const { step, curve, radius } = this;
        const inside = GAUSS.points.map((part) => {
            const x = Math.exp(from + part * step), { eeq, gamma, delta0 } = curve.at(x), y = x / radius;
            return { length: step * y, square: gamma.value ** 2, moment: y * eeq.value, penetration: y * y * delta0.value };
        });
        const integral = (values, k, rate) => {
            const rates = inside.map(rate), start = values[k];
            values[k] += weighted(GAUSS.whole, rates);
            return GAUSS.inner.map((weights) => start + weighted(weights, rates));
        };
        for (let k = 1; k < moments.length; k += 1) {
            if (k > 1) {
                const factor = 2 * k * (2 * k - 1);
                const all = integral(penetrations, k, ({ length, square, moment }) => (factor * length * moment) / square);
                inside.forEach((point, i) => { point.penetration = all[i]; });
            }
            const all = integral(moments, k, ({ length, square, penetration }) => length * square * penetration);
            inside.forEach((point, i) => { point.moment = all[i]; });
        }
    }

    /** Returns ln pi0 and ln delta0 and their slopes at ln x = `u`, from the integrals there. */
    node(u, penetrations, moments) {
        const x = Math.exp(u), y = x / this.radius, { eeq, gamma, delta0 } = this.curve.at(x);
        [moments[0], penetrations[1]] = [y * eeq.value, y * y * delta0.value];
        let [penetration, moment, flux] = [0, 0, 0];
        for (let k = moments.length - 1; k > 0; k -= 1) {
            penetration += penetrations[k] / (2 * k - 1);
            moment += moments[k] / (2 * k - 1);
            flux += 2 * k * moments[k - 1];
        }
        const load = 2 * (penetration * moments[0] - moment), rate = (y * flux) / gamma.value ** 2;
        return {
            pi0: [Math.log((2 * load) / y ** 3), (2 * moments[0] * rate) / load - 3],
            delta0: [Math.log(penetration / y ** 2), rate / penetration - 2],
        };
    }

    /** Returns the value of each quantity and its logarithmic slope d ln Q / d ln(a/t). */
    at(x) {
        const [from, to] = this.ends, place = (Math.min(Math.max(Math.log(x), from), to) - from) / this.step;
        const i = Math.min(Math.floor(place), this.nodes.length - 2), t = place - i;
        const between = (quantity) => {
            const [[f, df], [g, dg]] = [this.nodes[i][quantity], this.nodes[i + 1][quantity]];
            const [p, q] = [(g - f) / this.step - df, (g - f) / this.step - dg];
            // Hermite's cubic, and its derivative.
            const logarithm = f + t * (g - f) + t * (1 - t) * this.step * (t * q - (1 - t) * p);
            const slope = (g - f) / this.step + (1 - 2 * t) * (t * q - (1 - t) * p) + t * (1 - t) * (q + p);
            return { value: Math.exp(logarithm), slope };
        };
        return { ...this.curve.at(x), pi0: between("pi0"), delta0: between("delta0") };
    }
}

/** The contact of a flat punch. Its radius does not change: it has one state at each penetration. */
class Punch {
    /** `curve` and `system` as those of a `Contact`. */
    constructor(curve, system) {
        Object.assign(this, system);
        const { eeq, gamma } = curve.at(this.radius / this.thickness);
        this.stiffness = 2 * this.radius * this.modulus * eeq.value;
        /** The penetration at which the punch separates, without its sign. */
        this.pulled = Math.sqrt((2 * Math.PI * this.radius * this.workOfAdhesion) / this.modulus) / gamma.value;
    }

    state(penetration) {
        const slopes = { load: this.stiffness, penetration: 1 };
        return { contact_radius: this.radius, load: this.stiffness * penetration, penetration, slopes };
    }

    pullOff() {
        return this.workOfAdhesion === 0 ? null : this.state(-this.pulled);
    }

    zeroLoad() {
        return this.state(0);
    }

    /** Returns the range of penetrations to draw: as far in as out, or a tenth of the radius without adhesion. */
    drawn() {
        return this.workOfAdhesion === 0 ? [0, 0.1 * this.radius] : [-this.pulled, this.pulled];
    }

    printed(drawn) {
        return drawn;
    }
}
