#include <cmath>
#include <limits>

#include "geometry/pose_algebra.hpp"
#include "mesh/mesh_contact.hpp"
#include "mesh/patch_load.hpp"
#include "mesh/polytope_distance.hpp"
#include "mesh/swallowed.hpp"
#include "mesh/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

// Everything in the mesh's frame but the result.
class PolytopeQuery {
 public:
  PolytopeQuery(const convex::Polytope &body, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
                MeshContactScratch &scratch, ContactSet &result)
      : body_(body), mesh_(mesh), pose_(pose), scratch_(scratch), result_(result) {
    scratch.body_vertices.clear();
    scratch.body_normals.clear();
    for (const Vec3 &v : body.vertices()) scratch.body_vertices.push_back(body_in_mesh(v));
    for (const auto &face : body.faces()) scratch.body_normals.push_back(body_in_mesh.rotation * face.normal);
    box_ = bounds_of(scratch.body_vertices);
    size_ = 0.5 * norm(box_.high - box_.low);
  }

  void run() {
    PatchLoad load(mesh_, pose_, 0.5 * (box_.low + box_.high), scratch_.patch);
    mesh_.hierarchy().visit_near(
        box_, [&] { return size_ * size_; }, [&](std::uint32_t t) { triangle(t, load); });
    if (load.touches()) {
      load.finish(result_);
    } else {
      apart();
      swallowed_contact(0.5 * (box_.low + box_.high), mesh_, pose_, result_);
    }
  }

 private:
  // The part of the body's surface that triangle t pushes.
  void triangle(std::uint32_t t, PatchLoad &load) {
    const Vec3 &normal = mesh_.face_normal(t);
    const double offset = dot(normal, mesh_.corner(t, 0));
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3 &v : scratch_.body_vertices) lowest = std::fmin(lowest, dot(normal, v));
    if (!(lowest < offset)) return;
    TriangleWedge wedge;
    if (!wedge.build_if_it_meets(mesh_, t, size_, 0.5 * (box_.low + box_.high), size_)) return;
    for (std::size_t f = 0; f < scratch_.body_normals.size(); ++f) {
      if (!(dot(scratch_.body_normals[f], normal) < 0.0)) continue;
      const convex::Polytope::Face &face = body_.faces()[f];
      std::vector<Vec3> &polygon = scratch_.patch.polygon;
      polygon.clear();
      for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
        polygon.push_back(
            scratch_.body_vertices[static_cast<std::size_t>(body_.face_vertices()[static_cast<std::size_t>(i)])]);
      }
      load.push(wedge, scratch_.body_normals[f]);
    }
  }

  void apart() {
    PolytopeDistance best;
    best.distance = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    // The extents along the best direction so far bound the distance of the others.
    Vec3 direction;
    double lowest = 0.0;
    mesh_.hierarchy().visit_near(
        box_, [&] { return best.distance * best.distance; },
        [&](std::uint32_t t) {
          const double highest = std::fmax(dot(direction, mesh_.corner(t, 0)),
                                           std::fmax(dot(direction, mesh_.corner(t, 1)), dot(direction, mesh_.corner(t, 2))));
          if (lowest - highest > best.distance) return;
          const PolytopeDistance candidate =
              triangle_polytope_distance(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), body_,
                                         scratch_.body_vertices, scratch_.body_normals, scratch_.patch.polygon,
                                         scratch_.patch.clipped);
          if (candidate.distance < best.distance || (candidate.distance == best.distance && t < nearest)) {
            best = candidate;
            nearest = t;
            direction = normalized(best.on_body - best.on_triangle, mesh_.face_normal(t));
            lowest = std::numeric_limits<double>::infinity();
            for (const Vec3 &v : scratch_.body_vertices) lowest = std::fmin(lowest, dot(direction, v));
          }
        });
    result_.distance = best.distance;
    result_.normal = pose_.rotation * normalized(best.on_body - best.on_triangle, mesh_.face_normal(nearest));
    result_.witness = pose_(0.5 * (best.on_body + best.on_triangle));
  }

  const convex::Polytope &body_;
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
  PolytopeQuery(body, relative_pose(pose, body_pose), mesh, pose, scratch, result).run();
}

}  // namespace cmb::mesh
