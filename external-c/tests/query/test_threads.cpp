// Scenes are interned and asked from many threads at once; run under ThreadSanitizer by the preset "tsan".
#include <thread>

#include "support/engine_calls.hpp"
#include "support/scene_query.hpp"

namespace test_threads {
namespace {

using namespace cmb::test;

TEST(Threads, InternAndQueryTogether) {
  constexpr int threads = 4, rounds = 60;
  const PairScene known("cmb/1 box size=1,1,1", "cmb/1 box size=2,2,2");
  const BodyPose pose{{0.2, 0.1, 1.48}, rotation_about({0, 0, 1}, 0.4)};
  const Contact expected = known.query(pose, {}, 16);
  ASSERT_FALSE(expected.points.empty());
  std::vector<int> wrong(threads, 0);
  std::vector<cmb_scene> handle(threads * rounds);
  std::vector<std::thread> crew;
  for (int t = 0; t < threads; ++t) {
    crew.emplace_back([&, t] {
      for (int round = 0; round < rounds; ++round) {
        // Every thread interns the same scenes in its own order.
        const int number = (round * 7 + t * 13) % rounds;
        const PairScene scene("cmb/1 sphere radius=" + digits(0.5 + 0.001 * number), "cmb/1 halfspace",
                              number % 2 == 0 ? CMB_BACKEND_AUTO : CMB_BACKEND_ANALYTIC);
        handle[static_cast<std::size_t>(t * rounds + number)] = scene.handle();
        const Contact contact = known.query(pose, {}, 16);
        if (contact.points.size() != expected.points.size() || contact.distance != expected.distance) ++wrong[t];
        for (std::size_t k = 0; k < std::min(contact.points.size(), expected.points.size()); ++k) {
          if (contact.points[k].depth != expected.points[k].depth) ++wrong[t];
          if (contact.points[k].weight != expected.points[k].weight) ++wrong[t];
        }
        const char *bad[] = {"cmb/1 sphere radius=0"};
        cmb_scene none{};
        if (intern_scene(bad, 1, nullptr, 0, CMB_BACKEND_AUTO, &none) != CMB_ERROR_DESCRIPTOR) ++wrong[t];
        if (std::string(cmb_last_error()).find("radius is 0") == std::string::npos) ++wrong[t];
      }
    });
  }
  for (std::thread &thread : crew) thread.join();
  for (int t = 0; t < threads; ++t) EXPECT_EQ(wrong[static_cast<std::size_t>(t)], 0);
  for (int t = 1; t < threads; ++t) {
    for (int k = 0; k < rounds; ++k) {
      EXPECT_EQ(handle[static_cast<std::size_t>(t * rounds + k)], handle[static_cast<std::size_t>(k)]);
    }
  }
}

TEST(Threads, LibrariesShareTheShapesTheyKeep) {
  constexpr int threads = 4, poses = 200;
  const std::string hull = "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.4";
  for (const cmb_backend backend : {CMB_BACKEND_LIBCCD, CMB_BACKEND_FCL, CMB_BACKEND_COAL}) {
    cmb_scene none{};
    if (intern_scene(nullptr, 0, nullptr, 0, backend, &none) != CMB_OK) continue;  // no such module
    const PairScene scene(hull, hull, backend);
    const auto pose = [](int k) {
      return BodyPose{{0.4 * std::sin(0.1 * k), 0.3, 0.4 * std::cos(0.13 * k)}, rotation_about({0, 0, 1}, 0.05 * k)};
    };
    std::vector<double> expected;
    for (int k = 0; k < poses; ++k) expected.push_back(scene.query(pose(k), {}).distance);
    std::vector<int> wrong(threads, 0);
    std::vector<std::thread> crew;
    for (int t = 0; t < threads; ++t) {
      crew.emplace_back([&, t] {
        for (int k = 0; k < poses; ++k) {
          const int asked = (k * 7 + t * 50) % poses;
          if (scene.query(pose(asked), {}).distance != expected[static_cast<std::size_t>(asked)]) {
            ++wrong[static_cast<std::size_t>(t)];
          }
        }
      });
    }
    for (std::thread &thread : crew) thread.join();
    for (int t = 0; t < threads; ++t) EXPECT_EQ(wrong[static_cast<std::size_t>(t)], 0) << backend;
  }
}

}  // namespace
}  // namespace test_threads
