// Draws curves as SVG.

/** A number rounded to `digits` digits: without the rounding error of a change of units. */
const rounded = (value, digits = 14) => Number(value.toPrecision(digits));

/** Makes an element of HTML or SVG with attributes and children. */
function element(name, attributes = {}, ...children) {
    const drawing = ["svg", "g", "path", "line", "text", "circle", "rect"].includes(name);
    const made = drawing ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...children);
    return made;
}

const PREFIXES = { 12: "T", 9: "G", 6: "M", 3: "k", 0: "", [-3]: "m", [-6]: "µ", [-9]: "n", [-12]: "p", [-15]: "f", [-18]: "a" };

/** The power of a thousand in which a value has one to three digits before the point, and its prefix. */
function prefix(value) {
    const thousands = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(value)) / 3 + 1e-9);
    const power = 3 * Math.min(4, Math.max(-6, thousands));
    return { scale: 10 ** power, prefix: PREFIXES[power] };
}

/** Returns about `count` round numbers from `low` to `high`. */
function ticks(low, high, count) {
    const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * (rough < 1.5 * power ? 1 : rough < 3.5 * power ? 2 : rough < 7 * power ? 5 : 10);
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, i) => rounded((first + i) * step, 10));
}

/** The width of a digit of a chart in a wide font, in pixels. */
const DIGIT = 9;
/** The width of the label of the vertical axis with the space around it, in pixels. */
const LABEL = 30;

/** The number of an axis as text. */
const numeral = (value) => String(value).replace("-", "−");

/** True if the numerals at these places are clear of each other and of the right edge. */
function clear(marks, edge) {
    const half = ([, value]) => 0.5 * DIGIT * numeral(value).length + 4;
    return marks.every((mark, i) => mark[0] + half(mark) <= (i + 1 < marks.length ? marks[i + 1][0] - half(marks[i + 1]) : edge));
}

/** Draws the states as a curve, dashed where they are not `stable`, and the `marks` with their labels. */
function chart(x, y, states, stable, marks, width) {
    const height = Math.round(Math.min(Math.max(0.72 * width, 300), 400));
    const box = { right: width - 14, top: 10, bottom: height - 46 };
    const axis = ({ key }, [low, high]) => {
        const values = states.map((state) => state[key]);
        const [least, most] = [Math.min(0, ...values), Math.max(0, ...values)], length = most - least;
        const range = [least === 0 ? 0 : least - low * length, most === 0 ? 0 : most + high * length];
        const { scale, prefix: sign } = prefix(Math.max(...range.map(Math.abs)) / 1.5);
        const numbers = (count) => ticks(range[0] / scale, range[1] / scale, count);
        const between = ([start, end]) => {
            const place = (value) => start + ((end - start) * (value - range[0])) / (range[1] - range[0]);
            const marks = (count) => numbers(count).map((value) => [place(value * scale), value]);
            return { place, sign, marks };
        };
        return { numbers, between };
    };
    const rows = axis(y, [0.13, 0.04]), columns = axis(x, [0.06, 0.02]);
    box.left = LABEL + DIGIT * Math.max(...rows.numbers(6).map((value) => numeral(value).length));
    const vertical = rows.between([box.bottom, box.top]), horizontal = columns.between([box.left, box.right]);
    // As many numbers as there is room for.
    const horizontalMarks = [7, 6, 5, 4, 3, 2, 1].map(horizontal.marks).find((marks) => clear(marks, width)) ?? [];
    const at = (state) => [horizontal.place(state[x.key]), vertical.place(state[y.key])];
    const description = `${y.label} against ${x.label}`;
    const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": description });
    for (const [place, value] of horizontalMarks) {
        svg.append(element("line", { class: value === 0 ? "zero" : "grid", x1: place, x2: place, y1: box.top, y2: box.bottom }));
        svg.append(element("text", { x: place, y: box.bottom + 17, "text-anchor": "middle" }, numeral(value)));
    }
    for (const [place, value] of vertical.marks(6)) {
        svg.append(element("line", { class: value === 0 ? "zero" : "grid", x1: box.left, x2: box.right, y1: place, y2: place }));
        svg.append(element("text", { x: box.left - 7, y: place + 4, "text-anchor": "end" }, numeral(value)));
    }
    const middle = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
    svg.append(element("text", { class: "axis", x: middle[0], y: height - 8, "text-anchor": "middle" },
        `${x.label} (${horizontal.sign}${x.unit})`));
    svg.append(element("text", { class: "axis", "text-anchor": "middle", transform: `translate(15 ${middle[1]}) rotate(-90)` },
        `${y.label} (${vertical.sign}${y.unit})`));
    for (const kind of [false, true]) {
        const pieces = states.slice(1).map((state, i) => {
            if (stable(state) !== kind) return "";
            const starts = i === 0 || stable(states[i]) !== kind;
            const [[u, v], [p, q]] = [at(states[i]), at(state)];
            return `${starts ? `M${u.toFixed(2)} ${v.toFixed(2)}` : ""}L${p.toFixed(2)} ${q.toFixed(2)}`;
        });
        svg.append(element("path", { class: kind ? "curve stable" : "curve unstable", d: pieces.join("") }));
    }
    for (const { label, state } of marks) {
        const [u, v] = at(state), below = label === "load control";
        if (u > box.right + 1) continue;
        svg.append(element("circle", { cx: u, cy: v, r: 4.5 }));
        // Below the mark at the least load. Otherwise right of the mark, in two lines on a narrow page, the last one beside
        // the mark; above it near zero load.
        const flat = v - vertical.place(0) < 20;
        const lines = below || flat || width > 420 ? [label] : label.split(" ");
        lines.forEach((line, i) => {
            const offset = below ? [2, 18] : [9, flat ? -8 : x.key === "penetration" ? 4 : -2];
            svg.append(element("text", { class: "mark", x: u + offset[0], y: v + offset[1] + 14 * (i + 1 - lines.length) }, line));
        });
    }
    return svg;
}
