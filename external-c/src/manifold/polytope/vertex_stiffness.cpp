#include "manifold/polytope/vertex_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "math/index.hpp"
#include "math/pi.hpp"

namespace cmb {

bool visible_cone(const ContactSide &side, std::int32_t vertex, const convex::Mat3 &rotation, DirectionCone &cone) {
  cone.clear();
  const ContactPolytope &body = side.body();
  const ContactPolytope::FaceCorner *const corners = body.corners(vertex);
  // An apex with very many faces is taken with every second, third, ... of them.
  const auto count = static_cast<std::size_t>(body.corners(vertex + 1) - corners);
  const std::size_t step = 1 + count / (DirectionCone::capacity / 2);
  const Vec3 first = rotation * body.face_of(corners[0]).normal;
  Vec3 from = first;
  bool whole = step == 1;
  for (std::size_t i = 0; i < count; i += step) {
    const Vec3 to = i + step < count ? rotation * body.face_of(corners[i + step]).normal : first;
    if (from.z >= 0.0) cone.add(from);
    if ((from.z < 0.0) != (to.z < 0.0)) {
      whole = false;
      Vec3 border = std::fabs(to.z) * from + std::fabs(from.z) * to;
      border.z = 0.0;
      if (norm2(border) > 0.0) cone.add(border);
    }
    from = to;
  }
  return whole && !cone.empty();
}

double visible_angle(const ContactSide &side, std::int32_t vertex, DirectionCone &cone) {
  return visible_cone(side, vertex, side.to_side().rotation, cone) ? side.body().normal_cone(vertex)
                                                                   : cone.solid_angle();
}

void VertexStiffness::start(const ContactSide &side, double turning) {
  side_ = &side;
  turning_ = turning;
  if (known_.size() < side.vertex_count()) known_.resize(side.vertex_count()), found_in_.resize(side.vertex_count());
  if (++start_ == 0) {
    std::fill(found_in_.begin(), found_in_.end(), 0);
    start_ = 1;
  }
}

void VertexStiffness::find(std::int32_t k, Stiffness &stiffness) {
  const ContactPolytope &body = side_->body();
  const std::int32_t v = side_->number(index(k));
  const ContactPolytope::Share share = body.share(v, side_->towards());
  const double visible = share.least_cosine >= 0.0 ? body.normal_cone(v) : visible_angle(*side_, v, cone_);
  const double scale = 2.0 * pi / std::max(visible, 0.25 * body.normal_cone(v));
  stiffness.value = scale * share.value;
  stiffness.slope = body.shares_are_constant() ? Vec3{}
                                               : (scale * turning_) * (side_->to_side().rotation * share.gradient);
}

}  // namespace cmb
