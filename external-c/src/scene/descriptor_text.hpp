// The text of descriptors: tokens, numbers, keys.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cmb {

// Limits that keep untrusted descriptors from exhausting memory or time.
struct DescriptorLimits {
  static constexpr std::size_t characters = 16u << 20;
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

// A piece of the descriptor and where it begins. Borrows the descriptor.
struct Token {
  std::string_view text;
  std::size_t column = 1;
};

struct Number {
  double value;
  std::size_t column;
};

bool is_blank(char c);

// For messages: the text in quotation marks, cut where it is long; a number with six digits.
std::string quoted(std::string_view text);
std::string shortest(double value);

// Where `separator` next occurs outside of double quotation marks; the text's size where it does not.
std::size_t find_unquoted(std::string_view text, char separator, std::size_t begin);

// The blank-separated pieces; blanks within double quotation marks do not separate.
std::vector<Token> split_blanks(const Token &part);

// The key=value part of one shape.
class Keys {
 public:
  // `tokens` are those after the kind. Throws DescriptorError.
  Keys(const Token &kind, const std::vector<Token> &tokens);

  const Token &kind() const { return kind_; }

  // Whether the key is given; does not count as use.
  bool has(std::string_view name) const;

  // The numbers of a key, or nothing where it is left out.
  std::optional<std::vector<Number>> take(std::string_view name);
  std::vector<Number> require(std::string_view name);

  // The text of a key, without the quotation marks it may have; empty where it is left out.
  std::optional<Token> take_text(std::string_view name);

  // `count` lengths, each positive and within the limits.
  std::vector<double> require_lengths(std::string_view name, std::size_t count);

  static void check_count(std::string_view name, const std::vector<Number> &numbers, std::size_t count);

  // Complains of the first key nobody asked for.
  void check_all_used() const;

 private:
  struct Entry {
    Token name;
    Token value;
    bool used;
  };
  Entry *find(std::string_view name);

  Token kind_;
  std::vector<Entry> entries_;
};

// Throws DescriptorError unless the coordinate is within the limits.
void check_coordinate(const Number &number, std::string_view name);

}  // namespace cmb
