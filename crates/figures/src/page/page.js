// The page: reads the sliders and fields, and shows the curves and numbers of the contact that they set.

/** The settings, by the names of `tabulate curve`'s options. `scale` is the size of the unit shown, in SI units. */
const SETTINGS = {
    film_thickness: { name: "film thickness", symbol: "t", unit: "µm", scale: 1e-6, usual: 1e-6, sensible: [1e-9, 1e-3] },
    film_modulus: { name: "film modulus", symbol: "E₁", unit: "MPa", scale: 1e6, usual: 3.5e6, sensible: [1e3, 1e12] },
    film_poisson_ratio: { name: "film Poisson ratio", symbol: "ν₁", unit: "", scale: 1, usual: 0.5 },
    substrate_modulus: { name: "substrate modulus", symbol: "E₀", unit: "MPa", scale: 1e6, usual: 2e11, sensible: [1e3, 1e12] },
    substrate_poisson_ratio: { name: "substrate Poisson ratio", symbol: "ν₀", unit: "", scale: 1, usual: 0.25 },
    sphere_modulus: { name: "sphere reduced modulus", symbol: "E₂*", unit: "MPa", scale: 1e6, usual: 2e6, sensible: [1e3, 1e12] },
    sphere_radius: { name: "sphere radius", symbol: "R", unit: "µm", scale: 1e-6, usual: 1e-3, sensible: [1e-8, 0.1] },
    work_of_adhesion: { name: "work of adhesion", symbol: "w", unit: "mJ/m²", scale: 1e-3, usual: 0.04, sensible: [1e-4, 10] },
};
/** The probes, by the names of the option --probe: each with its text, and the name of its radius. */
const PROBES = {
    paraboloid: { text: "paraboloid r²/(2R)", radius: "sphere radius" },
    sphere: { text: "sphere itself", radius: "sphere radius" },
    "flat-punch": { text: "flat punch", radius: "punch radius" },
};
/** The number of steps of a slider. */
const STEPS = 1000;
/** The Poisson ratios of the materials of a table with paired Poisson ratios. */
const POISSON_RATIOS = [0, 0.5];
const COLUMNS = ["contact_radius", "load", "penetration", "jkr_abscissa", "jkr_ordinate"];

const byId = (id) => document.getElementById(id);

/** A value with its unit: rounded as text, exact in the attribute `value`. */
function shown(value, unit) {
    const { scale, prefix: sign } = unit === "" ? { scale: 1, prefix: "" } : prefix(value);
    const text = value === 0 ? "0" : (value / scale).toPrecision(6).replace("-", "−");
    return element("data", { value }, `${text} ${sign}${unit}`.trim());
}

/** The number that a text stands for: NaN if none. A rigid body has an infinite modulus. */
function parsed(text) {
    const plain = text.trim().toLowerCase().replace("−", "-").replace(",", ".");
    if (["rigid", "inf", "infinity", "∞"].includes(plain)) return Infinity;
    return plain === "" ? NaN : Number(plain);
}

/** The state of the page: the settings in SI units by name, and the contact that they describe. */
class Page {
    constructor(table) {
        this.table = table;
        this.adhesive = ["eeq", "gamma"].every((quantity) => table.answers(quantity));
        this.penetrates = table.answers("delta0");
        /** The probes other than the paraboloid need all quantities. */
        const computed = (probe) => probe === "paraboloid" || (this.adhesive && this.penetrates);
        this.probes = Object.keys(PROBES).filter(computed);
        this.keys = Object.keys(SETTINGS);
        this.probe = OPENING.probe;
        /** A film and a substrate are replaced by their equivalent with paired Poisson ratios. */
        this.paired = table.nu0 === null && !table.fixes("nu1");
        this.unit = table.rigidSphere ? "film_modulus" : "sphere_modulus";
        this.values = Object.fromEntries(Object.entries(SETTINGS).map(([key, setting]) => [key, setting.usual]));
        this.values.sphere_radius = OPENING.radius;
        this.rows = new Map();
        this.settle();
        // The paper's system, or the nearest one in the box.
        this.values.film_poisson_ratio = this.within(this.values.film_poisson_ratio, this.poissonRatios());
        for (const key of ["substrate_modulus", "film_modulus"]) {
            if (this.sliding(key) && key !== this.unit) this.values[key] = this.within(this.values[key], this.box(key));
        }
        this.open();
        this.usual = { ...this.values };
        this.makeControls();
        this.readAddress();
        addEventListener("hashchange", () => this.readAddress());
        new ResizeObserver(() => this.draw()).observe(byId("charts"));
        byId("download").addEventListener("click", () => this.download());
    }

