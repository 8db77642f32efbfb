#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "mesh/mesh_contact.hpp"
#include "mesh/mesh_pair_distance.hpp"
#include "mesh/pair_patches.hpp"
#include "mesh/patch_load.hpp"
#include "mesh/pierced_load.hpp"
#include "mesh/swallowed.hpp"

namespace cmb::mesh {

namespace {

// Triangles that cross by less than this part of the meshes' size do so by rounding.
constexpr double rounding = 1e-15;

// The middle of what the meshes' boxes have in common; moves steadily. In the first mesh's frame.
Vec3 common_center(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  const Bounds &one = mesh.hierarchy().bounds(), other = moved(body.hierarchy().bounds(), place);
  Vec3 center;
  for (int k = 0; k < 3; ++k) {
    center.set(k, 0.5 * (std::fmax(one.low[k], other.low[k]) + std::fmin(one.high[k], other.high[k])));
  }
  return center;
}

struct PlacedMesh {
  const TriangleMesh &mesh;
  const Pose &pose;
};

// Appends what the triangles of `one` push of the surface of `other`, whose pose in its frame is `place`; normals point
// out of `one`.
void push(const PlacedMesh &one, const TriangleMesh &other, const Pose &place, MeshContactScratch &scratch,
          ContactSet &result) {
  PatchLoad load(one.mesh, one.pose, common_center(one.mesh, other, place), scratch.patch);
  push_pair_patches(one.mesh, other, place, scratch.pair, scratch.patch, load);
  if (load.touches()) load.finish(result);
}

// Adds the contact in `from`, reversed, its load multiplied by `part`.
void add_reversed(ContactSet &from, double part, ContactSet &result) {
  reverse(from);
  for (ContactPoint &point : from.points) {
    point.weight *= part;
    if (point.weight > 0.0) result.points.push_back(point);
  }
  if (!(part * from.distance < result.distance)) return;
  result.distance = part * from.distance;
  result.normal = from.normal;
  result.witness = from.witness;
}

// The contact of two meshes of which `one` pushes; normals point out of it. Where that carries too little of what crosses,
// the other one pushes too, unless `one` is a sheet and the other is not, and if it cannot either, the crossing triangles
// do. Returns whether the meshes touch.
bool contact(const PlacedMesh &one, const PlacedMesh &other, MeshContactScratch &scratch, ContactSet &result) {
  const std::size_t begin = result.points.size();
  const Pose place = relative_pose(one.pose, other.pose);
  push(one, other.mesh, place, scratch, result);
  const double load = total_load(result.points, begin);
  const double nothing = rounding * (one.mesh.bound_radius() + other.mesh.bound_radius());
  const double crossing =
      deepest_crossing(one.mesh, other.mesh, place, scratch.pair, std::fmax(nothing, least_load_part * load));
  if (load > 0.0 && crossing == 0.0) return true;
  // A place of each may lie in the other; so it is where one has swallowed the other.
  const Pose back = place.inverse();
  const SwallowedPlace in_one(one.mesh, place(other.mesh.vertices()[0])), in_other(other.mesh, back(one.mesh.vertices()[0]));
  const double depth = std::fmax(crossing, std::fmax(in_one.depth(), in_other.depth()));
  if (!(depth > 0.0)) return false;
  if (!(load > 0.0)) result.distance = 0.0;
  PiercedLoad pierced(common_center(one.mesh, other.mesh, place));
  push_crossings(one.mesh, other.mesh, place, scratch.pair, pierced);
  ContactSet &reaction = scratch.reaction;
  const double lacking = load > 0.0 ? lacking_part(load, crossing) : 1.0;
  // A sheet pushes to its front alone, whatever the sides of the body that passes through it would do.
  if (one.mesh.closed() || !other.mesh.closed()) {
    reaction.points.clear();
    reaction.distance = 0.0;
    push(other, one.mesh, back, scratch, reaction);
    add_reversed(reaction, lacking, result);
  }
  const double part = lacking * lacking_part(total_load(result.points, begin), depth);
  pierced.finish(part, one.pose, result);
  in_one.lead_out(crossing, part, one.pose, result);
  reaction.points.clear();
  reaction.distance = 0.0;
  in_other.lead_out(std::fmax(crossing, in_one.depth()), part, other.pose, reaction);
  add_reversed(reaction, 1.0, result);
  return result.distance < 0.0;
}

// Whether the first mesh pushes the second one's surface rather than the other way round: sheets do, which have no
// inside, and the larger body, whose surface is likely to be the flatter one.
bool pushes(const TriangleMesh &one, const TriangleMesh &other) {
  if (one.closed() != other.closed()) return !one.closed();
  return one.bound_radius() > other.bound_radius();
}

}  // namespace

void mesh_pair_contact(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                       MeshContactScratch &scratch, ContactSet &result) {
  const PlacedMesh first{a, pose_a}, second{b, pose_b};
  if (pushes(a, b)) {
    if (contact(first, second, scratch, result)) {
      reverse(result);
      return;
    }
  } else if (contact(second, first, scratch, result)) {
    return;
  }
  const TrianglePair nearest = mesh_pair_distance(a, b, relative_pose(pose_a, pose_b));
  result.distance = nearest.distance;
  result.normal =
      normalized(pose_a.rotation * (nearest.on_a - nearest.on_b), pose_b.rotation * b.face_normal(nearest.b));
  result.witness = pose_a(0.5 * (nearest.on_a + nearest.on_b));
}

}  // namespace cmb::mesh
