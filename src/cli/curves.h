#pragma once
// A user's own curves over wavelength, from a CSV.
#include <string>
#include <vector>

#include "spectrum/spectrum.h"

namespace gonio::cli {

struct Curves {
  std::vector<std::string> name;           ///< one a column, as the header calls them
  std::vector<double> wavelength_nm;       ///< increasing, at least two
  std::vector<std::vector<double>> value;  ///< value[column][row]
};

/// Whether the argument means a file rather than a database id: it ends in .csv.
bool names_a_file(const std::string& id_or_file);

/// A CSV with wavelength_nm first and one or more named columns. InputError `FILE:LINE: …` for anything else.
Curves read_curves(const std::string& file);

}  // namespace gonio::cli
