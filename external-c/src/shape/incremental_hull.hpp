// A convex hull of points that grows point by point: closed triangulated surface with adjacency.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/vector3.hpp"

namespace cmb::convex {

// Storage is allocated by the constructor alone. Not for sharing between threads.
class IncrementalHull {
 public:
  struct Face {
    std::int32_t vertex[3];     // counter-clockwise seen from outside
    std::int32_t neighbour[3];  // face across the edge vertex[i] -> vertex[i + 1]
    Vec3 normal;                // unit, outward
    double offset;              // normal . p on the face
    std::uint32_t mark;
    bool alive;
    bool sliver;  // too thin for a plane of its own; has its neighbour's
  };
  enum class Outcome { expanded, not_outside, broken, full };

  IncrementalHull(std::size_t max_points, std::size_t max_faces);

  // Starts anew from four points; false where they span no volume (height below `thickness`).
  bool start(const Vec3 &p0, const Vec3 &p1, const Vec3 &p2, const Vec3 &p3, double thickness);

  // Adds `p`, which lies outside face `seen`. Faces that p lies outside of by more than `tolerance`
  // are replaced; triangles of height below `thickness` become slivers. New faces are those from
  // first_new_face() on. The hull is unchanged unless the outcome is `expanded`:
  // `broken` where rounding made the visible part of the surface not a disc, `full` for no room.
  Outcome expand(std::int32_t seen, const Vec3 &p, double tolerance, double thickness);

  std::int32_t point_count() const { return static_cast<std::int32_t>(points_.size()); }
  std::int32_t face_count() const { return static_cast<std::int32_t>(faces_.size()); }
  std::int32_t first_new_face() const { return first_new_face_; }
  const Vec3 &point(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  const Face &face(std::int32_t i) const { return faces_[static_cast<std::size_t>(i)]; }
  // The origin's distance from a face that is no sliver; its plane's offset where that is not positive.
  double distance(const Face &face) const;
  // The faces that the last expansion removed.
  const std::vector<std::int32_t> &removed_faces() const { return visible_; }

 private:
  struct HorizonEdge {
    std::int32_t from, to, outer_face;
  };
  Face &at(std::int32_t i) { return faces_[static_cast<std::size_t>(i)]; }
  bool set_plane(Face &face, double thickness) const;

  std::size_t max_points_, max_faces_;
  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<std::int32_t> visible_;
  std::vector<HorizonEdge> horizon_;
  std::vector<std::uint32_t> vertex_mark_;
  std::vector<std::int32_t> edge_at_vertex_;
  std::uint32_t pass_ = 0;
  std::int32_t first_new_face_ = 0;
};

}  // namespace cmb::convex
