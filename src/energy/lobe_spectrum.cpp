#include "energy/lobe_spectrum.h"

#include <algorithm>
#include <array>

#include "brdf/lanes.h"

namespace gonio {
namespace {
constexpr std::size_t kLanes = DoubleLanes::size;
}

LobeSpectrum::LobeSpectrum(const Lobe<double>& lobe, const SpectralSurface& surface)
    : count_(surface.size()), lobe_(lobe) {
  if (const auto* one = std::get_if<BeckmannKirchhoff<double>>(&lobe))
    lanes_lobe_ =
        BeckmannKirchhoff<DoubleLanes>{DoubleLanes(one->sigma_um), DoubleLanes(one->correlation_um), one->form};
  if (const auto* one = std::get_if<HeTorrance<double>>(&lobe))
    lanes_lobe_ = HeTorrance<DoubleLanes>{DoubleLanes(one->sigma0_um), DoubleLanes(one->correlation_um), one->reading};
  for (std::size_t first = 0; first < count_; first += kLanes) {
    std::array<double, kLanes> n, k, wavelength, perfect;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t at = std::min(first + lane, count_ - 1);
      n[lane] = surface.interfaces[at].n;
      k[lane] = surface.interfaces[at].k;
      wavelength[lane] = surface.wavelength_um[at];
      perfect[lane] = surface.interfaces[at].perfect ? 1 : 0;
    }
    interfaces_.push_back({DoubleLanes::load_unaligned(n.data()), DoubleLanes::load_unaligned(k.data()), false});
    perfect_.push_back(DoubleLanes::load_unaligned(perfect.data()));
    wavelength_um_.push_back(DoubleLanes::load_unaligned(wavelength.data()));
  }
}

void LobeSpectrum::evaluate(const Directions<double>& w, double weight, Eigen::Ref<Eigen::ArrayXd> out) const {
  const bool spectral = diffracts(lanes_lobe_);
  const double shape = spectral ? 1 : lobe_shape(lobe_, w, 1.0);
  const Directions<DoubleLanes> lanes = spread<DoubleLanes>(w);
  for (std::size_t block = 0; block < interfaces_.size(); ++block) {
    const DoubleLanes of_index = std::visit(
        [&](const auto& one) { return facet_reflectance<DoubleLanes>(one, lanes.cos_d, interfaces_[block]); }, lobe_);
    const DoubleLanes reflectance = select(perfect_[block] > DoubleLanes(0.5), DoubleLanes(1.0), of_index);
    DoubleLanes value = reflectance * DoubleLanes(weight * shape);
    if (spectral) value *= lobe_shape(lanes_lobe_, lanes, wavelength_um_[block]);
    std::array<double, kLanes> values;
    value.store_unaligned(values.data());
    for (std::size_t lane = 0; lane < kLanes && block * kLanes + lane < count_; ++lane)
      out[static_cast<Eigen::Index>(block * kLanes + lane)] = values[lane];
  }
}

}  // namespace gonio
