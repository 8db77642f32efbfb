// The text of this thread's last error.
#pragma once

#include <string>

namespace cmb {

// Remembers a text; never throws (a text too long is cut).
void set_last_error(const char *text) noexcept;

// Never null; valid until this thread's next set_last_error.
const char *last_error() noexcept;

}  // namespace cmb
