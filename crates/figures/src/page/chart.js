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

/** The power of a thousand in which a value has one to three digits before the point, and its prefix. */
function prefix(value) {
    const thousands = value === 0 ? 0 : clamped(Math.floor(Math.log10(Math.abs(value)) / 3 + 1e-9), [-6, 4]);
    return { scale: 10 ** (3 * thousands), prefix: "afpnµm kMGT"[thousands + 6].trim() };
}

/** Returns about `count` round numbers from `low` to `high`. */
function ticks(low, high, count) {
    const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * (rough < 1.5 * power ? 1 : rough < 3.5 * power ? 2 : rough < 7 * power ? 5 : 10);
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, i) => rounded((first + i) * step, 10));
}

/** The widths, in pixels, of a digit of a chart in a wide font, and of the label of the vertical axis with the space around it. */
const DIGIT = 9, LABEL = 30;

/** The number of an axis as text. */
const numeral = (value) => String(value).replace("-", "−");

/** True if the numerals at these places are clear of each other and of the right edge. */
function clear(marks, edge) {
    const half = ([, value]) => 0.5 * DIGIT * numeral(value).length + 4;
    return marks.every((mark, i) => mark[0] + half(mark) <= (i + 1 < marks.length ? marks[i + 1][0] - half(marks[i + 1]) : edge));
}

/** Draws the states as a curve, dashed where they are not stable, and the `marks` with their labels. */
function chart(x, y, states, marks, width) {
    const height = Math.round(clamped(0.72 * width, [300, 400]));
    const box = { right: width - 14, top: 10, bottom: height - 46 };
    /** The axis of a variable, with these parts of its range before the least and after the greatest value. */
    const axis = ({ key }, [low, high]) => {
        const values = states.map((state) => state[key]);
        const [least, most] = [Math.min(0, ...values), Math.max(0, ...values)], length = most - least;
        const range = [least === 0 ? 0 : least - low * length, most === 0 ? 0 : most + high * length];
        const { scale, prefix: sign } = prefix(Math.max(...range.map(Math.abs)) / 1.5);
        const numbers = (count) => ticks(range[0] / scale, range[1] / scale, count);
        const place = (value, [start, end]) => start + ((end - start) * (value - range[0])) / (range[1] - range[0]);
        return { sign, numbers, place, marks: (count, ends) => numbers(count).map((value) => [place(value * scale, ends), value]) };
    };
    const rows = axis(y, [0.13, 0.04]), columns = axis(x, [0.06, 0.02]);
    box.left = LABEL + DIGIT * Math.max(...rows.numbers(6).map((value) => numeral(value).length));
    const vertical = [box.bottom, box.top], horizontal = [box.left, box.right];
    const at = (state) => [columns.place(state[x.key], horizontal), rows.place(state[y.key], vertical)];
    const svg = element("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": y.against(x) });
    const line = (value, ends) => svg.append(element("line", { class: value === 0 ? "zero" : "grid", ...ends }));
    const text = (words, attributes) => svg.append(element("text", attributes, words));
    // As many numbers as there is room for.
    const some = [7, 6, 5, 4, 3, 2, 1].map((count) => columns.marks(count, horizontal)).find((all) => clear(all, width));
    for (const [u, value] of some ?? []) {
        line(value, { x1: u, x2: u, y1: box.top, y2: box.bottom });
        text(numeral(value), { x: u, y: box.bottom + 17, "text-anchor": "middle" });
    }
    for (const [v, value] of rows.marks(6, vertical)) {
        line(value, { x1: box.left, x2: box.right, y1: v, y2: v });
        text(numeral(value), { x: box.left - 7, y: v + 4, "text-anchor": "end" });
    }
    const title = { class: "axis", "text-anchor": "middle" }, label = (of, { sign }) => `${of.label} (${sign}${of.unit})`;
    text(label(x, columns), { ...title, x: (box.left + box.right) / 2, y: height - 8 });
    text(label(y, rows), { ...title, transform: `translate(15 ${(box.top + box.bottom) / 2}) rotate(-90)` });
    for (const kind of [false, true]) {
        const pieces = states.slice(1).map((state, i) => {
            if (state.stable !== kind) return "";
            const start = i === 0 || states[i].stable !== kind ? `M${at(states[i]).join(" ")}` : "";
            return `${start}L${at(state).join(" ")}`;
        });
        svg.append(element("path", { class: kind ? "curve stable" : "curve unstable", d: pieces.join("") }));
    }
    for (const { label: words, state } of marks) {
        const [u, v] = at(state), below = words === "load control";
        if (u > box.right + 1) continue;
        svg.append(element("circle", { cx: u, cy: v, r: 4.5 }));
        // Below the mark at the least load. Otherwise right of the mark, in two lines on a narrow page, the last one beside
        // the mark; above it near zero load.
        const flat = v - rows.place(0, vertical) < 20, lines = below || flat || width > 420 ? [words] : words.split(" ");
        const [du, dv] = below ? [2, 18] : [9, flat ? -8 : x.key === "penetration" ? 4 : -2];
        lines.forEach((words, i) => text(words, { class: "mark", x: u + du, y: v + dv + 14 * (i + 1 - lines.length) }));
    }
    return svg;
}
