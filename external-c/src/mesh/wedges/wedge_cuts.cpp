#include "mesh/wedges/wedge_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/core/ray_hit.hpp"
#include "mesh/wedges/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;  // by the mesh's size
constexpr int most_cuts = 12;      // of one triangle

// The wedge of one triangle.
class Wedge {
 public:
  Wedge(const MeshData &data, const std::vector<Vec3> &normals, const PlanarFaces &faces, std::uint32_t t, double tolerance)
      : data_(data), normals_(normals), faces_(faces), t_(t), tolerance_(tolerance), normal_(normals[t]), offset_(dot(normal_, corner(t, 0))) {
    keep_before(-normal_, -offset_);
  }

  // The line down from a corner between two sides, by how much deeper it goes; false where it runs level, or nearly.
  bool line_down(const std::array<WedgeSide, 3> &sides, std::size_t k, Vec3 &line) const {
    constexpr double least_slope = 0.1;
    const Vec3 along = cross(sides[k].normal, sides[(k + 2) % 3].normal);
    const double down = -dot(along, normal_);
    if (!(std::fabs(down) > least_slope * norm(along))) return false;
    line = (1.0 / down) * along;
    return true;
  }

  // How far the triangle reaches from its middle.
  double width() const {
    const Vec3 middle = (1.0 / 3.0) * (corner(t_, 0) + corner(t_, 1) + corner(t_, 2));
    return std::max({norm(corner(t_, 0) - middle), norm(corner(t_, 1) - middle), norm(corner(t_, 2) - middle)});
  }

  // How deep the line down from a corner is where it leaves the mesh; infinite where it does not.
  double way_out(const std::array<WedgeSide, 3> &sides, std::size_t k, const TriangleHierarchy &hierarchy) const {
    Vec3 line;
    if (!line_down(sides, k, line)) return infinity;
    const double length = norm(line);
    line = (1.0 / length) * line;
    const Vec3 &from = corner(t_, k);
    const std::uint32_t vertex = data_.triangles[t_][k];
    double hit = infinity;
    hierarchy.visit_along(from, line, [&] { return hit; }, [&](std::uint32_t other) {
      const Triangle &corners = data_.triangles[other];
      if (corners[0] == vertex || corners[1] == vertex || corners[2] == vertex || !(dot(normals_[other], line) > 0.0)) return;
      hit = std::min(hit, ray_hit(from, line, corner(other, 0), corner(other, 1), corner(other, 2)));
    });
    return hit / length;
  }

