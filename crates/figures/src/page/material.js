// The material that the settings describe: the ratios that are the axes of a table (material.rs, equivalence.rs).

/** The reduced modulus E/(1 - ν²). */
const reduced = (young, poisson) => young / ((1 - poisson) * (1 + poisson));

/** The reduced moduli of film, substrate and sphere. */
function reducedModuli(values) {
    return {
        film: reduced(values.film_modulus, values.film_poisson_ratio),
        substrate: reduced(values.substrate_modulus, values.substrate_poisson_ratio),
        sphere: values.sphere_modulus,
    };
}

/** Es*, the modulus of sphere and film (eq. 7), in Pa. */
function sphereFilmModulus(values) {
    const { film, sphere } = reducedModuli(values);
    return 1 / (1 / film + 1 / sphere);
}

/** The Poisson ratio of the substrate that makes a pair with the film's. */
const pairOf = (nu1) => (1 - 2 * nu1) / (2 - 3 * nu1);

/** The paired Poisson ratios of film and substrate that make, with the same reduced moduli, the same contact. */
function pairedPoissonRatios(values) {
    const { film, substrate } = reducedModuli(values), nu1 = values.film_poisson_ratio, nu0 = values.substrate_poisson_ratio;
    const p = 1 / (1 + film / substrate), rest = 1 / (1 + substrate / film);
    const k = (nu) => (1 - 2 * nu) / (1 - nu);
    // b and 1 - b, each without cancellation.
    const b = (p * nu1) / (1 - nu1) + rest * k(nu0), other = p * k(nu1) + (rest * nu0) / (1 - nu0);
    return { film_poisson_ratio: b / (b + b + other), substrate_poisson_ratio: other / (other + other + b) };
}

/** Returns the value of each of the table's parameters of a material. */
function materialOf(table, values) {
    const { film, substrate, sphere } = reducedModuli(values);
    const { film_poisson_ratio: nu1, substrate_poisson_ratio: nu0 } = table.nu0 === null ? pairedPoissonRatios(values) : values;
    if (table.reduced) {
        const e1s_over_einfs = film / sphere + film / substrate;
        // Between a rigid sphere and a rigid substrate E0*/E2* does not matter.
        return { e1s_over_einfs, nu1, e0s_over_e2s: e1s_over_einfs === 0 ? 1 : substrate / sphere };
    }
    // The Young's moduli of the equivalent.
    const young = (modulus, nu) => modulus * (1 - nu) * (1 + nu);
    const unit = table.rigidSphere ? young(film, nu1) : sphere;
    return { e1_over_e2: table.rigidSphere ? 0 : young(film, nu1) / unit, nu1, e0_over_e2: young(substrate, nu0) / unit };
}

/** True if all bodies of a kind are rigid in the table. `key` is the setting of their modulus. */
function alwaysRigid(table, key) {
    const [film, , substrate] = table.parameters.map((parameter) => table.range(parameter));
    const bothRigid = table.reduced && film[1] === 0;
    switch (key) {
        case "sphere_modulus": return bothRigid || table.rigidSphere || (table.reduced && substrate[1] === 0);
        case "substrate_modulus": return bothRigid || substrate[0] === Infinity;
        default: return false;
    }
}

/** True if some bodies of a kind are rigid in the table, and others are not. */
function mayBeRigid(table, key) {
    if (!table.reduced || alwaysRigid(table, key)) return false;
    const [from, to] = table.range("e0s_over_e2s");
    return key === "sphere_modulus" ? from === 0 : key === "substrate_modulus" && to === Infinity;
}

/** True if the table does not determine a modulus from the other settings. */
function isFree(table, key) {
    const [film, , substrate] = table.parameters;
    switch (key) {
        // A ratio of 0 is that of any film between rigid bodies, and of any substrate under a rigid sphere.
        case "film_modulus": return !table.fixes(film) || table.range(film)[0] === 0;
        case "substrate_modulus": return !alwaysRigid(table, key) && (!table.fixes(substrate) || table.range(substrate)[0] === 0);
        default: return !alwaysRigid(table, key);
    }
}

/** Returns the range of the Young's modulus `key` of film or substrate, from that of its ratio and the other values. */
function modulusRange(table, key, values) {
    const { substrate, sphere } = reducedModuli(values), film = key === "film_modulus";
    const nu = film ? values.film_poisson_ratio : values.substrate_poisson_ratio;
    const [film_ratio, , substrate_ratio] = table.parameters;
    const unit = table.reduced
        ? (1 - nu) * (1 + nu) * (film ? 1 / (1 / sphere + 1 / substrate) : sphere)
        : table.rigidSphere ? values.film_modulus : sphere;
    return table.range(film ? film_ratio : substrate_ratio).map((ratio) => (ratio === 0 ? 0 : rounded(ratio * unit)));
}
