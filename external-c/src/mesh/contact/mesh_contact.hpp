// Contact of a mesh with other bodies. Points and normals as ContactSet says, the mesh being the second body: normals
// point out of the mesh. One-sided: the front of a triangle pushes, its back does not.
#pragma once

#include <cstdint>
#include <vector>

#include "manifold/contact_set.hpp"
#include "mesh/elastic/elastic_points.hpp"
#include "mesh/elastic/pair_overlap.hpp"
#include "mesh/elastic/round_overlap.hpp"
#include "mesh/elastic/wedge_overlap.hpp"
#include "mesh/contact/sheet_patches.hpp"
#include "mesh/contact/patch_load.hpp"
#include "mesh/contact/shared_load.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "narrowphase/convex_distance.hpp"
#include "shape/polytope.hpp"

namespace cmb::mesh {

// Room that queries work in; one for each thread. Grows in the first calls.
struct MeshContactScratch {
  SharedLoad shared;
  std::vector<Vec3> body_vertices, body_normals;  // in the mesh's frame
  PatchScratch patch;
  OverlapScratch overlap;
  RoundOverlapScratch round;
  ElasticScratch elastic;
  PlacedVertexScratch placed;
  PairOverlapScratch pair_overlap;
  Crossings crossings;
  std::vector<std::uint8_t> components;  // of a mesh: which ones count
  SheetPatchScratch sheets;
  ContactSet reaction;  // what the other mesh of a pair pushes
  ContactSet opposite;  // what a pair of equally large meshes is from the other one
};

// A ball. `center` in world axes. Apart, distance is that of the nearest place. Touching, there is a point for each
// place of the mesh that is nearer than those around it (in a groove more than one), and they share the load as
// SharedLoad says. Continuous down to a depth of half the radius. On a plane, whatever its triangulation: depth and
// normal of the ball on a half-space, weight 1. Sheets
// have no inside: a ball that passes through one from behind is pushed by the part that has come through, beside their rims away from them
// and to the front.
void sphere_contact(const Vec3 &center, double radius, const TriangleMesh &mesh, const Pose &pose,
                    MeshContactScratch &scratch, ContactSet &result);

// A convex polytope. Its overlap with the triangles' wedges stores an energy, whose gradient are force and torque of the points
// (WedgeOverlap, append_elastic_points). Neither depends on how a face is cut into triangles (of faces that are not convex within
// the depth of a sharp edge they do). Depths count down to half the thickness of what lies behind a triangle.
void polytope_contact(const convex::Polytope &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                      MeshContactScratch &scratch, ContactSet &result);

// Distance, normal and witness alone, of a polytope that does not touch the mesh: sooner found than from the polytope's own triangles.
void polytope_clearance(const convex::Polytope &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                        MeshContactScratch &scratch, ContactSet &result);

// An ellipsoid, a cylinder, a cone or a capsule: the same, by its exact overlap (RoundOverlap). On a plane an ellipsoid, and a capsule that
// lies, has depth, normal and, shallow, weight of that on a half-space; cylinders and cones push as on a box.
void smooth_contact(const convex::ConvexBody &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                    MeshContactScratch &scratch, ContactSet &result);

// Two meshes, A and B; normals point out of B. What a closed mesh overlaps behind the triangles of the other one stores an energy as a
// polytope does (PairOverlap): behind those of a sheet, or of two closed ones of the larger one; of two equally large ones behind those of
// both, half each. Two sheets touch where they cross, and push each other, half each. Exchanging meshes gives the same points with normals
// reversed.
void mesh_pair_contact(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                       MeshContactScratch &scratch, ContactSet &result);
// The same where they touch; false, with a result of no use, where they do not.
bool mesh_pair_touch(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                     MeshContactScratch &scratch, ContactSet &result);

}  // namespace cmb::mesh
