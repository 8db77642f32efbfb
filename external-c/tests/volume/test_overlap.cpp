// Overlap volume, patch area and centroids against closed forms.
#include "support/engine_calls.hpp"
#include "support/scene_query.hpp"

namespace test_overlap {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;

cmb_overlap overlap_of(const PairScene &scene, const Vec3 &position_a, const Mat3 &rotation_a = {}) {
  const double position[] = {position_a.x, position_a.y, position_a.z, 0, 0, 0};
  double rotation[18] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation[3 * i + j] = rotation_a.row[j][i];
  }
  cmb_overlap result;
  EXPECT_EQ(query_overlap(scene.handle(), 1, position, rotation, 2, &result), CMB_OK) << cmb_last_error();
  return result;
}

TEST(Overlap, BoxesOverlapInABox) {
  const PairScene scene("cmb/1 box size=1,1,1", "cmb/1 box size=4,4,1");
  const cmb_overlap inside = overlap_of(scene, {0.3, 0.2, 0.9});
  EXPECT_EQ(inside.known, 1);
  EXPECT_NEAR(inside.volume, 0.1, 1e-14);
  EXPECT_NEAR(inside.patch_area, 1.0, 1e-13);
  EXPECT_NEAR(norm(Vec3{inside.centroid[0], inside.centroid[1], inside.centroid[2]} - Vec3{0.3, 0.2, 0.45}), 0, 1e-13);
  const cmb_overlap over_border = overlap_of(scene, {2.2, 0, 0.9});
  EXPECT_NEAR(over_border.volume, 0.03, 1e-14);
  EXPECT_NEAR(over_border.patch_centroid[0], 1.85, 1e-13);
  EXPECT_NEAR(over_border.patch_centroid[2], 0.45, 1e-13);
  EXPECT_EQ(overlap_of(scene, {0, 0, 1.5}).volume, 0.0);
}

TEST(Overlap, BoxAndHalfspaceAtAnyDepth) {
  const PairScene scene("cmb/1 box size=1,2,3", "cmb/1 halfspace");
  for (const double depth : {0.01, 1.0, 2.5, 3.0, 3.5, 50.0}) {
    const cmb_overlap overlap = overlap_of(scene, {5, 6, 1.5 - depth});
    const double part = std::fmin(depth, 3.0);
    EXPECT_NEAR(overlap.volume, 2.0 * part, 1e-11) << depth;
    EXPECT_NEAR(overlap.centroid[0], 5.0, 1e-11) << depth;
    EXPECT_NEAR(overlap.centroid[2], -depth + 0.5 * part, 1e-11) << depth;
  }
  EXPECT_EQ(overlap_of(scene, {0, 0, 1.6}).volume, 0.0);
  EXPECT_EQ(overlap_of(scene, {0, 0, 9.0}).volume, 0.0);
}

TEST(Overlap, CornerOfACubeIsATetrahedron) {
  const PairScene scene("cmb/1 box size=1,1,1", "cmb/1 halfspace");
  const Mat3 upright = rotation_about(normalized(cross(Vec3{1, 1, 1}, Vec3{0, 0, 1})), std::acos(1 / std::sqrt(3.0)));
  const double h = 0.1;
  const cmb_overlap overlap = overlap_of(scene, {0, 0, std::sqrt(0.75) - h}, upright);
  // Three edges of length h sqrt(3) at right angles.
  EXPECT_NEAR(overlap.volume, std::pow(h * std::sqrt(3.0), 3) / 6.0, 1e-14);
  EXPECT_NEAR(overlap.centroid[2], -0.25 * h, 1e-13);
}

TEST(Overlap, SphereAndHalfspaceIsACap) {
  const PairScene scene("cmb/1 halfspace", "cmb/1 sphere radius=0.5 position=0,0,0.5");
  const cmb_overlap half = overlap_of(scene, {0, 0, 0.5});
  EXPECT_EQ(half.known, 1);
  EXPECT_NEAR(half.volume, pi / 12.0, 1e-14);
  EXPECT_NEAR(half.patch_area, pi / 4.0, 1e-14);
  EXPECT_NEAR(half.centroid[2], 0.5 - 3.0 / 16.0, 1e-14);
  EXPECT_EQ(overlap_of(scene, {0, 0, -0.1}).volume, 0.0);
}

// A body of revolution about z, by shells of its shadow: up(r) and low(r) bound it, `reach` is the shadow's radius.
struct Shells {
  double volume = 0.0, height = 0.0, shadow = 0.0, middle = 0.0;  // of the centroid; half way between the sides' means
  template <typename Upper, typename Lower>
  Shells(double reach, Upper up, Lower low) {
    constexpr int count = 20000;
    double upper = 0.0, lower = 0.0, moment = 0.0;
    for (int k = 0; k < count; ++k) {
      // r = reach sin(angle): smooth where the sides meet upright.
      const double angle = pi / 2.0 * (k + 0.5) / count, r = reach * std::sin(angle);
      const double ring = 2.0 * pi * r * reach * std::cos(angle) * pi / 2.0 / count, u = up(r), l = low(r);
      shadow += ring;
      upper += ring * u;
      lower += ring * l;
      moment += 0.5 * ring * (u * u - l * l);
    }
    volume = upper - lower;
    height = moment / volume;
    middle = 0.5 * (upper + lower) / shadow;
  }
};

