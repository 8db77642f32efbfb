#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "mesh/mesh_contact.hpp"
#include "mesh/mesh_pair_distance.hpp"
#include "mesh/pair_patches.hpp"
#include "mesh/patch_load.hpp"
#include "mesh/swallowed.hpp"

namespace cmb::mesh {

namespace {

// The middle of what the meshes' boxes have in common; moves steadily. In the first mesh's frame.
Vec3 common_center(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  const Bounds &one = mesh.hierarchy().bounds(), other = moved(body.hierarchy().bounds(), place);
  Vec3 center;
  for (int k = 0; k < 3; ++k) {
    center.set(k, 0.5 * (std::fmax(one.low[k], other.low[k]) + std::fmin(one.high[k], other.high[k])));
  }
  return center;
}

// Normals of the contact point out of `mesh`. Returns whether the meshes touch.
bool push(const TriangleMesh &mesh, const Pose &pose, const TriangleMesh &body, const Pose &place,
          MeshContactScratch &scratch, ContactSet &result) {
  PatchLoad load(mesh, pose, common_center(mesh, body, place), scratch.patch);
  push_pair_patches(mesh, body, place, scratch.pair, scratch.patch, load);
  if (!load.touches()) return false;
  load.finish(result);
  return true;
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
  const Pose a_in_b = relative_pose(pose_b, pose_a), b_in_a = relative_pose(pose_a, pose_b);
  if (pushes(a, b)) {
    if (push(a, pose_a, b, b_in_a, scratch, result)) {
      reverse(result);
      return;
    }
  } else if (push(b, pose_b, a, a_in_b, scratch, result)) {
    return;
  }
  const TrianglePair nearest = mesh_pair_distance(a, b, b_in_a);
  result.distance = nearest.distance;
  result.normal =
      normalized(pose_a.rotation * (nearest.on_a - nearest.on_b), pose_b.rotation * b.face_normal(nearest.b));
  result.witness = pose_a(0.5 * (nearest.on_a + nearest.on_b));
  // One may have swallowed the other.
  if (swallowed_contact(a_in_b(a.vertices()[0]), b, pose_b, result)) return;
  if (swallowed_contact(b_in_a(b.vertices()[0]), a, pose_a, result)) reverse(result);
}

}  // namespace cmb::mesh
