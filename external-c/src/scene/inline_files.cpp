#include "scene/inline_files.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <vector>

#include "scene/descriptor.hpp"

namespace cmb {

namespace {

void append(std::string &text, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

// " name=1,2,3"
void append_numbers(std::string &text, const char *name, const std::vector<double> &numbers) {
  text += ' ';
  text += name;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += i == 0 ? '=' : ',';
    append(text, numbers[i]);
  }
}

// One shape that names a file and has been parsed without complaint.
std::string inlined(const Token &part, const std::vector<Token> &tokens, GeometryFiles &files) {
  Keys keys(tokens[1], {tokens.begin() + 2, tokens.end()});
  const Token name = *keys.take_text("file");
  const double scale = keys.has("scale") ? keys.require_lengths("scale", 1)[0] : 1.0;
  std::string text(tokens[0].text);
  text += ' ';
  text += tokens[1].text;
  if (tokens[1].text == "heightfield") {
    const GeometryFiles::Table &table = files.table(name.text);
    append_numbers(text, "grid", {static_cast<double>(table.columns), static_cast<double>(table.rows)});
    std::vector<double> heights = table.values;
    for (double &height : heights) height *= scale;
    append_numbers(text, "heights", heights);
  } else {
    const mesh::MeshData &data = files.mesh_data(name.text);
    std::vector<double> numbers;
    for (const Vec3 &p : data.vertices) numbers.insert(numbers.end(), {scale * p.x, scale * p.y, scale * p.z});
    append_numbers(text, "vertices", numbers);
    if (tokens[1].text == "mesh") {
      numbers.clear();
      for (const mesh::Triangle &t : data.triangles) numbers.insert(numbers.end(), {t[0] + 1.0, t[1] + 1.0, t[2] + 1.0});
      append_numbers(text, "triangles", numbers);
    }
  }
  for (std::size_t i = 2; i < tokens.size(); ++i) {
    const std::string_view token = tokens[i].text, key = token.substr(0, token.find('='));
    if (key == "file" || key == "scale") continue;
    text += ' ';
    text += token;
  }
  if (text.size() > DescriptorLimits::characters) {
    throw DescriptorError(part.column, std::string(name.text) + " takes " + std::to_string(text.size()) +
                                           " characters; at most " + std::to_string(DescriptorLimits::characters) +
                                           " are accepted: simplify the mesh");
  }
  return text;
}

}  // namespace

std::string inline_files(std::string_view descriptor, GeometryFiles &files) {
  parse_descriptor(descriptor, files);
  std::string result;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = find_unquoted(descriptor, ';', begin);
    const Token part{descriptor.substr(begin, end - begin), begin + 1};
    const std::vector<Token> tokens = split_blanks(part);
    const bool names_file = tokens.size() > 2 && Keys(tokens[1], {tokens.begin() + 2, tokens.end()}).has("file");
    result += names_file ? inlined(part, tokens, files) : std::string(part.text);
    if (end == descriptor.size()) return result;
    result += ';';
    begin = end + 1;
  }
}

}  // namespace cmb
