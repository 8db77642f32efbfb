// What contact points on meshes store changes without jumps, as their load does: damping and the manager's energy are by points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_stored_energy {
namespace {

using namespace cmb::test;
using random_bodies::Random;
using random_bodies::random_rotation;

std::string ground(const std::string &name) {
  if (name == "step") return mesh_samples::height_field_text(2, 9, [](double x, double) { return x < 0.0 ? 0.0 : 0.2; });
  if (name == "hills") return mesh_samples::height_field_text(2, 17, [](double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(4 * y); });
  // A block with a step as high as bodies are deep, whose wall begins to push without much load where a body comes to it.
  if (name == "ledge") {
    return "cmb/1 mesh vertices=-0.5,-0.5,-0.3,0.5,-0.5,-0.3,0.5,-0.5,-0.036,0,-0.5,-0.036,0,-0.5,-0.02,-0.5,-0.5,-0.02,"
           "-0.5,0.5,-0.3,0.5,0.5,-0.3,0.5,0.5,-0.036,0,0.5,-0.036,0,0.5,-0.02,-0.5,0.5,-0.02 "
           "triangles=1,2,3,1,3,4,1,4,5,1,5,6,7,9,8,7,10,9,7,11,10,7,12,11,1,8,2,1,7,8,2,9,3,2,8,9,3,10,4,3,9,10,4,11,5,4,10,11,5,12,6,5,11,12,"
           "6,7,1,6,12,7";
  }
  return mesh_samples::mesh_text(mesh_samples::angle_prism({-1, 1, 1, 0.1, 0.1, -1}, {-1, -1, 0.1, 0.1, 1, 1}, -0.5, 0.1));
}

std::string body(const std::string &kind, Random &random) {
  const auto length = [&] { return digits(random.uniform(0.1, 0.5)); };
  const std::string a = length(), b = length(), c = length();
  if (kind == "box" || kind == "ellipsoid") return "cmb/1 " + kind + " size=" + a + "," + b + "," + c;
  return "cmb/1 " + kind + " radius=" + digits(random.uniform(0.05, 0.25)) + " length=" + b;
}

double stored(const Contact &contact) {
  double sum = 0.0;
  for (const Point &point : contact.points) sum += 0.5 * point.weight * point.depth * point.depth;
  return sum;
}

using Kinds = std::tuple<std::string, std::string>;
class StoredEnergy : public testing::TestWithParam<Kinds> {};

TEST_P(StoredEnergy, DoesNotJump) {
  const auto &[kind, on] = GetParam();
  Random random(7);
  constexpr int bodies = 5, paths = 10, samples = 120, suspects = 4;
  int followed = 0;
  for (int k = 0; k < bodies; ++k) {
    const std::string text = body(kind, random);
    const PairScene scene(text, ground(on));
    for (int path = 0; path < paths; ++path) {
      BodyPose begin{{random.uniform(-0.15, 0.15), random.uniform(-0.3, 0.3), 1.2}, random_rotation(random)};
      const double deep = random.log_uniform(1e-4, 0.03);
      for (int step = 0; step < 60; ++step) {
        const double more = scene.query(begin, {}).distance + deep;
        if (std::fabs(more) < 0.1 * deep || begin.position.z < -2.0) break;
        begin.position.z -= more;
      }
      if (begin.position.z < -2.0) continue;  // beside the ground
      const Vec3 way = 3.0 * deep * random.direction(), axis = random.direction();
      const auto energy = [&](double s) {
        const BodyPose pose{begin.position + s * way, product(rotation_about(axis, 10.0 * deep * s), begin.rotation)};
        return stored(scene.query(pose, {}, 64));
      };
      std::vector<std::pair<double, double>> intervals;
      double last = energy(0.0), largest = last;
      for (int i = 1; i <= samples; ++i) {
        const double next = energy(static_cast<double>(i) / samples);
        intervals.emplace_back(std::fabs(next - last), static_cast<double>(i - 1) / samples);
        largest = std::fmax(largest, next), last = next;
      }
      if (!(largest > 0.0)) continue;
      ++followed;
      std::sort(intervals.rbegin(), intervals.rend());
      for (int i = 0; i < suspects; ++i) {
        double from = intervals[static_cast<std::size_t>(i)].second, to = from + 1.0 / samples, jump = 0.0;
        for (int halving = 0; halving < 24; ++halving) {
          const double middle = 0.5 * (from + to), at_middle = energy(middle);
          const double first = std::fabs(at_middle - energy(from)), second = std::fabs(energy(to) - at_middle);
          jump = std::fmax(first, second);
          (first > second ? to : from) = middle;
        }
        EXPECT_LT(jump, 1e-4 * largest) << text << ", path " << path << " at " << from;
      }
    }
  }
  EXPECT_GT(followed, 30);
}

INSTANTIATE_TEST_SUITE_P(OnMeshes, StoredEnergy,
                         testing::Combine(testing::Values("box", "ellipsoid", "cylinder", "cone", "capsule"), testing::Values("step", "hills", "angle", "ledge")),
                         [](const auto &info) { return std::get<0>(info.param) + "On" + std::get<1>(info.param); });

}  // namespace
}  // namespace test_stored_energy
