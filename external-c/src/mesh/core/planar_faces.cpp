#include "mesh/core/planar_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb::mesh {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Sides of a face's triangles in one line, with the same face beyond.
struct Border {
  Vec3 start, direction, inward;  // direction and inward unit
  double first = 0.0, last = 0.0; // along the direction
  double length = 0.0;            // of the sides together
  std::uint32_t beyond = none;
  bool convex = false;
  RoofPlane plane;

  double inside(const Vec3 &p) const { return dot(inward, p - start); }
  // Nothing of the line between its ends belongs to others.
  bool whole(double tolerance) const { return last - first <= length + tolerance; }
};

class Builder {
 public:
  Builder(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
          double tolerance)
      : data_(data), neighbours_(neighbours), normals_(normals), tolerance_(tolerance), face_of_(data.triangles.size(), none) {}

  const Vec3 &corner(std::uint32_t t, std::size_t k) const { return data_.vertices[data_.triangles[t][k % 3]]; }

  // The triangles of the plane of `seed` that hang together with it.
  const std::vector<std::uint32_t> &flood(std::uint32_t seed, std::uint32_t face) {
    const Vec3 &normal = normals_[seed];
    const double offset = dot(normal, corner(seed, 0));
    members_.assign(1, seed);
    face_of_[seed] = face;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      for (const std::int32_t next : neighbours_[members_[i]]) {
        if (next < 0) continue;
        const auto t = static_cast<std::uint32_t>(next);
        if (face_of_[t] != none || !(dot(normals_[t], normal) > 0.5)) continue;
        bool flat = true;
        for (std::size_t k = 0; k < 3; ++k) flat = flat && std::fabs(dot(normal, corner(t, k)) - offset) <= tolerance_;
        if (!flat) continue;
        face_of_[t] = face;
        members_.push_back(t);
      }
    }
    return members_;
  }

  const std::vector<std::uint32_t> &face_of() const { return face_of_; }

  // Once all faces are known.
  const std::vector<Border> &borders(const std::vector<std::uint32_t> &members) {
    borders_.clear();
    for (const std::uint32_t t : members) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t other = neighbours_[t][k];
        if (other < 0 || face_of_[static_cast<std::size_t>(other)] != face_of_[t]) add_side(t, k, other);
      }
    }
    return borders_;
  }

 private:
  void add_side(std::uint32_t t, std::size_t k, std::int32_t other) {
    const Vec3 from = corner(t, k), to = corner(t, k + 1), direction = normalized(to - from);
    const std::uint32_t beyond = other < 0 ? none : face_of_[static_cast<std::size_t>(other)];
    for (Border &border : borders_) {
      if (border.beyond != beyond || dot(border.direction, direction) < 0.5) continue;
      if (std::fabs(border.inside(from)) > tolerance_ || std::fabs(border.inside(to)) > tolerance_) continue;
      border.first = std::fmin(border.first, dot(border.direction, from - border.start));
      border.last = std::fmax(border.last, dot(border.direction, to - border.start));
      border.length += norm(to - from);
      return;
    }
    Border border;
    border.start = from;
    border.direction = direction;
    border.inward = cross(normals_[t], direction);
    border.last = border.length = norm(to - from);
    border.beyond = beyond;
    if (other >= 0) {
      const Vec3 &normal = normals_[static_cast<std::size_t>(other)];
      border.convex = dot(normals_[t], cross(direction, normal)) < -1e-9;
      const Vec3 side = cross(normals_[t] + normal, direction);
      border.plane = {side, dot(side, from), beyond};
    }
    borders_.push_back(border);
  }

  const MeshData &data_;
  const std::vector<std::array<std::int32_t, 3>> &neighbours_;
  const std::vector<Vec3> &normals_;
  double tolerance_;
  std::vector<std::uint32_t> face_of_, members_;
  std::vector<Border> borders_;
};

}  // namespace

PlanarFaces::PlanarFaces(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours,
                         const std::vector<Vec3> &normals, const std::vector<double> &limits, double tolerance) {
  const auto count = static_cast<std::uint32_t>(data.triangles.size());
  Builder builder(data, neighbours, normals, tolerance);
  std::vector<std::vector<std::uint32_t>> faces;  // of several triangles
  std::uint32_t number = 0;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (builder.face_of()[t] != none) continue;
    const std::vector<std::uint32_t> &members = builder.flood(t, number++);
    if (members.size() > 1) faces.push_back(members);
  }
  face_of_ = builder.face_of();
  clear_depth_.assign(count, std::numeric_limits<double>::infinity());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // of triangle and plane
  for (const std::vector<std::uint32_t> &members : faces) {
    const std::vector<Border> &borders = builder.borders(members);
    const auto corners_of = [&](std::uint32_t t, const auto &act) {
      for (std::size_t k = 0; k < 3; ++k) act(builder.corner(t, k));
    };
    bool convex = true;
    for (const Border &border : borders) {
      for (std::size_t i = 0; i < members.size() && convex; ++i) {
        corners_of(members[i], [&](const Vec3 &p) { convex = convex && border.inside(p) >= -tolerance; });
      }
    }
    for (const Border &border : borders) {
      if (!border.convex) continue;
      const auto plane = static_cast<std::uint32_t>(planes_.size());
      bool used = false;
      for (const std::uint32_t t : members) {
        const double sink = dot(border.plane.normal, normals[t]);  // how fast the plane comes in with depth
        double first = std::numeric_limits<double>::infinity(), last = -first, inside = first, nearest = first;
        corners_of(t, [&](const Vec3 &p) {
          const double along = dot(border.direction, p - border.start);
          first = std::fmin(first, along), last = std::fmax(last, along);
          inside = std::fmin(inside, border.inside(p));
          nearest = std::fmin(nearest, dot(border.plane.normal, p) - border.plane.offset);
        });
        if (!(sink > 0.0)) continue;
        const double depth = std::fmax(0.0, nearest) / sink;
        if (depth >= limits[t]) continue;
        // Beside the ends of a side of a face with notches and holes the face may reach on.
        const bool beside = first >= border.first - tolerance && last <= border.last + tolerance && inside >= -tolerance &&
                            border.whole(tolerance);
        if (!convex && !beside) continue;
        pairs.emplace_back(t, plane);
        clear_depth_[t] = std::fmin(clear_depth_[t], depth);
        used = true;
      }
      if (used) planes_.push_back(border.plane);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  first_.assign(count + 1, 0);
  for (const auto &pair : pairs) ++first_[pair.first + 1];
  for (std::uint32_t t = 0; t < count; ++t) first_[t + 1] += first_[t];
  for (const auto &pair : pairs) members_.push_back(pair.second);
}

}  // namespace cmb::mesh
