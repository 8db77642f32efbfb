// Lines and words of a text file, with what its errors need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// Walks over text that it borrows. Ends of lines: LF, CR LF or CR.
class TextScanner {
 public:
  TextScanner(std::string_view text, const std::string &source, std::size_t first_line = 1)
      : text_(text), source_(source), line_(first_line) {}

  // The next word of the current line; empty at its end.
  std::string_view word();
  // The next word, over line ends; empty at the text's end.
  std::string_view word_of_any_line();
  // To the next line; false at the text's end.
  bool next_line();
  std::size_t line() const { return line_; }
  std::size_t position() const { return position_; }

  // The word's value; MeshError, naming the line, where it is no finite number or no whole number.
  double number(std::string_view word) const;
  std::int64_t whole_number(std::string_view word) const;

  [[noreturn]] void fail(const std::string &problem, const std::string &remedy) const;

 private:
  bool at_line_end() const { return position_ >= text_.size() || text_[position_] == '\n' || text_[position_] == '\r'; }
  void skip_blanks();

  std::string_view text_;
  const std::string &source_;
  std::size_t position_ = 0;
  std::size_t line_;
};

}  // namespace cmb::mesh
