// The material that the settings describe: the ratios that are the axes of a table (material.rs, equivalence.rs).

/** The reduced moduli of film, substrate and sphere, and Es* of sphere and film (eq. 7), in Pa. */
function reducedModuli(values) {
    const reduced = (young, poisson) => young / ((1 - poisson) * (1 + poisson));
    const film = reduced(values.film_modulus, values.film_poisson_ratio), sphere = values.sphere_modulus;
    const substrate = reduced(values.substrate_modulus, values.substrate_poisson_ratio);
    return { film, substrate, sphere, ofSphereAndFilm: 1 / (1 / film + 1 / sphere) };
}

/** The paired Poisson ratios of film and substrate that make, with the same reduced moduli, the same contact. */
function pairedPoissonRatios(values) {
    const { film, substrate } = reducedModuli(values), nu1 = values.film_poisson_ratio, nu0 = values.substrate_poisson_ratio;
    const p = 1 / (1 + film / substrate), rest = 1 / (1 + substrate / film);
    const k = (nu) => (1 - 2 * nu) / (1 - nu);
    // b and 1 - b, each without cancellation.
    const b = (p * nu1) / (1 - nu1) + rest * k(nu0), other = p * k(nu1) + (rest * nu0) / (1 - nu0);
    return [b / (b + b + other), other / (other + other + b)];
}

/** Returns the value of each of the table's parameters of a material. */
function materialOf(values) {
    const { film, substrate, sphere } = reducedModuli(values);
    const [nu1, nu0] = TABLE.nu0 === null ? pairedPoissonRatios(values) : [values.film_poisson_ratio, values.substrate_poisson_ratio];
    if (TABLE.reduced) {
        const e1s_over_einfs = film / sphere + film / substrate;
        // Between a rigid sphere and a rigid substrate E0*/E2* does not matter.
        return { e1s_over_einfs, nu1, e0s_over_e2s: e1s_over_einfs === 0 ? 1 : substrate / sphere };
    }
    // The Young's moduli of the equivalent.
    const young = (modulus, nu) => modulus * (1 - nu) * (1 + nu), unit = TABLE.rigidSphere ? young(film, nu1) : sphere;
    return { e1_over_e2: TABLE.rigidSphere ? 0 : young(film, nu1) / unit, nu1, e0_over_e2: young(substrate, nu0) / unit };
}

/** Returns the range of the Young's modulus `key` of film or substrate, from that of its ratio and the other values. */
function modulusRange(key, values) {
    const { substrate, sphere } = reducedModuli(values), film = key === "film_modulus", nu = values[key.replace("modulus", "poisson_ratio")];
    const unit = TABLE.reduced ? (1 - nu) * (1 + nu) * (film ? 1 / (1 / sphere + 1 / substrate) : sphere) : values[TABLE.unit];
    return TABLE.parameters[film ? 0 : 2].ends.map((ratio) => (ratio === 0 ? 0 : rounded(ratio * unit)));
}
