#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "brdf/models.h"
#include "optics/interface.h"

namespace gonio {

/// A published table of fitted parameters (measurements/published_parameters/NAME.csv, conventions in the README there).
struct PublishedTable {
  std::string_view name;     ///< of the file
  std::string_view model;    ///< of ours, that has the table's formula
  std::string_view variant;  ///< empty: the model's default
  std::string_view shadowing;
};

/// One material and colour channel: our model, with our parameters, whose value is the published one's.
struct PublishedFit {
  std::string material, channel;
  ModelSpec spec;
  std::vector<double> values;  ///< in the order of spec.info().parameters
  Interface<double> surface;   ///< the fitted index where the model takes F from one; else perfect
};

const std::vector<PublishedTable>& published_tables();
/// InputError for an unknown name, listing the known ones.
const PublishedTable& published_table(std::string_view name);

/// Every row, in the file's order. InputError where the file or a value is wrong.
std::vector<PublishedFit> read_published(const PublishedTable& table);

/// "ngan-ward/blue-acrylic/g"; InputError naming what is unknown.
PublishedFit published_fit(std::string_view path);

}  // namespace gonio
