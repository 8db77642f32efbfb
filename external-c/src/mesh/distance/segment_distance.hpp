// Nearest points of two line segments.
#pragma once

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

struct SegmentPoints {
  double s = 0.0, t = 0.0;  // in [0, 1], along the first and the second segment
  Vec3 first, second;
};

// The nearest points of segments p + s u and q + t v (Ericson, Real-Time Collision Detection, section 5.1.9); some of
// them where there are many. u and v are not zero.
SegmentPoints nearest_of_segments(const Vec3 &p, const Vec3 &u, const Vec3 &q, const Vec3 &v);

}  // namespace cmb::mesh
