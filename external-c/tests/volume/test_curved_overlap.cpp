// Overlaps of curved bodies with half-spaces, against sums over flat pieces of their surface and closed forms.
#include <cmath>
#include <functional>
#include <vector>

#include "contact_multibody.h"
#include "support/engine_calls.hpp"
#include "support/scene_query.hpp"

namespace test_curved_overlap {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;

struct Sums {
  double volume = 0.0, shadow = 0.0;
  Vec3 centroid, patch;
  double second[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
};

// A solid below z = 0, by flat pieces of its surface.
class FlatPieces {
 public:
  explicit FlatPieces(const BodyPose &pose) : pose_(pose) {}

  // A triangle in the body's axes, counter-clockwise seen from outside.
  void add(const Vec3 &p, const Vec3 &q, const Vec3 &r) {
    const Vec3 corner[3] = {pose_.position + pose_.rotation * p, pose_.position + pose_.rotation * q,
                            pose_.position + pose_.rotation * r};
    std::vector<Vec3> below;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &from = corner[k], &to = corner[(k + 1) % 3];
      if (from.z <= 0.0) below.push_back(from);
      if ((from.z < 0.0) != (to.z < 0.0) && from.z != to.z) below.push_back(from + (from.z / (from.z - to.z)) * (to - from));
    }
    for (std::size_t k = 1; k + 1 < below.size(); ++k) add_below(below[0], below[k], below[k + 1]);
  }
  Sums sums() const {
    Sums result;
    result.volume = volume_, result.shadow = shadow_;
    if (volume_ > 0.0) result.centroid = (1.0 / volume_) * moment_;
    if (shadow_ > 0.0) result.patch = (1.0 / shadow_) * patch_;
    result.patch.z = shadow_ > 0.0 ? lower_ / shadow_ + 0.5 * volume_ / shadow_ : 0.0;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) result.second[3 * i + j] = second_[i][j] - shadow_ * result.patch[i] * result.patch[j];
    }
    return result;
  }

 private:
  void add_below(const Vec3 &p, const Vec3 &q, const Vec3 &r) {
    const double up = 0.5 * cross(q - p, r - p).z;  // of its shadow, with a sign
    // Exact for squares: a third at the middle of each side.
    for (const Vec3 &m : {0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)}) {
      const double part = up / 3.0;
      volume_ += part * m.z;
      moment_ = moment_ + (part * m.z) * Vec3{m.x, m.y, 0.5 * m.z};
      if (up >= 0.0) continue;
      shadow_ -= part;
      lower_ -= part * m.z;
      patch_ = patch_ - part * Vec3{m.x, m.y, 0.0};
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) second_[i][j] -= part * m[i] * m[j];
      }
    }
  }

  BodyPose pose_;
  double volume_ = 0.0, shadow_ = 0.0, lower_ = 0.0, second_[2][2] = {{0, 0}, {0, 0}};
  Vec3 moment_, patch_;
};

// A profile about the z axis, stretched: points from the lower to the upper end, as radius and height.
using Profile = std::function<Vec3(double)>;  // x: radius, z: height, over 0 to 1

Sums add_up(const Profile &profile, const Vec3 &stretch, const BodyPose &pose, int around, int along) {
  FlatPieces pieces(pose);
  std::vector<Vec3> outline, turn;  // each once: sines take longer than all else
  for (int j = 0; j <= along; ++j) outline.push_back(profile(static_cast<double>(j) / along));
  for (int i = 0; i <= around; ++i) {
    const double angle = 2.0 * pi * i / around;
    turn.push_back({std::cos(angle), std::sin(angle), 1.0});
  }
  const auto at = [&](int i, int j) {
    const Vec3 &p = outline[static_cast<std::size_t>(j)], &t = turn[static_cast<std::size_t>(i)];
    return Vec3{stretch.x * p.x * t.x, stretch.y * p.x * t.y, stretch.z * p.z};
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      pieces.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      pieces.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return pieces.sums();
}

// Flat pieces are off by the square of their size: two sizes tell what no size would give.
double limit(double coarse, double fine) { return (4.0 * fine - coarse) / 3.0; }

cmb_overlap overlap_of(const std::string &body, const BodyPose &pose) {
  const PairScene scene(body, "cmb/1 halfspace");
  double position[6] = {pose.position.x, pose.position.y, pose.position.z, 0, 0, 0};
  double rotation[18] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation[3 * i + j] = pose.rotation.row[j][i];
  }
  cmb_overlap overlap;
  EXPECT_EQ(query_overlap(scene.handle(), 1, position, rotation, 2, &overlap), CMB_OK) << cmb_last_error();
  return overlap;
}

