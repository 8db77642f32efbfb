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
// triangle's normal, divided by the area of all patches. What one triangle pushes becomes up to four points, one for each
// quadrant about the body's centre, that keep the sums of load, of load times place and of the energy at exponent 1.
// Borrows everything it is given. All in the mesh's frame, but points go to the result in world axes.
class PatchLoad {
 public:
  PatchLoad(const TriangleMesh &mesh, const Pose &pose, const Vec3 &center, PatchScratch &scratch, ContactSet &result)
      : mesh_(mesh), pose_(pose), center_(center), scratch_(scratch), result_(result), begin_(result.points.size()) {}

  // Before and after all that one triangle pushes.
  void open(const TriangleWedge &wedge);
  void close();

  // Adds what the open wedge's triangle pushes of the plane convex polygon in scratch.polygon (overwritten), whose unit
  // outward normal is `normal`, its load multiplied by `factor`. Only surface that faces the triangle is pushed.
  void push(const Vec3 &normal, double factor = 1.0);

  // Whether anything is pushed.
  bool touches() const { return deepest_ > 0.0 && result_.points.size() > begin_; }

  // Where it touches: divides the weights by the area, times `part`, leaves few points, and sets distance, normal and
  // witness of the result.
  void finish(double part = 1.0);

 private:
  // A flat patch below a triangle, or the sum of some.
  struct Patch {
    double load = 0.0;    // m3, integral of the depth over it
    double energy = 0.0;  // m4, integral of the depth squared
    Vec3 moment;          // m4, integral of depth times place
  };
  void add_part(const Vec3 &p, const Vec3 &q, const Vec3 &r, double dp, double dq, double dr, double cosine,
                double carried, double factor);
  double inside_share(const Vec3 &p, double depth) const;
  void thin();

  const TriangleMesh &mesh_;
  const Pose &pose_;
  Vec3 center_;
  PatchScratch &scratch_;
  ContactSet &result_;
  std::size_t begin_;
  double area_ = 0.0, carrying_area_ = 0.0;
  double most_carried_ = 0.0;
  const TriangleWedge *wedge_ = nullptr;
  Vec3 axis_;  // in the open triangle's plane
  Patch quadrants_[4];
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
};

}  // namespace cmb::mesh
