// Numbers in texts that people write.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace cmb::mesh {

// The whole of `word` as a number, with one sign at most, which may be a plus. Gives std::errc() where it is one,
// result_out_of_range where `Value` cannot hold it, invalid_argument else; infinity and NaN are numbers.
template <typename Value>
std::errc parse_number(std::string_view word, Value &value) {
  if (!word.empty() && word[0] == '+') {
    word.remove_prefix(1);
    if (!word.empty() && word[0] == '-') return std::errc::invalid_argument;
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return end == word.data() + word.size() || error != std::errc() ? error : std::errc::invalid_argument;
}

}  // namespace cmb::mesh
