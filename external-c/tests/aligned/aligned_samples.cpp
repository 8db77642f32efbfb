#include "aligned_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "support/scene_query.hpp"

namespace cmb::aligned {

namespace {

using test::BodyPose;
using test::Contact;
using test::PairScene;
using test::product;
using test::rotation_about;

constexpr std::size_t capacity = 512;
constexpr double pi = 3.14159265358979323846, rounding = 2.2e-16;

struct Bodies {
  Body a, b;
  std::unique_ptr<PairScene> pair, exchanged;
  double size, thickness, least_depth;

  Bodies(const KindPair &kinds, std::uint64_t seed) {
    Random random(seed);
    a = kinds.a->make(random);
    b = kinds.b->make(random);
    pair = std::make_unique<PairScene>(a.text, b.text);
    exchanged = std::make_unique<PairScene>(b.text, a.text);
    size = std::min(a.size, b.size);
    thickness = std::min(a.thickness, b.thickness);
    least_depth = std::max(kinds.a->least_depth, kinds.b->least_depth);
  }
  ~Bodies() {
    cmb_release_scene(pair->handle());
    cmb_release_scene(exchanged->handle());
  }
};

template <typename T>
const T &any_of(const std::vector<T> &list, Random &random) {
  return list[static_cast<std::size_t>(random.integer(0, static_cast<int>(list.size()) - 1))];
}

// Columns: along `way` as far as it is perpendicular to `up`, across both, `up`.
Mat3 frame_of(const Vec3 &way, const Vec3 &up) {
  const Vec3 first = normalized(way - dot(way, up) * up), second = cross(up, first);
  return transposed(Mat3{{first, second, up}});
}

// One of a body's ways that is not along `up`.
Vec3 way_across(const Body &body, const Vec3 &up, Random &random) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Vec3 &way = any_of(body.ways, random);
    if (norm(cross(way, up)) > 0.1) return way;
  }
  return convex::any_perpendicular(up);
}

// Entries that are 0 or 1 but for rounding are that.
Mat3 snapped(Mat3 rotation) {
  for (Vec3 &row : rotation.row) {
    for (int k = 0; k < 3; ++k) {
      if (std::fabs(row[k] - std::round(row[k])) < 1e-14) row.set(k, std::round(row[k]));
    }
  }
  return rotation;
}

double reach_of(const Body &body, const Vec3 &d) {
  double most = -HUGE_VAL;
  for (const Part &part : body.parts) most = std::max(most, reach(part, d));
  return most;
}

// A beside B, which is at rest in the origin.
struct Placed {
  BodyPose pose;
  Vec3 way;           // out of B
  double off = 0.0;   // by what it is disturbed
};

Placed place_once(const Bodies &bodies, Random &random) {
  const Feature &on_b = any_of(bodies.b.features, random), &on_a = any_of(bodies.a.features, random);
  const Vec3 n = on_b.outward, across = way_across(bodies.b, n, random);
  const Mat3 frame = frame_of(across, n);
  // A's feature looks down, one of its ways along B's or at half a right angle.
  const Mat3 own = frame_of(way_across(bodies.a, on_a.outward, random), -on_a.outward);
  const Mat3 spin = rotation_about({0, 0, 1}, random.integer(0, 2) > 0 ? 0.0 : 0.25 * pi * random.integer(0, 7));
  Mat3 rotation = product(product(frame, spin), transposed(own));
  if (random.integer(0, 3) == 0) {  // rather axes along axes
    for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      rotation = product(rotation_about(axis, 0.5 * pi * random.integer(0, 3)), rotation);
    }
  }
  if (random.integer(0, 1) == 0) rotation = snapped(rotation);
  Vec3 position;
  for (const int k : {0, 1}) {  // something of A over something of B
    const Vec3 axis = frame.column(k);
    const Vec3 on_other = random.integer(0, 3) == 0 ? Vec3{} : any_of(bodies.b.features, random).place;
    const Vec3 own_place = random.integer(0, 3) == 0 ? Vec3{} : any_of(bodies.a.features, random).place;
    double aside = dot(axis, on_other - rotation * own_place);
    if (random.integer(0, 4) == 0) aside += random.uniform(-0.3, 0.3) * bodies.size;
    position = position + aside * axis;
  }
  Placed placed{{}, n};
  const double deep = bodies.thickness * random.log_uniform(bodies.least_depth, 0.1) * (random.integer(0, 9) == 0 ? -1.0 : 1.0);
  const double up = dot(n, on_b.place) - deep + reach_of(bodies.a, -transposed_times(rotation, n));
  position = position + up * n;
  if (random.integer(0, 1) == 0) {
    placed.off = random.log_uniform(1e-15, 1e-9);
    position = position + placed.off * random.direction();
    rotation = product(rotation_about(random.direction(), placed.off), rotation);
  }
  placed.pose = {position, rotation};
  return placed;
}