    /** Chooses the thinnest film on which the curve reaches zero load before the table's a/t ends, if there is one. */
    open() {
        this.unknown = [];
        const { usual, sensible: [, thickest] } = SETTINGS.film_thickness;
        for (let i = 0; usual * 10 ** (i / 2) <= thickest; i += 1) {
            this.values.film_thickness = rounded(usual * 10 ** (i / 2), i % 2 ? 1 : 14);
            if (!this.wrong().length && (this.values.work_of_adhesion === 0 || this.makeContact().zeroLoad())) return;
        }
        this.values.film_thickness = usual;
    }

    /** The name of a setting. That of the radius depends on the probe. */
    name(key) {
        return (key === "sphere_radius" && PROBES[this.probe].radius) || SETTINGS[key].name;
    }

    within(value, [from, to]) {
        return Math.min(Math.max(value, from), to);
    }

    /** The range of a modulus of film or substrate, at the present values of the others. */
    box(key) {
        return modulusRange(this.table, key, this.values);
    }

    /** The range of the film's Poisson ratio. */
    poissonRatios() {
        return this.paired ? POISSON_RATIOS : this.table.range("nu1");
    }

    /** True if the user can change a setting. */
    sliding(key) {
        switch (key) {
            case "film_modulus": case "substrate_modulus": case "sphere_modulus": return isFree(this.table, key);
            case "film_poisson_ratio": return !this.table.fixes("nu1");
            case "substrate_poisson_ratio": return this.paired;
            case "work_of_adhesion": return this.adhesive;
            default: return true;
        }
    }

    /** Sets the values that the table fixes. */
    settle() {
        const { table, values } = this;
        if (table.fixes("nu1")) [values.film_poisson_ratio] = table.range("nu1");
        if (!this.paired) values.substrate_poisson_ratio = table.nu0 ?? pairOf(values.film_poisson_ratio);
        // The film's modulus may follow from the other two, that of the substrate from the sphere's.
        for (const key of ["sphere_modulus", "substrate_modulus", "film_modulus"]) {
            if (alwaysRigid(table, key)) values[key] = Infinity;
            else if (!isFree(table, key)) [values[key]] = this.box(key);
        }
        if (!this.adhesive) values.work_of_adhesion = 0;
    }

    /** Describes a setting that the table fixes. */
    fixed(key) {
        const { table, values } = this, value = values[key], { unit, scale } = SETTINGS[key];
        const amount = `${rounded(value / scale)} ${unit}`.trim();
        const [film, , substrate] = table.parameters, rigid = value === Infinity;
        const ratio = (parameter, of) => `${table.range(parameter)[0]} ${of}, fixed by the table: ${amount}`;
        switch (key) {
            case "film_modulus": return ratio(film, table.reduced ? "E∞*" : "E₂*");
            case "substrate_modulus": return rigid ? "rigid" : ratio(substrate, table.rigidSphere ? "E₁" : "E₂*");
            case "sphere_modulus": return table.rigidSphere ? "rigid: the unit is E₁*" : "rigid";
            case "work_of_adhesion": return "0: the table lacks eeq or gamma";
            default: return `${amount}, fixed by the table`;
        }
    }

    /** The ends of a slider, and whether its scale is logarithmic. */
    range(key) {
        switch (key) {
            case "film_poisson_ratio": return { ends: this.poissonRatios(), logarithmic: false };
            case "substrate_poisson_ratio": return { ends: POISSON_RATIOS, logarithmic: false };
            case "film_modulus": case "substrate_modulus": {
                const { sensible } = SETTINGS[key], box = key === this.unit ? sensible : this.box(key);
                // Ratios of reduced moduli may reach from 0 to infinity.
                return { ends: this.table.reduced ? box.map((end) => this.within(end, sensible)) : box, logarithmic: true };
            }
            default: return { ends: SETTINGS[key].sensible, logarithmic: true };
        }
    }

