#include "manifold/curved_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis/capsule_manifold.hpp"
#include "manifold/axis/capsule_on_revolved.hpp"
#include "manifold/disc_manifold.hpp"
#include "manifold/rod_end_share.hpp"
#include "math/pose_algebra.hpp"
#include "narrowphase/multicontact/contact_directions.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

// How far a shape rests on a face in the direction `towards` (unit, in its frame): 1 for a polytope, whose corners know
// themselves; for a cylinder or cone 1 with its flat end on the contact plane, fading to 0 where that is inclined by
// more than way_sine tells; 0 for all others. `gradient` receives its derivative by `towards`.
double flat_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient) {
  gradient = {};
  if (shape.polytope) return 1.0;
  if (!is_revolved(shape) || (shape.kind == ShapeKind::cone && towards.z > 0.0)) return 0.0;
  const double limit = way_sine(shape);
  const double across = std::sqrt(towards.x * towards.x + towards.y * towards.y), inclination = across / limit;
  if (across > 0.0) {
    gradient = (falling_smoothstep_slope(inclination) / (limit * across)) * Vec3{towards.x, towards.y, 0.0};
  }
  return falling_smoothstep(inclination);
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

// The part that counts of a contact `found` deep, where the shapes are `depth` deep in each other: what stands for them, and
// is hardly in each other, does not.
double agreement(double found, double depth) {
  constexpr double none = 0.5, full = 0.9;
  return falling_smoothstep(std::max(0.0, (full - found / depth) / (full - none)));
}

// Scales the weights of points[begin, end).
void scale_weights(double part, std::size_t begin, std::size_t end, std::vector<ContactPoint> &points) {
  for (std::size_t k = begin; k < end; ++k) points[k].weight *= part;
}

// The answer in A's frame.
SignedDistance in_frame_of_a(const SignedDistance &answer, const Pose &pose_a) {
  convex::SignedDistance result;
  result.distance = answer.distance;
  result.normal = transposed_times(pose_a.rotation, answer.normal);
  result.point_a = transposed_times(pose_a.rotation, answer.point_a - pose_a.translation);
  result.point_b = transposed_times(pose_a.rotation, answer.point_b - pose_a.translation);
  result.interior_ball = answer.interior_ball;
  return result;
}

// What the line of one shape carries on the flat end, or the faces, of the other.
void line_on_faces(const Shape &shape, const Pose &pose, const Shape &other, const Pose &other_pose, const Vec3 &deepest,
                   double depth, const Vec3 &normal, double sense, LineManifoldScratch &scratch,
                   std::vector<ContactPoint> &points) {
  const ContactLine line(shape, pose, -normal);
  if (other.polytope) {
    line_on_polytope(line, other.polytope->geometry(), other_pose, deepest, depth, normal, sense, scratch, points);
  } else {
    const Disc disc(other, other_pose, normal);
    line_on_disc(line, disc.center, disc.axis, disc.radius, deepest, normal, sense, scratch, points);
  }
}

// What flat ends carry on each other; returns the part of it that counts.
double flat_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, double depth, const Vec3 &normal,
                    std::vector<ContactPoint> &points) {
  return agreement(disc_on_disc(Disc(a, pose_a, -normal), Disc(b, pose_b, normal), normal, 1.0, points), depth);
}

// What the lines of two shapes carry on each other: half of it each.
void line_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                  LineManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  const std::size_t begin = points.size();
  const ContactLine line_a(a, pose_a, -answer.normal), line_b(b, pose_b, answer.normal);
  line_on_line(line_a, line_b, answer.point_a, answer.normal, 1.0, scratch, points);
  line_on_line(line_b, line_a, answer.point_b, -answer.normal, -1.0, scratch, points);
  scale_weights(0.5, begin, points.size(), points);
}

