// Distance of a triangle and a convex body that are apart.
#pragma once

#include "convex/convex_body.hpp"
#include "mesh/mesh_data.hpp"

namespace cmb::mesh {

struct ConvexGap {
  double distance = 0.0;  // m, 0 where they meet
  Vec3 on_triangle, on_body;
};

// By the Gilbert-Johnson-Keerthi algorithm, to 1e-10 of the body's size; or a value greater than `enough` where the
// distance is (its points are then of no use). `body_in_mesh` is the body's pose in the triangle's frame.
ConvexGap triangle_convex_gap(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::ConvexBody &body,
                              const Pose &body_in_mesh, double enough);

}  // namespace cmb::mesh
