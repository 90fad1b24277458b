// The page: reads the sliders and fields, and shows the curves and numbers of the contact that they set.

/** The settings that the user can change. */
const FREE = Object.keys(SETTINGS).filter((key) => SETTINGS[key].free);

/** True for Poisson ratios, whose sliders are linear. All others are logarithmic. */
const isRatio = (key) => key.endsWith("poisson_ratio");
const byId = (id) => document.getElementById(id);

/** A value with its unit: rounded as text, exact in the attribute `value`. */
function shown(value, unit) {
    const { scale, prefix: sign } = unit === "" ? { scale: 1, prefix: "" } : prefix(value);
    const text = value === 0 ? "0" : (value / scale).toPrecision(DIGITS).replace("-", "−");
    return element("data", { value }, `${text} ${sign}${unit}`.trim());
}

/** Texts such as 1,000, which are a thousand to some people and one to others. */
const AMBIGUOUS = /^[-+]?[1-9]\d*,\d{3}(e[-+]?\d+)?$/;

/** A text in lower case, without blanks around it, and with a plain minus sign. */
const plainly = (text) => text.trim().toLowerCase().replace("−", "-");

/** The number that a text stands for: NaN if none, or if it may be two. A rigid body has an infinite modulus. */
function parsed(text) {
    const plain = plainly(text);
    if (["rigid", "inf", "infinity", "∞"].includes(plain)) return Infinity;
    const number = /^[-+]?(\d+[.,]?\d*|[.,]\d+)(e[-+]?\d+)?$/.test(plain) && !AMBIGUOUS.test(plain) ? Number(plain.replace(",", ".")) : NaN;
    return Math.abs(number) === Infinity ? NaN : number;
}

/** The state of the page: the settings in SI units by name, and the contact that they describe. */
class Page {
    constructor() {
        this.values = Object.fromEntries(Object.entries(SETTINGS).map(([key, { usual }]) => [key, usual]));
        this.open();
        this.listen();
        this.readAddress();
    }

    /** Chooses the paper's system, or the nearest one in the table, on the thinnest film on which the curve reaches zero load. */
    open() {
        const { values } = this, { usual } = SETTINGS.film_thickness;
        [this.probe, this.unknown] = [PROBE, []];
        for (const key of ["substrate_modulus", "film_modulus"]) {
            this.settle();
            if (FREE.includes(key) && key !== TABLE.unit) values[key] = clamped(values[key], modulusRange(key, values));
        }
        const thicknesses = Array.from({ length: 7 }, (_, i) => rounded(usual * 10 ** (i / 2), i % 2 ? 1 : 14));
        const reaches = () => !this.wrong().length && (values.work_of_adhesion === 0 || this.makeContact().zeroLoad());
        for (values.film_thickness of [...thicknesses, usual]) if (reaches()) break;
        this.usual = { ...values };
    }

    /** Names the radius, and sets the moduli that follow: the film's from the other two, the substrate's from the sphere's. */
    settle() {
        SETTINGS.sphere_radius.name = this.probe === "flat-punch" ? "punch radius" : "sphere radius";
        for (const key of ["substrate_modulus", "film_modulus"]) if (SETTINGS[key].follows) [this.values[key]] = modulusRange(key, this.values);
    }

    /** The ends of a slider. */
    ends(key) {
        const { sensible } = SETTINGS[key], ofRatio = ["film_modulus", "substrate_modulus"].includes(key) && key !== TABLE.unit;
        // Ratios of moduli may reach from 0 to infinity.
        return (ofRatio ? modulusRange(key, this.values) : sensible).map((end) => clamped(end, sensible));
    }

    listen() {
        addEventListener("hashchange", () => this.readAddress());
        new ResizeObserver(() => this.draw()).observe(byId("charts"));
        byId("download").addEventListener("click", () => this.download());
        byId("probe")?.addEventListener("change", (event) => {
            this.probe = event.target.value;
            this.show();
            this.writeAddress();
        });
        for (const key of FREE) {
            const slider = byId(key), number = byId(`${key}-number`), { scale, mayBeRigid } = SETTINGS[key];
            slider.addEventListener("input", () => {
                const [from, to] = this.ends(key), part = slider.value / slider.max;
                const inside = isRatio(key) ? from + (to - from) * part : from * (to / from) ** part;
                this.values[key] = part === 0 ? from : part === 1 ? (mayBeRigid ? Infinity : to) : rounded(inside, 4);
                this.show();
            });
            number.addEventListener("input", () => {
                this.values[key] = rounded(parsed(number.value) * scale);
                this.show(number);
            });
            // Written when a slider is let go: browsers limit how often the address may change.
            [slider, number].forEach((input) => input.addEventListener("change", () => this.writeAddress()));
        }
    }

