#pragma once
#include <Eigen/Core>

#include "energy/directional_reflectance.h"

namespace gonio {

/// Lobe times reflectance at many wavelengths, in SIMD lanes: the geometry once, then R (and, for beckmann-kirchhoff, the
/// lobe) for every wavelength side by side.
class LobeSpectrum {
 public:
  LobeSpectrum(const Lobe<double>& lobe, const SpectralSurface& surface);
  Eigen::Index size() const { return static_cast<Eigen::Index>(count_); }
  /// out = weight·R·shape at each wavelength.
  void evaluate(const Directions<double>& w, double weight, Eigen::Ref<Eigen::ArrayXd> out) const;

 private:
  std::size_t count_;
  Lobe<double> lobe_;
  Lobe<DoubleLanes> lanes_lobe_;
  std::vector<Interface<DoubleLanes>> interfaces_;
  std::vector<DoubleLanes> perfect_;  ///< 1 where the surface reflects everything, else 0
  std::vector<DoubleLanes> wavelength_um_;
};

}  // namespace gonio
