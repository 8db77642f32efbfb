#include "volume/shape_overlap.hpp"

namespace cmb::overlap {

Pose seen_along(const Vec3 &z, const Vec3 &y, const Vec3 &origin) {
  const Vec3 across = y - dot(y, z) * z;
  const Vec3 second = norm(across) > 1e-3 * norm(y) ? normalized(across) : convex::any_perpendicular(z);
  const Vec3 first = normalized(cross(second, z));
  return {transposed(Mat3{{first, cross(z, first), z}}), origin};
}

ShapeOverlap shape_overlap(const SolidSums &sums, const Pose &axes) {
  ShapeOverlap result;
  SideSums shadow;
  shadow.add(sums.upper, 0.5);
  shadow.add(sums.lower, 0.5);
  if (!(sums.volume > 0.0) || !(shadow.area > 0.0)) return result;
  result.volume = sums.volume;
  result.centroid = axes((1.0 / sums.volume) * Vec3{sums.x, sums.y, sums.z});
  result.patch_area = shadow.area;
  const double x = shadow.x / shadow.area, y = shadow.y / shadow.area;
  result.patch_centroid = axes({x, y, shadow.height / shadow.area});
  const double xy = shadow.xy - shadow.area * x * y;
  result.patch_moment =
      turned(axes.rotation, {{{shadow.xx - shadow.area * x * x, xy, 0.0}, {xy, shadow.yy - shadow.area * y * y, 0.0}, {}}});
  return result;
}

}  // namespace cmb::overlap
