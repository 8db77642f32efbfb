#include "mesh/contact/shared_load.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

constexpr double coupling = 1.0 - 1e-6;

enum class Bound : unsigned char { lower, free, upper };

}  // namespace

void SharedLoad::add(const Contact &contact, double same) {
  for (std::size_t i = 0; i < count_; ++i) {
    Contact &other = contacts_[i];
    if (norm(other.position - contact.position) <= same && dot(other.normal, contact.normal) > 1.0 - 1e-9) {
      if (contact.depth > other.depth) other = contact;
      return;
    }
  }
  if (count_ < capacity) {
    contacts_[count_++] = contact;
    return;
  }
  std::size_t shallowest = 0;
  for (std::size_t i = 1; i < count_; ++i) {
    if (contacts_[i].depth < contacts_[shallowest].depth) shallowest = i;
  }
  if (contact.depth > contacts_[shallowest].depth) contacts_[shallowest] = contact;
}

double SharedLoad::gram(std::size_t i, std::size_t j) const {
  return i == j ? 1.0 : coupling * dot(contacts_[i].normal, contacts_[j].normal);
}

Vec3 SharedLoad::translation() const {
  Vec3 sum;
  for (std::size_t i = 0; i < count_; ++i) sum = sum + contacts_[i].load * contacts_[i].normal;
  return sum;
}

// Active sets, as in the bounded least squares of Stark and Parker 1995.
void SharedLoad::solve() {
  std::array<double, capacity> load{};
  std::array<Bound, capacity> bound{};
  double deepest = 0.0;
  for (std::size_t i = 0; i < count_; ++i) deepest = std::fmax(deepest, contacts_[i].depth);
  const auto limit = [&](std::size_t i) { return contacts_[i].depth; };
  const double tolerance = 1e-13 * deepest;
  for (std::size_t step = 0; step < 20 * count_ + 20; ++step) {
    // Free the contact whose bound is the most wrong.
    std::size_t chosen = count_;
    double most = tolerance;
    for (std::size_t i = 0; i < count_; ++i) {
      if (bound[i] == Bound::free) continue;
      double slope = contacts_[i].depth;
      for (std::size_t j = 0; j < count_; ++j) slope -= gram(i, j) * load[j];
      const double gain = bound[i] == Bound::lower ? slope : -slope;
      if (gain > most) {
        most = gain;
        chosen = i;
      }
    }
    if (chosen == count_) break;
    bound[chosen] = Bound::free;
    for (std::size_t round = 0; round <= count_; ++round) {
      // Cholesky's solution for the free loads.
      std::array<std::size_t, capacity> index{};
      std::size_t n = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        if (bound[i] == Bound::free) index[n++] = i;
      }
      if (n == 0) break;
      std::array<std::array<double, capacity>, capacity> factor;
      std::array<double, capacity> solution{};
      for (std::size_t r = 0; r < n; ++r) {
        double value = contacts_[index[r]].depth;
        for (std::size_t j = 0; j < count_; ++j) {
          if (bound[j] == Bound::upper) value -= gram(index[r], j) * load[j];
        }
        for (std::size_t c = 0; c <= r; ++c) {
          double sum = gram(index[r], index[c]);
          for (std::size_t k = 0; k < c; ++k) sum -= factor[r][k] * factor[c][k];
          factor[r][c] = r == c ? std::sqrt(std::fmax(sum, 1e-12)) : sum / factor[c][c];
        }
        for (std::size_t k = 0; k < r; ++k) value -= factor[r][k] * solution[k];
        solution[r] = value / factor[r][r];
      }
      for (std::size_t r = n; r-- > 0;) {
        for (std::size_t k = r + 1; k < n; ++k) solution[r] -= factor[k][r] * solution[k];
        solution[r] /= factor[r][r];
      }
      // As far towards it as the bounds allow.
      double part = 1.0;
      std::size_t hit = n;
      for (std::size_t r = 0; r < n; ++r) {
        const std::size_t i = index[r];
        const double target = solution[r];
        double allowed = 1.0;
        if (target < 0.0) allowed = load[i] / (load[i] - target);
        if (target > limit(i)) allowed = (limit(i) - load[i]) / (target - load[i]);
        if (allowed < part) {
          part = allowed;
          hit = r;
        }
      }
      for (std::size_t r = 0; r < n; ++r) load[index[r]] += part * (solution[r] - load[index[r]]);
      if (hit == n) break;
      const std::size_t i = index[hit];
      bound[i] = solution[hit] < 0.0 ? Bound::lower : Bound::upper;
      load[i] = bound[i] == Bound::lower ? 0.0 : limit(i);
    }
  }
  for (std::size_t i = 0; i < count_; ++i) contacts_[i].load = std::fmin(std::fmax(load[i], 0.0), limit(i));
}

}  // namespace cmb::mesh
