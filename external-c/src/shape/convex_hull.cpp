#include "shape/convex_hull.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "math/index.hpp"
#include "shape/incremental_hull.hpp"

namespace cmb::convex {

namespace {

using FaceList = std::vector<std::vector<std::int32_t>>;

double plane_distance(const IncrementalHull::Face &face, const Vec3 &p) { return dot(face.normal, p) - face.offset; }

// Four points far apart: ends of the widest axis, farthest from their line, farthest from that plane.
bool first_tetrahedron(const std::vector<Vec3> &points, double thickness, std::array<std::size_t, 4> &chosen) {
  std::array<std::size_t, 2> ends{0, 0};
  double widest = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vec3 &a, const Vec3 &b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
    if ((*high)[axis] - (*low)[axis] > widest) {
      widest = (*high)[axis] - (*low)[axis];
      ends = {static_cast<std::size_t>(low - points.begin()), static_cast<std::size_t>(high - points.begin())};
    }
  }
  if (!(widest > thickness)) return false;
  const Vec3 along = normalized(points[ends[1]] - points[ends[0]]);
  std::size_t third = 0, fourth = 0;
  double best = -1.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double away = norm2(cross(along, points[k] - points[ends[0]]));
    if (away > best) best = away, third = k;
  }
  const Vec3 across = normalized(cross(along, points[third] - points[ends[0]]));
  best = -1.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double away = std::fabs(dot(across, points[k] - points[ends[0]]));
    if (away > best) best = away, fourth = k;
  }
  chosen = {ends[0], ends[1], third, fourth};
  return best > thickness;
}

// Quickhull: every point waits at one face that it lies outside of; the farthest of a face goes first.
bool grow(const std::vector<Vec3> &points, double thickness, IncrementalHull &hull,
          std::vector<std::int32_t> &source, std::string &problem) {
  std::array<std::size_t, 4> first{};
  if (!first_tetrahedron(points, thickness, first) ||
      !hull.start(points[first[0]], points[first[1]], points[first[2]], points[first[3]], thickness)) {
    problem = "the points span no volume";
    return false;
  }
  for (std::int32_t p = 0; p < 4; ++p) {  // start() may have exchanged points
    for (std::size_t candidate : first) {
      if (norm2(hull.point(p) - points[candidate]) == 0.0) source.push_back(static_cast<std::int32_t>(candidate));
    }
  }
  source.resize(4);
  FaceList waiting(4);
  const auto assign = [&](std::int32_t p, std::int32_t begin) {
    std::int32_t where = -1;
    double farthest = thickness;
    for (std::int32_t f = begin; f < hull.face_count(); ++f) {
      const double away = hull.face(f).alive ? plane_distance(hull.face(f), points[index(p)]) : 0.0;
      if (away > farthest) farthest = away, where = f;
    }
    if (where >= 0) waiting[index(where)].push_back(p);
  };
  for (std::size_t p = 0; p < points.size(); ++p) assign(static_cast<std::int32_t>(p), 0);
  for (std::int32_t f = 0; f < hull.face_count(); ++f) {
    if (!hull.face(f).alive || waiting[index(f)].empty()) continue;
    std::vector<std::int32_t> &queue = waiting[index(f)];
    const auto farthest = std::max_element(queue.begin(), queue.end(), [&](std::int32_t a, std::int32_t b) {
      return plane_distance(hull.face(f), points[index(a)]) < plane_distance(hull.face(f), points[index(b)]);
    });
    const std::int32_t p = *farthest;
    queue.erase(farthest);
    const auto outcome = hull.expand(f, points[index(p)], 0.1 * thickness, 0.1 * thickness);
    if (outcome == IncrementalHull::Outcome::full) {
      problem = "too many faces";
      return false;
    }
    if (outcome != IncrementalHull::Outcome::expanded) {
      --f;  // the point is outside by rounding only: leave it out, look at the face again
      continue;
    }
    source.push_back(p);
    waiting.resize(index(hull.face_count()));
    std::vector<std::int32_t> orphans;
    for (std::int32_t removed : hull.removed_faces()) {
      orphans.insert(orphans.end(), waiting[index(removed)].begin(), waiting[index(removed)].end());
      waiting[index(removed)].clear();
    }
    std::sort(orphans.begin(), orphans.end());
    const std::int32_t begin = hull.first_new_face();
    for (std::int32_t orphan : orphans) assign(orphan, begin);
  }
  return true;
}

