#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>

#include "assess/brdf_stability.h"

namespace gonio {

/// Edges between the cells of a map where `inside` changes, as gnuplot vectors; cells are centred on the axes' values.
inline std::string map_outline(std::size_t columns, std::size_t rows, const MapAxis& x, const MapAxis& y,
                               const std::function<bool(std::size_t)>& inside) {
  const double dx = (x.hi - x.lo) / double(columns - 1), dy = (y.hi - y.lo) / double(rows - 1);
  const auto in = [&](long c, long r) {
    return c >= 0 && r >= 0 && c < long(columns) && r < long(rows) && inside(std::size_t(r) * columns + std::size_t(c));
  };
  std::string text;
  for (long r = 0; r <= long(rows); ++r)
    for (long c = 0; c <= long(columns); ++c) {
      const double left = x.lo + (double(c) - 0.5) * dx, low = y.lo + (double(r) - 0.5) * dy;
      if (in(c, r) != in(c - 1, r)) text += fmt::format("{:.5g} {:.5g} 0 {:.5g}\n", left, low, dy);
      if (in(c, r) != in(c, r - 1)) text += fmt::format("{:.5g} {:.5g} {:.5g} 0\n", left, low, dx);
    }
  return text.empty() ? "NaN NaN 0 0\n" : text;
}

}  // namespace gonio
