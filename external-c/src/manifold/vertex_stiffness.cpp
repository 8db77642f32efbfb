#include "manifold/vertex_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

constexpr double pi = 3.14159265358979323846;
std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Whether all faces at a vertex look towards the other body.
bool is_whole(const PolytopeSide &side, std::int32_t vertex) {
  const ContactPolytope &body = side.body();
  const Vec3 towards = side.towards();
  const std::size_t count = body.faces_at(vertex);
  for (std::size_t i = 0; i < count; ++i) {
    if (dot(towards, body.face_normal_at(vertex, i)) < 0.0) return false;
  }
  return true;
}

}  // namespace

double visible_cone(const PolytopeSide &side, std::int32_t vertex, DirectionCone &cone) {
  cone.clear();
  const ContactPolytope &body = side.body();
  const convex::Mat3 &rotation = side.to_side().rotation;
  // An apex with very many faces is taken with every second, third, ... of them.
  const std::size_t count = body.faces_at(vertex), step = 1 + count / (DirectionCone::capacity / 2);
  const Vec3 first = rotation * body.face_normal_at(vertex, 0);
  Vec3 from = first;
  bool whole = step == 1;
  for (std::size_t i = 0; i < count; i += step) {
    const Vec3 to = i + step < count ? rotation * body.face_normal_at(vertex, i + step) : first;
    if (from.z >= 0.0) cone.add(from);
    if ((from.z < 0.0) != (to.z < 0.0)) {
      whole = false;
      Vec3 border = std::fabs(to.z) * from + std::fabs(from.z) * to;
      border.z = 0.0;
      if (norm2(border) > 0.0) cone.add(border);
    }
    from = to;
  }
  return whole && !cone.empty() ? body.normal_cone(vertex) : cone.solid_angle();
}

void VertexStiffness::start(const PolytopeSide &side, double turning) {
  side_ = &side;
  turning_ = turning;
  known_.assign(side.vertex_count(), {});
}

const Stiffness &VertexStiffness::of(std::int32_t k, double visible) {
  Stiffness &stiffness = known_[index(k)];
  if (stiffness.value >= 0.0) return stiffness;
  const ContactPolytope &body = side_->body();
  const std::int32_t v = side_->vertex(index(k)).number;
  const double scale = 2.0 * pi / std::max(visible, 0.25 * body.normal_cone(v));
  if (body.share_is_constant(v)) {
    stiffness.value = scale * body.share(v, side_->towards());
  } else {
    Vec3 gradient;
    stiffness.value = scale * body.share(v, side_->towards(), &gradient);
    stiffness.slope = (scale * turning_) * (side_->to_side().rotation * gradient);
  }
  return stiffness;
}

const Stiffness &VertexStiffness::of(std::int32_t k) {
  if (known_[index(k)].value >= 0.0) return known_[index(k)];
  const std::int32_t v = side_->vertex(index(k)).number;
  return of(k, is_whole(*side_, v) ? side_->body().normal_cone(v) : visible_cone(*side_, v, cone_));
}

}  // namespace cmb
