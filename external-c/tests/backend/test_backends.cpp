// Back ends: selected, checked, and answered for where they fail.
#include <random>

#include "backend/distance_library.hpp"
#include "c_api/pose_check.hpp"
#include "math/pose_algebra.hpp"
#include "query/pair_query.hpp"
#include "support/engine_calls.hpp"
#include "scene/descriptor.hpp"
#include "support/mesh_text.hpp"
#include "support/scene_query.hpp"

namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;

const char *const convex_shapes[] = {
    "cmb/1 sphere radius=0.4",
    "cmb/1 box size=0.6,0.8,1",
    "cmb/1 capsule radius=0.25 length=0.7",
    "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.4,0.35,-0.3,-0.2,0.2,0.45,-0.1",
    "cmb/1 ellipsoid size=1,0.7,0.5",
    "cmb/1 cylinder radius=0.3 length=0.8",
    "cmb/1 cone radius=0.4 length=0.9"};

struct Counts {
  unsigned long long answered = 0, refused = 0;
};

Counts counts(const PairScene &scene) {
  Counts result;
  EXPECT_EQ(cmb_backend_counts(scene.handle(), &result.answered, &result.refused), CMB_OK);
  return result;
}

// Since `before`: equal scenes are one, with one count.
Counts counts(const PairScene &scene, const Counts &before) {
  const Counts now = counts(scene);
  return {now.answered - before.answered, now.refused - before.refused};
}

class Libraries : public testing::TestWithParam<cmb_backend> {
 protected:
  void SetUp() override {
    cmb_scene scene{};
    if (intern_scene(nullptr, 0, nullptr, 0, GetParam(), &scene) != CMB_OK) {
      EXPECT_NE(std::string(cmb_last_error()).find("the module libContactMultiBody"), std::string::npos);
      GTEST_SKIP() << cmb_last_error();
    }
  }
};

// A pair of shapes as the library holds them, asked directly.
struct Direct {
  const cmb::DistanceLibrary &library;
  cmb::Shape a, b;

  Direct(cmb_backend backend, const char *of_a, const char *of_b)
      : library(*cmb::distance_library(backend)), a(held(of_a)), b(held(of_b)) {}

  // The library's answer, if it has one.
  bool ask(const BodyPose &pose, cmb::SignedDistance &answer) const {
    const PairPoses poses(pose, {});  // read as a scene reads them, so that all bits are the same
    cmb::Pose body;
    EXPECT_EQ(cmb::read_body_pose(0, poses.position, poses.rotation, body), CMB_OK);
    return library.distance(a, cmb::compose(body, a.in_body), b, b.in_body, answer);
  }

 private:
  cmb::Shape held(const char *text) const {
    cmb::Shape shape = cmb::parse_descriptor(text).front();
    if (library.make_shape != nullptr) shape.in_library.reset(library.make_shape(shape));
    return shape;
  }
};

TEST_P(Libraries, AnswersAreUsedAsTheyAre) {
  std::mt19937 engine(7);
  const auto random = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 5) / 134217728.0);
  };
  unsigned long long answered = 0;
  double largest_error = 0.0;
  for (const char *a : convex_shapes) {
    for (const char *b : convex_shapes) {
      const PairScene exact(a, b), library(a, b, GetParam());
      const Direct direct(GetParam(), a, b);
      for (int k = 0; k < 12; ++k) {
        const BodyPose pose{{random(-0.6, 0.6), random(-0.6, 0.6), random(-0.6, 0.6)},
                            rotation_about(normalized(Vec3{random(-1, 1), random(-1, 1), 1.1}), random(-3, 3))};
        const double truth = exact.query(pose, {}).distance;
        const Counts before = counts(library);
        const Contact found = library.query(pose, {});
        const Counts seen = counts(library, before);
        ASSERT_EQ(seen.answered + seen.refused, 1u) << a << " | " << b;
        if (seen.answered == 0) {
          ASSERT_EQ(found.distance, truth) << a << " | " << b;
          continue;
        }
        ++answered;
        cmb::SignedDistance theirs;
        ASSERT_TRUE(direct.ask(pose, theirs)) << a << " | " << b;
        ASSERT_EQ(found.distance, theirs.distance) << a << " | " << b;
        if (found.points.size() == 1) {
          ASSERT_NEAR(dot(found.points.front().normal, theirs.normal), 1.0, 1e-12) << a << " | " << b;
        }
        // What is true along a normal is never more than the signed distance; apart it is the distance.
        ASSERT_LE(theirs.distance, truth + 2e-4) << a << " | " << b;
        if (truth > 2e-4) {
          ASSERT_NEAR(theirs.distance, truth, 2e-4) << a << " | " << b;
        } else if (truth < 0.0) {
          ASSERT_LT(theirs.distance, 0.0) << a << " | " << b;
          ASSERT_GT(norm(found.load()), 0.0) << a << " | " << b;
        }
        largest_error = std::fmax(largest_error, std::fabs(theirs.distance - truth));
      }
    }
  }
  EXPECT_GT(answered, 100u);  // the library is really asked
  // Portal refinement does not look for the least depth: its error is there to be seen.
  if (GetParam() == CMB_BACKEND_LIBCCD) {
    EXPECT_GT(largest_error, 1e-2);
  }
}

