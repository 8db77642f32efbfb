#include "shape/plane_section.hpp"

#include <cmath>

#include "math/index.hpp"

namespace cmb::convex {

namespace {

// Corners nearer to the plane than this part of the polytope's radius count as hardly beside it.
constexpr double beside_part = 1e-9;

class SectionWalk {
 public:
  SectionWalk(const Polytope &polytope, const Vec3 &point, const Vec3 &across)
      : polytope_(polytope), across_(across), height_(dot(across, point)), beside_(beside_part * polytope.radius()) {}

  // An edge that the plane cuts, by climbing from a corner towards the plane; -1 if there is none.
  std::int32_t first_edge(std::int32_t corner) const {
    const double sense = above(corner) ? -1.0 : 1.0;
    for (;;) {
      std::int32_t nearest = corner, edge = -1;
      double reached = sense * height(corner);
      for (std::int32_t k = polytope_.neighbour_begin(corner); k < polytope_.neighbour_begin(corner + 1); ++k) {
        const std::int32_t next = polytope_.neighbours()[index(k)];
        const double here = sense * height(next);
        if (here > reached) reached = here, nearest = next, edge = polytope_.neighbour_edges()[index(k)];
      }
      if (nearest == corner) return -1;
      if (above(nearest) != above(corner)) return edge;
      corner = nearest;
    }
  }

  // The edge by which the plane leaves a face that it enters by `entered`; -1 if there is none.
  std::int32_t other_edge(const Polytope::Face &face, std::int32_t entered) const {
    const std::int32_t *const corners = polytope_.face_vertices().data() + face.first;
    const std::int32_t *const edges = polytope_.face_edges().data() + face.first;
    if (face.count == 3) {  // of the other two edges the one that begins on the far corner's other side
      const int at = edges[0] == entered ? 0 : edges[1] == entered ? 1 : 2;
      const int next = (at + 1) % 3, far = (at + 2) % 3;
      const bool first_above = polytope_.edges()[index(entered)].vertex[0] == upper_end(entered);
      const bool begins_above = (polytope_.edges()[index(entered)].vertex[0] == corners[at]) == first_above;
      return above(corners[far]) == begins_above ? edges[next] : edges[far];
    }
    bool last = above(corners[face.count - 1]);
    for (std::int32_t k = 0, before = face.count - 1; k < face.count; before = k++) {
      const bool here = above(corners[k]);
      if (here != last && edges[before] != entered) return edges[before];
      last = here;
    }
    return -1;
  }

  // The faces about those ends of an edge that are hardly beside the plane.
  void append_beside(std::int32_t edge, std::vector<std::int32_t> &faces) const {
    for (const std::int32_t corner : polytope_.edges()[index(edge)].vertex) {
      if (std::fabs(height(corner)) > beside_) continue;
      for (std::int32_t k = polytope_.neighbour_begin(corner); k < polytope_.neighbour_begin(corner + 1); ++k) {
        for (const std::int32_t face : polytope_.edges()[index(polytope_.neighbour_edges()[index(k)])].face) {
          faces.push_back(face);
        }
      }
    }
  }

 private:
  // The end above the plane of an edge that it cuts.
  std::int32_t upper_end(std::int32_t edge) const {
    const std::int32_t *const ends = polytope_.edges()[index(edge)].vertex;
    return above(ends[0]) ? ends[0] : ends[1];
  }
  double height(std::int32_t corner) const { return dot(across_, polytope_.vertices()[index(corner)]) - height_; }
  bool above(std::int32_t corner) const { return height(corner) >= 0.0; }

  const Polytope &polytope_;
  Vec3 across_;
  double height_, beside_;
};

}  // namespace

bool append_section_faces(const Polytope &polytope, const Vec3 &point, const Vec3 &across, const Vec3 &start,
                          std::vector<std::int32_t> &faces) {
  const SectionWalk walk(polytope, point, across);
  const std::int32_t first = walk.first_edge(polytope.support_vertex(start));
  if (first < 0) return false;
  std::int32_t edge = first, face = polytope.edges()[index(first)].face[0];
  for (std::size_t step = 0; step < polytope.faces().size(); ++step) {
    walk.append_beside(edge, faces);
    faces.push_back(face);
    edge = walk.other_edge(polytope.faces()[index(face)], edge);
    if (edge < 0) return false;
    if (edge == first) return true;
    const Polytope::Edge &crossed = polytope.edges()[index(edge)];
    face = crossed.face[0] == face ? crossed.face[1] : crossed.face[0];
  }
  return false;
}

}  // namespace cmb::convex
