// Overlaps of closed triangle meshes.
#pragma once

#include "volume/curved_overlap.hpp"
#include "volume/face_columns.hpp"

namespace cmb::overlap {

// Room to work in; one for each thread. Grows in the first calls.
struct MeshOverlapScratch {
  FaceSet a, b;
  FaceColumns columns;
  CurvedScratch curved;
  convex::OverlapScratch base;
  std::vector<Vec3> corners;
};

// Of a closed mesh with the half-space below the plane z = 0 of `plane`.
ShapeOverlap mesh_and_halfspace(const Shape &mesh, const Pose &pose, const Pose &plane, MeshOverlapScratch &scratch);

// Of shape A, no half-space, with the closed mesh B; A may be a closed mesh. `normal`: unit, from B towards A; `near`: a
// place near the overlap.
ShapeOverlap mesh_overlap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const Vec3 &normal,
                          const Vec3 &near, MeshOverlapScratch &scratch);

}  // namespace cmb::overlap
