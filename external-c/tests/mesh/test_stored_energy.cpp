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

// Balls that several places touch, of which edges and corners turn their normals as the ball moves: up to a quarter of their radius deep.
TEST(StoredEnergy, OfBallsHasTheirForceAsGradient) {
  Random random(11);
  const std::string roofs = mesh_samples::height_field_text(2, 9, [](double x, double) { return std::fabs(x - 0.5 * std::floor(2.0 * x) - 0.25); });
  for (const std::string &text : {roofs, ground("hills"), ground("step"), ground("ledge"), ground("angle")}) {
    int asked = 0, several = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const double radius = random.uniform(0.1, 0.6), deep = random.log_uniform(1e-3, 0.25) * radius;
      const PairScene scene("cmb/1 sphere radius=" + digits(radius), text);
      BodyPose pose{{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 2.0}, {}};  // not at the rims of sheets
      if (trial % 2 == 0) pose.position.x = 0.25 + 0.5 * random.integer(-1, 0) + random.uniform(-0.05, 0.05);  // between ridges
      for (int step = 0; step < 60 && pose.position.z > -2.0; ++step) pose.position.z -= scene.query(pose, {}, 64).distance + deep;
      const Contact contact = scene.query(pose, {}, 64);
      if (std::fabs(contact.distance + deep) < 1e-6 * deep) {
        ++asked, several += contact.points.size() > 1 ? 1 : 0;
        // A place that comes to touch within the step bends the force.
        const double step = 1e-4 * deep;
        for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
          const auto energy_at = [&](double length) { return scene.query({pose.position + length * way, {}}, {}, 64).energy(); };
          const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
          EXPECT_NEAR(dot(way, contact.load()), -slope, 2e-4 * norm(contact.load())) << text.substr(0, 40) << ", trial " << trial;
        }
      }
      cmb_release_scene(scene.handle());
    }
    EXPECT_GT(asked, 50) << text.substr(0, 40);
    if (text == roofs) {
      EXPECT_GT(several, 20);
    }
  }
}

// A ball that is moved along `from` until it is `deep` in B; nothing where that does not settle.
bool come_near(const PairScene &scene, const Vec3 &from, double deep, BodyPose &pose) {
  pose.position = pose.position + 2.0 * from;
  for (int step = 0; step < 80; ++step) {
    const double more = scene.query(pose, {}, 64).distance + deep;
    if (std::fabs(more) < 1e-9 * deep) return true;
    if (norm(pose.position) > 10.0) return false;
    pose.position = pose.position - more * from;
  }
  return false;
}

// Balls beside the borders and corners of sheets, level, rolling and steep, on the side of their fronts.
TEST(StoredEnergy, OfBallsBesideRimsHasTheirForceAsGradient) {
  Random random(17);
  struct Field {
    const char *name;
    double (*height)(double x, double y);
    double steep;  // rises less than this beside its borders
  };
  for (const auto &[name, height, steep] : {Field{"level", [](double, double) { return 0.0; }, 0.02},
                                            Field{"valley", [](double, double y) { return 0.4 * y * y; }, 0.85},
                                            Field{"ridge", [](double, double y) { return -0.4 * y * y; }, 0.85},
                                            Field{"hills", [](double x, double y) { return 0.1 * std::sin(5 * x) * std::cos(4 * y); }, 0.55}}) {
    const std::string text = mesh_samples::height_field_text(2, 9, height);
    int asked = 0, beside = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const double radius = random.uniform(0.1, 0.6), deep = random.log_uniform(1e-3, 0.25) * radius;
      const PairScene scene("cmb/1 sphere radius=" + digits(radius), text);
      const double far = random.uniform(0.9, 1.3), aside = random.integer(0, 2) == 0 ? random.uniform(0.9, 1.3) : random.uniform(-1, 1);
      BodyPose pose{trial % 2 == 0 ? Vec3{far, aside, 0} : Vec3{-aside, -far, 0}, {}};
      Vec3 from = random.direction();
      from.z = std::fabs(from.z);
      if (come_near(scene, from, deep, pose)) {
        const Contact contact = scene.query(pose, {}, 64);
        const double step = 1e-4 * deep;
        const double x = std::fmin(1.0, std::fmax(-1.0, pose.position.x)), y = std::fmin(1.0, std::fmax(-1.0, pose.position.y));
        if (pose.position.z - height(x, y) > steep * std::hypot(pose.position.x - x, pose.position.y - y)) {
          ++asked, beside += std::fmax(std::fabs(pose.position.x), std::fabs(pose.position.y)) > 1.0 + deep ? 1 : 0;
          for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            const auto energy_at = [&](double length) { return scene.query({pose.position + length * way, {}}, {}, 64).energy(); };
            const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
            EXPECT_NEAR(dot(way, contact.load()), -slope, 2e-4 * norm(contact.load())) << name << ", trial " << trial;
          }
        }
      }
      cmb_release_scene(scene.handle());
    }
    EXPECT_GT(asked, 150) << name;
    EXPECT_GT(beside, 50) << name;
  }
}

