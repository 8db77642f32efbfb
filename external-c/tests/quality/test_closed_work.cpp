// Work around closed paths is seen as large as it is: of forces that are steep, and of those that are no gradient.
#include <gtest/gtest.h>

#include <cmath>

#include "closed_work.hpp"
#include "quality_samples.hpp"

namespace {

using namespace cmb::quality;

constexpr double pi = 3.14159265358979323846;

// Around the circle of radius 1 the energy E = 1 + tanh(y / width) / 2 has its whole slope within `width` of y = 0. Beside its gradient the force has
// along x the part `wrong` where y < 0, over a like width.
ClosedWork around_circle(double width, double wrong, int steps) {
  return closed_work(
      [=](double s) {
        const double x = std::cos(2 * pi * s), y = std::sin(2 * pi * s), t = std::tanh(y / width);
        const double fx = wrong * 0.5 * (1.0 - t), fy = -0.5 * (1.0 - t * t) / width;
        return PathPlace{2 * pi * (fy * x - fx * y), 1.0 + 0.5 * t};
      },
      steps);
}

TEST(ClosedWork, OfSteepEnergiesIsNone) {
  for (const double width : {1.0, 0.1, 1e-2, 1e-3}) {
    EXPECT_LT(std::fabs(around_circle(width, 0.0, 997).work), 1e-7) << width;
  }
}

// `wrong` times the way along x below y = 0, but for what the step's width takes.
TEST(ClosedWork, OfWhatIsNoGradientIsAllOfIt) {
  for (const double wrong : {1.0, 1e-3, 1e-5}) {
    for (const double width : {1e-2, 1e-3}) {
      const ClosedWork found = around_circle(width, wrong, 997);
      EXPECT_NEAR(found.work, 2.0 * wrong, 1e-2 * wrong + 1e-7) << wrong << ", " << width;
      EXPECT_NEAR(found.largest_energy, 1.5, 1e-6);
    }
  }
}

TEST(ClosedWork, OfForcesThatJumpIsAllOfIt) {
  const ClosedWork found = closed_work([](double s) { return PathPlace{s > 0.123456 && s < 0.3 ? 1.0 : 0.0, 1.0}; }, 100);
  EXPECT_NEAR(found.work, 0.3 - 0.123456, 1e-5);
}

// Contact forces that a factor spoils by 1 %, slowly or within a thousandth of the size: the work is the same with twice as many steps.
TEST(ClosedWork, OfSpoiledContactsIsSeen) {
  const KindPair kinds{find_kind("ellipsoid"), find_kind("angle-mesh")};
  EXPECT_LT(sample_loops(kinds, 0.01, 0.01, 8, 1000, 7).mean, 1e-6);
  for (const double waves : {100.0, 2000.0}) {
    const ForceFactor spoiled = [waves](const cmb::test::BodyPose &pose) { return 1.0 + 0.01 * std::sin(waves * pose.position.x); };
    const LoopWork work = sample_loops(kinds, 0.01, 0.01, 8, 1000, 7, spoiled), finer = sample_loops(kinds, 0.01, 0.01, 8, 2000, 7, spoiled);
    EXPECT_GT(work.mean, 3e-4) << waves;
    EXPECT_GT(work.worst, 1e-3) << waves;
    EXPECT_NEAR(work.mean, finer.mean, 1e-5) << waves;
  }
}

}  // namespace
