#include "narrowphase/polytope/nearest_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/index.hpp"

namespace cmb::convex {

namespace {

// In the plane of a face, across one of its edges: out of the face.
Vec3 outward(const Polytope &polytope, std::int32_t edge, std::int32_t face) {
  const Vec3 &normal = polytope.faces()[index(face)].normal, &along = polytope.edge_directions()[index(edge)];
  return polytope.edges()[index(edge)].face[0] == face ? cross(along, normal) : cross(normal, along);
}

const Vec3 &begin_of(const Polytope &polytope, const Polytope::Edge &edge) { return polytope.vertices()[index(edge.vertex[0])]; }
const Vec3 &end_of(const Polytope &polytope, const Polytope::Edge &edge) { return polytope.vertices()[index(edge.vertex[1])]; }

// Calls visit(height of p, normal, kind and number of the feature beyond) for each plane of a feature's region; normals
// point out of the region. Of a face, those through its sides.
template <typename Visit>
void for_planes(const Polytope &polytope, const Feature &feature, const Vec3 &p, const Visit &visit) {
  if (feature.kind == FeatureKind::vertex) {
    const Vec3 arm = p - polytope.vertices()[index(feature.index)];
    for (std::int32_t k = polytope.neighbour_begin(feature.index); k < polytope.neighbour_begin(feature.index + 1); ++k) {
      const std::int32_t edge = polytope.neighbour_edges()[index(k)];
      const Vec3 &along = polytope.edge_directions()[index(edge)];
      const Vec3 out = polytope.edges()[index(edge)].vertex[0] == feature.index ? along : -along;
      visit(dot(arm, out), out, FeatureKind::edge, edge);
    }
    return;
  }
  if (feature.kind == FeatureKind::edge) {
    const Polytope::Edge &edge = polytope.edges()[index(feature.index)];
    const Vec3 &along = polytope.edge_directions()[index(feature.index)], arm = p - begin_of(polytope, edge);
    visit(dot(arm, -along), -along, FeatureKind::vertex, edge.vertex[0]);
    visit(dot(p - end_of(polytope, edge), along), along, FeatureKind::vertex, edge.vertex[1]);
    for (const std::int32_t face : edge.face) {
      const Vec3 inward = -outward(polytope, feature.index, face);
      visit(dot(arm, inward), inward, FeatureKind::face, face);
    }
    return;
  }
  const Polytope::Face &face = polytope.faces()[index(feature.index)];
  for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
    const std::int32_t edge = polytope.face_edges()[index(k)];
    const Vec3 out = outward(polytope, edge, feature.index);
    visit(dot(p - begin_of(polytope, polytope.edges()[index(edge)]), out), out, FeatureKind::edge, edge);
  }
}

double height_over(const Polytope::Face &face, const Vec3 &p) { return dot(face.normal, p) - face.offset; }

}  // namespace

NearestFeatures::NearestFeatures(const Polytope &polytope, const Vec3 &place, const Vec3 &line, const Feature &near,
                                 FacesAlongLine &room)
    : polytope_(polytope), place_(place), line_(line), nearest_(near), room_(room) {
  if (nearest_.kind == FeatureKind::smooth) {
    nearest_ = {FeatureKind::face, highest_face()};
    start_inside_ = height_over(polytope.faces()[index(nearest_.index)], place) < 0.0;
    if (start_inside_) found_ = true;
  }
  // Each step comes nearer, but by rounding.
  const std::size_t most = polytope.vertices().size() + polytope.edges().size() + polytope.faces().size();
  for (std::size_t step = 0; !found_ && step < most; ++step) found_ = !improve();
}

void NearestFeatures::look_at_faces() {
  if (faces_known_) return;
  faces_known_ = true;
  const std::vector<Polytope::Face> &faces = polytope_.faces();
  room_.heights.resize(std::max(room_.heights.size(), faces.size()));
  room_.rates.resize(room_.heights.size());
  double *const height = room_.heights.data(), *const rate = room_.rates.data();
  for (std::size_t k = 0; k < faces.size(); ++k) {
    height[k] = height_over(faces[k], place_);
    rate[k] = dot(faces[k].normal, line_);
  }
}

