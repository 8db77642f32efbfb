// Shapes: convex solids, half-spaces and triangle meshes, in the frame of the body that carries them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shape/contact_polytope.hpp"
#include "shape/convex_body.hpp"

namespace cmb {

namespace mesh {
class TriangleMesh;
}

using convex::Mat3;
using convex::Pose;
using convex::Vec3;

// A convex shape as a back end's library holds it: made where the scene is interned, never changed, shared by threads.
class LibraryShape {
 public:
  virtual ~LibraryShape() = default;
};

enum class ShapeKind { halfspace, sphere, box, capsule, hull, ellipsoid, cylinder, cone, mesh };

// A box in a shape's frame, swept by a sphere, that holds the shape. Immutable.
struct LocalBounds {
  Vec3 center, half;
  double radius = 0.0;
};

// Immutable once parsed; shared by threads.
struct Shape {
  ShapeKind kind = ShapeKind::halfspace;
  convex::ConvexBody body;                           // of every kind but halfspace and mesh
  std::shared_ptr<const ContactPolytope> polytope;   // of box and hull; a closed convex mesh is a hull
  std::shared_ptr<const mesh::TriangleMesh> mesh;    // of mesh, which height fields are too, and of hulls given as meshes
  std::shared_ptr<const ContactPolytope> mesh_hull;  // of a mesh that a half-space may touch, if it is no plane
  std::shared_ptr<const LibraryShape> in_library;    // for the scene's back end; null where that keeps none
  Pose in_body;                                      // point_in_body = in_body(point_in_shape);
  bool is_moved = false;                             // whether that is not the identity
  Vec3 bound_center;                                 // bounding sphere in the shape's frame;
  double bound_radius = 0.0;                         // not for halfspace
  LocalBounds bounds;                                // nor these
};

// A cylinder or cone.
inline bool is_revolved(const Shape &shape) { return shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone; }

// The shapes of one body; empty where the body has none.
using BodyShapes = std::vector<Shape>;

}  // namespace cmb
