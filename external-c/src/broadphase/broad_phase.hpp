// From bodies at their poses to the few pairs of shapes that may touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shape/bounds.hpp"
#include "broadphase/collision_filter.hpp"
#include "broadphase/near_pairs.hpp"
#include "scene/scene.hpp"

namespace cmb {

// Two shapes whose bounds overlap, of bodies body_a < body_b that the filter lets touch. All numbers are 0-based.
struct Candidate {
  std::uint32_t body_a, body_b, shape_a, shape_b;
};

// Where the bounds of a shape begin and end along the first axis.
struct Extent {
  double low, high;
  std::uint32_t body, shape;
};

// Room that a search works in; one for each thread.
struct BroadPhaseScratch {
  std::vector<Pose> body_poses, shape_poses;
  std::vector<Bounds> bounds;
  NearPairs near;
  std::vector<Candidate> found;
  std::vector<Extent> extents;
  std::vector<std::size_t> row_end;
  std::vector<Candidate> candidates;
};

// Immutable; shared by threads. Keeps its scene.
class BroadPhase {
 public:
  // The filter has as many bodies as the scene.
  BroadPhase(std::shared_ptr<const Scene> scene, CollisionFilter filter);

  const Scene &scene() const { return *scene_; }
  const CollisionFilter &filter() const { return filter_; }
  std::size_t body_count() const { return scene_->bodies.size(); }

  // Fills scratch.candidates, sorted by body_a, body_b, shape_a, shape_b, and the shapes' poses in the world, for the
  // bodies' poses there, scratch.body_poses. The result depends on these alone.
  void find_candidates(BroadPhaseScratch &scratch) const;

  // The same where there were no other bodies than these, 0-based and ascending: the poses of others are not looked at.
  void find_candidates_among(const std::vector<std::uint32_t> &bodies, BroadPhaseScratch &scratch) const;

  // Radius of a ball about the origin of a body's frame that holds the body; infinite for half-spaces, 0 of nothing.
  double radius_about_origin(std::size_t body) const;

  // Where the shapes of a body begin in scratch.shape_poses.
  std::size_t first_shape(std::size_t body) const { return first_shape_[body]; }

 private:
  struct Proxy {
    std::uint32_t body, shape;
  };

  void place_shapes(BroadPhaseScratch &scratch) const;
  void place_shapes_of(std::size_t body, BroadPhaseScratch &scratch) const;
  bool are_near(std::size_t i, std::size_t j, const BroadPhaseScratch &scratch) const;
  void sweep_among(const std::vector<std::uint32_t> &bodies, BroadPhaseScratch &scratch) const;
  void find_candidates_of(std::uint32_t a, std::uint32_t b, BroadPhaseScratch &scratch) const;
  void emit(const Proxy &a, const Proxy &b, std::vector<Candidate> &found) const;
  void sort_candidates(BroadPhaseScratch &scratch) const;

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const void> identity_;  // unlike that of any other, also one that takes this one's place in memory
  CollisionFilter filter_;
  std::vector<std::size_t> first_shape_;     // of each body, and the number of all shapes
  std::vector<const Shape *> shapes_;        // all of them
  std::vector<double> ball_radius_;          // of all shapes; 0 of those whose bounds are no ball about their origin
  std::vector<char> is_where_body_is_;       // of all shapes
  std::vector<Proxy> bounded_, halfspaces_;  // all shapes
  std::vector<LocalBounds> local_bounds_;    // of the bounded ones
};

}  // namespace cmb