    /** Reads settings from the address, `#film_thickness=1e-6&...` in SI units. The others get their usual values. */
    readAddress() {
        Object.assign(this.values, this.usual);
        [this.probe, this.unknown] = [PROBE, []];
        // A plus sign, as in 1e+7, would be read as a blank.
        for (const [key, text] of new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"))) {
            if (key === "probe" && [...(byId("probe")?.options ?? [])].some(({ value }) => value === text)) this.probe = text;
            else if (FREE.includes(key)) this.values[key] = parsed(text);
            else this.unknown.push(key);
        }
        this.show();
    }

    writeAddress() {
        const settings = FREE.map((key) => `${key}=${this.values[key]}`);
        if (this.probe !== PROBE) settings.unshift(`probe=${this.probe}`);
        this.unknown = [];
        history.replaceState(null, "", `#${settings.join("&")}`);
    }

    /** Shows the settings and the results. Leaves the text of the field `typing` alone, in which the user types. */
    show(typing) {
        this.settle();
        if (byId("probe")) byId("probe").value = this.probe;
        const wrong = this.wrong();
        for (const [key, { unit, scale }] of Object.entries(SETTINGS)) {
            const value = this.values[key], slider = byId(key), number = byId(`${key}-number`);
            const amount = Number.isNaN(value) ? "" : value === Infinity ? "rigid" : String(rounded(value / scale));
            const withUnit = amount === "rigid" ? amount : `${amount} ${unit}`.trim();
            if (!FREE.includes(key)) {
                slider.textContent = `${withUnit}, fixed by the table`;
                continue;
            }
            if (number !== typing) number.value = amount;
            slider.labels[0].firstChild.textContent = SETTINGS[key].name;
            number.setAttribute("aria-label", unit ? `${SETTINGS[key].name} in ${unit}` : SETTINGS[key].name);
            const [from, to] = this.ends(key);
            const part = isRatio(key) ? (value - from) / (to - from) : Math.log(value / from) / Math.log(to / from);
            slider.value = Number.isNaN(part) ? 0 : Math.round(slider.max * clamped(part, [0, 1]));
            slider.setAttribute("aria-valuetext", withUnit);
            // Ties the field to the messages about it for screen readers.
            const about = wrong.flatMap(({ keys }, i) => (keys.includes(key) ? [`wrong-${i}`] : []));
            number.setAttribute("aria-invalid", about.length > 0);
            number.setAttribute("aria-describedby", about.join(" "));
        }
        byId("message").replaceChildren(...wrong.map(({ text }, i) => element("p", { id: `wrong-${i}` }, text)));
        // Shown again once the numbers are those of the settings.
        byId("results").hidden = true;
        this.contact = wrong.length ? null : this.makeContact();
        if (!this.contact) return;
        const [from, to] = this.drawn = this.contact.drawn();
        this.printed = [this.probe === "flat-punch" ? from : Math.max(from, rounded(0.1 * to, 4)), to];
        this.fillTables();
        byId("message").replaceChildren(...this.notes().map((text) => element("p", { class: "note" }, text)));
        byId("results").hidden = false;
        this.draw();
    }