struct Case {
  const char *name, *body;
  Profile profile;
  Vec3 stretch;
  int along;  // pieces; a multiple of the profile's straight and round parts
};

void PrintTo(const Case &c, std::ostream *stream) { *stream << c.name; }

Vec3 between(const Vec3 &p, const Vec3 &q, double part) { return (1.0 - part) * p + part * q; }

const Case cases[] = {
    {"capsule", "cmb/1 capsule radius=0.2 length=0.6",
     [](double s) {
       // Thirds: the lower half sphere, the side, the upper one.
       const double part = 3.0 * s;
       if (part < 1.0) return Vec3{0.2 * std::sin(0.5 * pi * part), 0, -0.3 - 0.2 * std::cos(0.5 * pi * part)};
       if (part < 2.0) return Vec3{0.2, 0, -0.3 + 0.6 * (part - 1.0)};
       return Vec3{0.2 * std::cos(0.5 * pi * (part - 2.0)), 0, 0.3 + 0.2 * std::sin(0.5 * pi * (part - 2.0))};
     },
     {1, 1, 1}, 240},
    {"cylinder", "cmb/1 cylinder radius=0.3 length=0.5",
     [](double s) {
       const double part = 3.0 * s;
       if (part < 1.0) return Vec3{0.3 * part, 0, -0.25};
       return part < 2.0 ? Vec3{0.3, 0, -0.25 + 0.5 * (part - 1.0)} : Vec3{0.3 * (3.0 - part), 0, 0.25};
     },
     {1, 1, 1}, 3},
    {"cone", "cmb/1 cone radius=0.3 length=0.5",
     [](double s) {
       const double part = 2.0 * s;
       return part < 1.0 ? Vec3{0.3 * part, 0, -0.25} : between({0.3, 0, -0.25}, {0, 0, 0.25}, part - 1.0);
     },
     {1, 1, 1}, 2},
    {"ellipsoid", "cmb/1 ellipsoid size=0.6,0.8,0.3",
     [](double s) { return Vec3{std::sin(pi * s), 0, -std::cos(pi * s)}; }, {0.3, 0.4, 0.15}, 160},
};

class CurvedOverlap : public testing::TestWithParam<Case> {};

