#include "scene/descriptor_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mesh/io/number_text.hpp"

namespace cmb {

namespace {

constexpr char quotation_mark = '"';

std::vector<Number> parse_numbers(const Token &list) {
  std::vector<Number> numbers;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = std::min(list.text.find(',', begin), list.text.size());
    const std::string_view text = list.text.substr(begin, comma - begin);
    const std::size_t column = list.column + begin;
    double value = 0.0;
    const std::errc error = mesh::parse_number(text, value);
    if (text.empty() || text == "+") throw DescriptorError(column, "a number is missing; write numbers as 1,2.5,3e-2");
    if (error == std::errc::result_out_of_range) {
      throw DescriptorError(column, quoted(text) + " is out of range; use a value a double can hold");
    }
    if (error != std::errc()) {
      throw DescriptorError(column, quoted(text) + " is not a number; write numbers as 1,2.5,3e-2, without blanks");
    }
    if (!std::isfinite(value)) throw DescriptorError(column, quoted(text) + " is not finite; give a finite number");
    numbers.push_back({value, column});
    if (comma == list.text.size()) return numbers;
    begin = comma + 1;
  }
}

}  // namespace

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

std::size_t find_unquoted(std::string_view text, char separator, std::size_t begin) {
  bool inside = false;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == quotation_mark) inside = !inside;
    if (text[i] == separator && !inside) return i;
  }
  return text.size();
}

std::vector<Token> split_blanks(const Token &part) {
  std::vector<Token> tokens;
  std::size_t i = 0;
  while (i < part.text.size()) {
    if (is_blank(part.text[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    bool inside = false;
    while (end < part.text.size() && (inside || !is_blank(part.text[end]))) {
      if (part.text[end] == quotation_mark) inside = !inside;
      ++end;
    }
    if (inside) {
      throw DescriptorError(part.column + part.text.find(quotation_mark, i),
                            "a quotation mark is not closed; write for example file=\"my part.stl\"");
    }
    tokens.push_back({part.text.substr(i, end - i), part.column + i});
    i = end;
  }
  return tokens;
}

Keys::Keys(const Token &kind, const std::vector<Token> &tokens) : kind_(kind) {
  for (const Token &token : tokens) {
    const std::size_t equals = token.text.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      throw DescriptorError(token.column, quoted(token.text) + " is not key=numbers; write for example radius=0.1");
    }
    const std::string_view name = token.text.substr(0, equals);
    if (has(name)) throw DescriptorError(token.column, quoted(name) + " is given twice; keep one");
    entries_.push_back(
        {{name, token.column}, {token.text.substr(equals + 1), token.column + equals + 1}, false});
  }
}

bool Keys::has(std::string_view name) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry &entry) { return entry.name.text == name; });
}

Keys::Entry *Keys::find(std::string_view name) {
  for (Entry &entry : entries_) {
    if (entry.name.text != name) continue;
    entry.used = true;
    return &entry;
  }
  return nullptr;
}

std::optional<std::vector<Number>> Keys::take(std::string_view name) {
  const Entry *entry = find(name);
  if (entry == nullptr) return std::nullopt;
  return parse_numbers(entry->value);
}

std::vector<Number> Keys::require(std::string_view name) {
  auto numbers = take(name);
  if (!numbers) {
    throw DescriptorError(kind_.column, std::string(kind_.text) + " lacks the key " + quoted(name) + "; add " +
                                            std::string(name) + "=...");
  }
  return *numbers;
}

std::optional<Token> Keys::take_text(std::string_view name) {
  const Entry *entry = find(name);
  if (entry == nullptr) return std::nullopt;
  Token value = entry->value;
  if (!value.text.empty() && value.text.front() == quotation_mark) {
    if (value.text.size() < 2 || value.text.find(quotation_mark, 1) + 1 != value.text.size()) {
      throw DescriptorError(value.column, quoted(value.text) + " has quotation marks inside; put one pair around it");
    }
    value.text = value.text.substr(1, value.text.size() - 2);
    ++value.column;
  }
  return value;
}

std::vector<double> Keys::require_lengths(std::string_view name, std::size_t count) {
  const std::vector<Number> numbers = require(name);
  check_count(name, numbers, count);
  std::vector<double> values;
  for (const Number &number : numbers) {
    if (!(number.value > 0.0)) {
      throw DescriptorError(number.column,
                            std::string(name) + " is " + shortest(number.value) + "; it has to be greater than 0");
    }
    if (number.value < DescriptorLimits::smallest_length || number.value > DescriptorLimits::largest_length) {
      throw DescriptorError(number.column, std::string(name) + " is " + shortest(number.value) +
                                               " m; lengths have to lie between 1e-9 m and 1e9 m");
    }
    values.push_back(number.value);
  }
  return values;
}

void Keys::check_count(std::string_view name, const std::vector<Number> &numbers, std::size_t count) {
  if (numbers.size() == count) return;
  throw DescriptorError(numbers.front().column, std::string(name) + " has " + std::to_string(numbers.size()) +
                                                    " numbers; give " + std::to_string(count));
}

void Keys::check_all_used() const {
  for (const Entry &entry : entries_) {
    if (!entry.used) {
      throw DescriptorError(entry.name.column, std::string(kind_.text) + " has no key " + quoted(entry.name.text) +
                                                   "; remove it or correct its spelling");
    }
  }
}

void check_coordinate(const Number &number, std::string_view name) {
  if (std::fabs(number.value) > DescriptorLimits::largest_length) {
    throw DescriptorError(number.column, std::string(name) + " has the coordinate " + shortest(number.value) +
                                             " m; coordinates have to lie within 1e9 m");
  }
}

}  // namespace cmb
