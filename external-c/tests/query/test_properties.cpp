// Properties that every pair of shapes has, at random poses about contact.
#include <random>
#include <sstream>

#include "support/engine_calls.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_properties {
namespace {

using namespace cmb::test;

// One of every kind, at length scale `s`.
std::vector<std::string> shapes(double s) {
  const auto kind = [](const std::string &name) { return "cmb/1 " + name + " "; };
  std::string hull = kind("hull") + "vertices=";
  const double points[][3] = {{0.4, 0.1, 0.1},   {-0.3, 0.4, 0.2},  {0.0, -0.5, 0.1}, {0.1, 0.2, 0.6},
                              {-0.2, -0.1, -0.4}, {0.35, -0.3, -0.2}, {0.2, 0.45, -0.1}};
  for (const auto &p : points) {
    for (const double x : p) hull += digits(s * x) + ",";
  }
  hull.pop_back();
  return {kind("halfspace"),
          kind("sphere") + "radius=" + digits(0.4 * s),
          kind("box") + "size=" + digits(0.6 * s) + "," + digits(0.8 * s) + "," + digits(s),
          kind("capsule") + "radius=" + digits(0.25 * s) + " length=" + digits(0.7 * s),
          hull,
          kind("ellipsoid") + "size=" + digits(s) + "," + digits(0.7 * s) + "," + digits(0.5 * s),
          kind("cylinder") + "radius=" + digits(0.3 * s) + " length=" + digits(0.8 * s),
          kind("cone") + "radius=" + digits(0.4 * s) + " length=" + digits(0.9 * s),
          kind("box") + "size=" + digits(0.5 * s) + "," + digits(0.5 * s) + "," + digits(0.1 * s) + ";" +
              kind("sphere") + "radius=" + digits(0.2 * s) + " position=0,0," + digits(0.3 * s)};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    // Not std::uniform_real_distribution: its values differ between libraries.
    return low + (high - low) * (static_cast<double>(engine_() >> 5) / 134217728.0);
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v{(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)};
      if (norm(v) > 0.1 && norm(v) < 1.0) return normalized(v);
    }
  }
  Mat3 rotation() { return rotation_about(direction(), (*this)(-3.1, 3.1)); }

 private:
  std::mt19937 engine_;
};

BodyPose moved(const BodyPose &motion, const BodyPose &pose, double scale = 1.0) {
  return {motion.rotation * (scale * pose.position) + motion.position, product(motion.rotation, pose.rotation)};
}

// Places A so that the pair overlaps by about `depth`, in some steps along the normal; not exactly, as that would end
// where two translations are equally short, and either answer is right.
BodyPose nearly_touching(const PairScene &scene, Random &random, const BodyPose &b, double depth) {
  BodyPose a{b.position + 3.0 * random.direction(), random.rotation()};
  for (int i = 0; i < 4; ++i) {
    const Contact contact = scene.query(a, b, 1);
    if (contact.distance == CMB_DISTANCE_NONE) return a;
    // The normal of an unused slot is that of the closest points; a touching pair has it in its point.
    double distance, d, w, n[3], p[3], position[6], rotation[18];
    const BodyPose *poses[2] = {&a, &b};
    for (int body = 0; body < 2; ++body) {
      for (int k = 0; k < 3; ++k) {
        position[3 * body + k] = poses[body]->position[k];
        for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * k + j] = poses[body]->rotation.row[j][k];
      }
    }
    EXPECT_EQ(query_pair(scene.handle(), 1, position, rotation, 2, 1, &distance, &d, &w, n, p), CMB_OK);
    a.position = a.position - (distance + random(0.8, 1.2) * depth) * Vec3{n[0], n[1], n[2]};
  }
  return a;
}

double worst_depth(const Contact &contact) {
  double worst = 0.0;
  for (const Point &p : contact.points) worst = std::fmax(worst, p.depth);
  return worst;
}

constexpr int poses_a_pair = 25;

TEST(Properties, ReversedPairsGiveReversedLoads) {
  const auto all = shapes(1.0);
  Random random(1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const PairScene scene(all[i], all[j]), reversed(all[j], all[i]);
      for (int k = 0; k < poses_a_pair; ++k) {
        const BodyPose b{{random(-1, 1), random(-1, 1), random(-1, 1)}, random.rotation()};
        const BodyPose a = nearly_touching(scene, random, b, random(-0.02, 0.05));
        const Contact one = scene.query(a, b, 64), other = reversed.query(b, a, 64);
        ASSERT_NEAR(one.distance, other.distance, 1e-8) << all[i] << " | " << all[j] << " " << k;
        ASSERT_LT(norm(one.load() + other.load()), 1e-6) << all[i] << " | " << all[j] << " " << k;
        ASSERT_LT(norm(one.moment(b.position) + other.moment(b.position)), 1e-6) << all[i] << " | " << all[j];
      }
    }
  }
}

