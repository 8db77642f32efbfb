#include <cmath>
#include <cstdint>

#include "math/pose_algebra.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/nearest_triangle.hpp"
#include "mesh/contact/overlap_contact.hpp"
#include "mesh/contact/polytope_distance.hpp"
#include "mesh/contact/triangle_convex_distance.hpp"
#include "mesh/elastic/wedge_overlap.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

namespace {

// Everything in the mesh's frame but the result.
class PolytopeQuery {
 public:
  PolytopeQuery(const convex::Polytope &body, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
                MeshContactScratch &scratch, ContactSet &result)
      : body_(body), place_(body_in_mesh), mesh_(mesh), pose_(pose), scratch_(scratch), result_(result) {
    scratch.body_vertices.clear();
    scratch.body_normals.clear();
    for (const Vec3 &v : body.vertices()) scratch.body_vertices.push_back(body_in_mesh(v));
    for (const auto &face : body.faces()) scratch.body_normals.push_back(body_in_mesh.rotation * face.normal);
    box_ = bounds_of(scratch.body_vertices);
    size_ = 0.5 * norm(box_.high - box_.low);
  }

  void run() {
    const NearestPoint nearest = mesh_.nearest(0.5 * (box_.low + box_.high));
    // A body that no triangle meets touches only what its middle is in, or nothing.
    if (!(nearest.distance < 0.0 && mesh_.closed()) && apart(nearest.triangle)) return;
    WedgeOverlap overlap(body_, place_, scratch_.body_vertices, scratch_.body_normals, mesh_, 0.5 * (box_.low + box_.high), size_,
                         scratch_.overlap);
    mesh_.visit_wedges(
        box_, size_, [&](const Vec3 &d) { return farthest_vertex(d); }, [&](std::uint32_t t) { overlap.add(t); });
    const SectionedBody body(body_, place_, scratch_.body_vertices, scratch_.body_normals, scratch_.patch.polygon,
                             scratch_.patch.clipped);
    if (!append_overlap_contact(overlap, body, mesh_, pose_, scratch_.elastic, result_)) apart(nearest.triangle);
  }

  // Where nothing touches.
  void find_clearance() { apart(mesh_.nearest(0.5 * (box_.low + box_.high)).triangle); }

 private:
  // Where the body begins along a unit direction from the mesh to it; nothing at first.
  struct Extent {
    Vec3 direction;
    double lowest = 0.0;

    // How far at least the body is beyond a triangle or a box; negative where that says nothing.
    double gap(const Vec3 &a, const Vec3 &b, const Vec3 &c) const {
      return lowest - std::fmax(dot(direction, a), std::fmax(dot(direction, b), dot(direction, c)));
    }
    double gap(const Bounds &box) const {
      double highest = 0.0;
      for (int k = 0; k < 3; ++k) highest += direction[k] * (direction[k] > 0.0 ? box.high[k] : box.low[k]);
      return lowest - highest;
    }
  };
  const Vec3 &farthest_vertex(const Vec3 &direction) const {
    const Vec3 local = transposed_times(place_.rotation, direction);
    return scratch_.body_vertices[static_cast<std::size_t>(body_.support_vertex(local))];
  }
  Extent extent_along(const Vec3 &direction) const { return {direction, dot(direction, farthest_vertex(-direction))}; }

  // Whether no triangle meets the body; sets distance, normal and witness then. The search begins with triangle `first`.
  bool apart(std::uint32_t first) {
    NearestTriangle nearest(mesh_);
    // Of equally near triangles rounding chooses none.
    const double slack = 1e-12 * (size_ + norm(box_.low) + norm(box_.high) + mesh_.bound_radius());
    // Extents along a direction bound distances: along that of the nearest triangle so far, and along that which has
    // parted the last one, often a neighbour.
    Extent nearest_extent, last_extent;
    const auto is_farther = [&](const Bounds &box) {
      const double enough = nearest.distance() + slack;
      return nearest_extent.gap(box) > enough || last_extent.gap(box) > enough;
    };
    const auto offer = [&](std::uint32_t t) {
      const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
      if (nearest_extent.gap(a, b, c) > nearest.distance() || last_extent.gap(a, b, c) > nearest.distance()) return;
      bool proven;
      Vec3 parting;
      TriangleGap gap = triangle_polytope_gap(a, b, c, body_, place_, nearest.distance(), proven, parting);
      if (!proven) {
        gap = triangle_polytope_distance(a, b, c, body_, scratch_.body_vertices, scratch_.body_normals,
                                         scratch_.patch.polygon, scratch_.patch.clipped);
      }
      if (nearest.offer(gap, t)) {
        nearest_extent = extent_along(nearest.direction());
      } else if (norm2(parting) > 0.0) {
        last_extent = extent_along(parting);
      }
    };
    const bool none_meets = nearest.search(box_, first, is_farther, offer);
    nearest.write(pose_, result_);
    return none_meets;
  }

  const convex::Polytope &body_;
  const Pose &place_;
  const TriangleMesh &mesh_;
  const Pose &pose_;
  MeshContactScratch &scratch_;
  ContactSet &result_;
  Bounds box_;
  double size_ = 0.0;
};

}  // namespace

void polytope_contact(const convex::Polytope &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                      MeshContactScratch &scratch, ContactSet &result) {
  const Pose body_in_mesh = relative_pose(pose, body_pose);
  PolytopeQuery(body, body_in_mesh, mesh, pose, scratch, result).run();
}

void polytope_clearance(const convex::Polytope &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                        MeshContactScratch &scratch, ContactSet &result) {
  const Pose body_in_mesh = relative_pose(pose, body_pose);
  PolytopeQuery(body, body_in_mesh, mesh, pose, scratch, result).find_clearance();
}

}  // namespace cmb::mesh
