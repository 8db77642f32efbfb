#include "narrowphase/polytope/feature_enumeration.hpp"

#include <algorithm>

#include "math/index.hpp"

namespace cmb::convex {

namespace {

const Polytope &unit_box() {
  static const Polytope box = Polytope::box({1, 1, 1});
  return box;
}

// Vertices, edges and faces of a polyhedral core in A's frame, whatever its shape.
class Features {
 public:
  Features(const ConvexBody &body, const Pose &pose) : body_(body), pose_(pose) {
    if (body.core == CoreShape::box) topology_ = &unit_box();
    if (body.core == CoreShape::polytope) topology_ = body.polytope;
  }
  std::int32_t vertex_count() const {
    if (topology_ != nullptr) return static_cast<std::int32_t>(topology_->vertices().size());
    return body_.core == CoreShape::segment ? 2 : 1;
  }
  Vec3 vertex(std::int32_t v) const {
    switch (body_.core) {
      case CoreShape::point: return pose_.translation;
      case CoreShape::segment: return pose_(v == 0 ? -body_.half : body_.half);
      case CoreShape::box: {
        const Vec3 &p = topology_->vertices()[index(v)];
        return pose_({2 * p.x * body_.half.x, 2 * p.y * body_.half.y, 2 * p.z * body_.half.z});
      }
      default: return pose_(topology_->vertices()[index(v)]);
    }
  }
  std::int32_t edge_count() const {
    if (topology_ != nullptr) return static_cast<std::int32_t>(topology_->edges().size());
    return body_.core == CoreShape::segment ? 1 : 0;
  }
  std::int32_t edge_vertex(std::int32_t e, int end) const {
    return topology_ != nullptr ? topology_->edges()[index(e)].vertex[end] : end;
  }
  Vec3 edge_direction(std::int32_t e) const {
    return pose_.rotation * (topology_ != nullptr ? topology_->edge_directions()[index(e)] : Vec3{0, 0, 1});
  }
  bool has_faces() const { return topology_ != nullptr; }
  Vec3 edge_face_normal(std::int32_t e, int side) const {
    return face_normal(topology_->edges()[index(e)].face[side]);
  }
  std::int32_t face_count() const {
    return topology_ != nullptr ? static_cast<std::int32_t>(topology_->faces().size()) : 0;
  }
  Vec3 face_normal(std::int32_t f) const { return pose_.rotation * topology_->faces()[index(f)].normal; }
  std::int32_t face_size(std::int32_t f) const { return topology_->faces()[index(f)].count; }
  std::int32_t face_vertex(std::int32_t f, std::int32_t k) const {
    return topology_->face_vertices()[index(topology_->faces()[index(f)].first + k)];
  }

