#include "mesh/elastic/pair_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/elastic/depth_powers.hpp"

namespace cmb::mesh {

namespace {

// As steep as this, lines upright on the triangle run in the plane as far as its contents are known.
constexpr double least_slope = 1e-12;
// Terms that cancel to this part of their size cancel.
constexpr double rounding_of_sums = 1e-14;
// By the body's radius: what facets and their boxes are widened by, more than planes are moved aside.
constexpr double rounding = 1e-12;

// The greatest direction . x in a box.
double reach(const Bounds &box, const Vec3 &direction) {
  double most = 0.0;
  for (int k = 0; k < 3; ++k) most += direction[k] * (direction[k] > 0.0 ? box.high[k] : box.low[k]);
  return most;
}

}  // namespace

// How far the body reaches at most along a direction in its own frame.
double PairOverlap::reach(const Vec3 &direction) const {
  return std::fmin(mesh::reach(body_.hierarchy().bounds(), direction),
                   dot(body_.bound_center(), direction) + body_.bound_radius() * norm(direction));
}

void PairOverlap::add_all() {
  const Bounds box = moved(body_.hierarchy().bounds(), place_);
  const auto farthest = [&](const Vec3 &direction) {
    const Vec3 local = transposed_times(place_.rotation, direction);
    return center_ + ((reach(local) - dot(body_.bound_center(), local)) / norm2(local)) * direction;
  };
  mesh().visit_wedges(box, 0.5 * norm(box.high - box.low), farthest, [&](std::uint32_t t) {
    visit_regions(mesh(), t, [this](const WedgeRegion &region) { add(region); });
  });
}

void PairOverlap::add(const WedgeRegion &region) {
  look_at(region);
  const auto support = [this](const Vec3 &direction) { return reach(direction); };
  if (is_out_of_reach(center_) || is_outside(place_, support)) return;
  if (!(depth(place_.translation) - support(transposed_times(place_.rotation, face_normal())) < mesh().depth_limit(triangle()))) return;
  // Behind a sheet nothing ends, and most of what is there meets.
  if (mesh().closed() && !meets_surface() && !may_fill()) return;
  const bool meets = gather();
  if (scratch_.facets.empty()) return;
  set_planes();
  if (!meets && !is_filled()) return;
  patch_ = {};
  begin(vertices_.corner(scratch_.facets[0], 0));
  Powers inside, below;
  double size_below = 0.0;
  measure();
  bool in_wedge = false;
  deepest_inside_ = 0.0;
  for (std::size_t number = 0; number < scratch_.facets.size(); ++number) in_wedge = add_inside(number, inside) || in_wedge;
  if (meets && !in_wedge && !is_filled()) return;
  if (in_wedge) end_below_surface();
  for (std::size_t number = 0; number < scratch_.facets.size(); ++number) add_below(number, below, size_below);
  // What passes by below all that counts leaves nothing.
  if (std::fabs(below.second) > rounding_of_sums * size_below) inside.add(1.0, below);
  part().second.integral += inside.second, part().fourth.integral += inside.fourth;
  add_patch(patch_, patch_.load > 0.0 ? origin() + (1.0 / patch_.load) * patch_.moment : center_);
}

namespace {

// Half-spaces that hold what is looked for: normal . x >= offset.
template <std::size_t count>
struct HalfSpaces {
  Vec3 normal[count];
  double offset[count];

