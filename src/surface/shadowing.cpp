#include "surface/shadowing.h"

#include <array>
#include <utility>

#include "base/error.h"

namespace gonio {
namespace {
constexpr std::array<std::pair<std::string_view, Shadowing>, 5> kNames{{{"none", Shadowing::none},
                                                                        {"v-cavity", Shadowing::v_cavity},
                                                                        {"smith-separable", Shadowing::smith_separable},
                                                                        {"smith-correlated", Shadowing::smith_correlated},
                                                                        {"smith-1967", Shadowing::smith_1967}}};
}

std::string_view name_of(Shadowing shadowing) {
  for (const auto& [name, value] : kNames)
    if (value == shadowing) return name;
  return "";
}

Shadowing shadowing_from(std::string_view name) {
  for (const auto& [known, value] : kNames)
    if (known == name) return value;
  throw input_error("shadowing={}: unknown; expected v-cavity, smith-separable, smith-correlated, smith-1967 or none", name);
}

}  // namespace gonio
