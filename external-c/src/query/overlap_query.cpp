#include "query/overlap_query.hpp"

#include <cmath>
#include <optional>

#include "backend/distance_backend.hpp"
#include "convex/convex_overlap.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb {

namespace {

constexpr double pi = 3.14159265358979323846;

// The overlap of two shapes, in world axes.
struct ShapeOverlap {
  double volume = 0.0, patch_area = 0.0;
  Vec3 centroid, patch_centroid;
  Mat3 patch_moment = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};

Mat3 outer_product(double factor, const Vec3 &v) {
  return {{(factor * v.x) * v, (factor * v.y) * v, (factor * v.z) * v}};
}

Mat3 sum(const Mat3 &a, const Mat3 &b) { return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}}; }

// A symmetric tensor in the axes of a body, in world axes.
Mat3 turned(const Mat3 &axes, const Mat3 &tensor) {
  const Mat3 half{{axes * tensor.row[0], axes * tensor.row[1], axes * tensor.row[2]}};
  const Mat3 columns = transposed(half);
  return {{axes * columns.row[0], axes * columns.row[1], axes * columns.row[2]}};
}

ShapeOverlap polytopes(const convex::Polytope &a, const Pose &pose_a, const convex::Polytope &b, const Pose &pose_b,
                       const Vec3 &normal) {
  convex::OverlapScratch scratch;
  const convex::Overlap overlap = convex::convex_overlap(
      a, b, relative_pose(pose_a, pose_b), transposed_times(pose_a.rotation, normal), scratch);
  return {overlap.volume, overlap.patch_area, pose_a(overlap.centroid), pose_a(overlap.patch_centroid),
          turned(pose_a.rotation, overlap.patch_moment)};
}

// A half-space, cut down to a box that holds all of the other shape below the plane.
ShapeOverlap polytope_and_halfspace(const Shape &shape, const Pose &pose, const Pose &plane) {
  const double side = 4.0 * shape.bound_radius;
  const Vec3 normal = plane.rotation.column(2), center = pose(shape.bound_center);
  const double height = dot(normal, center - plane.translation);
  if (height >= shape.bound_radius) return {};
  // Deep below the plane all of the shape is inside anyway: the box follows it.
  const double top = std::fmin(0.0, height + shape.bound_radius) - std::fmin(0.0, height - shape.bound_radius);
  const double upper = std::fmin(0.0, height + shape.bound_radius);
  const convex::Polytope box = convex::Polytope::box({side, side, side + top});
  const Pose box_pose{plane.rotation, center + (upper - height - 0.5 * (side + top)) * normal};
  return polytopes(shape.polytope->geometry(), pose, box, box_pose, normal);
}

// The cap of a sphere whose centre lies on or above the plane.
ShapeOverlap sphere_and_halfspace(double radius, const Vec3 &center, const Pose &plane) {
  const Vec3 normal = plane.rotation.column(2);
  const double height = dot(normal, center - plane.translation), depth = radius - height;
  if (depth <= 0.0) return {};
  ShapeOverlap cap;
  cap.volume = pi * depth * depth * (3.0 * radius - depth) / 3.0;
  cap.patch_area = pi * depth * (2.0 * radius - depth);
  const double off = 2.0 * radius - depth;
  cap.centroid = center - (0.75 * off * off / (3.0 * radius - depth)) * normal;
  // Half way between the plane and the mean of the sphere's surface below it.
  cap.patch_centroid = center - (height + 0.5 * cap.volume / cap.patch_area) * normal;
  const double moment = cap.patch_area * cap.patch_area / (4.0 * pi);  // of a disc about a diameter
  cap.patch_moment = sum({{{moment, 0, 0}, {0, moment, 0}, {0, 0, moment}}}, outer_product(-moment, normal));
  return cap;
}

// Nothing where the overlap of these shapes is not known in closed form.
std::optional<ShapeOverlap> shapes(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  if (a.kind == ShapeKind::halfspace) {
    if (b.kind == ShapeKind::halfspace) return ShapeOverlap{};
    return shapes(b, pose_b, a, pose_a);
  }
  if (b.kind == ShapeKind::halfspace) {
    if (a.polytope) return polytope_and_halfspace(a, pose_a, pose_b);
    if (a.kind == ShapeKind::sphere && dot(pose_b.rotation.column(2), pose_a.translation - pose_b.translation) >= 0.0) {
      return sphere_and_halfspace(a.body.radius, pose_a.translation, pose_b);
    }
    return std::nullopt;
  }
  if (a.mesh || b.mesh) return std::nullopt;
  BackendScratch scratch;
  const ConvexAnswer answer = *exact_distance(a, pose_a, b, pose_b, scratch);
  if (answer.distance >= 0.0) return ShapeOverlap{};
  if (!a.polytope || !b.polytope) return std::nullopt;
  return polytopes(a.polytope->geometry(), pose_a, b.polytope->geometry(), pose_b, answer.normal);
}

void write(const Vec3 &v, double *target) {
  for (int i = 0; i < 3; ++i) target[i] = v[i];
}

}  // namespace

cmb_overlap query_overlap(const BodyShapes &a, const Pose &pose_a, const BodyShapes &b, const Pose &pose_b) {
  cmb_overlap result = {};
  Vec3 centroid, patch_centroid;
  Mat3 moment = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  for (const Shape &shape_a : a) {
    for (const Shape &shape_b : b) {
      const auto part = shapes(shape_a, compose(pose_a, shape_a.in_body), shape_b, compose(pose_b, shape_b.in_body));
      if (!part) return {};
      result.volume += part->volume;
      result.patch_area += part->patch_area;
      centroid = centroid + part->volume * part->centroid;
      const Vec3 so_far = result.patch_area > part->patch_area
                              ? (1.0 / (result.patch_area - part->patch_area)) * patch_centroid
                              : part->patch_centroid;
      const double both = (result.patch_area - part->patch_area) * part->patch_area;
      if (both > 0.0) moment = sum(moment, outer_product(both / result.patch_area, part->patch_centroid - so_far));
      moment = sum(moment, part->patch_moment);
      patch_centroid = patch_centroid + part->patch_area * part->patch_centroid;
    }
  }
  result.known = 1;
  if (result.volume > 0.0) write((1.0 / result.volume) * centroid, result.centroid);
  if (result.patch_area > 0.0) write((1.0 / result.patch_area) * patch_centroid, result.patch_centroid);
  for (int i = 0; i < 3; ++i) write(moment.row[i], result.patch_moment + 3 * i);
  return result;
}

}  // namespace cmb
