#include "spectrum/spectrum.h"

#include <algorithm>

namespace gonio {

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  const std::size_t hi = std::clamp<std::size_t>(static_cast<std::size_t>(above - x.begin()), 1, x.size() - 1);
  if (at == x[hi - 1]) return y[hi - 1];
  if (at == x[hi]) return y[hi];
  const double t = (at - x[hi - 1]) / (x[hi] - x[hi - 1]);
  return (1 - t) * y[hi - 1] + t * y[hi];
}

double Spectrum::at(double nm) const { return interpolate(wavelength_nm, value, nm); }

}  // namespace gonio
