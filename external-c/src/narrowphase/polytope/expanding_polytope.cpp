#include "narrowphase/polytope/expanding_polytope.hpp"

#include <algorithm>
#include <functional>

namespace cmb::convex {

namespace {

constexpr double relative_thickness = 1e-12;  // triangles thinner than this (times scale) are slivers

double smallest_height(const DifferencePoint *t) {
  double largest_face = 0.0;
  for (int f = 0; f < 4; ++f) {
    const Vec3 &a = t[f].w, &b = t[(f + 1) % 4].w, &c = t[(f + 2) % 4].w;
    largest_face = std::max(largest_face, norm(cross(b - a, c - a)));
  }
  const double volume = std::fabs(dot(cross(t[1].w - t[0].w, t[2].w - t[0].w), t[3].w - t[0].w));
  return largest_face > 0.0 ? volume / largest_face : 0.0;
}

}  // namespace

ExpandingPolytope::ExpandingPolytope(std::size_t max_points) : hull_(max_points, 12 * max_points) {
  points_.reserve(max_points);
  queue_.reserve(12 * max_points);
}

bool ExpandingPolytope::start_from(const DifferencePoint *t, double thickness) {
  if (!hull_.start(t[0].w, t[1].w, t[2].w, t[3].w, thickness)) return false;
  points_.clear();
  const bool exchanged = norm2(hull_.point(1) - t[1].w) != 0.0;
  points_.push_back(t[0]);
  points_.push_back(exchanged ? t[2] : t[1]);
  points_.push_back(exchanged ? t[1] : t[2]);
  points_.push_back(t[3]);
  return true;
}

bool ExpandingPolytope::start(const MinkowskiDifference &difference, const DifferencePoint *simplex, int count) {
  const double scale = difference.scale;
  if (count == 4 && smallest_height(simplex) > 1e-6 * scale && start_from(simplex, relative_thickness * scale)) {
    return true;
  }
  // Farthest points: along an axis, from that line, from that plane.
  DifferencePoint t[4];
  double best = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 d;
    d.set(axis, 1.0);
    const DifferencePoint high = difference.support(d), low = difference.support(-d);
    if (norm2(high.w - low.w) > best) best = norm2(high.w - low.w), t[0] = low, t[1] = high;
  }
  const Vec3 along = normalized(t[1].w - t[0].w);
  const Vec3 u = any_perpendicular(along), v = cross(along, u);
  best = -1.0;
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.78539816339744831 * k;
    const DifferencePoint p = difference.support(std::cos(angle) * u + std::sin(angle) * v);
    const double away = norm2(cross(along, p.w - t[0].w));
    if (away > best) best = away, t[2] = p;
  }
  const Vec3 across = normalized(cross(along, t[2].w - t[0].w), u);
  const DifferencePoint above = difference.support(across), below = difference.support(-across);
  t[3] = dot(across, above.w - t[0].w) > dot(across, t[0].w - below.w) ? above : below;
  return start_from(t, relative_thickness * scale);
}

// Convex combination of the corners of the face through which the line along the direction leaves the
// surface: its point of A - B is depth * direction to the tolerance of the depth.
void ExpandingPolytope::witness(PenetrationResult &result) const {
  const Vec3 &m = result.direction;
  double best_inside = -INFINITY;
  double weight[3] = {1, 0, 0};
  const IncrementalHull::Face *best = nullptr;
  for (std::int32_t f = hull_.face_count(); f-- > 0;) {  // the latest faces are most likely the ones
    const IncrementalHull::Face &face = hull_.face(f);
    if (!face.alive || face.sliver || !(dot(face.normal, m) > 0.0)) continue;
    const Vec3 &a = hull_.point(face.vertex[0]), &b = hull_.point(face.vertex[1]), &c = hull_.point(face.vertex[2]);
    const double u = dot(m, cross(b, c)), v = dot(m, cross(c, a)), w = dot(m, cross(a, b));
    const double sum = u + v + w;
    if (!(sum > 0.0)) continue;
    const double inside = std::min(u, std::min(v, w)) / sum;
    if (inside <= best_inside) continue;
    best_inside = inside;
    best = &face;
    weight[0] = u / sum, weight[1] = v / sum, weight[2] = w / sum;
    if (inside >= 0.0) break;
  }
  if (best == nullptr) return;
  double sum = 0.0;
  for (double &x : weight) x = std::max(x, 0.0), sum += x;
  result.a = result.b = {};
  for (int k = 0; k < 3; ++k) {
    const DifferencePoint &p = points_[static_cast<std::size_t>(best->vertex[k])];
    result.a = result.a + (weight[k] / sum) * p.a;
    result.b = result.b + (weight[k] / sum) * p.b;
  }
}

