#include "contact_multibody.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "backend/distance_library.hpp"
#include "c_api/call_guard.hpp"
#include "c_api/pose_check.hpp"
#include "query/overlap_query.hpp"
#include "query/pair_query.hpp"
#include "scene/descriptor.hpp"
#include "scene/inline_files.hpp"
#include "scene/registry.hpp"

namespace {

using cmb::ContactPoint;
using cmb::ContactSet;
using cmb::Pose;
using cmb::Scene;
using cmb::Vec3;

using cmb::read_body_pose;
using cmb::fail;
using cmb::guarded;

cmb_status check_query(cmb_scene handle, const double *position, const double *rotation, std::size_t body_count,
                       std::size_t point_capacity, const Scene *&scene) {
  scene = cmb::find_scene(handle);
  if (scene == nullptr) {
    return fail(CMB_ERROR_ARGUMENT,
                "there is no scene " + std::to_string(handle) + "; use a handle that cmb_intern gave");
  }
  if (body_count != scene->bodies.size()) {
    return fail(CMB_ERROR_ARGUMENT, "poses of " + std::to_string(body_count) + " bodies for a scene of " +
                                        std::to_string(scene->bodies.size()));
  }
  if (point_capacity < 1) return fail(CMB_ERROR_ARGUMENT, "point_capacity is 0; it has to be at least 1");
  if (body_count > 0 && (position == nullptr || rotation == nullptr)) {
    return fail(CMB_ERROR_ARGUMENT, "position or rotation is NULL");
  }
  return CMB_OK;
}

void write_vector(const Vec3 &v, double *target) {
  target[0] = v.x;
  target[1] = v.y;
  target[2] = v.z;
}

// The same vector `count` times, two at once: most slots hold nothing.
void fill_vectors(const Vec3 &v, double *target, std::size_t count) {
  const double two[6] = {v.x, v.y, v.z, v.x, v.y, v.z};
  for (; count >= 2; count -= 2, target += 6) std::memcpy(target, two, sizeof two);
  if (count > 0) write_vector(v, target);
}

cmb_status check_pair_query(cmb_scene handle, std::size_t pair, const double *position, const double *rotation,
                            std::size_t body_count, std::size_t point_capacity, const Scene *&scene, Pose &pose_a,
                            Pose &pose_b) {
  cmb_status status = check_query(handle, position, rotation, body_count, point_capacity, scene);
  if (status != CMB_OK) return status;
  if (pair >= scene->pairs.size()) {
    return fail(CMB_ERROR_ARGUMENT, "there is no pair " + std::to_string(pair) + "; the scene has " +
                                        std::to_string(scene->pairs.size()) + ", counted from 0");
  }
  status = read_body_pose(scene->pairs[pair].first, position, rotation, pose_a);
  return status != CMB_OK ? status : read_body_pose(scene->pairs[pair].second, position, rotation, pose_b);
}

// Where the arrays of one pair begin.
struct PairOutput {
  double *distance, *depth, *weight, *normal, *point;
};

void query_pair(const Scene &scene, std::size_t pair, const Pose &pose_a, const Pose &pose_b,
                double exact_within, std::size_t point_capacity, cmb::QueryScratch &scratch, const PairOutput &output) {
  cmb::PairReport report;
  ContactSet &contact = scratch.contact;
  cmb::query_bodies(scene, scene.bodies[scene.pairs[pair].first], pose_a, scene.bodies[scene.pairs[pair].second], pose_b,
                    scratch, contact, report, exact_within);
  cmb::merge_points(contact.points, point_capacity);
  *output.distance = contact.distance;
  const std::size_t used = contact.points.size();
  for (std::size_t k = 0; k < used; ++k) {
    const ContactPoint &point = contact.points[k];
    output.depth[k] = point.depth;
    output.weight[k] = point.weight;
    write_vector(point.normal, output.normal + 3 * k);
    write_vector(point.position, output.point + 3 * k);
  }
  for (std::size_t k = used; k < point_capacity; ++k) output.depth[k] = 0.0;
  for (std::size_t k = used; k < point_capacity; ++k) output.weight[k] = 0.0;
  fill_vectors(contact.normal, output.normal + 3 * used, point_capacity - used);
  fill_vectors(contact.witness, output.point + 3 * used, point_capacity - used);
}

}  // namespace

