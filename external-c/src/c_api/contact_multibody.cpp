#include "contact_multibody.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "backend/distance_library.hpp"
#include "c_api/call_guard.hpp"
#include "c_api/pose_check.hpp"
#include "math/lanes.hpp"
#include "query/overlap_query.hpp"
#include "query/pair_query.hpp"
#include "query/query_memory.hpp"
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

cmb_status unknown_scene(cmb_scene handle) {
  return fail(CMB_ERROR_ARGUMENT,
              "there is no scene " + std::to_string(handle.number) + "; use a handle that cmb_intern gave");
}

cmb_status check_query(cmb_scene handle, const cmb_poses *poses, const Scene *&scene) {
  scene = cmb::find_scene(handle);
  if (scene == nullptr) return unknown_scene(handle);
  return cmb::check_poses(poses, scene->bodies.size());
}

// What is wrong with what receives the points of `pair_count` pairs, if anything is.
cmb_status check_room_closely(const cmb_contact_points *points, std::size_t pair_count) {
  if (points == nullptr) return fail(CMB_ERROR_ARGUMENT, "points is NULL");
  if (points->point_capacity < 1) return fail(CMB_ERROR_ARGUMENT, "point_capacity is 0; it has to be at least 1");
  if (points->pair_count != pair_count) {
    return fail(CMB_ERROR_ARGUMENT, "room for " + std::to_string(points->pair_count) + " pairs where " +
                                        std::to_string(pair_count) + " are asked for");
  }
  if (pair_count > 0 && (points->distance == nullptr || points->depth == nullptr || points->weight == nullptr ||
                         points->normal == nullptr || points->point == nullptr)) {
    return fail(CMB_ERROR_ARGUMENT, "an output array is NULL");
  }
  return CMB_OK;
}

cmb_status check_room(const cmb_contact_points *points, std::size_t pair_count) {
  const bool is_there = points != nullptr && points->point_capacity >= 1 && points->pair_count == pair_count &&
                        points->distance != nullptr && points->depth != nullptr && points->weight != nullptr &&
                        points->normal != nullptr && points->point != nullptr;
  return is_there ? CMB_OK : check_room_closely(points, pair_count);
}

void write_vector(const Vec3 &v, double *target) {
  target[0] = v.x;
  target[1] = v.y;
  target[2] = v.z;
}

// One pair of a scene with the poses of its bodies.
struct PosedPair {
  const Scene *scene = nullptr;
  std::size_t index = 0;  // 0-based
  Pose pose_a, pose_b;

  std::size_t body_a() const { return scene->pairs[index].first; }
  std::size_t body_b() const { return scene->pairs[index].second; }
};

cmb_status check_pair(const Scene &scene, std::size_t pair) {
  const std::size_t pair_count = scene.pairs.size();
  if (pair >= 1 && pair <= pair_count) return CMB_OK;
  return fail(CMB_ERROR_ARGUMENT, "there is no pair " + std::to_string(pair) + "; the scene has " +
                                      std::to_string(pair_count) + ", numbered from 1");
}

cmb_status check_pair_query(cmb_scene handle, std::size_t pair, const cmb_poses *poses, PosedPair &posed) {
  cmb_status status = check_query(handle, poses, posed.scene);
  if (status == CMB_OK) status = check_pair(*posed.scene, pair);
  if (status != CMB_OK) return status;
  posed.index = pair - 1;
  const Scene::Pair &bodies = posed.scene->pairs[posed.index];
  status = read_body_pose(bodies.first, poses->position, poses->rotation, posed.pose_a);
  return status != CMB_OK ? status : read_body_pose(bodies.second, poses->position, poses->rotation, posed.pose_b);
}

// Where the arrays of one pair begin.
struct PairOutput {
  double *distance, *depth, *weight, *normal, *point;
};

// A vector twice, as it lies in memory.
struct TwoVectors {
  cmb::convex::Lanes lanes[3];
  explicit TwoVectors(const Vec3 &v) : lanes{{v.x, v.y}, {v.z, v.x}, {v.y, v.z}} {}
  void write(double *target) const {
    for (int k = 0; k < 3; ++k) std::memcpy(target + 2 * k, &lanes[k], sizeof lanes[k]);
  }
};