  void keep_before(const Vec3 &normal, double offset) {
    const double scale = 1.0 / norm(normal);
    planes_.push_back({scale * normal, scale * offset});
  }
  void end_at(double limit) { keep_before(normal_, offset_ - limit); }
  // Whether what is below triangles in the box, as deep as `reach` at most, leaves the wedge alone.
  bool leaves_out(const Bounds &box, double reach) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const WedgeSide &plane) {
      double most = reach;
      for (int k = 0; k < 3; ++k) most += plane.normal[k] * (plane.normal[k] > 0.0 ? box.high[k] : box.low[k]);
      return most < plane.offset;
    });
  }

  // Where places below another triangle are as near to its plane as to this one's: how deep that begins in the wedge; infinite where it does
  // not come there.
  double begin_of(std::uint32_t other) {
    if (faces_.face_of(other) == faces_.face_of(t_)) return infinity;
    const Vec3 &normal = normals_[other];
    const double closing = 1.0 - dot(normal, normal_);  // how fast both depths come together along the other's normal
    if (!(closing > least_closing)) return infinity;
    polygon_.assign({corner(other, 0), corner(other, 1), corner(other, 2)});
    const auto lower = [&](Vec3 &p) { p = p - (depth(p) / closing) * normal; };
    if (depth(polygon_[0]) >= 0.0 && depth(polygon_[1]) >= 0.0 && depth(polygon_[2]) >= 0.0) {
      for (Vec3 &p : polygon_) lower(p);
      if (is_beyond(beside)) return infinity;
    } else {
      clip_polygon(polygon_, -normal_, -offset_, room_);
      for (Vec3 &p : polygon_) lower(p);
    }
    if (!keep_inside(beside)) return infinity;
    double begin = infinity;
    for (const Vec3 &p : polygon_) begin = std::min(begin, depth(p));
    return begin;
  }

  // The plane that halves the angle to the other triangle's; false where the triangle is not behind that.
  bool find_plane(std::uint32_t other, WedgeSide &plane) const {
    const Vec3 &normal = normals_[other], across = normal_ - normal;
    const double offset = dot(normal, corner(other, 0));
    for (std::size_t k = 0; k < 3; ++k) {
      if (dot(normal, corner(t_, k)) > offset + tolerance_) return false;
    }
    const double length = norm(across);
    plane = {(1.0 / length) * across, (offset_ - offset) / length};
    return true;
  }

  // How deep in the wedge a plane begins to cut; infinite where it does not.
  double clear_depth(const WedgeSide &plane, double size) {
    const Vec3 along = convex::any_perpendicular(plane.normal), across = cross(plane.normal, along);
    const Vec3 &corner0 = corner(t_, 0), middle = corner0 - (dot(plane.normal, corner0) - plane.offset) * plane.normal;
    polygon_ = {middle + size * along, middle + size * across, middle - size * along, middle - size * across};
    double begin = infinity;
    if (!keep_inside(0.0)) return infinity;
    for (const Vec3 &p : polygon_) begin = std::min(begin, depth(p));
    return std::max(0.0, begin);
  }

 private:
  static constexpr double least_closing = 1e-6;
  // Beside an edge as high above a plane as h places that are less than h off are nearer to it, or hardly farther.
  static constexpr double beside = 0.5;

  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }
  // Whether all of the polygon is beyond one of the planes, and not beside the wedge either.
  bool is_beyond(double part) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const WedgeSide &plane) {
      return std::all_of(polygon_.begin(), polygon_.end(),
                         [&](const Vec3 &p) { return dot(plane.normal, p) < plane.offset - part * depth(p); });
    });
  }
  // Keeps the polygon's part in the wedge, or beside it by a part of the depth; false where that is nothing but border.
  bool keep_inside(double part) {
    for (const WedgeSide &plane : planes_) {
      if (polygon_.size() < 3) return false;
      clip_polygon(polygon_, plane.normal - part * normal_, plane.offset - part * offset_, room_);
    }
    if (polygon_.size() < 3) return false;
    Vec3 middle;
    for (const Vec3 &p : polygon_) middle = middle + (1.0 / static_cast<double>(polygon_.size())) * p;
    return std::all_of(planes_.begin(), planes_.end(), [&](const WedgeSide &plane) {
      return dot(plane.normal, middle) > plane.offset - part * depth(middle) + tolerance_;
    });
  }
  const Vec3 &corner(std::uint32_t t, std::size_t k) const { return data_.vertices[data_.triangles[t][k]]; }

  const MeshData &data_;
  const std::vector<Vec3> &normals_;
  const PlanarFaces &faces_;
  std::uint32_t t_;
  double tolerance_;
  Vec3 normal_;
  double offset_;
  std::vector<WedgeSide> planes_;
  std::vector<Vec3> polygon_, room_;
};

// Those beside an edge that the surface is folded inwards at by more than 20 degrees.
std::vector<std::uint8_t> find_folds(const MeshData &data, const std::vector<Vec3> &normals, const std::vector<std::array<std::int32_t, 3>> &neighbours) {
  constexpr double least_sine = 0.342;
  std::vector<std::uint8_t> folds(normals.size());
  for (std::uint32_t t = 0; t < normals.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t other = neighbours[t][k];
      if (other < 0) continue;
      const Vec3 along = normalized(data.vertices[data.triangles[t][(k + 1) % 3]] - data.vertices[data.triangles[t][k]]);
      if (dot(cross(normals[t], normals[static_cast<std::size_t>(other)]), along) < -least_sine) folds[t] = 1;
    }
  }
  return folds;
}