void expect_shells(const cmb_overlap &overlap, const Shells &shells, const char *what, double number) {
  EXPECT_EQ(overlap.known, 1) << what << number;
  EXPECT_NEAR(overlap.volume, shells.volume, 1e-8) << what << number;
  EXPECT_NEAR(overlap.centroid[2], shells.height, 1e-7) << what << number;
  EXPECT_NEAR(overlap.patch_area, shells.shadow, 1e-8) << what << number;
  EXPECT_NEAR(overlap.patch_centroid[2], shells.middle, 1e-7) << what << number;
}

TEST(Overlap, SphereAndHalfspaceAtAnyDepth) {
  const double r = 0.5;
  const PairScene scene("cmb/1 sphere radius=0.5", "cmb/1 halfspace");
  for (const double height : {0.45, 0.2, 0.0, -0.1, -0.4, -0.5, -3.0}) {
    const double reach = height > 0.0 ? std::sqrt(r * r - height * height) : r;
    const auto rise = [&](double x) { return std::sqrt(std::fmax(0.0, r * r - x * x)); };
    expect_shells(overlap_of(scene, {0, 0, height}),
                  Shells(reach, [&](double x) { return std::fmin(0.0, height + rise(x)); },
                         [&](double x) { return height - rise(x); }),
                  "height ", height);
  }
}

// Turned about its axis, which rounding, or a little more, tilts: the volume is that of the disc that stands straight.
TEST(Overlap, TurnedDiscOnHalfspaceTiltedByRounding) {
  const double r = 0.2, depth = 1e-6;
  const PairScene scene("cmb/1 cylinder radius=0.2 length=0.05", "cmb/1 halfspace");
  for (const double tilt : {0.0, 1e-18, 1e-17, 1e-16, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7}) {
    for (int k = 0; k < 40; ++k) {
      const double turn = 0.1 * k, c = std::cos(turn), s = std::sin(turn), slow = 1.0 + (k % 3 - 1) * 1.2e-16;
      const Mat3 rotation{{{c, -s, tilt * c}, {s, c, tilt * s}, {-tilt, tilt * 0.1, slow}}};
      const cmb_overlap overlap = overlap_of(scene, {0, 0, 0.025 - depth}, rotation);
      EXPECT_NEAR(overlap.volume, pi * r * r * depth, 1e-9 * pi * r * r * depth) << tilt << ", " << turn;
      EXPECT_NEAR(overlap.patch_area, pi * r * r, 1e-9) << tilt << ", " << turn;
    }
  }
}

TEST(Overlap, SpheresAtAnyDepth) {
  for (const double b : {0.5, 0.3, 0.8}) {
    const double a = 0.5;
    const PairScene scene("cmb/1 sphere radius=0.5", "cmb/1 sphere radius=" + digits(b));
    for (const double part : {0.02, 0.3, 0.6, 0.9, 0.99}) {
      // A above B, at distances from touching to where the smaller is just inside.
      const double distance = (a + b) + part * (std::fabs(a - b) - (a + b));
      const double plane = distance > 0.0 ? 0.5 * (distance + (b * b - a * a) / distance) : 0.0;  // from B's centre
      double reach = std::sqrt(std::fmax(0.0, b * b - plane * plane));
      if (plane < 0.0) reach = b;
      if (plane > distance) reach = a;
      const auto rise = [](double radius, double x) { return std::sqrt(std::fmax(0.0, radius * radius - x * x)); };
      expect_shells(overlap_of(scene, {0, 0, distance}),
                    Shells(reach,
                           [&](double x) { return std::fmin(rise(b, x), distance + rise(a, x)); },
                           [&](double x) { return std::fmax(-rise(b, x), distance - rise(a, x)); }),
                    "distance ", distance);
    }
  }
  const cmb_overlap inside = overlap_of(PairScene("cmb/1 sphere radius=0.2", "cmb/1 sphere radius=1"), {0.1, 0, 0});
  EXPECT_NEAR(inside.volume, 4.0 / 3.0 * pi * 0.008, 1e-15);
  EXPECT_NEAR(inside.centroid[0], 0.1, 1e-15);
  const cmb_overlap around = overlap_of(PairScene("cmb/1 sphere radius=1", "cmb/1 sphere radius=0.2"), {0.1, 0, 0});
  EXPECT_NEAR(around.volume, 4.0 / 3.0 * pi * 0.008, 1e-15);
  EXPECT_NEAR(around.centroid[0], 0.0, 1e-15);
  const cmb_overlap apart = overlap_of(PairScene("cmb/1 sphere radius=1", "cmb/1 sphere radius=0.2"), {1.3, 0, 0});
  EXPECT_EQ(apart.known, 1);
  EXPECT_EQ(apart.volume, 0.0);
}