TEST(Properties, RigidMotionsOfBothBodiesMoveTheContact) {
  const auto all = shapes(1.0);
  Random random(2);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i; j < all.size(); ++j) {
      const PairScene scene(all[i], all[j]);
      for (int k = 0; k < poses_a_pair; ++k) {
        const BodyPose b{{0, 0, 0}, random.rotation()};
        const BodyPose a = nearly_touching(scene, random, b, random(-0.02, 0.05));
        const BodyPose motion{{random(-5, 5), random(-5, 5), random(-5, 5)}, random.rotation()};
        const Contact one = scene.query(a, b, 64), other = scene.query(moved(motion, a), moved(motion, b), 64);
        ASSERT_NEAR(one.distance, other.distance, 1e-8) << all[i] << " | " << all[j] << " " << k;
        ASSERT_LT(norm(motion.rotation * one.load() - other.load()), 1e-6) << all[i] << " | " << all[j] << " " << k;
        ASSERT_LT(norm(motion.rotation * one.moment(b.position) - other.moment(motion.position)), 1e-6)
            << all[i] << " | " << all[j] << " " << k;
      }
    }
  }
}

TEST(Properties, LengthsScale) {
  for (const double scale : {1e-3, 1e3}) {
    const auto all = shapes(1.0), scaled = shapes(scale);
    Random random(3);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i; j < all.size(); ++j) {
        const PairScene scene(all[i], all[j]), scaled_scene(scaled[i], scaled[j]);
        for (int k = 0; k < poses_a_pair / 3; ++k) {
          const BodyPose b{{0, 0, 0}, random.rotation()};
          const BodyPose a = nearly_touching(scene, random, b, random(-0.02, 0.05));
          const Contact one = scene.query(a, b, 64);
          const Contact other = scaled_scene.query(moved({}, a, scale), moved({}, b, scale), 64);
          if (one.distance == CMB_DISTANCE_NONE) continue;
          ASSERT_NEAR(one.distance, other.distance / scale, 1e-8) << all[i] << " | " << all[j] << " " << k;
          ASSERT_LT(norm(one.load() - (1.0 / scale) * other.load()), 1e-6) << all[i] << " | " << all[j] << " " << k;
        }
      }
    }
  }
}

TEST(Properties, PointsFitTheSignedDistance) {
  const auto all = shapes(1.0);
  Random random(4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const PairScene scene(all[i], all[j]);
      for (int k = 0; k < poses_a_pair; ++k) {
        const BodyPose b{{0, 0, 0}, random.rotation()};
        const BodyPose a = nearly_touching(scene, random, b, random(-0.02, 0.05));
        const Contact contact = scene.query(a, b, 64);
        if (contact.distance >= 0.0) {
          ASSERT_TRUE(contact.points.empty()) << all[i] << " | " << all[j] << " " << k;
        } else {
          ASSERT_FALSE(contact.points.empty()) << all[i] << " | " << all[j] << " " << k;
          // Depth is the overlap's extent along the contact normal. Along the minimum translation that is the signed
          // distance, but where thin parts of both meet, of which one ends within the other, it is less.
          ASSERT_GE(worst_depth(contact), -0.5 * contact.distance) << all[i] << " | " << all[j];
          // Nothing is deeper than the bodies allow.
          ASSERT_LE(worst_depth(contact), 1.2) << all[i] << " | " << all[j];
        }
      }
    }
  }
}

// A prism on a regular polygon of radius 0.5 and height 1.
std::string prism(int corners) {
  constexpr double pi = 3.14159265358979323846;
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < 2 * corners; ++k) {
    const double angle = 2.0 * pi * (k / 2) / corners;
    text += (k > 0 ? "," : "") + digits(0.5 * std::cos(angle)) + "," + digits(0.5 * std::sin(angle)) + "," +
            (k % 2 == 0 ? "0.5" : "-0.5");
  }
  return text;
}

TEST(Properties, MergingKeepsLoadMomentAndStoredEnergy) {
  const auto stored = [](const Contact &contact) {
    double sum = 0.0;
    for (const auto &p : contact.points) sum += p.weight * p.depth * p.depth;
    return sum;
  };
  const PairScene scene(prism(12), "cmb/1 halfspace");
  const BodyPose a{{0.1, 0.05, 0.49}, rotation_about({0.6, 0.8, 0}, 0.004)};
  const Contact all = scene.query(a, {}, 64);
  ASSERT_GE(all.points.size(), 8u);
  for (std::size_t capacity = 1; capacity < all.points.size(); ++capacity) {
    const Contact merged = scene.query(a, {}, capacity);
    EXPECT_LE(merged.points.size(), capacity);
    EXPECT_NEAR(stored(merged), stored(all), 1e-15);
    EXPECT_LT(norm(merged.load() - all.load()), 1e-15);
    EXPECT_LT(norm(merged.moment({}) - all.moment({})), 1e-15);
  }
}

