// What contacts of bodies that are level with each other have to be: the same in every frame and with the bodies exchanged, the gradient of
// their energy, without jumps, near the bodies, there where these overlap and nowhere else. Random poses never meet these.
//
// The force is the sum of weight * depth * normal at the contact points: stiffness 1, exponent 1.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "aligned_kinds.hpp"

namespace cmb::aligned {

// Two kinds; where one of them is ground it is the second.
struct KindPair {
  const Kind *a, *b;
};

// Each unordered pair once, ground second.
std::vector<KindPair> all_pairs();

enum class Property {
  same_in_frames,     // bodies moved together
  same_exchanged,
  gradient,           // of the energy, between the slopes to either side
  steady,             // next to the pose
  near_bodies,        // where its points are
  found,              // a load where the bodies overlap, and about as deep as they do
  apart               // none where they do not
};
constexpr int property_count = 7;
const char *name_of(Property property);

struct Tally {
  int poses = 0, apart = 0;
  struct Failures {
    int count = 0;
    double worst = 0.0;  // by what is allowed
    int worst_pose = 0;
    struct Pose {
      int number;
      double error;
    };
    std::vector<Pose> poses;
  } of[property_count];
  const Failures &operator[](Property property) const { return of[static_cast<int>(property)]; }
};

// Faces, edges, corners or axes along each other or in one plane, middles, sides and corners over each other, by rounding or some
// 1e-15 to 1e-9 off; 1e-12 to 0.1 of the thinner body's thickness deep, or as far apart.
Tally sample_aligned(const KindPair &kinds, int poses, std::uint64_t seed);

// What is known to fail in some poses, and in which share of them at most (docs/engine/limits.md).
struct KnownFailure {
  const char *a, *b;
  Property property;
  double share;
};
// Null where nothing is known.
const KnownFailure *known_failure(const KindPair &kinds, Property property);

// What one of the sample's poses is, and its contact and errors.
std::string describe(const KindPair &kinds, std::uint64_t seed, int pose);

}  // namespace cmb::aligned