// The slots from `slot` on, which hold no point; two at once, for most are such.
void write_no_points(const ContactSet &contact, std::size_t slot, std::size_t point_capacity, const PairOutput &output) {
  const TwoVectors normals(contact.normal), places(contact.witness);
  const cmb::convex::Lanes zeros{0.0, 0.0};
  for (; slot + 2 <= point_capacity; slot += 2) {
    std::memcpy(output.depth + slot, &zeros, sizeof zeros);
    std::memcpy(output.weight + slot, &zeros, sizeof zeros);
    normals.write(output.normal + 3 * slot);
    places.write(output.point + 3 * slot);
  }
  if (slot == point_capacity) return;
  output.depth[slot] = output.weight[slot] = 0.0;
  write_vector(contact.normal, output.normal + 3 * slot);
  write_vector(contact.witness, output.point + 3 * slot);
}

void write_contact(const ContactSet &contact, std::size_t point_capacity, const PairOutput &output) {
  *output.distance = contact.distance;
  // No two overlap, as compilers cannot know.
  double *const __restrict depth = output.depth, *const __restrict weight = output.weight, *const __restrict normal = output.normal,
                          *const __restrict place = output.point;
  const ContactPoint *const __restrict points = contact.points.data();
  const std::size_t used = contact.points.size();
  for (std::size_t k = 0; k < used; ++k) {
    depth[k] = points[k].depth;
    weight[k] = points[k].weight;
    normal[3 * k] = points[k].normal.x, normal[3 * k + 1] = points[k].normal.y, normal[3 * k + 2] = points[k].normal.z;
    place[3 * k] = points[k].position.x, place[3 * k + 1] = points[k].position.y, place[3 * k + 2] = points[k].position.z;
  }
  write_no_points(contact, used, point_capacity, output);
}

inline void query_pair(const Scene &scene, const Scene::Pair &bodies, const Pose &pose_a, const Pose &pose_b, double exact_within,
                cmb::QueryScratch &scratch, std::size_t point_capacity, const PairOutput &output) {
  cmb::PairReport report;
  cmb::query_bodies(scene, bodies.first, pose_a, bodies.second, pose_b, scratch, scratch.contact, report, exact_within);
  cmb::merge_points(scratch.contact.points, point_capacity);
  write_contact(scratch.contact, point_capacity, output);
}

cmb::QueryMemory &query_memory() {
  static thread_local cmb::QueryMemory memory;
  return memory;
}

}  // namespace

