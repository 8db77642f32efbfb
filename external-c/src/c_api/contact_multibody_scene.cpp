#include "contact_multibody_scene.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "c_api/call_guard.hpp"
#include "c_api/pose_check.hpp"
#include "passage/passage_search.hpp"
#include "response/contact_response.hpp"
#include "response/pair_law.hpp"
#include "scene/interned.hpp"
#include "scene/registry.hpp"

namespace {

using cmb::BroadPhase;
using cmb::ContactPoint;
using cmb::fail;
using cmb::guarded;
using cmb::Scene;
using cmb::SceneError;
using cmb::Vec3;

cmb::Interned<BroadPhase, CMB_BROADPHASE_LIMIT> &registry() {
  static cmb::Interned<BroadPhase, CMB_BROADPHASE_LIMIT> instance;
  return instance;
}

std::vector<cmb::FilterEntry> filter_entries(const cmb_collision_filter &filter) {
  std::vector<cmb::FilterEntry> entries(filter.body_count);
  for (std::size_t body = 0; body < filter.body_count; ++body) {
    if (filter.fixed != nullptr) entries[body].fixed = filter.fixed[body] != 0;
    if (filter.group != nullptr) entries[body].group = static_cast<std::uint32_t>(filter.group[body]);
    if (filter.mask != nullptr) entries[body].mask = static_cast<std::uint32_t>(filter.mask[body]);
  }
  return entries;
}

std::vector<std::pair<std::size_t, std::size_t>> excluded_pairs(const cmb_collision_filter &filter) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  pairs.reserve(filter.excluded_count);
  for (std::size_t i = 0; i < filter.excluded_count; ++i) {
    const int *row = filter.excluded + 2 * i;
    for (const int body : {row[0], row[1]}) {
      if (body < 1 || static_cast<std::size_t>(body) > filter.body_count) {
        throw SceneError(CMB_ERROR_ARGUMENT, "excluded pair " + std::to_string(i + 1) + " names body " +
                                                 std::to_string(body) + "; bodies are numbered from 1 to " +
                                                 std::to_string(filter.body_count));
      }
    }
    pairs.emplace_back(row[0] - 1, row[1] - 1);
  }
  return pairs;
}

std::string filter_key(cmb_scene scene, const cmb_collision_filter &filter) {
  std::string key = std::to_string(scene.number);
  for (const int *flags : {filter.fixed, filter.group, filter.mask}) {
    key += '|';
    for (std::size_t body = 0; flags != nullptr && body < filter.body_count; ++body) key += std::to_string(flags[body]) + ' ';
  }
  key += '|';
  for (std::size_t i = 0; i < 2 * filter.excluded_count; ++i) key += std::to_string(filter.excluded[i]) + ' ';
  return key;
}

cmb_status unknown_broadphase(cmb_broadphase handle) {
  return fail(CMB_ERROR_ARGUMENT, "there is no broad phase " + std::to_string(handle.number) +
                                      "; use a handle that cmb_intern_broadphase gave");
}

// Checks what every query takes. broad_phase, and the bodies' poses in this thread's scratch, are set where it returns CMB_OK.
cmb_status check_query(cmb_broadphase handle, const cmb_poses *poses, const BroadPhase *&broad_phase) {
  broad_phase = registry().find(handle.number);
  if (broad_phase == nullptr) return unknown_broadphase(handle);
  const cmb_status counted = cmb::check_poses(poses, broad_phase->body_count());
  if (counted != CMB_OK) return counted;
  std::vector<cmb::convex::Pose> &body_poses = cmb::response_scratch().broad_phase.body_poses;
  body_poses.resize(poses->body_count);
  return cmb::read_body_poses(*poses, body_poses.data());
}

