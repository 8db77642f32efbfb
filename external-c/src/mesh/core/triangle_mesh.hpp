// A checked triangle mesh with what contact queries need.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/core/face_relations.hpp"
#include "mesh/core/mesh_check.hpp"
#include "mesh/core/mesh_data.hpp"
#include "mesh/core/planar_faces.hpp"
#include "mesh/core/triangle_hierarchy.hpp"
#include "mesh/wedges/fold_regions.hpp"
#include "mesh/wedges/wedge_cuts.hpp"
#include "mesh/wedges/wedge_reach.hpp"

namespace cmb::mesh {

// Of a closed mesh filled with density 1.
struct MassProperties {
  double volume = 0.0;  // m3
  Vec3 centroid;
  Mat3 inertia = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // m5, about the centroid, axes of the mesh
};

// Where on a triangle a point is.
enum class TriangleFeature : std::uint8_t { face, edge, vertex };
struct TrianglePoint {
  Vec3 point;
  TriangleFeature feature = TriangleFeature::face;
  std::uint8_t index = 0;  // side of the edge, corner of the vertex
};

// The point of triangle abc nearest to p (Ericson, Real-Time Collision Detection, section 5.1.5).
TrianglePoint nearest_on_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c);

struct NearestPoint {
  double distance = 0.0;  // signed: negative behind the surface
  Vec3 point;             // of the mesh
  Vec3 normal;            // unit; from the surface at `point` to where the distance grows fastest
  std::uint32_t triangle = 0;
  TriangleFeature feature = TriangleFeature::face;  // of that triangle
  std::uint8_t index = 0;                           // of the edge or vertex
};

// Immutable; shared by threads. All in the mesh's frame.
class TriangleMesh {
 public:
  // Throws MeshError (see check_mesh), std::bad_alloc. Vertices must be shared already (weld_vertices).
  TriangleMesh(MeshData data, MeshUse use, const std::string &source);

  const std::vector<Vec3> &vertices() const { return data_.vertices; }
  const std::vector<Triangle> &triangles() const { return data_.triangles; }
  const Vec3 &corner(std::uint32_t t, std::size_t k) const { return data_.vertices[data_.triangles[t][k % 3]]; }
  // Triangle beyond side k of t, or -1.
  std::int32_t neighbour(std::uint32_t t, std::size_t k) const { return neighbours_[t][k]; }
  // What hangs together by edges, numbered from 0.
  std::uint32_t component_of(std::uint32_t t) const { return components_[t]; }
  std::uint32_t component_count() const { return component_count_; }
  // One of its vertices.
  const Vec3 &place_of_component(std::uint32_t component) const { return corner(component_triangles_[component], 0); }
  // The triangles at vertex v: vertex_triangles()[vertex_begin(v) .. vertex_begin(v + 1)).
  const std::vector<std::uint32_t> &vertex_triangles() const { return vertex_triangles_; }
  std::uint32_t vertex_begin(std::uint32_t v) const { return vertex_begin_[v]; }

  // Unit, towards the front.
  const Vec3 &face_normal(std::uint32_t t) const { return face_normals_[t]; }
  // Normals of edges (mean of the two faces) and vertices (mean by angle), unit: their sign tells front from back
  // where an edge or vertex is nearest (Baerentzen and Aanaes 2005).
  Vec3 edge_normal(std::uint32_t t, std::size_t k) const;
  const Vec3 &vertex_normal(std::uint32_t v) const { return vertex_normals_[v]; }
  // Half of what lies behind the triangle: contact deeper than that belongs to the other side. Infinite where the
  // line into the body from the triangle's middle meets nothing.
  double depth_limit(std::uint32_t t) const { return depth_limits_[t]; }

  // Down to this depth behind the triangle no other side of the mesh is as near as the triangle is: no triangle whose
  // normal is more than 60 degrees off, but for those that share a corner with it. At most three lengths of a side.
  double clear_depth(std::uint32_t t) const { return clear_depths_[t]; }

