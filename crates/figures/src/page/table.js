// Reads a table that the crate `interp` packed (packed.rs, entropy.rs), and evaluates its polynomials and splines (chebyshev.rs, low_rank.rs, bspline.rs).

/** The version of the packed form that this page reads. */
const PACKED_VERSION = 4;
/** The bytes before the payload: 8 of magic, the version (u32), the length (u64) and the CRC-32 (u32) of the payload. */
const PREFIX = 24;
/** The degree of the splines through a table's nodes, where there are enough of them. */
const DEGREE = 9;
/** The largest relative rounding error of a ratio of moduli. */
const ROUNDING = 1e-12;

const QUANTITIES = ["pi0", "eeq", "gamma", "delta0"];
/** All parameters of axes: in files, an axis has the number of its parameter here. */
const PARAMETERS = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "e1s_over_einfs", "e0s_over_e2s"];
/** For each dimension (a/t, film's modulus, film's Poisson ratio, substrate's modulus) the degree from which the factors of the polynomials fall. */
const SMOOTH_DEGREE = [40, 20, 2, 20];
/** The largest number of integers that a byte of their code holds, and their largest length in bits. */
const MOST_IN_A_BYTE = 6, MOST_BITS = 54;

/** Reads numbers, texts and lists in bincode's two encodings: integers of fixed and of variable width. */
class Reader {
    constructor(bytes, at) {
        this.bytes = bytes;
        this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
        this.at = at;
    }
    take(size) {
        this.at += size;
        return this.at - size;
    }
    f64() {
        return this.view.getFloat64(this.take(8), true);
    }
    u32() {
        return this.view.getUint32(this.take(4), true);
    }
    u64() {
        return Number(this.view.getBigUint64(this.take(8), true));
    }
    option(item) {
        return this.view.getUint8(this.take(1)) === 1 ? item() : null;
    }
    text() {
        const length = this.u64();
        return new TextDecoder().decode(this.bytes.subarray(this.take(length), this.at));
    }
    /** Reads an unsigned integer of variable width: one byte below 251, otherwise a mark and 2, 4 or 8 bytes. */
    variable() {
        const byte = this.view.getUint8(this.take(1));
        switch (byte) {
            case 251: return this.view.getUint16(this.take(2), true);
            case 252: return this.u32();
            case 253: return this.u64();
            default: return byte;
        }
    }
    i8() {
        return this.view.getInt8(this.take(1));
    }
    /** Reads a list of bytes. */
    raw() {
        const length = this.variable();
        return this.bytes.subarray(this.take(length), this.at);
    }
    array(count, item) {
        return Array.from({ length: count }, item);
    }
}

/** The CRC-32 of bytes, as in zip and PNG. */
function checksum(bytes) {
    const table = Uint32Array.from({ length: 256 }, (_, byte) => {
        let remainder = byte;
        for (let bit = 0; bit < 8; bit += 1) remainder = (remainder >>> 1) ^ (remainder & 1 ? 0xedb88320 : 0);
        return remainder;
    });
    let remainder = 0xffffffff;
    for (const byte of bytes) remainder = (remainder >>> 8) ^ table[(remainder ^ byte) & 255];
    return ~remainder >>> 0;
}

