// The C interface with its structures filled from a test's arrays, and handles that can be compared and printed.
#pragma once

#include <cmath>
#include <cstddef>
#include <ostream>

#include "contact_multibody_scene.h"

inline bool operator==(cmb_scene a, cmb_scene b) { return a.number == b.number; }
inline bool operator!=(cmb_scene a, cmb_scene b) { return a.number != b.number; }
inline bool operator==(cmb_broadphase a, cmb_broadphase b) { return a.number == b.number; }
inline bool operator!=(cmb_broadphase a, cmb_broadphase b) { return a.number != b.number; }
inline std::ostream &operator<<(std::ostream &out, cmb_scene scene) { return out << "scene " << scene.number; }
inline std::ostream &operator<<(std::ostream &out, cmb_broadphase broadphase) {
  return out << "broad phase " << broadphase.number;
}

namespace cmb::test {

inline cmb_status intern_scene(const char *const *geometry, std::size_t body_count, const int *pairs,
                               std::size_t pair_count, cmb_backend backend, cmb_scene *scene,
                               const char *folder = nullptr) {
  const cmb_scene_source source{geometry, body_count, pairs, pair_count, backend, folder};
  return cmb_intern(&source, scene);
}

// The caller's arrays for one pair or all of a scene.
inline cmb_status query_scene(cmb_scene scene, const double *position, const double *rotation, std::size_t body_count,
                              std::size_t pair_count, std::size_t point_capacity, double *distance, double *depth,
                              double *weight, double *normal, double *point, double exact_within = HUGE_VAL) {
  const cmb_poses poses{body_count, position, rotation};
  const cmb_contact_points points{pair_count, point_capacity, distance, depth, weight, normal, point};
  return cmb_query_scene(scene, &poses, exact_within, &points);
}

inline cmb_status query_pair(cmb_scene scene, std::size_t pair, const double *position, const double *rotation,
                             std::size_t body_count, std::size_t point_capacity, double *distance, double *depth,
                             double *weight, double *normal, double *point) {
  const cmb_poses poses{body_count, position, rotation};
  const cmb_contact_points points{1, point_capacity, distance, depth, weight, normal, point};
  return cmb_query_pair(scene, pair, &poses, &points);
}

inline cmb_status query_backend(cmb_scene scene, std::size_t pair, const double *position, const double *rotation,
                                std::size_t body_count, cmb_backend *backend) {
  const cmb_poses poses{body_count, position, rotation};
  return cmb_query_backend(scene, pair, &poses, backend);
}

inline cmb_status query_overlap(cmb_scene scene, std::size_t pair, const double *position, const double *rotation,
                                std::size_t body_count, cmb_overlap *overlap) {
  const cmb_poses poses{body_count, position, rotation};
  return cmb_query_overlap(scene, pair, &poses, overlap);
}

inline cmb_status query_candidates(cmb_broadphase broadphase, const double *position, const double *rotation,
                                   std::size_t body_count, std::size_t pair_capacity, int *pairs,
                                   std::size_t *pair_count) {
  const cmb_poses poses{body_count, position, rotation};
  return cmb_query_candidates(broadphase, &poses, pair_capacity, pairs, pair_count);
}

inline cmb_status query_contacts(cmb_broadphase broadphase, const double *position, const double *rotation,
                                 std::size_t body_count, std::size_t contact_capacity, cmb_contact *contacts,
                                 std::size_t *contact_count) {
  const cmb_poses poses{body_count, position, rotation};
  return cmb_query_contacts(broadphase, &poses, contact_capacity, contacts, contact_count);
}

}  // namespace cmb::test