// Groups triangles by plane, largest first, and walks round each group's boundary.
FaceList merge_coplanar(const IncrementalHull &hull, double thickness) {
  const auto area = [&](std::int32_t f) {
    const IncrementalHull::Face &face = hull.face(f);
    if (face.sliver) return 0.0;
    const Vec3 &a = hull.point(face.vertex[0]);
    return norm(cross(hull.point(face.vertex[1]) - a, hull.point(face.vertex[2]) - a));
  };
  std::vector<std::int32_t> order;
  std::vector<double> areas(index(hull.face_count()), 0.0);
  for (std::int32_t f = 0; f < hull.face_count(); ++f) {
    if (!hull.face(f).alive) continue;
    order.push_back(f);
    areas[index(f)] = area(f);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return areas[index(a)] > areas[index(b)]; });
  std::vector<std::int32_t> group(index(hull.face_count()), -1);
  std::int32_t groups = 0;
  for (std::int32_t seed : order) {
    if (group[index(seed)] >= 0) continue;
    std::vector<std::int32_t> members{seed};
    group[index(seed)] = groups;
    const IncrementalHull::Face plane = hull.face(seed);
    for (std::size_t k = 0; k < members.size(); ++k) {
      for (std::int32_t g : hull.face(members[k]).neighbour) {
        if (group[index(g)] >= 0) continue;
        const IncrementalHull::Face &other = hull.face(g);
        const bool flat = std::all_of(other.vertex, other.vertex + 3, [&](std::int32_t v) {
          return std::fabs(plane_distance(plane, hull.point(v))) <= thickness;
        });
        if (!flat) continue;
        group[index(g)] = groups;
        members.push_back(g);
      }
    }
    ++groups;
  }
  FaceList polygons(index(groups));
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> boundary(index(groups));
  for (std::int32_t f : order) {
    const IncrementalHull::Face &face = hull.face(f);
    for (int i = 0; i < 3; ++i) {
      if (group[index(face.neighbour[i])] == group[index(f)]) continue;
      boundary[index(group[index(f)])].push_back({face.vertex[i], face.vertex[(i + 1) % 3]});
    }
  }
  for (std::size_t g = 0; g < boundary.size(); ++g) {
    if (boundary[g].empty()) continue;
    const std::int32_t begin = std::min_element(boundary[g].begin(), boundary[g].end())->first;
    std::int32_t at = begin;
    do {
      polygons[g].push_back(at);
      const auto next =
          std::find_if(boundary[g].begin(), boundary[g].end(), [at](const auto &edge) { return edge.first == at; });
      if (next == boundary[g].end()) break;
      at = next->second;
    } while (at != begin && polygons[g].size() <= boundary[g].size());
  }
  return polygons;
}

bool attempt(const std::vector<Vec3> &points, double extent, double tolerance, Polytope &result,
             std::vector<std::int32_t> *kept, std::string &problem) {
  const double thickness = tolerance * extent;
  IncrementalHull hull(points.size() + 4, 64 * points.size() + 64);
  std::vector<std::int32_t> source;
  if (!grow(points, thickness, hull, source, problem)) return false;
  const FaceList polygons = merge_coplanar(hull, thickness);
  // A vertex of fewer than three polygons lies within a face or an edge: leave it out.
  std::vector<int> uses(index(hull.point_count()), 0);
  for (const auto &polygon : polygons) {
    for (std::int32_t v : polygon) ++uses[index(v)];
  }
  std::vector<std::int32_t> renumbered(uses.size(), -1), used;
  for (std::size_t v = 0; v < uses.size(); ++v) {
    if (uses[v] < 3) continue;
    renumbered[v] = static_cast<std::int32_t>(used.size());
    used.push_back(static_cast<std::int32_t>(v));
  }
  FaceList faces;
  for (const auto &polygon : polygons) {
    std::vector<std::int32_t> face;
    for (std::int32_t v : polygon) {
      if (renumbered[index(v)] >= 0) face.push_back(renumbered[index(v)]);
    }
    if (face.size() >= 3) faces.push_back(std::move(face));
  }
  std::vector<Vec3> vertices;
  for (std::int32_t v : used) vertices.push_back(hull.point(v));
  Polytope built;
  // No point may be left outside by rounding.
  if (!Polytope::build(vertices, faces, built, &problem, 100.0 * tolerance, &points)) return false;
  result = std::move(built);
  if (kept != nullptr) {
    kept->clear();
    for (std::int32_t v : used) kept->push_back(source[index(v)]);
  }
  return true;
}

}  // namespace

bool build_convex_hull(const std::vector<Vec3> &points, Polytope &result, std::vector<std::int32_t> *kept,
                       std::string *problem, double tolerance) {
  if (points.size() < 4) {
    if (problem != nullptr) *problem = "a hull needs at least 4 points";
    return false;
  }
  Vec3 low = points[0], high = points[0];
  for (const Vec3 &p : points) {
    if (!is_finite(p)) {
      if (problem != nullptr) *problem = "a point is not finite";
      return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
      low.set(axis, std::min(low[axis], p[axis]));
      high.set(axis, std::max(high[axis], p[axis]));
    }
  }
  const double extent = norm(high - low);
  std::string reason = "the points span no volume";
  // Points that lie in a plane only nearly can make slivers that do not fit together: coarser then.
  for (double t = tolerance; t <= 1001.0 * tolerance; t *= 10.0) {
    if (attempt(points, extent, t, result, kept, reason)) return true;
  }
  if (problem != nullptr) *problem = reason;
  return false;
}

}  // namespace cmb::convex
