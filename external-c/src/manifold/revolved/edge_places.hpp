// The places of an edge where two sides of an overlap meet, on both sides to rounding of the overlap's size rather than of the bodies'.
#pragma once

#include <cmath>
#include <vector>

#include "manifold/surface/off_side.hpp"
#include "math/legendre_series.hpp"
#include "math/vector3.hpp"

namespace cmb {

using convex::Vec3;

// Moves a place onto three sides, by their off(), until only rounding moves it. False, and as far as it came, where it does not settle within
// `most`, as where they do not meet in one place.
template <typename A, typename B, typename C>
bool move_onto(const A &a, const B &b, const C &c, double most, Vec3 &at) {
  constexpr int rounds = 10;
  constexpr double settled = 1e-9, shrinks = 0.5;
  double before = HUGE_VAL;
  for (int k = 0; k < rounds; ++k) {
    const OffSide p = a.off(at), q = b.off(at), r = c.off(at);
    const Vec3 of_p = cross(q.normal, r.normal), of_q = cross(r.normal, p.normal), of_r = cross(p.normal, q.normal);
    const Vec3 way = (1.0 / dot(p.normal, of_p)) * (p.distance * of_p + q.distance * of_q + r.distance * of_r);
    const double far = norm(way);
    if (!(far <= most)) return false;
    if (!(far < shrinks * before)) return far <= settled * norm(at);
    at = at - way;
    before = far;
  }
  return false;
}

class EdgePlaces {
 public:
  // By how much places may be off for all that is rounded, by the bodies' size.
  static constexpr double most_off = 1e-7;

  struct Place {
    Vec3 at, step;
  };

  void clear() { places_.clear(), arcs_.clear(); }
  // The next places are of one smooth arc, by Gauss' rule.
  void begin_arc(const LegendreSeries &series) { arcs_.push_back({places_.size(), series}); }
  const std::vector<Place> &places() const { return places_; }

  // A place as good as on both sides, and the edge's way there by the weight of the rule that integrates along it.
  template <typename A, typename B>
  static Place on_both(const A &a, const B &b, const Vec3 &at, const Vec3 &step, double most) {
    constexpr int rounds = 2;
    Place place{at, step};
    for (int k = 0; k <= rounds; ++k) {
      const OffSide p = a.off(place.at), q = b.off(place.at);
      const Vec3 way = cross(p.normal, q.normal);
      const double sine = norm(way);
      if (!(sine > 0.0)) return place;
      const Vec3 along = (1.0 / sine) * way, across = cross(along, p.normal);
      if (k == rounds) {
        const Vec3 straight = dot(along, step) * along;
        place.step = straight - dot(p.normal, straight) * p.normal;
        break;
      }
      const double aside = (dot(p.normal, q.normal) * p.distance - q.distance) / sine;
      if (!(std::fabs(aside) + std::fabs(p.distance) <= most)) return place;
      place.at = place.at - p.distance * p.normal + aside * across;
    }
    return place;
  }
  void add(const Place &place) { places_.push_back(place); }
  // Makes the ways lead there; of a closed edge they lead to where it begins. False where they do not as good as, as a part is missing.
  bool lead(const Vec3 &way);
  // Between two corners.
  template <typename A, typename B>
  void lead(const A &a, const B &b, const Vec3 &from, const Vec3 &to, double most) {
    if (!go_by_chord(a, b, from, to)) lead(from, to, most);
  }
  // Makes them lead from one corner to the next, and moves the places along the edge to where the ways say, by no more than `most`.
  void lead(const Vec3 &from, const Vec3 &to, double most);

 private:
  struct Upright {
    Vec3 normal;
    double offset;
    OffSide off(const Vec3 &at) const { return {dot(normal, at) - offset, normal}; }
  };
  template <typename A, typename B>
  bool go_by_chord(const A &a, const B &b, const Vec3 &from, const Vec3 &to);
  struct Arc {
    std::size_t first;
    LegendreSeries series;
  };
  // How far the ways lead, together, and what is missing to where they ought to.
  struct Lead {
    Vec3 left;
    double whole;
    bool arrives() const {
      constexpr double hardly = 1e-3;
      return norm(left) <= hardly * whole;
    }
  };
  Lead lead_to(const Vec3 &way) const;
  static const LegendreSeries &chord_rule();
  static void straighten(const LegendreSeries &series, const Vec3 &begin, const Vec3 &whole, double most, Place *place);

  std::vector<Place> places_, on_chord_;
  std::vector<Arc> arcs_;
};

// Where the edge is as good as straight: by its chord's length alone, which is known to rounding of its own. Whether that serves.
template <typename A, typename B>
bool EdgePlaces::go_by_chord(const A &a, const B &b, const Vec3 &from, const Vec3 &to) {
  constexpr double straight = 0.995, aside = 0.1, enough = 1e-11;
  const Vec3 way = to - from;
  const double length = norm(way);
  if (!(length > 0.0) || arcs_.size() != 1 || !lead_to(way).arrives()) return false;
  const Vec3 along = (1.0 / length) * way;
  for (const Place &place : places_) {
    if (!(dot(along, place.step) > straight * norm(place.step))) return false;
  }
  const LegendreSeries &rule = chord_rule();
  on_chord_.clear();
  Vec3 left = way;
  for (std::size_t k = 0; k < rule.count; ++k) {
    const double there = rule.node[k] * length;
    // From between the nearest known places.
    Vec3 low = from, high = to;
    double low_far = 0.0, high_far = length;
    for (const Place &place : places_) {
      const double far = dot(along, place.at - from);
      if (far <= there && far > low_far) low = place.at, low_far = far;
      if (far > there && far < high_far) high = place.at, high_far = far;
    }
    Vec3 at = low + ((there - low_far) / (high_far - low_far)) * (high - low);
    if (!move_onto(a, b, Upright{along, there + dot(along, from)}, aside * length, at)) return false;
    const Vec3 edge = cross(a.off(at).normal, b.off(at).normal);
    const double rate = dot(edge, along);
    if (!(std::fabs(rate) > straight * norm(edge))) return false;
    on_chord_.push_back({at, (rule.weight[k] * length / rate) * edge});
    left = left - on_chord_.back().step;
  }
  if (!(norm(left) <= enough * length)) return false;
  places_.swap(on_chord_);
  return true;
}

}  // namespace cmb
