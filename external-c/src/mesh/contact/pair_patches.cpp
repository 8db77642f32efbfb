#include "mesh/contact/pair_patches.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/core/dual_traversal.hpp"
#include "mesh/core/triangle_wedge.hpp"
#include "mesh/intersection/sheet_crossing.hpp"
#include "mesh/intersection/triangle_crossing.hpp"

namespace cmb::mesh {

namespace {

using Pair = PairScratch::Pair;

class PairSearch {
 public:
  PairSearch(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
             std::vector<Vec3> &polygon, PatchLoad &load)
      : mesh_(mesh), body_(body), place_(place), scratch_(scratch), polygon_(polygon), load_(load),
        rounding_(rounding_of_crossings(mesh, body)) {
    if (scratch.vertices.size() < body.vertices().size()) scratch.vertices.resize(body.vertices().size());
    if (scratch.wedge_of.size() < mesh.triangles().size()) scratch.wedge_of.resize(mesh.triangles().size());
    if (scratch.seen.empty()) grow();
    if (++scratch.query == 0) {  // the counter has wrapped
      for (auto &entry : scratch.seen) entry.query = 0;
      for (auto &entry : scratch.vertices) entry.query = 0;
      for (auto &entry : scratch.wedge_of) entry.query = 0;
      scratch.query = 1;
    }
    scratch.seen_count = 0;
    scratch.wedges.clear();
    scratch.cuts.clear();
  }

  void run() {
    walk_pairs(mesh_.hierarchy(), body_.hierarchy(), place_, [this] { return rounding_ * rounding_; },
               [&](std::uint32_t leaf, std::uint32_t body_leaf) { leaves(leaf, body_leaf); });
  }

 private:
  // Every pair of triangles that cross, and what hangs together with it.
  void leaves(std::uint32_t number, std::uint32_t body_number) {
    const TriangleHierarchy::Node &leaf = mesh_.hierarchy().nodes()[number];
    const TriangleHierarchy::Node &body_leaf = body_.hierarchy().nodes()[body_number];
    const CylinderBound &flat = mesh_.hierarchy().flat_bounds()[number];
    for (std::uint32_t j = body_leaf.first; j < body_leaf.first + body_leaf.count; ++j) {
      const std::uint32_t facet = body_.hierarchy().order()[j];
      const Vec3 corners[3] = {placed(facet, 0), placed(facet, 1), placed(facet, 2)};
      if (!reaches(flat, corners)) continue;
      const Bounds box = bounds_of(corners);
      if (distance2(box, leaf.bounds) > rounding_ * rounding_) continue;
      for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const std::uint32_t t = mesh_.hierarchy().order()[i];
        const double cut = depth_of_cut(t, corners);
        if (!(cut >= -rounding_) || distance2(box_of(t), box) > rounding_ * rounding_) continue;
        scratch_.cuts.push_back({{t, facet}, cut});
        offer({t, facet});
        while (!scratch_.open.empty()) {
          const Pair pair = scratch_.open.back();
          scratch_.open.pop_back();
          look_at(pair);
        }
      }
    }
  }

  // Whether the triangle may come between the two planes of the bound.
  static bool reaches(const CylinderBound &flat, const Vec3 (&corners)[3]) {
    const double first = dot(flat.axis, corners[0] - flat.center), second = dot(flat.axis, corners[1] - flat.center),
                 third = dot(flat.axis, corners[2] - flat.center);
    return std::min({first, second, third}) <= flat.half_thickness &&
           std::max({first, second, third}) >= -flat.half_thickness;
  }

  Bounds box_of(std::uint32_t t) const {
    const Vec3 corners[3] = {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
    return bounds_of(corners);
  }

  // How deep the plane of triangle t cuts into a triangle; negative where that is on one side.
  double depth_of_cut(std::uint32_t t, const Vec3 (&corners)[3]) const {
    const Vec3 &normal = mesh_.face_normal(t);
    const double offset = dot(normal, mesh_.corner(t, 0));
    const double first = dot(normal, corners[0]) - offset, second = dot(normal, corners[1]) - offset,
                 third = dot(normal, corners[2]) - offset;
    return std::min(std::max({first, second, third}), -std::min({first, second, third}));
  }

  void look_at(const Pair &pair) {
    const Vec3 corners[3] = {placed(pair.facet, 0), placed(pair.facet, 1), placed(pair.facet, 2)};
    const TriangleWedge &wedge = wedge_of(pair.triangle);
    if (!wedge.may_meet(corners)) return;
    polygon_.assign(corners, corners + 3);
    if (!load_.push(wedge, place_.rotation * body_.face_normal(pair.facet))) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t t = mesh_.neighbour(pair.triangle, k), facet = body_.neighbour(pair.facet, k);
      if (t >= 0) offer({static_cast<std::uint32_t>(t), pair.facet});
      if (facet >= 0) offer({pair.triangle, static_cast<std::uint32_t>(facet)});
    }
  }

  const Vec3 &placed(std::uint32_t facet, std::size_t k) {
    const std::uint32_t v = body_.triangles()[facet][k];
    PairScratch::PlacedVertex &vertex = scratch_.vertices[v];
    if (vertex.query != scratch_.query) vertex = {place_(body_.vertices()[v]), scratch_.query};
    return vertex.place;
  }

  // Valid until the next call.
  const TriangleWedge &wedge_of(std::uint32_t t) {
    PairScratch::KnownWedge &known = scratch_.wedge_of[t];
    if (known.query != scratch_.query) {
      known = {static_cast<std::uint32_t>(scratch_.wedges.size()), scratch_.query};
      scratch_.wedges.emplace_back(mesh_, t, body_.bound_radius());
    }
    return scratch_.wedges[known.number];
  }