    makeControls() {
        if (this.probes.length > 1) {
            const options = this.probes.map((probe) => element("option", { value: probe }, PROBES[probe].text));
            this.choice = element("select", { id: "probe" }, ...options);
            this.choice.addEventListener("change", () => {
                this.probe = this.choice.value;
                this.show();
                this.writeAddress();
            });
            byId("controls").append(element("div", { class: "control" }, element("label", { for: "probe" }, "probe"), this.choice));
        }
        for (const key of this.keys) {
            const { name, symbol, unit, scale } = SETTINGS[key];
            if (!this.sliding(key)) {
                const text = element("output");
                byId("controls").append(element("div", { class: "control" }, element("span", {}, `${name} ${symbol}`), text));
                this.rows.set(key, { text });
                continue;
            }
            const slider = element("input", { type: "range", id: key, min: 0, max: STEPS, step: 1 });
            const number = element("input", { type: "text", inputmode: "decimal", id: `${key}-number`, spellcheck: "false" });
            slider.addEventListener("input", () => {
                const { ends: [from, to], logarithmic } = this.range(key), part = slider.value / STEPS;
                const inside = logarithmic ? from * (to / from) ** part : from + (to - from) * part;
                const last = mayBeRigid(this.table, key) ? Infinity : to;
                this.change(key, part === 0 ? from : part === 1 ? last : rounded(inside, 4));
            });
            number.addEventListener("input", () => {
                this.change(key, rounded(parsed(number.value) * scale), number);
            });
            // Written when a slider is let go: browsers limit how often the address may change.
            [slider, number].forEach((input) => input.addEventListener("change", () => this.writeAddress()));
            const title = element("span", {}, name), label = element("label", { for: key }, title, " ", element("i", {}, symbol));
            if (mayBeRigid(this.table, key)) label.append(", or rigid");
            const field = element("span", { class: "field" }, number, element("span", {}, unit));
            byId("controls").append(element("div", { class: "control" }, label, slider, field));
            this.rows.set(key, { slider, number, title });
        }
        byId("controls").addEventListener("submit", (event) => event.preventDefault());
    }

    change(key, value, typing) {
        this.values[key] = value;
        this.show(typing);
    }

    /** Reads settings from the address, `#film_thickness=1e-6&...` in SI units. The others get their usual values. */
    readAddress() {
        this.unknown = [];
        Object.assign(this.values, this.usual);
        this.probe = OPENING.probe;
        for (const [key, text] of new URLSearchParams(location.hash.slice(1))) {
            if (key === "probe" && this.probes.includes(text)) this.probe = text;
            else if (this.keys.includes(key) && this.sliding(key)) this.values[key] = parsed(text);
            else this.unknown.push(key);
        }
        this.show();
    }

    writeAddress() {
        const free = this.keys.filter((key) => this.sliding(key)).map((key) => `${key}=${this.values[key]}`);
        if (this.probe !== OPENING.probe) free.unshift(`probe=${this.probe}`);
        this.unknown = [];
        history.replaceState(null, "", `#${free.join("&")}`);
    }

    /** Shows the settings and the results. Leaves the text of the field `typing` alone, in which the user types. */
    show(typing) {
        this.settle();
        if (this.choice) this.choice.value = this.probe;
        for (const [key, { slider, number, title, text }] of this.rows) {
            const value = this.values[key], { unit, scale } = SETTINGS[key];
            if (text) {
                text.textContent = this.fixed(key);
                continue;
            }
            const rigid = value === Infinity, amount = Number.isNaN(value) ? "" : rigid ? "rigid" : String(rounded(value / scale));
            if (number !== typing) number.value = amount;
            title.textContent = this.name(key);
            number.setAttribute("aria-label", unit ? `${this.name(key)} in ${unit}` : this.name(key));
            const { ends: [from, to], logarithmic } = this.range(key);
            const part = logarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
            slider.value = Number.isNaN(part) ? 0 : Math.round(STEPS * this.within(part, [0, 1]));
            slider.setAttribute("aria-valuetext", rigid ? amount : `${amount} ${unit}`.trim());
        }
        const wrong = this.wrong();
        byId("message").replaceChildren(...wrong.map(({ text }, i) => element("p", { id: `wrong-${i}` }, text)));
        this.markFields(wrong);
        this.contact = null;
        if (!wrong.length) {
            this.contact = this.makeContact();
            this.drawn = this.contact.drawn();
            const notes = this.fillTables();
            byId("message").replaceChildren(...notes.map((text) => element("p", { class: "note" }, text)));
        }
        byId("results").hidden = wrong.length > 0;
        this.draw();
    }

