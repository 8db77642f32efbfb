#include "query/overlap_query.hpp"

#include <cmath>
#include <optional>

#include "backend/distance_backend.hpp"
#include "math/pi.hpp"
#include "math/pose_algebra.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "query/mesh_halfspace.hpp"
#include "query/mesh_query.hpp"
#include "shape/pair_table.hpp"
#include "volume/convex_overlap.hpp"
#include "volume/halfspace_overlap.hpp"
#include "volume/mesh_overlap.hpp"

namespace cmb {

namespace {

using overlap::ShapeOverlap;
using overlap::turned;

// Room to work in; one for each thread.
struct OverlapRoom {
  BackendScratch distance;
  convex::OverlapScratch flat;
  overlap::CurvedScratch curved;
  overlap::MeshOverlapScratch mesh;
  MeshQueryScratch mesh_contact;
  ContactSet contact;
};

OverlapRoom &room() {
  static thread_local OverlapRoom result;
  return result;
}

Mat3 outer_product(double factor, const Vec3 &v) {
  return {{(factor * v.x) * v, (factor * v.y) * v, (factor * v.z) * v}};
}

Mat3 sum(const Mat3 &a, const Mat3 &b) { return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}}; }

// From A's axes.
ShapeOverlap in_world(const convex::Overlap &overlap, const Pose &pose) {
  return {overlap.volume, overlap.patch_area, pose(overlap.centroid), pose(overlap.patch_centroid),
          turned(pose.rotation, overlap.patch_moment)};
}

ShapeOverlap polytopes(const convex::Polytope &a, const Pose &pose_a, const convex::Polytope &b, const Pose &pose_b,
                       const Vec3 &normal) {
  return in_world(convex::convex_overlap(a, b, relative_pose(pose_a, pose_b), transposed_times(pose_a.rotation, normal),
                                         room().flat),
                  pose_a);
}

ShapeOverlap polytope_and_halfspace(const convex::Polytope &polytope, const Pose &pose, const Pose &plane) {
  const Vec3 normal = plane.rotation.column(2);
  const double offset = dot(normal, plane.translation - pose.translation);
  return in_world(convex::convex_overlap(polytope, transposed_times(pose.rotation, normal), offset, room().flat), pose);
}

// The part of a sphere within `depth` of a plane that cuts it, depth being measured from the sphere's farthest point.
struct Cap {
  double volume = 0.0, from_center = 0.0;  // of its centroid, towards the farthest point
  Cap(double radius, double depth) {
    volume = pi * depth * depth * (3.0 * radius - depth) / 3.0;
    const double off = 2.0 * radius - depth;
    from_center = 0.75 * off * off / (3.0 * radius - depth);
  }
};

// The second moments of a disc of the given area about its middle.
Mat3 disc_moment(double area, const Vec3 &normal) {
  const double moment = area * area / (4.0 * pi);  // about a diameter
  return sum({{{moment, 0, 0}, {0, moment, 0}, {0, 0, moment}}}, outer_product(-moment, normal));
}

ShapeOverlap whole_sphere(double radius, const Vec3 &center, const Vec3 &normal) {
  const double shadow = pi * radius * radius;
  return {4.0 / 3.0 * radius * shadow, shadow, center, center, disc_moment(shadow, normal)};
}

ShapeOverlap sphere_and_halfspace(double radius, const Vec3 &center, const Pose &plane) {
  const Vec3 normal = plane.rotation.column(2);
  const double height = dot(normal, center - plane.translation), depth = radius - height;
  if (depth <= 0.0) return {};
  if (depth >= 2.0 * radius) return whole_sphere(radius, center, normal);
  const Cap cap(radius, depth);
  ShapeOverlap overlap;
  overlap.volume = cap.volume;
  overlap.centroid = center - cap.from_center * normal;
  // Its shadow along the normal: the plane's circle, or the sphere's own beyond the middle. The lower side's mean
  // height is known, and the volume is the shadow times the height between both sides' means.
  const bool past_middle = depth > radius;
  overlap.patch_area = past_middle ? pi * radius * radius : pi * depth * (2.0 * radius - depth);
  const double between = cap.volume / overlap.patch_area;
  const double lower = past_middle ? -2.0 / 3.0 * radius : -height - between;  // from the centre
  overlap.patch_centroid = center + (lower + 0.5 * between) * normal;
  overlap.patch_moment = disc_moment(overlap.patch_area, normal);
  return overlap;
}

ShapeOverlap curved_and_halfspace(const Shape &shape, const Pose &pose, const Pose &plane) {
  // Places from below the body's middle: sums of places far away would lose digits.
  const Vec3 normal = plane.rotation.column(2);
  const Vec3 origin = pose.translation - dot(normal, pose.translation - plane.translation) * normal;
  const SolidBelowPlane solid = solid_below_plane(shape, pose, origin, normal);
  ShapeOverlap overlap;
  if (!(solid.volume > 0.0) || !(solid.shadow > 0.0)) return overlap;
  overlap.volume = solid.volume;
  overlap.centroid = origin + (1.0 / solid.volume) * solid.volume_moment;
  overlap.patch_area = solid.shadow;
  const Vec3 middle = (1.0 / solid.shadow) * solid.shadow_moment;
  const double lower = solid.lower_height / solid.shadow, upper = lower + solid.volume / solid.shadow;
  overlap.patch_centroid = origin + middle + (0.5 * (lower + upper)) * normal;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      overlap.patch_moment.row[i].set(j, solid.shadow_second[i][j] - solid.shadow * middle[i] * middle[j]);
    }
  }
  return overlap;
}