  HalfSpaces seen_from(const Pose &place) const {
    HalfSpaces own;
    for (std::size_t k = 0; k < count; ++k) {
      own.normal[k] = transposed_times(place.rotation, normal[k]);
      own.offset[k] = offset[k] - dot(normal[k], place.translation);
    }
    return own;
  }
  // Whether one of them holds nothing of the box, moved outwards by `slack`.
  bool leave_out(const Bounds &box, double slack) const {
    for (std::size_t k = 0; k < count; ++k) {
      if (reach(box, normal[k]) < offset[k] - slack) return true;
    }
    return false;
  }
  bool leave_out(const Vec3 &p, const Vec3 &q, const Vec3 &r, double slack) const {
    for (std::size_t k = 0; k < count; ++k) {
      const double least = offset[k] - slack;
      if (dot(normal[k], p) < least && dot(normal[k], q) < least && dot(normal[k], r) < least) return true;
    }
    return false;
  }
};

// What holds the region but for what parts it from other sides of the mesh.
HalfSpaces<5> around_region(const TriangleMesh &mesh, const WedgeRegion &region) {
  const std::uint32_t t = region.triangle();
  const Vec3 &normal = mesh.face_normal(t);
  const double front = dot(normal, mesh.corner(t, 0));
  HalfSpaces<5> wedge{{-normal, normal, {}, {}, {}}, {-front, front - mesh.depth_limit(t), 0.0, 0.0, 0.0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const WedgeSide &side = region.sides()[k];
    wedge.normal[k + 2] = side.normal, wedge.offset[k + 2] = side.offset;
  }
  return wedge;
}

}  // namespace

// Whether some of the body's surface may be in the wedge.
bool PairOverlap::meets_surface() const {
  const HalfSpaces<5> wedge = around_region(mesh(), region()), own = wedge.seen_from(place_);
  const TriangleHierarchy &hierarchy = body_.hierarchy();
  const double slack = rounding * radius();
  bool meets = false;
  hierarchy.visit_near_unless(
      hierarchy.bounds(), [&meets] { return meets ? -1.0 : 0.0; }, [&](const Bounds &box) { return own.leave_out(box, slack); },
      [&](std::uint32_t facet) {
        if (meets || !counts(facet)) return;
        meets = !wedge.leave_out(vertices_.corner(facet, 0), vertices_.corner(facet, 1), vertices_.corner(facet, 2), slack);
      });
  return meets;
}

// Where none of the body's surface is in the wedge: false where the triangle's middle is well outside of the body, so that all of the wedge is.
bool PairOverlap::may_fill() {
  constexpr double slack = 1e-9;
  const Vec3 middle = region().middle();
  const Vec3 in_body = transposed_times(place_.rotation, middle - place_.translation);
  const Bounds point{in_body, in_body};
  if (distance2(body_.hierarchy().bounds(), point) > 0.0) return false;
  if (components_ != nullptr && body_.component_count() > 1) return true;
  const NearestPoint nearest = body_.nearest(in_body, nearest_facet_);
  nearest_facet_ = nearest.triangle;
  return nearest.distance < slack * radius();
}

// The facets that are in the wedge or may be below it. Returns whether some may be in it.
bool PairOverlap::gather() {
  const double front = dot(face_normal(), mesh().corner(triangle(), 0));
  const HalfSpaces<5> wedge = around_region(mesh(), region());
  // Behind a convex side the wedge becomes narrower: what is below it is behind the side's own plane.
  HalfSpaces<4> column{{-face_normal(), {}, {}, {}}, {-front, 0.0, 0.0, 0.0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const WedgeSide &side = region().sides()[k];
    const double slope = dot(side.normal, face_normal());
    column.normal[k + 1] = slope > 0.0 ? side.normal - slope * face_normal() : side.normal;
    column.offset[k + 1] = slope > 0.0 ? dot(column.normal[k + 1], region().place_on_side(k)) : side.offset;
  }
  scratch_.facets.clear();
  deepest_corner_ = 0.0;
  bool meets = false;
  const HalfSpaces<4> own = column.seen_from(place_);
  const TriangleHierarchy &hierarchy = body_.hierarchy();
  const double slack = rounding * radius();
  hierarchy.visit_near_unless(
      hierarchy.bounds(), [] { return 0.0; }, [&](const Bounds &box) { return own.leave_out(box, slack); },
      [&](std::uint32_t facet) {
        if (!counts(facet)) return;
        const Vec3 &p = vertices_.corner(facet, 0), &q = vertices_.corner(facet, 1), &r = vertices_.corner(facet, 2);
        if (column.leave_out(p, q, r, slack)) return;
        meets = meets || !wedge.leave_out(p, q, r, slack);
        deepest_corner_ = std::max({deepest_corner_, depth(p), depth(q), depth(r)});
        scratch_.facets.push_back(facet);
      });
  return meets;
}

// Whether a place in the wedge is in the body, where none of its surface is near. Of the facets, those that the line down from there meets
// tell; facets that share a side agree on which of them it meets.
bool PairOverlap::holds(const Vec3 &middle) const {
  const Vec3 along = normalized(mesh().corner(triangle(), 1) - mesh().corner(triangle(), 0), {1, 0, 0}), across = cross(face_normal(), along);
  const double beside = dot(across, middle), begin = dot(along, middle);
  bool inside = false;
  for (const std::uint32_t facet : scratch_.facets) {
    bool between = false;
    for (std::size_t k = 0; k < 3; ++k) {
      // Both facets reckon from the same corner.
      std::uint32_t from = body_.triangles()[facet][k], to = body_.triangles()[facet][(k + 1) % 3];
      if (to < from) std::swap(from, to);
      const Vec3 &p = vertices_[from], &q = vertices_[to];
      const double p_above = dot(across, p) - beside, q_above = dot(across, q) - beside;
      if ((p_above > 0.0) == (q_above > 0.0)) continue;
      const Vec3 place = p + (p_above / (p_above - q_above)) * (q - p);
      if (dot(along, place) > begin) between = !between;
    }
    if (!between) continue;
    const Vec3 normal = place_.rotation * body_.face_normal(facet);
    if (dot(normal, middle - vertices_.corner(facet, 0)) / dot(normal, face_normal()) > 0.0) inside = !inside;
  }
  return inside;
}

void PairOverlap::set_planes() {
  // They change places with each cut: neither would have grown for good.
  constexpr std::size_t enough_corners = 64;
  scratch_.polygon.reserve(enough_corners), scratch_.kept.reserve(enough_corners);
  scratch_.planes.clear();
  region().visit_planes(deepest_corner_, [&](const WedgePlane &in_mesh) {
    const WedgePlane plane = moved_aside(in_mesh);
    for (const Plane &other : scratch_.planes) {
      if (coincide(plane, other, radius())) return true;
    }
    scratch_.planes.push_back({plane, dot(plane.normal, face_normal()), 0.0});
    return true;
  });
}

// A place of the wedge so deep below the triangle, not at its border; false where there is none.
bool PairOverlap::find_place(double level, Vec3 &place) {
  const double size = 4.0 * (radius() + mesh().bound_radius());
  const Vec3 along = convex::any_perpendicular(face_normal()), across = cross(face_normal(), along);
  const Vec3 middle = center_ + (depth(center_) - level) * face_normal();
  scratch_.polygon = {middle + size * along, middle + size * across, middle - size * along, middle - size * across};
  for (const Plane &plane : scratch_.planes) {
    if (!keep_where([&](const Vec3 &p) { return dot(plane.normal, p) - plane.offset; })) return false;
  }
  Vec3 sum;
  for (const Vec3 &p : scratch_.polygon) sum = sum + p;
  place = (1.0 / static_cast<double>(scratch_.polygon.size())) * sum;
  return true;
}

// Where none of the body's surface is in the wedge: whether the body is. Asked behind the triangle, as a side of the body may lie in its plane.
bool PairOverlap::is_filled() {
  const double limit = std::fmin(mesh().depth_limit(triangle()), deepest_corner_);
  Vec3 place;
  for (const double part : {0.3, 0.03, 0.003}) {
    if (find_place(part * limit, place)) return holds(place);
  }
  return false;
}

// Where the body is not what is behind its deepest surface in the wedge, nothing counts there: what passes by below would cancel to rounding of
// its depth.
void PairOverlap::end_below_surface() {
  const double limit = std::fmin(mesh().depth_limit(triangle()), deepest_corner_), front = dot(face_normal(), mesh().corner(triangle(), 0));
  if (!(deepest_inside_ < (1.0 - 1e-6) * limit)) return;
  for (const double deeper : {1.5, 1.001}) {
    const double level = std::fmin(deeper * deepest_inside_, 0.5 * (deepest_inside_ + limit));
    Vec3 place;
    if (!find_place(level, place)) continue;
    if (holds(place)) return;
    const double end = std::fmin(1.001 * deepest_inside_, level);
    // A little below: what lies at that depth has been counted as in the wedge.
    scratch_.planes.push_back({{face_normal(), front - end, false}, 1.0, end});
    measure();
    return;
  }
}

namespace {

// What lies in the plane is beyond it where the plane is strict. Of two wedges that share a plane one counts it.
bool within(double above, const WedgePlane &plane) { return plane.strict ? above > 0.0 : above >= 0.0; }

// Of three corners.
int count_within(const double *above, const WedgePlane &plane) {
  return (within(above[0], plane) ? 1 : 0) + (within(above[1], plane) ? 1 : 0) + (within(above[2], plane) ? 1 : 0);
}

}  // namespace

// Of the corners of all facets: how deep they are, and how far above the planes.
void PairOverlap::measure() {
  const std::size_t planes = scratch_.planes.size();
  scratch_.deep.resize(3 * scratch_.facets.size());
  scratch_.above.resize(3 * planes * scratch_.facets.size());
  double *deep = scratch_.deep.data(), *above = scratch_.above.data();
  for (const std::uint32_t facet : scratch_.facets) {
    const Vec3 *const corners[3] = {&vertices_.corner(facet, 0), &vertices_.corner(facet, 1), &vertices_.corner(facet, 2)};
    for (const Vec3 *corner : corners) *deep++ = depth(*corner);
    for (const Plane &plane : scratch_.planes) {
      for (const Vec3 *corner : corners) *above++ = dot(plane.normal, *corner) - plane.offset;
    }
  }
}

// What of the facet is in the wedge; takes it on as surface, too. Returns whether something is.
bool PairOverlap::add_inside(std::size_t number, Powers &sum) {
  const std::size_t planes = scratch_.planes.size();
  const double *const deep = scratch_.deep.data() + 3 * number, *const above = scratch_.above.data() + 3 * planes * number;
  if (!(deep[0] > 0.0) && !(deep[1] > 0.0) && !(deep[2] > 0.0)) return false;
  for (std::size_t i = 0; i < planes; ++i) {
    if (count_within(above + 3 * i, scratch_.planes[i]) == 0) return false;
  }
  const std::uint32_t facet = scratch_.facets[number];
  start_with(facet);
  for (std::size_t i = 0; i < planes; ++i) {
    const Plane &plane = scratch_.planes[i];
    if (count_within(above + 3 * i, plane) < 3 && !keep(plane, true)) return false;
  }
  if ((deep[0] < 0.0 || deep[1] < 0.0 || deep[2] < 0.0) && !keep_where([this](const Vec3 &p) { return depth(p); })) return false;
  for (const Vec3 &p : scratch_.polygon) deepest_inside_ = std::fmax(deepest_inside_, depth(p));
  add_surface(scratch_.polygon.data(), scratch_.polygon.size(), place_.rotation * body_.face_normal(facet), patch_);
  sum.add(1.0, powers());
  return true;
}

// What of the facet is below the wedge, and, while the wedge begins behind the triangle, what of it is in the wedge: by where the lines up
// from there meet the wedge's planes. `size`: of the terms of s, which may cancel.
void PairOverlap::add_below(std::size_t number, Powers &sum, double &size) {
  const std::size_t planes = scratch_.planes.size();
  const double *const deep = scratch_.deep.data() + 3 * number, *const above = scratch_.above.data() + 3 * planes * number;
  for (std::size_t i = 0; i < planes; ++i) {
    const Plane &plane = scratch_.planes[i];
    if (!(std::fabs(plane.slope) > least_slope)) continue;
    const bool wanted = plane.slope < 0.0;
    const int count = count_within(above + 3 * i, plane);
    if (count == (wanted ? 0 : 3)) continue;
    // How deep the line up from a corner meets the plane.
    double depth_there[3];
    int behind = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      depth_there[k] = deep[k] + above[3 * i + k] / plane.slope;
      behind += depth_there[k] > 0.0 ? 1 : 0;
    }
    if (behind == 0) continue;
    scratch_.cutting.clear();
    bool meets = true;
    for (std::size_t j = 0; j < planes && meets; ++j) {
      if (j == i) continue;
      const double slope = scratch_.planes[j].slope / plane.slope;
      int beyond = 0;
      for (std::size_t k = 0; k < 3; ++k) beyond += above[3 * j + k] - slope * above[3 * i + k] < 0.0 ? 1 : 0;
      meets = beyond < 3;
      if (beyond > 0) scratch_.cutting.push_back(j);
    }
    if (!meets) continue;
    start_with(scratch_.facets[number]);
    if (count > 0 && count < 3 && !keep(plane, wanted)) continue;
    const auto up = [&](const Vec3 &p) { return (plane.offset - dot(plane.normal, p)) / plane.slope; };
    if (behind < 3 && !keep_where([&](const Vec3 &p) { return depth(p) - up(p); })) continue;
    for (Vec3 &p : scratch_.polygon) p = p + up(p) * face_normal();
    for (const std::size_t j : scratch_.cutting) {
      const Plane &other = scratch_.planes[j];
      meets = meets && keep_where([&](const Vec3 &p) { return dot(other.normal, p) - other.offset; });
    }
    if (!meets) continue;
    const Powers there = plane.level > 0.0 ? powers_at(plane.level) : powers();
    sum.add(wanted ? -1.0 : 1.0, there);
    size += std::fabs(there.second);
  }
}

void PairOverlap::start_with(std::uint32_t facet) {
  scratch_.polygon.clear();
  for (std::size_t k = 0; k < 3; ++k) scratch_.polygon.push_back(vertices_.corner(facet, k));
}

// Keeps the part of the polygon that is within the plane, or that is not; false where that is nothing.
bool PairOverlap::keep(const Plane &plane, bool wanted) {
  std::size_t count = 0;
  for (const Vec3 &p : scratch_.polygon) count += within(dot(plane.normal, p) - plane.offset, plane) == wanted ? 1 : 0;
  if (count == 0 || count == scratch_.polygon.size()) return count > 0;
  const double sign = wanted ? 1.0 : -1.0;
  return keep_where([&](const Vec3 &p) { return sign * (dot(plane.normal, p) - plane.offset); });
}

// Keeps the part of the polygon where above(p), which is linear, is not negative; false where that is nothing.
template <typename Above>
bool PairOverlap::keep_where(Above &&above) {
  const std::vector<Vec3> &polygon = scratch_.polygon;
  std::vector<Vec3> &kept = scratch_.kept;
  kept.resize(2 * polygon.size());
  std::size_t count = 0;
  const Vec3 *p = &polygon.back();
  double above_p = above(*p);
  for (const Vec3 &q : polygon) {
    const double above_q = above(q);
    // From the corner that is kept, as in the facet beyond the side.
    if (above_p >= 0.0 && above_q < 0.0) kept[count++] = *p + (above_p / (above_p - above_q)) * (q - *p);
    if (above_p < 0.0 && above_q >= 0.0) kept[count++] = q + (above_q / (above_q - above_p)) * (*p - q);
    if (above_q >= 0.0) kept[count++] = q;
    above_p = above_q;
    p = &q;
  }
  if (count < 3) return false;
  kept.resize(count);
  scratch_.polygon.swap(kept);
  return true;
}

// Of the polygon, which lies so deep below the triangle.
PairOverlap::Powers PairOverlap::powers_at(double level) const {
  const std::vector<Vec3> &polygon = scratch_.polygon;
  double area = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    area -= 0.5 * dot(face_normal(), cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  }
  const double square = level * level;
  return {square * area, square * square * area};
}

// Of the polygon.
PairOverlap::Powers PairOverlap::powers() const {
  Powers powers;
  const std::vector<Vec3> &polygon = scratch_.polygon;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double area = -0.5 * dot(face_normal(), cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    const double a = std::fmax(0.0, depth(polygon[0])), b = std::fmax(0.0, depth(polygon[i - 1])), c = std::fmax(0.0, depth(polygon[i]));
    const ProductsOfDepths products(a, b, c);
    powers.second += area / 6.0 * products.of_two;
    powers.fourth += area / 15.0 * products.of_four();
  }
  return powers;
}

}  // namespace cmb::mesh