  // Of what lies behind triangle t, one for each side.
  const std::array<WedgeSide, 3> &wedge_sides(std::uint32_t t) const { return wedge_sides_[t]; }

  // Where other sides of the mesh reach into triangle t's wedge, the planes that part it from these.
  WedgeCuts::Planes wedge_cuts(std::uint32_t t) const { return wedge_cuts_.of(t); }

  const FoldRegions &fold_regions() const { return fold_regions_; }

  // Calls visit(triangle) for the triangles of all leaves that are within `farthest` of the box and in whose wedges some of a convex body in
  // the box may be, the nearer ones first. support(d) is a place of the body farthest along d.
  template <typename Support, typename Visit>
  void visit_wedges(const Bounds &box, double farthest, Support &&support, Visit &&visit) const {
    hierarchy_.visit_nodes(
        box, [&] { return farthest * farthest; }, [&](std::uint32_t node) { return !wedge_reach_.may_meet(node, support); }, visit);
  }

  // The same for triangles that the body, of which reach(d) is the greatest d . x, may touch, until stop().
  template <typename Stop, typename Reach, typename Visit>
  void visit_touched(const Bounds &box, Stop &&stop, Reach &&reach, Visit &&visit) const {
    hierarchy_.visit_nodes(
        box, [&] { return stop() ? -1.0 : 0.0; }, [&](std::uint32_t node) { return !wedge_reach_.may_touch(node, reach); }, visit);
  }

  // Flat faces of several triangles.
  const PlanarFaces &faces() const { return faces_; }
  const FaceRelations &face_relations() const { return face_relations_; }

  // A few places well inside a closed mesh, far from each other; of a sheet, one of its vertices. Never empty.
  const std::vector<Vec3> &interior_points() const { return interior_points_; }
  static constexpr std::size_t max_interior_points = 8;

  bool closed() const { return closed_; }
  const MassProperties &mass_properties() const { return mass_properties_; }  // all zero for open meshes
  double area() const { return area_; }
  // About the length of the triangles' sides, as a mean.
  double triangle_size() const;
  const TriangleHierarchy &hierarchy() const { return hierarchy_; }
  // Bounding sphere.
  const Vec3 &bound_center() const { return bound_center_; }
  double bound_radius() const { return bound_radius_; }

  // Where the mesh is nearest to p (finite). The search begins with triangle `first`: the nearer that one is, the faster;
  // the answer does not depend on it. Neither allocates nor throws.
  NearestPoint nearest(const Vec3 &p, std::uint32_t first = 0) const;

 private:
  void build_normals();
  void build_vertex_triangles();
  void build_depth_limits();
  void build_clear_depths();
  void build_wedge_sides();
  void build_interior_points();
  bool is_other_side(std::uint32_t t, std::uint32_t other) const;
  void measure();

  MeshData data_;
  std::vector<std::array<std::int32_t, 3>> neighbours_;
  std::vector<std::uint32_t> components_;
  std::uint32_t component_count_ = 0;
  std::vector<std::uint32_t> component_triangles_;  // one of each
  TriangleHierarchy hierarchy_;
  PlanarFaces faces_;
  FaceRelations face_relations_;
  std::vector<std::uint32_t> vertex_triangles_, vertex_begin_;
  std::vector<Vec3> face_normals_, vertex_normals_;
  std::vector<double> depth_limits_, clear_depths_;
  std::vector<std::array<WedgeSide, 3>> wedge_sides_;
  WedgeReach wedge_reach_;
  WedgeCuts wedge_cuts_;
  FoldRegions fold_regions_;
  std::vector<Vec3> interior_points_;
  MassProperties mass_properties_;
  double area_ = 0.0;
  bool closed_ = true;
  Vec3 bound_center_;
  double bound_radius_ = 0.0;
};

}  // namespace cmb::mesh
