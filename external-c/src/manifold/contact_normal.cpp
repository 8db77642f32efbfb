#include "manifold/contact_normal.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Directions nearer than this (sine) count as one.
constexpr double same_direction = 1e-12;

// Sums the weight of facets of the difference, polygons given edge by edge.
class FacetIntegral {
 public:
  // `normal` unit, outward; the facet's plane is at `height` >= 0 from the origin; `radius` of the ball.
  FacetIntegral(const Vec3 &normal, double height, double radius)
      : normal_(normal), foot_(height * normal), limit2_(radius * radius - height * height) {}

  bool empty() const { return !(limit2_ > 0.0); }

  // Adds the edge from p to q, counter-clockwise about the normal.
  void add_edge(const Vec3 &p, const Vec3 &q) {
    const Vec3 from = p - foot_, along = q - p;
    const double length2 = norm2(along);
    if (!(length2 > 0.0)) return;
    const double length = std::sqrt(length2);
    const double off = dot(normal_, cross(from, along)) / length;  // of the edge's line from the foot
    const double begin = dot(from, along) / length, end = begin + length;
    const double off2 = off * off;
    if (off2 >= limit2_) {
      if (off < 0.0) outside_ = true;
      add_angle(off, begin, end);
      return;
    }
    all_beyond_ = false;
    const double chord = std::sqrt(limit2_ - off2);
    const double low = std::clamp(begin, -chord, chord), high = std::clamp(end, -chord, chord);
    // The integral of (limit2 - r^2)^2 r dr, divided by r^2, along the edge.
    const auto antiderivative = [&](double t) {
      const double t2 = t * t;
      const double c0 = 3.0 * limit2_ * limit2_ - 3.0 * limit2_ * off2 + off2 * off2;
      return t * (c0 + t2 * ((2.0 * off2 - 3.0 * limit2_) / 3.0 + t2 / 5.0));
    };
    sum_ += off * (antiderivative(high) - antiderivative(low)) / 6.0;
    if (begin < -chord) add_angle(off, begin, std::min(end, -chord));
    if (end > chord) add_angle(off, std::max(begin, chord), end);
  }

  double value() const {
    const double whole = limit2_ * limit2_ * limit2_ / 6.0;
    if (all_beyond_) return outside_ ? 0.0 : 2.0 * 3.14159265358979323846 * whole;
    double angle = 0.0;
    for (int k = 0; k < arcs_; ++k) angle += std::atan2(arc_[k][0], arc_[k][1]);
    return std::max(0.0, sum_ + whole * (angle + more_angle_));
  }

 private:
  void add_angle(double off, double begin, double end) {
    const double sine = off * (end - begin), cosine = off * off + begin * end;
    if (arcs_ < most_arcs) {
      arc_[arcs_][0] = sine;
      arc_[arcs_++][1] = cosine;
    } else {
      more_angle_ += std::atan2(sine, cosine);
    }
  }

  static constexpr int most_arcs = 16;
  Vec3 normal_, foot_;
  double limit2_, sum_ = 0.0, more_angle_ = 0.0;
  double arc_[most_arcs][2];
  int arcs_ = 0;
  bool all_beyond_ = true, outside_ = false;
};

struct Mean {
  Vec3 sum;
  double of_a = 0.0, total = 0.0;

  void add(const Vec3 &outward, double weight, double part_of_a) {
    sum = sum - weight * outward;
    total += weight;
    of_a += part_of_a * weight;
  }
};

// The facets that faces of one body make with the farthest corner of the other. x = a - b.
void add_faces(const PolytopeSide &own, const PolytopeSide &other, double radius, Mean &mean) {
  const double sign = own.sense() < 0.0 ? 1.0 : -1.0;  // own is A, or B
  const convex::Polytope &geometry = own.body().geometry();
  const convex::Polytope &other_geometry = other.body().geometry();
  for (const PolytopeSide::Face &face : own.faces()) {
    // The difference's outward normal there is sign * face.normal.
    const PolytopeSide::Vertex *best = nullptr;
    double least = HUGE_VAL;
    for (const PolytopeSide::Vertex &v : other.vertices()) {
      if (!v.inside) continue;
      const double height = dot(face.shaken_normal, v.shaken);
      if (height < least) least = height, best = &v;
    }
    if (best == nullptr) continue;
    const double height = face.offset - dot(face.normal, best->at);
    if (!(height < radius)) continue;
    // Where a corner beyond the gathered part is farther, so is the facet.
    const std::int32_t number = best->number;
    bool farthest = true;
    for (std::int32_t k = other_geometry.neighbour_begin(number);
         k < other_geometry.neighbour_begin(number + 1) && farthest; ++k) {
      const Vec3 p = other.to_contact()(other_geometry.vertices()[index(other_geometry.neighbours()[index(k)])]);
      farthest = !(dot(face.shaken_normal, other.shake()(p)) < least);
    }
    if (!farthest) continue;
    const Vec3 outward = sign * face.normal;
    FacetIntegral integral(outward, std::max(height, 0.0), radius);
    if (integral.empty()) continue;
    const convex::Polytope::Face &polygon = geometry.faces()[index(face.number)];
    const auto corner = [&](std::int32_t k) {
      const Vec3 p = own.to_contact()(geometry.vertices()[index(geometry.face_vertices()[index(polygon.first + k)])]);
      return sign * (p - best->at);
    };
    const Vec3 first = corner(0);
    Vec3 from = first;
    for (std::int32_t k = 1; k <= polygon.count; ++k) {
      const Vec3 to = k < polygon.count ? corner(k) : first;
      // B's polygon, seen from the other side, runs clockwise.
      if (sign > 0.0) integral.add_edge(from, to);
      else integral.add_edge(to, from);
      from = to;
    }
    mean.add(outward, integral.value(), own.sense() < 0.0 ? 1.0 : 0.0);
  }
}

