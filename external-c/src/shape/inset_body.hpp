// Bodies taken off a little all round, with the same features: where two overlap by less, those are apart.
#pragma once

#include <algorithm>

#include "shape/convex_body.hpp"

namespace cmb::convex {

// A core within another of the same kind, each side of it parallel to one of that; its frame has the same axes.
struct InsetBody {
  ConvexBody body;
  Vec3 origin;  // of its frame in that of the whole one
  Vec3 growth;  // coordinates of the whole one by its own
};

// By a part of the radius of the greatest ball within. Segments, points and polytopes stay what they are.
inline InsetBody inset(const ConvexBody &whole, double part) {
  InsetBody result{whole, {}, {1, 1, 1}};
  Vec3 &h = result.body.half;
  switch (whole.core) {
    case CoreShape::box:
    case CoreShape::ellipsoid:
    case CoreShape::cylinder: {
      const double off = part * std::min({h.x, h.y, h.z});
      h = h - Vec3{off, off, off};
      break;
    }
    case CoreShape::cone: {
      const double slant = cone_slant(h), ball = 2.0 * h.x * h.z / (h.x + slant);
      result.origin.z = part * (ball - h.z);
      h = (1.0 - part) * h;
      break;
    }
    default: return result;
  }
  result.growth = {whole.half.x / h.x, whole.half.y / h.y, whole.half.z / h.z};
  return result;
}

// The point of the whole core that is like p (both in their own frames).
inline Vec3 grown(const InsetBody &inset, const Vec3 &p) {
  return {inset.growth.x * p.x, inset.growth.y * p.y, inset.growth.z * p.z};
}

}  // namespace cmb::convex
