// Overlap of two convex polytopes: volume, centroids and contact patch.
//
// One body's surface is cut by the other's face planes one after the other. The surface is closed
// again after every cut by construction, so that faces in one plane, edges in faces and other
// coincidences cost accuracy of rounding only.
#pragma once

#include <cstdint>
#include <vector>

#include "math/vector3.hpp"
#include "shape/polytope.hpp"

namespace cmb::convex {

// Everything in A's frame. All zero where the bodies have no volume in common.
struct Overlap {
  double volume = 0.0;      // m3
  Vec3 centroid;            // of the volume
  double patch_area = 0.0;  // m2, of the overlap's projection along the normal
  Vec3 patch_centroid;      // of the projection; along the normal midway between the overlap's two sides (their means)
  Mat3 patch_moment = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // m4: integral of r r^T over the projection, r in its
                                                            // plane from patch_centroid; symmetric
};

// Room for the intersection and, after convex_overlap, the intersection itself. Grows in the first
// calls; one for each thread.
class OverlapScratch {
 public:
  struct Face {
    std::int32_t first = 0;  // into corners()
    std::int32_t count = 0;
    std::int32_t source_face = 0;  // of the body named next
    bool from_b = false;
    Vec3 normal;
    double offset = 0.0;
  };
  // The intersection's surface of the last call, in A's frame: faces as cycles of corners,
  // counter-clockwise seen from outside. Points and short edges may repeat.
  const std::vector<Vec3> &vertices() const { return vertices_; }
  const std::vector<Face> &faces() const { return faces_; }
  const std::vector<std::int32_t> &corners() const { return corners_; }

  // Makes the intersection a box between two corners; its faces have the number -1.
  void start_box(const Vec3 &low, const Vec3 &high);
  // Drops what lies beyond the plane normal . p = offset (normal of any length); the new face has the given number.
  void cut(const Vec3 &normal, double offset, std::int32_t source_face, bool from_b);

 private:
  friend Overlap convex_overlap(const Polytope &, const Polytope &, const Pose &, const Vec3 &, OverlapScratch &);
  friend Overlap convex_overlap(const Polytope &, const Vec3 &, double, OverlapScratch &);
  struct Crossing {
    std::int32_t outer_vertex, new_vertex, next;  // a list for each inner vertex
  };
  void load(const Polytope &body, const Pose &pose, bool is_b);
  std::int32_t crossing_vertex(std::int32_t inner, std::int32_t outer);
  void clear();
  void bound();
  Overlap measure(const Vec3 &normal) const;

  std::vector<Vec3> vertices_, next_vertices_;
  std::vector<Face> faces_, next_faces_;
  std::vector<std::int32_t> corners_, next_corners_;
  std::vector<double> height_;
  std::vector<std::int32_t> renumbered_, crossing_at_, cap_next_;
  std::vector<Crossing> crossings_;
  Vec3 middle_, reach_;  // bounding box: centre and half lengths
};

// The overlap of A and B; `b_in_a` maps B's frame to A's (finite, rotation orthonormal); `normal` is
// unit, in A's frame, either sense: the direction that the patch is projected along.
Overlap convex_overlap(const Polytope &a, const Polytope &b, const Pose &b_in_a, const Vec3 &normal,
                       OverlapScratch &scratch);

// The same of A and the half-space normal . p <= offset; `normal` is unit.
Overlap convex_overlap(const Polytope &a, const Vec3 &normal, double offset, OverlapScratch &scratch);

}  // namespace cmb::convex
