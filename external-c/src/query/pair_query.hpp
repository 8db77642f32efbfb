// The contact of a pair of bodies.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"
#include "manifold/convex_manifold.hpp"
#include "math/body_pose.hpp"
#include "query/mesh_query.hpp"
#include "scene/scene.hpp"

namespace cmb {

// Two shapes of two bodies, by their numbers, whose bounds do not overlap.
struct ShapesApart {
  std::size_t first, second;
  double at_least;  // their distance, m
};

// Room that queries work in; one for each thread.
struct QueryScratch {
  BackendScratch backend;
  ManifoldScratch manifold;
  MeshQueryScratch mesh;
  ContactSet contact;
  ContactSet shape_contact;
  std::vector<Pose> body_poses;        // of a scene
  std::vector<Pose> poses_a, poses_b;  // of the shapes of two compounds
  std::vector<Vec3> centers_a, centers_b;  // of their bounding spheres
  std::vector<ShapesApart> apart;      // of them
  Pose placed_a, placed_b;             // of two single shapes that are not where their bodies are
  SignedDistance answer;                 // kept here, where it need not be cleared for each pair
};

// This thread's scratch.
QueryScratch &query_scratch();

// What a pair's query tells besides the contact.
struct PairReport {
  cmb_backend backend = CMB_BACKEND_AUTO;  // who answered for the nearest shapes; AUTO where there are none
};

// The contact of two shapes, not both half-spaces, at their poses in the world: writes distance, normal and witness of
// `result` and appends to its points. `who` receives the back end that answered.
void query_shapes(const Scene &scene, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  QueryScratch &scratch, ContactSet &result, cmb_backend &who);

// The contact of bodies a and b of the scene, 0-based; `result` is overwritten. Bodies without shape, and pairs of half-spaces, never
// touch: their distance is CMB_DISTANCE_NONE. Shapes farther apart than `exact_within` (m) are treated as
// cmb_query_scene says.
void query_bodies(const Scene &scene, std::size_t a, const Pose &pose_a, std::size_t b, const Pose &pose_b,
                  QueryScratch &scratch, ContactSet &result, PairReport &report,
                  double exact_within = std::numeric_limits<double>::infinity());

}  // namespace cmb