// The nodes of a hierarchy that hold some of the marked triangles.
std::vector<bool> nodes_with(const std::vector<std::uint8_t> &marked, const TriangleHierarchy &hierarchy) {
  const std::vector<TriangleHierarchy::Node> &nodes = hierarchy.nodes();
  std::vector<bool> result(nodes.size());
  for (std::size_t k = nodes.size(); k-- > 0;) {  // children follow their parents
    const TriangleHierarchy::Node &node = nodes[k];
    if (node.count == 0) {
      result[k] = result[node.first] || result[node.first + 1];
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) result[k] = result[k] || marked[hierarchy.order()[i]] != 0;
  }
  return result;
}

}  // namespace

WedgeCuts::WedgeCuts(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
                     const std::vector<std::array<WedgeSide, 3>> &sides, const PlanarFaces &faces, const TriangleHierarchy &hierarchy, double size,
                     std::vector<double> &limits) {
  const double tolerance = rounding * size;
  const std::vector<std::uint8_t> folds = find_folds(data, normals, neighbours);
  first_.assign(data.triangles.size() + 1, 0);
  // What bulges outwards everywhere, or bends slowly, is as thick beside a line down as below it.
  if (std::find(folds.begin(), folds.end(), 1) == folds.end()) return;
  const std::vector<bool> has_folds = nodes_with(folds, hierarchy);
  std::vector<std::pair<double, std::uint32_t>> near;  // by how deep they begin
  for (std::uint32_t t = 0; t < data.triangles.size(); ++t) {
    first_[t] = static_cast<std::uint32_t>(planes_.size());
    double &limit = limits[t];
    if (!std::isfinite(limit)) continue;
    Wedge wedge(data, normals, faces, t, tolerance);
    // Of a narrow column what is below its corners tells enough, but for folds that it passes by.
    constexpr double narrow_part = 0.5;
    const bool narrow = wedge.width() < narrow_part * limit;
    for (std::size_t k = 0; narrow && k < 3; ++k) limit = std::min(limit, 0.5 * wedge.way_out(sides[t], k, hierarchy));
    for (const WedgeSide &side : sides[t]) wedge.keep_before(side.normal, side.offset);
    const PlanarFaces::Roof roof = faces.roof(t);
    for (const std::uint32_t *k = roof.begin; k != roof.end; ++k) wedge.keep_before(faces.plane(*k).normal, faces.plane(*k).offset);
    wedge.end_at(limit);
    near.clear();
    const auto leaves_out = [&](std::uint32_t node) {
      return (narrow && !has_folds[node]) || wedge.leaves_out(hierarchy.nodes()[node].bounds, 1.5 * limit);
    };
    hierarchy.visit_nodes(
        hierarchy.bounds(), [] { return 0.0; }, leaves_out, [&](std::uint32_t other) {
          if (other == t || (narrow && folds[other] == 0)) return;
          const double begin = wedge.begin_of(other);
          if (begin < infinity) near.emplace_back(begin, other);
        });
    std::sort(near.begin(), near.end());
    int cuts = 0;
    for (const auto &candidate : near) {
      const std::uint32_t other = candidate.second;
      const double begin = wedge.begin_of(other);  // within what is left
      WedgeSide plane;
      if (!(begin < infinity) || cuts == most_cuts) continue;
      if (wedge.find_plane(other, plane)) {
        const double clear = wedge.clear_depth(plane, 8.0 * size);
        if (!(clear < infinity)) continue;
        planes_.push_back({plane.normal, plane.offset, faces.face_of(other), clear});
        wedge.keep_before(plane.normal, plane.offset);
        ++cuts;
      } else if (begin > tolerance && begin < limit) {
        limit = begin;
        wedge.end_at(limit);
      }
    }
  }
  first_.back() = static_cast<std::uint32_t>(planes_.size());
}

}  // namespace cmb::mesh