// Appends the contact along one contact direction: each shape touches with a flat end or its faces, on a line, or at a
// point, in parts.
void contact_along(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                   CurvedManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  const std::size_t begin = points.size();
  const double depth = -answer.distance;
  const Vec3 witness = 0.5 * (answer.point_a + answer.point_b), &normal = answer.normal;
  if (touches_at_a_point(a) || touches_at_a_point(b)) {
    points.push_back({depth, 1.0, normal, witness});
    return;
  }
  if (pair_entry(a, b).method == PairMethod::capsule_capsule) {
    if (!capsule_on_capsule(a, pose_a, b, pose_b, answer, points)) line_contact(a, pose_a, b, pose_b, answer, scratch.axis, points);
    if (points.size() == begin) points.push_back({depth, 1.0, normal, witness});
    return;
  }
  const Ways of_a(a, pose_a, -normal), of_b(b, pose_b, normal);
  // Each of the ways of touching: its part, and what it stores where it is all.
  const double of_point = 0.5 * depth * depth;
  const double flats = of_a.flat * of_b.flat;
  double rest = 1.0;  // the part of a point at the deepest place
  double more_flats = 0.0, more_a_on_b = 0.0, more_b_on_a = 0.0, more_lines = 0.0;
  const auto close = [&](double part, std::size_t first) {
    const double more = stored(points, first, points.size()) - of_point;
    scale_weights(part, first, points.size(), points);
    rest -= part;
    return more;
  };
  if (flats > 0.0) {
    const double agree = flat_contact(a, pose_a, b, pose_b, depth, normal, points);
    more_flats = agree * close(flats * agree, begin);
  }
  if (of_a.line * of_b.flat > 0.0) {
    const std::size_t first = points.size();
    line_on_faces(a, pose_a, b, pose_b, answer.point_a, depth, normal, 1.0, scratch.axis, points);
    more_a_on_b = close(of_a.line * of_b.flat, first);
  }
  if (of_b.line * of_a.flat > 0.0) {
    const std::size_t first = points.size();
    line_on_faces(b, pose_b, a, pose_a, answer.point_b, depth, -normal, -1.0, scratch.axis, points);
    more_b_on_a = close(of_b.line * of_a.flat, first);
  }
  if (of_a.line * of_b.line > 0.0) {
    const std::size_t first = points.size();
    line_contact(a, pose_a, b, pose_b, answer, scratch.axis, points);
    more_lines = close(of_a.line * of_b.line, first);
  }
  if (rest > 1e-12) points.push_back({depth, rest, normal, witness});
  points.erase(std::remove_if(points.begin() + static_cast<std::ptrdiff_t>(begin), points.end(),
                              [](const ContactPoint &p) { return !(p.weight > 0.0); }),
               points.end());
  if (points.size() == begin) {
    points.push_back({depth, 1.0, normal, witness});
    return;
  }
  if (!is_revolved(a) && !is_revolved(b)) return;
  // Energy that changes with the direction alone asks for a torque, as on a half-space. A shape's direction towards the other one turns
  // by half of what either turns.
  const Vec3 of_direction_a = (of_b.flat * more_flats + of_b.line * more_b_on_a) * of_a.flat_gradient +
                              (of_b.flat * more_a_on_b + of_b.line * more_lines) * of_a.line_gradient;
  const Vec3 of_direction_b = (of_a.flat * more_flats + of_a.line * more_a_on_b) * of_b.flat_gradient +
                              (of_a.flat * more_b_on_a + of_a.line * more_lines) * of_b.line_gradient;
  const Vec3 missing = 0.5 * (of_direction_a + of_direction_b);
  const Vec3 shift = (1.0 / total_load(points, begin)) * (missing - dot(missing, normal) * normal);
  for (std::size_t k = begin; k < points.size(); ++k) points[k].position = points[k].position + shift;
}

// The shortest way's part beside the ways that a ball of radius `reach` rests on, for bodies rounded by `rounding` and `depth`
// deep in each other. Until they are as deep as the rounding the shortest way is continuous. A ball no greater than the
// rounding touches there alone, one a little greater all at once on every face about an edge or corner; between these
// two the shortest way hands over.
double shortest_part(double reach, double rounding, double depth) {
  return depth < rounding ? falling_smoothstep(std::max(0.0, (reach - rounding) / (reach - depth))) : 0.0;
}

