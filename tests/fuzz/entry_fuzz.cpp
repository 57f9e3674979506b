// Any bytes as an entry of materials_db: an Entry that can be evaluated all over its range, or an InputError, nothing
// else.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "materials/entry_reader.h"

namespace {

/// Inside its range a value is finite and non-negative (or k is said not to be known there).
void evaluate(const gonio::Entry& entry) {
  const std::size_t columns = std::max<std::size_t>(entry.columns.size(), 1);
  for (int i = 0; i <= 16; ++i) {
    const double nm = std::lerp(entry.range_lo_nm, entry.range_hi_nm, i / 16.0);
    for (std::size_t c = 0; c < columns; ++c) try {
        const double value = entry.at(nm, c);
        if (!std::isfinite(value) || value < 0) std::abort();
      } catch (const gonio::InputError&) {
        if (c == 0 && entry.formula.empty()) std::abort();
      }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    evaluate(gonio::read_entry({reinterpret_cast<const char*>(data), size}, "entry.txt"));
  } catch (const gonio::InputError&) {
  }
  return 0;
}
