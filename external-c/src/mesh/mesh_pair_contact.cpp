#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "mesh/mesh_contact.hpp"
#include "mesh/mesh_pair_distance.hpp"
#include "mesh/pair_walk.hpp"
#include "mesh/patch_load.hpp"
#include "mesh/swallowed.hpp"
#include "mesh/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

constexpr std::uint32_t most_in_leaf = TriangleHierarchy::leaf_size;
// A place that a triangle pushes, so deep below it, lies within this many times the depth of it (beside the edges of
// grooves more than once).
constexpr double reach_factor = 1.5;

// The middle of what the meshes' boxes have in common; moves steadily. In the first mesh's frame.
Vec3 common_center(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  const Bounds &one = mesh.hierarchy().bounds(), other = moved(body.hierarchy().bounds(), place);
  Vec3 center;
  for (int k = 0; k < 3; ++k) {
    center.set(k, 0.5 * (std::fmax(one.low[k], other.low[k]) + std::fmin(one.high[k], other.high[k])));
  }
  return center;
}

// What the triangles of `mesh` push of the surface of `body`, down to a depth. All in the frame of `mesh`.
class PairPatches {
 public:
  PairPatches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, double deepest,
              std::vector<Vec3> &polygon, PatchLoad &load)
      : mesh_(mesh), body_(body), place_(place), deepest_(deepest), polygon_(polygon), load_(load) {}

  void run() {
    const double reach = reach_factor * deepest_;
    walk_pairs(mesh_.hierarchy(), body_.hierarchy(), place_, [&] { return reach * reach; },
               [&](const TriangleHierarchy::Node &leaf, const TriangleHierarchy::Node &body_leaf) {
                 leaves(leaf, body_leaf);
               });
  }

 private:
  // The corners of a leaf's triangles.
  struct LeafTriangles {
    Vec3 corner[most_in_leaf][3], normal[most_in_leaf];
  };

  void leaves(const TriangleHierarchy::Node &leaf, const TriangleHierarchy::Node &body_leaf) {
    const Vec3 center = place_(0.5 * (body_leaf.bounds.low + body_leaf.bounds.high));
    const double radius = 0.5 * norm(body_leaf.bounds.high - body_leaf.bounds.low);
    bool ready = false;
    LeafTriangles of_body;
    TriangleWedge wedge;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      if (!wedge.build_if_it_meets(mesh_, mesh_.hierarchy().order()[i], deepest_, center, radius)) continue;
      if (!ready) transform(body_leaf, of_body);
      ready = true;
      for (std::uint32_t j = 0; j < body_leaf.count; ++j) {
        if (!(dot(wedge.normal(), of_body.normal[j]) < 0.0) || !wedge.may_meet(of_body.corner[j])) continue;
        polygon_.assign(of_body.corner[j], of_body.corner[j] + 3);
        load_.push(wedge, of_body.normal[j]);
      }
    }
  }

  void transform(const TriangleHierarchy::Node &leaf, LeafTriangles &triangles) const {
    for (std::uint32_t j = 0; j < leaf.count; ++j) {
      const std::uint32_t t = body_.hierarchy().order()[leaf.first + j];
      for (std::size_t k = 0; k < 3; ++k) triangles.corner[j][k] = place_(body_.corner(t, k));
      triangles.normal[j] = place_.rotation * body_.face_normal(t);
    }
  }

  const TriangleMesh &mesh_, &body_;
  const Pose &place_;
  double deepest_;
  std::vector<Vec3> &polygon_;
  PatchLoad &load_;
};

// Normals of the contact point out of `mesh`. Returns whether the meshes touch.
bool push(const TriangleMesh &mesh, const Pose &pose, const TriangleMesh &body, const Pose &place,
          MeshContactScratch &scratch, ContactSet &result) {
  // Shallow contacts need little of the meshes. Surface that is deeper shows by what the wedges cut off.
  const double most = body.bound_radius();
  double deepest = std::fmin(most, 0.5 * std::fmin(mesh.triangle_size(), body.triangle_size()));
  for (;;) {
    PatchLoad load(mesh, pose, common_center(mesh, body, place), scratch.patch);
    PairPatches(mesh, body, place, deepest, scratch.patch.polygon, load).run();
    if (load.cut_off() > 0.0 && deepest < most) {
      deepest = std::fmin(most, std::fmax(2.0 * deepest, 1.1 * load.cut_off()));
      continue;
    }
    if (!load.touches()) return false;
    load.finish(result);
    return true;
  }
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
