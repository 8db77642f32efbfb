#include "mesh/pair_patches.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/pair_walk.hpp"
#include "mesh/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

using Pair = PairScratch::Pair;

class PairSearch {
 public:
  PairSearch(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
             std::vector<Vec3> &polygon, PatchLoad &load)
      : mesh_(mesh), body_(body), place_(place), scratch_(scratch), polygon_(polygon), load_(load) {
    if (scratch.placed_in.size() < body.vertices().size()) {
      scratch.placed_in.resize(body.vertices().size(), 0);
      scratch.places.resize(body.vertices().size());
    }
    if (scratch.seen.empty()) grow();
    if (++scratch.query == 0) {  // the counter has wrapped
      std::fill(scratch.placed_in.begin(), scratch.placed_in.end(), 0);
      std::fill(scratch.seen_in.begin(), scratch.seen_in.end(), 0);
      scratch.query = 1;
    }
    scratch.seen_count = 0;
  }

  void run() {
    walk_pairs(mesh_.hierarchy(), body_.hierarchy(), place_, [] { return 0.0; },
               [&](const TriangleHierarchy::Node &leaf, const TriangleHierarchy::Node &body_leaf) {
                 leaves(leaf, body_leaf);
               });
  }

 private:
  // Every pair of triangles that cross, and what hangs together with it.
  void leaves(const TriangleHierarchy::Node &leaf, const TriangleHierarchy::Node &body_leaf) {
    Bounds boxes[TriangleHierarchy::leaf_size];
    bool measured = false;
    for (std::uint32_t j = body_leaf.first; j < body_leaf.first + body_leaf.count; ++j) {
      const std::uint32_t facet = body_.hierarchy().order()[j];
      const Vec3 corners[3] = {placed(facet, 0), placed(facet, 1), placed(facet, 2)};
      const Bounds box = bounds_of(corners);
      if (distance2(box, leaf.bounds) > 0.0) continue;
      if (!measured) measure(leaf, boxes);
      measured = true;
      for (std::uint32_t i = 0; i < leaf.count; ++i) {
        const std::uint32_t t = mesh_.hierarchy().order()[leaf.first + i];
        if (distance2(boxes[i], box) > 0.0 || !cuts(t, corners)) continue;
        offer({t, facet});
        while (!scratch_.open.empty()) {
          const Pair pair = scratch_.open.back();
          scratch_.open.pop_back();
          look_at(pair);
        }
      }
    }
  }

  void measure(const TriangleHierarchy::Node &leaf, Bounds *boxes) const {
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      const std::uint32_t t = mesh_.hierarchy().order()[leaf.first + i];
      const Vec3 corners[3] = {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
      boxes[i] = bounds_of(corners);
    }
  }

  // Whether the plane of triangle t has corners on both sides, or on it.
  bool cuts(std::uint32_t t, const Vec3 (&corners)[3]) const {
    const Vec3 &normal = mesh_.face_normal(t);
    const double offset = dot(normal, mesh_.corner(t, 0));
    const double first = dot(normal, corners[0]) - offset, second = dot(normal, corners[1]) - offset,
                 third = dot(normal, corners[2]) - offset;
    return std::min({first, second, third}) <= 0.0 && std::max({first, second, third}) >= 0.0;
  }

  void look_at(const Pair &pair) {
    const Vec3 corners[3] = {placed(pair.facet, 0), placed(pair.facet, 1), placed(pair.facet, 2)};
    TriangleWedge wedge;
    if (!wedge.build_if_it_meets(mesh_, pair.triangle, body_.bound_radius(), corners)) return;
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
    if (scratch_.placed_in[v] != scratch_.query) {
      scratch_.placed_in[v] = scratch_.query;
      scratch_.places[v] = place_(body_.vertices()[v]);
    }
    return scratch_.places[v];
  }

  // Opens a pair, unless it was before.
  void offer(const Pair &pair) {
    if (2 * (scratch_.seen_count + 1) > scratch_.seen.size()) grow();
    const std::size_t slot = find(pair);
    if (scratch_.seen_in[slot] == scratch_.query) return;
    scratch_.seen_in[slot] = scratch_.query;
    scratch_.seen[slot] = pair;
    ++scratch_.seen_count;
    scratch_.open.push_back(pair);
  }

  // Where the pair is, or should be.
  std::size_t find(const Pair &pair) const {
    const std::size_t mask = scratch_.seen.size() - 1;
    std::uint64_t hash = (std::uint64_t{pair.triangle} << 32 | pair.facet) * 0x9e3779b97f4a7c15ull;
    std::size_t slot = static_cast<std::size_t>(hash >> 32) & mask;
    while (scratch_.seen_in[slot] == scratch_.query &&
           (scratch_.seen[slot].triangle != pair.triangle || scratch_.seen[slot].facet != pair.facet)) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  // The table's size is a power of two.
  void grow() {
    std::vector<Pair> pairs(std::max<std::size_t>(1024, 2 * scratch_.seen.size()));
    std::vector<std::uint32_t> in(pairs.size(), 0);
    pairs.swap(scratch_.seen);
    in.swap(scratch_.seen_in);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (in[i] != scratch_.query || scratch_.query == 0) continue;
      const std::size_t slot = find(pairs[i]);
      scratch_.seen_in[slot] = scratch_.query;
      scratch_.seen[slot] = pairs[i];
    }
  }

  const TriangleMesh &mesh_, &body_;
  const Pose &place_;
  PairScratch &scratch_;
  std::vector<Vec3> &polygon_;
  PatchLoad &load_;
};

}  // namespace

void push_pair_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
                       PatchScratch &patch_scratch, PatchLoad &load) {
  PairSearch(mesh, body, place, scratch, patch_scratch.polygon, load).run();
}

}  // namespace cmb::mesh