/** Reads the integers of cores: an adaptive binary range decoder. */
class Integers {
    constructor(bytes) {
        Object.assign(this, { bytes, at: 0, code: 0, range: 0xffffffff });
        for (let i = 0; i < 4; i += 1) this.shift();
        /** For each context and number of bits: two estimates of the probability that an integer is not longer, in units of 2^-16. */
        this.longer = Array.from({ length: 120 }, () => new Uint16Array(2 * MOST_BITS).fill(1 << 15));
        /** For each length: those of the first bit after the leading one, and of the second after either. */
        this.next = Array.from({ length: MOST_BITS + 1 }, () => new Uint16Array(6).fill(1 << 15));
    }
    shift() {
        const byte = this.at < this.bytes.length ? this.bytes[this.at] : 0;
        this.code = ((this.code << 8) | byte) >>> 0;
        this.at += 1;
    }
    narrow(bound) {
        const decision = this.code >= bound;
        if (decision) {
            this.code -= bound;
            this.range -= bound;
        } else {
            this.range = bound;
        }
        while (this.range < 0x1000000) {
            this.range = (this.range << 8) >>> 0;
            this.shift();
        }
        return decision ? 1 : 0;
    }
    even() {
        return this.narrow(this.range >>> 1);
    }
    adaptive(estimates, i) {
        const fast = estimates[2 * i], slow = estimates[2 * i + 1];
        const decision = this.narrow((this.range >>> 16) * ((fast + slow) >>> 1));
        estimates[2 * i] = decision ? fast - (fast >>> 4) : fast + ((0xffff - fast) >>> 4);
        estimates[2 * i + 1] = decision ? slow - (slow >>> 7) : slow + ((0xffff - slow) >>> 7);
        return decision;
    }
    integer(context) {
        let bits = 0;
        while (bits < MOST_BITS && this.adaptive(this.longer[context], bits)) bits += 1;
        if (bits === 0) return 0;
        let found = 1;
        for (let read = 0; read < bits - 1; read += 1) {
            // Integers may be longer than the 32 bits of JavaScript's operators.
            found = 2 * found + (read === 0 ? this.adaptive(this.next[bits], 0)
                : read === 1 ? this.adaptive(this.next[bits], 1 + (found & 1)) : this.even());
        }
        return this.even() ? -found : found;
    }
    /** Reads the integers of a core: row-major over the bond before, the degree, and the next bond. */
    core([before, terms, after]) {
        const core = new Float64Array(before * terms * after), sizes = new Int32Array(core.length);
        // Twice the size of the nearest neighbour, and the next one's as often as `far` says.
        const near = (i, place, stride, far) => (place > 0 ? 2 * sizes[i - stride] : 0) + (place > 1 ? far * sizes[i - 2 * stride] : 0);
        let i = 0;
        for (let b = 0; b < before; b += 1) for (let k = 0; k < terms; k += 1) for (let a = 0; a < after; a += 1, i += 1) {
            const sum = 2 + near(i, a, 1, 1) + near(i, k, after, 2) + near(i, b, after * terms, 1);
            const length = 31 - Math.clz32(sum);
            core[i] = this.integer(4 * (length - 1) + (Math.floor((4 * sum) / 2 ** length) & 3));
            sizes[i] = Math.min(Math.abs(core[i]), 2 ** 26);
        }
        return core;
    }
    /** Reads the cores of these shapes; zeros must follow, so that no byte holds too many integers. */
    static cores(bytes, shapes) {
        const count = shapes.reduce((sum, [before, terms, after]) => sum + before * terms * after, 0);
        if (!(count <= MOST_IN_A_BYTE * bytes.length)) throw new Error("the data is damaged");
        const reader = new Integers(bytes), cores = shapes.map((shape) => reader.core(shape));
        const end = Math.max(reader.at, Math.ceil(count / MOST_IN_A_BYTE));
        if (end !== bytes.length || bytes.subarray(reader.at).some((byte) => byte !== 0)) throw new Error("the data is damaged");
        return cores;
    }
}

/** Returns the values at `u` of `count` polynomials along a dimension of a tile (chebyshev.rs). */
function polynomials(dimension, count, [from, to], u) {
    const t = to > from ? (u - from - (to - u)) / (to - from) : 0;
    let before = t, present = 1;
    return Float64Array.from({ length: count }, (_, k) => {
        const value = present;
        [before, present] = [present, 2 * t * present - before];
        return k === 0 ? value : (Math.SQRT2 * value) / Math.hypot(k / SMOOTH_DEGREE[dimension], 1);
    });
}

/** The B-splines on the nodes of an axis, with "not-a-knot" ends. */
class Basis {
    constructor(nodes) {
        this.nodes = nodes;
        this.count = nodes.length;
        this.degree = Math.min(DEGREE, this.count - 1);
        const p = this.degree;
        const dropped = Math.ceil(p / 2);
        const inner = this.count - p - 1;
        const last = nodes[this.count - 1];
        this.knots = [...Array(p + 1).fill(nodes[0]), ...nodes.slice(dropped, dropped + inner), ...Array(p + 1).fill(last)];
        this.matrix = nodes.map((node) => {
            const row = new Float64Array(this.count);
            const { first, values } = this.weights(node);
            values.forEach((value, i) => { row[first + i] = value; });
            return row;
        });
    }

    /** Returns the values and slopes at `u` of the splines that do not vanish there, from number `first` on (Cox-de Boor). */
    weights(u) {
        const p = this.degree, { knots } = this;
        let span = p;
        while (span + 1 < knots.length - p - 1 && knots[span + 1] <= u) span += 1;
        let values = [1], lower = [1];
        for (let degree = 1; degree <= p; degree += 1) {
            lower = values;
            values = [];
            let carried = 0;
            lower.forEach((value, i) => {
                const left = knots[span + 1 + i - degree], right = knots[span + 1 + i];
                const share = value / (right - left);
                values.push(carried + (right - u) * share);
                carried = (u - left) * share;
            });
            values.push(carried);
        }
        const first = span - p;
        const slopes = Array(p + 1).fill(0);
        for (let i = 0; i < p; i += 1) {
            const share = (p * lower[i]) / (knots[span + 1 + i] - knots[span + 1 + i - p]);
            slopes[i] -= share;
            slopes[i + 1] += share;
        }
        return { first, values, slopes };
    }

