// Shapes: convex solids, and the half-space, in the frame of the body that carries them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/contact_polytope.hpp"

namespace cmb {

using convex::Mat3;
using convex::Pose;
using convex::Vec3;

enum class ShapeKind { halfspace, sphere, box, capsule, hull, ellipsoid, cylinder, cone };

// Immutable once parsed; shared by threads.
struct Shape {
  ShapeKind kind = ShapeKind::halfspace;
  convex::ConvexBody body;                           // of every kind but halfspace
  std::shared_ptr<const ContactPolytope> polytope;   // of box and hull
  Pose in_body;                                      // point_in_body = in_body(point_in_shape)
  Vec3 bound_center;                                 // bounding sphere in the shape's frame;
  double bound_radius = 0.0;                         // not for halfspace
};

// The shapes of one body; empty where the body has none.
using BodyShapes = std::vector<Shape>;

}  // namespace cmb
