// The contact in SI units: eqs. 2 to 9 (mechanics.rs), and its separation (equilibria.rs).

/** Returns the root of `f` between `low` and `high`, at which `f` has opposite signs. */
function root(f, low, high) {
    const sign = Math.sign(f(low));
    for (let i = 0; i < 60; i += 1) {
        const middle = 0.5 * (low + high);
        if (Math.sign(f(middle)) === sign) low = middle; else high = middle;
    }
    return 0.5 * (low + high);
}

/** The largest contact radius under each probe, over its radius; that of the sphere is LARGEST_A_OVER_R of the crate contact. */
const LARGEST = { paraboloid: 1 - 1e-12, sphere: 0.55 * (1 - 1e-12) };

/** The contact of a sphere, or of its paraboloid, with a film on a substrate, with a work of adhesion. */
class Contact {
    /** `quantities` are those at an a/t. `system` has thickness, radius, modulus (Es*), workOfAdhesion and the largest contact radius. */
    constructor(quantities, system) {
        Object.assign(this, system, { quantities });
        this.range = TABLE.range.map((x) => Math.min(rounded(x * this.thickness), this.largest));
        const [first, last] = this.range, count = Math.max(2, Math.ceil(Math.log(last / first) / 0.05));
        this.states = Array.from({ length: count + 1 }, (_, i) => this.state(first * (last / first) ** (i / count)));
    }

    /** Returns load and penetration at contact radius `a`: the parts without adhesion less those that adhesion subtracts. */
    state(a) {
        const { radius, modulus } = this, { pi0, eeq, gamma, delta0 } = this.quantities(a / this.thickness);
        const edge = Math.sqrt(0.5 * Math.PI * a * this.workOfAdhesion * modulus);
        return {
            contact_radius: a,
            a_over_t: a / this.thickness,
            load: (0.5 * a ** 3 * modulus * pi0) / radius - (4 * a * edge * eeq) / gamma,
            penetration: (a * a * delta0) / radius - (2 * edge) / (modulus * gamma),
        };
    }

    /** Returns the state with the least load or penetration, where the contact separates; null if the table does not reach it. */
    pullOff(controlled) {
        const { states } = this, values = states.map((state) => state[controlled]), i = values.indexOf(Math.min(...values));
        if (this.workOfAdhesion === 0 || i === 0 || values.at(-1) <= values.at(-2)) return null;
        const slope = (a) => this.state(1.0001 * a)[controlled] - this.state(0.9999 * a)[controlled];
        return this.state(root(slope, states[i - 1].contact_radius, states[i + 1].contact_radius));
    }

    /** Returns the largest stable contact at zero load; null if the table does not reach it, or without adhesion. */
    zeroLoad() {
        const { states } = this, i = states.findLastIndex(({ load }, k) => k > 0 && load >= 0 && states[k - 1].load <= 0);
        if (this.workOfAdhesion === 0 || i < 0) return null;
        // Exactly zero, without the rounding error of the root.
        return { ...this.state(root((a) => this.state(a).load, states[i - 1].contact_radius, states[i].contact_radius)), load: 0 };
    }

    /** Returns the range of contact radii to draw: up to 1.3 times the one at zero load; without adhesion, up to a tenth of the radius. */
    drawn() {
        const [first, last] = this.range, rest = this.zeroLoad();
        let to = first;
        if (rest) to = Number((1.3 * rest.contact_radius).toPrecision(3));
        else if (this.workOfAdhesion === 0) to = 0.1 * this.radius;
        else if (this.states.at(-1).load < 0) to = last;
        to = Math.min(rounded(Math.max(to, 10 * first)), last);
        return [Math.max(first, rounded(1e-6 * to)), to];
    }
}

/** The contact of a flat punch, whose radius is that of the contact: its load is proportional to its penetration until it separates. */
function punch(quantities, { thickness, radius, modulus, workOfAdhesion }) {
    const { eeq, gamma } = quantities(radius / thickness), adhesive = workOfAdhesion > 0;
    const stiffness = 2 * radius * modulus * eeq, a_over_t = radius / thickness;
    const state = (penetration) => ({ contact_radius: radius, a_over_t, load: stiffness * penetration, penetration });
    /** How far the punch can be pulled. */
    const pulled = Math.sqrt((2 * Math.PI * radius * workOfAdhesion) / modulus) / gamma;
    return {
        radius, workOfAdhesion, state,
        pullOff: () => (adhesive ? state(-pulled) : null),
        zeroLoad: () => state(0),
        /** The range of penetrations to draw: as far in as out, or a tenth of the radius without adhesion. */
        drawn: () => (adhesive ? [-pulled, pulled] : [0, 0.1 * radius]),
    };
}