PenetrationResult ExpandingPolytope::depth(const MinkowskiDifference &difference, const DifferencePoint *simplex,
                                           int count, double tolerance, std::int32_t most_points) {
  PenetrationResult result;
  result.depth = INFINITY;
  result.direction = {0, 0, 1};
  if (!start(difference, simplex, count)) {
    const DifferencePoint p = difference.support(result.direction);
    result.depth = dot(p.w, result.direction);
    result.a = p.a;
    result.b = p.b;
    return result;
  }
  search(difference, tolerance, most_points, result);
  return result;
}

PenetrationResult ExpandingPolytope::go_on(const MinkowskiDifference &difference, const PenetrationResult &before, double tolerance,
                                           std::int32_t most_points) {
  PenetrationResult result;
  result.depth = before.depth, result.direction = before.direction, result.a = before.a, result.b = before.b, result.steps = before.steps;
  search(difference, tolerance, most_points, result);
  return result;
}

// From the surface there is.
void ExpandingPolytope::search(const MinkowskiDifference &difference, double tolerance, std::int32_t most_points, PenetrationResult &result) {
  const double thickness = relative_thickness * difference.scale;
  const double visibility = 4e-16 * difference.scale;
  queue_.clear();
  // Faces farther than this have nothing to tell.
  double limit = result.depth - tolerance;
  const auto lower_depth = [&](double depth) {
    result.depth = depth;
    limit = depth - tolerance;
  };
  const auto enqueue = [&](std::int32_t begin) {
    for (std::int32_t f = begin; f < hull_.face_count(); ++f) {
      const IncrementalHull::Face &face = hull_.face(f);
      if (!face.alive || face.sliver || face.offset >= limit) continue;
      const double distance = hull_.distance(face);
      if (distance >= limit) continue;
      queue_.emplace_back(distance, f);
      std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    }
  };
  enqueue(0);
  result.proven = true;
  result.lower = INFINITY;
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const auto [distance, f] = queue_.back();
    queue_.pop_back();
    const IncrementalHull::Face &face = hull_.face(f);
    if (!face.alive) continue;
    if (distance >= limit) break;
    const bool decides = distance < result.depth - tolerance;
    ++result.steps;
    const Vec3 direction = face.normal;
    const double offset = face.offset;
    const DifferencePoint p = difference.support(direction);
    const double height = dot(p.w, direction);
    if (height < result.depth) {
      lower_depth(height);
      result.direction = direction;
      result.a = p.a;
      result.b = p.b;
    }
    if (height - offset <= tolerance) continue;
    const bool repeated =
        std::any_of(points_.begin(), points_.end(), [&](const DifferencePoint &q) { return same_vertices(p, q); });
    if (repeated) continue;  // the face is thin and its normal off by rounding: its neighbours decide
    const IncrementalHull::Outcome outcome = hull_.point_count() < most_points
                                               ? hull_.expand(f, p.w, visibility, thickness)
                                               : IncrementalHull::Outcome::full;
    if (outcome != IncrementalHull::Outcome::expanded) {
      if (decides) {
        result.proven = false;
        result.lower = std::min(result.lower, distance);
      }
      if (outcome == IncrementalHull::Outcome::full) break;
      continue;
    }
    points_.push_back(p);
    enqueue(hull_.first_new_face());
  }
  result.lower = std::min(result.lower, result.depth - tolerance);
  witness(result);
  if (!result.proven) other_directions(result);
}

namespace {

// The cosine up to which directions count as one, of those that may be nearer, and of those that may be as near.
constexpr double same_if_nearer = 0.97, same_if_as_near = 0.9999;

// Adds a direction that is well apart from those known.
void add_other(const Vec3 &normal, double same, PenetrationResult &result) {
  const auto near = [&](const Vec3 &d) { return dot(d, normal) > same; };
  if (near(result.direction) || std::any_of(result.other, result.other + result.other_count, near)) return;
  result.other[result.other_count++] = normal;
}

}  // namespace

void ExpandingPolytope::other_directions(PenetrationResult &result) {
  while (!queue_.empty() && result.other_count < PenetrationResult::most_others) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const IncrementalHull::Face &face = hull_.face(queue_.back().second);
    queue_.pop_back();
    if (face.alive && face.offset < result.depth) add_other(face.normal, same_if_nearer, result);
  }
}

void ExpandingPolytope::find_others(double depth, PenetrationResult &result) const {
  result.other_count = 0;
  for (std::int32_t f = 0; f < hull_.face_count() && result.other_count < PenetrationResult::most_others; ++f) {
    const IncrementalHull::Face &face = hull_.face(f);
    if (face.alive && !face.sliver && face.offset < depth && hull_.distance(face) < depth) {
      add_other(face.normal, same_if_as_near, result);
    }
  }
}

}  // namespace cmb::convex
