#include "manifold/axis/capsule_on_polytope.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis/axis_energy.hpp"
#include "manifold/axis/carried_part.hpp"
#include "math/index.hpp"
#include "math/smoothstep.hpp"

namespace cmb {

namespace {

using convex::Feature;
using convex::FeatureKind;
using convex::NearestFeatures;
using convex::Polytope;

constexpr int samples = 8;

// An axis beside or inside a polytope, in whose frame all is; places are counted from `origin`.
class AxisBesidePolytope {
 public:
  AxisBesidePolytope(const Polytope &polytope, const Vec3 &origin, const Vec3 &axis, double radius)
      : polytope_(polytope), origin_(origin), axis_(axis), radius_(radius) {}

  // Finds the stretches from `first` to `last` that may be deep, each with the feature nearest to it; false where that fails.
  bool find_pieces(double first, double last, const Feature &near, CapsuleScratch &scratch) {
    pieces_ = &scratch.pieces;
    pieces_->clear();
    NearestFeatures nearest(polytope_, origin_, axis_, near, scratch.faces);
    const std::size_t most = 4 * (polytope_.vertices().size() + polytope_.edges().size() + polytope_.faces().size());
    if (!nearest.found()) return false;
    for (const double sense : {1.0, -1.0}) {
      const double length = sense > 0.0 ? last : -first;
      double from = 0.0, to = 0.0;
      for (nearest.start(sense, length);; nearest.next(), from = to) {
        to = std::min(nearest.end(), length);
        pieces_->push_back({nearest.feature(), sense > 0.0 ? from : -to, sense > 0.0 ? to : -from});
        if (to >= length || apart_from(nearest.feature(), sense, to)) break;
        if (pieces_->size() > most) return false;
      }
    }
    return true;
  }

  AxisEnergy energy() const {
    AxisEnergy energy;
    for (const AxisPiece &piece : *pieces_) {
      if (!(piece.to > piece.from)) continue;
      if (piece.feature.kind == FeatureKind::face) {
        const Polytope::Face &face = face_of(piece.feature);
        energy.add_flat(face.normal, radius_ - height(face), dot(face.normal, axis_), piece.from, piece.to);
      } else {
        const Gap g = gap(piece.feature);
        energy.add_round(g.at, g.slope, norm2(g.at) - radius_ * radius_, dot(g.at, g.slope), norm2(g.slope), radius_, piece.from,
                         piece.to);
      }
    }
    return energy;
  }

  // How deep the axis is in the polytope where it is, plus the radius; the radius where it is not.
  double deepest() const {
    double lowest = 0.0;
    for (const AxisPiece &piece : *pieces_) {
      if (piece.feature.kind != FeatureKind::face) continue;
      const Polytope::Face &face = face_of(piece.feature);
      const double rate = dot(face.normal, axis_);
      lowest = std::min(lowest, height(face) + std::min(piece.from * rate, piece.to * rate));
    }
    return radius_ - lowest;
  }

  // The part of the stretch that is near edges, or near the planes between two sides inside.
  double near_edges(double begin, double end) const {
    const double step = (end - begin) / samples, near = near_edge_part * std::min(1.0, polytope_.sharpest_edge()) * radius_;
    double sum = 0.0;
    for (const AxisPiece &piece : *pieces_) {
      for (int k = 0; k < samples; ++k) {
        const double x = begin + (k + 0.5) * step;
        if (x < piece.from || x >= piece.to) continue;
        sum += convex::falling_smoothstep(to_edge(piece.feature, origin_ + x * axis_) / near);
      }
    }
    return sum / samples;
  }

 private:
  const Polytope::Face &face_of(const Feature &feature) const { return polytope_.faces()[index(feature.index)]; }
  double height(const Polytope::Face &face) const { return dot(face.normal, origin_) - face.offset; }

