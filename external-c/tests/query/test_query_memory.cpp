// A thread remembers what its last query found: with bodies at the same poses as then, answers are those of a thread that
// has never asked, to the last bit.
#include <cstring>
#include <thread>

#include "support/engine_calls.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_query_memory {
namespace {

using namespace cmb::test;

const std::vector<std::string> bodies = {
    "cmb/1 box size=0.4,0.6,0.5",
    "cmb/1 sphere radius=0.2;cmb/1 box size=0.2,0.2,0.6 position=0.3,0,0.2",
    "cmb/1 hull vertices=0.5,0,0,-0.4,0.1,0,0,0.5,0.1,0,-0.5,0,0,0,0.7",
    "cmb/1 cylinder radius=0.3 length=0.6;cmb/1 capsule radius=0.1 length=0.8 position=0,0.3,0",
    "cmb/1 halfspace position=0,0,-0.4",
};
const std::vector<int> pairs = {1, 2, 1, 3, 1, 4, 2, 3, 2, 4, 3, 4, 5, 1, 2, 5, 3, 5, 4, 5};

struct Poses {
  std::vector<double> position, rotation;

  void place(std::size_t body, const Vec3 &at, const Mat3 &turned) {
    for (int i = 0; i < 3; ++i) {
      position[3 * body + static_cast<std::size_t>(i)] = at[i];
      for (int j = 0; j < 3; ++j) rotation[9 * body + static_cast<std::size_t>(3 * i + j)] = turned.row[j][i];
    }
  }
};

Poses random_poses(random_bodies::Random &random) {
  Poses poses{std::vector<double>(3 * bodies.size()), std::vector<double>(9 * bodies.size())};
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    poses.place(body, random.uniform(0.0, 0.8) * random.direction(), random_bodies::random_rotation(random));
  }
  return poses;
}

// All numbers of an answer.
std::vector<double> ask(cmb_scene scene, const Poses &poses, double exact_within, std::size_t capacity) {
  const std::size_t count = pairs.size() / 2;
  std::vector<double> numbers(count * (1 + 8 * capacity), -1.0);
  double *const distance = numbers.data(), *const depth = distance + count, *const weight = depth + count * capacity;
  double *const normal = weight + count * capacity, *const point = normal + 3 * count * capacity;
  EXPECT_EQ(query_scene(scene, poses.position.data(), poses.rotation.data(), bodies.size(), count, capacity, distance, depth,
                        weight, normal, point, exact_within),
            CMB_OK)
      << cmb_last_error();
  return numbers;
}

std::vector<double> ask_afresh(cmb_scene scene, const Poses &poses, double exact_within, std::size_t capacity) {
  std::vector<double> numbers;
  std::thread([&] { numbers = ask(scene, poses, exact_within, capacity); }).join();
  return numbers;
}

TEST(QueryMemory, TellsWhatAThreadWithoutMemoryFinds) {
  random_bodies::Random random(11);
  cmb_scene scenes[] = {intern(bodies, pairs), intern({bodies[3], bodies[2], bodies[1], bodies[0], bodies[4]}, pairs)};
  const double lengths[] = {HUGE_VAL, 0.1};
  const std::size_t capacities[] = {4, 2};
  Poses poses = random_poses(random);
  std::size_t scene = 0, length = 0, capacity = 0;
  for (int k = 0; k < 600; ++k) {
    const Poses before = poses;
    const double chance = random.uniform(0.0, 1.0);
    if (chance < 0.05) poses = random_poses(random);
    if (chance > 0.97) scene = 1 - scene;
    if (chance > 0.94 && chance < 0.97) length = 1 - length;
    if (chance > 0.91 && chance < 0.94) capacity = 1 - capacity;
    if (chance > 0.88 && chance < 0.91) {  // another one at the same handle's place
      ASSERT_EQ(cmb_release_scene(scenes[scene]), CMB_OK);
      scenes[scene] = intern({bodies[1], bodies[0], bodies[3], bodies[2], bodies[4]}, pairs);
    }
    if (chance > 0.85 && chance < 0.88) {  // refused half way
      Poses wrong = poses;
      wrong.position[7] = NAN;
      std::vector<double> room(1000);
      EXPECT_EQ(query_scene(scenes[scene], wrong.position.data(), wrong.rotation.data(), bodies.size(), 10, 4, room.data(),
                            room.data() + 10, room.data() + 50, room.data() + 90, room.data() + 210, lengths[length]),
                CMB_ERROR_POSE);
    }
    // A body or two move a little, or by a last digit, and back.
    for (double left = random.uniform(0.0, 2.5); left > 1.0; left -= 1.0) {
      const auto number = static_cast<std::size_t>(random.uniform(0.0, 0.999) * static_cast<double>(poses.position.size()));
      double &moved = poses.position[number];
      moved = random.uniform(0.0, 1.0) < 0.3 ? std::nextafter(moved, 2.0) : moved + random.uniform(-1e-3, 1e-3);
    }
    const std::vector<double> found = ask(scenes[scene], poses, lengths[length], capacities[capacity]);
    const std::vector<double> afresh = ask_afresh(scenes[scene], poses, lengths[length], capacities[capacity]);
    ASSERT_EQ(found.size(), afresh.size());
    ASSERT_EQ(std::memcmp(found.data(), afresh.data(), found.size() * sizeof(double)), 0) << k;
    if (random.uniform(0.0, 1.0) < 0.5) poses = before;
  }
}

}  // namespace
}  // namespace test_query_memory
