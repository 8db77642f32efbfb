// The contact of a pair of bodies.
#pragma once

#include <cstddef>
#include <cstdint>
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

// A shape of a body, by its number, whose bounding sphere does not overlap that of another body.
struct ShapeAway {
  std::size_t number;
  double at_least;  // their distance, m
};

// Where the shapes of a compound and their bounding spheres are, for the pose that its body was last seen at: many pairs have
// a body in common.
struct PlacedShapes {
  std::uint64_t scene_number = 0;
  Pose body;
  std::vector<Pose> poses;
  std::vector<Vec3> centers;  // half-spaces have no bounding sphere; theirs is their origin
};

// Room that queries work in; one for each thread.
struct QueryScratch {
  BackendScratch backend;
  ManifoldScratch manifold;
  MeshQueryScratch mesh;
  ContactSet contact;
  ContactSet shape_contact;
  std::vector<Pose> body_poses;        // of a scene
  std::vector<PlacedShapes> placed;    // of the bodies of a scene, as far as they were asked for
  std::vector<ShapesApart> apart;      // of two compounds
  std::vector<ShapeAway> away;         // of a compound, from the other
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