// From a rim's front side to that of its back a ball is pushed aside, and to the front; nowhere at once otherwise.
TEST(StoredEnergy, OfBallsAboutRimsGoesRoundThemWithoutAJump) {
  const PairScene scene("cmb/1 sphere radius=0.3", mesh_samples::height_field_text(2, 9, [](double, double) { return 0.0; }));
  Vec3 last;
  constexpr int steps = 20000;
  for (int k = 0; k <= steps; ++k) {
    const double turn = 3.14159265358979323846 * (0.5 - static_cast<double>(k) / steps), away = 0.28;
    const Vec3 load = scene.query({{1.0 + away * std::cos(turn), 0.1, away * std::sin(turn)}, {}}, {}, 64).load();
    EXPECT_NEAR(norm(load), 0.02, 1e-12);
    EXPECT_GE(load.x, -1e-12) << turn;
    EXPECT_GE(load.z, -1e-12) << turn;
    if (k > 0) {
      EXPECT_LT(norm(load - last), 1e-5) << turn;
    }
    last = load;
  }
}

// Bodies of some hundred metres that touch a mesh of two, less deep than rounding lets squares of places be known.
TEST(StoredEnergy, OfShallowContactsOfGreatBodiesHasTheirForceAsGradient) {
  Random random(13);
  const std::string round = " radius=" + digits(300.0) + " length=";
  for (const std::string text : {"cmb/1 ellipsoid size=400,500,300", "cmb/1 cylinder", "cmb/1 cone", "cmb/1 capsule"}) {
    const PairScene scene(text.find('=') != std::string::npos ? text : text + round + digits(400.0), ground("angle"));
    int asked = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const double deep = random.log_uniform(1e-5, 1e-4);
      const Vec3 from = random.direction();
      BodyPose pose{1500.0 * from, random_rotation(random)};
      for (int step = 0; step < 100; ++step) {
        const double more = scene.query(pose, {}, 64).distance + deep;
        if (std::fabs(more) < 0.1 * deep) break;
        pose.position = pose.position - more * from;
      }
      const Contact contact = scene.query(pose, {}, 64);
      if (!(std::fabs(contact.distance + deep) < 0.1 * deep)) continue;
      ++asked;
      const double step = 1e-3 * deep;
      for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const auto energy_at = [&](double length) { return scene.query({pose.position + length * way, pose.rotation}, {}, 64).energy(); };
        const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
        EXPECT_NEAR(dot(way, contact.load()), -slope, 3e-3 * norm(contact.load())) << text << ", trial " << trial << ", " << deep << " deep";
      }
    }
    EXPECT_GT(asked, 20) << text;
  }
}

}  // namespace
}  // namespace test_stored_energy