// Mostly one in which they touch.
Placed place(const Bodies &bodies, Random &random) {
  for (int attempt = 0;; ++attempt) {
    const Placed placed = place_once(bodies, random);
    const double distance = bodies.pair->query(placed.pose, {}, capacity).distance;
    if (attempt == 10 || (distance < 0.0 && distance > -0.3 * bodies.thickness) || random.integer(0, 19) == 0) return placed;
  }
}

bool is_revolved(const Kind *kind) { return std::string(kind->name) == "cylinder" || std::string(kind->name) == "cone"; }

double carried(const Contact &contact) {
  double load = 0.0;
  for (const test::Point &point : contact.points) load += point.weight * point.depth;
  return load;
}

BodyPose moved_by(const BodyPose &frame, const BodyPose &pose) {
  return {frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
}

// By how far the body moves, turns about where the contact is.
BodyPose beside(const BodyPose &pose, const Vec3 &about, const Vec3 &shift, const Vec3 &turn) {
  const double angle = norm(turn);
  const Mat3 rotation = angle > 0.0 ? rotation_about((1.0 / angle) * turn, angle) : Mat3{};
  return {about + rotation * (pose.position - about) + shift, product(rotation, pose.rotation)};
}

// One pose with what is asked of it. Errors are by what is allowed: more than 1 fails.
class Check {
 public:
  Check(const Bodies &bodies, const KindPair &kinds, const Placed &placed, Random &random)
      : bodies_(bodies), kinds_(kinds), pose_(placed.pose), way_(placed.way), off_(placed.off), random_(random),
        contact_(bodies.pair->query(pose_, {}, capacity)), load_(carried(contact_)), deep_(-contact_.distance) {
    Vec3 sum;
    for (const test::Point &point : contact_.points) sum = sum + (point.weight * point.depth) * point.position;
    about_ = load_ > 0.0 ? (1.0 / load_) * sum : pose_.position;
  }

  bool is_apart() const { return !(deep_ > 1e-13 * (bodies_.size + norm(pose_.position))); }
  // So deep as no sample is meant to be, in another part of B; or hardly at all, as it is hardly beside it.
  // A sheet has no far side: what it has swallowed to the middle is no contact any more.
  bool is_swallowed() const { return bodies_.b.swallows && bodies_.b.swallows(pose_.position); }
  bool is_left_out() const { return is_swallowed() || deep_ > 0.3 * bodies_.thickness || (deep_ > 0.0 && deep_ < 0.3 * bodies_.least_depth * bodies_.thickness); }
  double deep() const { return deep_; }
  const Contact &contact() const { return contact_; }
  const BodyPose &pose() const { return pose_; }

  double error(Property property) {
    switch (property) {
      case Property::same_in_frames: return of_frames();
      case Property::same_exchanged: return of_exchange();
      case Property::gradient: return of_gradient();
      case Property::steady: return of_neighbours();
      case Property::near_bodies: return of_places();
      case Property::found: return of_load();
      case Property::apart: return 0.0;
    }
    return 0.0;
  }
  double error_apart() const { return deep_ < 0.0 && load_ > 0.0 ? HUGE_VAL : 0.0; }

 private:
  // What errors are measured by: the load, or a small part of what it would be at this depth.
  double scale() const { return load_ + 1e-3 * deep_; }
  // What rounding of the pose may change, as a part.
  double of_rounding(double shift) const { return 300.0 * shift * (bodies_.size + norm(pose_.position)) / deep_; }

  double difference(const Vec3 &load, const Vec3 &moment) const {
    return (norm(load - contact_.load()) + norm(moment - contact_.moment(about_)) / bodies_.size) / scale();
  }
  double of_frames() {
    double worst = 0.0;
    for (int k = 0; k < 3; ++k) {
      const BodyPose frame{{random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)}, random_bodies::random_rotation(random_)};
      const Contact there = bodies_.pair->query(moved_by(frame, pose_), frame, capacity);
      const Vec3 load = transposed_times(frame.rotation, there.load());
      const Vec3 moment = transposed_times(frame.rotation, there.moment(frame.rotation * about_ + frame.position));
      worst = std::max(worst, difference(load, moment));
    }
    return worst / (1e-9 + of_rounding(rounding));
  }
  double of_exchange() const {
    const Contact there = bodies_.exchanged->query({}, pose_, capacity);
    // Between two bodies of revolution whose edges are not the same ones.
    const bool both_revolved = is_revolved(kinds_.a) && is_revolved(kinds_.b);
    return difference(-there.load(), -there.moment(about_)) / ((both_revolved ? 1e-6 : 1e-9) + of_rounding(rounding));
  }
  double of_gradient() {
    // Rounding of the energy by what steps change, and steps by which energies have no edge beside the pose.
    const double step = 1e-3 * deep_;
    if (!(deep_ > 1e-8 * bodies_.size) || off_ > 1e-3 * step) return 0.0;
    double worst = 0.0;
    const double energy = contact_.energy();
    const Mat3 frame = frame_of(convex::any_perpendicular(way_), way_);
    const Vec3 ways[] = {frame.column(0), frame.column(1), way_, random_.direction()};
    for (const bool turns : {false, true}) {
      for (const Vec3 &way : ways) {
        const double reach = turns ? bodies_.size : 1.0;
        const auto energy_at = [&](double length) {
          const Vec3 motion = (length / reach) * way;
          return bodies_.pair->query(turns ? beside(pose_, about_, {}, motion) : beside(pose_, about_, motion, {}), {}, capacity).energy();
        };
        const double slope = -dot(way, turns ? contact_.moment(about_) : contact_.load()) / reach;
        const double after = (energy_at(step) - energy) / step, before = (energy - energy_at(-step)) / step;
        const double low = std::min(after, before), high = std::max(after, before);
        worst = std::max(worst, std::max(low - slope, slope - high) / scale());
      }
    }
    return worst / (1e-3 + of_rounding(1e-13));
  }
  double of_neighbours() {
    const double shift = std::max(1e-14, 1e-6 * deep_);
    double worst = 0.0;
    for (int k = 0; k < 8; ++k) {
      Vec3 motion = random_.direction(), turn = random_.direction();
      if (k < 3) turn = {};
      if (k == 3) motion = {};
      const Contact there = bodies_.pair->query(beside(pose_, about_, shift * motion, (shift / bodies_.size) * turn), {}, capacity);
      worst = std::max(worst, difference(there.load(), there.moment(about_)));
    }
    return worst / (1e-4 + of_rounding(shift / 3.0));
  }
  double of_places() const {
    const bool of_a = kinds_.b->ground || bodies_.a.radius <= bodies_.b.radius;
    const Vec3 middle = of_a ? pose_.position + pose_.rotation * bodies_.a.middle : bodies_.b.middle;
    double farthest = 0.0;
    for (const test::Point &point : contact_.points) {
      if (point.weight * point.depth > 1e-9 * load_) farthest = std::max(farthest, norm(point.position - middle));
    }
    return farthest / (1.6 * (of_a ? bodies_.a.radius : bodies_.b.radius));
  }
  double of_load() const {
    if (!(load_ > 0.0)) return HUGE_VAL;
    return load_ / (10.0 * deep_);
  }

  const Bodies &bodies_;
  const KindPair &kinds_;
  const BodyPose pose_;
  const Vec3 way_;
  const double off_;
  Random &random_;
  const Contact contact_;
  const double load_, deep_;
  Vec3 about_;
};

