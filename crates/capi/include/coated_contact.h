#ifndef COATED_CONTACT_H
#define COATED_CONTACT_H

/* Made of crates/capi/src by cbindgen: change it there, and run the tests with WRITE_HEADER=1. */

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
/* A pointer that is null is refused with a text, or ignored where that is stated. Any other pointer must be one to
   a sound object: one that its maker here has given, and that has not been freed. An object is freed once. */

/*
 The status that a function returns.
 */
typedef enum CcStatus {
  /*
   The results are written.
   */
  CC_STATUS_OK = 0,
  /*
   A pointer is null, or a number is not one of those that an enumeration has.
   */
  CC_STATUS_ARGUMENT = 1,
  /*
   The contact cannot be computed: a value out of range, a table that cannot be read.
   */
  CC_STATUS_CONTACT = 2,
  /*
   A fault of the library.
   */
  CC_STATUS_FAULT = 3,
} CcStatus;

/*
 The shapes of the probe: the values of `CcSystem.probe`. Angles are between the axis and the flank.
 */
typedef enum CcProbe {
  /*
   Paraboloid of the radius of curvature `probe_radius`: the sphere of JKR's and Barthel's models.
   */
  CC_PROBE_PARABOLOID = 0,
  /*
   The sphere of `probe_radius` itself.
   */
  CC_PROBE_SPHERE = 1,
  /*
   Cone of `half_angle`.
   */
  CC_PROBE_CONE = 2,
  /*
   Cone of `half_angle` with a round end of `probe_radius`.
   */
  CC_PROBE_ROUNDED_CONE = 3,
  /*
   Flat cylindrical punch of `probe_radius`.
   */
  CC_PROBE_FLAT_PUNCH = 4,
  /*
   Cone of `half_angle` with a flat end of `probe_radius`.
   */
  CC_PROBE_FLAT_ENDED_CONE = 5,
} CcProbe;

/*
 A probe on a film on a substrate, looked up.
 */
typedef struct CcContact CcContact;

/*
 A table of contacts.
 */
typedef struct CcTable CcTable;

/*
 A probe on a film on a substrate, in SI units.
 */
typedef struct CcSystem {
  /*
   The shape of the probe: a value of `CcProbe`.
   */
  int32_t probe;
  /*
   Radius of the probe, m; not read for a cone. Messages name it `sphere_radius`.
   */
  double probe_radius;
  /*
   Half angle of a cone, rad, between 0 and pi/2; not read for other shapes.
   */
  double half_angle;
  /*
   Reduced modulus E2* of the probe, Pa, at most 1e25; infinity is rigid. Messages name it `sphere_modulus`.
   */
  double probe_modulus;
  /*
   Young's modulus of the film, Pa.
   */
  double film_modulus;
  /*
   Poisson ratio of the film, from 0 to 0.5.
   */
  double film_poisson_ratio;
  /*
   Thickness of the film, m.
   */
  double film_thickness;
  /*
   Young's modulus of the substrate, Pa; infinity is rigid.
   */
  double substrate_modulus;
  /*
   Poisson ratio of the substrate, from 0 to 0.5.
   */
  double substrate_poisson_ratio;
} CcSystem;

/*
 A state of a contact.
 */
typedef struct CcState {
  /*
   Contact radius, m.
   */
  double contact_radius;
  /*
   Load, N, positive in compression.
   */
  double load;
  /*
   Penetration, m, positive when the probe has moved in.
   */
  double penetration;
} CcState;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Returns why the last failed call of this thread failed, as UTF-8 that ends with a zero byte.

 The text is valid until the next call of this thread fails. Before any failure it is empty.
 */
const char *cc_error(void);

/*
 Reads a table, in HDF5 or packed, from the file of a `path` in UTF-8.

 Free the table by `cc_table_free` after the last contact in it is made. A contact keeps no table.

 # Safety
 `path` is null or a text that ends with a zero byte.
 */
enum CcStatus cc_table_read(const char *path, struct CcTable **table);

/*
 Frees a table. A null pointer is ignored.
 */
void cc_table_free(struct CcTable *table);

/*
 Looks a system up in a table; a null `table` is the one that is compiled in. To 1e-6 it holds contact radii from
 1e-3 to 1e3 film thicknesses, Poisson ratios from 0 to 0.5, probes and substrates of any modulus, and films up to 1e10
 times as stiff as both together. Smaller and larger contacts are answered by expansions where these are as accurate.

 Free the contact by `cc_contact_free`.
 */
enum CcStatus cc_contact_new(const struct CcTable *table,
                             const struct CcSystem *system,
                             struct CcContact **contact);

/*
 Frees a contact. A null pointer is ignored.
 */
void cc_contact_free(struct CcContact *contact);

/*
 Computes the load (N) at each of `count` contact radii (m) for a work of adhesion (J/m^2).

 # Safety
 `contact_radii` is null or holds `count` numbers; `loads` is null or has room for as many, and may be
 the same array.
 */
enum CcStatus cc_load(const struct CcContact *contact,
                      const double *contact_radii,
                      size_t count,
                      double work_of_adhesion,
                      double *loads);

/*
 Computes the penetration (m) at each of `count` contact radii (m) for a work of adhesion (J/m^2).

 # Safety
 As `cc_load`.
 */
enum CcStatus cc_penetration(const struct CcContact *contact,
                             const double *contact_radii,
                             size_t count,
                             double work_of_adhesion,
                             double *penetrations);

/*
 Computes the contact stiffness dF/d delta (N/m) of a pinned contact line at each of `count` contact
 radii (m).

 # Safety
 As `cc_load`.
 */
enum CcStatus cc_stiffness(const struct CcContact *contact,
                           const double *contact_radii,
                           size_t count,
                           double *stiffnesses);

/*
 Finds the last stable state of a separation by a machine of the stiffness `machine_stiffness` (N/m):
 0 is a dead weight, infinity a rigid machine, and a cantilever lies between.
 */
enum CcStatus cc_pull_off(const struct CcContact *contact,
                          double work_of_adhesion,
                          double machine_stiffness,
                          struct CcState *state);

/*
 Computes the derivatives of the load at a contact radius (m) and a work of adhesion (J/m^2) with
 respect to nine inputs, in N per unit of the input: contact radius, work of adhesion, probe radius,
 probe modulus (reduced), film thickness, film modulus, film Poisson ratio, substrate modulus,
 substrate Poisson ratio. A derivative that is not known, such as that by the radius of a cone, is NaN.

 # Safety
 `derivatives` is null or has room for nine numbers.
 */
enum CcStatus cc_gradient(const struct CcContact *contact,
                          double contact_radius,
                          double work_of_adhesion,
                          double *derivatives);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* COATED_CONTACT_H */
