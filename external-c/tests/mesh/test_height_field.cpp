// Height fields: geometry, contact, and refusal of bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/contact/mesh_contact.hpp"
#include "mesh/core/height_field.hpp"

namespace test_height_field {
namespace {

using cmb::convex::Vec3;
using cmb::mesh::height_field;
using cmb::mesh::MeshError;
using cmb::mesh::MeshUse;
using cmb::mesh::TriangleMesh;

TEST(HeightField, InclineCarriesABallAlongItsNormal) {
  std::vector<double> heights;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 9; ++i) heights.push_back(0.5 * 0.25 * (i - 4) + 0.2 * 0.5 * (j - 2.5));
  }
  const TriangleMesh field(height_field(9, 6, 0.25, 0.5, heights, "field"), MeshUse::any, "field");
  EXPECT_FALSE(field.closed());
  const Vec3 normal = normalized(Vec3{-0.5, -0.2, 1.0});
  cmb::mesh::MeshContactScratch scratch;
  for (int k = 0; k < 1000; ++k) {
    const double x = -0.6 + 0.0012 * k, y = 0.7 * std::sin(0.01 * k);
    const Vec3 foot{x, y, 0.5 * x + 0.2 * y};
    cmb::ContactSet set;
    sphere_contact(foot + 0.25 * normal, 0.3, field, {}, scratch, set);
    ASSERT_EQ(set.points.size(), 1u);
    ASSERT_NEAR(set.points[0].depth, 0.05, 1e-14);
    ASSERT_NEAR(set.points[0].weight, 1.0, 1e-12);
    ASSERT_NEAR(norm(set.points[0].normal - normal), 0.0, 1e-12);
  }
}

TEST(HeightField, RidgesStayWhole) {
  // Along both diagonals of a cell.
  for (const bool rising : {true, false}) {
    const std::vector<double> heights = rising ? std::vector<double>{1, 0, 0, 1} : std::vector<double>{0, 1, 1, 0};
    const TriangleMesh field(height_field(2, 2, 2.0, 2.0, heights, "field"), MeshUse::any, "field");
    EXPECT_NEAR(field.nearest({0, 0, 1.5}).distance, 0.5, 1e-15);
  }
}

std::string refusal(std::size_t columns, std::size_t rows, double spacing, const std::vector<double> &heights) {
  try {
    height_field(columns, rows, spacing, 1.0, heights, "ground");
  } catch (const MeshError &error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(HeightField, BadOnesAreRefused) {
  EXPECT_EQ(refusal(1, 4, 1.0, {0, 0, 0, 0}).find("ground: fewer than 2 x 2"), 0u);
  EXPECT_EQ(refusal(2, 2, 1.0, {0, 0, 0}).find("ground: 3 heights where 2 x 2 are 4"), 0u);
  EXPECT_EQ(refusal(2, 2, 0.0, {0, 0, 0, 0}).find("ground: a spacing"), 0u);
  EXPECT_EQ(refusal(2, 2, std::nan(""), {0, 0, 0, 0}).find("ground: a spacing"), 0u);
  EXPECT_EQ(refusal(2, 2, 1.0, {0, 0, std::nan(""), 0}).find("ground: height 3 is not"), 0u);
  EXPECT_EQ(refusal(3000, 3000, 1.0, {}).find("ground: more than 5000000"), 0u);
  EXPECT_EQ(refusal(std::numeric_limits<std::size_t>::max(), 2, 1.0, {}).find("ground: more than 5000000"), 0u);
}

}  // namespace
}  // namespace test_height_field
