// Bodies of which a closed mesh holds more than its surface crosses.
#pragma once

#include "manifold/contact_set.hpp"
#include "mesh/triangle_mesh.hpp"

namespace cmb::mesh {

// A place of a body that may lie inside a mesh.
class SwallowedPlace {
 public:
  // In the mesh's frame. Sheets hold nothing.
  SwallowedPlace(const TriangleMesh &mesh, const Vec3 &place);

  // How deep it lies inside; 0 outside.
  double depth() const { return nearest_.distance < 0.0 ? -nearest_.distance : 0.0; }

  // Where it lies deeper than the `other` ways out of the body: appends a point that leads to the nearest place of the mesh
  // with what is missing, all depths multiplied by `part`; sets distance, normal and witness where that is nearer.
  void lead_out(double other, double part, const Pose &pose, ContactSet &result) const;

 private:
  Vec3 place_;
  NearestPoint nearest_;
};

}  // namespace cmb::mesh
