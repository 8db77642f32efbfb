#include "interface/last_error.hpp"

#include <cstdio>

namespace cmb {

namespace {

constexpr std::size_t longest_text = 1024;
thread_local char text_of_thread[longest_text] = "";

}  // namespace

void set_last_error(const char *text) noexcept { std::snprintf(text_of_thread, longest_text, "%s", text); }

const char *last_error() noexcept { return text_of_thread; }

}  // namespace cmb
