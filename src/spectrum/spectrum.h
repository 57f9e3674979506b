#pragma once
#include <cstddef>
#include <vector>

namespace gonio {

/// A quantity over wavelength in nm: points in increasing order, linear between them, not extended beyond them.
struct Spectrum {
  std::vector<double> wavelength_nm, value;

  double lo_nm() const { return wavelength_nm.front(); }
  double hi_nm() const { return wavelength_nm.back(); }
  /// Requires lo_nm() <= nm <= hi_nm().
  double at(double nm) const;
};

/// Linear between the points of y(x), x increasing and of at least two points; at a point its own value, whatever its
/// neighbours. Requires x.front() <= at <= x.back().
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace gonio
