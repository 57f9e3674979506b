#pragma once
// Who looks: the --observer of the colour commands.
#include <string>

#include "materials/database.h"
#include "spectrum/sensor.h"

namespace gonio::cli {

/// An observer, cone fundamentals, a luminous efficiency … by database id, or a user's curves (FILE.csv: wavelength_nm
/// and a column a channel). `name` is the full id or the file. InputError for entries of other kinds.
Sensor sensor_named(const std::string& id_or_file, const Database& database = Database::bundled());

/// The same as a colorimetric observer; InputError when its channels are not xbar, ybar, zbar.
Observer observer_named(const std::string& id_or_file, const Database& database = Database::bundled());

}  // namespace gonio::cli