// Appends the sum of the contacts along all contact directions.
void contact_along_all(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                       convex::DistanceScratch &distance, CurvedManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  const double size = a.bound_radius + b.bound_radius, depth = -answer.distance;
  // No other way is near; the reach is no more than 1.5 depths, which takes no root.
  if (answer.interior_ball >= 1.5 * depth || answer.interior_ball >= convex::inner_parallel_radius(depth, size)) {
    contact_along(a, pose_a, b, pose_b, answer, scratch, points);
    return;
  }
  const convex::SignedDistance nearest = in_frame_of_a(answer, pose_a);
  const convex::ContactDirections directions = convex::contact_directions(a.body, b.body, relative_pose(pose_a, pose_b),
                                                                          nearest, size, distance);
  const std::size_t first = points.size();
  double rest = 1.0, scale = 1.0;  // the shares' part, and what makes the sum of share * normal a unit vector again
  const double shortest =
      directions.count > 1 ? shortest_part(convex::inner_parallel_radius(depth, size), a.body.radius + b.body.radius, depth) : 0.0;
  if (shortest > 0.0) {
    rest -= shortest;
    Vec3 sum = shortest * nearest.normal;
    for (int k = 0; k < directions.count; ++k) sum = sum + (rest * directions.contact[k].share) * directions.contact[k].normal;
    scale = 1.0 / norm(sum);
    contact_along(a, pose_a, b, pose_b, answer, scratch, points);
    scale_weights(shortest * scale, first, points.size(), points);
  }
  for (int k = 0; k < directions.count; ++k) {
    const convex::ContactDirection &way = directions.contact[k];
    if (!(way.depth > 0.0)) continue;  // within rounding of touching
    SignedDistance along = answer;
    along.distance = -way.depth;
    along.normal = pose_a.rotation * way.normal;
    along.point_a = pose_a(way.point_a);
    const Vec3 aside = pose_a.rotation * way.aside;
    along.point_b = along.point_a + way.depth * along.normal;
    const std::size_t begin = points.size();
    contact_along(a, pose_a, b, {pose_b.rotation, pose_b.translation + aside}, along, scratch, points);
    scale_weights(way.share * rest * scale, begin, points.size(), points);
    for (std::size_t i = begin; i < points.size(); ++i) points[i].position = points[i].position - 0.5 * aside;
  }
  if (points.size() == first) contact_along(a, pose_a, b, pose_b, answer, scratch, points);
}

// What the energy of a capsule's axis carries on a box, hull, cylinder or cone; returns its part of the contact.
double elastic_part(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                    CapsuleScratch &scratch, std::vector<ContactPoint> &points) {
  const double depth = -answer.distance;
  if (a.kind == ShapeKind::capsule && b.polytope) {
    return capsule_on_polytope(a, pose_a, b, pose_b, depth, answer.point_a, answer.normal, 1.0, scratch, points);
  }
  if (b.kind == ShapeKind::capsule && a.polytope) {
    return capsule_on_polytope(b, pose_b, a, pose_a, depth, answer.point_b, -answer.normal, -1.0, scratch, points);
  }
  if (a.kind == ShapeKind::capsule && is_revolved(b)) {
    return capsule_on_revolved(a, pose_a, b, pose_b, depth, answer.point_a, 1.0, points);
  }
  if (b.kind == ShapeKind::capsule && is_revolved(a)) {
    return capsule_on_revolved(b, pose_b, a, pose_a, depth, answer.point_b, -1.0, points);
  }
  return 0.0;
}

}  // namespace

void curved_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                    convex::DistanceScratch &distance, CurvedManifoldScratch &scratch,
                    std::vector<ContactPoint> &points) {
  const double elastic = elastic_part(a, pose_a, b, pose_b, answer, scratch.capsule, points);
  if (elastic == 1.0) return;
  const std::size_t begin = points.size();
  contact_along_all(a, pose_a, b, pose_b, answer, distance, scratch, points);
  scale_weights(1.0 - elastic, begin, points.size(), points);
}

}  // namespace cmb