std::int32_t NearestFeatures::highest_face() {
  look_at_faces();
  const auto end = room_.heights.begin() + static_cast<std::ptrdiff_t>(polytope_.faces().size());
  return static_cast<std::int32_t>(std::max_element(room_.heights.begin(), end) - room_.heights.begin());
}

bool NearestFeatures::improve() {
  double greatest = 0.0;
  Feature better;
  for_planes(polytope_, nearest_, place_, [&](double height, const Vec3 &, FeatureKind kind, std::int32_t to) {
    if (height > greatest) greatest = height, better = {kind, to};
  });
  if (greatest > 0.0) {
    nearest_ = better;
    return true;
  }
  if (nearest_.kind != FeatureKind::face || height_over(polytope_.faces()[index(nearest_.index)], place_) >= 0.0) return false;
  // Behind the face: inside, or over the far side.
  const std::int32_t highest = highest_face();
  start_inside_ = height_over(polytope_.faces()[index(highest)], place_) < 0.0;
  nearest_.index = highest;
  return !start_inside_;
}

void NearestFeatures::start(double sense, double length) {
  sense_ = sense;
  way_ = sense * line_;
  length_ = length;
  ahead_known_ = false;
  at_ = 0.0;
  feature_ = nearest_;
  inside_ = start_inside_;
  look_ahead();
}

void NearestFeatures::next() {
  at_ = end_;
  feature_ = next_;
  inside_ = next_inside_;
  look_ahead();
}

void NearestFeatures::bound(double height, double rate, FeatureKind kind, std::int32_t to) {
  if (!(rate > 0.0)) return;
  const double t = std::max(at_, -height / rate);
  if (t < end_) end_ = t, next_ = {kind, to};
}

void NearestFeatures::look_ahead() {
  end_ = std::numeric_limits<double>::infinity();
  next_inside_ = false;
  if (feature_.kind == FeatureKind::face) {
    const Polytope::Face &face = polytope_.faces()[index(feature_.index)];
    const double height = height_over(face, place_), rate = dot(face.normal, way_);
    if (inside_) return look_ahead_inside(height, rate);
    bound(-height, -rate, FeatureKind::face, feature_.index);  // where it goes in
    next_inside_ = true;
  }
  const double goes_in = end_;
  for_planes(polytope_, feature_, place_, [&](double height, const Vec3 &out, FeatureKind kind, std::int32_t to) {
    bound(height, dot(out, way_), kind, to);
  });
  if (end_ < goes_in) next_inside_ = false;
}

void NearestFeatures::look_ahead_inside(double height, double rate) {
  if (!ahead_known_) find_faces_ahead(height, rate);
  bound(height, rate, FeatureKind::face, feature_.index);  // where it comes out
  const double comes_out = end_;
  for (const FacesAlongLine::Face &other : room_.ahead) bound(other.height - height, other.rate - rate, FeatureKind::face, other.face);
  next_inside_ = end_ < comes_out;
}

// A line goes through a convex body once, so this is asked once a way. Heights change evenly along it: the highest face is above
// both that which is the highest here and that at the end, and only what is above these where they cross can be it.
void NearestFeatures::find_faces_ahead(double height, double rate) {
  look_at_faces();
  ahead_known_ = true;
  room_.ahead.clear();
  const std::size_t count = polytope_.faces().size();
  const double *const heights = room_.heights.data(), *const rates = room_.rates.data();
  const double at_end = height + rate * length_;
  // Few faces pass either comparison that comes first.
  double level = at_end;
  std::size_t last = count;
  for (std::size_t k = 0; k < count; ++k) {
    const double end = heights[k] + sense_ * rates[k] * length_;
    if (end > level && sense_ * rates[k] > rate) level = end, last = k;
  }
  if (last == count) return;
  const double meet = (height - heights[last]) / (sense_ * rates[last] - rate), least = height + rate * meet;
  for (std::size_t k = 0; k < count; ++k) {
    const double along = sense_ * rates[k];
    if (k != last && heights[k] + along * meet < least) continue;
    if (along > rate && heights[k] + along * length_ > at_end) {
      room_.ahead.push_back({heights[k], along, static_cast<std::int32_t>(k)});
    }
  }
}

}  // namespace cmb::convex