extern "C" {

cmb_status cmb_intern(const char *const *geometry, size_t body_count, const int *pairs, size_t pair_count,
                      cmb_backend backend, cmb_scene *scene) {
  return cmb_intern_with_files(geometry, body_count, pairs, pair_count, backend, nullptr, scene);
}

cmb_status cmb_intern_with_files(const char *const *geometry, size_t body_count, const int *pairs, size_t pair_count,
                                 cmb_backend backend, const char *folder, cmb_scene *scene) {
  return guarded([&] {
    if (scene == nullptr) return fail(CMB_ERROR_ARGUMENT, "scene is NULL");
    if (body_count > 0 && geometry == nullptr) return fail(CMB_ERROR_ARGUMENT, "geometry is NULL");
    if (pair_count > 0 && pairs == nullptr) return fail(CMB_ERROR_ARGUMENT, "pairs is NULL");
    for (size_t i = 0; i < body_count; ++i) {
      if (geometry[i] == nullptr) {
        return fail(CMB_ERROR_ARGUMENT, "descriptor " + std::to_string(i + 1) + " is NULL; give an empty string");
      }
    }
    if (backend < CMB_BACKEND_AUTO || backend > CMB_BACKEND_COAL) {
      return fail(CMB_ERROR_ARGUMENT, "there is no back end " + std::to_string(static_cast<int>(backend)) +
                                          "; use 0 auto, 1 analytic, 2 libccd, 3 FCL or 4 coal");
    }
    *scene = cmb::intern_scene(geometry, body_count, pairs, pair_count, backend, cmb::distance_library(backend),
                               folder == nullptr ? "" : folder);
    return CMB_OK;
  });
}

cmb_status cmb_inline_files(const char *geometry, const char *folder, char *text, size_t capacity, size_t *length) {
  return guarded([&] {
    if (geometry == nullptr || length == nullptr) return fail(CMB_ERROR_ARGUMENT, "geometry or length is NULL");
    if (text == nullptr && capacity > 0) return fail(CMB_ERROR_ARGUMENT, "text is NULL");
    cmb::GeometryFiles files(folder == nullptr ? "" : folder);
    try {
      const std::string inlined = cmb::inline_files(geometry, files);
      *length = inlined.size() + 1;
      if (capacity >= *length) std::memcpy(text, inlined.c_str(), *length);
    } catch (const cmb::DescriptorError &error) {
      return fail(CMB_ERROR_DESCRIPTOR, "column " + std::to_string(error.column()) + ": " + error.what());
    }
    return CMB_OK;
  });
}

cmb_status cmb_query_scene(cmb_scene scene, const double *position, const double *rotation, size_t body_count,
                           size_t pair_count, size_t point_capacity, double *distance, double *depth,
                           double *weight, double *normal, double *point) {
  return cmb_query_scene_within(scene, HUGE_VAL, position, rotation, body_count, pair_count, point_capacity, distance,
                                depth, weight, normal, point);
}

cmb_status cmb_query_scene_within(cmb_scene scene, double exact_within, const double *position, const double *rotation,
                                  size_t body_count, size_t pair_count, size_t point_capacity, double *distance,
                                  double *depth, double *weight, double *normal, double *point) {
  return guarded([&] {
    if (!(exact_within > 0.0)) return fail(CMB_ERROR_ARGUMENT, "exact_within is not positive; give a length in m");
    const Scene *found = nullptr;
    cmb_status status = check_query(scene, position, rotation, body_count, point_capacity, found);
    if (status != CMB_OK) return status;
    if (pair_count != found->pairs.size()) {
      return fail(CMB_ERROR_ARGUMENT, "room for " + std::to_string(pair_count) + " pairs for a scene of " +
                                          std::to_string(found->pairs.size()));
    }
    if (pair_count > 0 && (distance == nullptr || depth == nullptr || weight == nullptr || normal == nullptr ||
                           point == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "an output array is NULL");
    }
    cmb::QueryScratch &scratch = cmb::query_scratch();
    std::vector<Pose> &poses = scratch.body_poses;
    if (poses.size() < body_count) poses.resize(body_count);
    for (size_t body = 0; body < body_count; ++body) {
      status = read_body_pose(body, position, rotation, poses[body]);
      if (status != CMB_OK) return status;
    }
    for (size_t pair = 0; pair < pair_count; ++pair) {
      const size_t slot = pair * point_capacity;
      query_pair(*found, pair, poses[found->pairs[pair].first], poses[found->pairs[pair].second], exact_within,
                 point_capacity, scratch,
                 {distance + pair, depth + slot, weight + slot, normal + 3 * slot, point + 3 * slot});
    }
    return CMB_OK;
  });
}

cmb_status cmb_query_pair(cmb_scene scene, size_t pair, const double *position, const double *rotation,
                          size_t body_count, size_t point_capacity, double *distance, double *depth,
                          double *weight, double *normal, double *point) {
  return guarded([&] {
    const Scene *found = nullptr;
    Pose pose_a, pose_b;
    const cmb_status status =
        check_pair_query(scene, pair, position, rotation, body_count, point_capacity, found, pose_a, pose_b);
    if (status != CMB_OK) return status;
    if (distance == nullptr || depth == nullptr || weight == nullptr || normal == nullptr || point == nullptr) {
      return fail(CMB_ERROR_ARGUMENT, "an output array is NULL");
    }
    query_pair(*found, pair, pose_a, pose_b, HUGE_VAL, point_capacity, cmb::query_scratch(), {distance, depth, weight, normal, point});
    return CMB_OK;
  });
}

cmb_status cmb_query_backend(cmb_scene scene, size_t pair, const double *position, const double *rotation,
                             size_t body_count, cmb_backend *backend) {
  return guarded([&] {
    const Scene *found = nullptr;
    Pose pose_a, pose_b;
    const cmb_status status = check_pair_query(scene, pair, position, rotation, body_count, 1, found, pose_a, pose_b);
    if (status != CMB_OK) return status;
    if (backend == nullptr) return fail(CMB_ERROR_ARGUMENT, "backend is NULL");
    cmb::PairReport report;
    cmb::QueryScratch &scratch = cmb::query_scratch();
    cmb::query_bodies(*found, found->bodies[found->pairs[pair].first], pose_a,
                      found->bodies[found->pairs[pair].second], pose_b, scratch, scratch.contact, report);
    *backend = report.backend;
    return CMB_OK;
  });
}

cmb_status cmb_query_overlap(cmb_scene scene, size_t pair, const double *position, const double *rotation,
                             size_t body_count, cmb_overlap *overlap) {
  return guarded([&] {
    const Scene *found = nullptr;
    Pose pose_a, pose_b;
    const cmb_status status = check_pair_query(scene, pair, position, rotation, body_count, 1, found, pose_a, pose_b);
    if (status != CMB_OK) return status;
    if (overlap == nullptr) return fail(CMB_ERROR_ARGUMENT, "overlap is NULL");
    *overlap = cmb::query_overlap(found->bodies[found->pairs[pair].first], pose_a,
                                  found->bodies[found->pairs[pair].second], pose_b);
    return CMB_OK;
  });
}

cmb_status cmb_backend_counts(cmb_scene scene, unsigned long long *answered, unsigned long long *refused) {
  return guarded([&] {
    const Scene *found = cmb::find_scene(scene);
    if (found == nullptr) {
      return fail(CMB_ERROR_ARGUMENT,
                  "there is no scene " + std::to_string(scene) + "; use a handle that cmb_intern gave");
    }
    if (answered == nullptr || refused == nullptr) return fail(CMB_ERROR_ARGUMENT, "answered or refused is NULL");
    *answered = found->answered.load(std::memory_order_relaxed);
    *refused = found->refused.load(std::memory_order_relaxed);
    return CMB_OK;
  });
}

const char *cmb_status_text(cmb_status status) {
  switch (status) {
    case CMB_OK: return "no error";
    case CMB_ERROR_ARGUMENT: return "wrong argument";
    case CMB_ERROR_DESCRIPTOR: return "wrong descriptor";
    case CMB_ERROR_POSE: return "wrong pose";
    case CMB_ERROR_MEMORY: return "out of memory";
    case CMB_ERROR_INTERNAL: return "internal failure";
  }
  return "unknown status";
}

const char *cmb_last_error(void) { return cmb::last_error(); }

const char *cmb_version(void) { return CMB_VERSION; }

}  // extern "C"