// The exact path is not asked where the library has answered.
TEST_P(Libraries, NothingIsComputedBesideTheirAnswer) {
  const char *const box = convex_shapes[1];
  const PairScene library(box, box, GetParam());
  const auto &exact = cmb::query_scratch().backend.distance.counters;
  const auto queries = exact.queries;
  const Counts before = counts(library);
  for (int k = 0; k < 20; ++k) {
    const BodyPose pose{{0.3, 0.2, 0.64 + 0.005 * k}, rotation_about(normalized(Vec3{1, 2, 3}), 1.1 + 0.01 * k)};
    const Contact found = library.query(pose, {}, 64);
    ASSERT_LT(found.distance, 0.0);
    EXPECT_GT(norm(found.load()), 0.0);
  }
  const Counts seen = counts(library, before);
  EXPECT_GE(seen.answered, 10u);
  EXPECT_EQ(seen.answered + seen.refused, 20u);
  EXPECT_EQ(exact.queries - queries, seen.refused);
}

TEST_P(Libraries, ShallowOverlapsStayOverlaps) {
  // Well within the depth that an answer may be off by.
  std::mt19937 engine(3);
  const auto random = [&] { return static_cast<double>(engine() >> 5) / 134217728.0 - 0.5; };
  for (const char *a : convex_shapes) {
    for (const char *b : convex_shapes) {
      const PairScene exact(a, b), library(a, b, GetParam());
      for (int k = 0; k < 10; ++k) {
        const Vec3 way = normalized(Vec3{random(), random(), random()});
        BodyPose pose{2.0 * way, rotation_about(normalized(Vec3{random(), random(), 1.1}), 6 * random())};
        for (int step = 0; step < 60; ++step) pose.position = pose.position - exact.query(pose, {}).distance * way;
        pose.position = pose.position - 4e-5 * way;
        const Contact contact = exact.query(pose, {});
        if (!(contact.distance < 0.0)) continue;
        const Contact answer = library.query(pose, {});
        ASSERT_LT(answer.distance, 0.0) << a << " | " << b << " | " << k;
        ASSERT_GT(norm(answer.load()), 0.0) << a << " | " << b << " | " << k;
      }
    }
  }
}

TEST_P(Libraries, FailuresAreRefusedAndAnswered) {
  // Aligned and concentric cubes: no direction, no depth, or too deep a one, from the libraries.
  const PairScene exact("cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1");
  const PairScene library("cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1", GetParam());
  const BodyPose poses[] = {{{0, 0, 0}, {}},
                            {{0, 0, 0.999}, {}},
                            {{0.5, 0.5, 0.5}, {}},
                            {{0, 0, 1.0}, {}},
                            {{1, 1, 1}, {}},
                            {{0, 0, std::sqrt(0.75) + 0.3},
                             rotation_about(normalized(Vec3{1, -1, 0}), std::acos(1 / std::sqrt(3.0)))}};
  for (const BodyPose &pose : poses) {
    const Counts before = counts(library);
    const Contact contact = library.query(pose, {});
    const double truth = exact.query(pose, {}).distance;
    if (counts(library).refused > before.refused) {
      EXPECT_EQ(contact.distance, truth);
    } else {
      EXPECT_LE(contact.distance, truth + 2e-4);
    }
  }
  const Counts seen = counts(library);
  EXPECT_EQ(seen.answered + seen.refused, std::size(poses));
  if (GetParam() != CMB_BACKEND_COAL) {
    EXPECT_GE(seen.refused, 1u);  // coal is right here
  }
}

