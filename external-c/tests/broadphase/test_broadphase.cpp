// The broad phase finds all pairs that touch, and those only that its filter lets touch.
#include <algorithm>
#include <atomic>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

#include "broadphase/near_pairs.hpp"
#include "support/engine_calls.hpp"
#include "contact_multibody_scene.h"
#include "support/scene_query.hpp"

namespace {

using namespace cmb::test;
using cmb::Bounds;
using Pairs = std::set<std::pair<int, int>>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
  Vec3 vector(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Mat3 rotation() { return rotation_about(normalized(vector(1.0)), in(0.0, 6.0)); }
  std::size_t index(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937 engine_;
};

// Poses of all bodies as the engine takes them.
struct Poses {
  std::vector<double> position, rotation;

  void add(const Vec3 &p, const Mat3 &r) {
    for (int i = 0; i < 3; ++i) position.push_back(p[i]);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation.push_back(r.row[j][i]);
    }
  }
  std::size_t count() const { return position.size() / 3; }
};

struct Scene {
  std::vector<std::string> geometry;
  Poses poses;
};

cmb_broadphase intern_filtered(const Scene &scene, const cmb_collision_filter *filter = nullptr) {
  cmb_broadphase broadphase{};
  EXPECT_EQ(cmb_intern_broadphase(intern(scene.geometry, {}), filter, &broadphase), CMB_OK)
      << cmb_last_error();
  return broadphase;
}

std::vector<std::pair<int, int>> candidates(cmb_broadphase broadphase, const Poses &poses) {
  std::size_t count = 0;
  EXPECT_EQ(query_candidates(broadphase, poses.position.data(), poses.rotation.data(), poses.count(), 0, nullptr,
                                 &count),
            CMB_OK)
      << cmb_last_error();
  std::vector<int> flat(2 * count);
  query_candidates(broadphase, poses.position.data(), poses.rotation.data(), poses.count(), count, flat.data(),
                       &count);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(flat[2 * i], flat[2 * i + 1]);
  return pairs;
}

std::vector<cmb_contact> contacts(cmb_broadphase broadphase, const Poses &poses) {
  std::size_t count = 0;
  EXPECT_EQ(query_contacts(broadphase, poses.position.data(), poses.rotation.data(), poses.count(), 0, nullptr,
                               &count),
            CMB_OK)
      << cmb_last_error();
  std::vector<cmb_contact> found(count);
  query_contacts(broadphase, poses.position.data(), poses.rotation.data(), poses.count(), count, found.data(),
                     &count);
  return found;
}

std::string random_shape(Random &random, double size) {
  const auto number = [&](double low, double high) { return digits(size * random.in(low, high)); };
  switch (random.index(8)) {
    case 0: return "cmb/1 sphere radius=" + number(0.3, 0.6);
    case 1: return "cmb/1 box size=" + number(0.5, 1) + "," + number(0.5, 1) + "," + number(0.5, 1);
    case 2: return "cmb/1 capsule radius=" + number(0.1, 0.4) + " length=" + number(0.1, 1);
    case 3: return "cmb/1 cylinder radius=" + number(0.2, 0.5) + " length=" + number(0.1, 1);
    case 4: return "cmb/1 cone radius=" + number(0.2, 0.5) + " length=" + number(0.3, 1);
    case 5: return "cmb/1 ellipsoid size=" + number(0.5, 1) + "," + number(0.5, 1) + "," + number(0.5, 1);
    case 6: {
      std::string text = "cmb/1 hull vertices=";
      for (int k = 0; k < 8; ++k) {
        for (const int bit : {1, 2, 4}) text += digits(size * ((k & bit ? 0.4 : -0.4) + random.in(-0.1, 0.1))) + ",";
      }
      text.pop_back();
      return text;
    }
    default:
      return "cmb/1 sphere radius=" + number(0.2, 0.4) + " position=" + number(-1, 1) + ",0,0;cmb/1 box size=" +
             number(0.2, 0.6) + "," + number(0.2, 0.6) + "," + number(0.2, 0.6) + " position=0," + number(0.2, 0.9) + ",0";
  }
}

// Bodies of sizes over three decades, a floor, and one body that is as large as the scene.
Scene random_scene(unsigned seed, std::size_t count) {
  Random random(seed);
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    scene.geometry.push_back(random_shape(random, std::pow(10.0, random.in(-2.0, 0.5))));
    scene.poses.add(random.vector(2.0), random.rotation());
  }
  scene.geometry[count / 2] = "cmb/1 halfspace";
  scene.geometry[count / 3] = "cmb/1 box size=9,9,0.4;cmb/1 halfspace position=0,0,-1.5";
  scene.geometry[count / 4] = "";
  return scene;
}