constexpr int bodies_a_pair = 24;

std::uint64_t body_seed(std::uint64_t seed, int pose) { return seed * 1000003u + static_cast<std::uint64_t>(pose % bodies_a_pair); }
std::uint64_t pose_seed(std::uint64_t seed, int pose) { return (seed << 24) + static_cast<std::uint64_t>(pose) + 1; }

}  // namespace

std::vector<KindPair> all_pairs() {
  std::vector<KindPair> pairs;
  for (std::size_t i = 0; i < all_kinds().size(); ++i) {
    for (std::size_t j = i; j < all_kinds().size(); ++j) {
      const Kind *a = &all_kinds()[i], *b = &all_kinds()[j];
      if (a->ground && b->ground) continue;
      if (a->ground) std::swap(a, b);
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

const char *name_of(Property property) {
  static const char *const names[property_count] = {"frames", "exchanged", "gradient", "steady", "places", "found", "apart"};
  return names[static_cast<int>(property)];
}

const KnownFailure *known_failure(const KindPair &kinds, Property property) {
  // The first that fits.
  static const KnownFailure known[] = {
      // What passes through a body pushes; places where the energy would pull, torque beside little load, bodies deeper than half of what is behind a
      // triangle; a side in the plane in which a field ends.
      {"any", "field", Property::same_in_frames, 0.01},
      {"any", "field", Property::gradient, 0.015},
      {"any", "field", Property::steady, 0.02},
      {"any", "field", Property::near_bodies, 0.01},
      {"any", "angle-mesh", Property::same_in_frames, 0.01},
      {"any", "angle-mesh", Property::gradient, 5e-3},
      {"any", "angle-mesh", Property::steady, 5e-3},
      {"any", "angle-mesh", Property::near_bodies, 0.01},
      {"cone", "box-mesh", Property::same_in_frames, 0.01},
      {"any", "box-mesh", Property::gradient, 5e-3},
      {"any", "box-mesh", Property::near_bodies, 0.01},
      {"any", "ball-mesh", Property::same_in_frames, 0.01},
      {"any", "ball-mesh", Property::gradient, 0.01},
      // Sides a few degrees apart fade into each other, which is not the same with the bodies exchanged: by up to 2e-3 of the load.
      {"box", "hull", Property::same_exchanged, 2e-3},
      {"prism", "hull", Property::same_exchanged, 2e-3},
      {"hull", "hull", Property::same_exchanged, 2e-3},
      {"prism", "hull", Property::gradient, 2e-3},
      {"hull", "hull", Property::gradient, 2e-3},
      // Edges along edges, 1e-7 deep and turned by 1e-10: known to 3e-5 of the load.
      {"prism", "prism", Property::same_in_frames, 2e-3},
      {"prism", "prism", Property::same_exchanged, 2e-3},
      // Less than 1e-8 of the radius deep an overlap of curved sides is found by another way, or not, where rounding of the pose decides.
      {"cylinder", "cylinder", Property::same_in_frames, 0.02},
      {"cylinder", "cylinder", Property::same_exchanged, 0.1},
      {"cylinder", "cone", Property::same_in_frames, 0.04},
      {"cylinder", "cone", Property::same_exchanged, 0.2},
      {"cone", "cone", Property::same_in_frames, 0.05},
      {"cone", "cone", Property::same_exchanged, 0.25},
      {"cone", "any", Property::same_in_frames, 0.03},
      {"cone", "any", Property::same_exchanged, 0.01},
      {"cone", "any", Property::gradient, 0.01},
      {"cone", "any", Property::steady, 0.03},
      {"cylinder", "any", Property::same_in_frames, 0.01},
      {"cylinder", "any", Property::same_exchanged, 0.01},
      {"cylinder", "any", Property::steady, 0.01},
      // Contact directions have no energy.
      {"ellipsoid", "any", Property::same_exchanged, 0.01},
      {"ellipsoid", "any", Property::gradient, 0.01},
  };
  const auto is = [](const char *name, const Kind *kind) { return std::string(name) == "any" || kind->name == std::string(name); };
  for (const KnownFailure &failure : known) {
    const bool of_pair = (is(failure.a, kinds.a) && is(failure.b, kinds.b)) || (is(failure.a, kinds.b) && is(failure.b, kinds.a));
    if (of_pair && property == failure.property) return &failure;
  }
  return nullptr;
}

Tally sample_aligned(const KindPair &kinds, int poses, std::uint64_t seed) {
  std::vector<std::unique_ptr<Bodies>> bodies;
  for (int k = 0; k < std::min(poses, bodies_a_pair); ++k) bodies.push_back(std::make_unique<Bodies>(kinds, body_seed(seed, k)));
  Tally tally;
  for (int pose = 0; pose < poses; ++pose) {
    const Bodies &pair = *bodies[static_cast<std::size_t>(pose % bodies_a_pair)];
    Random random(pose_seed(seed, pose));
    const Placed placed = place(pair, random);
    Check check(pair, kinds, placed, random);
    const auto count = [&](Property property, double error) {
      Tally::Failures &failures = tally.of[static_cast<int>(property)];
      if (!(error <= 1.0)) ++failures.count, failures.poses.push_back({pose, error});
      if (!(error <= failures.worst)) failures.worst = error, failures.worst_pose = pose;
    };
    if (check.is_left_out()) continue;
    if (check.is_apart()) {
      ++tally.apart;
      count(Property::apart, check.error_apart());
      continue;
    }
    ++tally.poses;
    for (int k = 0; k < property_count - 1; ++k) count(static_cast<Property>(k), check.error(static_cast<Property>(k)));
  }
  return tally;
}

std::string describe(const KindPair &kinds, std::uint64_t seed, int pose) {
  const Bodies pair(kinds, body_seed(seed, pose));
  Random random(pose_seed(seed, pose));
  const Placed placed = place(pair, random);
  Check check(pair, kinds, placed, random);
  std::ostringstream out;
  out.precision(17);
  const auto put = [&out](const char *name, const Vec3 &v) { out << name << v.x << ", " << v.y << ", " << v.z << "\n"; };
  out << pair.a.text << "\n" << pair.b.text << "\n";
  put("position ", placed.pose.position);
  for (const Vec3 &row : placed.pose.rotation.row) put("row ", row);
  out << "off " << placed.off << " deep " << check.deep() << "\n";
  for (const test::Point &point : check.contact().points) {
    out << "point: depth " << point.depth << " weight " << point.weight << "\n";
    put("  normal ", point.normal);
    put("  position ", point.position);
  }
  put("load ", check.contact().load());
  put("moment about B ", check.contact().moment({}));
  const Contact exchanged = pair.exchanged->query({}, placed.pose, capacity);
  out << "exchanged: deep " << -exchanged.distance << "\n";
  put("  load ", exchanged.load());
  put("  moment ", exchanged.moment({}));
  if (check.is_apart()) return out.str();
  for (int k = 0; k < 3; ++k) {
    const BodyPose frame{0.5 * random.direction(), random_bodies::random_rotation(random)};
    const Contact there = pair.pair->query(moved_by(frame, placed.pose), frame, capacity);
    out << "in another frame: points " << there.points.size() << " energy " << there.energy() << " deep " << -there.distance << "\n";
    put("  load ", transposed_times(frame.rotation, there.load()));
  }
  out << "energy " << check.contact().energy() << "\n";
  for (int k = 0; k < property_count - 1; ++k) {
    out << name_of(static_cast<Property>(k)) << " " << check.error(static_cast<Property>(k)) << "\n";
  }
  return out.str();
}

}  // namespace cmb::aligned
