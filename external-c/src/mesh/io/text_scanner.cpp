#include "mesh/io/text_scanner.hpp"

#include <cmath>

#include "mesh/io/number_text.hpp"

namespace cmb::mesh {

namespace {

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > longest ? "...'" : "'");
}

}  // namespace

void TextScanner::skip_blanks() {
  while (position_ < text_.size() &&
         (text_[position_] == ' ' || text_[position_] == '\t' || text_[position_] == '\v' || text_[position_] == '\f')) {
    ++position_;
  }
}

std::string_view TextScanner::word() {
  skip_blanks();
  const std::size_t begin = position_;
  while (!at_line_end() && text_[position_] != ' ' && text_[position_] != '\t' && text_[position_] != '\v' &&
         text_[position_] != '\f') {
    ++position_;
  }
  return text_.substr(begin, position_ - begin);
}

std::string_view TextScanner::word_of_any_line() {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty() || !next_line()) return found;
  }
}

bool TextScanner::next_line() {
  while (!at_line_end()) ++position_;
  if (position_ >= text_.size()) return false;
  position_ += text_[position_] == '\r' && position_ + 1 < text_.size() && text_[position_ + 1] == '\n' ? 2 : 1;
  ++line_;
  return true;
}

double TextScanner::number(std::string_view word) const {
  double value = 0.0;
  if (word.empty()) fail("a number is missing", "the file is damaged or cut short: export it again");
  if (parse_number(word, value) != std::errc() || !std::isfinite(value)) {
    fail(quoted(word) + " is not a finite number", "the file is damaged: export it again");
  }
  return value;
}

std::int64_t TextScanner::whole_number(std::string_view word) const {
  std::int64_t value = 0;
  if (word.empty()) fail("a number is missing", "the file is damaged or cut short: export it again");
  if (parse_number(word, value) != std::errc()) fail(quoted(word) + " is not a whole number", "the file is damaged: export it again");
  return value;
}

void TextScanner::fail(const std::string &problem, const std::string &remedy) const {
  throw MeshError(source_, "line " + std::to_string(line_) + ": " + problem, remedy);
}

}  // namespace cmb::mesh