TEST(BroadPhase, FindsTheContactsOfAllPairs) {
  constexpr std::size_t count = 60, capacity = 64;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Scene scene = random_scene(seed, count);
    const cmb_broadphase broadphase = intern_filtered(scene);
    const std::vector<cmb_contact> found = contacts(broadphase, scene.poses);
    const auto candidate_list = candidates(broadphase, scene.poses);
    EXPECT_TRUE(std::is_sorted(candidate_list.begin(), candidate_list.end()));
    const Pairs candidate_set(candidate_list.begin(), candidate_list.end());
    EXPECT_EQ(candidate_set.size(), candidate_list.size()) << "a pair is named twice";
    EXPECT_LT(candidate_list.size(), count * (count - 1) / 3) << "hardly a pair was sorted out";

    std::vector<int> pairs;
    for (int a = 1; a <= static_cast<int>(count); ++a) {
      for (int b = a + 1; b <= static_cast<int>(count); ++b) pairs.insert(pairs.end(), {a, b});
    }
    const cmb_scene all = intern(scene.geometry, pairs);
    std::size_t next = 0;
    for (std::size_t pair = 0; pair < pairs.size() / 2; ++pair) {
      double distance, depth[capacity], weight[capacity], normal[3 * capacity], point[3 * capacity];
      ASSERT_EQ(query_pair(all, pair + 1, scene.poses.position.data(), scene.poses.rotation.data(), count, capacity,
                               &distance, depth, weight, normal, point),
                CMB_OK);
      for (std::size_t k = 0; k < capacity && weight[k] > 0.0; ++k, ++next) {
        ASSERT_LT(next, found.size()) << "a contact is missing";
        const cmb_contact &contact = found[next];
        ASSERT_EQ(std::make_pair(contact.body_a, contact.body_b), std::make_pair(pairs[2 * pair], pairs[2 * pair + 1]));
        EXPECT_TRUE(candidate_set.count({contact.body_a, contact.body_b}));
        EXPECT_EQ(contact.depth, depth[k]);
        EXPECT_EQ(contact.weight, weight[k]);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_EQ(contact.normal[i], normal[3 * k + i]);
          EXPECT_EQ(contact.point[i], point[3 * k + i]);
        }
      }
    }
    EXPECT_EQ(next, found.size()) << "contacts of pairs that do not touch";
    EXPECT_GT(next, 20u);
  }
}

Pairs overlapping(const std::vector<Bounds> &boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (overlap(boxes[i], boxes[j])) pairs.emplace(static_cast<int>(i), static_cast<int>(j));
    }
  }
  return pairs;
}

// Boxes of all sizes, in clusters, on top of each other, touching exactly, and very far away.
std::vector<Bounds> random_boxes(unsigned seed) {
  Random random(seed);
  std::vector<Bounds> boxes;
  const double decades = random.in(0.0, 6.0), room = std::pow(10.0, random.in(-1.0, 2.0));
  const std::size_t count = 20 + random.index(400);
  for (std::size_t i = 0; i < count; ++i) {
    const double size = 0.3 * std::pow(10.0, -random.in(0.0, decades));
    Vec3 center = random.vector(room);
    if (random.index(4) == 0 && !boxes.empty()) center = boxes[random.index(boxes.size())].high;
    if (random.index(50) == 0) center = center + Vec3{1e12, -1e12, 0};
    const Vec3 half{size * random.in(0.1, 1.0), size * random.in(0.1, 1.0), size};
    boxes.push_back({center - half, center + half});
    if (random.index(20) == 0) boxes.push_back(boxes.back());
  }
  // Side by side on whole cells.
  for (int i = 0; i < 8; ++i) boxes.push_back({{1.0 * i, 0, 0}, {i + 1.0, 1, 1}});
  return boxes;
}

TEST(HierarchicalGrid, FindsEachOverlapOnce) {
  cmb::HierarchicalGrid grid;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::vector<Bounds> boxes = random_boxes(seed);
    Pairs found;
    grid.visit_overlaps(boxes, [&](std::uint32_t i, std::uint32_t j) {
      EXPECT_TRUE(found.emplace(static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))).second) << "found twice, seed " << seed;
    });
    EXPECT_EQ(found, overlapping(boxes)) << "seed " << seed;
  }
}