    /** Marks the fields that a message is about, and ties them to it for screen readers. */
    markFields(wrong) {
        for (const [key, { number }] of this.rows) {
            if (!number) continue;
            const messages = wrong.flatMap(({ keys }, i) => (keys.includes(key) ? [`wrong-${i}`] : []));
            if (messages.length) {
                number.setAttribute("aria-invalid", "true");
                number.setAttribute("aria-describedby", messages.join(" "));
            } else {
                number.removeAttribute("aria-invalid");
                number.removeAttribute("aria-describedby");
            }
        }
    }

    /** The reasons why there is no curve: for each its text, and the keys of the fields that it is about. */
    wrong() {
        const unknown = (key) => ({ text: `The address sets “${key}”, which is not a setting of this table.`, keys: [] });
        const wrong = this.unknown.map(unknown);
        for (const key of this.keys) {
            if (!this.sliding(key)) continue;
            const name = this.name(key), value = this.values[key], zero = key === "work_of_adhesion", rigid = mayBeRigid(this.table, key);
            if (key.endsWith("poisson_ratio")) {
                const [from, to] = POISSON_RATIOS, text = `The ${name} must be a number from ${from} to ${to}.`;
                if (this.paired && !(value >= from && value <= to)) wrong.push({ text, keys: [key] });
            } else if (!(value > 0 || (zero && value === 0)) || (value === Infinity && !rigid)) {
                const text = `The ${name} must be a number ${zero ? "that is 0 or larger" : "above 0"}${rigid ? ", or “rigid”" : ""}.`;
                wrong.push({ text, keys: [key] });
            }
        }
        if (wrong.length) return wrong;
        const { film_thickness: t, sphere_radius: R } = this.values, [first, last] = this.table.range("a_over_t");
        const lengths = ["sphere_radius", "film_thickness"];
        if (this.probe === "flat-punch") {
            if (!this.table.covers("a_over_t", R / t)) {
                const text = `The radius of the punch over the film thickness is ${rounded(R / t, 6)}; the table holds ${first} to ${last}. Change the punch radius or the film thickness.`;
                wrong.push({ text, keys: lengths });
            }
        } else if (first * t >= this.largest()) {
            const radius = `${shown(first * t, "m").textContent}, where the table’s a/t begins`;
            const sphere = this.probe === "sphere" ? `${LARGEST_UNDER_SPHERE} times the sphere` : "the sphere";
            const text = `A contact of ${radius}, is not smaller than ${sphere}. Change the sphere radius or the film thickness.`;
            wrong.push({ text, keys: lengths });
        }
        const unit = this.table.rigidSphere ? "E₁" : "E₂*", moduli = ["film_modulus", "substrate_modulus", "sphere_modulus"];
        const ratios = {
            e1_over_e2: { symbol: `E₁/${unit}`, keys: ["film_modulus", this.unit] },
            nu1: { symbol: "ν₁", keys: ["film_poisson_ratio"] },
            e0_over_e2: { symbol: `E₀/${unit}`, keys: ["substrate_modulus", this.unit] },
            e1s_over_einfs: { symbol: "E₁*/E∞*", keys: moduli },
            e0s_over_e2s: { symbol: "E₀*/E₂*", keys: moduli.slice(1) },
        };
        if (this.paired) ratios.nu1 = { symbol: "ν₁ of the equivalent film", keys: ["film_poisson_ratio", "substrate_poisson_ratio"] };
        const plain = (value) => (value === Infinity ? "∞" : String(rounded(value, 6)));
        const material = materialOf(this.table, this.values);
        for (const [parameter, value] of Object.entries(material)) {
            if (this.table.covers(parameter, value)) continue;
            const [from, to] = this.table.range(parameter), { symbol, keys } = ratios[parameter];
            const amount = Number.isNaN(value) ? "not a number" : plain(value);
            const names = keys.map((key) => `the ${this.name(key)}`).join(" or ");
            wrong.push({ text: `${symbol} is ${amount}; the table holds ${plain(from)} to ${plain(to)}. Change ${names}.`, keys });
        }
        if (wrong.length) return wrong;
        this.curve = this.table.curve(material);
        // The fifth order of a thick film (thick_film.rs).
        const thick = first <= LARGEST_FIRST ? (4 * first ** 5 * sphereFilmModulus(this.values)) / reducedModuli(this.values).film : Infinity;
        if (this.curve.error > this.table.tolerance || (this.probe === "sphere" && thick > this.table.tolerance)) {
            const text = `At a/t = ${first}, where the table begins, this film is not thick enough for the start of the integrals that give load and penetration. Change the film modulus.`;
            wrong.push({ text, keys: ["film_modulus"] });
        }
        return wrong;
    }