    /** The reasons why there is no curve: for each its text, and the keys of the fields that it is about. */
    wrong() {
        const wrong = this.unknown.map((key) => ({ text: `The address sets “${key}”, which is not a setting of this table.`, keys: [] }));
        for (const key of FREE) {
            const { valid: [from, to], must } = SETTINGS[key], value = this.values[key], typed = plainly(byId(`${key}-number`).value);
            const twofold = AMBIGUOUS.test(typed) ? ` Write ${typed.replace(",", "")} or ${typed.replace(",", ".")}.` : "";
            if (!(value >= from && value <= to)) wrong.push({ text: `The ${SETTINGS[key].name} must be ${must}.${twofold}`, keys: [key] });
        }
        if (wrong.length) return wrong;
        const plain = (value) => (value === Infinity ? "∞" : String(rounded(value, 6)));
        const outside = (name, value, [from, to], keys) => {
            // To rounding.
            const above = value >= from || from - value < 1e-12 * Math.max(1, from);
            if (above && (value <= to || value - to < 1e-12 * Math.max(1, to))) return;
            const names = keys.map((key) => `the ${SETTINGS[key].name}`).join(" or ");
            wrong.push({ text: `${name} is ${plain(value)}; the table holds ${plain(from)} to ${plain(to)}. Change ${names}.`, keys });
        };
        const { film_thickness: t, sphere_radius: R } = this.values, [first] = TABLE.range, lengths = ["sphere_radius", "film_thickness"];
        if (this.probe === "flat-punch") {
            outside("The radius of the punch over the film thickness", R / t, TABLE.range, lengths);
        } else if (first * t >= R * LARGEST[this.probe]) {
            const radius = `${shown(first * t, "m").textContent}, where the table’s a/t begins`;
            const sphere = this.probe === "sphere" ? `${rounded(LARGEST.sphere, 6)} times the sphere` : "the sphere";
            const text = `A contact of ${radius}, is not smaller than ${sphere}. Change the sphere radius or the film thickness.`;
            wrong.push({ text, keys: lengths });
        }
        const material = materialOf(this.values);
        TABLE.parameters.forEach(({ name, symbol, ends, keys }) => outside(symbol, material[name], ends, keys));
        return wrong;
    }

    makeContact() {
        const { sphere_radius: radius, film_thickness: thickness, work_of_adhesion: workOfAdhesion } = this.values;
        const system = { thickness, radius, workOfAdhesion, modulus: reducedModuli(this.values).ofSphereAndFilm, largest: radius * LARGEST[this.probe] };
        const quantities = quantitiesOf(materialOf(this.values));
        if (this.probe === "flat-punch") return punch(quantities, system);
        return new Contact(this.probe === "sphere" ? ofSphere(quantities, radius / thickness) : quantities, system);
    }

    /** Fills the tables of numbers, and shows the command that prints the curve. */
    fillTables() {
        const { contact } = this, { penetrates } = TABLE, punch = this.probe === "flat-punch";
        const columns = [["load", "N"], ...(penetrates ? [["penetration", "m"]] : []), ["contact_radius", "m"], ["a_over_t", ""]];
        const cells = (state) => columns.map(([key, unit]) => element("td", { class: key }, shown(state[key], unit)));
        const controls = { load: "load control", ...(penetrates ? { penetration: "displacement control" } : {}) };
        const pulled = Object.entries(controls)
            .map(([key, label]) => ({ id: `pull-off-${key}`, name: `pull-off, ${label}`, label, state: contact.pullOff(key) }));
        this.marks = pulled.filter(({ state }) => state);
        const states = contact.workOfAdhesion > 0 ? [...pulled, { id: "zero-load", name: "zero load", state: contact.zeroLoad() }] : [];
        byId("states").tBodies[0].replaceChildren(...states.map(({ id, name, state }) => {
            const rest = state ? cells(state) : [element("td", { colspan: columns.length }, "outside the curve")];
            return element("tr", { id }, element("th", { scope: "row" }, name), ...rest);
        }));
        byId("states").parentElement.hidden = states.length === 0;
        byId("points").tBodies[0].replaceChildren(...this.points(10).map((state) => element("tr", {}, ...cells(state))));
        const [from, to] = this.printed, probe = this.probe === "paraboloid" ? {} : { probe: this.probe };
        // The program takes a soft modulus with its unit alone.
        const argument = (key, value) => (value === Infinity ? "inf" : `${value}${key.endsWith("modulus") ? "Pa" : ""}`);
        const options = Object.entries({ ...probe, ...this.values, ...(punch ? {} : { from, to, points: 150 }) })
            .map(([key, value]) => `--${key.replaceAll("_", "-")} ${argument(key, value)}`);
        const isDoubted = ([key, value]) => value < Infinity && value !== clamped(value, SETTINGS[key].undoubted);
        if (Object.entries(this.values).some(isDoubted)) options.push("--allow magnitudes");
        byId("command").textContent = ["tabulate curve TABLE", ...options].join(" ");
        byId("prints").textContent = punch ? "the state in which the punch separates" : "the same curve";
        // The program prints penetrations, too.
        byId("command").hidden = byId("prints").parentElement.hidden = !penetrates;
    }