TEST_P(CurvedOverlap, EqualsSumsOverFlatPieces) {
  const Case &c = GetParam();
  const int around = c.along > 10 ? 320 : 4000;
  for (const double tilt : {0.0, 0.4, 1.1, 2.0, 2.8}) {
    const Mat3 rotation = product(rotation_about({0, 0, 1}, 0.7), rotation_about({0.6, 0.8, 0}, tilt));
    for (const double height : {0.15, 0.05, -0.05, -0.2}) {
      const BodyPose pose{{0.1, -0.2, height}, rotation};
      const cmb_overlap overlap = overlap_of(c.body, pose);
      const int finer = c.along > 10 ? 2 : 1;
      const Sums coarse = add_up(c.profile, c.stretch, pose, around, c.along);
      const Sums fine = add_up(c.profile, c.stretch, pose, 2 * around, finer * c.along);
      ASSERT_EQ(overlap.known, 1);
      // The outline of a round body's flat pieces goes to and fro: the limit of its shadow is known less well.
      const double shadow_error = c.along > 10 ? 1e-5 : 1e-6;
      const auto check = [&](double found, double of_coarse, double of_fine, double size, const char *what) {
        EXPECT_NEAR(found, limit(of_coarse, of_fine), size) << what << " " << tilt << " " << height;
      };
      check(overlap.volume, coarse.volume, fine.volume, 1e-7, "volume");
      check(overlap.patch_area, coarse.shadow, fine.shadow, shadow_error * 0.3, "area");
      if (fine.volume < 1e-4) continue;
      for (int i = 0; i < 3; ++i) {
        check(overlap.centroid[i], coarse.centroid[i], fine.centroid[i], 1e-6, "centroid");
        check(overlap.patch_centroid[i], coarse.patch[i], fine.patch[i], shadow_error, "patch");
      }
      for (int i = 0; i < 9; ++i) check(overlap.patch_moment[i], coarse.second[i], fine.second[i], shadow_error * 0.1, "moment");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CurvedOverlap, testing::ValuesIn(cases));

TEST(CurvedOverlapClosedForms, UprightLyingWholeAndNone) {
  const Mat3 upright, lying = rotation_about({0, 1, 0}, pi / 2), turned = rotation_about({1, 0, 0}, pi);
  // A standing cylinder and cone, 0.1 deep.
  const cmb_overlap cylinder = overlap_of("cmb/1 cylinder radius=0.3 length=0.5", {{1, 2, 0.15}, upright});
  const double disc = pi * 0.09;
  EXPECT_NEAR(cylinder.volume, 0.1 * disc, 1e-13);
  EXPECT_NEAR(cylinder.centroid[0], 1.0, 1e-12);
  EXPECT_NEAR(cylinder.centroid[2], -0.05, 1e-12);
  EXPECT_NEAR(cylinder.patch_area, disc, 1e-12);
  EXPECT_NEAR(cylinder.patch_centroid[2], -0.05, 1e-12);
  EXPECT_NEAR(cylinder.patch_moment[0], disc * 0.09 / 4, 1e-12);
  EXPECT_NEAR(cylinder.patch_moment[4], disc * 0.09 / 4, 1e-12);
  const cmb_overlap tip = overlap_of("cmb/1 cone radius=0.3 length=0.5", {{0, 0, 0.15}, turned});
  const double r = 0.3 * 0.1 / 0.5;
  EXPECT_NEAR(tip.volume, pi * r * r * 0.1 / 3, 1e-14);
  EXPECT_NEAR(tip.centroid[2], -0.025, 1e-11);
  EXPECT_NEAR(tip.patch_area, pi * r * r, 1e-13);
  // A lying cylinder: segments of a circle.
  const cmb_overlap side = overlap_of("cmb/1 cylinder radius=0.3 length=0.5", {{0, 0, 0.2}, lying});
  const double half = std::acos(2.0 / 3.0), segment = 0.09 * (half - std::sin(half) * std::cos(half));
  EXPECT_NEAR(side.volume, 0.5 * segment, 1e-12);
  EXPECT_NEAR(side.patch_area, 0.5 * 2 * 0.3 * std::sin(half), 1e-12);
  EXPECT_NEAR(side.centroid[2], 0.2 - 2.0 / 3.0 * 0.027 * std::pow(std::sin(half), 3) / segment, 1e-11);
  // A lying capsule: the same and a sphere's cap.
  const cmb_overlap capsule = overlap_of("cmb/1 capsule radius=0.3 length=0.5", {{0, 0, 0.2}, lying});
  const double cap = pi * 0.01 * (0.9 - 0.1) / 3;
  EXPECT_NEAR(capsule.volume, 0.5 * segment + cap, 1e-12);
  EXPECT_NEAR(capsule.patch_area, 0.5 * 2 * 0.3 * std::sin(half) + pi * 0.1 * 0.5, 1e-12);
  // An ellipsoid's cap: that of the unit sphere, stretched.
  const cmb_overlap bowl = overlap_of("cmb/1 ellipsoid size=0.6,0.8,0.4", {{0, 0, 0.1}, upright});
  EXPECT_NEAR(bowl.volume, 0.3 * 0.4 * 0.2 * pi * 0.25 * 2.5 / 3, 1e-13);
  EXPECT_NEAR(bowl.patch_area, pi * 0.3 * 0.4 * 0.75, 1e-12);
  // Shadows of what is below as a whole.
  const Mat3 slanted = rotation_about({0, 1, 0}, 0.6);
  const double sine = std::sin(0.6), cosine = std::cos(0.6);
  EXPECT_NEAR(overlap_of("cmb/1 capsule radius=0.3 length=0.5", {{0, 0, -2}, slanted}).patch_area,
              pi * 0.09 + 0.6 * 0.5 * sine, 1e-11);
  EXPECT_NEAR(overlap_of("cmb/1 cylinder radius=0.3 length=0.5", {{0, 0, -2}, slanted}).patch_area,
              pi * 0.09 * cosine + 0.6 * 0.5 * sine, 1e-11);
  EXPECT_NEAR(overlap_of("cmb/1 ellipsoid size=0.6,0.8,0.4", {{0, 0, -2}, slanted}).patch_area,
              pi * 0.4 * std::hypot(0.2 * sine, 0.3 * cosine), 1e-11);
  // All of them below, tilted, and none.
  const Mat3 tilted = rotation_about({0.6, 0.8, 0}, 0.9);
  const struct {
    const char *text;
    double volume;
  } bodies[] = {{"cmb/1 cylinder radius=0.3 length=0.5", 0.5 * disc},
                {"cmb/1 cone radius=0.3 length=0.5", 0.5 * disc / 3},
                {"cmb/1 capsule radius=0.3 length=0.5", 0.5 * disc + 4.0 / 3.0 * pi * 0.027},
                {"cmb/1 ellipsoid size=0.6,0.8,0.4", 4.0 / 3.0 * pi * 0.024}};
  for (const auto &body : bodies) {
    EXPECT_NEAR(overlap_of(body.text, {{0, 0, -2}, tilted}).volume, body.volume, 1e-12) << body.text;
    EXPECT_EQ(overlap_of(body.text, {{0, 0, 2}, tilted}).volume, 0.0) << body.text;
    EXPECT_EQ(overlap_of(body.text, {{0, 0, 2}, tilted}).known, 1) << body.text;
  }
}

// Whatever is below one side of a plane and whatever is below the other are the whole.
TEST(CurvedOverlapClosedForms, BothSidesOfAPlaneAddUp) {
  for (const char *body : {"cmb/1 cylinder radius=0.3 length=0.5", "cmb/1 cone radius=0.3 length=0.5",
                           "cmb/1 capsule radius=0.3 length=0.5", "cmb/1 ellipsoid size=0.6,0.8,0.4"}) {
    const double whole = overlap_of(body, {{0, 0, -3}, {}}).volume;
    for (int k = 0; k < 60; ++k) {
      const Mat3 rotation = rotation_about(normalized(Vec3{std::sin(1.0 * k), std::cos(2.0 * k), std::sin(3.0 * k + 1)}), 0.37 * k);
      const Mat3 over = product(rotation_about({1, 0, 0}, pi), rotation);
      const double height = 0.25 * std::sin(5.0 * k);
      const double below = overlap_of(body, {{0, 0, height}, rotation}).volume;
      const double above = overlap_of(body, {{0, 0, -height}, over}).volume;
      EXPECT_NEAR(below + above, whole, 1e-9 * whole) << body << " " << k;
    }
  }
}

}  // namespace
}  // namespace test_curved_overlap