// The facets of the difference that two edges make.
void add_edges(const PolytopeSide &a, const PolytopeSide &b, double radius, Mean &mean) {
  for (const PolytopeSide::Edge &e : a.edges()) {
    const Vec3 &e0 = a.vertices()[index(e.vertex[0])].at, &e1 = a.vertices()[index(e.vertex[1])].at;
    const Vec3 de = e1 - e0;
    const Vec3 &n0 = a.faces()[index(e.face[0])].normal, &n1 = a.faces()[index(e.face[1])].normal;
    const Vec3 low{std::min(e0.x, e1.x) - radius, std::min(e0.y, e1.y) - radius, std::min(e0.z, e1.z) - radius};
    const Vec3 high{std::max(e0.x, e1.x) + radius, std::max(e0.y, e1.y) + radius, std::max(e0.z, e1.z) + radius};
    for (const PolytopeSide::Edge &f : b.edges()) {
      const PolytopeSide::Vertex &v0 = b.vertices()[index(f.vertex[0])], &v1 = b.vertices()[index(f.vertex[1])];
      const Vec3 &f0 = v0.at, &f1 = v1.at;
      if ((f0.x < low.x && f1.x < low.x) || (f0.x > high.x && f1.x > high.x) || (f0.y < low.y && f1.y < low.y) ||
          (f0.y > high.y && f1.y > high.y) || (f0.z < low.z && f1.z < low.z) || (f0.z > high.z && f1.z > high.z)) {
        continue;
      }
      // The arcs of the edges' outward directions, B's turned over, cross.
      const Vec3 shaken_df = v1.shaken - v0.shaken;
      const double side0 = dot(n0, shaken_df), side1 = dot(n1, shaken_df);
      if (side0 * side1 >= 0.0) continue;
      const Vec3 &m0 = b.faces()[index(f.face[0])].shaken_normal, &m1 = b.faces()[index(f.face[1])].shaken_normal;
      const double other0 = dot(m0, de), other1 = dot(m1, de);
      if (other0 * other1 >= 0.0) continue;
      // Of the great circles' two crossings the one on A's arc: between n0 and n1.
      const Vec3 crossing = std::fabs(side1) * n0 + std::fabs(side0) * n1;
      const Vec3 other = std::fabs(other1) * m0 + std::fabs(other0) * m1;
      if (dot(crossing, other) >= 0.0) continue;
      const Vec3 df = f1 - f0;
      Vec3 outward = cross(de, df);
      const double size = norm(outward);
      if (!(size * size > same_direction * same_direction * norm2(de) * norm2(df))) continue;
      outward = ((dot(outward, crossing) > 0.0 ? 1.0 : -1.0) / size) * outward;
      const Vec3 first = e0 - f0;
      const double height = dot(outward, first);
      if (!(height < radius)) continue;
      FacetIntegral integral(outward, std::max(height, 0.0), radius);
      if (integral.empty()) continue;
      const Vec3 second = e1 - f0, third = e1 - f1, fourth = e0 - f1;
      if (dot(outward, cross(de, df)) < 0.0) {
        integral.add_edge(first, second);
        integral.add_edge(second, third);
        integral.add_edge(third, fourth);
        integral.add_edge(fourth, first);
      } else {
        integral.add_edge(first, fourth);
        integral.add_edge(fourth, third);
        integral.add_edge(third, second);
        integral.add_edge(second, first);
      }
      mean.add(outward, integral.value(), 0.5);
    }
  }
}

}  // namespace

ContactNormal mean_contact_normal(const PolytopeSide &a, const PolytopeSide &b, double least) {
  const double radius = normal_reach * least;
  Mean mean;
  add_faces(a, b, radius, mean);
  add_faces(b, a, radius, mean);
  add_edges(a, b, radius, mean);
  ContactNormal result;
  result.up = normalized(mean.sum);
  result.part_of_a = mean.total > 0.0 ? mean.of_a / mean.total : 0.5;
  return result;
}

}  // namespace cmb
