// What of a closed mesh lies behind the triangles of another one, as an elastic solid.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose_algebra.hpp"
#include "mesh/core/placed_vertices.hpp"
#include "mesh/elastic/wedge_integrals.hpp"
#include "mesh/wedges/wedge_region.hpp"

namespace cmb::mesh {

// Room for one wedge; grows in the first calls.
struct PairOverlapScratch {
  struct Plane : WedgePlane {
    double slope = 0.0;  // normal . the triangle's: positive where the plane ends what is behind the triangle, negative where that begins
    double level = 0.0;  // how deep below the triangle the plane is, where it is level and that has to be exact
  };
  std::vector<Plane> planes;
  std::vector<std::uint32_t> facets;
  std::vector<Vec3> polygon, kept;
  std::vector<double> deep, above;    // of the facets' corners
  std::vector<std::size_t> cutting;   // planes
  std::vector<WedgeIntegrals::Part> parts;
};

// A wedge is convex: a line upright on its triangle is in it from one depth to another. So the integral of k s^(k-1) over what the body
// has in the wedge is one over the body's surface, by area as seen along the triangle's normal, positive where the body is above the
// surface: the difference of s^k between the places where the line up from there leaves the wedge and where it comes into it. Every
// part of the surface counts by itself, and changes steadily; nothing is stitched, and no inside is looked up.
//
// Everything in the mesh's frame. Borrows all it is given.
class PairOverlap : public WedgeIntegrals {
 public:
  // `body` is closed; `place` its pose.
  PairOverlap(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PlacedVertices vertices, PairOverlapScratch &scratch)
      : WedgeIntegrals(mesh, body.bound_radius(), 1.0, 0.0, scratch.parts), body_(body), place_(place), center_(place(body.bound_center())), vertices_(vertices),
        scratch_(scratch) {}

  // Of the body's components only those count that are not 0 here, which is borrowed; otherwise all do.
  void count_only(const std::vector<std::uint8_t> &components) { components_ = &components; }
  // What lies behind all triangles.
  void add_all();

 private:
  using Plane = PairOverlapScratch::Plane;
  // Integrals of s^k by area as seen along the triangle's normal, k = 2 and 4.
  struct Powers {
    double second = 0.0, fourth = 0.0;
    void add(double factor, const Powers &other) { second += factor * other.second, fourth += factor * other.fourth; }
  };

  double reach(const Vec3 &direction) const;
  void add(const WedgeRegion &region);
  bool counts(std::uint32_t facet) const { return components_ == nullptr || (*components_)[body_.component_of(facet)] != 0; }
  bool meets_surface() const;
  bool may_fill();
  bool gather();
  bool holds(const Vec3 &place) const;
  void set_planes();
  bool find_place(double level, Vec3 &place);
  bool is_filled();
  void end_below_surface();
  void measure();
  bool add_inside(std::size_t number, Powers &sum);
  void add_below(std::size_t number, Powers &sum, double &size);
  void start_with(std::uint32_t facet);
  bool keep(const Plane &plane, bool wanted);
  template <typename Above>
  bool keep_where(Above &&above);
  Powers powers() const;
  Powers powers_at(double level) const;

  const TriangleMesh &body_;
  const Pose &place_;
  Vec3 center_;
  PlacedVertices vertices_;
  PairOverlapScratch &scratch_;
  const std::vector<std::uint8_t> *components_ = nullptr;
  std::uint32_t nearest_facet_ = 0;  // to a triangle looked at before
  // Of the triangle at hand:
  double deepest_corner_ = 0.0, deepest_inside_ = 0.0;
  PatchSums patch_;
};

}  // namespace cmb::mesh
