// Contact spread over patches: what the triangles of a mesh push of another body's surface.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "mesh/contact/direction_sums.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/wedges/triangle_wedge.hpp"

namespace cmb::mesh {

// Room for one polygon; grows in the first calls.
struct PatchScratch {
  std::vector<Vec3> polygon, clipped, half, quarter;
};

// Collects the patches of a contact of two sheets. Each carries its depth below its triangle times its area as seen along the
// triangle's normal, divided by the area of all patches.
//
// Few points stand for all patches: one for each quadrant about a centre, and for each of the six directions of the mesh's
// axes (DirectionSums). Patches are cut where quadrants meet. So every point, not only their sum, changes continuously.
//
// As a sheet turns away no other side takes over, and the depth behind the other one grows without bound; so its load and depth
// count by a share, 1 down to a cosine of 1/2, from there with its square to 0, and its area counts whichever way it faces.
//
// Borrows everything it is given. All in the mesh's frame, but points go to the result in world axes.
class PatchLoad {
 public:
  PatchLoad(const Pose &pose, const Vec3 &center, PatchScratch &scratch) : pose_(pose), center_(center), scratch_(scratch) {}

  // Adds what the wedge's triangle pushes of the plane convex polygon in scratch.polygon (overwritten), whose unit
  // outward normal is `normal`. Only surface that faces the triangle is pushed. Returns whether some of the polygon lies in the
  // wedge.
  bool push(const TriangleWedge &wedge, const Vec3 &normal);

  // Whether anything is pushed.
  bool touches() const { return deepest_ > 0.0 && area_ > 0.0; }

  // Where it touches: appends the points, and sets distance, normal and witness.
  void finish(ContactSet &result) const;

 private:
  struct Integral {
    double area = 0.0, load = 0.0, energy = 0.0;
    Vec3 moment;
  };
  static Integral integrate(const std::vector<Vec3> &polygon, const TriangleWedge &wedge, double cosine);
  void add_patch(const TriangleWedge &wedge, double cosine);
  void add(const Integral &integral, std::size_t quadrant, const Vec3 &normal, double share);

  const Pose &pose_;
  Vec3 center_;
  PatchScratch &scratch_;
  double area_ = 0.0;
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
  DirectionSums sums_[4];  // by quadrant
};

}  // namespace cmb::mesh