TEST_P(Libraries, WhoAnsweredCanBeAsked) {
  const PairScene spheres("cmb/1 sphere radius=0.5", "cmb/1 sphere radius=0.5", GetParam());
  const double position[] = {0.3, 0.2, 0.8, 0, 0, 0};
  const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  cmb_backend who = CMB_BACKEND_AUTO;
  ASSERT_EQ(query_backend(spheres.handle(), 1, position, rotation, 2, &who), CMB_OK);
  EXPECT_EQ(who, GetParam());
  const PairScene on_floor("cmb/1 sphere radius=0.5", "cmb/1 halfspace", GetParam());
  ASSERT_EQ(query_backend(on_floor.handle(), 1, position, rotation, 2, &who), CMB_OK);
  EXPECT_EQ(who, CMB_BACKEND_ANALYTIC);
  const PairScene bare("", "cmb/1 halfspace", GetParam());
  ASSERT_EQ(query_backend(bare.handle(), 1, position, rotation, 2, &who), CMB_OK);
  EXPECT_EQ(who, CMB_BACKEND_AUTO);
}

// Closed convex meshes are hulls to libraries as well; other meshes are the engine's.
TEST_P(Libraries, AnswerForConvexMeshes) {
  using namespace mesh_samples;
  const std::string box = "cmb/1 box size=1,1,1";
  const PairScene convex(mesh_text(box_mesh({1, 1, 1}, 2)), box, GetParam());
  const PairScene other(mesh_text(with_speck(box_mesh({1, 1, 1}, 2))), box, GetParam());
  // libccd has no distances apart, FCL none of hulls in each other.
  const double height = GetParam() == CMB_BACKEND_LIBCCD ? 0.9 : 1.3, position[] = {0.3, 0.2, height, 0, 0, 0};
  const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  cmb_backend who = CMB_BACKEND_AUTO;
  ASSERT_EQ(query_backend(convex.handle(), 1, position, rotation, 2, &who), CMB_OK);
  EXPECT_EQ(who, GetParam());
  ASSERT_EQ(query_backend(other.handle(), 1, position, rotation, 2, &who), CMB_OK);
  EXPECT_EQ(who, CMB_BACKEND_ANALYTIC);
  EXPECT_NEAR(convex.query({{0.3, 0.2, height}, {}}, {}).distance, height - 1.0, 1e-4);
}

// What a library has not been given it does not answer for.
TEST_P(Libraries, AnswerForShapesThatTheyHoldAlone) {
  using namespace cmb;
  const DistanceLibrary &library = *distance_library(GetParam());
  if (library.make_shape == nullptr) GTEST_SKIP() << "takes the engine's shapes";
  const Shape cube = parse_descriptor("cmb/1 box size=1,1,1").front();
  const Shape mesh = parse_descriptor(mesh_samples::mesh_text(mesh_samples::with_speck(mesh_samples::box_mesh({1, 1, 1})))).front();
  EXPECT_EQ(library.make_shape(mesh), nullptr);
  Shape held = cube;
  held.in_library.reset(library.make_shape(cube));
  ASSERT_NE(held.in_library, nullptr);
  const Pose apart{Mat3{}, {1.5, 0, 0}};
  SignedDistance answer;
  ASSERT_TRUE(library.distance(held, apart, held, {}, answer));
  EXPECT_NEAR(answer.distance, 0.5, 1e-6);
  EXPECT_FALSE(library.distance(cube, apart, cube, {}, answer));
  EXPECT_FALSE(library.distance(held, apart, cube, {}, answer));
  EXPECT_FALSE(library.distance(cube, apart, held, {}, answer));
}

INSTANTIATE_TEST_SUITE_P(All, Libraries, testing::Values(CMB_BACKEND_LIBCCD, CMB_BACKEND_FCL, CMB_BACKEND_COAL));

TEST(OwnBackends, NeedNoLibrary) {
  EXPECT_EQ(cmb::distance_library(CMB_BACKEND_AUTO), nullptr);
  EXPECT_EQ(cmb::distance_library(CMB_BACKEND_ANALYTIC), nullptr);
}

