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
// more than a sixth of a right angle; 0 for all others. `gradient` receives its derivative by `towards`.
double flat_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient) {
  gradient = {};
  if (shape.polytope) return 1.0;
  if (!shape.rim || (shape.kind == ShapeKind::cone && towards.z > 0.0)) return 0.0;
  const double across = std::hypot(towards.x, towards.y), inclination = across / flat_sine;
  if (across > 0.0) {
    gradient = (faded_slope(inclination) / (flat_sine * across)) * Vec3{towards.x, towards.y, 0.0};
  }
  return faded(inclination);
}

// A shape's ways of touching.
struct Ways {
  double flat, line;
  Vec3 flat_gradient, line_gradient;  // by the direction towards the other shape, in world axes
  Ways(const Shape &shape, const Pose &pose, const Vec3 &world_towards) {
    const Vec3 towards = transposed_times(pose.rotation, world_towards);
    flat = flat_part(shape, towards, flat_gradient);
    line = line_part(shape, towards, line_gradient);
    flat_gradient = pose.rotation * flat_gradient;
    line_gradient = pose.rotation * line_gradient;
  }
};

// What the points [begin, end) store at exponent 1.
double stored(const std::vector<ContactPoint> &points, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t k = begin; k < end; ++k) sum += 0.5 * points[k].weight * points[k].depth * points[k].depth;
  return sum;
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
  Vec3 shift;
  // The parts that the contact has as one of faces, as one along a line of A or of B, and at a point.
  const Ways of_a(a, pose_a, -answer.normal), of_b(b, pose_b, answer.normal);
  double agree = 1.0, agree_a = 1.0, agree_b = 1.0;
  if (of_a.flat * of_b.flat > 0.0) {
    polytope_contact(corners_of(a), pose_a, corners_of(b), pose_b, answer.mean_normal, result.witness, scratch.polytope,
                     points);
    if (a.rim || b.rim) agree = agreement(points, begin, depth);
  }
  const double flat = of_a.flat * of_b.flat * agree;
  const std::size_t flat_end = points.size();
  if (of_a.line > 0.0 && flat < 1.0) {
    line_contact(a, pose_a, b, pose_b, answer.point_a, answer.normal, 1.0, scratch.axis, points);
    if (a.rim) agree_a = agreement(points, flat_end, depth);
  }
  const std::size_t line_end = points.size();
  if (of_b.line > 0.0 && flat < 1.0) {
    line_contact(b, pose_b, a, pose_a, answer.point_b, -answer.normal, -1.0, scratch.axis, points);
    if (b.rim) agree_b = agreement(points, line_end, depth);
  }
  const double line_a = of_a.line * agree_a, line_b = of_b.line * agree_b;
  const double any_line = 1.0 - (1.0 - line_a) * (1.0 - line_b), line = (1.0 - flat) * any_line;
  const double rest = 1.0 - flat - line;
  const double share_a = line > 0.0 ? line_a / (line_a + line_b) : 0.0;
  if (a.rim || b.rim) {
    // Energy that changes with the direction alone asks for a torque, as on a half-space.
    const double of_flat = stored(points, begin, flat_end), of_point = 0.5 * depth * depth;
    const double of_line = share_a * stored(points, flat_end, line_end) +
                           (1.0 - share_a) * stored(points, line_end, points.size());
    // A shape's direction towards the other one turns with that where the other one has a face; else half of it.
    const auto missing = [&](const Ways &own, const Ways &other, double own_agree, double other_line, bool against_face) {
      const double by_flat = other.flat * agree * (of_flat - any_line * of_line - (1.0 - any_line) * of_point);
      const double by_line = (1.0 - flat) * (1.0 - other_line) * own_agree * (of_line - of_point);
      return (against_face ? 1.0 : 0.5) * (by_flat * own.flat_gradient + by_line * own.line_gradient);
    };
    shift = missing(of_a, of_b, agree_a, line_b, b.polytope != nullptr) +
            missing(of_b, of_a, agree_b, line_a, a.polytope != nullptr);
  }
  scale_weights(flat, begin, flat_end, points);
  scale_weights(line * share_a, flat_end, line_end, points);
  scale_weights(line * (1.0 - share_a), line_end, points.size(), points);
  if (rest > 1e-12) points.push_back({depth, rest, answer.normal, result.witness});
  points.erase(std::remove_if(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end(),
                              [](const ContactPoint &p) { return !(p.weight > 0.0); }),
               points.end());
  if (norm2(shift) > 0.0) {
    shift = (1.0 / total_load(points, begin)) * (shift - dot(shift, answer.normal) * answer.normal);
    for (std::size_t k = begin; k < points.size(); ++k) points[k].position = points[k].position + shift;
  }
  // Where the shapes hardly overlap, or one swallows the other, no corners may be left.
  if (points.size() == begin) points.push_back({depth, 1.0, answer.normal, result.witness});
}

}  // namespace cmb