    /** Replaces rows of values at the nodes, of `width` splines side by side, by rows of spline coefficients. */
    interpolate(rows, width) {
        const matrix = this.matrix.map((row) => row.slice()), n = this.count;
        const subtract = (target, source, factor) => {
            for (let k = 0; k < width; k += 1) rows[target * width + k] -= factor * rows[source * width + k];
        };
        // The matrix is totally positive: elimination needs no pivots.
        for (let i = 0; i < n; i += 1) {
            for (let below = i + 1; below < Math.min(n, i + DEGREE + 1); below += 1) {
                const factor = matrix[below][i] / matrix[i][i];
                if (factor === 0) continue;
                for (let k = i; k < n; k += 1) matrix[below][k] -= factor * matrix[i][k];
                subtract(below, i, factor);
            }
        }
        for (let i = n - 1; i >= 0; i -= 1) {
            for (let k = i + 1; k < n; k += 1) if (matrix[i][k] !== 0) subtract(i, k, matrix[i][k]);
            for (let k = 0; k < width; k += 1) rows[i * width + k] /= matrix[i][i];
        }
    }
}

/** The coordinate of a parameter in which the splines are polynomials (parameter.rs). */
function coordinate(parameter, value) {
    switch (parameter) {
        case "nu1": return -((1 - 2 * value + 1e-6) ** 0.125);
        case "e1s_over_einfs": return Math.log(value + 1e-10);
        case "e0s_over_e2s": {
            // Both forms are exact at their end.
            const end = (ratio) => Math.log((ratio + 1e-11) / (1 + 1e-11 * ratio));
            return value < 1 ? end(value) : -end(1 / value);
        }
        default: return Math.log(value);
    }
}

/** A low-rank table. Quantities are in units of Es*, the modulus of sphere and film: 1/Es* = 1/E1* + 1/E2*. */
class Table {
    constructor(bytes) {
        const reader = new Reader(bytes, 8), { f64, u32, u64 } = Reader.prototype;
        // What is whole was checked when the page was made.
        const isWhole = bytes.length >= PREFIX && reader.u32() === PACKED_VERSION && reader.u64() === bytes.length - PREFIX
            && reader.u32() === checksum(bytes.subarray(PREFIX));
        if (!isWhole) throw new Error("the data is damaged");
        const list = (item) => reader.array(reader.u64(), () => item.call(reader));
        // The description: title, scene, nu0, tolerance, program, certificate.
        reader.text();
        reader.text();
        /** The Poisson ratio of the substrate; null if it is the pair of the film's. */
        this.nu0 = reader.u32() === 0 ? reader.f64() : null;
        this.tolerance = reader.f64();
        reader.text();
        [f64, f64, f64, u64, u64, u32, f64, f64, f64, f64].forEach((item) => item.call(reader));
        reader.array(4, () => reader.option(() => reader.f64()));
        this.axes = Object.fromEntries(reader.array(4, () => [PARAMETERS[reader.u32()], list(f64)]));
        this.held = list(u32).map((variant) => QUANTITIES[variant]);
        if (reader.u32() !== 1) throw new Error("the data is not in low-rank form");
        // The lengths of the pieces of a curve in Rust.
        list(u32);
        const index = () => reader.variable();
        const coordinates = Object.entries(this.axes).map(([parameter, nodes]) => nodes.map((node) => coordinate(parameter, node)));
        /** The B-splines along a/t. */
        this.basis = new Basis(coordinates[0]);
        this.tiles = reader.array(reader.variable(), () => {
            const [film, substrate] = [reader.array(2, index), reader.array(2, index)];
            const order = [...reader.array(3, index), 0], terms = reader.array(4, index);
            const weights = reader.array(3, () => reader.array(reader.variable(), () => 2 ** reader.i8()));
            const step = reader.f64();
            const bonds = [1, ...weights.map((all) => all.length), this.held.length];
            const shapes = terms.map((count, i) => [bonds[i], count, bonds[i + 1]]);
            const cores = Integers.cores(reader.raw(), shapes).map((core) => core.map((n) => n * step));
            const nodes = coordinates.map((all) => [0, all.length - 1]);
            [nodes[1], nodes[3]] = [film, substrate];
            const ends = coordinates.map((all, dimension) => nodes[dimension].map((node) => all[node]));
            return { order, shapes, weights, cores, ends };
        });
        if (reader.at !== bytes.length) throw new Error("the data is damaged");
        /** True if all quantities of a sphere follow from gamma, the only one of them that is held. */
        this.derives = this.held.join() === "gamma" && derivable(this.range("a_over_t"));
    }

