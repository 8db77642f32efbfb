#include "mesh/contact/rod_load.hpp"

#include <cmath>

#include "manifold/rod_end_share.hpp"

namespace cmb::mesh {

namespace {

constexpr double coupling = 1.0 - 1e-9;
// Places and normals that differ by less are one.
constexpr double same = 1e-11;
constexpr double most_loads = 6.0;

double product(const std::array<double, 6> &a, const std::array<double, 6> &b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 6; ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

void RodLoad::clear(const Vec3 &axis) {
  axis_ = axis;
  contacts_.clear();
}

void RodLoad::add(double part, const Vec3 &normal, double depth, double share) {
  if (!(depth > 0.0) || !(share > 0.0)) return;
  Contact contact;
  contact.part = contact.place = part;
  contact.depth = depth;
  contact.need = share * depth;
  contact.normal = normal;
  const double to_near = std::sqrt(2.0) * (1.0 - part), to_far = std::sqrt(2.0) * part;
  for (int k = 0; k < 3; ++k) {
    contact.feature[static_cast<std::size_t>(k)] = to_near * normal[k];
    contact.feature[static_cast<std::size_t>(k) + 3] = to_far * normal[k];
  }
  contact.norm2 = to_near * to_near + to_far * to_far;
  // Neighbouring features begin where others end.
  for (std::size_t i = contacts_.size(); i-- > 0 && contacts_.size() - i <= 16;) {
    Contact &other = contacts_[i];
    if (std::fabs(other.part - part) > same || norm2(other.normal - normal) > same * same) continue;
    if (contact.need > other.need) other = contact;
    return;
  }
  contacts_.push_back(contact);
}

// The loads of the active contacts, were they all free: Cholesky's method.
bool RodLoad::solve_active(std::size_t count, std::array<double, most_active> &solution) const {
  std::array<std::array<double, most_active>, most_active> factor;
  bool positive = true;
  for (std::size_t r = 0; r < count; ++r) {
    const Contact &row = contacts_[active_[r]];
    double value = needs_[active_[r]];
    for (std::size_t c = 0; c <= r; ++c) {
      double sum = r == c ? row.norm2 : coupling * product(row.feature, contacts_[active_[c]].feature);
      for (std::size_t k = 0; k < c; ++k) sum -= factor[r][k] * factor[c][k];
      factor[r][c] = r == c ? std::sqrt(std::fmax(sum, 1e-14 * row.norm2)) : sum / factor[c][c];
    }
    for (std::size_t k = 0; k < r; ++k) value -= factor[r][k] * solution[k];
    solution[r] = value / factor[r][r];
  }
  for (std::size_t r = count; r-- > 0;) {
    for (std::size_t k = r + 1; k < count; ++k) solution[r] -= factor[k][r] * solution[k];
    solution[r] /= factor[r][r];
    positive = positive && solution[r] > 0.0;
  }
  return positive;
}

// Loads for needs that are the less the shallower a contact is: by `relief` |phi|^2 / need. Returns what `most_loads` limits.
// Nonnegative least squares by active sets (Lawson and Hanson, Solving Least Squares Problems, chapter 23).
double RodLoad::solve_with(double relief) {
  double greatest = 0.0;
  needs_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    needs_.push_back(need(i, relief));
    greatest = std::fmax(greatest, needs_[i]);
    contacts_[i].load = 0.0;
  }
  is_active_.assign(contacts_.size(), 0);
  std::size_t count = 0;
  std::array<double, 6> moved{};
  const double tolerance = 1e-13 * greatest;
  for (std::size_t step = 0; step < 4 * contacts_.size() + 20 && count < most_active; ++step) {
    std::size_t chosen = contacts_.size();
    double most = tolerance;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (is_active_[i] != 0 || needs_[i] <= most) continue;
      const double gain = needs_[i] - coupling * product(contacts_[i].feature, moved);
      if (gain > most) {
        most = gain;
        chosen = i;
      }
    }
    if (chosen == contacts_.size()) break;
    is_active_[chosen] = 1;
    active_[count++] = chosen;
    std::array<double, most_active> solution{};
    while (!solve_active(count, solution)) {
      // As far towards it as no load turns negative.
      double part = 1.0;
      for (std::size_t r = 0; r < count; ++r) {
        const double load = contacts_[active_[r]].load;
        if (!(solution[r] > 0.0)) part = std::fmin(part, load > 0.0 ? load / (load - solution[r]) : 0.0);
      }
      std::size_t kept = 0;
      for (std::size_t r = 0; r < count; ++r) {
        Contact &contact = contacts_[active_[r]];
        const double before = contact.load;
        contact.load += part * (solution[r] - before);
        const bool leaves = !(solution[r] > 0.0) && (!(before > 0.0) || before / (before - solution[r]) <= part);
        if (leaves) {
          contact.load = 0.0;
          is_active_[active_[r]] = 0;
        } else {
          active_[kept++] = active_[r];
        }
      }
      count = kept;
    }
    moved = {};
    for (std::size_t r = 0; r < count; ++r) {
      Contact &contact = contacts_[active_[r]];
      contact.load = solution[r];
      for (std::size_t k = 0; k < 6; ++k) moved[k] += contact.load * contact.feature[k];
    }
  }
  double loads = 0.0;
  for (std::size_t r = 0; r < count; ++r) {
    const Contact &contact = contacts_[active_[r]];
    loads += contact.load * contact.norm2 / contact.need;
  }
  return loads;
}

void RodLoad::solve() {
  if (!contacts_.empty() && solve_with(0.0) > most_loads) {
    // The sum falls with the relief, and is 0 where that leaves no need.
    double less = 0.0, more = 0.0;
    for (const Contact &contact : contacts_) more = std::fmax(more, contact.need * contact.need / contact.norm2);
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (less + more);
      if (!(middle > less) || !(middle < more)) break;
      (solve_with(middle) > most_loads ? less : more) = middle;
    }
    solve_with(more);
  }
  share_by_inclination();
}

void RodLoad::share_by_inclination() {
  missing_ = {};
  for (Contact &contact : contacts_) {
    if (!(contact.load > 0.0)) continue;
    const double sine = dot(axis_, contact.normal), limited = std::fmin(1.0, std::fmax(-1.0, -sine));
    const double side = 2.0 * contact.part - 1.0;  // -1 at one end, 1 at the other
    missing_ = missing_ + (0.5 * contact.load * contact.need * side * end_share_slope(limited)) * (axis_ - sine * contact.normal);
    // Parts 1 - part and part of the load are taken to the ends and shared there: force and moment are those of one place.
    const double difference = end_share_difference(limited), sum = 1.0 + side * difference;
    contact.load *= sum;
    if (sum > 0.0) contact.place = contact.part * (1.0 + difference) / sum;
  }
}

}  // namespace cmb::mesh
