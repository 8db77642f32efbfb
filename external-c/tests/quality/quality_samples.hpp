// Samples of what contact forces have to be: work around closed paths, jumps along paths, the same in every frame, at places near the bodies.
//
// The force is the sum of weight * depth * normal at the contact points: stiffness 1, exponent 1.
#pragma once

#include <cstdint>
#include <functional>

#include "quality_kinds.hpp"
#include "support/poses.hpp"

namespace cmb::quality {

// Two kinds; where one of them is ground it is the second.
struct KindPair {
  const Kind *a, *b;
};

struct LoopWork {
  double mean = 0.0, worst = 0.0;  // |work| as a part of the largest elastic energy on the path
  std::uint64_t worst_seed = 0;
  int paths = 0;
};

// The work along random closed paths of A, all six degrees of freedom, around poses `deep` times the smaller size in B, moved
// by as much and turned by up to about `turn` (rad). `steps` points a path, and more where the power is steep (ClosedWork). A `factor` by A's
// pose spoils all forces and moments.
using ForceFactor = std::function<double(const test::BodyPose &)>;
LoopWork sample_loops(const KindPair &kinds, double deep, double turn, int paths, int steps, std::uint64_t seed,
                      const ForceFactor &factor = {});

struct Jumps {
  double worst = 0.0;          // the largest jump of load and moment, as a part of the largest load on its path
  std::uint64_t worst_seed = 0;
  double worst_place = 0.0;    // along its path, 0 to 1
  int paths = 0, jumping = 0;  // paths with a jump above 1e-4 no deeper than a quarter of the thinner body
};

// Random paths of A beside B, which is less deep than `deep` times the thinner body's thickness at some places.
Jumps sample_jumps(const KindPair &kinds, double deep, int paths, int steps, std::uint64_t seed);

struct FrameError {
  double worst = 0.0;  // |change| of load and moment about the contact, as a part of the load (and the size)
  std::uint64_t worst_seed = 0;
  int poses = 0;
  // The same, by what moving A as little as rounding moves it changes (over 1e-9): a sliver's contact changes much.
  double worst_by_rounding = 0.0;
};

// Contacts of up to a twentieth of the thinner body, and both bodies moved together.
FrameError sample_frames(const KindPair &kinds, int poses, std::uint64_t seed);

// How far contact points lie from the smaller body: from the middle of its bounding sphere, by that sphere's radius.
struct FarPoints {
  static constexpr double limits[3] = {1.5, 3.0, 10.0};
  int poses = 0, points = 0;
  int beyond[3] = {};        // points farther than the limits
  double farthest = 0.0;     // by radii
  double load_there = 0.0;   // of the farthest point, as a part of all points'
  std::uint64_t worst_seed = 0;
};

// Poses of all orientations, level ones and some between, A in B by 1e-7 to 0.3 times the thinner body's thickness.
FarPoints sample_far_points(const KindPair &kinds, int poses, std::uint64_t seed);

}  // namespace cmb::quality
