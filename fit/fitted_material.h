#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/lobe_sum.h"
#include "materials/database.h"

namespace gonio {

struct FitResult;

/// Lobes that add up, on their surface at one wavelength: what an evaluation takes.
struct LobesOnSurface {
  std::vector<Brdf<double>> lobes;
  Interface<double> surface;
  double wavelength_um;  ///< 1 where none matters

  double f_per_sr(const Directions<double>& w) const { return evaluate<double>(lobes, w, surface, wavelength_um); }
};

/// What a fit leaves behind for those who use the material: model, values, and where its n and k come from.
struct FittedMaterial {
  LobeSum model;
  std::vector<double> values;  ///< in the order of the model's parameters; of the first wavelength where they differ
  /// For each parameter its values at wavelength_nm, or nothing where one value serves all; empty where all are shared.
  std::vector<std::vector<double>> by_wavelength;
  std::optional<std::string> material;          ///< full database id; none: F = 1, or n as fitted
  std::optional<double> n, k;                   ///< fitted; k = 0 where n alone was
  std::vector<double> wavelength_nm;            ///< of the fit, increasing; empty = not stated
  std::optional<double> assumed_wavelength_nm;  ///< where n and k were taken although the wavelength is not stated

  bool is_spectral() const { return !by_wavelength.empty(); }  ///< whether kd or ks differ between wavelengths

  /// The parameters at a wavelength that wavelength() allows: linear between those of the fit.
  std::vector<double> values_at(std::optional<double> wavelength_nm) const;
  /// Lobe by lobe; their sum is f_r (brdf/lobe_sum.h).
  std::vector<Brdf<double>> brdfs(std::optional<double> wavelength_nm) const {
    return make_brdfs(model, values_at(wavelength_nm));
  }

  /// The wavelength to evaluate at: the one asked for, else the fit's only one, else the assumed one. InputError where
  /// the fit does not reach (beyond its own wavelengths, unless n and k come from the database and kd, ks are shared) or
  /// where one is needed and none is known. No value: the material looks the same at every wavelength.
  std::optional<double> wavelength(std::optional<double> asked_nm) const;

  /// n and k there (InputError outside the material's range).
  Interface<double> surface(std::optional<double> wavelength_nm) const;

  LobesOnSurface at(std::optional<double> wavelength_nm) const {
    return {brdfs(wavelength_nm), surface(wavelength_nm), wavelength_nm.value_or(1000) * 1e-3};
  }
};

FittedMaterial fitted_material(const FitResult& result);

/// Reads a fit.json strictly; InputError `file: …` for one that is not complete or not of this version.
FittedMaterial read_fit(const std::filesystem::path& path);
FittedMaterial parse_fit(std::string_view json, const std::string& file);

}  // namespace gonio
