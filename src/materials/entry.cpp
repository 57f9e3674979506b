#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "materials/database.h"
#include "optics/dispersion.h"

namespace gonio {
namespace {

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  const std::size_t hi = std::clamp<std::size_t>(static_cast<std::size_t>(above - x.begin()), 1, x.size() - 1);
  if (at == x[hi - 1]) return y[hi - 1];  // also where the neighbour is unknown
  if (at == x[hi]) return y[hi];
  const double t = (at - x[hi - 1]) / (x[hi] - x[hi - 1]);
  return (1 - t) * y[hi - 1] + t * y[hi];
}

}  // namespace

bool Entry::has_k() const { return column_names.size() == 2 && column_names[1] == "k"; }

double Entry::at(double nm, std::size_t column) const {
  if (!(nm >= range_lo_nm) || !(nm <= range_hi_nm))
    throw input_error("{}: {} nm is outside the data; expected {} to {} nm", id, nm, range_lo_nm, range_hi_nm);
  if (!formula.empty()) {
    if (column != 0) throw input_error("{}: has no column {}; a dispersion formula gives n alone", id, column);
    return refractive_index<double>(*dispersion_named(formula), coefficients, nm * 1e-3);
  }
  if (column >= columns.size())
    throw input_error("{}: has no column {}; expected below {}", id, column, columns.size());
  const double value = interpolate(wavelength_nm, columns[column], nm);
  if (std::isnan(value))
    throw input_error("{}: {} is not known at {} nm; expected a wavelength where the source gives it", id,
                      column_names[column], nm);
  return value;
}

}  // namespace gonio
