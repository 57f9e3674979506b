#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// One lobe, or a sum of up to three, over one diffuse part: f = kd·ρd/π + Σ ks_j·lobe_j; ρd is the first lobe's.
///
/// Parameters of one lobe are its model's. Those of a sum are every lobe's own, with the suffix _1, _2, _3, then kd, then ks_1, ks_2, ks_3.
class LobeSum {
 public:
  static constexpr std::size_t kMostLobes = 3;

  LobeSum() : LobeSum(ModelSpec{}) {}
  LobeSum(const ModelSpec& one) : LobeSum(std::vector{one}) {}  // a model is a sum of one
  /// InputError for none, for too many, and for models that are no lobe (lambert, mirror) in a sum of several.
  explicit LobeSum(std::vector<ModelSpec> lobes);

  const std::vector<ModelSpec>& lobes() const { return lobes_; }
  const ModelSpec& first() const { return lobes_.front(); }
  bool is_sum() const { return lobes_.size() > 1; }

  std::string name() const;       ///< "ggx+phong-1975"
  std::string described() const;  ///< for people: "ggx + phong-1975 (turned back)"
  std::string variant() const;  ///< of each lobe, joined likewise
  const std::vector<ParameterInfo>& parameters() const { return parameters_; }
  std::size_t index_of(std::string_view parameter) const;  ///< InputError naming the parameters when unknown
  bool needs_wavelength() const;

  /// What a parameter is: of which lobe, and where in that lobe's own list (kd: of the first).
  struct Place {
    std::size_t lobe, parameter;
  };
  const Place& place(std::size_t parameter) const { return places_[parameter]; }
  bool is_diffuse(std::size_t parameter) const { return parameters_[parameter].name == "kd"; }
  bool is_scale(std::size_t parameter) const { return parameters_[parameter].name.starts_with("ks"); }

  /// The number of a lobe's own list each: kd stays with the first, and is 0 in the others.
  std::vector<double> values_of(std::size_t lobe, std::span<const double> values) const;

  /// InputError for a value outside its box.
  void check(std::span<const double> values) const;

  /// `shadowing`, `variant` or `retro`, of a sum with the suffix of the lobe; false where it is another setting.
  bool set(std::string_view setting, std::string_view value);

 private:
  std::vector<ModelSpec> lobes_;
  std::vector<ParameterInfo> parameters_;
  std::vector<Place> places_;
};

/// "ggx" or "ggx+phong-1975".
LobeSum lobe_sum(std::string_view names);

/// Each lobe with its share of the values.
std::vector<Brdf<double>> make_brdfs(const LobeSum& sum, std::span<const double> values);

/// f_r in sr⁻¹ of lobes that add up.
template <class T, class G>
T evaluate(std::span<const Brdf<T>> lobes, const Directions<G>& w, const Interface<T>& surface,
           const T& wavelength_um) {
  T f = evaluate(lobes[0], w, surface, wavelength_um);
  for (const Brdf<T>& lobe : lobes.subspan(1)) f += evaluate_lobe(lobe, w, surface, wavelength_um);
  return f;
}

}  // namespace gonio
