#include "mesh/elastic/wedge_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/elastic/depth_powers.hpp"

namespace cmb::mesh {

namespace {

using Plane = OverlapScratch::Plane;

// What lies in the plane is beyond it where the plane is strict. Of two wedges that share a plane one counts it.
bool within(double above, const Plane &plane) { return plane.strict ? above > 0.0 : above >= 0.0; }

// Writes to `kept`, which has room for two corners more than the polygon, its part before the plane, of at least three corners or
// nothing, and moves `kept` behind it. Returns whether a side was cut off;
// then it runs from `from` to `to` in the polygon that is left. Faces that share a side cut it at the same place to the bit: caps
// have no gaps, also where the body's corners lie in the plane.
bool cut(const Vec3 *polygon, std::size_t count, const Plane &plane, double *above, Vec3 *&kept, Vec3 &from, Vec3 &to) {
  std::size_t inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    above[i] = dot(plane.normal, polygon[i]) - plane.offset;
    inside += within(above[i], plane) ? 1 : 0;
  }
  if (inside == 0) return false;
  if (inside == count) {
    kept = std::copy(polygon, polygon + count, kept);
    return false;
  }
  Vec3 *const begin = kept;
  bool leaves = false, enters = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = i + 1 == count ? 0 : i + 1;
    const Vec3 &p = polygon[i], &q = polygon[next];
    const bool p_within = within(above[i], plane), q_within = within(above[next], plane);
    if (p_within) *kept++ = p;
    if (p_within && !q_within) {
      from = p + (above[i] / (above[i] - above[next])) * (q - p);
      *kept++ = from;
      leaves = true;
    } else if (!p_within && q_within) {
      to = q + (above[next] / (above[next] - above[i])) * (p - q);
      *kept++ = to;
      enters = true;
    }
  }
  if (kept < begin + 3) kept = begin;
  return leaves && enters;
}

bool same(const Vec3 &p, const Vec3 &q) { return p.x == q.x && p.y == q.y && p.z == q.z; }

}  // namespace

// Takes the plane on where it cuts the body, and marks the vertices outside; false where all are.
bool WedgeOverlap::offer(const Plane &plane) {
  std::vector<Plane> &planes = scratch_.planes;
  const std::uint64_t bit = planes.size() < 64 ? std::uint64_t{1} << planes.size() : 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const bool is_outside = !within(dot(plane.normal, vertices_[v]) - plane.offset, plane);  // unpredictable: no branch
    scratch_.outside[v] |= is_outside ? bit : 0;
    count += is_outside ? 1 : 0;
  }
  if (count == vertices_.size()) return false;
  if (count > 0) planes.push_back(plane);
  return true;
}

// The planes that cut the body; false where nothing of it is left. The triangle's own comes first.
bool WedgeOverlap::set_planes(const WedgeRegion &region) {
  look_at(region);
  const auto support = [&](const Vec3 &d) { return dot(d, body_.vertices()[static_cast<std::size_t>(body_.support_vertex(d))]); };
  if (is_out_of_reach(center_) || is_outside(place_, support)) return false;
  scratch_.depths.clear();
  const double limit = mesh().depth_limit(triangle());
  double deepest = 0.0, shallowest = limit;
  for (const Vec3 &v : vertices_) {
    const double deep = depth(v);
    deepest = deep > deepest ? deep : deepest;
    shallowest = deep < shallowest ? deep : shallowest;
    scratch_.depths.push_back(deep);
  }
  if (!(deepest > 0.0) || !(shallowest < limit)) return false;
  const bool front = shallowest < 0.0;
  scratch_.planes.clear();
  scratch_.outside.assign(vertices_.size(), 0);
  front_ = front ? 1 : 0;
  if (front) {
    scratch_.planes.push_back({{-face_normal(), -dot(face_normal(), mesh().corner(triangle(), 0)), false}, false});
    for (std::size_t v = 0; v < vertices_.size(); ++v) scratch_.outside[v] = scratch_.depths[v] < 0.0 ? 1 : 0;
  }
  return region.visit_planes(deepest, [&](const WedgePlane &in_mesh) {
    const WedgePlane plane = moved_aside(in_mesh);
    if (dot(plane.normal, center_) - plane.offset >= radius()) return true;
    for (const Plane &other : scratch_.planes) {
      if (coincide(plane, other, radius())) return true;
    }
    return offer({plane, true});
  });
}

