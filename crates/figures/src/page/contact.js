// The contact in SI units: eqs. 2 to 9 (mechanics.rs), and its separation (equilibria.rs).

/** The largest contact radius over the radius of the sphere. */
const BELOW_SPHERE = 1 - 1e-12;
/** The step in ln a of the grid on which turning points are searched. */
const SEARCH_STEP = 0.05;

/** Returns the root of `f` between `low` and `high`, at which `f` has opposite signs. */
function root(f, low, high) {
    const sign = Math.sign(f(low));
    for (let i = 0; i < 200; i += 1) {
        const middle = 0.5 * (low + high);
        if (middle === low || middle === high) break;
        if (Math.sign(f(middle)) === sign) low = middle; else high = middle;
    }
    return 0.5 * (low + high);
}

/** The contact of a sphere, or of its paraboloid, with a film on a substrate, with a work of adhesion. */
class Contact {
    /**
     * `curve` holds the quantities; `system` thickness, workOfAdhesion, modulus: Es*, the unit of the quantities, order and
     * factor: on a half-space the penetration without adhesion is factor a^order, largest: the largest contact radius of the
     * probe, and extent: the contact radius up to which a curve without adhesion is drawn.
     */
    constructor(table, curve, system) {
        Object.assign(this, system, { curve });
        /** The contact radii that the table covers, up to the largest one. */
        this.range = table.range("a_over_t").map((x) => Math.min(rounded(x * this.thickness), this.largest));
        this.sections = { load: this.sectionsOf("load"), penetration: this.sectionsOf("penetration") };
    }

    /** Returns load, penetration and their slopes d/d ln a at contact radius `a`. */
    state(a) {
        const { pi0, eeq, gamma, delta0 } = this.curve.at(a / this.thickness);
        const edge = Math.sqrt(0.5 * Math.PI * a * this.workOfAdhesion * this.modulus);
        // The parts without adhesion, and the parts that adhesion subtracts.
        const power = this.factor * a ** this.order;
        const pressed = { load: 0.5 * power * a * this.modulus * pi0.value, penetration: power * delta0.value };
        const pulled = {
            load: (4 * a * edge * eeq.value) / gamma.value,
            penetration: (2 * edge) / (this.modulus * gamma.value),
        };
        return {
            contact_radius: a,
            load: pressed.load - pulled.load,
            penetration: pressed.penetration - pulled.penetration,
            slopes: {
                load: pressed.load * (this.order + 1 + pi0.slope) - pulled.load * (1.5 + eeq.slope - gamma.slope),
                penetration: pressed.penetration * (this.order + delta0.slope) - pulled.penetration * (0.5 - gamma.slope),
            },
        };
    }

    /** Splits the table's contact radii into sections on which `controlled`, "load" or "penetration", rises or falls. */
    sectionsOf(controlled) {
        const [first, last] = this.range.map(Math.log);
        const slope = (u) => this.state(Math.exp(u)).slopes[controlled];
        const count = Math.max(1, Math.ceil((last - first) / SEARCH_STEP));
        const place = (i) => first + ((last - first) * i) / count;
        const sections = [];
        let start = first, rises = slope(first) >= 0;
        const end = (u) => {
            sections.push({ u: [start, u], imposed: [start, u].map((v) => this.state(Math.exp(v))[controlled]), rises });
            start = u;
        };
        for (let i = 1; i <= count; i += 1) {
            if (slope(place(i)) >= 0 !== rises) {
                end(root(slope, place(i - 1), place(i)));
                rises = !rises;
            }
        }
        end(last);
        return sections;
    }

    /** Returns the state at which the contact separates: null if its contact radius is outside the table, or without adhesion. */
    pullOff(controlled) {
        const sections = this.sections[controlled];
        if (this.workOfAdhesion === 0 || sections[0].rises || !sections.at(-1).rises) return null;
        const stable = sections.filter((section) => section.rises);
        const least = stable.reduce((a, b) => (b.imposed[0] < a.imposed[0] ? b : a));
        return this.state(Math.exp(least.u[0]));
    }

    /** Returns the largest stable contact at zero load: null if its contact radius is outside the table, or without adhesion. */
    zeroLoad() {
        const rest = this.sections.load.findLast(({ rises, imposed: [from, to] }) => rises && from <= 0 && to >= 0);
        if (this.workOfAdhesion === 0 || !rest) return null;
        // Exactly zero, without the rounding error of the root.
        return { ...this.state(Math.exp(root((u) => this.state(Math.exp(u)).load, ...rest.u))), load: 0 };
    }

    /** Returns the range of contact radii to draw: up to 1.3 times the one at zero load; without adhesion, up to the extent. */
    drawn() {
        const [first, last] = this.range, rest = this.zeroLoad();
        let to = first;
        if (rest) to = Number((1.3 * rest.contact_radius).toPrecision(3));
        else if (this.workOfAdhesion === 0) to = this.extent;
        else if (this.state(last).load < 0) to = last;
        to = Math.min(rounded(Math.max(to, 10 * first)), last);
        return [Math.max(first, rounded(1e-6 * to)), to];
    }

    /** Returns the part of a drawn range of which points are printed. */
    printed([from, to]) {
        return [Math.max(from, rounded(0.1 * to, 4)), to];
    }
}