TEST(Overlap, CrossedCapsulesAreCrossedCylinders) {
  // Of equal tubes at a right angle, their axes `off` apart: slices along both axes are rectangles.
  const double r = 0.3;
  const PairScene capsules("cmb/1 capsule radius=0.3 length=2", "cmb/1 capsule radius=0.3 length=2");
  const PairScene cylinders("cmb/1 cylinder radius=0.3 length=3", "cmb/1 cylinder radius=0.3 length=3");
  const Mat3 along_x = rotation_about({0, 1, 0}, 0.5 * pi);
  for (const double off : {0.05, 0.2, 0.4, 0.55}) {
    // Chebyshev's rule for the square root at both ends of the common stretch, the other factor being smooth.
    constexpr int count = 400;
    const double half = 0.5 * (2.0 * r - off);
    double volume = 0.0;
    for (int k = 1; k <= count; ++k) {
      const double angle = pi * k / (count + 1), y = half * std::cos(angle);  // from the middle of the stretch
      const double a = (half - y) * (half + y + off), b = (half + y) * (half - y + off);
      volume += pi / (count + 1) * half * std::sin(angle) * 4.0 * std::sqrt(a * b);
    }
    // Along y both axes are apart, so that the contact's normal is it.
    EXPECT_NEAR(overlap_of(capsules, {0, off, 0}, along_x).volume, volume, 1e-9) << off;
    EXPECT_NEAR(overlap_of(cylinders, {0, off, 0}, along_x).volume, volume, 1e-9) << off;
  }
}

TEST(Overlap, CompoundsAddUp) {
  const PairScene legs("cmb/1 box size=1,1,1 position=2,0,0;cmb/1 box size=1,1,1 position=-2,0,0", "cmb/1 halfspace");
  const cmb_overlap both = overlap_of(legs, {0, 0, 0.4});
  EXPECT_NEAR(both.volume, 0.2, 1e-13);
  EXPECT_NEAR(both.centroid[0], 0.0, 1e-12);
  const PairScene capsule("cmb/1 capsule radius=0.5 length=1", "cmb/1 box size=1,1,1");
  EXPECT_EQ(overlap_of(capsule, {0, 0, 0.5}).known, 1);
  EXPECT_EQ(overlap_of(capsule, {0, 0, 5.0}).known, 1);
  EXPECT_EQ(overlap_of(PairScene("", "cmb/1 halfspace"), {}).known, 1);
  EXPECT_EQ(overlap_of(PairScene("cmb/1 halfspace", "cmb/1 halfspace"), {}).known, 1);
}

TEST(Overlap, PatchHasItsSecondMoment) {
  const cmb_overlap face = overlap_of(PairScene("cmb/1 box size=1,2,3", "cmb/1 halfspace"), {5, 6, 1.4});
  const double of_face[] = {2.0 / 12.0, 0, 0, 0, 8.0 / 12.0, 0, 0, 0, 0};
  const Mat3 quarter{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const cmb_overlap turned = overlap_of(PairScene("cmb/1 box size=1,2,3", "cmb/1 halfspace"), {5, 6, 1.4}, quarter);
  const double of_turned[] = {8.0 / 12.0, 0, 0, 0, 2.0 / 12.0, 0, 0, 0, 0};
  const cmb_overlap cap = overlap_of(PairScene("cmb/1 sphere radius=0.5", "cmb/1 halfspace"), {0, 0, 0.3});
  const double disc = cap.patch_area * cap.patch_area / (4.0 * pi);
  const double of_cap[] = {disc, 0, 0, 0, disc, 0, 0, 0, 0};
  // Two unit squares whose middles are 4 apart: 2 (1/12) and 2 (1/12 + 4).
  const PairScene legs("cmb/1 box size=1,1,1 position=2,0,0;cmb/1 box size=1,1,1 position=-2,0,0", "cmb/1 halfspace");
  const cmb_overlap both = overlap_of(legs, {0, 0, 0.4});
  const double of_both[] = {2.0 / 12.0 + 8.0, 0, 0, 0, 2.0 / 12.0, 0, 0, 0, 0};
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(face.patch_moment[i], of_face[i], 1e-11) << i;
    EXPECT_NEAR(turned.patch_moment[i], of_turned[i], 1e-11) << i;
    EXPECT_NEAR(cap.patch_moment[i], of_cap[i], 1e-14) << i;
    EXPECT_NEAR(both.patch_moment[i], of_both[i], 1e-11) << i;
  }
}

}  // namespace
}  // namespace test_overlap
