#include "mesh/intersection/mesh_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/distance/dual_traversal.hpp"
#include "mesh/intersection/sheet_crossing.hpp"
#include "mesh/intersection/triangle_crossing.hpp"

namespace cmb::mesh {

namespace {

Bounds box_of(const TriangleMesh &mesh, std::uint32_t t) {
  const Vec3 corners[3] = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  return bounds_of(corners);
}

// Whether the triangle may come between the two planes of the bound.
bool reaches(const CylinderBound &flat, const Vec3 (&corners)[3]) {
  const double first = dot(flat.axis, corners[0] - flat.center), second = dot(flat.axis, corners[1] - flat.center),
               third = dot(flat.axis, corners[2] - flat.center);
  return std::min({first, second, third}) <= flat.half_thickness && std::max({first, second, third}) >= -flat.half_thickness;
}

// How deep the plane of triangle t cuts into a triangle; negative where that is on one side.
double depth_of_cut(const TriangleMesh &mesh, std::uint32_t t, const Vec3 (&corners)[3]) {
  const Vec3 &normal = mesh.face_normal(t);
  const double offset = dot(normal, mesh.corner(t, 0));
  const double first = dot(normal, corners[0]) - offset, second = dot(normal, corners[1]) - offset,
               third = dot(normal, corners[2]) - offset;
  return std::min(std::max({first, second, third}), -std::min({first, second, third}));
}

}  // namespace

double rounding_of_crossings(const TriangleMesh &a, const TriangleMesh &b) {
  return 1e-15 * (a.bound_radius() + b.bound_radius());
}

void find_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PlacedVertices &vertices,
                    Crossings &crossings) {
  crossings.cuts.clear();
  const double rounding = rounding_of_crossings(mesh, body);
  const auto leaves = [&](std::uint32_t number, std::uint32_t body_number) {
    const TriangleHierarchy::Node &leaf = mesh.hierarchy().nodes()[number];
    const TriangleHierarchy::Node &body_leaf = body.hierarchy().nodes()[body_number];
    const CylinderBound &flat = mesh.hierarchy().flat_bounds()[number];
    for (std::uint32_t j = body_leaf.first; j < body_leaf.first + body_leaf.count; ++j) {
      const std::uint32_t facet = body.hierarchy().order()[j];
      const Vec3 corners[3] = {vertices.corner(facet, 0), vertices.corner(facet, 1), vertices.corner(facet, 2)};
      if (!reaches(flat, corners)) continue;
      const Bounds box = bounds_of(corners);
      if (distance2(box, leaf.bounds) > rounding * rounding) continue;
      for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const std::uint32_t t = mesh.hierarchy().order()[i];
        const double cut = depth_of_cut(mesh, t, corners);
        if (!(cut >= -rounding) || distance2(box_of(mesh, t), box) > rounding * rounding) continue;
        crossings.cuts.push_back({{t, facet}, cut});
      }
    }
  };
  walk_pairs(mesh.hierarchy(), body.hierarchy(), place, [rounding] { return rounding * rounding; }, leaves);
}

namespace {

// Calls act(corners of the triangle, its normal, corners of the facet, its normal).
template <typename Act>
auto of_triangles(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const TrianglePairNumbers &pair, Act &&act) {
  const Vec3 own[3] = {mesh.corner(pair.triangle, 0), mesh.corner(pair.triangle, 1), mesh.corner(pair.triangle, 2)};
  const Vec3 facet[3] = {place(body.corner(pair.facet, 0)), place(body.corner(pair.facet, 1)),
                         place(body.corner(pair.facet, 2))};
  return act(own, mesh.face_normal(pair.triangle), facet, place.rotation * body.face_normal(pair.facet));
}

TriangleSection crossing_of(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const TrianglePairNumbers &pair,
                            double enough) {
  return of_triangles(mesh, body, place, pair, [enough](const auto &a, const Vec3 &normal_a, const auto &b, const Vec3 &normal_b) {
    return triangle_crossing(a, normal_a, b, normal_b, enough);
  });
}

}  // namespace

bool any_meet(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings) {
  constexpr double rounding = 1e-12;  // by the meshes' size: more than moves take
  const double near = rounding * (mesh.bound_radius() + body.bound_radius());
  return std::any_of(crossings.cuts.begin(), crossings.cuts.end(), [&](const Crossings::Cut &cut) {
    return of_triangles(mesh, body, place, cut.pair, [near](const auto &a, const Vec3 &normal_a, const auto &b, const Vec3 &normal_b) {
      return may_meet(a, normal_a, b, normal_b, near);
    });
  });
}

double deepest_crossing(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings,
                        double enough) {
  double deepest = 0.0;
  for (const Crossings::Cut &cut : crossings.cuts) {
    const double known = std::fmax(enough, deepest);
    if (cut.depth > known) deepest = std::fmax(deepest, crossing_of(mesh, body, place, cut.pair, known).depth);
  }
  return deepest;
}

namespace {

// How far the mesh's box reaches behind the plane through `place`, in the mesh's frame.
double behind(const TriangleMesh &mesh, const Vec3 &normal, const Vec3 &place) {
  const Bounds &box = mesh.hierarchy().bounds();
  double least = 0.0;
  for (int k = 0; k < 3; ++k) least += std::fmin(normal[k] * (box.low[k] - place[k]), normal[k] * (box.high[k] - place[k]));
  return -least;
}

double area_of(const TriangleMesh &mesh, std::uint32_t t) {
  return 0.5 * norm(cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
}

}  // namespace

void push_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings,
                    PiercedLoad &load) {
  const Pose back = place.inverse();
  for (const Crossings::Cut &cut : crossings.cuts) {
    const TriangleSection crossing = crossing_of(mesh, body, place, cut.pair, 0.0);
    if (!(crossing.depth > 0.0)) continue;
    const std::uint32_t t = cut.pair.triangle;
    const Vec3 &n = mesh.face_normal(t);
    load.add(crossing, n, behind(body, back.rotation * n, back(mesh.corner(t, 0))), area_of(mesh, t));
  }
}

double depths_of_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings,
                           double negligible, double enough) {
  double sum = 0.0;
  for (const Crossings::Cut &cut : crossings.cuts) {
    sum += sheet_crossing(mesh, cut.pair.triangle, body, cut.pair.facet, place, negligible).depth;
    if (sum > enough) break;
  }
  return sum;
}

void push_sheet_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place,
                          const Crossings &crossings, double enough, PiercedLoad &load, PiercedLoad &reaction) {
  const Pose back = place.inverse();
  for (const Crossings::Cut &cut : crossings.cuts) {
    const std::uint32_t t = cut.pair.triangle, facet = cut.pair.facet;
    const TriangleSection crossing = sheet_crossing(mesh, t, body, facet, place, enough);
    if (!(crossing.depth > 0.0)) continue;
    const Vec3 &n = mesh.face_normal(t), &m = body.face_normal(facet);
    load.add(crossing, n, behind(body, back.rotation * n, back(mesh.corner(t, 0))), area_of(mesh, t));
    reaction.add({crossing.depth, back(crossing.place)}, m, behind(mesh, place.rotation * m, place(body.corner(facet, 0))),
                 area_of(body, facet));
  }
}

}  // namespace cmb::mesh
