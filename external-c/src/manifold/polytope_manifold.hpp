// Contact of two polytopes.
#pragma once

#include <cstdint>
#include <vector>

#include "convex/convex_overlap.hpp"
#include "geometry/contact_polytope.hpp"
#include "manifold/contact_set.hpp"
#include "scene/shape.hpp"

namespace cmb {

// Room that polytope contacts are made in; one for each thread.
struct PolytopeManifoldScratch {
  // The part of a body's edge that lies in the overlap.
  struct Segment {
    Vec3 from, along;  // where it begins, and the vector to its end
  };
  // A vertex of either body near the contact, and what it would carry if its normal cone filled the hemisphere.
  struct Anchor {
    double x, y;  // in the contact plane's axes
    double influence;
    double stiffness;
  };
  // A corner of the depth's graph over the contact plane.
  struct Corner {
    Vec3 lifted;    // in the contact plane's axes: two coordinates in the plane, and the depth
    Vec3 position;  // half way between the surfaces, in A's frame
  };
  convex::OverlapScratch overlap;
  std::vector<Vec3> vertices_b;  // in A's frame
  std::vector<std::int32_t> lower_edges, upper_edges;  // of A, of B
  std::vector<std::uint8_t> bounds;  // which faces of a body bound the overlap
  std::vector<Segment> segments_a, segments_b;
  std::vector<Anchor> anchors;
  std::vector<Corner> corners;
};

// Appends the points at which polytopes A and B touch; none where they do not overlap, or where one contains the
// other. `normal` is the direction, from B to A, of the shortest translation that parts them.
//
// How far B's upper side lies above A's lower side, measured along the contact normal, is a concave function over the
// contact plane; the points are the corners of its graph. A corner's weight is the part of the hemisphere of directions in
// which it is the graph's farthest point (its normal cone), scaled so that a vertex of one body inside a face of
// the other carries its share in that face. This measure of a convex body changes continuously with the body
// (Schneider, Convex Bodies, section 4.2), so corners may appear, merge and vanish without a jump.
void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, PolytopeManifoldScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
