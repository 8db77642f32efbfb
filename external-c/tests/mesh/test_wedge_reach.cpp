// No triangle in whose wedge a body is, or that it touches, is left out with its node.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "mesh/core/triangle_mesh.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_wedge_reach {
namespace {

using namespace cmb::mesh;
using random_bodies::Random;

std::vector<TriangleMesh> meshes() {
  std::vector<TriangleMesh> result;
  result.push_back(mesh_samples::mesh(mesh_samples::sheet_mesh(2.0, 17, [](double x, double y) { return 0.3 * std::sin(3 * x) * std::cos(2 * y); })));
  result.push_back(mesh_samples::mesh(mesh_samples::sheet_mesh(2.0, 9, [](double x, double) { return 0.9 * std::fabs(x); })));
  result.push_back(mesh_samples::mesh(mesh_samples::sheet_mesh(2.0, 9, [](double, double) { return 0.0; })));
  result.push_back(mesh_samples::mesh(mesh_samples::sphere_mesh(0.7, 3)));
  result.push_back(mesh_samples::mesh(mesh_samples::angle_prism({-1, 1, 1, 0, 0, -1}, {-1, -1, 0, 0, 1, 1}, -0.5, 0.5)));
  return result;
}

bool is_in_wedge(const TriangleMesh &mesh, std::uint32_t t, const Vec3 &p) {
  if (!(dot(mesh.face_normal(t), p - mesh.corner(t, 0)) < -1e-12)) return false;
  for (const WedgeSide &side : mesh.wedge_sides(t)) {
    if (!(dot(side.normal, p) > side.offset + 1e-12)) return false;
  }
  return true;
}

// Or in what of it counts for the faces across its folds.
bool is_beyond_fold(const TriangleMesh &mesh, std::uint32_t t, const Vec3 &p) {
  const FoldRegions::Regions folds = mesh.fold_regions().of(t);
  return std::any_of(folds.begin, folds.end, [&](const FoldRegion &fold) {
    if (!(dot(mesh.face_normal(fold.triangle), p - mesh.corner(fold.triangle, 0)) < -1e-12)) return false;
    const FoldRegions::Planes planes = mesh.fold_regions().planes(fold);
    return std::all_of(planes.begin, planes.end, [&](const WedgePlane &plane) { return dot(plane.normal, p) > plane.offset + 1e-12; });
  });
}

TEST(WedgeReach, LeavesNothingOut) {
  Random random(1);
  long inside = 0, beyond_folds = 0, visited = 0, all = 0;
  for (const TriangleMesh &mesh : meshes()) {
    for (int k = 0; k < 400; ++k) {
      // A tetrahedron, of which the corners and places between them are asked.
      const Vec3 middle{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.6, 0.6)};
      const double size = random.log_uniform(1e-3, 1);
      std::vector<Vec3> corners;
      for (int i = 0; i < 4; ++i) corners.push_back(middle + size * random.direction());
      const auto support = [&](const Vec3 &d) {
        Vec3 best = corners[0];
        for (const Vec3 &corner : corners) best = dot(d, corner) > dot(d, best) ? corner : best;
        return best;
      };
      std::set<std::uint32_t> found;
      mesh.visit_wedges(bounds_of(corners), 10.0, support, [&](std::uint32_t t) { found.insert(t); });
      visited += static_cast<long>(found.size());
      all += static_cast<long>(mesh.triangles().size());
      for (int i = 0; i < 30; ++i) {
        double part[4], sum = 0.0;
        for (double &p : part) sum += p = random.log_uniform(1e-3, 1);
        Vec3 place;
        for (std::size_t j = 0; j < 4; ++j) place = place + (part[j] / sum) * corners[j];
        for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
          const bool beyond_fold = is_beyond_fold(mesh, t, place);
          beyond_folds += beyond_fold ? 1 : 0;
          if (!beyond_fold && !is_in_wedge(mesh, t, place)) continue;
          ++inside;
          ASSERT_TRUE(found.count(t) == 1) << k << ", triangle " << t << (beyond_fold ? ", beyond a fold" : "");
        }
      }
    }
  }
  EXPECT_GT(inside, 10000);
  EXPECT_GT(beyond_folds, 100);
  EXPECT_LT(visited, 2 * all / 3);
}

TEST(WedgeReach, FindsAllThatIsTouched) {
  Random random(2);
  int touched = 0;
  for (const TriangleMesh &mesh : meshes()) {
    for (int k = 0; k < 2000; ++k) {
      const auto t = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(mesh.triangles().size()) - 1));
      // A segment that ends in the triangle.
      const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
      const Vec3 place = mesh.corner(t, 0) + u * (mesh.corner(t, 1) - mesh.corner(t, 0)) + v * (mesh.corner(t, 2) - mesh.corner(t, 0));
      const Vec3 end = place + random.log_uniform(1e-3, 1) * random.direction();
      const auto reach = [&](const Vec3 &d) { return std::fmax(dot(d, place), dot(d, end)); };
      bool found = false;
      mesh.visit_touched(bounds_of(std::vector<Vec3>{place, end}), [] { return false; }, reach, [&](std::uint32_t other) { found = found || other == t; });
      ASSERT_TRUE(found) << k;
      ++touched;
    }
  }
  EXPECT_EQ(touched, 10000);
}

}  // namespace
}  // namespace test_wedge_reach
