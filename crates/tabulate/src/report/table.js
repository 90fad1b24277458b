// Reads a table that the crate `interp` packed (packed.rs), and evaluates its splines (bspline.rs, low_rank.rs, tiles.rs).

/** The version of the packed form that this page reads. */
const PACKED_VERSION = 2;
/** The bytes before the payload: 8 of magic, the version (u32), the length (u64) and the CRC-32 (u32) of the payload. */
const PREFIX = 24;
/** The degree of the splines through a table's nodes, where there are enough of them. */
const DEGREE = 9;
/** The largest relative rounding error of a ratio of moduli. */
const ROUNDING = 1e-12;

const QUANTITIES = ["pi0", "eeq", "gamma", "delta0"];
/** All parameters of axes: in files, an axis has the number of its parameter here. */
const PARAMETERS = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "e1s_over_einfs", "e0s_over_e2s"];
/** The dimensions of a table (a/t, film's modulus, film's Poisson ratio, substrate's modulus) in the order of a train's cores. */
const CORES = [3, 1, 2, 0];
/** The number of nodes by which a tile reaches beyond the nodes where it meets its neighbours (tiles.rs). */
const OVERLAP = 16;

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
    /** Reads a signed integer of variable width, in the order 0, -1, 1, -2. */
    signed() {
        const wide = this.bytes[this.at] === 253;
        const zigzag = wide ? this.view.getBigUint64(this.take(9) + 1, true) : BigInt(this.variable());
        return Number(zigzag & 1n ? -(zigzag >> 1n) - 1n : zigzag >> 1n);
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

/** The B-splines on the nodes of an axis, with "not-a-knot" ends. */
class Basis {
    constructor(nodes) {
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
        const numbers = (item) => Float64Array.from(reader.array(reader.variable(), () => item()));
        const double = () => reader.f64();
        const cuts = numbers(() => reader.variable());
        const [, film] = Object.keys(this.axes), nodes = this.axes[film];
        /** The coordinates of the film's modulus where tiles meet. */
        this.breaks = Array.from(cuts, (cut) => coordinate(film, nodes[cut]));
        this.tiles = reader.array(reader.variable(), (_, i) => {
            const start = i === 0 ? 0 : Math.max(cuts[i - 1] - OVERLAP, 0);
            const end = i === cuts.length ? nodes.length : cuts[i] + OVERLAP + 1;
            const weights = reader.array(3, () => numbers(double));
            const functions = reader.array(4, () => numbers(double));
            const steps = reader.array(4, double);
            const cores = reader.array(4, () => numbers(() => reader.signed()));
            return this.train({ ...this.axes, [film]: nodes.slice(start, end) }, { weights, functions, steps, cores });
        });
        /** True if all quantities follow from gamma, the only one held. */
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

    /** The cores of a tensor train on the nodes of `axes`. */
    train(axes, { weights, functions, steps, cores }) {
        return CORES.map((dimension, i) => {
            const [parameter, nodes] = Object.entries(axes)[dimension];
            const basis = new Basis(nodes.map((node) => coordinate(parameter, node)));
            const count = functions[i].length / nodes.length;
            // The splines of a core are those of the functions that it combines.
            basis.interpolate(functions[i], count);
            return { parameter, basis, count, functions: functions[i], numbers: cores[i].map((n) => n * steps[i]), weights: weights[i] };
        });
    }

    /** True if the table holds a quantity, or derives it. */
    answers(quantity) {
        return this.derives || this.held.includes(quantity);
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
        const at = this.place(this.parameters[0], material[this.parameters[0]]);
        const cores = this.tiles[this.breaks.filter((end) => end <= at).length];
        let vector = [1];
        for (const { parameter, basis, count, functions, numbers, weights } of cores.slice(0, 3)) {
            const after = weights.length, splines = basis.weights(this.place(parameter, material[parameter]));
            const next = new Float64Array(after);
            for (let f = 0; f < count; f += 1) {
                let value = 0;
                splines.values.forEach((spline, k) => { value += spline * functions[(splines.first + k) * count + f]; });
                vector.forEach((entry, b) => {
                    const factor = entry * value, row = (b * count + f) * after;
                    for (let a = 0; a < after; a += 1) next[a] += factor * numbers[row + a];
                });
            }
            vector = next.map((entry, a) => entry / weights[a]);
        }
        const { basis, count, functions, numbers } = cores[3], held = this.held.length;
        const sums = new Float64Array(count * held);
        vector.forEach((entry, c) => {
            for (let k = 0; k < sums.length; k += 1) sums[k] += entry * numbers[c * sums.length + k];
        });
        const coefficients = this.held.map((_, q) => Float64Array.from({ length: basis.count }, (_, node) => {
            let sum = 0;
            for (let f = 0; f < count; f += 1) sum += functions[node * count + f] * sums[f * held + q];
            return sum;
        }));
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