    /** The parameters of a material, in the order of the dimensions: modulus and Poisson ratio of the film, modulus of the substrate. */
    get parameters() {
        return Object.keys(this.axes).slice(1);
    }

    /** True if the axes are those of reduced moduli, E1* over E∞* and E0* over E2*. */
    get reduced() {
        return "e1s_over_einfs" in this.axes;
    }

    /** True if the sphere is rigid and the axes are those of Young's moduli: e0_over_e2 is E0/E1. */
    get rigidSphere() {
        return !this.reduced && this.range("e1_over_e2")[0] === 0;
    }

    /** True if the table holds a quantity, or derives it. */
    answers(quantity) {
        return this.held.includes(quantity) || this.derives;
    }

    /** The first and the last node of a parameter. */
    range(parameter) {
        const nodes = this.axes[parameter];
        return [nodes[0], nodes[nodes.length - 1]];
    }

    /** True if the table holds a single value of the parameter. */
    fixes(parameter) {
        return this.axes[parameter].length === 1;
    }

    /** True if a value is in the table's range, to rounding. */
    covers(parameter, value) {
        const [from, to] = this.range(parameter);
        const size = (end) => (parameter === "nu1" ? 1 : Math.abs(end));
        const near = (end) => end !== Infinity && Math.abs(value - end) <= ROUNDING * size(end);
        return (value >= from && value <= to) || near(from) || near(to);
    }

    /** Returns the quantities of a material in the box, as functions of a/t. `material` has a value for each of the parameters. */
    curve(material) {
        const places = [0, ...this.parameters.map((parameter) => this.place(parameter, material[parameter]))];
        const inside = ({ ends }) => [1, 3].every((i) => places[i] >= ends[i][0] && places[i] <= ends[i][1]);
        const { order, shapes, weights, cores, ends } = this.tiles.find(inside);
        let vector = [1];
        for (let i = 0; i < 3; i += 1) {
            const [, terms, after] = shapes[i], dimension = order[i];
            const values = polynomials(dimension, terms, ends[dimension], places[dimension]);
            const next = new Float64Array(after);
            vector.forEach((entry, b) => values.forEach((value, k) => {
                const factor = entry * value, row = (b * terms + k) * after;
                for (let a = 0; a < after; a += 1) next[a] += factor * cores[i][row + a];
            }));
            vector = next.map((entry, a) => entry / weights[i][a]);
        }
        const [, terms, held] = shapes[3];
        const sums = new Float64Array(terms * held);
        vector.forEach((entry, c) => {
            for (let k = 0; k < sums.length; k += 1) sums[k] += entry * cores[3][c * sums.length + k];
        });
        // The values at the nodes of a/t become coefficients of the splines.
        const { basis } = this, coefficients = this.held.map(() => new Float64Array(basis.count));
        basis.nodes.forEach((place, node) => {
            polynomials(0, terms, ends[0], place).forEach((value, k) => {
                for (let q = 0; q < held; q += 1) coefficients[q][node] += value * sums[k * held + q];
            });
        });
        coefficients.forEach((row) => basis.interpolate(row, 1));
        const curve = new Curve(this, basis, coefficients);
        return this.derives ? new DerivedCurve(curve, this.range("a_over_t")) : curve;
    }

    /** Returns the coordinate of a value, clamped to the table's range. */
    place(parameter, value) {
        const [from, to] = this.range(parameter);
        return coordinate(parameter, Math.min(Math.max(value, from), to));
    }
}

/** The quantities of one material as functions of a/t. The splines are of ln(Pi0/es), ln(Eeq/es), ln(Gamma/es), ln Delta0. */
class Curve {
    constructor(table, basis, coefficients) {
        Object.assign(this, { table, basis, coefficients });
    }

    /** Returns the value of each quantity and its logarithmic slope d ln Q / d ln(a/t). A quantity not in the table is 1. */
    at(x) {
        const { first, values, slopes } = this.basis.weights(this.table.place("a_over_t", x));
        const result = Object.fromEntries(QUANTITIES.map((quantity) => [quantity, { value: 1, slope: 0 }]));
        this.table.held.forEach((quantity, q) => {
            let logarithm = 0, slope = 0;
            values.forEach((value, k) => {
                logarithm += value * this.coefficients[q][first + k];
                slope += slopes[k] * this.coefficients[q][first + k];
            });
            result[quantity] = { value: Math.exp(logarithm), slope };
        });
        return result;
    }
}
