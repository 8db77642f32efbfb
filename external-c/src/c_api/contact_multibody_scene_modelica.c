#include "contact_multibody_scene_modelica.h"

#include "contact_multibody_scene.h"
#include "c_api/passage_numbers.h"

/* Supplied by the Modelica tool (ModelicaUtilities.h of the Modelica specification); does not return. */
extern void ModelicaFormatError(const char *string, ...);

static void report(cmb_status status) {
  if (status != CMB_OK) {
    ModelicaFormatError("ContactMultiBody: %s: %s\n", cmb_status_text(status), cmb_last_error());
  }
}

int cmb_modelica_intern_broadphase(int scene, const int *fixed, size_t body_count, const int *group, const int *mask,
                                   const int *excluded, size_t excluded_count) {
  const cmb_collision_filter filter = {.body_count = body_count,
                                       .fixed = fixed,
                                       .group = group,
                                       .mask = mask,
                                       .excluded = excluded,
                                       .excluded_count = excluded_count};
  cmb_broadphase broadphase = {0};
  report(cmb_intern_broadphase((cmb_scene){scene}, &filter, &broadphase));
  return broadphase.number;
}

static cmb_contact_law law_of(const int *choice, const double *number) {
  return (cmb_contact_law){.normal_law = (cmb_normal_law)choice[0],
                           .use_restitution = choice[1],
                           .restitution_rule = (cmb_combination_rule)choice[3],
                           .use_friction = choice[4],
                           .friction_rule = (cmb_combination_rule)choice[5],
                           .exponent = number[0],
                           .steady_rate = number[1],
                           .damping = number[2],
                           .damping_depth = number[3],
                           .regularisation_speed = number[4],
                           .stribeck_speed = number[5],
                           .spin_radius = number[6],
                           .rolling_lever = number[7],
                           .turning_regularisation_speed = number[8]};
}

static cmb_body_properties properties_of(const int *choice, const double *mass, const double *center_of_mass,
                                         const double *inertia, const double *stiffness, const double *modulus,
                                         const double *curvature, const double *restitution, const double *mu_static,
                                         const double *mu_dynamic) {
  const int hertz = choice[2];
  return (cmb_body_properties){.mass = mass,
                               .center_of_mass = center_of_mass,
                               .inertia = inertia,
                               .stiffness = hertz ? NULL : stiffness,
                               .modulus = modulus,
                               .curvature = curvature,
                               .restitution = restitution,
                               .mu_static = mu_static,
                               .mu_dynamic = mu_dynamic};
}

void cmb_modelica_response(int broadphase, const double *position, size_t body_count, const double *rotation,
                           const double *velocity, const double *angular_velocity, const double *mass,
                           const double *center_of_mass, const double *inertia, const double *stiffness,
                           const double *modulus, const double *curvature, const double *restitution,
                           const double *mu_static, const double *mu_dynamic, const int *choice, const double *number,
                           double *force, double *torque, double *elastic_energy, double *contact_count,
                           double *largest_depth, double *relative_depth) {
  const cmb_contact_law law = law_of(choice, number);
  const cmb_body_properties properties = properties_of(choice, mass, center_of_mass, inertia, stiffness, modulus,
                                                       curvature, restitution, mu_static, mu_dynamic);
  const cmb_motion motion = {{body_count, position, rotation}, velocity, angular_velocity};
  cmb_response_sums sums;
  report(cmb_evaluate_response((cmb_broadphase){broadphase}, &law, &properties, &motion, force, torque, &sums));
  *elastic_energy = sums.elastic_energy;
  *contact_count = (double)sums.contact_count;
  *largest_depth = sums.largest_depth;
  *relative_depth = sums.relative_depth;
}

void cmb_modelica_response_among(int broadphase, const int *bodies, size_t count, const double *position,
                                 size_t body_count, const double *rotation, const double *velocity,
                                 const double *angular_velocity, const double *mass, const double *center_of_mass,
                                 const double *inertia, const double *stiffness, const double *modulus,
                                 const double *curvature, const double *restitution, const double *mu_static,
                                 const double *mu_dynamic, const int *choice, const double *number, double *force,
                                 double *torque) {
  const cmb_contact_law law = law_of(choice, number);
  const cmb_body_properties properties = properties_of(choice, mass, center_of_mass, inertia, stiffness, modulus,
                                                       curvature, restitution, mu_static, mu_dynamic);
  const cmb_motion motion = {{body_count, position, rotation}, velocity, angular_velocity};
  report(cmb_evaluate_response_among((cmb_broadphase){broadphase}, &law, &properties, &motion, bodies, count, force, torque,
                                     NULL));
}

void cmb_modelica_body_radii(int broadphase, size_t body_count, double *radius) {
  report(cmb_body_radii((cmb_broadphase){broadphase}, body_count, radius));
}

void cmb_modelica_find_passage_among(int broadphase, const int *bodies, size_t count, size_t body_count, double duration,
                                     const double *begin, const double *end,
                                     int (*at)(void *context, double share, double *motion), void *context, int *pair,
                                     double *number) {
  const cmb_step step = {body_count, duration, begin, end, at, context};
  cmb_passage passage;
  report(cmb_find_passage_among((cmb_broadphase){broadphase}, bodies, count, &step, &passage));
  cmb_tell_passage(&passage, pair, number);
}
