#include "mesh/contact/sheet_patches.hpp"

#include <algorithm>

namespace cmb::mesh {

namespace {

using Pair = TrianglePairNumbers;

class PairWalk {
 public:
  PairWalk(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PlacedVertices &vertices,
           SheetPatchScratch &scratch, std::vector<Vec3> &polygon, PatchLoad &load)
      : mesh_(mesh), body_(body), place_(place), vertices_(vertices), scratch_(scratch), polygon_(polygon), load_(load) {
    if (scratch.wedge_of.size() < mesh.triangles().size()) scratch.wedge_of.resize(mesh.triangles().size());
    if (scratch.seen.empty()) grow();
    if (++scratch.query == 0) {  // the counter has wrapped
      for (auto &entry : scratch.seen) entry.query = 0;
      for (auto &entry : scratch.wedge_of) entry.query = 0;
      scratch.query = 1;
    }
    scratch.seen_count = 0;
    scratch.wedges.clear();
  }

  // The pair, and what hangs together with it.
  void run(const Pair &first) {
    offer(first);
    while (!scratch_.open.empty()) {
      const Pair pair = scratch_.open.back();
      scratch_.open.pop_back();
      look_at(pair);
    }
  }

 private:
  void look_at(const Pair &pair) {
    const Vec3 corners[3] = {vertices_.corner(pair.facet, 0), vertices_.corner(pair.facet, 1), vertices_.corner(pair.facet, 2)};
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

  // Valid until the next call.
  const TriangleWedge &wedge_of(std::uint32_t t) {
    SheetPatchScratch::KnownWedge &known = scratch_.wedge_of[t];
    if (known.query != scratch_.query) {
      known = {static_cast<std::uint32_t>(scratch_.wedges.size()), scratch_.query};
      scratch_.wedges.emplace_back(mesh_, t, body_.bound_radius());
    }
    return scratch_.wedges[known.number];
  }

  // Opens a pair, unless it was before.
  void offer(const Pair &pair) {
    if (2 * (scratch_.seen_count + 1) > scratch_.seen.size()) grow();
    SheetPatchScratch::SeenPair &slot = scratch_.seen[find(pair)];
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
      const SheetPatchScratch::SeenPair &entry = scratch_.seen[slot];
      if (entry.query != scratch_.query) return slot;
      if (entry.pair.triangle == pair.triangle && entry.pair.facet == pair.facet) return slot;
    }
  }

  // The table's size is a power of two.
  void grow() {
    std::vector<SheetPatchScratch::SeenPair> before(std::max<std::size_t>(1024, 2 * scratch_.seen.size()));
    before.swap(scratch_.seen);
    for (const SheetPatchScratch::SeenPair &entry : before) {
      if (entry.query == scratch_.query) scratch_.seen[find(entry.pair)] = entry;
    }
  }

  const TriangleMesh &mesh_, &body_;
  const Pose &place_;
  const PlacedVertices &vertices_;
  SheetPatchScratch &scratch_;
  std::vector<Vec3> &polygon_;
  PatchLoad &load_;
};

}  // namespace

void push_sheet_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PlacedVertices &vertices,
                        const Crossings &crossings, SheetPatchScratch &scratch, PatchScratch &patch_scratch, PatchLoad &load) {
  PairWalk walk(mesh, body, place, vertices, scratch, patch_scratch.polygon, load);
  for (const Crossings::Cut &cut : crossings.cuts) walk.run(cut.pair);
}

}  // namespace cmb::mesh
