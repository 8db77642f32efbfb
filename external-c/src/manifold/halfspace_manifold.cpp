#include "manifold/halfspace_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "manifold/polytope/tessellation_energy.hpp"
#include "manifold/rod_end_share.hpp"

namespace cmb {

namespace {

// Collects the points of one shape; everything in the shape's frame, where the obstacle lies towards `down`.
class Collector {
 public:
  Collector(const Pose &pose, const Plane &plane, ContactSet &result)
      : pose_(pose),
        plane_(plane),
        result_(result),
        begin_(result.points.size()),
        down_(-transposed_times(pose.rotation, plane.normal)),
        offset_(dot(plane.normal, pose.translation) - plane.offset) {}

  const Vec3 &down() const { return down_; }

  // Height above the plane of a point of the shape.
  double height(const Vec3 &p) const { return offset_ - dot(down_, p); }

  // A point of the shape that carries `weight`, and that weight's derivative by the direction `down`.
  void add(const Vec3 &p, double weight, const Vec3 &weight_gradient = {}) {
    const double depth = -height(p);
    if (!(depth > 0.0) || !(weight > 0.0)) return;
    put(p, depth, weight);
    deepest_ = std::fmax(deepest_, depth);
    load_ += weight * depth;
    missing_ = missing_ + 0.5 * depth * depth * weight_gradient;
  }

  // A corner of a tessellated body that lies deep in the plane: its force follows the last one, from share_energy().
  void add_corner(const Vec3 &p, const TessellationEnergy &energy, const ContactPolytope::Share &share) {
    const double depth = -height(p);
    if (!(depth > 0.0)) return;
    const TessellationEnergy::Term term = energy.at(depth);
    const double force = share.value * term.slope;
    if (!(force > 0.0)) return;
    terms_ += share.value * term.value;
    load_ += force;
    squares_ += force * depth;
    missing_ = missing_ + term.value * share.gradient;
    put(p, depth, force);
  }
  // Points get the depth that stores the energy.
  void share_energy(const TessellationEnergy &energy) {
    if (!(load_ > 0.0)) return;
    const TessellationEnergy::Mean mean = energy.mean(terms_);
    const double deeper = mean.depth * mean.depth / (mean.force * squares_);
    load_ *= mean.force;
    missing_ = mean.share * missing_;
    for (std::size_t i = begin_; i < result_.points.size(); ++i) {
      ContactPoint &point = result_.points[i];
      point.depth *= deeper;
      point.weight *= mean.force / point.depth;
    }
  }

  // Ends the collection: `lowest` is the shape's lowest point.
  void finish(const Vec3 &lowest) {
    // By rounding a point may be lower than the lowest one, or none below the plane where that is.
    const bool carries = result_.points.size() > begin_;
    const double lowest_height = height(lowest);
    result_.distance = carries ? -std::fmax(deepest_, -lowest_height) : std::fmax(0.0, lowest_height);
    result_.normal = plane_.normal;
    result_.witness = pose_(lowest) - 0.5 * result_.distance * plane_.normal;
    if (!carries) return;
    // Energy that changes with the direction alone asks for a torque; a shift of the points supplies it.
    const Vec3 tangential = missing_ - dot(missing_, down_) * down_;
    const Vec3 shift = (1.0 / load_) * (pose_.rotation * tangential);
    for (std::size_t i = begin_; i < result_.points.size(); ++i) {
      result_.points[i].position = result_.points[i].position + shift;
    }
  }

 private:
  void put(const Vec3 &p, double depth, double weight) {
    const Vec3 at = pose_(p) + 0.5 * depth * plane_.normal;
    ContactPoint &point = result_.points.emplace_back();  // written member by member, which does not wait for a copy
    point.depth = depth, point.weight = weight;
    point.normal.x = plane_.normal.x, point.normal.y = plane_.normal.y, point.normal.z = plane_.normal.z;
    point.position.x = at.x, point.position.y = at.y, point.position.z = at.z;
  }