    /** The largest contact radius of the probe. */
    largest() {
        return this.values.sphere_radius * (this.probe === "sphere" ? LARGEST_UNDER_SPHERE : BELOW_SPHERE);
    }

    /** The radius of curvature at the tip; NaN without one. */
    curvature() {
        return this.probe === "flat-punch" ? NaN : this.values.sphere_radius;
    }

    makeContact() {
        const { table, values, probe } = this;
        const { sphere_radius: radius, film_thickness: thickness, work_of_adhesion: workOfAdhesion } = values;
        const system = { thickness, workOfAdhesion, modulus: sphereFilmModulus(values), largest: this.largest() };
        if (probe === "flat-punch") return new Punch(this.curve, { ...system, radius });
        Object.assign(system, { order: 2, factor: 1 / radius, extent: 0.1 * radius });
        const curve = probe === "sphere" ? new SphereCurve(this.curve, table.range("a_over_t"), radius / thickness) : this.curve;
        return new Contact(table, curve, system);
    }

    /** Fills the tables of numbers. Returns notes on them. */
    fillTables() {
        const { contact } = this, notes = [], [, to] = this.drawn;
        const columns = [["load", "F", "N"], ...(this.penetrates ? [["penetration", "δ", "m"]] : []), ["contact_radius", "a", "m"]];
        const cells = (state) => [
            ...columns.map(([key, , unit]) => element("td", { class: key }, shown(state[key], unit))),
            element("td", { class: "a_over_t" }, shown(state.contact_radius / contact.thickness, "")),
        ];
        const head = (...first) => element("tr", {}, ...first.map((text) => element("th", { scope: "col" }, text)),
            ...[...columns.map(([, symbol]) => symbol), "a/t"].map((symbol) => element("th", { scope: "col" }, symbol)));

        this.marks = [];
        const states = [];
        if (contact.workOfAdhesion > 0) {
            const particular = [["pull-off", "load control", "load"]];
            if (this.penetrates) particular.push(["pull-off", "displacement control", "penetration"]);
            for (const [what, label, controlled] of particular) {
                const state = contact.pullOff(controlled);
                if (state) this.marks.push({ label, state });
                states.push([`${what}, ${label}`, `pull-off-${controlled}`, state]);
            }
            states.push(["zero load", "zero-load", contact.zeroLoad()]);
        }
        byId("states").tHead.replaceChildren(head("contact"));
        byId("states").tBodies[0].replaceChildren(...states.map(([name, id, state]) => {
            const rest = state ? cells(state) : [element("td", { colspan: columns.length + 1 }, "outside the table’s a/t")];
            return element("tr", { id }, element("th", { scope: "row" }, name), ...rest);
        }));
        byId("states").parentElement.hidden = states.length === 0;
        byId("points").tHead.replaceChildren(head());
        byId("points").tBodies[0].replaceChildren(...this.points(10).map((state) => element("tr", {}, ...cells(state))));
        byId("command").textContent = this.command();
        const punch = this.probe === "flat-punch";
        byId("prints").textContent = punch ? "the state in which the punch separates" : "the same curve";
        if (punch) return notes;

        const [x0, x1] = this.table.range("a_over_t"), [least, most] = contact.range;
        const limit = (verb, a, x) => {
            notes.push(`The curve ${verb} at a = ${shown(a, "m").textContent}, where the table’s a/t ${verb}: ${x}.`);
        };
        if (least > 0.1 * to) limit("begins", least, x0);
        if (to === most && most < x1 * contact.thickness) {
            notes.push(this.probe === "sphere" ? `The curve ends at a = ${LARGEST_UNDER_SPHERE} R.` : "The curve ends at the sphere’s radius R.");
        } else if (to === most) limit("ends", most, x1);
        if (this.probe === "paraboloid" && to > WARNING_A_OVER_R * this.curvature()) notes.push(LARGE_CONTACT);
        return notes;
    }

