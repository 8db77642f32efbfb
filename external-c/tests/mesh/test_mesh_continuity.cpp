// Loads of pairs with meshes have no jumps: over the intervals in which they change most, halved again and again towards
// the larger change, the change goes to zero. Over a jump it would stay.
#include <algorithm>
#include <functional>

#include "support/mesh_text.hpp"
#include "support/scene_query.hpp"

namespace test_mesh_continuity {
namespace {

using namespace cmb::test;
using mesh_samples::box_mesh;
using mesh_samples::height_field_text;
using mesh_samples::mesh_text;
using mesh_samples::with_speck;
using mesh_samples::sphere_mesh;

constexpr double pi = 3.14159265358979323846;

// Hills and hollows with creases between all cells.
double hills(double x, double y) { return 0.08 * std::sin(2.1 * x + 0.3) * std::cos(1.7 * y) + 0.03 * std::sin(5 * y); }

const std::string &terrain() {
  static const std::string text = height_field_text(4.0, 17, hills);
  return text;
}

const std::string &table() {
  static const std::string text = mesh_text(with_speck(box_mesh({2, 2, 1}, 3), {0, 40, 0}));
  return text;
}

struct Path {
  const char *name;
  std::string a;
  const std::string &(*b)();
  std::function<BodyPose(double)> pose_a;
};

void PrintTo(const Path &path, std::ostream *stream) { *stream << path.name; }

// Rolling over the terrain, about as deep everywhere as the height says.
BodyPose rolling(double s, double height) {
  const double x = -1.3 + 2.4 * s, y = 0.7 - 1.1 * s;
  return {{x, y, hills(x, y) + height}, rotation_about(normalized(Vec3{0.3, 1, 0.2}), 3.0 * s)};
}

BodyPose over_border(double s, double height) {
  return {{0.6 + 0.9 * s, 0.3 + 0.9 * s, 0.5 + height}, rotation_about(normalized(Vec3{0.4, 1, 0.3}), 0.2 + 0.3 * s)};
}

BodyPose pressed_down(double s, double height) {
  return {{0.1 + 0.1 * s, 0.2, 0.5 + height - 0.05 * s}, rotation_about(normalized(Vec3{1, 0.4, 0.1}), 0.7 + 0.4 * s)};
}

// A capsule 0.3 long touches by its ends at most half its radius deep: its centre keeps above.
BodyPose raised(BodyPose pose) {
  pose.position.z += 0.15 * std::fabs(pose.rotation.row[2].z);
  return pose;
}

const std::string ellipsoid = "cmb/1 ellipsoid size=0.4,0.5,0.6", cylinder = "cmb/1 cylinder radius=0.2 length=0.4",
                  cone = "cmb/1 cone radius=0.2 length=0.4", box = "cmb/1 box size=0.4,0.4,0.4",
                  sphere = "cmb/1 sphere radius=0.2", capsule = "cmb/1 capsule radius=0.1 length=0.3";

std::vector<Path> paths() {
  const std::string cube = mesh_text(with_speck(box_mesh({0.4, 0.4, 0.4}, 2))), ball = mesh_text(with_speck(sphere_mesh(0.2, 2)));
  std::vector<Path> result;
  struct Body {
    const char *name;
    const std::string &text;
    double height;
    bool raised = false;
  };
  const Body bodies[] = {{"ellipsoid", ellipsoid, 0.21}, {"cylinder", cylinder, 0.21}, {"cone", cone, 0.17},
                         {"box", box, 0.24},             {"sphere", sphere, 0.18},     {"capsule", capsule, 0.08, true},
                         {"cube mesh", cube, 0.24},      {"ball mesh", ball, 0.18}};
  for (const Body &body : bodies) {
    const auto add = [&](const std::string &(*ground)(), BodyPose (*path)(double, double), double height) {
      const bool raise = body.raised;
      result.push_back({body.name, body.text, ground, [=](double s) {
                          const BodyPose pose = path(s, height);
                          return raise ? raised(pose) : pose;
                        }});
    };
    add(terrain, rolling, body.height);
    add(table, over_border, body.height);
    add(table, pressed_down, body.raised ? body.height + 0.02 : body.height + 0.03);
  }
  return result;
}

class MeshContinuity : public testing::TestWithParam<Path> {};

TEST_P(MeshContinuity, LoadHasNoJumps) {
  const Path &path = GetParam();
  const PairScene scene(path.a, path.b());
  struct Sums {
    Vec3 load, moment;
    double distance;
  };
  const auto sums = [&](double s) {
    const BodyPose pose = path.pose_a(s);
    const Contact contact = scene.query(pose, {}, 512);
    return Sums{contact.load(), contact.moment(pose.position), contact.distance};
  };
  const auto change = [](const Sums &x, const Sums &y) { return norm(x.load - y.load) + norm(x.moment - y.moment); };
  constexpr int samples = 300;
  struct Interval {
    double change, begin;
  };
  std::vector<Interval> intervals;
  Sums last = sums(0.0);
  double largest = norm(last.load);
  for (int i = 1; i <= samples; ++i) {
    const Sums next = sums(static_cast<double>(i) / samples);
    intervals.push_back({change(last, next), static_cast<double>(i - 1) / samples});
    largest = std::fmax(largest, norm(next.load));
    last = next;
  }
  ASSERT_GT(largest, 1e-3);
  std::sort(intervals.begin(), intervals.end(), [](const auto &x, const auto &y) { return x.change > y.change; });
  for (std::size_t k = 0; k < 12; ++k) {
    double begin = intervals[k].begin, end = begin + 1.0 / samples, jump = 0.0;
    for (int halving = 0; halving < 26; ++halving) {
      const double middle = 0.5 * (begin + end);
      const Sums at_middle = sums(middle);
      const double first = change(sums(begin), at_middle), second = change(at_middle, sums(end));
      jump = std::fmax(first, second);
      (first > second ? end : begin) = middle;
    }
    EXPECT_LT(jump, 1e-5 * largest) << "at s = " << begin << " from " << intervals[k].change << " of " << largest;
  }
}

std::string path_name(const testing::TestParamInfo<Path> &info) {
  static const char *const kinds[] = {"_over_hills", "_over_border", "_pressed_down"};
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name + kinds[info.index % 3];
}

INSTANTIATE_TEST_SUITE_P(Paths, MeshContinuity, testing::ValuesIn(paths()), path_name);

}  // namespace
}  // namespace test_mesh_continuity