// Checks the bodies that a query is about, and sets scratch.among and their poses.
cmb_status check_among(const BroadPhase &broad_phase, const cmb_motion &motion, const int *bodies, size_t count,
                       cmb::ResponseScratch &scratch) {
  scratch.among.clear();
  scratch.broad_phase.body_poses.resize(broad_phase.body_count());
  int last = 0;
  for (size_t k = 0; k < count; ++k) {
    if (bodies[k] <= last || static_cast<size_t>(bodies[k]) > broad_phase.body_count()) {
      return fail(CMB_ERROR_ARGUMENT, "body " + std::to_string(bodies[k]) + " in the list of bodies; they ascend from 1 to " +
                                          std::to_string(broad_phase.body_count()));
    }
    last = bodies[k];
    const std::size_t body = static_cast<std::size_t>(last) - 1;
    const cmb_status status = cmb::read_body_pose(body, motion.poses.position, motion.poses.rotation,
                                                  scratch.broad_phase.body_poses[body]);
    if (status != CMB_OK) return status;
    scratch.among.push_back(static_cast<std::uint32_t>(body));
  }
  return CMB_OK;
}

bool finite_row(const double *array, std::size_t row) {
  return std::isfinite(array[3 * row]) && std::isfinite(array[3 * row + 1]) && std::isfinite(array[3 * row + 2]);
}

cmb_status check_velocity(const cmb_motion &motion, size_t body) {
  if (finite_row(motion.velocity, body) && finite_row(motion.angular_velocity, body)) return CMB_OK;
  return fail(CMB_ERROR_POSE, "body " + std::to_string(body + 1) +
                                  " has a velocity that is not finite; check the initial values, or the step "
                                  "size of the integrator");
}

cmb_status check_step(const cmb_step *step, const cmb_passage *passage, std::size_t body_count) {
  if (step == nullptr || passage == nullptr) return fail(CMB_ERROR_ARGUMENT, "step or passage is NULL");
  if (step->body_count != body_count) {
    return fail(CMB_ERROR_ARGUMENT, "a step of " + std::to_string(step->body_count) + " bodies for a scene of " +
                                        std::to_string(body_count));
  }
  if (!(step->duration > 0.0)) return fail(CMB_ERROR_ARGUMENT, "the duration of the step is not positive");
  if (body_count > 0 && (step->begin == nullptr || step->end == nullptr || step->at == nullptr)) {
    return fail(CMB_ERROR_ARGUMENT, "begin, end or at is NULL");
  }
  return CMB_OK;
}

void write_row(const Vec3 &row, double *target) {
  for (int axis = 0; axis < 3; ++axis) target[axis] = row[axis];
}

void write_rows(const std::vector<Vec3> &rows, double *target) {
  for (const Vec3 &row : rows) {
    for (int axis = 0; axis < 3; ++axis) *target++ = row[axis];
  }
}

}  // namespace

