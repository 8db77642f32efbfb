// The weight of a facet's part in the ball, against a sum over angles round the foot, along each of which it is known.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "narrowphase/polytope/mean_normal.hpp"
#include "support/random_bodies.hpp"

namespace {

using namespace cmb::convex;
using random_bodies::Random;

// A plane's axes; places in it are given by x and y from the foot.
struct Plane {
  Vec3 x, y, normal;
  double height;
  Vec3 at(double along_x, double along_y) const { return height * normal + along_x * x + along_y * y; }
};

Plane random_plane(Random &random, double height) {
  const Mat3 rotation = random_bodies::random_rotation(random);
  return {rotation.column(0), rotation.column(1), rotation.column(2), height};
}

struct Place {
  double x, y;
};

// Of (limit2 - r^2)^2 over the part of a convex polygon that is within r^2 < limit2: along the ray at each angle the
// integral of that times r is a cubic of r^2.
double reference(const std::vector<Place> &polygon, double limit2) {
  constexpr int angles = 200000;
  constexpr double step = 2.0 * 3.14159265358979323846 / angles;
  double sum = 0.0;
  for (int k = 0; k < angles; ++k) {
    const double cosine = std::cos((k + 0.5) * step), sine = std::sin((k + 0.5) * step);
    double begin = 0.0, end = std::sqrt(limit2);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      // Inside is where off + rate r >= 0.
      const double off = p.x * q.y - p.y * q.x;
      const double rate = (q.x - p.x) * sine - (q.y - p.y) * cosine;
      if (rate > 0.0) begin = std::max(begin, -off / rate);
      if (rate < 0.0) end = std::min(end, -off / rate);
      if (rate == 0.0 && off < 0.0) end = 0.0;
    }
    const auto rest = [&](double r) { return std::pow(limit2 - r * r, 3) / 6.0; };
    if (begin < end) sum += step * (rest(begin) - rest(end));
  }
  return sum;
}

double integral(const Plane &plane, const std::vector<Place> &polygon, double radius) {
  std::vector<Vec3> corners;
  for (const Place &place : polygon) corners.push_back(plane.at(place.x, place.y));
  FacetIntegral result(plane.normal, plane.height, radius);
  result.add_rim(static_cast<std::int32_t>(corners.size()),
                 [&](std::int32_t k) -> const Vec3 & { return corners[static_cast<std::size_t>(k)]; });
  return result.value();
}

// A convex polygon of corners on an ellipse.
std::vector<Place> random_polygon(Random &random, int corners) {
  const double middle_x = random.uniform(-1.5, 1.5), middle_y = random.uniform(-1.5, 1.5);
  const double half_x = random.uniform(0.05, 2.5), half_y = random.uniform(0.05, 2.5);
  std::vector<double> angles;
  for (int k = 0; k < corners; ++k) angles.push_back(random.uniform(0.0, 6.28));
  std::sort(angles.begin(), angles.end());
  std::vector<Place> polygon;
  for (const double angle : angles) {
    polygon.push_back({middle_x + half_x * std::cos(angle), middle_y + half_y * std::sin(angle)});
  }
  return polygon;
}

// The disc that the ball cuts out of the plane has radius 1: polygons within, over its border, round it and beside it.
TEST(FacetIntegral, IsTheIntegralOverThePartInTheBall) {
  Random random(1);
  int without = 0, with_all = 0;
  constexpr double whole = 3.14159265358979323846 / 3.0;
  for (int sample = 0; sample < 200; ++sample) {
    const double height = random.uniform(0.0, 2.0);
    const std::vector<Place> polygon = random_polygon(random, random.integer(3, 9));
    const double expected = reference(polygon, 1.0);
    const double found = integral(random_plane(random, height), polygon, std::sqrt(1.0 + height * height));
    EXPECT_NEAR(found, expected, 1e-8) << sample;
    without += expected == 0.0;
    with_all += expected > 0.999 * whole;
  }
  EXPECT_GT(without, 10);
  EXPECT_GT(with_all, 1);
}

// Corners and edges through the foot, where angles round it are not defined.
TEST(FacetIntegral, CornersAndEdgesThroughTheFoot) {
  constexpr double whole = 3.14159265358979323846 / 3.0, radius = 1.4142135623730951, rounding = 1e-14;
  const Plane plane{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1.0};
  EXPECT_NEAR(integral(plane, {{0, 0}, {5, 0}, {5, 5}, {0, 5}}, radius), 0.25 * whole, rounding);
  EXPECT_NEAR(integral(plane, {{-5, 0}, {5, 0}, {5, 5}, {-5, 5}}, radius), 0.5 * whole, rounding);
  EXPECT_NEAR(integral(plane, {{0, 0}, {5, 0}, {-5, 5}}, radius), 0.375 * whole, rounding);
  EXPECT_NEAR(integral(plane, {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, radius), whole, rounding);
  EXPECT_NEAR(integral(plane, {{1, -5}, {5, -5}, {5, 5}, {1, 5}}, radius), 0.0, rounding);
  // A corner given twice.
  EXPECT_NEAR(integral(plane, {{0, 0}, {5, 0}, {5, 5}, {5, 5}, {0, 5}}, radius), 0.25 * whole, rounding);
}

}  // namespace