TEST(HierarchicalGrid, ComparesFewBoxesOfALargeScene) {
  // 20^3 boxes that do not touch, and a large one under all of them.
  std::vector<Bounds> boxes;
  for (int i = 0; i < 8000; ++i) {
    const Vec3 low{1.5 * (i % 20), 1.5 * (i / 20 % 20), 1.5 * (i / 400)};
    boxes.push_back({low, low + Vec3{1, 1, 1}});
  }
  boxes.push_back({{-5, -5, -1}, {50, 50, 0.0}});
  cmb::HierarchicalGrid grid;
  std::size_t visits = 0;
  grid.visit_overlaps(boxes, [&](std::uint32_t, std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 400u);
}

// Boxes that creep, fly, jump, grow, become more or fewer, for owners that take turns, end, and take others' places in memory.
TEST(NearPairs, AreThoseOfTheBoxesAtHand) {
  cmb::NearPairs near;
  Random random(5);
  std::vector<std::shared_ptr<const void>> owners(3);
  std::vector<std::vector<Bounds>> boxes(owners.size());
  std::vector<unsigned> left_out(owners.size());
  std::size_t at_hand = 0;
  for (int round = 0; round < 3000; ++round) {
    if (random.index(8) == 0) at_hand = random.index(owners.size());
    std::vector<Bounds> &own = boxes[at_hand];
    if (owners[at_hand] == nullptr || random.index(60) == 0) {
      owners[at_hand] = std::make_shared<char>();
      own = random_boxes(static_cast<unsigned>(round));
      own.resize(std::min<std::size_t>(own.size(), 60));
      left_out[at_hand] = static_cast<unsigned>(1 + random.index(7));
    }
    const double step = random.index(20) == 0 ? 1.0 : std::pow(10.0, -random.in(1.5, 4.0));
    const bool one_flies = random.index(2) == 0;  // beside others that hardly move
    const std::size_t flying = random.index(own.size());
    for (Bounds &box : own) {
      const double way = !one_flies ? step : &box == &own[flying] ? 1.0 : 1e-5;
      const Vec3 move = random.vector(way * (box.high.z - box.low.z));
      box = {box.low + move, box.high + move};
    }
    const unsigned divisor = left_out[at_hand];
    const auto wanted = [divisor](std::uint32_t i, std::uint32_t j) { return (i + j) % divisor != 0 || divisor == 1; };
    Pairs found, expected;
    near.visit_overlaps(owners[at_hand], own, wanted, [&](std::uint32_t i, std::uint32_t j) {
      EXPECT_TRUE(found.emplace(static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))).second) << "found twice";
    });
    for (const auto &[i, j] : overlapping(own)) {
      if (wanted(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) expected.emplace(i, j);
    }
    ASSERT_EQ(found, expected) << "round " << round;
  }
}

// Ten spheres at one place.
Scene heap() {
  Scene scene;
  for (int i = 0; i < 10; ++i) {
    scene.geometry.push_back("cmb/1 sphere radius=1");
    scene.poses.add({0.1 * i, 0, 0}, {});
  }
  return scene;
}

TEST(CollisionFilter, KeepsFixedBodiesApart) {
  const Scene scene = heap();
  const int fixed[10] = {1, 0, 1, 0, 0, 0, 0, 0, 0, 2};
  const cmb_collision_filter filter{10, fixed, nullptr, nullptr, nullptr, 0};
  const auto found = candidates(intern_filtered(scene, &filter), scene.poses);
  EXPECT_EQ(found.size(), 45u - 3u);
  for (const auto &[a, b] : found) EXPECT_FALSE(fixed[a - 1] && fixed[b - 1]);
}

TEST(CollisionFilter, AsksBothBodiesForTheirGroups) {
  const Scene scene = heap();
  Random random(3);
  for (int repetition = 0; repetition < 20; ++repetition) {
    int group[10], mask[10];
    for (int i = 0; i < 10; ++i) {
      group[i] = static_cast<int>(random.index(16));
      mask[i] = static_cast<int>(random.index(16));
    }
    group[0] = mask[0] = -1;  // all bits
    group[1] = 0;
    const cmb_collision_filter filter{10, nullptr, group, mask, nullptr, 0};
    const auto list = candidates(intern_filtered(scene, &filter), scene.poses);
    const Pairs found(list.begin(), list.end());
    for (int a = 1; a <= 10; ++a) {
      for (int b = a + 1; b <= 10; ++b) {
        const bool touch = (group[a - 1] & mask[b - 1]) != 0 && (group[b - 1] & mask[a - 1]) != 0;
        EXPECT_EQ(found.count({a, b}) > 0, touch);
      }
    }
  }
}

