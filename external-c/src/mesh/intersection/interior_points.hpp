// Bodies of which a closed mesh holds more than its surface crosses.
//
// A convex body has one interior point, its middle; a mesh up to eight, half way through it behind triangles far from each other. They
// lead out where they lie deeper in the other mesh than 8 times the load, also where nothing crosses: faces may be flush.
#pragma once

#include <array>
#include <cstddef>

#include "manifold/contact_set.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// A place of a body that may lie inside a mesh.
class InteriorPoint {
 public:
  InteriorPoint() = default;  // that lies outside
  // In the mesh's frame. Sheets hold nothing. Places no deeper than `enough` may count as outside.
  InteriorPoint(const TriangleMesh &mesh, const Vec3 &place, double enough = 0.0);

  // How deep it lies inside; 0 outside.
  double depth() const { return nearest_.distance < 0.0 ? -nearest_.distance : 0.0; }

  // Where it lies deeper than `other`, the depth of what else parts the two: appends a point of the weight that leads to the
  // nearest place of the mesh with what is missing, all depths multiplied by `part`; sets distance, normal and witness where that is nearer.
  void push_out(double other, double part, const Pose &pose, ContactSet &result, double weight = 1.0) const;

 private:
  Vec3 place_;
  NearestPoint nearest_;
};

// Whether a closed mesh may hold a component of the body, whose surface none of its own crosses; of a sheet false. `place`: the body's pose in
// the mesh's frame.
bool may_hold_component(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place);

// The interior points of a body that is a mesh itself. One alone may lie in the other's surface: faces of meshes may be flush.
class InteriorPoints {
 public:
  // `place`: the body's pose in the mesh's frame. Places no deeper than `enough` may count as outside.
  InteriorPoints(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, double enough);

  // How deep the deepest lies inside; 0 where all are outside.
  double depth() const { return deepest_; }

  // The same as of one place. They count by the fourth power of what is missing, so that none takes over at once.
  void push_out(double other, double part, const Pose &pose, ContactSet &result) const;

 private:
  std::array<InteriorPoint, TriangleMesh::max_interior_points> places_;
  std::size_t count_ = 0;
  double deepest_ = 0.0;
};

}  // namespace cmb::mesh