TEST(Properties, RestingFacesOfBoxesOnBoxesCarryWholly) {
  const double depth = 1e-4;
  const struct {
    const char *a, *b;
    BodyPose pose;
  } cases[] = {
      {"cmb/1 box size=1,1,1", "cmb/1 box size=4,4,1", {{0.3, -0.2, 1.0 - depth}, {}}},
      {"cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1", {{0, 0, 1.0 - depth}, {}}},                              // flush
      {"cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1", {{0, 0, 1.0 - depth}, rotation_about({0, 0, 1}, 0.4)}},  // octagon
      {"cmb/1 box size=4,4,1", "cmb/1 box size=1,1,1", {{0.3, -0.2, 1.0 - depth}, {}}},
      {"cmb/1 box size=1,1,1", "cmb/1 box size=4,4,1", {{2.2, 0.0, 1.0 - depth}, {}}},                          // overhang
  };
  for (const auto &c : cases) {
    const PairScene scene(c.a, c.b);
    const Contact contact = scene.query(c.pose, {}, 64);
    EXPECT_NEAR(contact.total_weight(), 1.0, 1e-9) << c.a << " | " << c.b;
    EXPECT_NEAR(contact.load().z, depth, 1e-12) << c.a << " | " << c.b;
    EXPECT_LT(std::hypot(contact.load().x, contact.load().y), 1e-12);
    EXPECT_GE(contact.points.size(), 4u);
  }
}

// Whatever polygon the faces have in common: its corners are crossings of edges, and corners of either prism.
TEST(Properties, PolygonalFacesOnEachOtherCarryWholly) {
  const double depth = 1e-4;
  Random random(17);
  for (const auto &[below, above] : {std::pair{6, 6}, {3, 5}, {7, 4}, {12, 6}}) {
    const PairScene scene(prism(above), prism(below));
    for (int k = 0; k < 20; ++k) {
      const BodyPose pose{{random(-0.3, 0.3), random(-0.3, 0.3), 1.0 - depth},
                          rotation_about({0, 0, 1}, random(-3.0, 3.0))};
      const Contact contact = scene.query(pose, {}, 64);
      EXPECT_NEAR(contact.total_weight(), 1.0, 1e-9) << below << " " << above << " " << k;
      EXPECT_NEAR(contact.load().z, depth, 1e-12);
    }
  }
}

TEST(Properties, OverhangingBoxIsSupportedUpToTheBorder) {
  // A box whose middle is 0.2 m inside the table's border at x = 2: supported from x = 1.3 to x = 2.
  const PairScene scene("cmb/1 box size=1,1,1", "cmb/1 box size=4,4,1");
  const Contact contact = scene.query({{1.8, 0, 1.0 - 1e-4}, {}}, {}, 4);
  ASSERT_EQ(contact.points.size(), 4u);
  for (const Point &p : contact.points) {
    EXPECT_NEAR(p.weight, 0.25, 1e-9);
    EXPECT_NEAR(std::fabs(p.position.x - 1.65), 0.35, 1e-9);
    EXPECT_NEAR(std::fabs(p.position.y), 0.5, 1e-9);
  }
}

// Where a face lies on a wide box, also partly lifted about an edge, the overlap's energy is that of springs at its corners.
TEST(Properties, FaceOnBoxEqualsFaceOnHalfspace) {
  const PairScene on_box("cmb/1 box size=1,0.8,1.2", "cmb/1 box size=9,9,1 position=0,0,-0.5");
  const PairScene on_plane("cmb/1 box size=1,0.8,1.2", "cmb/1 halfspace");
  Random random(5);
  for (int k = 0; k < 100; ++k) {
    const double depth = random(1e-4, 1e-3), tilt = random(-2.0, 2.0) * depth;
    const Vec3 axis = k % 2 == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    BodyPose a{{random(-1, 1), random(-1, 1), 0.9}, product(rotation_about({0, 0, 1}, random(-3, 3)), rotation_about(axis, tilt))};
    a.position.z -= on_plane.query(a, {}, 8).distance + depth;
    const Contact one = on_box.query(a, {}, 64), other = on_plane.query(a, {}, 8);
    ASSERT_NEAR(one.distance, other.distance, 1e-10);
    ASSERT_LT(norm(one.load() - other.load()), 2e-5 * norm(other.load())) << k;
    ASSERT_LT(norm(one.moment({}) - other.moment({})), 2e-5 * norm(other.load())) << k;
  }
}