  const Pose &pose_;
  const Plane &plane_;
  ContactSet &result_;
  std::size_t begin_;
  Vec3 down_;
  double offset_;
  double load_ = 0.0, deepest_ = 0.0;
  double terms_ = 0.0, squares_ = 0.0;  // of corners: of the energy's terms; of force times depth
  Vec3 missing_;
};

// Room to look for vertices: a bit for each that was met, and for each that is found; these in turn.
struct VertexSearch {
  std::vector<std::uint64_t> met, deeper;
  std::vector<std::int32_t> found;
};

VertexSearch &vertex_search() {
  static thread_local VertexSearch search;
  return search;
}

// Calls visit(vertex) for all vertices that lie deeper than `level` below the plane: they hang together, and are found from `lowest`
// along the edges. They come in the body's order, not in that in which they are found: so each of the contact points is a
// differentiable function of the pose, also where a body lies flat and another vertex becomes the lowest one. Who
// differentiates the list of points, as integrators do, would else see points that change places.
template <typename Visit>
void visit_deeper(const convex::Polytope &polytope, std::int32_t lowest, double level, const Collector &collector, const Visit &visit) {
  constexpr std::size_t in_word = 64;
  const std::size_t vertices = polytope.vertices().size(), words = vertices / in_word + 1;
  // Small bodies need no room but this.
  std::uint64_t one_word = 0, *met = &one_word;
  std::int32_t few_found[in_word], *found = few_found;
  if (vertices >= in_word) {
    VertexSearch &search = vertex_search();
    if (search.found.size() <= vertices) {
      search.met.resize(words);
      search.deeper.resize(words);
      search.found.resize(vertices + 1);
    }
    met = search.met.data();
    found = search.found.data();
    std::fill_n(met, words, 0);
  }
  std::size_t count = 0;
  const Vec3 *const places = polytope.vertices().data();
  const auto look_at = [&](std::int32_t v) {
    std::uint64_t &word = met[static_cast<std::size_t>(v) / in_word];
    const std::uint64_t bit = std::uint64_t{1} << (static_cast<std::size_t>(v) % in_word);
    if ((word & bit) != 0) return;
    word |= bit;
    found[count] = v;
    count += -collector.height(places[v]) > level ? 1 : 0;
  };
  look_at(lowest);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t last_slot = polytope.neighbour_begin(found[k] + 1);
    for (std::int32_t slot = polytope.neighbour_begin(found[k]); slot < last_slot; ++slot) {
      look_at(polytope.neighbours()[static_cast<std::size_t>(slot)]);
    }
  }
  constexpr std::size_t few = 12;
  if (count < few || vertices < in_word) {
    std::sort(found, found + count);
    for (std::size_t k = 0; k < count; ++k) visit(found[k]);
    return;
  }
  // Many are set in order by a bit each.
  std::uint64_t *const deeper = vertex_search().deeper.data();
  std::fill_n(deeper, words, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const auto v = static_cast<std::size_t>(found[k]);
    deeper[v / in_word] |= std::uint64_t{1} << (v % in_word);
  }
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t left = deeper[word]; left != 0; left &= left - 1) {
      visit(static_cast<std::int32_t>(in_word * word) + __builtin_ctzll(left));
    }
  }
}

void polytope_contact(const ContactPolytope &polytope, Collector &collector) {
  const convex::Polytope &geometry = polytope.geometry();
  const std::int32_t lowest = geometry.support_vertex(collector.down());
  const auto place = [&](std::int32_t v) -> const Vec3 & { return geometry.vertices()[static_cast<std::size_t>(v)]; };
  const double deepest = -collector.height(place(lowest));
  if (deepest > 0.0) {
    const TessellationEnergy energy(deepest, polytope.fineness());
    const bool springs = energy.are_springs();
    visit_deeper(geometry, lowest, energy.level(), collector, [&](std::int32_t v) {
      const ContactPolytope::Share share = polytope.share(v, collector.down());
      if (springs) {
        collector.add(place(v), share.value, share.gradient);
      } else {
        collector.add_corner(place(v), energy, share);
      }
    });
    if (!springs) collector.share_energy(energy);
  }
  collector.finish(place(lowest));
}

// Whether a body of that radius whose lowest point is known is apart by more than rounding, so that no other point need be looked at.
bool is_apart(const Vec3 &lowest, double radius, const Collector &collector) {
  constexpr double more_than_rounding = 1e-9;
  return collector.height(lowest) > more_than_rounding * radius;
}

void capsule_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 &down = collector.down();
  const double sine = down.z;
  const Vec3 upper = Vec3{0, 0, body.half.z} + body.radius * down, lower = Vec3{0, 0, -body.half.z} + body.radius * down;
  const Vec3 &lowest = sine < 0.0 ? lower : upper;
  if (is_apart(lowest, body.radius, collector)) {
    collector.finish(lowest);
    return;
  }
  const double difference = end_share_difference(sine), slope = end_share_slope(sine);
  collector.add(upper, 0.5 * (1.0 + difference), {0, 0, 0.5 * slope});
  collector.add(lower, 0.5 * (1.0 - difference), {0, 0, -0.5 * slope});
  collector.finish(lowest);
}

// How a body of revolution about z is inclined: its lowest direction across that axis, and the sine of the angle between both.
struct Inclination {
  explicit Inclination(const Vec3 &down)
      : sine(std::sqrt(down.x * down.x + down.y * down.y)),
        lowest(sine > none ? Vec3{down.x / sine, down.y / sine, 0.0} : Vec3{1.0, 0.0, 0.0}) {}

  static constexpr double none = 1e-150;  // below it the sine's square is not known to rounding
  double sine;
  Vec3 lowest;
};

