#pragma once
// base: what every other room uses: errors, files that appear whole, number types.
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace gonio {

/// Input or usage that cannot be accepted; the command prints the one line and exits with 2.
/// The message reads `file:line: what is wrong; what was expected` (file and line where there is one).
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// throw input_error("{}:{}: theta_i_deg is {}; expected 0 to 90", file, line, value)
template <class... Args>
InputError input_error(fmt::format_string<Args...> text, Args&&... args) {
  return InputError(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace gonio