    /** States along the curve: equally spaced in the contact radius, as `tabulate curve` spaces them, or in the penetration of a punch. */
    points(count) {
        const [from, to] = this.contact.printed(this.drawn);
        return Array.from({ length: count }, (_, i) => this.contact.state(from + (to - from) * (i / (count - 1))));
    }

    command() {
        const [from, to] = this.contact.printed(this.drawn);
        const other = this.probe === "paraboloid" ? {} : { probe: this.probe };
        const settings = { ...other, ...this.values, ...(this.probe === "flat-punch" ? {} : { from, to, points: 150 }) };
        const number = (value) => (value === Infinity ? "inf" : value);
        const options = Object.entries(settings).map(([key, value]) => `--${key.replaceAll("_", "-")} ${number(value)}`);
        return ["tabulate curve TABLE", ...options].join(" ");
    }

    download() {
        const curvature = this.curvature();
        const rows = this.points(150).map(({ contact_radius: a, load, penetration }) => {
            const power = a * Math.sqrt(a);
            const jkr = [power / (Math.sqrt(Math.PI) * curvature), load / (Math.sqrt(6 * Math.PI) * power)];
            return [a, load, this.penetrates ? penetration : "", ...jkr].join(",");
        });
        const link = element("a", { download: "curve.csv" });
        link.href = URL.createObjectURL(new Blob([[COLUMNS.join(","), ...rows, ""].join("\n")], { type: "text/csv" }));
        link.click();
        URL.revokeObjectURL(link.href);
    }

    /** Draws the curves. */
    draw() {
        const { contact } = this, charts = byId("charts");
        if (!contact || charts.clientWidth === 0) return;
        const [from, to] = this.drawn;
        const states = Array.from({ length: 301 }, (_, i) => contact.state(from + (to - from) * (i / 300) ** 2));
        const stable = (state) => state.slopes[this.penetrates ? "penetration" : "load"] >= 0;
        const load = { key: "load", label: "load F", unit: "N" };
        const abscissae = this.probe === "flat-punch" ? [] : [{ key: "contact_radius", label: "contact radius a", unit: "m" }];
        if (this.penetrates) abscissae.unshift({ key: "penetration", label: "penetration δ", unit: "m" });
        const columns = charts.clientWidth < 700 ? 1 : abscissae.length, width = Math.floor(charts.clientWidth / columns) - 12;
        const legend = [];
        if (this.marks.length) legend.push("Dots: pull-off.");
        const control = this.penetrates ? "even at fixed penetration" : "at fixed load";
        if (!states.every(stable)) legend.push(`Dashed: unstable, ${control}.`);
        byId("legend").textContent = legend.join(" ");
        charts.replaceChildren(...abscissae.map((x) => {
            const caption = element("figcaption", {}, `${load.label} against ${x.label}`);
            return element("figure", {}, caption, chart(x, load, states, stable, this.marks, Math.min(width, 640)));
        }));
    }
}

/** The table in a text of base64; null if it is damaged. */
function read(text) {
    try {
        return new Table(Uint8Array.from(atob(text.trim()), (character) => character.charCodeAt(0)));
    } catch {
        return null;
    }
}

/** The reason why there are no curves of a table; empty if there are. */
function reason(table) {
    if (table === null) return "The data of this page is damaged. Copy the page again, or make it again with `tabulate report`.";
    if (!table.answers("pi0")) return "The table does not hold pi0, from which the load is computed.";
    return table.fixes("a_over_t") ? "The table holds a single a/t: there is no curve." : "";
}

const table = read(byId("packed").textContent);
if (reason(table)) byId("message").append(element("p", {}, reason(table)));
else new Page(table);

// On a narrow page a figure is as wide as the page; a button shows it at its full size, to be moved sideways.
for (const figure of document.querySelectorAll(".figures figure")) {
    const button = element("button", { type: "button", class: "enlarge", "aria-pressed": "false" }, "Full size");
    button.addEventListener("click", () => button.setAttribute("aria-pressed", String(figure.classList.toggle("large"))));
    figure.querySelector("figcaption").append(" ", button);
}
