// Numbers of a given byte order in a buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace cmb::mesh {

// Walks over bytes that it borrows. Callers ask left() before they read.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  std::size_t left() const { return bytes_.size() - position_; }
  std::size_t position() const { return position_; }
  void skip(std::size_t count) { position_ += count; }

  // sizeof(Number) <= left().
  template <typename Number>
  Number read() {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[position_ + i]);
      const std::size_t place = big_endian_ ? sizeof(Number) - 1 - i : i;
      bits |= std::uint64_t{byte} << (8 * place);
    }
    position_ += sizeof(Number);
    if constexpr (std::is_same_v<Number, double>) {
      double value;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    } else if constexpr (std::is_same_v<Number, float>) {
      const auto low = static_cast<std::uint32_t>(bits);
      float value;
      std::memcpy(&value, &low, sizeof value);
      return value;
    } else {
      return static_cast<Number>(bits);
    }
  }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  bool big_endian_;
};

}  // namespace cmb::mesh