  // The gap from an edge or corner at the origin, and its growth along the axis.
  struct Gap {
    Vec3 at, slope;
  };
  Gap gap(const Feature &feature) const {
    if (feature.kind == FeatureKind::vertex) return {origin_ - polytope_.vertices()[index(feature.index)], axis_};
    const Vec3 &along = polytope_.edge_directions()[index(feature.index)];
    const Vec3 arm = origin_ - polytope_.vertices()[index(polytope_.edges()[index(feature.index)].vertex[0])];
    return {arm - dot(arm, along) * along, axis_ - dot(axis_, along) * along};
  }

  // Whether the axis is farther away than its radius at `t` along the sense, and goes away. The distance is a convex function of
  // the place: then nothing beyond is deep.
  bool apart_from(const Feature &feature, double sense, double t) const {
    const double x = sense * t;
    if (feature.kind == FeatureKind::face) {
      const Polytope::Face &face = face_of(feature);
      const double rate = dot(face.normal, axis_);
      return height(face) + x * rate >= radius_ && sense * rate >= 0.0;
    }
    const Gap g = gap(feature);
    const Vec3 here = g.at + x * g.slope;
    return norm2(here) >= radius_ * radius_ && sense * dot(here, g.slope) >= 0.0;
  }

  // How far p, to which the feature is nearest, is from the edges, or inside from the planes between the feature, a side, and its
  // neighbours, counted along the side; not below 0.
  double to_edge(const Feature &feature, const Vec3 &p) const {
    if (feature.kind != FeatureKind::face) {
      const Gap g = gap(feature);
      return norm(g.at + dot(p - origin_, axis_) * g.slope);
    }
    const Polytope::Face &face = face_of(feature);
    const double above = dot(face.normal, p) - face.offset;
    double nearest = HUGE_VAL;
    for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
      const std::int32_t e = polytope_.face_edges()[index(k)];
      const Polytope::Edge &edge = polytope_.edges()[index(e)];
      const Vec3 &along = polytope_.edge_directions()[index(e)];
      const Vec3 arm = p - polytope_.vertices()[index(edge.vertex[0])];
      const double aside = std::fabs(dot(arm, cross(along, face.normal)));
      const double here = above > 0.0 ? std::sqrt(aside * aside + above * above)
                                       : aside + above * polytope_.edge_sharpness()[index(e)];
      nearest = std::min(nearest, here);
    }
    return std::max(0.0, nearest);
  }

  const Polytope &polytope_;
  const Vec3 origin_, axis_;
  const double radius_;
  std::vector<AxisPiece> *pieces_ = nullptr;
};

}  // namespace

double capsule_on_polytope(const Shape &capsule, const Pose &pose, const Shape &polytope, const Pose &polytope_pose, double depth,
                           const Vec3 &deepest, const Vec3 &normal, double sense, CapsuleScratch &scratch,
                           std::vector<ContactPoint> &points) {
  const Polytope &geometry = polytope.polytope->geometry();
  const Mat3 &frame = polytope_pose.rotation;
  const double radius = capsule.body.radius, half = capsule.body.half.z;
  const Vec3 axis = pose.rotation.column(2);
  const double place = std::clamp(dot(deepest - pose.translation, axis), -half, half);
  const Vec3 origin = pose.translation + place * axis;
  Feature near;
  if (depth < radius) near = {FeatureKind::vertex, geometry.support_vertex(transposed_times(frame, normal))};
  AxisBesidePolytope beside(geometry, transposed_times(frame, origin - polytope_pose.translation), transposed_times(frame, axis), radius);
  if (!beside.find_pieces(-half - place, half - place, near, scratch)) return 0.0;
  const AxisEnergy energy = beside.energy();
  double part = 1.0, limit = radius;
  if (depth > deep_axis_part * radius) {
    const double inside = beside.deepest();
    limit = std::max(depth, inside);
    part = carried_part(beside.near_edges(energy.begin(), energy.end()), inside, depth, radius);
  }
  return part > 0.0 && energy.carry(frame, axis, origin, radius, part, limit, sense, points) ? part : 0.0;
}

}  // namespace cmb