void WedgeOverlap::add(const WedgeRegion &region) {
  if (!set_planes(region)) return;
  patch_ = {};
  const std::vector<std::int32_t> &corners = body_.face_vertices();
  scratch_.points.clear();
  scratch_.pieces.clear();
  const std::uint64_t front = front_;
  for (std::size_t f = 0; f < normals_.size(); ++f) {
    const convex::Polytope::Face &face = body_.faces()[f];
    std::uint64_t everywhere = ~std::uint64_t{0}, anywhere = 0;
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      const std::uint64_t code = scratch_.outside[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
      everywhere &= code;
      anywhere |= code;
    }
    // Beyond a plane nothing counts, unless a plane before it has cut sides of a cap from the face.
    const std::uint64_t beyond = everywhere & (~everywhere + 1);
    if (beyond != 0 && (anywhere & (beyond - 1) & ~front) == 0) continue;
    const std::size_t first = scratch_.points.size();
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      scratch_.points.push_back(vertices_[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])]);
    }
    scratch_.pieces.push_back({first, static_cast<std::size_t>(face.count), normals_[f], true});
  }
  for (const Plane &plane : scratch_.planes) {
    if (scratch_.pieces.empty()) return;
    keep_before(plane);
  }
  if (scratch_.pieces.empty()) return;
  const Vec3 &place = scratch_.points[scratch_.pieces[0].first];
  apex_ = place + depth(place) * face_normal();
  begin(place);
  for (const OverlapScratch::Piece &piece : scratch_.pieces) integrate(piece);
  add_patch(patch_, patch_.load > 0.0 ? origin() + (1.0 / patch_.load) * patch_.moment : center_);
}

// Cuts all pieces; where the plane is capped, adds the cap as triangles from that corner of it which is least deep. Where the
// cap reaches up to the triangle's plane, whose own cap is not known, this one lies there.
void WedgeOverlap::keep_before(const Plane &plane) {
  std::vector<Vec3> &kept = scratch_.kept;
  std::size_t most = 0, longest = 0;
  for (const OverlapScratch::Piece &piece : scratch_.pieces) {
    most += piece.count + 2;
    longest = std::max(longest, piece.count);
  }
  if (kept.size() < most) kept.resize(most);
  if (scratch_.above.size() < longest) scratch_.above.resize(longest);
  scratch_.edges.clear();
  std::size_t pieces = 0;
  Vec3 *const begin = kept.data(), *end = begin;
  for (const OverlapScratch::Piece &piece : scratch_.pieces) {
    const Vec3 *const first = end;
    Vec3 from, to;
    const bool was_cut = cut(scratch_.points.data() + piece.first, piece.count, plane, scratch_.above.data(), end, from, to);
    if (was_cut && plane.capped) scratch_.edges.push_back({to, from});
    if (end > first) {
      scratch_.pieces[pieces++] = {static_cast<std::size_t>(first - begin), static_cast<std::size_t>(end - first), piece.normal, piece.of_body};
    }
  }
  kept.resize(static_cast<std::size_t>(end - begin));
  scratch_.pieces.resize(pieces);
  const Vec3 *fan = nullptr;
  for (const OverlapScratch::Edge &edge : scratch_.edges) {
    if (fan == nullptr || depth(edge.from) < depth(*fan)) fan = &edge.from;
    if (depth(edge.to) < depth(*fan)) fan = &edge.to;
  }
  for (const OverlapScratch::Edge &edge : scratch_.edges) {
    if (same(edge.from, *fan) || same(edge.to, *fan)) continue;
    const std::size_t first = kept.size();
    kept.insert(kept.end(), {*fan, edge.from, edge.to});
    scratch_.pieces.push_back({first, 3, -plane.normal, false});
  }
  scratch_.points.swap(kept);
}

// Of a cap.
WedgeIntegrals::PolygonSums WedgeOverlap::sums_of(const Vec3 *polygon, std::size_t count, const Vec3 &normal) const {
  PolygonSums sums;
  const double dp = depth_behind(polygon[0]);
  double dq = depth_behind(polygon[1]);
  for (std::size_t i = 2; i < count; ++i) {
    const double dr = depth_behind(polygon[i]);
    const double size = 0.5 * dot(normal, cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    const ProductsOfDepths products(dp, dq, dr);
    sums.depths += size / 3.0 * products.of_one;
    sums.cubes += size / 10.0 * products.of_three;
    dq = dr;
  }
  return sums;
}

void WedgeOverlap::integrate(const OverlapScratch::Piece &piece) {
  const Vec3 *const polygon = scratch_.points.data() + piece.first;
  const PolygonSums sums = piece.of_body ? add_surface(polygon, piece.count, piece.normal, patch_) : sums_of(polygon, piece.count, piece.normal);
  const double height = dot(piece.normal, polygon[0] - apex_);
  part().second.integral += 0.5 * height * sums.depths;
  part().fourth.integral += 2.0 / 3.0 * height * sums.cubes;
}

}  // namespace cmb::mesh
