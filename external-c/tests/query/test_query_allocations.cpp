// Queries do not allocate once the thread's scratch has grown.
#include "support/counted_allocations.hpp"
#include "support/engine_calls.hpp"
#include "support/mesh_text.hpp"
#include "support/rigid_bodies.hpp"
#include "support/scene_query.hpp"

namespace {

using namespace cmb::test;

TEST(Allocations, StopOnceTheScratchHasGrown) {
  const std::vector<std::string> geometry = {
      "cmb/1 box size=1,1,1",
      "cmb/1 box size=2,2,1 position=0,0,-0.9",
      "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.6,0.35,-0.3,-0.2",
      "cmb/1 capsule radius=0.3 length=0.5",
      "cmb/1 halfspace",
      "cmb/1 sphere radius=0.4;cmb/1 cylinder radius=0.2 length=1",
      "cmb/1 mesh vertices=-0.4,-0.4,-0.4,0.5,-0.4,-0.4,0,0.6,-0.4,0,0,0.7 triangles=1,3,2,1,2,4,2,3,4,3,1,4",
      mesh_samples::mesh_text(mesh_samples::with_speck(mesh_samples::sphere_mesh(0.5, 2))),
      mesh_samples::height_field_text(3.0, 9, [](double x, double y) { return 0.2 * std::sin(3 * x) * std::cos(2 * y); }),
      "cmb/1 ellipsoid size=0.6,0.7,0.8;cmb/1 cone radius=0.3 length=0.9"};
  std::vector<int> pairs;
  for (int a = 1; a <= 10; ++a) {
    for (int b = a + 1; b <= 10; ++b) pairs.insert(pairs.end(), {a, b});
  }
  const cmb_scene scene = intern(geometry, pairs);
  constexpr std::size_t bodies = 10, count = 45, capacity = 4;
  double position[3 * bodies], rotation[9 * bodies];
  double distance[count], depth[count * capacity], weight[count * capacity], normal[3 * count * capacity],
      point[3 * count * capacity];
  const auto query = [&](int k) {
    for (std::size_t body = 0; body < bodies; ++body) {
      const double phase = 0.1 * k + static_cast<double>(body);
      const Mat3 r = rotation_about(normalized(Vec3{1, std::sin(phase), 0.3}), phase);
      for (std::size_t i = 0; i < 3; ++i) {
        position[3 * body + i] = 0.2 * std::sin(phase + static_cast<double>(i));
        for (int j = 0; j < 3; ++j) {
          rotation[9 * body + 3 * i + static_cast<std::size_t>(j)] = r.row[j][static_cast<int>(i)];
        }
      }
    }
    return query_scene(scene, position, rotation, bodies, count, capacity, distance, depth, weight, normal, point);
  };
  for (int k = 0; k < 60; ++k) ASSERT_EQ(query(k), CMB_OK);
  const unsigned long before = allocations;
  for (int k = 0; k < 60; ++k) query(k);
  EXPECT_EQ(allocations - before, 0u);
}

// A ball of `count` vertices.
std::string ball_hull(int count) {
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < count; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / count, r = std::sqrt(1.0 - z * z), turn = 2.399963 * k;
    text += (k > 0 ? "," : "") + digits(r * std::cos(turn)) + "," + digits(r * std::sin(turn)) + "," + digits(z);
  }
  return text;
}

TEST(Allocations, OfFclDoNotGrowWithTheHulls) {
  const auto of_a_query = [](int vertices) {
    const PairScene scene(ball_hull(vertices), ball_hull(vertices), CMB_BACKEND_FCL);
    const BodyPose afar{{3.0, 0.4, 0.2}, {}};
    scene.query(afar, {});
    const unsigned long before = allocations;
    scene.query(afar, {});
    return allocations - before;
  };
  EXPECT_EQ(of_a_query(400), of_a_query(12));
}

TEST(Allocations, StopInScenesWithAFilterToo) {
  Bodies bodies;
  for (int i = 0; i < 100; ++i) bodies.add_sphere(0.1, 1.0, 1e4);
  bodies.add("cmb/1 box size=0.2,0.2,0.2;cmb/1 capsule radius=0.1 length=0.4", 1.0, {0.1, 0.1, 0.1}, 1e4);
  bodies.add_fixed("cmb/1 halfspace");
  bodies.intern({1, 2});
  Motion motion(bodies.count());
  const auto move = [&](int k) {
    for (std::size_t i = 0; i + 1 < bodies.count(); ++i) {
      const double phase = 0.1 * k + static_cast<double>(i);
      Motion::set_row(motion.position, i, {0.3 * std::sin(phase), 0.3 * std::cos(1.7 * phase), 0.1 + 0.1 * std::sin(2.3 * phase)});
    }
  };
  std::vector<cmb_contact> contacts(20000);
  std::size_t count = 0;
  Wrenches wrenches(bodies, motion);
  const auto evaluate = [&](int k) {
    move(k);
    wrenches.evaluate(bodies, motion);
    query_contacts(bodies.broadphase, motion.position.data(), motion.rotation.data(), bodies.count(),
                       contacts.size(), contacts.data(), &count);
  };
  for (int k = 0; k < 30; ++k) evaluate(k);
  const unsigned long before = allocations;
  for (int k = 0; k < 30; ++k) evaluate(k);
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(count, 100u);
}

}  // namespace
