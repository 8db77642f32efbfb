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

// Room that a search works in; one for each thread.
struct BroadPhaseScratch {
  std::vector<Pose> body_poses, shape_poses;
  std::vector<Bounds> bounds;
  NearPairs near;
  std::vector<Candidate> found;
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

  // Where the shapes of a body begin in scratch.shape_poses.
  std::size_t first_shape(std::size_t body) const { return first_shape_[body]; }

 private:
  struct Proxy {
    std::uint32_t body, shape;
  };

  void place_shapes(BroadPhaseScratch &scratch) const;
  void emit(const Proxy &a, const Proxy &b, std::vector<Candidate> &found) const;
  void sort_candidates(BroadPhaseScratch &scratch) const;

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const void> identity_;  // unlike that of any other, also one that takes this one's place in memory
  CollisionFilter filter_;
  std::vector<std::size_t> first_shape_;     // of each body, and the number of all shapes
  std::vector<char> is_where_body_is_;       // of all shapes
  std::vector<Proxy> bounded_, halfspaces_;  // all shapes
  std::vector<LocalBounds> local_bounds_;    // of the bounded ones
  std::vector<char> is_ball_;                // whose bounds are a ball about its origin
};

}  // namespace cmb
