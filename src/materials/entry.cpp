#include <cmath>

#include "base/error.h"
#include "materials/database.h"
#include "optics/dispersion.h"
#include "spectrum/spectrum.h"

namespace gonio {

bool Entry::has_k() const { return column_names.size() == 2 && column_names[1] == "k"; }

double Entry::at(double nm, std::size_t column) const {
  if (!(nm >= range_lo_nm) || !(nm <= range_hi_nm))
    throw input_error("{}: {} nm is outside the data; expected {} to {} nm", id, nm, range_lo_nm, range_hi_nm);
  if (!formula.empty() && column == 0) {
    const double n = refractive_index<double>(*dispersion_named(formula), coefficients, nm * 1e-3);
    if (!(n > 0) || !std::isfinite(n))
      throw input_error("{}: the formula gives n = {} at {} nm; expected n > 0", id, n, nm);
    return n;
  }
  if (column >= columns.size())
    throw input_error("{}: has no column {}; expected below {}", id, column, columns.size());
  const bool covered = nm >= wavelength_nm.front() && nm <= wavelength_nm.back();  // a formula may reach further
  const double value = covered ? interpolate(wavelength_nm, columns[column], nm) : std::nan("");
  if (std::isnan(value))
    throw input_error("{}: {} is not known at {} nm; expected a wavelength where the source gives it", id,
                      column_names[column], nm);
  return value;
}

}  // namespace gonio
