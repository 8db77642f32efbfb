#include "manifold/revolved/edge_places.hpp"

#include "math/gauss_rule.hpp"

namespace cmb {

const LegendreSeries &EdgePlaces::chord_rule() {
  static const LegendreSeries rule = overlap::GaussNodes(overlap::gauss_rule<8>).series;
  return rule;
}

EdgePlaces::Lead EdgePlaces::lead_to(const Vec3 &way) const {
  Lead lead{way, 0.0};
  for (const Place &place : places_) lead.left = lead.left - place.step, lead.whole += norm(place.step);
  return lead;
}

bool EdgePlaces::lead(const Vec3 &way) {
  const Lead lead = lead_to(way);
  if (!lead.arrives()) return false;
  if (!(lead.whole > 0.0)) return true;
  for (Place &place : places_) place.step = place.step + (norm(place.step) / lead.whole) * lead.left;
  return true;
}

void EdgePlaces::lead(const Vec3 &from, const Vec3 &to, double most) {
  if (!lead(to - from)) return;
  Vec3 begin = from;
  for (const Arc &arc : arcs_) {
    Place *const place = &places_[arc.first];
    Vec3 whole;
    for (std::size_t k = 0; k < arc.series.count; ++k) whole = whole + place[k].step;
    straighten(arc.series, begin, whole, most, place);
    begin = begin + whole;
  }
}

void EdgePlaces::straighten(const LegendreSeries &series, const Vec3 &begin, const Vec3 &whole, double most, Place *place) {
  const double length = norm(whole);
  if (!(length > 0.0)) return;
  const Vec3 along = (1.0 / length) * whole;
  // What the series may leave out.
  double last = 0.0, next = 0.0;
  for (std::size_t k = 0; k < series.count; ++k) {
    const double rate = dot(along, place[k].step) / series.weight[k];
    last += series.last[k] * rate, next += series.next[k] * rate;
  }
  const double unknown = (std::fabs(last) + std::fabs(next)) / static_cast<double>(series.count);
  for (std::size_t k = 0; k < series.count; ++k) {
    double ahead = dot(along, begin - place[k].at);
    for (std::size_t j = 0; j < series.count; ++j) ahead += series.part[k * series.count + j] * dot(along, place[j].step);
    const Vec3 move = (ahead / dot(along, place[k].step)) * place[k].step;
    const double far = norm(move);
    if (far > unknown && far <= most) place[k].at = place[k].at + move;
  }
}

}  // namespace cmb