    /** Notes on the curve: where it begins and ends, and whether its contacts are large. */
    notes() {
        if (this.probe === "flat-punch") return [];
        const { contact, drawn: [, to], probe } = this, [least, most] = contact.range, [x0, x1] = TABLE.range, notes = [];
        const limit = (verb, a, x) => notes.push(`The curve ${verb} at a = ${shown(a, "m").textContent}, where the table’s a/t ${verb}: ${x}.`);
        // The range that is drawn is at least ten times the smallest radius, but for rounding.
        if (least > 0.0999 * to) limit("begins", least, x0);
        if (to === most && most === contact.largest) {
            notes.push(probe === "sphere" ? `The curve ends at a = ${rounded(LARGEST.sphere, 6)} R.` : "The curve ends at the sphere’s radius R.");
        } else if (to === most) limit("ends", most, x1);
        if (probe === "paraboloid" && to > WARNING_A_OVER_R * contact.radius) notes.push(LARGE_CONTACT);
        return notes;
    }

    /** States along the curve: equally spaced in the contact radius, as `tabulate curve` spaces them, or in the penetration of a punch. */
    points(count) {
        const [from, to] = this.printed;
        return Array.from({ length: count }, (_, i) => this.contact.state(from + (to - from) * (i / (count - 1))));
    }

    download() {
        const curvature = this.probe === "flat-punch" ? NaN : this.values.sphere_radius;
        const rows = this.points(150).map(({ contact_radius: a, load, penetration }) => {
            const power = a * Math.sqrt(a), jkr = [power / (Math.sqrt(Math.PI) * curvature), load / (Math.sqrt(6 * Math.PI) * power)];
            return [a, load, TABLE.penetrates ? penetration : "", ...jkr].join(",");
        });
        const head = "contact_radius,load,penetration,jkr_abscissa,jkr_ordinate";
        const href = URL.createObjectURL(new Blob([[head, ...rows, ""].join("\n")], { type: "text/csv" }));
        element("a", { download: "curve.csv", href }).click();
        URL.revokeObjectURL(href);
    }

    /** Draws the curves. */
    draw() {
        const { contact } = this, { penetrates } = TABLE, charts = byId("charts");
        if (!contact || charts.clientWidth === 0) return;
        const [from, to] = this.drawn, controlled = penetrates ? "penetration" : "load";
        const states = Array.from({ length: 301 }, (_, i) => contact.state(from + (to - from) * (i / 300) ** 2));
        states.forEach((state, i) => { state.stable = (states[i + 1] ?? state)[controlled] >= (states[i - 1] ?? state)[controlled]; });
        const abscissae = this.probe === "flat-punch" ? [] : [{ key: "contact_radius", label: "contact radius a", unit: "m" }];
        if (penetrates) abscissae.unshift({ key: "penetration", label: "penetration δ", unit: "m" });
        const columns = charts.clientWidth < 700 ? 1 : abscissae.length, width = Math.floor(charts.clientWidth / columns) - 12;
        const dashed = `Dashed: unstable, ${penetrates ? "even at fixed penetration" : "at fixed load"}.`;
        byId("legend").textContent = `${this.marks.length ? "Dots: pull-off. " : ""}${states.every(({ stable }) => stable) ? "" : dashed}`;
        const load = { key: "load", label: "load F", unit: "N", against: ({ label }) => `load F against ${label}` };
        charts.replaceChildren(...abscissae.map((x) => element("figure", {}, element("figcaption", {}, load.against(x)),
            chart(x, load, states, this.marks, Math.min(width, 640)))));
    }
}

const text = byId("integers").textContent;
/** The integers of all cores. A zero is left out between its commas. */
const INTEGERS = Float64Array.from(text.split(","), Number);
if (hashOf(text) === TABLE.hash) new Page();
else byId("message").append("The data of this page is damaged. Copy the page again, or make it again with `tabulate report`.");