extern "C" {

cmb_status cmb_intern(const cmb_scene_source *source, cmb_scene *scene) {
  return guarded([&] {
    if (source == nullptr || scene == nullptr) return fail(CMB_ERROR_ARGUMENT, "source or scene is NULL");
    if (source->body_count > 0 && source->geometry == nullptr) return fail(CMB_ERROR_ARGUMENT, "geometry is NULL");
    if (source->pair_count > 0 && source->pairs == nullptr) return fail(CMB_ERROR_ARGUMENT, "pairs is NULL");
    for (size_t i = 0; i < source->body_count; ++i) {
      if (source->geometry[i] == nullptr) {
        return fail(CMB_ERROR_ARGUMENT, "descriptor " + std::to_string(i + 1) + " is NULL; give an empty string");
      }
    }
    const cmb_backend backend = source->backend;
    if (backend < CMB_BACKEND_AUTO || backend > CMB_BACKEND_COAL) {
      return fail(CMB_ERROR_ARGUMENT, "there is no back end " + std::to_string(static_cast<int>(backend)) +
                                          "; use 0 auto, 1 analytic, 2 libccd, 3 FCL or 4 coal");
    }
    *scene = cmb::intern_scene(*source, cmb::distance_library(backend));
    return CMB_OK;
  });
}

cmb_status cmb_release_scene(cmb_scene scene) {
  return guarded([&] { return cmb::release_scene(scene) ? CMB_OK : unknown_scene(scene); });
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

cmb_status cmb_query_scene(cmb_scene scene, const cmb_poses *poses, double exact_within,
                           const cmb_contact_points *points) {
  return guarded([&] {
    if (!(exact_within > 0.0)) return fail(CMB_ERROR_ARGUMENT, "exact_within is not positive; give a length in m");
    const Scene *found = nullptr;
    cmb_status status = check_query(scene, poses, found);
    if (status == CMB_OK) status = check_room(points, found->pairs.size());
    if (status != CMB_OK) return status;
    cmb::QueryScratch &scratch = cmb::query_scratch();
    std::vector<Pose> &body_poses = scratch.body_poses;
    if (body_poses.size() < poses->body_count) body_poses.resize(poses->body_count);
    status = cmb::read_body_poses(*poses, body_poses.data());
    if (status != CMB_OK) return status;
    // A library's answers are counted, each time that it is asked; of a single pair little is to be known.
    const bool is_remembered = found->library == nullptr && found->pairs.size() > 1;
    cmb::QueryMemory *const memory = is_remembered ? &query_memory() : nullptr;
    if (memory != nullptr) memory->begin(*found, *poses, exact_within, points->point_capacity);
    for (size_t pair = 0; pair < points->pair_count; ++pair) {
      if (memory != nullptr && memory->recall(pair, *points)) continue;
      const Scene::Pair &bodies = found->pairs[pair];
      const size_t slot = pair * points->point_capacity;
      query_pair(*found, bodies, body_poses[bodies.first], body_poses[bodies.second], exact_within, scratch, points->point_capacity,
                 {points->distance + pair, points->depth + slot, points->weight + slot, points->normal + 3 * slot,
                  points->point + 3 * slot});
    }
    if (memory != nullptr) memory->end(*poses, *points);
    return CMB_OK;
  });
}

cmb_status cmb_query_pair(cmb_scene scene, size_t pair, const cmb_poses *poses, const cmb_contact_points *points) {
  return guarded([&] {
    PosedPair posed;
    cmb_status status = check_pair_query(scene, pair, poses, posed);
    if (status == CMB_OK) status = check_room(points, 1);
    if (status != CMB_OK) return status;
    query_pair(*posed.scene, posed.scene->pairs[posed.index], posed.pose_a, posed.pose_b, HUGE_VAL, cmb::query_scratch(),
               points->point_capacity, {points->distance, points->depth, points->weight, points->normal, points->point});
    return CMB_OK;
  });
}

cmb_status cmb_query_backend(cmb_scene scene, size_t pair, const cmb_poses *poses, cmb_backend *backend) {
  return guarded([&] {
    PosedPair posed;
    const cmb_status status = check_pair_query(scene, pair, poses, posed);
    if (status != CMB_OK) return status;
    if (backend == nullptr) return fail(CMB_ERROR_ARGUMENT, "backend is NULL");
    cmb::PairReport report;
    cmb::QueryScratch &scratch = cmb::query_scratch();
    cmb::query_bodies(*posed.scene, posed.body_a(), posed.pose_a, posed.body_b(), posed.pose_b, scratch,
                      scratch.contact, report);
    *backend = report.backend;
    return CMB_OK;
  });
}

cmb_status cmb_query_overlap(cmb_scene scene, size_t pair, const cmb_poses *poses, cmb_overlap *overlap) {
  return guarded([&] {
    PosedPair posed;
    const cmb_status status = check_pair_query(scene, pair, poses, posed);
    if (status != CMB_OK) return status;
    if (overlap == nullptr) return fail(CMB_ERROR_ARGUMENT, "overlap is NULL");
    *overlap = cmb::query_overlap(posed.scene->bodies[posed.body_a()], posed.pose_a,
                                  posed.scene->bodies[posed.body_b()], posed.pose_b);
    return CMB_OK;
  });
}

cmb_status cmb_pair_thickness(cmb_scene scene, size_t pair, double *thickness) {
  return guarded([&] {
    const Scene *found = cmb::find_scene(scene);
    if (found == nullptr) return unknown_scene(scene);
    const cmb_status status = check_pair(*found, pair);
    if (status != CMB_OK) return status;
    if (thickness == nullptr) return fail(CMB_ERROR_ARGUMENT, "thickness is NULL");
    const Scene::Pair &bodies = found->pairs[pair - 1];
    *thickness = std::fmin(std::fmin(found->thickness[bodies.first], found->thickness[bodies.second]),
                           CMB_DISTANCE_NONE);
    return CMB_OK;
  });
}

cmb_status cmb_backend_counts(cmb_scene scene, unsigned long long *answered, unsigned long long *refused) {
  return guarded([&] {
    const Scene *found = cmb::find_scene(scene);
    if (found == nullptr) return unknown_scene(scene);
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
