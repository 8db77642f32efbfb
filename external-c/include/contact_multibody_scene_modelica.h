/* contact_multibody_scene_modelica.h - scenes of many bodies as Modelica's external "C" calls them.
 *
 * Arrays come row-major as Modelica passes them. Errors are reported through ModelicaFormatError,
 * which does not return. */
#ifndef CONTACT_MULTIBODY_SCENE_MODELICA_H
#define CONTACT_MULTIBODY_SCENE_MODELICA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Interns the bodies of a scene with a filter and returns the handle; see cmb_intern_broadphase.
 * excluded is [excluded_count][2], 1-based; fixed, group and mask are [body_count]. */
int cmb_modelica_intern_broadphase(int scene, const int *fixed, size_t body_count, const int *group, const int *mask,
                                   const int *excluded, size_t excluded_count);

/* Forces on all bodies; see cmb_evaluate_response.
 * choice: normal law, use of restitution, use of Hertz's stiffness, rule of restitution, use of friction, rule of
 * friction. number: exponent, steady rate, damping, damping depth, regularisation speed, Stribeck speed, spin radius,
 * rolling lever, turning regularisation speed. stiffness is used without Hertz, modulus and curvature with it. */
void cmb_modelica_response(int broadphase, const double *position, size_t body_count, const double *rotation,
                           const double *velocity, const double *angular_velocity, const double *mass,
                           const double *center_of_mass, const double *inertia, const double *stiffness,
                           const double *modulus, const double *curvature, const double *restitution,
                           const double *mu_static, const double *mu_dynamic, const int *choice, const double *number,
                           double *force, double *torque, double *elastic_energy, double *contact_count,
                           double *largest_depth, double *relative_depth);

/* Forces on some of the bodies, were there no others; see cmb_evaluate_response_among. For the integrator of an FMU, with the
 * arguments of cmb_modelica_response but for its sums. */
void cmb_modelica_response_among(int broadphase, const int *bodies, size_t count, const double *position,
                                 size_t body_count, const double *rotation, const double *velocity,
                                 const double *angular_velocity, const double *mass, const double *center_of_mass,
                                 const double *inertia, const double *stiffness, const double *modulus,
                                 const double *curvature, const double *restitution, const double *mu_static,
                                 const double *mu_dynamic, const int *choice, const double *number, double *force,
                                 double *torque);

/* Radii of the bodies; see cmb_body_radii. */
void cmb_modelica_body_radii(int broadphase, size_t body_count, double *radius);

/* Bodies, all where `bodies` is NULL, that pass through each other between the ends of an integrator's step; see
 * cmb_find_passage_among. For the integrator of an FMU. `pair` and `number`: as of cmb_modelica_find_passage. */
void cmb_modelica_find_passage_among(int broadphase, const int *bodies, size_t count, size_t body_count, double duration,
                                     const double *begin, const double *end,
                                     int (*at)(void *context, double share, double *motion), void *context, int *pair,
                                     double *number);

#ifdef __cplusplus
}
#endif

#endif