extern "C" {

cmb_status cmb_intern_broadphase(cmb_scene scene, const cmb_collision_filter *filter, cmb_broadphase *broadphase) {
  return guarded([&] {
    if (broadphase == nullptr) return fail(CMB_ERROR_ARGUMENT, "broadphase is NULL");
    const std::shared_ptr<const Scene> found = cmb::share_scene(scene);
    if (found == nullptr) {
      return fail(CMB_ERROR_ARGUMENT,
                  "there is no scene " + std::to_string(scene.number) + "; use a handle that cmb_intern gave");
    }
    const cmb_collision_filter none{found->bodies.size(), nullptr, nullptr, nullptr, nullptr, 0};
    const cmb_collision_filter &given = filter == nullptr ? none : *filter;
    if (given.body_count != found->bodies.size()) {
      return fail(CMB_ERROR_ARGUMENT, "a filter for " + std::to_string(given.body_count) + " bodies for a scene of " +
                                          std::to_string(found->bodies.size()));
    }
    if (given.excluded_count > 0 && given.excluded == nullptr) return fail(CMB_ERROR_ARGUMENT, "excluded is NULL");
    const int handle = registry().intern(filter_key(scene, given), [&]() -> std::shared_ptr<const BroadPhase> {
      return std::make_shared<BroadPhase>(found, cmb::CollisionFilter(filter_entries(given), excluded_pairs(given)));
    });
    if (handle == 0) {
      return fail(CMB_ERROR_MEMORY, "there are " + std::to_string(CMB_BROADPHASE_LIMIT) +
                                        " filters already; intern a filter once, not at every step, or release "
                                        "those that are done with");
    }
    *broadphase = {handle};
    return CMB_OK;
  });
}

cmb_status cmb_release_broadphase(cmb_broadphase broadphase) {
  return guarded(
      [&] { return registry().release(broadphase.number) ? CMB_OK : unknown_broadphase(broadphase); });
}

cmb_status cmb_query_candidates(cmb_broadphase broadphase, const cmb_poses *poses, size_t pair_capacity, int *pairs,
                                size_t *pair_count) {
  return guarded([&] {
    const BroadPhase *found = nullptr;
    const cmb_status status = check_query(broadphase, poses, found);
    if (status != CMB_OK) return status;
    if (pair_count == nullptr || (pair_capacity > 0 && pairs == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "pairs or pair_count is NULL");
    }
    cmb::BroadPhaseScratch &scratch = cmb::response_scratch().broad_phase;
    found->find_candidates(scratch);
    std::size_t count = 0;
    const cmb::Candidate *last = nullptr;
    for (const cmb::Candidate &candidate : scratch.candidates) {
      const bool same = last != nullptr && last->body_a == candidate.body_a && last->body_b == candidate.body_b;
      last = &candidate;
      if (same) continue;  // another pair of shapes
      if (count < pair_capacity) {
        pairs[2 * count] = static_cast<int>(candidate.body_a) + 1;
        pairs[2 * count + 1] = static_cast<int>(candidate.body_b) + 1;
      }
      ++count;
    }
    *pair_count = count;
    return CMB_OK;
  });
}

cmb_status cmb_query_contacts(cmb_broadphase broadphase, const cmb_poses *poses, size_t contact_capacity,
                              cmb_contact *contacts, size_t *contact_count) {
  return guarded([&] {
    const BroadPhase *found = nullptr;
    const cmb_status status = check_query(broadphase, poses, found);
    if (status != CMB_OK) return status;
    if (contact_count == nullptr || (contact_capacity > 0 && contacts == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "contacts or contact_count is NULL");
    }
    std::size_t count = 0;
    cmb::visit_contacts(*found, cmb::response_scratch().broad_phase, cmb::query_scratch(),
                        [&](std::size_t a, std::size_t b, const std::vector<ContactPoint> &points) {
                          for (const ContactPoint &p : points) {
                            if (count < contact_capacity) {
                              contacts[count] = {static_cast<int>(a) + 1,
                                                 static_cast<int>(b) + 1,
                                                 p.depth,
                                                 p.weight,
                                                 {p.normal.x, p.normal.y, p.normal.z},
                                                 {p.position.x, p.position.y, p.position.z}};
                            }
                            ++count;
                          }
                        });
    *contact_count = count;
    return CMB_OK;
  });
}

void cmb_contact_law_init(cmb_contact_law *law) {
  *law = {CMB_LAW_EXACT, 1,    1.0, 0.5,  1e3, 1e-4, CMB_COMBINE_MINIMUM, CMB_COMBINE_GEOMETRIC_MEAN, 1, 1e-3,
          0.0,           0.0,  0.0, 1e-2};
}

cmb_status cmb_evaluate_response(cmb_broadphase broadphase, const cmb_contact_law *law,
                                 const cmb_body_properties *properties, const cmb_motion *motion, double *force,
                                 double *torque, cmb_response_sums *sums) {
  return guarded([&] {
    if (law == nullptr || properties == nullptr || motion == nullptr) {
      return fail(CMB_ERROR_ARGUMENT, "law, properties or motion is NULL");
    }
    const BroadPhase *found = nullptr;
    const cmb_status status = check_query(broadphase, &motion->poses, found);
    if (status != CMB_OK) return status;
    const size_t body_count = motion->poses.body_count;
    if (body_count > 0 && (motion->velocity == nullptr || motion->angular_velocity == nullptr || force == nullptr ||
                           torque == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "velocity, angular_velocity, force or torque is NULL");
    }
    for (size_t body = 0; body < body_count; ++body) {
      const cmb_status finite = check_velocity(*motion, body);
      if (finite != CMB_OK) return finite;
    }
    try {
      cmb::ResponseScratch &scratch = cmb::response_scratch();
      const cmb_response_sums result =
          cmb::evaluate_response(*found, *law, *properties, *motion, scratch, cmb::query_scratch());
      write_rows(scratch.force, force);
      write_rows(scratch.torque, torque);
      if (sums != nullptr) *sums = result;
      return CMB_OK;
    } catch (const cmb::ResponseError &error) {
      return fail(CMB_ERROR_ARGUMENT, error.what());
    }
  });
}

cmb_status cmb_evaluate_response_among(cmb_broadphase broadphase, const cmb_contact_law *law,
                                       const cmb_body_properties *properties, const cmb_motion *motion,
                                       const int *bodies, size_t count, double *force, double *torque,
                                       cmb_response_sums *sums) {
  return guarded([&] {
    if (law == nullptr || properties == nullptr || motion == nullptr) {
      return fail(CMB_ERROR_ARGUMENT, "law, properties or motion is NULL");
    }
    const BroadPhase *found = registry().find(broadphase.number);
    if (found == nullptr) return unknown_broadphase(broadphase);
    cmb_status status = cmb::check_poses(&motion->poses, found->body_count());
    if (status != CMB_OK) return status;
    if (count > 0 && (bodies == nullptr || motion->velocity == nullptr || motion->angular_velocity == nullptr ||
                      force == nullptr || torque == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "bodies, velocity, angular_velocity, force or torque is NULL");
    }
    cmb::ResponseScratch &scratch = cmb::response_scratch();
    status = check_among(*found, *motion, bodies, count, scratch);
    if (status != CMB_OK) return status;
    for (const std::uint32_t body : scratch.among) {
      status = check_velocity(*motion, body);
      if (status != CMB_OK) return status;
    }
    try {
      const cmb_response_sums result =
          cmb::evaluate_response_among(*found, *law, *properties, *motion, scratch, cmb::query_scratch());
      for (const std::uint32_t body : scratch.among) {
        write_row(scratch.force[body], force + 3 * body);
        write_row(scratch.torque[body], torque + 3 * body);
      }
      if (sums != nullptr) *sums = result;
      return CMB_OK;
    } catch (const cmb::ResponseError &error) {
      return fail(CMB_ERROR_ARGUMENT, error.what());
    }
  });
}

cmb_status cmb_body_radii(cmb_broadphase broadphase, size_t body_count, double *radius) {
  return guarded([&] {
    const BroadPhase *found = registry().find(broadphase.number);
    if (found == nullptr) return unknown_broadphase(broadphase);
    if (body_count != found->body_count() || (body_count > 0 && radius == nullptr)) {
      return fail(CMB_ERROR_ARGUMENT, "radius is NULL, or not that of all bodies");
    }
    for (size_t body = 0; body < body_count; ++body) radius[body] = found->radius_about_origin(body);
    return CMB_OK;
  });
}

cmb_status cmb_find_passage(cmb_scene scene, const cmb_step *step, cmb_passage *passage) {
  return guarded([&] {
    const Scene *const found = cmb::find_scene(scene);
    if (found == nullptr) return fail(CMB_ERROR_ARGUMENT, "there is no scene " + std::to_string(scene.number));
    const cmb_status status = check_step(step, passage, found->bodies.size());
    if (status != CMB_OK) return status;
    *passage = {};
    cmb::PassageSearch(*found, *step).find(*passage);
    return CMB_OK;
  });
}

cmb_status cmb_find_passage_among(cmb_broadphase broadphase, const int *bodies, size_t count, const cmb_step *step,
                                  cmb_passage *passage) {
  return guarded([&] {
    const BroadPhase *const found = registry().find(broadphase.number);
    if (found == nullptr) return unknown_broadphase(broadphase);
    const cmb_status status = check_step(step, passage, found->body_count());
    if (status != CMB_OK) return status;
    std::vector<std::uint32_t> among(bodies == nullptr ? found->body_count() : count);
    for (std::size_t k = 0; k < among.size(); ++k) {
      const std::size_t number = bodies == nullptr ? k + 1 : static_cast<std::size_t>(bodies[k]);
      if (number < 1 || number > found->body_count() || (k > 0 && number <= std::size_t{among[k - 1]} + 1)) {
        return fail(CMB_ERROR_ARGUMENT, "bodies do not ascend from 1 to " + std::to_string(found->body_count()));
      }
      among[k] = static_cast<std::uint32_t>(number - 1);
    }
    *passage = {};
    cmb::PassageSearch(found->scene(), *step).find_among(among, found->filter(), *passage);
    return CMB_OK;
  });
}

}  // extern "C"