TEST(CollisionFilter, LeavesOutExcludedPairs) {
  const Scene scene = heap();
  const int excluded[] = {2, 1, 3, 4, 4, 3, 10, 1, 5, 5};
  const cmb_collision_filter filter{10, nullptr, nullptr, nullptr, excluded, 5};
  const auto list = candidates(intern_filtered(scene, &filter), scene.poses);
  const Pairs found(list.begin(), list.end());
  EXPECT_EQ(found.size(), 45u - 3u);
  for (const auto &pair : Pairs{{1, 2}, {3, 4}, {1, 10}}) EXPECT_EQ(found.count(pair), 0u);
}

TEST(CollisionFilter, IsInternedWithItsScene) {
  const Scene scene = heap();
  const int fixed[10] = {1, 1}, more[10] = {1, 1, 1};
  const cmb_collision_filter one{10, fixed, nullptr, nullptr, nullptr, 0}, other{10, more, nullptr, nullptr, nullptr, 0};
  EXPECT_EQ(intern_filtered(scene, &one), intern_filtered(scene, &one));
  EXPECT_NE(intern_filtered(scene, &one), intern_filtered(scene, &other));
  EXPECT_NE(intern_filtered(scene, &one), intern_filtered(scene));
  const cmb_collision_filter as_group{10, nullptr, fixed, nullptr, nullptr, 0};
  EXPECT_NE(intern_filtered(scene, &one), intern_filtered(scene, &as_group));
}

TEST(BroadPhase, RemembersNothing) {
  const Scene scene = random_scene(21, 80), other = random_scene(22, 50);
  const cmb_broadphase first = intern_filtered(scene), second = intern_filtered(other);
  const std::vector<cmb_contact> expected = contacts(first, scene.poses);
  const auto same = [](const cmb_contact &a, const cmb_contact &b) {
    return std::tie(a.body_a, a.body_b, a.depth, a.weight, a.point[0], a.point[1], a.point[2], a.normal[0],
                    a.normal[1], a.normal[2]) == std::tie(b.body_a, b.body_b, b.depth, b.weight, b.point[0],
                                                          b.point[1], b.point[2], b.normal[0], b.normal[1],
                                                          b.normal[2]);
  };
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      Random random(static_cast<unsigned>(thread));
      for (int repetition = 0; repetition < 20; ++repetition) {
        Poses moved;
        for (std::size_t i = 0; i < other.poses.count(); ++i) moved.add(random.vector(2.0), random.rotation());
        contacts(second, moved);
        const std::vector<cmb_contact> found = contacts(first, scene.poses);
        if (!std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) ++wrong;
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(BroadPhase, SaysWhatIsWrong) {
  const Scene scene = heap();
  const cmb_scene handle = intern(scene.geometry, {});
  cmb_broadphase broadphase{-7};
  const auto refused = [&](cmb_scene which, const cmb_collision_filter *filter, const char *says) {
    EXPECT_EQ(cmb_intern_broadphase(which, filter, &broadphase), CMB_ERROR_ARGUMENT);
    EXPECT_NE(std::string(cmb_last_error()).find(says), std::string::npos) << cmb_last_error();
    EXPECT_EQ(broadphase.number, -7);
  };
  refused({99999}, nullptr, "no scene 99999");
  const cmb_collision_filter small{9, nullptr, nullptr, nullptr, nullptr, 0};
  refused(handle, &small, "filter for 9 bodies for a scene of 10");
  const int wrong[] = {1, 2, 3, 11};
  const cmb_collision_filter filter{10, nullptr, nullptr, nullptr, wrong, 2};
  const cmb_collision_filter missing{10, nullptr, nullptr, nullptr, nullptr, 1};
  refused(handle, &filter, "excluded pair 2 names body 11");
  refused(handle, &missing, "excluded is NULL");
  EXPECT_EQ(cmb_intern_broadphase(handle, nullptr, nullptr), CMB_ERROR_ARGUMENT);

  broadphase = intern_filtered(scene);
  std::size_t count = 12345;
  Poses poses = scene.poses;
  const auto status = [&](cmb_broadphase which, std::size_t bodies, std::size_t capacity) {
    return query_candidates(which, poses.position.data(), poses.rotation.data(), bodies, capacity, nullptr, &count);
  };
  EXPECT_EQ(status({99999}, 10, 0), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(status(broadphase, 9, 0), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(status(broadphase, 10, 1), CMB_ERROR_ARGUMENT);
  poses.position[14] = NAN;
  EXPECT_EQ(status(broadphase, 10, 0), CMB_ERROR_POSE);
  EXPECT_NE(std::string(cmb_last_error()).find("body 5"), std::string::npos) << cmb_last_error();
  EXPECT_EQ(count, 12345u);
}

TEST(BroadPhase, AcceptsAnEmptyScene) {
  const Scene scene;
  EXPECT_TRUE(candidates(intern_filtered(scene), scene.poses).empty());
}

}  // namespace