// What a disc's rim carries: a load `carried` (with its derivative by `down`) on four points, one of them the lowest;
// in equal parts where the disc lies flat, and all of it on the lowest where the sine of the disc's inclination is
// `edge_sine` or more.
void rim_contact(const Inclination &disc, double radius, double height, double edge_sine, double carried, const Vec3 &carried_gradient,
                 Collector &collector) {
  const Vec3 &lowest = disc.lowest, beside{-lowest.y, lowest.x, 0.0};
  const double part = std::fmin(1.0, disc.sine / edge_sine);
  const double difference = end_share_difference(part), slope = end_share_slope(part) / edge_sine;
  const Vec3 middle{0.0, 0.0, height};
  const auto add = [&](const Vec3 &direction, double share, double share_slope) {
    collector.add(middle + radius * direction, carried * share,
                  share * carried_gradient + (carried * share_slope) * lowest);
  };
  add(lowest, 0.25 * (1.0 + 3.0 * difference), 0.75 * slope);
  add(beside, 0.25 * (1.0 - difference), -0.25 * slope);
  add(-lowest, 0.25 * (1.0 - difference), -0.25 * slope);
  add(-beside, 0.25 * (1.0 - difference), -0.25 * slope);
}

// The ends share as those of a capsule do.
void cylinder_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 bottom = convex::core_support(body, collector.down()).point;
  if (is_apart(bottom, body.half.x, collector)) {
    collector.finish(bottom);
    return;
  }
  const Inclination inclination(collector.down());
  const double sine = collector.down().z;
  const double difference = end_share_difference(sine), slope = end_share_slope(sine);
  rim_contact(inclination, body.half.x, body.half.z, 1.0, 0.5 * (1.0 + difference), {0, 0, 0.5 * slope}, collector);
  rim_contact(inclination, body.half.x, -body.half.z, 1.0, 0.5 * (1.0 - difference), {0, 0, -0.5 * slope}, collector);
  collector.finish(bottom);
}

// Apex and base share by the inclination of the lowest line of the mantle; all is the base's where that lies flat.
void cone_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 &down = collector.down();
  const Vec3 bottom = convex::core_support(body, down).point;
  if (is_apart(bottom, body.half.x, collector)) {
    collector.finish(bottom);
    return;
  }
  const Inclination inclination(down);
  const Vec3 &lowest = inclination.lowest;
  const double height = 2.0 * body.half.z;
  // The sine of the line's inclination, as a part of what it is with the base flat.
  const double part = std::fmin(1.0, std::fmax(-1.0, (height * down.z - body.half.x * inclination.sine) / height));
  const Vec3 part_gradient = (1.0 / height) * (Vec3{0, 0, height} - body.half.x * lowest);
  const double difference = end_share_difference(part);
  const Vec3 gradient = (0.5 * end_share_slope(part)) * part_gradient;
  collector.add({0, 0, body.half.z}, 0.5 * (1.0 + difference), gradient);
  // Lying on its mantle the cone touches with one point of the rim.
  const double edge_sine = height / std::sqrt(height * height + body.half.x * body.half.x);
  rim_contact(inclination, body.half.x, -body.half.z, edge_sine, 0.5 * (1.0 - difference), -gradient, collector);
  collector.finish(bottom);
}

// Of a ball, which looks the same from everywhere.
void ball_contact(double radius, const Vec3 &center, const Plane &plane, ContactSet &result) {
  const double height = dot(plane.normal, center) - plane.offset - radius;
  result.distance = height;
  result.normal = plane.normal;
  result.witness = center - (radius + 0.5 * height) * plane.normal;
  if (!(height < 0.0)) return;
  ContactPoint &point = result.points.emplace_back();
  point.depth = -height, point.weight = 1.0;
  point.normal = plane.normal, point.position = result.witness;
}

void single_point_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 lowest = convex::core_support(body, collector.down()).point + body.radius * collector.down();
  collector.add(lowest, 1.0);
  collector.finish(lowest);
}

}  // namespace

void halfspace_contact(const Shape &shape, const Pose &pose, const Plane &plane, ContactSet &result) {
  if (shape.kind == ShapeKind::sphere) {
    ball_contact(shape.body.radius, pose.translation, plane, result);
    return;
  }
  Collector collector(pose, plane, result);
  switch (shape.kind) {
    case ShapeKind::box:
    case ShapeKind::hull:
      polytope_contact(*shape.polytope, collector);
      return;
    case ShapeKind::capsule:
      capsule_contact(shape.body, collector);
      return;
    case ShapeKind::cylinder:
      cylinder_contact(shape.body, collector);
      return;
    case ShapeKind::cone:
      cone_contact(shape.body, collector);
      return;
    default:
      single_point_contact(shape.body, collector);
      return;
  }
}

}  // namespace cmb
