#include "response/pair_laws.hpp"

#include <array>
#include <cstring>

#include "response/speed_ratio.hpp"

namespace cmb {

namespace {

// Beyond so many materials the law of a pair is combined when it is asked for.
constexpr std::size_t most_materials = 32;
constexpr std::size_t column_count = 9;

// An array of the bodies' properties: so many numbers a body; null where there is none.
struct Column {
  const double *numbers;
  std::size_t each;
};

std::array<Column, column_count> columns_of(const cmb_body_properties &p) {
  return {{{p.mass, 1},
           {p.center_of_mass, 3},
           {p.inertia, 9},
           {p.stiffness, 1},
           {p.modulus, 1},
           {p.curvature, 1},
           {p.restitution, 1},
           {p.mu_static, 1},
           {p.mu_dynamic, 1}}};
}

// What laws of pairs, and checks of bodies, look at.
LawChoices choices_of(const cmb_contact_law &law, const cmb_body_properties &properties) {
  LawChoices choices{static_cast<double>(law.normal_law),
                     static_cast<double>(law.use_restitution),
                     static_cast<double>(law.restitution_rule),
                     static_cast<double>(law.use_friction),
                     static_cast<double>(law.friction_rule),
                     law.exponent,
                     law.stribeck_speed};
  double *given = choices.data() + choices.size() - column_count;
  for (const Column &column : columns_of(properties)) *given++ = column.numbers != nullptr ? 1.0 : 0.0;
  return choices;
}

// Compared bit by bit: a number that is none is the same as itself.
bool same(const double *a, const double *b, std::size_t count) { return std::memcmp(a, b, count * sizeof *a) == 0; }

// The same without a call.
bool same_number(const double *a, const double *b) {
  std::uint64_t x = 0, y = 0;
  std::memcpy(&x, a, sizeof x);
  std::memcpy(&y, b, sizeof y);
  return x == y;
}

}  // namespace

bool PairLaws::holds(const LawChoices &choices, const CollisionFilter &filter) const {
  const std::size_t bodies = filter.body_count();
  if (!kept_ || fixed_.size() != bodies || !same(choices.data(), choices_.data(), choices.size())) return false;
  for (std::size_t body = 0; body < bodies; ++body) {
    if ((fixed_[body] != 0) != filter.fixed(body)) return false;
  }
  const double *kept = numbers_.data();
  for (const Column &column : columns_of(*properties_)) {
    if (column.numbers == nullptr) continue;
    const std::size_t count = column.each * bodies;
    if (!same(column.numbers, kept, count)) return false;
    kept += count;
  }
  return true;
}

bool PairLaws::holds_among(const LawChoices &choices, const CollisionFilter &filter,
                           const std::vector<std::uint32_t> &bodies) const {
  if (!kept_ || fixed_.size() != filter.body_count() || !same(choices.data(), choices_.data(), choices.size())) return false;
  for (const std::uint32_t body : bodies) {
    if ((fixed_[body] != 0) != filter.fixed(body)) return false;
  }
  const double *kept = numbers_.data();
  for (const Column &column : columns_of(*properties_)) {
    if (column.numbers == nullptr) continue;
    for (const std::uint32_t body : bodies) {
      for (std::size_t k = column.each * body; k < column.each * (body + 1); ++k) {
        if (!same_number(column.numbers + k, kept + k)) return false;
      }
    }
    kept += column.each * fixed_.size();
  }
  return true;
}

void PairLaws::keep(const LawChoices &choices, const CollisionFilter &filter) {
  const std::size_t bodies = filter.body_count();
  choices_ = choices;
  numbers_.clear();
  for (const Column &column : columns_of(*properties_)) {
    if (column.numbers != nullptr) numbers_.insert(numbers_.end(), column.numbers, column.numbers + column.each * bodies);
  }
  fixed_.clear();
  for (std::size_t body = 0; body < bodies; ++body) fixed_.push_back(filter.fixed(body) ? 1 : 0);
  sort_materials();
  kept_ = true;
}

// By what pair_law() reads of a body.
void PairLaws::sort_materials() {
  const cmb_body_properties &p = *properties_;
  const std::array<const double *, 6> read = {p.stiffness,   p.modulus,   p.curvature,
                                              p.restitution, p.mu_static, p.mu_dynamic};
  std::vector<std::size_t> first;  // a body of each material
  const auto alike = [&](std::size_t a, std::size_t b) {
    for (const double *numbers : read) {
      if (numbers != nullptr && !same(numbers + a, numbers + b, 1)) return false;
    }
    return true;
  };
  material_.clear();
  for (std::size_t body = 0; body < fixed_.size(); ++body) {
    std::size_t k = 0;
    while (k < first.size() && !alike(first[k], body)) ++k;
    if (k == first.size()) {
      if (k == most_materials) {
        material_.clear();
        return;
      }
      first.push_back(body);
    }
    material_.push_back(static_cast<std::uint32_t>(k));
  }
  material_count_ = first.size();
  laws_.resize(material_count_ * material_count_);
  known_.assign(laws_.size(), 0);
}

void PairLaws::prepare(const cmb_contact_law &law, const cmb_body_properties &properties, const CollisionFilter &filter) {
  check_law(law, properties);
  law_ = &law;
  properties_ = &properties;
  const LawChoices asked = choices_of(law, properties);
  if (holds(asked, filter)) return;
  kept_ = false;
  for (std::size_t body = 0; body < filter.body_count(); ++body) check_body(law, properties, body, filter.fixed(body));
  keep(asked, filter);
}

void PairLaws::prepare_among(const cmb_contact_law &law, const cmb_body_properties &properties,
                             const CollisionFilter &filter, const std::vector<std::uint32_t> &bodies) {
  law_ = &law;
  properties_ = &properties;
  if (!holds_among(choices_of(law, properties), filter, bodies)) prepare(law, properties, filter);
}

const PairLaw &PairLaws::of(std::size_t a, std::size_t b) {
  if (material_.empty()) return single_ = pair_law(*law_, *properties_, a, b, damping_);
  const std::size_t pair = material_[a] * material_count_ + material_[b];
  if (known_[pair] == 0) {
    laws_[pair] = pair_law(*law_, *properties_, a, b, damping_);
    if (needs_masses(*law_)) laws_[pair].damping.sigma = tabulate_sigma(laws_[pair].damping);
    known_[pair] = 1;
  }
  return laws_[pair];
}

}  // namespace cmb