// A sphere of radius 1 at 2.5 from another one: what is true of them, and what is not.
TEST(AnswerCheck, TakesWhatIsTrueAlone) {
  using namespace cmb;
  const Shape ball = parse_descriptor("cmb/1 sphere radius=1").front();
  const Pose right{Mat3{}, {2.5, 0, 0}};
  SignedDistance truth;
  truth.distance = 0.5, truth.normal = {1, 0, 0}, truth.point_a = {1.5, 0, 0}, truth.point_b = {1, 0, 0};
  const auto holds = [&](const SignedDistance &answer) { return answer_holds(answer, ball, right, ball, {}, 1e-6); };
  EXPECT_TRUE(holds(truth));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    SignedDistance distance = truth, normal = truth, point_a = truth, point_b = truth;
    distance.distance = bad, normal.normal.y = bad, point_a.point_a.z = bad, point_b.point_b.x = bad;
    for (const SignedDistance &answer : {distance, normal, point_a, point_b}) EXPECT_FALSE(holds(answer)) << bad;
  }
  SignedDistance longer = truth, aside = truth, nearer = truth, elsewhere = truth;
  longer.normal.x = 1.0 + 1e-6, aside.normal = {0.8, 0.6, 0}, nearer.distance = 0.49, elsewhere.point_a.y = 0.01;
  for (const SignedDistance &answer : {longer, aside, nearer, elsewhere}) EXPECT_FALSE(holds(answer));
  // Within the slack, but of the wrong sign: apart by less than a micrometre, or not.
  const Pose touching{Mat3{}, {2.0 - 4e-7, 0, 0}};
  SignedDistance apart = truth;
  apart.distance = 4e-7, apart.point_a = {1.0, 0, 0};
  EXPECT_FALSE(answer_holds(apart, ball, touching, ball, {}, 1e-6));
  apart.distance = -4e-7;
  EXPECT_TRUE(answer_holds(apart, ball, touching, ball, {}, 1e-6));
}

TEST(Boxes, DepthOnTheDiagonalIsTheMinimumTranslation) {
  // A cube stands on its diagonal, 0.2 deep in a wide table: other engines say 0.346.
  const Mat3 upright = rotation_about(normalized(Vec3{1, -1, 0}), std::acos(1 / std::sqrt(3.0)));
  const Vec3 top = upright * Vec3{-0.5, -0.5, -0.5};
  const PairScene scene("cmb/1 box size=1,1,1", "cmb/1 box size=10,10,2 position=0,0,-1");
  const Contact contact = scene.query({{0, 0, std::fabs(top.z) - 0.2}, upright}, {});
  EXPECT_NEAR(contact.distance, std::fabs(top.z) > 0.8 ? -0.2 : contact.distance, 1e-12);
  EXPECT_NEAR(std::fabs(top.z), std::sqrt(0.75), 1e-12);
}

// Independent oracle: separating axes of two boxes, for overlap and its depth.
double box_overlap_depth(const Vec3 &half_a, const BodyPose &a, const Vec3 &half_b, const BodyPose &b) {
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i) axes.push_back(a.rotation.column(i));
  for (int i = 0; i < 3; ++i) axes.push_back(b.rotation.column(i));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 axis = cross(a.rotation.column(i), b.rotation.column(j));
      if (norm(axis) > 1e-6) axes.push_back(normalized(axis));
    }
  }
  double depth = 1e30;
  for (const Vec3 &axis : axes) {
    double reach = 0.0;
    for (int i = 0; i < 3; ++i) {
      reach += half_a[i] * std::fabs(dot(axis, a.rotation.column(i)));
      reach += half_b[i] * std::fabs(dot(axis, b.rotation.column(i)));
    }
    depth = std::fmin(depth, reach - std::fabs(dot(axis, a.position - b.position)));
  }
  return depth;
}

TEST(Boxes, DepthEqualsThatOfTheSeparatingAxes) {
  std::mt19937 engine(11);
  const auto random = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 5) / 134217728.0);
  };
  const Vec3 half_a{0.3, 0.4, 0.5}, half_b{0.6, 0.2, 0.45};
  const PairScene scene("cmb/1 box size=0.6,0.8,1", "cmb/1 box size=1.2,0.4,0.9");
  int overlapping = 0;
  for (int k = 0; k < 3000; ++k) {
    const BodyPose pose{{random(-1, 1), random(-1, 1), random(-1, 1)},
                        rotation_about(normalized(Vec3{random(-1, 1), random(-1, 1), 1.1}), random(-pi, pi))};
    const double depth = box_overlap_depth(half_a, pose, half_b, {});
    const double distance = scene.query(pose, {}, 4).distance;
    ASSERT_EQ(depth > 0.0, distance < 0.0) << k;
    if (depth > 0.0) {
      ASSERT_NEAR(distance, -depth, 1e-12) << k;
      ++overlapping;
    } else {
      ASSERT_GE(distance, -depth - 1e-12) << k;  // the Euclidean distance is at least the largest gap
    }
  }
  EXPECT_GT(overlapping, 500);
}

}  // namespace
