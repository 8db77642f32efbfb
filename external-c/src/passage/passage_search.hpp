// Bodies that pass through each other, or through each other's edge, between the ends of an integrator's step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "broadphase/collision_filter.hpp"
#include "contact_multibody_scene.h"
#include "passage/closing_speed.hpp"
#include "scene/scene.hpp"

namespace cmb {

// All bodies at a moment of a step.
struct Moment {
  double share = 0.0;              // of the step
  const double *numbers = nullptr;  // as in cmb_step
};

// A pair of bodies that may have met within a part of a step.
struct WatchedPair {
  std::uint32_t a, b;
  double thickness;          // of the thinner body, m
  TurningReach reach_a, reach_b;
  double start;              // signed distance where the step begins,
  double begin, end;         // and at both ends of its part
};

// One search; keeps references to its arguments.
class PassageSearch {
 public:
  PassageSearch(const Scene &scene, const cmb_step &step) : scene_(scene), step_(step) {}

  // Of the scene's own pairs.
  bool find(cmb_passage &passage);
  // Of all pairs of these bodies, 0-based and ascending, that the filter lets touch.
  bool find_among(const std::vector<std::uint32_t> &bodies, const CollisionFilter &filter, cmb_passage &passage);

 private:
  BodyMotion motion_of(std::size_t body, const Moment &moment) const;
  ClosingSpeed speed(const WatchedPair &pair, const Moment &moment) const;
  double way(const WatchedPair &pair, const Moment &begin, const Moment &end) const;
  double distance(const WatchedPair &pair, const Moment &moment, double exact_within) const;
  bool has_met(const WatchedPair &pair) const;
  bool may_pass(const WatchedPair &pair, double way) const;
  double fastest(std::size_t body) const;
  void watch(std::size_t a, std::size_t b);
  bool take(double share, std::vector<double> &room, Moment &moment) const;
  bool search(const Moment &begin, const Moment &end, const std::vector<WatchedPair> &pairs, cmb_passage &passage) const;
  bool locate_first(const std::vector<WatchedPair> &pairs, double from, double until, cmb_passage &passage) const;
  bool locate(const WatchedPair &pair, double from, double until, cmb_passage &passage) const;

  const Scene &scene_;
  const cmb_step &step_;
  std::vector<WatchedPair> watched_;
};

}  // namespace cmb
