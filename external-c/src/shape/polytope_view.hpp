// A convex polytope's surface as others keep it.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/polytope.hpp"

namespace cmb::convex {

// Borrows lists that mean what those of a Polytope mean; edges' faces need not be known.
struct PolytopeView {
  const std::vector<Vec3> &vertices;
  const std::vector<Polytope::Face> &faces;
  const std::vector<Polytope::Edge> &edges;
  const std::vector<std::int32_t> &face_vertices, &face_edges;
  const FaceClusters *clusters = nullptr;  // of the faces, where they are known

  // A polytope is one.
  PolytopeView(const Polytope &polytope)
      : vertices(polytope.vertices()),
        faces(polytope.faces()),
        edges(polytope.edges()),
        face_vertices(polytope.face_vertices()),
        face_edges(polytope.face_edges()),
        clusters(&polytope.clusters()) {}
  PolytopeView(const std::vector<Vec3> &all_vertices, const std::vector<Polytope::Face> &all_faces,
               const std::vector<Polytope::Edge> &all_edges, const std::vector<std::int32_t> &vertices_of_faces,
               const std::vector<std::int32_t> &edges_of_faces)
      : vertices(all_vertices),
        faces(all_faces),
        edges(all_edges),
        face_vertices(vertices_of_faces),
        face_edges(edges_of_faces) {}
};

}  // namespace cmb::convex
