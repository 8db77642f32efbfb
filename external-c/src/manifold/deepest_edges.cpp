#include "manifold/deepest_edges.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/rod_end_share.hpp"

namespace cmb {

namespace {

// What counts is less than this part of the depth above the deepest place.
constexpr double band = 0.05;
// Edges so short beside the depth do not tell the place alone: a tip's, steeper than two to one.
constexpr double short_edges = 0.01;

// Part of a line, by a parameter.
struct Stretch {
  double from, to;
};

// Leaves of a stretch what is where begin + t (end - begin) is positive.
void keep_positive(double begin, double end, Stretch &stretch) {
  if (begin <= 0.0 && end <= 0.0) {
    stretch.to = stretch.from;
  } else if (begin < 0.0) {
    stretch.from = std::max(stretch.from, begin / (begin - end));
  } else if (end < 0.0) {
    stretch.to = std::min(stretch.to, begin / (begin - end));
  }
}

// Leaves of a stretch of from + t along what is less than `radius` from the origin.
void keep_near(const Vec3 &from, const Vec3 &along, double radius, Stretch &stretch) {
  const double aa = norm2(along), ab = dot(along, from), bb = norm2(from) - radius * radius;
  const double discriminant = ab * ab - aa * bb;
  if (!(discriminant > 0.0)) {
    if (aa > 0.0 || bb > 0.0) stretch.to = stretch.from;
    return;
  }
  const double root = std::sqrt(discriminant);
  stretch.from = std::max(stretch.from, (-ab - root) / aa);
  stretch.to = std::min(stretch.to, (-ab + root) / aa);
}

}  // namespace

Vec3 middle_of_deepest(const Disc &disc, const convex::Polytope &polytope, const Pose &pose, double depth,
                       const Vec3 &deepest, const Vec3 &witness) {
  const double level = dot(disc.axis, disc.center - deepest) - band * depth;
  double sum = 0.0;
  Vec3 first;  // of the place, from the witness
  for (const convex::Polytope::Edge &edge : polytope.edges()) {
    const Vec3 begin = pose(polytope.vertices()[static_cast<std::size_t>(edge.vertex[0])]) - disc.center;
    const Vec3 end = pose(polytope.vertices()[static_cast<std::size_t>(edge.vertex[1])]) - disc.center;
    const double below0 = -dot(disc.axis, begin), below1 = -dot(disc.axis, end);
    Stretch stretch{0.0, 1.0};
    keep_positive(below0 - level, below1 - level, stretch);
    if (!(stretch.from < stretch.to)) continue;
    const Vec3 flat0 = begin + below0 * disc.axis, flat1 = end + below1 * disc.axis;  // on the disc's plane
    keep_near(flat0, flat1 - flat0, disc.radius, stretch);
    if (!(stretch.from < stretch.to)) continue;
    const auto above = [&](double t) { return below0 + t * (below1 - below0) - level; };
    const double more0 = above(stretch.from), more1 = above(stretch.to);
    const double length = (stretch.to - stretch.from) * norm(end - begin);
    const double part = 0.5 * length * (more0 + more1);
    if (!(part > 0.0)) continue;
    const double at = length * (stretch.from * (2.0 * more0 + more1) + stretch.to * (more0 + 2.0 * more1)) / (6.0 * part);
    const Vec3 place = disc.center + begin + at * (end - begin) + (0.5 * (above(at) + level)) * disc.axis;
    sum += part;
    first = first + part * (place - witness);
  }
  const double whole = short_edges * band * depth * depth;
  return witness + (1.0 / (sum + whole * falling_smoothstep(sum / whole))) * first;
}

}  // namespace cmb