// Load by depth as docs/engine/concept.md states it.
TEST(Properties, EdgesAndCornersOfBoxesPushByTheirEnergy) {
  constexpr double pi = 3.14159265358979323846;
  const double depth = 1e-3;
  const Mat3 on_edge = rotation_about({1, 0, 0}, pi / 4);
  const Mat3 on_corner = product(rotation_about({0, 1, 0}, -std::atan(std::sqrt(0.5))), on_edge);
  const PairScene on_table("cmb/1 box size=1,1,1", "cmb/1 box size=9,9,1 position=0,0,-0.5");
  const PairScene on_cube("cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1");
  const double half_diagonal = std::sqrt(0.5);
  const struct {
    const char *name;
    const PairScene &scene;
    BodyPose a, b;
    double load;
  } cases[] = {
      {"edge on face", on_table, {{0, 0, half_diagonal - depth}, on_edge}, {}, 0.75},
      {"corner on face", on_table, {{0, 0, std::sqrt(0.75) - depth}, on_corner}, {}, 0.6},
      {"edges across", on_cube, {{0, 0, 2 * half_diagonal - depth}, product(rotation_about({0, 0, 1}, pi / 2), on_edge)},
       {{}, on_edge}, 0.6},
  };
  for (const auto &c : cases) {
    const Contact contact = c.scene.query(c.a, c.b, 8);
    ASSERT_NEAR(contact.distance, -depth, 1e-12) << c.name;
    EXPECT_NEAR(contact.load().z, c.load * depth, 1e-9 * depth) << c.name;
    EXPECT_LT(std::hypot(contact.load().x, contact.load().y), 1e-9 * depth) << c.name;
    for (const Point &point : contact.points) EXPECT_NEAR(point.depth, depth, 1e-9 * depth) << c.name;
  }
}

// The contact directions on both sides of a plate in the middle of a round body nearly oppose each other. Ways deeper than
// 1.5 times the shortest do not count, nor shares beyond 8.
TEST(Properties, PlatesWithinRoundBodiesAreNotSqueezed) {
  Random random(23);
  int squeezed = 0;
  for (const char *round : {"cmb/1 cone radius=2 length=2", "cmb/1 cylinder radius=1 length=2", "cmb/1 ellipsoid size=2,3,4",
                            "cmb/1 capsule radius=1 length=1"}) {
    for (const char *plate : {"cmb/1 box size=2,2,0.25", "cmb/1 cylinder radius=1 length=0.1"}) {
      const PairScene scene(round, plate);
      for (int k = 0; k < 400; ++k) {
        const BodyPose a{0.05 * random.direction(), random.rotation()}, b{{0, 0, 0}, random.rotation()};
        const Contact contact = scene.query(a, b, 64);
        double load = 0.0;
        for (const Point &p : contact.points) load += p.weight * p.depth;
        ASSERT_LE(load, -12.0 * contact.distance) << round << " | " << plate << " " << k;
        squeezed += load > -2.0 * contact.distance ? 1 : 0;
      }
    }
  }
  EXPECT_GT(squeezed, 0);
}

// Their many corners push as the smooth body's one point does, on a box to a tenth or so, on a half-space the nearer the more corners
// lie in it, and near where that would.
TEST(Properties, FinelyTessellatedBallsPushAsBalls) {
  for (const int corners : {100, 400}) {
    const double spacing = 0.5 * std::sqrt(4.0 * 3.14159265358979324 / corners);  // of the corners
    for (const char *other : {"cmb/1 box size=4,4,1 position=0,0,-0.5", "cmb/1 halfspace"}) {
      const PairScene scene(tessellated_ball(corners), other);
      Random random(5);
      for (const double depth : {0.1, 0.2}) {  // with enough corners in it
        for (int k = 0; k < 40; ++k) {
          BodyPose a{{random(-0.3, 0.3), random(-0.3, 0.3), 0.6}, random.rotation()};
          a.position.z -= scene.query(a, {}, 8).distance + depth;
          const Contact contact = scene.query(a, {}, 128);
          const double load = norm(contact.load());
          const bool on_box = other[6] == 'b';
          ASSERT_NEAR(load, depth, on_box ? 0.15 * depth : 1.0 / corners) << corners << " " << other;
          const Vec3 arm = (1.0 / load) * contact.moment(a.position);  // of a load straight up at (x, y): (y, -x, 0)
          ASSERT_LT(std::hypot(arm.x, arm.y), on_box ? spacing : 0.3 * spacing) << corners << " " << other;
        }
      }
    }
  }
}

}  // namespace
}  // namespace test_properties
