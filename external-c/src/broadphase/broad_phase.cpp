#include "broadphase/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "math/pose_algebra.hpp"
#include "query/pair_query.hpp"

namespace cmb {

namespace {

// Whether bounds reach into a half-space; those of a ball about its origin have a radius alone.
bool reaches(const LocalBounds &bounds, double ball_radius, const Pose &pose, const Pose &plane) {
  const Vec3 normal = plane.rotation.column(2);
  if (ball_radius > 0.0) return dot(normal, pose.translation - plane.translation) <= ball_radius;
  return dot(normal, pose(bounds.center) - plane.translation) <=
         half_extent(bounds, transposed_times(pose.rotation, normal));
}

}  // namespace

BroadPhase::BroadPhase(std::shared_ptr<const Scene> given, CollisionFilter filter)
    : scene_(std::move(given)), identity_(std::make_shared<char>()), filter_(std::move(filter)) {
  const Scene &scene = *scene_;
  std::size_t shapes = 0;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    first_shape_.push_back(shapes);
    shapes += scene.bodies[body].size();
    for (std::size_t shape = 0; shape < scene.bodies[body].size(); ++shape) {
      shapes_.push_back(&scene.bodies[body][shape]);
      ball_radius_.push_back(0.0);
      is_where_body_is_.push_back(scene.bodies[body][shape].is_moved ? 0 : 1);
      const Proxy proxy{static_cast<std::uint32_t>(body), static_cast<std::uint32_t>(shape)};
      if (scene.bodies[body][shape].kind == ShapeKind::halfspace) {
        halfspaces_.push_back(proxy);
      } else {
        bounded_.push_back(proxy);
        const LocalBounds &bounds = scene.bodies[body][shape].bounds;
        local_bounds_.push_back(bounds);
        if (norm2(bounds.half) == 0.0 && norm2(bounds.center) == 0.0) ball_radius_.back() = bounds.radius;
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

void BroadPhase::place_shapes_of(std::size_t body, BroadPhaseScratch &scratch) const {
  const Pose &pose = scratch.body_poses[body];
  std::size_t k = first_shape_[body];
  for (const Shape &shape : scene_->bodies[body]) {
    scratch.shape_poses[k] = is_where_body_is_[k] != 0 ? pose : compose(pose, shape.in_body);
    ++k;
  }
}

void BroadPhase::place_shapes(BroadPhaseScratch &scratch) const {
  scratch.shape_poses.resize(first_shape_.back());
  for (std::size_t body = 0; body < body_count(); ++body) place_shapes_of(body, scratch);
  scratch.bounds.resize(bounded_.size());
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    const Proxy &proxy = bounded_[i];
    const std::size_t shape = first_shape_[proxy.body] + proxy.shape;
    const Pose &pose = scratch.shape_poses[shape];
    if (const double radius = ball_radius_[shape]; radius > 0.0) {
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
    for (std::size_t i = 0; i < bounded_.size(); ++i) {
      const std::size_t shape = first_shape_[bounded_[i].body] + bounded_[i].shape;
      if (reaches(local_bounds_[i], ball_radius_[shape], scratch.shape_poses[shape], plane)) {
        emit(halfspace, bounded_[i], scratch.found);
      }
    }
  }
  sort_candidates(scratch);
}

// All pairs of shapes of two bodies.
void BroadPhase::find_candidates_of(std::uint32_t a, std::uint32_t b, BroadPhaseScratch &scratch) const {
  for (std::size_t i = first_shape_[a]; i < first_shape_[a + 1]; ++i) {
    for (std::size_t j = first_shape_[b]; j < first_shape_[b + 1]; ++j) {
      if (are_near(i, j, scratch)) {
        scratch.candidates.push_back({a, b, static_cast<std::uint32_t>(i - first_shape_[a]),
                                      static_cast<std::uint32_t>(j - first_shape_[b])});
      }
    }
  }
}

// Whether shapes that have been placed may touch.
bool BroadPhase::are_near(std::size_t i, std::size_t j, const BroadPhaseScratch &scratch) const {
  const Pose &pose_i = scratch.shape_poses[i], &pose_j = scratch.shape_poses[j];
  if (ball_radius_[i] > 0.0 && ball_radius_[j] > 0.0) {
    const double both = ball_radius_[i] + ball_radius_[j];
    return norm2(pose_i.translation - pose_j.translation) <= both * both;
  }
  const Shape &one = *shapes_[i], &other = *shapes_[j];
  const bool is_plane = one.kind == ShapeKind::halfspace;
  if (!is_plane && other.kind != ShapeKind::halfspace) {
    return overlap(world_bounds(one.bounds, pose_i), world_bounds(other.bounds, pose_j));
  }
  const std::size_t k = is_plane ? j : i;  // the other one
  if (shapes_[k]->kind == ShapeKind::halfspace) return false;
  return reaches(shapes_[k]->bounds, ball_radius_[k], is_plane ? pose_j : pose_i, is_plane ? pose_i : pose_j);
}

void BroadPhase::find_candidates_among(const std::vector<std::uint32_t> &bodies, BroadPhaseScratch &scratch) const {
  constexpr std::size_t few = 12;  // bodies, all pairs of which are looked at
  scratch.shape_poses.resize(first_shape_.back());
  for (const std::uint32_t body : bodies) place_shapes_of(body, scratch);
  scratch.candidates.clear();
  if (bodies.size() > few) {
    sweep_among(bodies, scratch);
    return;
  }
  for (std::size_t p = 0; p < bodies.size(); ++p) {
    for (std::size_t q = p + 1; q < bodies.size(); ++q) {
      if (filter_.may_touch(bodies[p], bodies[q])) find_candidates_of(bodies[p], bodies[q], scratch);
    }
  }
}

// Looks at shapes whose bounds overlap along the first axis.
void BroadPhase::sweep_among(const std::vector<std::uint32_t> &bodies, BroadPhaseScratch &scratch) const {
  std::vector<Extent> &extents = scratch.extents;
  extents.clear();
  for (const std::uint32_t body : bodies) {
    for (std::size_t k = first_shape_[body]; k < first_shape_[body + 1]; ++k) {
      const auto shape = static_cast<std::uint32_t>(k - first_shape_[body]);
      if (shapes_[k]->kind == ShapeKind::halfspace) {
        extents.push_back({-HUGE_VAL, HUGE_VAL, body, shape});
        continue;
      }
      const Bounds bounds = world_bounds(shapes_[k]->bounds, scratch.shape_poses[k]);
      extents.push_back({bounds.low.x, bounds.high.x, body, shape});
    }
  }
  std::sort(extents.begin(), extents.end(), [](const Extent &a, const Extent &b) {
    return std::tie(a.low, a.body, a.shape) < std::tie(b.low, b.body, b.shape);
  });
  for (std::size_t p = 0; p < extents.size(); ++p) {
    for (std::size_t q = p + 1; q < extents.size() && extents[q].low <= extents[p].high; ++q) {
      const Extent &one = extents[p].body < extents[q].body ? extents[p] : extents[q];
      const Extent &other = extents[p].body < extents[q].body ? extents[q] : extents[p];
      if (one.body == other.body || !filter_.may_touch(one.body, other.body)) continue;
      if (!are_near(first_shape_[one.body] + one.shape, first_shape_[other.body] + other.shape, scratch)) continue;
      scratch.candidates.push_back({one.body, other.body, one.shape, other.shape});
    }
  }
  std::sort(scratch.candidates.begin(), scratch.candidates.end(), [](const Candidate &a, const Candidate &b) {
    return std::tie(a.body_a, a.body_b, a.shape_a, a.shape_b) < std::tie(b.body_a, b.body_b, b.shape_a, b.shape_b);
  });
}

double BroadPhase::radius_about_origin(std::size_t body) const {
  double radius = 0.0;
  for (const Shape &shape : scene_->bodies[body]) {
    if (shape.kind == ShapeKind::halfspace) return HUGE_VAL;
    const LocalBounds &bounds = shape.bounds;
    radius = std::fmax(radius, norm(shape.in_body(bounds.center)) + norm(bounds.half) + bounds.radius);
  }
  return radius;
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
