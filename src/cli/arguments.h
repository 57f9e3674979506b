#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "brdf/lobe_sum.h"
#include "materials/database.h"

namespace gonio::cli {

/// The surface that --material, or --n and --k, name.
struct SurfaceArguments {
  std::string material;
  std::optional<double> n, k;

  void add_to(CLI::App& command);
  /// Empty where nothing was given.
  bool given() const { return !material.empty() || n || k; }
};

/// What the surface is, at any wavelength: a database material or a fixed index.
class Surface {
 public:
  explicit Surface(const SurfaceArguments& arguments);
  explicit Surface(SurfaceMaterial material) : material_(std::move(material)) {}

  /// The database id; "perfect"; or "n=… k=…".
  std::string name() const;
  bool needs_wavelength() const { return !fixed_ && !material_.is_perfect(); }
  /// InputError outside the material's range.
  Interface<double> at(double wavelength_nm) const { return fixed_ ? *fixed_ : material_.at(wavelength_nm); }
  const SurfaceMaterial& material() const { return material_; }

 private:
  SurfaceMaterial material_ = SurfaceMaterial::perfect();
  std::optional<Interface<double>> fixed_;
};

/// MODEL, or a sum MODEL+MODEL, with --set name=value …, --variant: a model and its values, checked against its box.
struct ModelArguments {
  std::string model;
  std::vector<std::string> settings;
  std::string variant;

  void add_to(CLI::App& command);
};

struct ChosenModel {
  LobeSum sum;
  std::vector<double> values;                    ///< in the order of sum.parameters()
  std::optional<double> patch_x_um, patch_y_um;  ///< of a single lobe
};

/// InputError for an unknown parameter, a missing roughness, both m and alpha, a value outside the box.
ChosenModel choose_model(const ModelArguments& arguments);

/// "0,30,60" or a bare number; InputError for anything else or outside [lo, hi].
std::vector<double> number_list(const std::string& text, std::string_view option, double lo, double hi);
double number_in(const std::string& text, std::string_view option);

}  // namespace gonio::cli
