/* A JKR lens on a film: loads, pull-off and the derivative by the film's modulus. Built and run by
   tests/c.rs; by hand: cc force.c -I../include -L../../../target/release -lcoated_contact */

#include <math.h>
#include <stdio.h>

#include "coated_contact.h"

static int failed(CcStatus status) {
    if (status != CC_STATUS_OK) {
        fprintf(stderr, "%s\n", cc_error());
    }
    return status != CC_STATUS_OK;
}

int main(int count, char **arguments) {
    CcSystem lens = {
        .probe = CC_PROBE_PARABOLOID,
        .probe_radius = 1e-3,
        .probe_modulus = 2e6, /* reduced, E2* */
        .film_modulus = 3.5e6,
        .film_poisson_ratio = 0.5,
        .film_thickness = 1e-6,
        .substrate_modulus = 2e11,
        .substrate_poisson_ratio = 0.25,
    };
    CcTable *table = NULL; /* the table that is compiled in */
    CcContact *contact = NULL;
    if (count > 1 && failed(cc_table_read(arguments[1], &table))) {
        return 1;
    }
    if (failed(cc_contact_new(table, &lens, &contact))) {
        return 1;
    }
    cc_table_free(table);

    double radii[] = {40e-6, 65e-6, 90e-6}, loads[3], gradient[9];
    double work_of_adhesion = 0.040;
    CcState last;
    if (failed(cc_load(contact, radii, 3, work_of_adhesion, loads)) ||
        failed(cc_pull_off(contact, work_of_adhesion, 0.0, &last)) ||
        failed(cc_gradient(contact, radii[1], work_of_adhesion, gradient))) {
        return 1;
    }
    for (int i = 0; i < 3; i++) {
        printf("%.17e %.17e\n", radii[i], loads[i]);
    }
    printf("pull-off %.17e %.17e %.17e\n", last.contact_radius, last.load, last.penetration);
    printf("dF/dE1 %.17e\n", gradient[5]);

    /* A length in millimetres is an error with the value and the range. */
    double millimetres = 65.0;
    if (cc_load(contact, &millimetres, 1, work_of_adhesion, loads) == CC_STATUS_OK) {
        return 1;
    }
    printf("%s\n", cc_error());
    cc_contact_free(contact);
    return 0;
}
