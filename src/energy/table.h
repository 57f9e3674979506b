#pragma once
#include <filesystem>
#include <vector>

#include "brdf/models.h"

namespace gonio {

/// E(θ; m) of a faceted lobe on perfect facets (F = 1, ks = 1) on a grid: columns θ, rows m.
struct ReflectanceTable {
  ModelSpec spec;
  std::vector<double> theta_deg, slope_rms;
  std::vector<double> e, error;  ///< [row m][column θ], absolute error bound of the quadrature

  double at(std::size_t m, std::size_t theta) const { return e[m * theta_deg.size() + theta]; }
};

/// θ from 0 to 89.99° in 46 steps closer towards grazing, m from 0.01 to 2 in 24 logarithmic steps. InputError for a model
/// whose lobe is not a function of m alone.
ReflectanceTable make_reflectance_table(const ModelSpec& spec, double tolerance = 1e-7);

/// An OpenEXR file (channels E, error; grids, model and units in attributes) and a CSV of the same name beside it.
void write_reflectance_table(const ReflectanceTable& table, const std::filesystem::path& exr);

}  // namespace gonio
