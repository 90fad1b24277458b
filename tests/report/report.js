// Appended to a copy of a report. `browse` and `fill` use the page as a user does, and `leave` writes the result into the page
// as JSON in base64. Everything runs to its end before the event `load`, without waiting. The complaints of the page are
// collected in `complaints`.

/** Takes the page to an address, and tells the page at once. The browser itself would tell it later. */
function visit(address) {
    history.replaceState(null, "", `#${address}`);
    dispatchEvent(new HashChangeEvent("hashchange"));
}

/** The text of the file that the button "download" makes. */
function download() {
    let csv = null;
    class Written extends Blob {
        constructor(parts, options) {
            super(parts, options);
            csv = parts.join("");
        }
    }
    const before = { Blob, click: HTMLAnchorElement.prototype.click };
    globalThis.Blob = Written;
    HTMLAnchorElement.prototype.click = () => {};
    document.getElementById("download").click();
    globalThis.Blob = before.Blob;
    HTMLAnchorElement.prototype.click = before.click;
    return csv;
}

/** The results that the page shows of one system. */
function look() {
    const value = (cell) => [cell.className, cell.firstChild.value];
    const values = (row) => Object.fromEntries([...row.querySelectorAll("td")].map(value));
    const { hidden } = document.getElementById("results"), command = document.getElementById("command");
    return {
        hidden,
        messages: document.getElementById("message").innerText,
        command: command.hidden ? "" : command.textContent,
        states: Object.fromEntries([...document.querySelectorAll("#states tbody tr")].map((row) => [row.id, values(row)])),
        points: [...document.querySelectorAll("#points tbody tr")].map(values),
        paths: paths(),
        csv: hidden ? null : download(),
    };
}

const paths = () => [...document.querySelectorAll("#charts path")].map((path) => path.getAttribute("d"));

/** Types a text into an input, or moves a slider. */
function enter(input, text) {
    input.value = text;
    input.dispatchEvent(new Event("input", { bubbles: true }));
}

/** Moves each slider of the present probe some steps towards its middle and back: which curves, and which number, follow. */
function slide() {
    const shown = (slider) => !slider.closest(".control").hidden;
    return [...document.querySelectorAll("input[type=range]")].filter(shown).map((slider) => {
        const number = document.getElementById(`${slider.id}-number`), before = [...paths(), number.value], start = slider.value;
        enter(slider, Number(start) + (start < 500 ? 20 : -20));
        const after = [...paths(), number.value];
        enter(number, before.at(-1));
        return {
            id: slider.id,
            label: slider.labels.length,
            moved: after.map((text, i) => text !== before[i]),
            back: paths().every((text, i) => text === before[i]),
        };
    });
}

/** The page at each of the addresses, the effect of the sliders at the last one, and the address that the page writes. */
function browse(addresses) {
    const looks = addresses.map((address) => {
        visit(address);
        return look();
    });
    const sliders = slide();
    // The page writes the address when a slider is let go.
    history.replaceState(null, "", "#");
    document.querySelector("input[type=range]").dispatchEvent(new Event("change", { bubbles: true }));
    return { looks, sliders, address: location.hash };
}

/** Each number field: whether it is marked as invalid, and the text that describes it. */
function fields() {
    return Object.fromEntries([...document.querySelectorAll("#controls input[type=text]")].map((input) => {
        const described = (input.getAttribute("aria-describedby") ?? "").split(" ").filter((id) => id !== "");
        const text = described.map((id) => document.getElementById(id).textContent).join(" ");
        return [input.id.replace("-number", ""), { invalid: input.getAttribute("aria-invalid"), text }];
    }));
}

/** The fields and messages after each entry `[field, text]`. */
function fill(entries) {
    return entries.map(([field, text]) => {
        enter(document.getElementById(`${field}-number`), text);
        const hidden = document.getElementById("results").hidden, messages = document.getElementById("message").innerText;
        return { hidden, messages, fields: fields() };
    });
}

/** What the page shows after each choice of a probe, with the film thickness `thickness` in µm. */
function choose(probes, thickness) {
    enter(document.getElementById("film_thickness-number"), thickness);
    const choice = document.getElementById("probe");
    return probes.map((probe) => {
        choice.value = probe;
        choice.dispatchEvent(new Event("change", { bubbles: true }));
        return {
            radius: document.querySelector("label[for=sphere_radius]").innerText,
            drawings: document.querySelectorAll("#charts svg").length,
            messages: document.getElementById("message").innerText,
            address: location.hash.split("&")[0],
        };
    });
}

/** The texts of the charts that collide or leave their chart, and the choices of probes that are cut off, at each address. */
function crowded(addresses, width) {
    document.body.style.width = `${width}px`;
    const within = (inner, outer) => inner.left >= outer.left - 1 && inner.right <= outer.right + 1;
    const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 2 || b.bottom <= a.top + 2;
    const charts = () => [...document.querySelectorAll("#charts svg")].flatMap((svg) => {
        const texts = [...svg.querySelectorAll("text")].map((text) => [text.textContent, text.getBoundingClientRect()]);
        const outside = texts.filter(([, box]) => !within(box, svg.getBoundingClientRect())).map(([text]) => `${text} is cut off`);
        const pairs = texts.flatMap(([text, box], i) => texts.slice(0, i).filter(([, other]) => !apart(box, other))
            .map(([other]) => `${text} meets ${other}`));
        return [...outside, ...pairs];
    });
    const choices = () => {
        const select = document.getElementById("probe");
        if (!select) return [];
        const context = document.createElement("canvas").getContext("2d");
        context.font = getComputedStyle(select).font;
        // The arrow of a list takes some 30 pixels.
        const room = select.clientWidth - 30;
        return [...select.options].map((option) => option.text).filter((text) => context.measureText(text).width > room)
            .map((text) => `${text} is cut off`);
    };
    return addresses.map((address) => {
        visit(address);
        return { texts: [...charts(), ...choices()], charts: document.querySelectorAll("#charts svg").length,
            scrolls: document.documentElement.scrollWidth > Math.max(width, innerWidth) };
    });
}

/** The messages of the page. */
function told() {
    return document.getElementById("message").innerText;
}

function leave(result) {
    const seen = { result, fetched: performance.getEntriesByType("resource").length, complaints };
    const bytes = new TextEncoder().encode(JSON.stringify(seen));
    const text = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
    document.body.append(Object.assign(document.createElement("pre"), { id: "seen", textContent: text }));
}
