#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "mesh/mesh_contact.hpp"
#include "mesh/mesh_pair_distance.hpp"
#include "mesh/patch_load.hpp"
#include "mesh/swallowed.hpp"
#include "mesh/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

// What the triangles of one mesh push of another's surface. Everything in the pushing mesh's frame but the result.
class HalfContact {
 public:
  HalfContact(const TriangleMesh &body, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
              MeshContactScratch &scratch, ContactSet &result)
      : body_(body), place_(body_in_mesh), mesh_(mesh), polygon_(scratch.patch.polygon),
        load_(mesh, pose, body_in_mesh(body.bound_center()), scratch.patch, result) {}

  // Returns whether anything is pushed.
  bool run() {
    walk(0, 0);
    if (!load_.touches()) return false;
    load_.finish(0.5);
    return true;
  }

 private:
  // `first`: a triangle of the mesh near the node.
  void walk(std::uint32_t index, std::uint32_t first) {
    const TriangleHierarchy::Node &node = body_.hierarchy().nodes()[index];
    const Vec3 center = place_(0.5 * (node.bounds.low + node.bounds.high));
    const double radius = 0.5 * norm(node.bounds.high - node.bounds.low);
    // Closed meshes hold nothing outside of their box, sheets may push what is below it.
    if (mesh_.closed() && distance2(mesh_.hierarchy().bounds(), {center, center}) > radius * radius) return;
    const NearestPoint nearest = mesh_.nearest(center, first);
    if (nearest.distance > radius) return;
    if (node.count == 0) {
      walk(node.first, nearest.triangle);
      walk(node.first + 1, nearest.triangle);
      return;
    }
    leaf(node, center, radius, nearest);
  }

  void leaf(const TriangleHierarchy::Node &node, const Vec3 &center, double radius, const NearestPoint &nearest) {
    Vec3 corners[most_in_leaf][3], normals[most_in_leaf];
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const std::uint32_t t = body_.hierarchy().order()[node.first + i];
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = place_(body_.corner(t, k));
      normals[i] = place_.rotation * body_.face_normal(t);
    }
    // No place of the leaf is deeper than this; what pushes it lies within three times that.
    const double deepest = radius - nearest.distance, farthest = radius + 3.0 * deepest;
    mesh_.hierarchy().visit_near(
        {center, center}, [&] { return farthest * farthest; },
        [&](std::uint32_t t) {
          const Vec3 &normal = mesh_.face_normal(t);
          const double height = dot(normal, center - mesh_.corner(t, 0));
          if (height >= radius) return;
          const TriangleWedge wedge(mesh_, t, body_.bound_radius());
          if (!wedge.may_meet(center, radius)) return;
          load_.open(wedge);
          for (std::uint32_t i = 0; i < node.count; ++i) {
            if (!(dot(normals[i], normal) < 0.0)) continue;
            if (!(wedge.depth(corners[i][0]) > 0.0 || wedge.depth(corners[i][1]) > 0.0 ||
                  wedge.depth(corners[i][2]) > 0.0)) {
              continue;
            }
            polygon_.assign(corners[i], corners[i] + 3);
            load_.push(normals[i]);
          }
          load_.close();
        });
  }

  static constexpr std::size_t most_in_leaf = TriangleHierarchy::leaf_size;
  const TriangleMesh &body_;
  const Pose &place_;
  const TriangleMesh &mesh_;
  std::vector<Vec3> &polygon_;
  PatchLoad load_;
};

}  // namespace

void mesh_pair_contact(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                       MeshContactScratch &scratch, ContactSet &result) {
  const Pose a_in_b = relative_pose(pose_b, pose_a), b_in_a = relative_pose(pose_a, pose_b);
  ContactSet &other = scratch.half_contact;
  other.points.clear();
  const bool b_pushes = HalfContact(a, a_in_b, b, pose_b, scratch, result).run();
  const bool a_pushes = HalfContact(b, b_in_a, a, pose_a, scratch, other).run();
  for (ContactPoint &point : other.points) {
    point.normal = -point.normal;
    result.points.push_back(point);
  }
  if (a_pushes && (!b_pushes || other.distance < result.distance)) {
    result.distance = other.distance;
    result.normal = -other.normal;
    result.witness = other.witness;
  }
  if (a_pushes || b_pushes) return;
  const TrianglePair nearest = mesh_pair_distance(a, b, b_in_a);
  result.distance = nearest.distance;
  result.normal = normalized(pose_a.rotation * (nearest.on_a - nearest.on_b), pose_b.rotation * b.face_normal(nearest.b));
  result.witness = pose_a(0.5 * (nearest.on_a + nearest.on_b));
  // One may have swallowed the other.
  if (swallowed_contact(a_in_b(a.vertices()[0]), b, pose_b, result)) return;
  if (swallowed_contact(b_in_a(b.vertices()[0]), a, pose_a, result)) {
    result.normal = -result.normal;
    result.points.back().normal = result.normal;
  }
}

}  // namespace cmb::mesh
