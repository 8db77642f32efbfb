// A slice of what `make contact-quality` samples: contact forces are the same in every frame, do not jump, are near the bodies, and where they are
// the gradient of an energy do no work around closed paths.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "quality_samples.hpp"

namespace {

using namespace cmb::quality;

struct Pair {
  const char *a, *b;
  KindPair kinds() const { return {find_kind(a), find_kind(b)}; }
};

void PrintTo(const Pair &pair, std::ostream *stream) { *stream << pair.a << ", " << pair.b; }

std::vector<Pair> pairs() {
  std::vector<Pair> result;
  for (std::size_t i = 0; i < all_kinds().size(); ++i) {
    for (std::size_t j = i; j < all_kinds().size(); ++j) {
      const Kind *a = &all_kinds()[i], *b = &all_kinds()[j];
      if (a->ground && b->ground) continue;
      if (a->ground) std::swap(a, b);
      result.push_back({a->name, b->name});
    }
  }
  return result;
}

class InFrames : public testing::TestWithParam<Pair> {};

TEST_P(InFrames, ForcesMoveWithTheBodies) {
  const FrameError frames = sample_frames(GetParam().kinds(), 12, 11);
  EXPECT_GT(frames.poses, 6);
  // What two surfaces as little as 1e-3 rad apart cut out of each other is a sliver, which poses tell no better than they are rounded.
  EXPECT_LT(frames.worst_by_rounding, 30.0) << "by " << frames.worst << " at pose " << frames.worst_seed;
}

INSTANTIATE_TEST_SUITE_P(AllPairs, InFrames, testing::ValuesIn(pairs()));

class ThinInFrames : public testing::TestWithParam<Pair> {};

// As deep as 1e-4 of a disc's thickness its border and that of the other body cut a sliver out of each other. It is known to rounding of its
// own size, not of the bodies'.
TEST_P(ThinInFrames, ForcesMoveWithTheBodies) {
  const FrameError frames = sample_frames(GetParam().kinds(), 100, 1);
  EXPECT_GT(frames.poses, 80);
  EXPECT_LT(frames.worst, 1e-7) << "at pose " << frames.worst_seed;
}

INSTANTIATE_TEST_SUITE_P(BluntCones, ThinInFrames,
                         testing::Values(Pair{"cone", "flat-cone"}, Pair{"cylinder", "flat-cone"}, Pair{"cone", "cone"},
                                         Pair{"cylinder", "cone"}));

class WithoutJumps : public testing::TestWithParam<Pair> {};

TEST_P(WithoutJumps, LoadsAreContinuous) {
  const Jumps jumps = sample_jumps(GetParam().kinds(), 0.1, 8, 300, 5);
  EXPECT_GT(jumps.paths, 3);
  EXPECT_EQ(jumps.jumping, 0) << "by " << jumps.worst << " on path " << jumps.worst_seed << " at " << jumps.worst_place;
}

INSTANTIATE_TEST_SUITE_P(Polytopes, WithoutJumps,
                         testing::Values(Pair{"box", "box"}, Pair{"box", "prism"}, Pair{"prism", "prism"}, Pair{"box", "hull-20"},
                                         Pair{"hull-20", "hull-100"}, Pair{"compound", "compound"}, Pair{"capsule", "capsule"},
                                         Pair{"capsule", "box"}, Pair{"capsule", "hull-20"}, Pair{"capsule", "cylinder"},
                                         Pair{"capsule", "cone"}));

INSTANTIATE_TEST_SUITE_P(Cones, WithoutJumps,
                         testing::Values(Pair{"flat-cone", "box"}, Pair{"flat-cone", "capsule"}, Pair{"flat-cone", "hull-20"},
                                         Pair{"flat-cone", "cylinder"}, Pair{"flat-cone", "flat-cone"},
                                         Pair{"slender-cone", "box"}, Pair{"cone", "cone"}, Pair{"cone", "flat-cone"},
                                         Pair{"cone", "slender-cone"}, Pair{"cylinder", "slender-cone"},
                                         Pair{"flat-cone", "slender-cone"}, Pair{"slender-cone", "slender-cone"}));

INSTANTIATE_TEST_SUITE_P(OnMeshes, WithoutJumps,
                         testing::Values(Pair{"capsule", "box-mesh"}, Pair{"capsule", "divided-box-mesh"},
                                         Pair{"capsule", "sphere-mesh"}, Pair{"capsule", "torus-mesh"},
                                         Pair{"capsule", "heightfield"}, Pair{"sphere", "heightfield"},
                                         Pair{"sphere", "torus-mesh"}, Pair{"box", "divided-box-mesh"},
                                         Pair{"cone", "divided-box-mesh"}, Pair{"box", "angle-mesh"},
                                         Pair{"capsule", "angle-mesh"}));

INSTANTIATE_TEST_SUITE_P(RoundOnMeshes, WithoutJumps,
                         testing::Values(Pair{"ellipsoid", "heightfield"}, Pair{"cylinder", "angle-mesh"}, Pair{"flat-cone", "angle-mesh"},
                                         Pair{"slender-cone", "torus-mesh"}));

INSTANTIATE_TEST_SUITE_P(MeshesWithEachOther, WithoutJumps,
                         testing::Values(Pair{"angle-mesh", "angle-mesh"}, Pair{"torus-mesh", "torus-mesh"}, Pair{"angle-mesh", "torus-mesh"},
                                         Pair{"torus-mesh", "heightfield"}, Pair{"sphere-mesh", "torus-mesh"}));

// Convex meshes are hulls.
INSTANTIATE_TEST_SUITE_P(ConvexMeshes, WithoutJumps,
                         testing::Values(Pair{"ellipsoid", "divided-box-mesh"}, Pair{"cylinder", "divided-box-mesh"},
                                         Pair{"box-mesh", "divided-box-mesh"}, Pair{"box-mesh", "sphere-mesh"},
                                         Pair{"divided-box-mesh", "angle-mesh"}));

class NearBodies : public testing::TestWithParam<Pair> {};

// Farther off, friction would do there what it does not do at the body. What lever a force has with its torque may be up to two radii.
TEST_P(NearBodies, PointsAreWhereTheyTouch) {
  const FarPoints far = sample_far_points(GetParam().kinds(), 300, 1);
  EXPECT_GT(far.poses, 240);
  EXPECT_LT(far.farthest, 3.0) << "at pose " << far.worst_seed << ", " << far.load_there << " of the load";
  EXPECT_LE(far.beyond[0], far.points / 500);
}

INSTANTIATE_TEST_SUITE_P(OnMeshes, NearBodies,
                         testing::Values(Pair{"ellipsoid", "angle-mesh"}, Pair{"capsule", "angle-mesh"}, Pair{"cylinder", "angle-mesh"},
                                         Pair{"box", "angle-mesh"}, Pair{"prism", "angle-mesh"}, Pair{"box-mesh", "angle-mesh"},
                                         Pair{"hull-20", "torus-mesh"}, Pair{"cylinder", "torus-mesh"}, Pair{"box", "heightfield"},
                                         Pair{"prism", "heightfield"}, Pair{"cone", "heightfield"}));

class Elastic : public testing::TestWithParam<Pair> {};

TEST_P(Elastic, DoesNoWorkAroundClosedPaths) {
  const LoopWork loops = sample_loops(GetParam().kinds(), 0.01, 0.01, 8, 1000, 3);
  EXPECT_GT(loops.paths, 4);
  EXPECT_LT(loops.worst, 1e-5) << "path " << loops.worst_seed;
}

INSTANTIATE_TEST_SUITE_P(Gradients, Elastic,
                         testing::Values(Pair{"box", "halfspace"}, Pair{"prism", "halfspace"}, Pair{"cylinder", "halfspace"},
                                         Pair{"sphere", "box"}, Pair{"ellipsoid", "box"}, Pair{"sphere", "cylinder"},
                                         Pair{"cylinder", "box"}, Pair{"cylinder", "hull-20"}, Pair{"cone", "box"}, Pair{"cone", "hull-100"},
                                         Pair{"flat-cone", "prism"}, Pair{"slender-cone", "hull-20"}, Pair{"cylinder", "box-mesh"},
                                         Pair{"box", "box"}, Pair{"prism", "prism"}, Pair{"hull-20", "hull-20"},
                                         Pair{"box", "box-mesh"}, Pair{"hull-20", "divided-box-mesh"}, Pair{"box", "sphere-mesh"},
                                         Pair{"hull-20", "torus-mesh"}, Pair{"box", "heightfield"}, Pair{"hull-20", "angle-mesh"},
                                         Pair{"ellipsoid", "divided-box-mesh"}, Pair{"capsule", "sphere-mesh"},
                                         Pair{"box-mesh", "divided-box-mesh"}, Pair{"sphere-mesh", "sphere-mesh"},
                                         Pair{"divided-box-mesh", "angle-mesh"}, Pair{"cylinder", "torus-mesh"}, Pair{"capsule", "torus-mesh"},
                                         Pair{"angle-mesh", "angle-mesh"}, Pair{"angle-mesh", "torus-mesh"}, Pair{"torus-mesh", "torus-mesh"},
                                         Pair{"angle-mesh", "heightfield"}, Pair{"torus-mesh", "heightfield"},
                                         Pair{"sphere-mesh", "torus-mesh"}, Pair{"flat-cone", "heightfield"},
                                         Pair{"slender-cone", "heightfield"}));

class ElasticBodies : public testing::TestWithParam<Pair> {
 protected:
  void expect_no_work_around(int paths) const {
    const LoopWork small = sample_loops(GetParam().kinds(), 0.01, 0.01, paths, 1000, 7);
    EXPECT_GT(small.paths, paths / 2);
    EXPECT_LT(small.worst, 1e-4) << "path " << small.worst_seed;
    EXPECT_LT(small.mean, 1e-5);
    const LoopWork large = sample_loops(GetParam().kinds(), 0.1, 0.5, paths, 1000, 7);
    EXPECT_GT(large.paths, paths / 2);
    EXPECT_LT(large.worst, 1e-2) << "path " << large.worst_seed;
    EXPECT_LT(large.mean, 1e-3);
  }
};

TEST_P(ElasticBodies, DoesNoWorkAroundClosedPaths) { expect_no_work_around(8); }

TEST_P(ElasticBodies, DoesNoWorkAroundManyClosedPaths) { expect_no_work_around(24); }

INSTANTIATE_TEST_SUITE_P(AllMeshes, ElasticBodies,
                         testing::Values(Pair{"box", "box-mesh"}, Pair{"box", "divided-box-mesh"}, Pair{"box", "sphere-mesh"},
                                         Pair{"box", "heightfield"}, Pair{"prism", "box-mesh"}, Pair{"prism", "heightfield"},
                                         Pair{"hull-20", "box-mesh"}, Pair{"hull-20", "divided-box-mesh"},
                                         Pair{"hull-20", "sphere-mesh"}, Pair{"hull-20", "heightfield"},
                                         Pair{"hull-100", "box-mesh"}, Pair{"hull-100", "heightfield"},
                                         Pair{"box-mesh", "divided-box-mesh"}, Pair{"box-mesh", "sphere-mesh"},
                                         Pair{"sphere-mesh", "sphere-mesh"}, Pair{"box-mesh", "heightfield"},
                                         Pair{"box", "angle-mesh"}, Pair{"ellipsoid", "sphere-mesh"}, Pair{"capsule", "divided-box-mesh"}));

INSTANTIATE_TEST_SUITE_P(RoundOnMeshes, ElasticBodies,
                         testing::Values(Pair{"ellipsoid", "angle-mesh"}, Pair{"cylinder", "angle-mesh"}, Pair{"cone", "heightfield"},
                                         Pair{"capsule", "angle-mesh"}, Pair{"capsule", "heightfield"}));

INSTANTIATE_TEST_SUITE_P(MeshesWithEachOther, ElasticBodies,
                         testing::Values(Pair{"angle-mesh", "angle-mesh"}, Pair{"angle-mesh", "torus-mesh"}, Pair{"angle-mesh", "heightfield"},
                                         Pair{"torus-mesh", "heightfield"}, Pair{"sphere-mesh", "angle-mesh"}));

INSTANTIATE_TEST_SUITE_P(Revolved, ElasticBodies,
                         testing::Values(Pair{"cylinder", "cylinder"}, Pair{"cylinder", "cone"}, Pair{"cone", "cone"},
                                         Pair{"cylinder", "slender-cone"}, Pair{"cone", "slender-cone"}, Pair{"cone", "flat-cone"}));

INSTANTIATE_TEST_SUITE_P(AllPolytopes, ElasticBodies,
                         testing::Values(Pair{"box", "box"}, Pair{"box", "prism"}, Pair{"prism", "prism"}, Pair{"box", "hull-20"},
                                         Pair{"prism", "hull-20"}, Pair{"hull-20", "hull-20"}, Pair{"hull-20", "hull-100"},
                                         Pair{"compound", "box"}));

INSTANTIATE_TEST_SUITE_P(Capsules, ElasticBodies, testing::Values(Pair{"capsule", "capsule"}, Pair{"capsule", "box"}, Pair{"capsule", "prism"},
                                         Pair{"capsule", "hull-20"}, Pair{"capsule", "hull-100"}, Pair{"capsule", "compound"},
                                         Pair{"capsule", "cylinder"}, Pair{"capsule", "cone"}, Pair{"capsule", "slender-cone"}));

// Many corners at once as well.
INSTANTIATE_TEST_SUITE_P(OnHalfSpaces, ElasticBodies,
                         testing::Values(Pair{"box", "halfspace"}, Pair{"prism", "halfspace"}, Pair{"hull-20", "halfspace"},
                                         Pair{"hull-100", "halfspace"}, Pair{"compound", "halfspace"}, Pair{"box-mesh", "halfspace"},
                                         Pair{"sphere-mesh", "halfspace"}, Pair{"torus-mesh", "halfspace"}));

}  // namespace