ShapeOverlap spheres(double radius_a, const Vec3 &center_a, double radius_b, const Vec3 &center_b) {
  const Vec3 apart = center_b - center_a;
  const double distance = norm(apart);
  if (distance >= radius_a + radius_b) return {};
  const Vec3 along = normalized(apart);
  if (distance <= radius_b - radius_a) return whole_sphere(radius_a, center_a, along);
  if (distance <= radius_a - radius_b) return whole_sphere(radius_b, center_b, along);
  // The spheres' circle lies in a plane `middle` from A's centre; each gives the cap beyond it.
  const double middle = 0.5 * (distance + (radius_a - radius_b) * (radius_a + radius_b) / distance);
  const Cap cap_a(radius_a, radius_a - middle), cap_b(radius_b, radius_b - (distance - middle));
  ShapeOverlap overlap;
  overlap.volume = cap_a.volume + cap_b.volume;
  overlap.centroid = center_a + ((cap_a.volume * cap_a.from_center + cap_b.volume * (distance - cap_b.from_center)) /
                                 overlap.volume) * along;
  // The shadow along the line of centres, and where on it half way between both sides' means is, from A's centre.
  double place;
  if (middle < 0.0) {
    overlap.patch_area = pi * radius_a * radius_a;
    place = 2.0 / 3.0 * radius_a - 0.5 * overlap.volume / overlap.patch_area;
  } else if (middle > distance) {
    overlap.patch_area = pi * radius_b * radius_b;
    place = distance - 2.0 / 3.0 * radius_b + 0.5 * overlap.volume / overlap.patch_area;
  } else {
    overlap.patch_area = pi * (radius_a - middle) * (radius_a + middle);
    place = middle + 0.5 * (cap_a.volume - cap_b.volume) / overlap.patch_area;
  }
  overlap.patch_centroid = center_a + place * along;
  overlap.patch_moment = disc_moment(overlap.patch_area, along);
  return overlap;
}

// Sheets have no volume: nothing where one is touched.
std::optional<ShapeOverlap> mesh_with_halfspace(const Shape &mesh, const Pose &pose, const Pose &pose_b) {
  if (mesh.mesh->closed()) return overlap::mesh_and_halfspace(mesh, pose, pose_b, room().mesh);
  ContactSet &contact = room().contact;
  contact.points.clear();
  const Vec3 normal = pose_b.rotation.column(2);
  mesh_halfspace_contact(mesh, pose, {normal, dot(normal, pose_b.translation)}, contact);
  if (contact.distance < 0.0) return std::nullopt;
  return ShapeOverlap{};
}

// B is a mesh.
std::optional<ShapeOverlap> with_mesh(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  ContactSet &contact = room().contact;
  contact.points.clear();
  mesh_contact(a, pose_a, b, pose_b, room().mesh_contact, contact);
  if (contact.distance > 0.0) return ShapeOverlap{};
  if (!b.mesh->closed() || (a.mesh && !a.mesh->closed())) return std::nullopt;
  return overlap::mesh_overlap(a, pose_a, b, pose_b, normalized(contact.normal), contact.witness, room().mesh);
}

// Nothing where the overlap of these shapes is not known.
std::optional<ShapeOverlap> shapes(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  const PairEntry pair = pair_entry(a, b);
  if (pair.exchanged && !is_bounded_convex(pair.method)) return shapes(b, pose_b, a, pose_a);
  switch (pair.method) {
    case PairMethod::none: return ShapeOverlap{};
    case PairMethod::sphere_halfspace: return sphere_and_halfspace(a.body.radius, pose_a.translation, pose_b);
    case PairMethod::polytope_halfspace: return polytope_and_halfspace(a.polytope->geometry(), pose_a, pose_b);
    case PairMethod::round_halfspace: return curved_and_halfspace(a, pose_a, pose_b);
    case PairMethod::mesh_halfspace: return mesh_with_halfspace(a, pose_a, pose_b);
    case PairMethod::sphere_mesh:
    case PairMethod::polytope_mesh:
    case PairMethod::round_mesh:
    case PairMethod::mesh_mesh: return with_mesh(a, pose_a, b, pose_b);
    case PairMethod::sphere_sphere: return spheres(a.body.radius, pose_a.translation, b.body.radius, pose_b.translation);
    default: break;
  }
  SignedDistance answer;
  find_exact_distance(a, pose_a, b, pose_b, room().distance, answer);
  if (answer.distance >= 0.0) return ShapeOverlap{};
  if (pair.method != PairMethod::polytope_polytope) {
    return overlap::curved_overlap(a, pose_a, b, pose_b, {answer.normal, answer.point_a, answer.point_b}, room().curved);
  }
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