 private:
  const ConvexBody &body_;
  const Pose &pose_;
  const Polytope *topology_ = nullptr;
};

struct Lowest {
  double height = INFINITY;  // of the difference's support function
  Vec3 direction{0, 0, 1};
  DifferencePoint support;
};

void try_direction(const MinkowskiDifference &difference, const Vec3 &direction, Lowest &lowest) {
  const DifferencePoint p = difference.support(direction);
  const double height = dot(p.w, direction);
  if (height < lowest.height) lowest = {height, direction, p};
}

// Whether the edges' arcs on the Gauss map (B's mirrored) cross or all but cross.
bool arcs_may_cross(const Vec3 &a0, const Vec3 &a1, const Vec3 &edge_a, const Vec3 &b0, const Vec3 &b1,
                    const Vec3 &edge_b) {
  constexpr double slack = 1e-9;
  const double b0_side = dot(b0, edge_a), b1_side = dot(b1, edge_a);
  if (b0_side * b1_side > slack * slack && std::min(std::fabs(b0_side), std::fabs(b1_side)) > slack) return false;
  const double a0_side = dot(a0, edge_b), a1_side = dot(a1, edge_b);
  if (a0_side * a1_side > slack * slack && std::min(std::fabs(a0_side), std::fabs(a1_side)) > slack) return false;
  return true;
}

Lowest lowest_direction(const MinkowskiDifference &difference, const Features &a, const Features &b) {
  Lowest lowest;
  for (std::int32_t f = 0; f < a.face_count(); ++f) try_direction(difference, a.face_normal(f), lowest);
  for (std::int32_t f = 0; f < b.face_count(); ++f) try_direction(difference, -b.face_normal(f), lowest);
  for (std::int32_t e = 0; e < a.edge_count(); ++e) {
    const Vec3 edge_a = a.edge_direction(e);
    const Vec3 point_a = a.vertex(a.edge_vertex(e, 0));
    for (std::int32_t g = 0; g < b.edge_count(); ++g) {
      const Vec3 edge_b = b.edge_direction(g);
      if (a.has_faces() && b.has_faces() &&
          !arcs_may_cross(a.edge_face_normal(e, 0), a.edge_face_normal(e, 1), edge_a, -b.edge_face_normal(g, 0),
                          -b.edge_face_normal(g, 1), edge_b)) {
        continue;
      }
      Vec3 n;
      if (!common_perpendicular(edge_a, edge_b, n)) continue;
      const double height = dot(n, point_a - b.vertex(b.edge_vertex(g, 0)));
      // Where both edges support the difference, its support function is this height.
      if (height < lowest.height) try_direction(difference, n, lowest);
      if (-height < lowest.height) try_direction(difference, -n, lowest);
    }
  }
  return lowest;
}

struct Shortest {
  const MinkowskiDifference &difference;
  Lowest parting;  // the direction that parts the bodies most, of all tried
  double distance2 = INFINITY;
  Vec3 a, b;
};

// `direction` runs along b - a, but is normal to the features to rounding however near they are. Where
// pairs are equally short to rounding (a vertex and the edge beside it), each direction is tried.
void keep_shorter(Shortest &best, const Vec3 &a, const Vec3 &b, const Vec3 &direction) {
  const double distance2 = norm2(a - b);
  if (distance2 > best.distance2 * (1.0 + 1e-9)) return;
  const double length = norm(direction);
  if (length > 0.0) {
    const double factor = (dot(direction, b - a) < 0.0 ? -1.0 : 1.0) / length;
    try_direction(best.difference, factor * direction, best.parting);
  }
  if (distance2 >= best.distance2) return;
  best.distance2 = distance2;
  best.a = a;
  best.b = b;
}

Vec3 normal_part(const Vec3 &d, const Vec3 &edge) {
  const double length2 = norm2(edge);
  return length2 > 0.0 ? d - (dot(d, edge) / length2) * edge : d;
}

// A vertex against the edge from p to q: `exchanged` where the vertex is B's.
void vertex_against_edge(const Vec3 &vertex, const Vec3 &p, const Vec3 &q, bool exchanged, Shortest &best) {
  const Vec3 u = q - p;
  const double length2 = norm2(u);
  const double t = length2 > 0.0 ? std::clamp(dot(vertex - p, u) / length2, 0.0, 1.0) : 0.0;
  const Vec3 foot = t < 0.5 ? p + t * u : q - (1.0 - t) * u;
  const Vec3 across = t > 0.0 && t < 1.0 ? normal_part(foot - vertex, u) : foot - vertex;
  exchanged ? keep_shorter(best, foot, vertex, across) : keep_shorter(best, vertex, foot, across);
}

// Point against the inside of each face: `exchanged` where the point is B's.
void points_against_faces(const Features &points, const Features &faces, bool exchanged, Shortest &best) {
  for (std::int32_t f = 0; f < faces.face_count(); ++f) {
    const Vec3 n = faces.face_normal(f);
    const Vec3 corner = faces.vertex(faces.face_vertex(f, 0));
    for (std::int32_t v = 0; v < points.vertex_count(); ++v) {
      const Vec3 p = points.vertex(v);
      const double height = dot(n, p - corner);
      if (height < 0.0 || height * height > best.distance2 * (1.0 + 1e-9)) continue;
      bool inside = true;
      for (std::int32_t k = 0; inside && k < faces.face_size(f); ++k) {
        const Vec3 q0 = faces.vertex(faces.face_vertex(f, k));
        const Vec3 q1 = faces.vertex(faces.face_vertex(f, (k + 1) % faces.face_size(f)));
        inside = dot(cross(q1 - q0, p - q0), n) >= 0.0;
      }
      if (!inside) continue;
      const Vec3 foot = p - height * n;
      exchanged ? keep_shorter(best, foot, p, n) : keep_shorter(best, p, foot, n);
    }
  }
}

void find_shortest(const Features &a, const Features &b, Shortest &best) {
  points_against_faces(a, b, false, best);
  points_against_faces(b, a, true, best);
  // Edges against edges: inside of both, then ends against edges.
  for (std::int32_t e = 0; e < a.edge_count(); ++e) {
    const Vec3 p0 = a.vertex(a.edge_vertex(e, 0)), p1 = a.vertex(a.edge_vertex(e, 1));
    for (std::int32_t g = 0; g < b.edge_count(); ++g) {
      const Vec3 q0 = b.vertex(b.edge_vertex(g, 0)), q1 = b.vertex(b.edge_vertex(g, 1));
      const Vec3 u = p1 - p0, v = q1 - q0, n = cross(u, v);
      const double n2 = norm2(n);
      if (n2 > 0.0) {
        const double s = dot(cross(q0 - p0, v), n) / n2, t = dot(cross(q0 - p0, u), n) / n2;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) keep_shorter(best, p0 + s * u, q0 + t * v, n);
      }
      vertex_against_edge(p0, q0, q1, false, best);
      vertex_against_edge(p1, q0, q1, false, best);
      vertex_against_edge(q0, p0, p1, true, best);
      vertex_against_edge(q1, p0, p1, true, best);
    }
  }
  // A body that is a point has no edges.
  for (std::int32_t e = 0; a.edge_count() == 0 && e < b.edge_count(); ++e) {
    vertex_against_edge(a.vertex(0), b.vertex(b.edge_vertex(e, 0)), b.vertex(b.edge_vertex(e, 1)), false, best);
  }
  for (std::int32_t e = 0; b.edge_count() == 0 && e < a.edge_count(); ++e) {
    vertex_against_edge(b.vertex(0), a.vertex(a.edge_vertex(e, 0)), a.vertex(a.edge_vertex(e, 1)), true, best);
  }
}

}  // namespace

EnumerationResult enumerate_features(const MinkowskiDifference &difference) {
  const Pose identity;
  const Features a(difference.body_a, identity), b(difference.body_b, difference.b_in_a);
  const Lowest lowest = lowest_direction(difference, a, b);
  EnumerationResult result{-lowest.height, lowest.direction, lowest.support.a, lowest.support.b};
  if (lowest.height >= 0.0) return result;
  Shortest shortest{difference, lowest, INFINITY, {}, {}};
  find_shortest(a, b, shortest);
  result.a = shortest.a;
  result.b = shortest.b;
  result.distance = std::sqrt(shortest.distance2);
  result.direction = shortest.parting.direction;
  return result;
}

}  // namespace cmb::convex
