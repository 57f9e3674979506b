#include "cli/eye.h"

#include <fmt/format.h>

#include "base/error.h"
#include "cli/curves.h"

namespace gonio::cli {

Sensor sensor_named(const std::string& id_or_file, const Database& database) {
  if (names_a_file(id_or_file)) {
    Curves curves = read_curves(id_or_file);
    return {std::move(curves.name), std::move(curves.wavelength_nm), std::move(curves.value), id_or_file};
  }
  const Entry& entry = database.find(id_or_file);
  for (const char* kind : {"illuminant", "optical-constants", "reflectance", "transmittance", "daylight-basis"})
    if (entry.kind == kind)
      throw input_error("{} is of kind {}; expected an observer (or the curves of one: FILE.csv)", entry.id,
                        entry.kind);
  return {entry.column_names, entry.wavelength_nm, entry.columns, entry.id};
}

Observer observer_named(const std::string& id_or_file, const Database& database) {
  const Sensor sensor = sensor_named(id_or_file, database);
  if (!is_colorimetric(sensor))
    throw input_error("{} has the channels {}; expected xbar, ybar, zbar", sensor.name,
                      fmt::join(sensor.channel, ", "));
  return colorimetric(sensor);
}

}  // namespace gonio::cli
