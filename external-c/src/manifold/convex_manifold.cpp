#include "manifold/convex_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis_share.hpp"

namespace cmb {

namespace {

// Sine of the inclination at which a disc no longer touches with its face.
constexpr double flat_sine = 0.25;

// How far a shape rests on a face in the direction `towards` (unit, in its frame): 1 for a polytope, whose corners know
// themselves; for a cylinder or cone 1 with its flat end on the contact plane, fading to 0 where that is inclined by
// more than a sixth of a right angle; 0 for all others.
double flat_part(const Shape &shape, const Vec3 &towards) {
  if (shape.polytope) return 1.0;
  if (!shape.rim || (shape.kind == ShapeKind::cone && towards.z > 0.0)) return 0.0;
  return faded(std::hypot(towards.x, towards.y) / flat_sine);
}

bool touches_at_a_point(const Shape &shape) {
  return shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::ellipsoid;
}

const ContactPolytope &corners_of(const Shape &shape) { return shape.polytope ? *shape.polytope : *shape.rim; }

// The part of points[begin..] that counts, where the shapes are `depth` deep in each other: what is inscribed in them,
// and hardly in each other at a rim, does not stand for them.
double agreement(const std::vector<ContactPoint> &points, std::size_t begin, double depth) {
  constexpr double none = 0.5, full = 0.9;
  double deepest = 0.0;
  for (std::size_t k = begin; k < points.size(); ++k) deepest = std::max(deepest, points[k].depth);
  return faded(std::max(0.0, (full - deepest / depth) / (full - none)));
}

// Scales the weights of points[begin, end).
void scale_weights(double part, std::size_t begin, std::size_t end, std::vector<ContactPoint> &points) {
  for (std::size_t k = begin; k < end; ++k) points[k].weight *= part;
}

}  // namespace

void convex_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const ConvexAnswer &answer,
                    ManifoldScratch &scratch, ContactSet &result) {
  result.distance = answer.distance;
  result.normal = answer.normal;
  result.witness = 0.5 * (answer.point_a + answer.point_b);
  if (!(answer.distance < 0.0)) return;
  std::vector<ContactPoint> &points = result.points;
  const std::size_t begin = points.size();
  const double depth = -answer.distance;
  if (touches_at_a_point(a) && touches_at_a_point(b)) {
    points.push_back({depth, 1.0, answer.normal, result.witness});
    return;
  }
  const Vec3 towards_b = -transposed_times(pose_a.rotation, answer.normal);
  const Vec3 towards_a = transposed_times(pose_b.rotation, answer.normal);
  // The parts that the contact has as one of faces, as one along a line of A or of B, and at a point.
  double flat = flat_part(a, towards_b) * flat_part(b, towards_a);
  if (flat > 0.0) {
    polytope_contact(corners_of(a), pose_a, corners_of(b), pose_b, answer.mean_normal, result.witness, scratch.polytope,
                     points);
    if (a.rim || b.rim) flat *= agreement(points, begin, depth);
  }
  const std::size_t flat_end = points.size();
  double line_a = flat < 1.0 ? line_part(a, towards_b) : 0.0, line_b = flat < 1.0 ? line_part(b, towards_a) : 0.0;
  if (line_a > 0.0) {
    line_contact(a, pose_a, b, pose_b, answer.point_a, answer.normal, 1.0, scratch.axis, points);
    if (a.rim) line_a *= agreement(points, flat_end, depth);
  }
  const std::size_t line_end = points.size();
  if (line_b > 0.0) {
    line_contact(b, pose_b, a, pose_a, answer.point_b, -answer.normal, -1.0, scratch.axis, points);
    if (b.rim) line_b *= agreement(points, line_end, depth);
  }
  const double line = (1.0 - flat) * (1.0 - (1.0 - line_a) * (1.0 - line_b));
  const double each = line > 0.0 ? line / (line_a + line_b) : 0.0;
  scale_weights(flat, begin, flat_end, points);
  scale_weights(each * line_a, flat_end, line_end, points);
  scale_weights(each * line_b, line_end, points.size(), points);
  const double rest = 1.0 - flat - line;
  if (rest > 1e-12) points.push_back({depth, rest, answer.normal, result.witness});
  points.erase(std::remove_if(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end(),
                              [](const ContactPoint &p) { return !(p.weight > 0.0); }),
               points.end());
  // Where the shapes hardly overlap, or one swallows the other, no corners may be left.
  if (points.size() == begin) points.push_back({depth, 1.0, answer.normal, result.witness});
}

}  // namespace cmb
