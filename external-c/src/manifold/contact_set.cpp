#include "manifold/contact_set.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"

namespace cmb {

double total_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  double load = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) load += points[i].weight * points[i].depth;
  return load;
}

Vec3 net_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  Vec3 sum;
  for (std::size_t k = begin; k < points.size(); ++k) sum = sum + (points[k].weight * points[k].depth) * points[k].normal;
  return sum;
}

namespace {

// Of so many points the best of all pairs is united.
constexpr std::size_t points_for_all_pairs = 16;

double load_of(const ContactPoint &point) { return point.weight * point.depth; }

// What uniting two loads adds to the second moment of the load that is lost.
double union_cost(double load_a, double load_b, double distance2) {
  return load_a * load_b / (load_a + load_b) * distance2;
}

void unite(ContactPoint &point, const ContactPoint &other) {
  const double load = load_of(point), other_load = load_of(other), sum = load + other_load;
  const double part = other_load / sum;
  // By load: corners of hardly any depth would drag a mean by weight to the surface. Rounding leaves it between the two depths.
  const double least = std::fmin(point.depth, other.depth);
  point.depth = std::fmax(least, point.depth + part * (other.depth - point.depth));
  point.weight = sum / point.depth;
  point.position = point.position + part * (other.position - point.position);
  const Vec3 turn = other.normal - point.normal;
  if (turn.x == 0.0 && turn.y == 0.0 && turn.z == 0.0) return;  // as on a plane
  point.normal = normalized(point.normal + part * turn, point.normal);
}

// Loads as columns: what uniting one of them with each of the others costs is found for all at once. Borrows four columns of `room`.
class LoadColumns {
 public:
  LoadColumns(double *room, std::size_t most) : load_(room), x_(load_ + most), y_(x_ + most), z_(y_ + most) {}
  void note(std::size_t i, const ContactPoint &point) {
    load_[i] = load_of(point);
    x_[i] = point.position.x, y_[i] = point.position.y, z_[i] = point.position.z;
  }
  // Of load i with each of the first ones.
  void find_costs(std::size_t i, std::size_t count, double *cost) const {
    find_costs(load_[i], {x_[i], y_[i], z_[i]}, count, load_, x_, y_, z_, cost);
  }
  void find_costs(const ContactPoint &point, std::size_t count, double *cost) const {
    find_costs(load_of(point), point.position, count, load_, x_, y_, z_, cost);
  }

 private:
  // Of arrays that do not overlap compilers make vectors.
  static void find_costs(double load, const Vec3 &at, std::size_t count, const double *__restrict loads, const double *__restrict x,
                         const double *__restrict y, const double *__restrict z, double *__restrict cost) {
    const double at_x = at.x, at_y = at.y, at_z = at.z;
    for (std::size_t k = 0; k < count; ++k) {
      const double dx = at_x - x[k], dy = at_y - y[k], dz = at_z - z[k];
      cost[k] = union_cost(load, loads[k], dx * dx + dy * dy + dz * dz);
    }
  }

  double *load_, *x_, *y_, *z_;
};

// The first place of the least of `count` values.
std::size_t place_of(double least, const double *values, std::size_t count) {
  std::size_t place = 0;
  while (place + 1 < count && values[place] != least) ++place;
  return place;
}

// Leaves the `capacity` points of greatest load; each of the others is united with the one that is cheapest.
void keep_heaviest(std::vector<ContactPoint> &points, std::size_t capacity) {
  // What is sorted is less to move about than the points are.
  struct Key {
    double load;
    std::size_t place;
  };
  struct Room {
    std::vector<Key> order;
    std::vector<ContactPoint> heaviest;
    std::vector<double> columns;  // four, and one of costs
  };
  static thread_local Room room;
  room.order.clear();
  for (std::size_t k = 0; k < points.size(); ++k) room.order.push_back({load_of(points[k]), k});
  std::sort(room.order.begin(), room.order.end(), [](const Key &x, const Key &y) { return x.load > y.load; });
  if (room.columns.size() < 5 * capacity) room.columns.resize(5 * capacity);
  LoadColumns columns(room.columns.data(), capacity);
  double *const costs = room.columns.data() + 4 * capacity;
  room.heaviest.clear();
  for (std::size_t i = 0; i < capacity; ++i) {
    room.heaviest.push_back(points[room.order[i].place]);
    columns.note(i, room.heaviest[i]);
  }
  for (std::size_t k = capacity; k < points.size(); ++k) {
    const ContactPoint &point = points[room.order[k].place];
    columns.find_costs(point, capacity, costs);
    const std::size_t partner = place_of(convex::least_of(costs, capacity), costs, capacity);
    unite(room.heaviest[partner], point);
    columns.note(partner, room.heaviest[partner]);
  }
  points.assign(room.heaviest.begin(), room.heaviest.end());
}

// Finds the cheapest pair again and again. What uniting costs is kept for all pairs, of each point with those before it, and the least
// of each; beyond these nothing is cheap, so that rows are of one length.
class CheapestPair {
 public:
  explicit CheapestPair(std::vector<ContactPoint> &points) : points_(points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      columns_.note(i, points[i]);
      columns_.find_costs(i, i, cost_[i]);
      std::fill(cost_[i] + i, cost_[i] + points_for_all_pairs, HUGE_VAL);
      least_[i] = least_of_row(i);
    }
    std::fill(least_ + points.size(), least_ + points_for_all_pairs, HUGE_VAL);
  }

  // Unites pairs until `capacity` points are left.
  void unite_cheapest(std::size_t capacity) {
    for (;;) {
      const std::size_t second = place_of(convex::least_of(least_, points_for_all_pairs), least_, points_.size());
      const std::size_t first = place_of(least_[second], cost_[second], second);
      unite(points_[first], points_[second]);
      points_[second] = points_.back();
      points_.pop_back();
      const std::size_t count = points_.size();
      if (count <= capacity) return;
      least_[count] = HUGE_VAL;
      renew(first);
      if (second < count) renew(second);
      for (std::size_t i = first; i < count; ++i) least_[i] = least_of_row(i);
    }
  }

 private:
  double least_of_row(std::size_t i) const { return convex::least_of(cost_[i], points_for_all_pairs); }
  void renew(std::size_t i) {
    double costs[points_for_all_pairs];
    columns_.note(i, points_[i]);
    columns_.find_costs(i, points_.size(), costs);
    for (std::size_t k = 0; k < i; ++k) cost_[i][k] = costs[k];
    for (std::size_t k = i + 1; k < points_.size(); ++k) cost_[k][i] = costs[k];
  }

  std::vector<ContactPoint> &points_;
  double room_[4 * points_for_all_pairs];
  LoadColumns columns_{room_, points_for_all_pairs};
  double cost_[points_for_all_pairs][points_for_all_pairs], least_[points_for_all_pairs];
};

}  // namespace

void merge_surplus(std::vector<ContactPoint> &points, std::size_t capacity) {
  const std::size_t most = std::max(capacity, points_for_all_pairs);
  if (points.size() > most) keep_heaviest(points, most);
  if (points.size() <= capacity) return;
  CheapestPair(points).unite_cheapest(capacity);
}

}  // namespace cmb
