// Vertices of a mesh at a pose, each moved when it is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose_algebra.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// Room for the vertices of one mesh; grows in the first calls. What was moved carries the number of its query, so that nothing has to be
// cleared.
struct PlacedVertexScratch {
  struct Vertex {
    Vec3 place;
    std::uint32_t query = 0;
  };
  std::uint32_t query = 0;
  std::vector<Vertex> vertices;
};

// Borrows everything; one at a time uses the scratch.
class PlacedVertices {
 public:
  PlacedVertices(const TriangleMesh &mesh, const Pose &pose, PlacedVertexScratch &scratch) : mesh_(mesh), pose_(pose), scratch_(scratch) {
    if (scratch.vertices.size() < mesh.vertices().size()) scratch.vertices.resize(mesh.vertices().size());
    if (++scratch.query != 0) return;
    for (PlacedVertexScratch::Vertex &vertex : scratch.vertices) vertex.query = 0;  // the counter has wrapped
    scratch.query = 1;
  }

  const Vec3 &operator[](std::uint32_t v) const {
    PlacedVertexScratch::Vertex &vertex = scratch_.vertices[v];
    if (vertex.query != scratch_.query) vertex = {pose_(mesh_.vertices()[v]), scratch_.query};
    return vertex.place;
  }
  const Vec3 &corner(std::uint32_t t, std::size_t k) const { return (*this)[mesh_.triangles()[t][k]]; }

 private:
  const TriangleMesh &mesh_;
  const Pose &pose_;
  PlacedVertexScratch &scratch_;
};

}  // namespace cmb::mesh
