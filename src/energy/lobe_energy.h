#pragma once
#include <string_view>
#include <vector>

#include "energy/directional_reflectance.h"
#include "energy/reflectance_curve.h"

namespace gonio {

/// E(θ, φ) as a Fourier sum over the azimuth from the grain, E = Σ_k a_k(θ)·cos 2kφ; one term where the lobe has no grain.
class AzimuthalCurve {
 public:
  AzimuthalCurve() : harmonics_(1) {}
  explicit AzimuthalCurve(ReflectanceCurve all_around) : harmonics_{std::move(all_around)} {}
  /// Of curves at azimuths evenly from 0 to 90 degrees.
  static AzimuthalCurve of(std::span<const ReflectanceCurve> over_quarter);

  /// cos_2phi = (x² - y²)/(x² + y²) of a direction; nothing but 1 matters where there is no grain.
  double operator()(double cos_theta, double cos_2phi = 1) const;
  bool has_grain() const { return harmonics_.size() > 1; }
  /// The mean over azimuths.
  const ReflectanceCurve& around() const { return harmonics_.front(); }
  double mean() const { return around().mean(); }
  ReflectanceCurve::Largest largest() const;
  /// The largest of the last two harmonics: about what the Fourier sum leaves out; 0 where there is no grain.
  double truncation() const;

 private:
  std::vector<ReflectanceCurve> harmonics_;
};

/// E of one lobe (ks = 1; the delta is not in it) over the incidence, at some wavelengths: what a renderer asks of it, made once.
///
/// From the bundled tables where the lobe is a sum of their families and R is one of the polynomials they hold; else by quadrature
/// to 1e-6 at the columns of EnergyGrid, and cubics between them. Unbounded lobes are level beyond kUnboundedTo_deg.
class LobeEnergy {
 public:
  LobeEnergy(const Lobe<double>& lobe, const SpectralSurface& surface);

  std::size_t wavelengths() const { return curves_.size(); }
  /// One serves all wavelengths where R = 1 and the lobe does not diffract.
  const AzimuthalCurve& at(std::size_t wavelength) const { return curves_[wavelength]; }
  /// Largest error of any value: EnergyTable::kError times the lobe's factor, or what the quadrature and the cubics lose.
  double error() const { return error_; }
  bool from_table() const { return from_table_; }

  static constexpr double kUnboundedTo_deg = 85;

 private:
  bool take_from_tables(const Lobe<double>& lobe, const SpectralSurface& surface);
  void integrate(const Lobe<double>& lobe, const SpectralSurface& surface);

  std::vector<AzimuthalCurve> curves_;
  double error_ = 0;
  bool from_table_ = false;
};

/// Whether a lobe's E grows without bound next to grazing: the models that say so, and facets without shadowing.
bool unbounded_at_grazing(const Lobe<double>& lobe);

}  // namespace gonio
