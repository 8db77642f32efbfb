#include "broadphase/broad_phase.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "math/pose_algebra.hpp"
#include "query/pair_query.hpp"

namespace cmb {

BroadPhase::BroadPhase(std::shared_ptr<const Scene> given, CollisionFilter filter)
    : scene_(std::move(given)), identity_(std::make_shared<char>()), filter_(std::move(filter)) {
  const Scene &scene = *scene_;
  std::size_t shapes = 0;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    first_shape_.push_back(shapes);
    shapes += scene.bodies[body].size();
    for (std::size_t shape = 0; shape < scene.bodies[body].size(); ++shape) {
      is_where_body_is_.push_back(is_identity(scene.bodies[body][shape].in_body) ? 1 : 0);
      const Proxy proxy{static_cast<std::uint32_t>(body), static_cast<std::uint32_t>(shape)};
      if (scene.bodies[body][shape].kind == ShapeKind::halfspace) {
        halfspaces_.push_back(proxy);
      } else {
        bounded_.push_back(proxy);
        const LocalBounds &bounds = scene.bodies[body][shape].bounds;
        local_bounds_.push_back(bounds);
        is_ball_.push_back(norm2(bounds.half) == 0.0 && norm2(bounds.center) == 0.0 ? 1 : 0);
      }
    }
  }
  first_shape_.push_back(shapes);
}

void BroadPhase::emit(const Proxy &a, const Proxy &b, std::vector<Candidate> &found) const {
  if (!filter_.may_touch(a.body, b.body)) return;
  if (a.body < b.body) {
    found.push_back({a.body, b.body, a.shape, b.shape});
  } else {
    found.push_back({b.body, a.body, b.shape, a.shape});
  }
}

void BroadPhase::place_shapes(BroadPhaseScratch &scratch) const {
  scratch.shape_poses.resize(first_shape_.back());
  for (std::size_t body = 0; body < body_count(); ++body) {
    const Pose &pose = scratch.body_poses[body];
    std::size_t k = first_shape_[body];
    for (const Shape &shape : scene_->bodies[body]) {
      scratch.shape_poses[k] = is_where_body_is_[k] != 0 ? pose : compose(pose, shape.in_body);
      ++k;
    }
  }
  scratch.bounds.resize(bounded_.size());
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    const Proxy &proxy = bounded_[i];
    const Pose &pose = scratch.shape_poses[first_shape_[proxy.body] + proxy.shape];
    if (is_ball_[i] != 0) {
      const double radius = local_bounds_[i].radius;
      const Vec3 half{radius, radius, radius};
      scratch.bounds[i] = {pose.translation - half, pose.translation + half};
    } else {
      scratch.bounds[i] = world_bounds(local_bounds_[i], pose);
    }
  }
}

void BroadPhase::find_candidates(BroadPhaseScratch &scratch) const {
  place_shapes(scratch);
  scratch.found.clear();
  scratch.near.visit_overlaps(
      identity_, scratch.bounds,
      [&](std::uint32_t i, std::uint32_t j) { return filter_.may_touch(bounded_[i].body, bounded_[j].body); },
      [&](std::uint32_t i, std::uint32_t j) { emit(bounded_[i], bounded_[j], scratch.found); });
  for (const Proxy &halfspace : halfspaces_) {
    const Pose &plane = scratch.shape_poses[first_shape_[halfspace.body] + halfspace.shape];
    const Vec3 normal = plane.rotation.column(2);
    for (std::size_t i = 0; i < bounded_.size(); ++i) {
      const Pose &pose = scratch.shape_poses[first_shape_[bounded_[i].body] + bounded_[i].shape];
      const bool is_near = is_ball_[i] != 0
                               ? dot(normal, pose.translation - plane.translation) <= local_bounds_[i].radius
                               : dot(normal, pose(local_bounds_[i].center) - plane.translation) <=
                                     half_extent(local_bounds_[i], transposed_times(pose.rotation, normal));
      if (is_near) {
        emit(halfspace, bounded_[i], scratch.found);
      }
    }
  }
  sort_candidates(scratch);
}

// By counting, then within the short rows of one body.
void BroadPhase::sort_candidates(BroadPhaseScratch &scratch) const {
  std::vector<std::size_t> &row_end = scratch.row_end;
  row_end.assign(body_count() + 1, 0);
  for (const Candidate &c : scratch.found) ++row_end[c.body_a + 1];
  for (std::size_t body = 0; body < body_count(); ++body) row_end[body + 1] += row_end[body];
  scratch.candidates.resize(scratch.found.size());
  for (const Candidate &c : scratch.found) scratch.candidates[row_end[c.body_a]++] = c;
  std::size_t begin = 0;
  for (std::size_t body = 0; body < body_count(); ++body) {
    const auto row = scratch.candidates.begin();
    std::sort(row + static_cast<std::ptrdiff_t>(begin), row + static_cast<std::ptrdiff_t>(row_end[body]),
              [](const Candidate &a, const Candidate &b) {
                return std::tie(a.body_b, a.shape_a, a.shape_b) < std::tie(b.body_b, b.shape_a, b.shape_b);
              });
    begin = row_end[body];
  }
}

}  // namespace cmb
