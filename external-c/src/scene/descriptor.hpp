// Descriptor strings: text to shapes.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scene/shape.hpp"

namespace cmb {

// Limits that keep untrusted descriptors from exhausting memory or time.
struct DescriptorLimits {
  static constexpr std::size_t characters = 4u << 20;
  static constexpr std::size_t shapes = 1024;
  static constexpr std::size_t hull_points = 8192;
  static constexpr double smallest_length = 1e-9;  // m
  static constexpr double largest_length = 1e9;    // m
};

// What is wrong with a descriptor: 1-based column, and a text that says what is wrong and what to do.
class DescriptorError : public std::runtime_error {
 public:
  DescriptorError(std::size_t column, const std::string &what) : std::runtime_error(what), column_(column) {}
  std::size_t column() const { return column_; }

 private:
  std::size_t column_;
};

// The shapes a descriptor names; none for a blank descriptor. Throws DescriptorError, std::bad_alloc.
BodyShapes parse_descriptor(std::string_view text);

}  // namespace cmb
