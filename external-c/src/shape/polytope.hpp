// Convex polytopes: vertices, polygon faces and the adjacency that support queries walk on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "math/vector3.hpp"

namespace cmb {
class FaceClusters;
}

namespace cmb::convex {

// An immutable convex polytope with interior. Built once, shared by any number of threads.
class Polytope {
 public:
  struct Face {
    Vec3 normal;              // unit, outward
    double offset = 0.0;      // normal . p for points p of the face
    std::int32_t first = 0;   // into face_vertices()
    std::int32_t count = 0;   // corners, counter-clockwise seen from outside
  };
  struct Edge {
    std::int32_t vertex[2] = {0, 0};  // runs from vertex[0] to vertex[1] on face[0]
    std::int32_t face[2] = {0, 0};
  };

  // From vertices and polygon faces (indices of corners, counter-clockwise seen from outside; face
  // planes are fitted to the corners). Returns false, with the reason in `problem` (may be null), and
  // leaves `result` unchanged where that is not the closed surface of a convex solid: each edge shared
  // by two faces in opposite sense, no vertex farther than `tolerance` (relative to the extent)
  // outside any face plane or off the plane of its own face. Other points that must not lie outside either may be given
  // as `inside`, with all the vertices among them. Allocates.
  static bool build(const std::vector<Vec3> &vertices, const std::vector<std::vector<std::int32_t>> &faces,
                    Polytope &result, std::string *problem, double tolerance = 1e-9,
                    const std::vector<Vec3> *inside = nullptr);

  // The box of full lengths `size` (all > 0), centred at the origin. Vertex v has the coordinate signs
  // of v's bits (bit 0: x, set = positive); faces come in the order -x, +x, -y, +y, -z, +z.
  static Polytope box(const Vec3 &size);

  const std::vector<Vec3> &vertices() const { return vertices_; }
  const std::vector<Face> &faces() const { return faces_; }
  const std::vector<Edge> &edges() const { return edges_; }
  // In step with edges(): the tangent of half the angle between the normals of an edge's faces.
  const std::vector<double> &edge_sharpness() const { return edge_sharpness_; }
  // In step with edges(): unit, from vertex[0] to vertex[1]. Apart from them, so that those looked at stay close in memory.
  const std::vector<Vec3> &edge_directions() const { return edge_directions_; }
  const std::vector<std::int32_t> &face_vertices() const { return face_vertices_; }
  // In step with face_vertices(): the edge from each corner to the next one.
  const std::vector<std::int32_t> &face_edges() const { return face_edges_; }

  // Neighbouring vertices of vertex v: neighbours()[neighbour_begin(v) .. neighbour_begin(v + 1)).
  const std::vector<std::int32_t> &neighbours() const { return neighbours_; }
  std::int32_t neighbour_begin(std::int32_t v) const { return neighbour_begin_[static_cast<std::size_t>(v)]; }
  // The edges of vertex v, in step with its neighbours.
  const std::vector<std::int32_t> &neighbour_edges() const { return neighbour_edges_; }
  // The ways from a vertex to its neighbours, in step with these.
  const std::vector<Vec3> &neighbour_ways() const { return neighbour_ways_; }

  // The faces' planes in groups, of a polytope that was built.
  const FaceClusters &clusters() const { return *clusters_; }

  // Largest distance of a vertex from the origin of the polytope's frame.
  double radius() const { return radius_; }
  // The tangent of half the greatest angle between the normals of two neighbouring faces.
  double sharpest_edge() const { return sharpest_edge_; }
  // Mean of the vertices: an interior point.
  const Vec3 &center() const { return center_; }

  // The vertex farthest along d (not necessarily unit, finite), out of the few that a table names for directions like d;
  // the same for the same d whatever was asked before.
  std::int32_t support_vertex(const Vec3 &d) const;
  // The vertex that is farthest along the middle of the directions that are like d: found by one look into the table.
  std::int32_t outer_vertex(const Vec3 &d) const;

 private:
  void build_support_table();
  void build_few_places();
  std::int32_t support_of_few(const Vec3 &d) const;
  // The same by hill climbing from a vertex.
  std::int32_t climb(const Vec3 &d, std::int32_t start) const;

  std::vector<Vec3> vertices_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<Vec3> edge_directions_;
  std::vector<double> edge_sharpness_;
  std::vector<std::int32_t> face_vertices_;
  std::vector<std::int32_t> face_edges_;
  std::shared_ptr<const FaceClusters> clusters_;  // immutable, as all else
  std::vector<std::int32_t> neighbours_;
  std::vector<std::int32_t> neighbour_edges_;
  std::vector<Vec3> neighbour_ways_;
  std::vector<std::int32_t> neighbour_begin_;
  // For each cell of a cube's surface (cells_ x cells_ on each side) the vertices that are farthest along some direction
  // that leaves through the cell: candidates_[cell_begin_[cell] .. cell_begin_[cell + 1]).
  int cells_ = 1;
  std::vector<std::int32_t> candidates_;
  std::vector<std::int32_t> cell_begin_;
  // Of polytopes with so few vertices all are compared: their coordinates, axis by axis, the last vertex again and again at the end.
  // Empty for others.
  static constexpr std::size_t few_vertices = 8;
  std::vector<double> few_places_;
  double radius_ = 0.0, sharpest_edge_ = 0.0;
  Vec3 center_;
};

}  // namespace cmb::convex
