// A cube that planes cut, as the surface of a convex polytope.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/polytope_view.hpp"

namespace cmb::mesh {

using convex::Vec3;

// Room for one; grows in the first calls. Which corners a cut leaves is decided once, so its faces and edges fit together by construction;
// no corner is joined with another one, however near.
class ConvexCell {
 public:
  // The cube about `center` whose sides are 2 `half` wide.
  void start(const Vec3 &center, double half);

  enum class Cut { all, part, none, failed };
  // Keeps what has normal . x > offset, `normal` being unit. Failed where rounding has bent the cell so that the plane cuts it in two: then
  // it is as before.
  Cut keep_before(const Vec3 &normal, double offset);

  convex::PolytopeView surface() const { return {vertices_, faces_, edges_, face_vertices_, face_edges_}; }

 private:
  using Face = convex::Polytope::Face;
  using Edge = convex::Polytope::Edge;
  // Of the face that the cut makes, about its border: from a cut edge's place to the next one's.
  struct CapSide {
    std::int32_t from, to, edge;
  };

  bool cut_faces(std::int32_t new_edge);  // the first number that is free
  bool close_cap();

  std::vector<Vec3> vertices_, new_vertices_;
  std::vector<Face> faces_, new_faces_;
  std::vector<Edge> edges_, new_edges_;
  std::vector<std::int32_t> face_vertices_, face_edges_, new_face_vertices_, new_face_edges_;
  std::vector<double> above_;                      // of the vertices
  std::vector<std::int32_t> vertex_of_, edge_of_;  // in the cut cell, -1 where there is none
  std::vector<std::int32_t> place_of_;             // of the edges: the vertex where they are cut
  std::vector<CapSide> cap_;
};

}  // namespace cmb::mesh
