#include "materials/interpolated_entry.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {

Interpolation default_interpolation(std::string_view data_class) {
  if (data_class == "illuminant") return Interpolation::pchip;
  if (data_class == "optical-constants k") return Interpolation::akima;
  if (data_class == "daylight-basis") return Interpolation::linear;  // as its definition says
  return Interpolation::natural_cubic;
}

std::string data_class_of(const Entry& entry, std::size_t column) {
  return entry.kind == "optical-constants" ? entry.kind + " " + entry.column_names.at(column) : entry.kind;
}

Interpolated interpolated(const Entry& entry, double wavelength_nm, std::size_t column, Interpolation variant,
                          std::optional<Extension> extension) {
  if (column >= entry.columns.size() || entry.columns[column].size() != entry.wavelength_nm.size())
    return {entry.at(wavelength_nm, column), false};  // a formula, or no such column
  std::vector<double> x, y;
  for (std::size_t i = 0; i < entry.wavelength_nm.size(); ++i)
    if (std::isfinite(entry.columns[column][i]))
      x.push_back(entry.wavelength_nm[i]), y.push_back(entry.columns[column][i]);
  try {
    const Interpolator table(variant, std::move(x), std::move(y));
    Interpolated found = extension ? table.at(wavelength_nm, *extension) : Interpolated{table.at(wavelength_nm), false};
    if (entry.kind != "rgb-observer" && entry.kind != "daylight-basis") found.value = std::max(found.value, 0.0);
    return found;
  } catch (const InputError& error) {
    throw input_error("{}: {}", entry.id, error.what());
  }
}

}  // namespace gonio
