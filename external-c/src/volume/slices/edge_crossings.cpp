#include "volume/slices/edge_crossings.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "math/index.hpp"

namespace cmb::overlap {

void EdgeCrossings::find(const CommonSolid &solid) {
  kinks_.clear(), inside_.clear();
  const convex::OverlapScratch &polytope = *solid.polytope;
  for (const auto &face : polytope.faces()) {
    for (std::int32_t i = 0; i < face.count; ++i) {
      const std::int32_t from = polytope.corners()[index(face.first + i)];
      const std::int32_t to = polytope.corners()[index(face.first + (i + 1) % face.count)];
      if (from >= to) continue;  // each edge once
      const Vec3 &p = polytope.vertices()[index(from)], along = polytope.vertices()[index(to)] - p;
      for (const double end : {0.0, 1.0}) {
        if (solid.rounds_hold(p + end * along, -1)) kinks_.push_back(p.y + end * along.y);
      }
      Stretch common{0.0, 1.0};
      for (int k = 0; k < solid.round_count; ++k) {
        const Stretch inside = solid.rounds[k].stretch(p, along);
        common = inside.empty() ? inside : Stretch{std::max(common.begin, inside.begin), std::min(common.end, inside.end)};
        if (common.empty()) break;
        for (const double s : {inside.begin, inside.end}) {
          if (s > 0.0 && s < 1.0 && solid.rounds_hold(p + s * along, k)) kinks_.push_back(p.y + s * along.y);
        }
      }
      if (!common.empty()) inside_.push_back(p + (0.5 * (common.begin + common.end)) * along);
    }
  }
  for (int k = 0; k < solid.round_count; ++k) {
    if (const Vec3 *apex = solid.rounds[k].apex()) {
      if (solid.rounds_hold(*apex, k)) kinks_.push_back(apex->y);
    }
  }
  std::sort(kinks_.begin(), kinks_.end());
}

}  // namespace cmb::overlap