  // Opens a pair, unless it was before.
  void offer(const Pair &pair) {
    if (2 * (scratch_.seen_count + 1) > scratch_.seen.size()) grow();
    PairScratch::SeenPair &slot = scratch_.seen[find(pair)];
    if (slot.query == scratch_.query) return;
    slot = {pair, scratch_.query};
    ++scratch_.seen_count;
    scratch_.open.push_back(pair);
  }

  // Where the pair is, or should be.
  std::size_t find(const Pair &pair) const {
    const std::size_t mask = scratch_.seen.size() - 1;
    const std::uint64_t hash = (std::uint64_t{pair.triangle} << 32 | pair.facet) * 0x9e3779b97f4a7c15ull;
    std::size_t slot = static_cast<std::size_t>(hash >> 32) & mask;
    for (;; slot = (slot + 1) & mask) {
      const PairScratch::SeenPair &entry = scratch_.seen[slot];
      if (entry.query != scratch_.query) return slot;
      if (entry.pair.triangle == pair.triangle && entry.pair.facet == pair.facet) return slot;
    }
  }

  // The table's size is a power of two.
  void grow() {
    std::vector<PairScratch::SeenPair> before(std::max<std::size_t>(1024, 2 * scratch_.seen.size()));
    before.swap(scratch_.seen);
    for (const PairScratch::SeenPair &entry : before) {
      if (entry.query == scratch_.query) scratch_.seen[find(entry.pair)] = entry;
    }
  }

  const TriangleMesh &mesh_, &body_;
  const Pose &place_;
  PairScratch &scratch_;
  std::vector<Vec3> &polygon_;
  PatchLoad &load_;
  double rounding_;  // m: what is as far apart may cross
};

}  // namespace

double rounding_of_crossings(const TriangleMesh &a, const TriangleMesh &b) {
  return 1e-15 * (a.bound_radius() + b.bound_radius());
}

void push_pair_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
                       PatchScratch &patch_scratch, PatchLoad &load) {
  PairSearch(mesh, body, place, scratch, patch_scratch.polygon, load).run();
}

namespace {

TriangleSection crossing_of(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Pair &pair,
                            double enough) {
  const Vec3 own[3] = {mesh.corner(pair.triangle, 0), mesh.corner(pair.triangle, 1), mesh.corner(pair.triangle, 2)};
  const Vec3 facet[3] = {place(body.corner(pair.facet, 0)), place(body.corner(pair.facet, 1)),
                         place(body.corner(pair.facet, 2))};
  return triangle_crossing(own, mesh.face_normal(pair.triangle), facet, place.rotation * body.face_normal(pair.facet),
                           enough);
}

}  // namespace

double deepest_crossing(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                        double enough) {
  double deepest = 0.0;
  for (const PairScratch::Cut &cut : scratch.cuts) {
    const double known = std::fmax(enough, deepest);
    if (cut.depth > known) deepest = std::fmax(deepest, crossing_of(mesh, body, place, cut.pair, known).depth);
  }
  return deepest;
}

namespace {

// How far the mesh's box reaches behind the plane through `place`, in the mesh's frame.
double behind(const TriangleMesh &mesh, const Vec3 &normal, const Vec3 &place) {
  const Bounds &box = mesh.hierarchy().bounds();
  double least = 0.0;
  for (int k = 0; k < 3; ++k) least += std::fmin(normal[k] * (box.low[k] - place[k]), normal[k] * (box.high[k] - place[k]));
  return -least;
}

double area_of(const TriangleMesh &mesh, std::uint32_t t) {
  return 0.5 * norm(cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0)));
}

}  // namespace

void push_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                    PiercedLoad &load) {
  const Pose back = place.inverse();
  for (const PairScratch::Cut &cut : scratch.cuts) {
    const TriangleSection crossing = crossing_of(mesh, body, place, cut.pair, 0.0);
    if (!(crossing.depth > 0.0)) continue;
    const std::uint32_t t = cut.pair.triangle;
    const Vec3 &n = mesh.face_normal(t);
    load.add(crossing, n, behind(body, back.rotation * n, back(mesh.corner(t, 0))), area_of(mesh, t));
  }
}

double depths_of_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                           double negligible, double enough) {
  double sum = 0.0;
  for (const PairScratch::Cut &cut : scratch.cuts) {
    sum += sheet_crossing(mesh, cut.pair.triangle, body, cut.pair.facet, place, negligible).depth;
    if (sum > enough) break;
  }
  return sum;
}

void push_sheet_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place,
                          const PairScratch &scratch, double enough, PiercedLoad &load, PiercedLoad &reaction) {
  const Pose back = place.inverse();
  for (const PairScratch::Cut &cut : scratch.cuts) {
    const std::uint32_t t = cut.pair.triangle, facet = cut.pair.facet;
    const TriangleSection crossing = sheet_crossing(mesh, t, body, facet, place, enough);
    if (!(crossing.depth > 0.0)) continue;
    const Vec3 &n = mesh.face_normal(t), &m = body.face_normal(facet);
    load.add(crossing, n, behind(body, back.rotation * n, back(mesh.corner(t, 0))), area_of(mesh, t));
    reaction.add({crossing.depth, back(crossing.place)}, m, behind(mesh, place.rotation * m, place(body.corner(facet, 0))),
                 area_of(body, facet));
  }
}

}  // namespace cmb::mesh
