// Gauss' rule: what follows from its nodes.
#include "math/gauss_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_bodies.hpp"

namespace test_gauss_rule {
namespace {

using cmb::overlap::gauss_rule;
using cmb::overlap::GaussNodes;
using cmb::overlap::NodeTurns;
using random_bodies::Random;

TEST(GaussNodes, TurnByTheirPartsOfAnAngle) {
  Random random(1);
  for (const GaussNodes &rule : {GaussNodes(gauss_rule<5>), GaussNodes(gauss_rule<8>), GaussNodes(gauss_rule<15>), GaussNodes(gauss_rule<16>)}) {
    ASSERT_LE(rule.count, NodeTurns::most);
    for (int sample = 0; sample < 200; ++sample) {
      const double angle = sample % 2 == 0 ? random.uniform(-7.0, 7.0) : random.uniform(-1.1, 1.1);
      const NodeTurns turns(rule, angle, std::cos(angle), std::sin(angle));
      for (std::size_t k = 0; k < rule.count; ++k) {
        EXPECT_NEAR(turns.cosine[k], std::cos(rule.node[k] * angle), 1e-15) << angle;
        EXPECT_NEAR(turns.sine[k], std::sin(rule.node[k] * angle), 1e-15) << angle;
      }
    }
  }
}

}  // namespace
}  // namespace test_gauss_rule
