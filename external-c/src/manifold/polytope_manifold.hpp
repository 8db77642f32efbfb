// Contact of two polytopes.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/solid_angle.hpp"
#include "manifold/contact_set.hpp"
#include "manifold/polytope_side.hpp"
#include "scene/shape.hpp"

namespace cmb {

// Room that polytope contacts are made in; one for each thread.
struct PolytopeManifoldScratch {
  // A corner of the depth's graph over the contact plane.
  struct Corner {
    Vec3 middle;  // half way between the surfaces, in the contact's axes
    double depth, weight;
    Vec3 slope;  // of the weight by the direction towards the other body, in the contact's axes
  };
  // A face's plane over the contact plane: z = height - slope_x x - slope_y y, the z axis pointing to the other body.
  struct Patch {
    double slope_x, slope_y, height;                 // of the true face
    double shaken_x, shaken_y, shaken_height;
    bool towards;                                    // faces the other body; else only its border counts:
    double wall_x, wall_y, wall_z, wall_offset;      // shaken
  };
  // An edge between faces of which at least one looks towards the other body.
  struct Border {
    double low_x, high_x, low_y, high_y;
    Vec3 from, to, shaken_from, shaken_to;
    std::int32_t vertex[2];  // into the side's
    Vec3 ray[2];  // its faces' directions within the hemisphere
  };
  PolytopeSide side_a, side_b;
  std::vector<Patch> patches_a, patches_b;
  std::vector<Border> borders_a, borders_b;
  // What a vertex would carry if its normal cone filled the hemisphere, and how that changes with the direction towards
  // the other body as far as that turns with the other body.
  struct Stiffness {
    double value = -1.0;  // negative where not yet known
    Vec3 slope;
  };
  std::vector<Stiffness> stiffness_a, stiffness_b;  // of the sides' vertices
  std::vector<Corner> corners;
  DirectionCone cone, sheared_cone;
};

// Appends the points at which polytopes A and B touch. `normal` (unit, from B to A) is the contact normal, `witness` a
// point near the contact, both in world axes.
//
// How far B's upper side lies above A's lower side, measured along the contact normal, is a concave function over the
// contact plane; the points are the corners of its graph: vertices of one body over the other's faces, crossings of
// edges. A corner's weight is the part of the hemisphere of directions in which it is the graph's farthest point (its
// normal cone), scaled so that a vertex of one body inside a face of the other carries its share in that face. This
// measure of a convex body changes continuously with the body (Schneider, Convex Bodies, section 4.2), so corners may
// appear, merge and vanish without a jump. Where edges cross, the scale is interpolated between their four ends.
//
// Shares that change with the direction ask for a torque, as on a half-space: all points are shifted along the contact
// plane to supply it.
void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, PolytopeManifoldScratch &scratch,
                      std::vector<ContactPoint> &points);

}  // namespace cmb
