#include "c_api/last_error.hpp"

#include <cstdio>
#include <cstring>

namespace cmb {

namespace {

constexpr std::size_t longest_text = 1024;
thread_local char text_of_thread[longest_text] = "";

}  // namespace

// Of what is too long the middle is left out: the place is named at the beginning, the problem and its remedy at the end.
void set_last_error(const char *text) noexcept {
  const std::size_t length = std::strlen(text);
  if (length < longest_text) {
    std::memcpy(text_of_thread, text, length + 1);
    return;
  }
  constexpr int half = (longest_text - sizeof " ... ") / 2;
  std::snprintf(text_of_thread, longest_text, "%.*s ... %s", half, text, text + length - half);
}

const char *last_error() noexcept { return text_of_thread; }

}  // namespace cmb
