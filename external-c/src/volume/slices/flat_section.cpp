#include "volume/slices/flat_section.hpp"

#include <algorithm>
#include <limits>

#include "math/index.hpp"

namespace cmb::overlap {

bool FlatSection::cut(const convex::OverlapScratch &polytope, double y, std::int32_t marked_face) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  segments_.clear();
  low_ = infinity, high_ = -infinity;
  const std::vector<Vec3> &vertices = polytope.vertices();
  for (std::size_t f = 0; f < polytope.faces().size(); ++f) {
    const auto &face = polytope.faces()[f];
    double x[2], z[2];
    int count = 0;
    const Vec3 *from = &vertices[index(polytope.corners()[index(face.first + face.count - 1)])];
    for (std::int32_t k = 0; k < face.count && count < 2; ++k) {
      const Vec3 *to = &vertices[index(polytope.corners()[index(face.first + k)])];
      if ((from->y < y) != (to->y < y)) {
        const double part = (y - from->y) / (to->y - from->y);
        x[count] = from->x + part * (to->x - from->x);
        z[count++] = from->z + part * (to->z - from->z);
      }
      from = to;
    }
    if (count < 2) continue;
    const int first = x[0] <= x[1] ? 0 : 1;
    low_ = std::min(low_, x[first]), high_ = std::max(high_, x[1 - first]);
    if (face.normal.z == 0.0) continue;
    segments_.push_back({x[first], z[first], x[1 - first], z[1 - first], face.normal.z > 0.0,
                         face.source_face == marked_face, static_cast<int>(f)});
  }
  return low_ < high_;
}

}  // namespace cmb::overlap
