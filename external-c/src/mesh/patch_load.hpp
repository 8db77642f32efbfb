// Contact spread over patches: what the triangles of a mesh push of another body's surface.
#pragma once

#include <cstddef>
#include <vector>

#include "manifold/contact_set.hpp"
#include "mesh/triangle_mesh.hpp"
#include "mesh/triangle_wedge.hpp"

namespace cmb::mesh {

// Room for one polygon; grows in the first calls.
struct PatchScratch {
  std::vector<Vec3> polygon, clipped;
};

// Collects the patches of one contact. Each carries its depth below its triangle times its area as seen along the
// triangle's normal, divided by the area of all patches. Borrows everything it is given. All in the mesh's frame, but
// points go to the result in world axes.
class PatchLoad {
 public:
  PatchLoad(const TriangleMesh &mesh, const Pose &pose, PatchScratch &scratch, ContactSet &result)
      : mesh_(mesh), pose_(pose), scratch_(scratch), result_(result), begin_(result.points.size()) {}

  // Adds what the wedge's triangle pushes of the plane convex polygon in scratch.polygon (overwritten), whose unit
  // outward normal is `normal`, its load multiplied by `factor`. Only surface that faces the triangle is pushed.
  void push(const TriangleWedge &wedge, const Vec3 &normal, double factor = 1.0);

  // Whether anything is pushed.
  bool touches() const { return deepest_ > 0.0 && result_.points.size() > begin_; }

  // Where it touches: divides the weights by the area, times `part`, leaves few points, and sets distance, normal and
  // witness of the result.
  void finish(double part = 1.0);

 private:
  // A flat patch below a triangle, or a part of one.
  struct Patch {
    double area = 0.0;    // m2, as seen along the triangle's normal
    double load = 0.0;    // m3, integral of the depth over it
    double energy = 0.0;  // m4, integral of the depth squared
    Vec3 moment;          // m4, integral of depth times place
  };
  static Patch linear_patch(const Vec3 &p, const Vec3 &q, const Vec3 &r, double dp, double dq, double dr,
                            double cosine);
  void add(const Patch &patch, double carried, double factor, const Vec3 &normal);
  double inside_share(const Vec3 &p, double depth, std::uint32_t triangle) const;
  void thin();

  const TriangleMesh &mesh_;
  const Pose &pose_;
  PatchScratch &scratch_;
  ContactSet &result_;
  std::size_t begin_;
  double area_ = 0.0, carrying_area_ = 0.0;
  double most_carried_ = 0.0;
  std::size_t patches_ = 0;
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
};

}  // namespace cmb::mesh
