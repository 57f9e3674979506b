#pragma once
#include <optional>
#include <span>
#include <vector>

#include "brdf/lanes.h"
#include "brdf/sampling.h"
#include "render/random.h"
#include "render/spectral_lanes.h"

namespace gonio {

/// A BRDF at the scene's wavelengths. i towards the light, o towards the eye, in the surface's frame. The geometry is
/// reduced once, in double; the wavelengths follow side by side.
template <std::size_t N>
class SurfaceShader {
 public:
  using Lanes = SpectralLanes<N>;

  struct Sample {
    LocalDirection i;
    Lanes weight;       ///< f·cos_i/pdf; for a delta its energy over its share of the samples
    double pdf_per_sr;  ///< 0 for a delta, whose energy has no density
    bool delta;
  };

  /// `surfaces`: the interface at each wavelength.
  SurfaceShader(const ModelSpec& spec, std::span<const double> values, std::span<const Interface<double>> surfaces,
                std::span<const double> wavelengths_nm)
      : brdf_(make_brdf<double>(spec, values)), lanes_brdf_(spread_brdf<FloatLanes>(spec, values)) {
    std::vector<double> n, k, um, r0;
    for (const Interface<double>& surface : surfaces) {
      n.push_back(surface.n);
      k.push_back(surface.k);
      r0.push_back(surface.r0());
    }
    for (const double nm : wavelengths_nm) um.push_back(nm * 1e-3);
    const Lanes lanes_n = Lanes::from(n), lanes_k = Lanes::from(k);
    for (std::size_t b = 0; b < N; ++b)
      surface_.push_back({lanes_n.part[b], lanes_k.part[b], surfaces.front().perfect});
    wavelength_um_ = Lanes::from(um);
    diffuse_ = brdf_.diffuse_times_r0() ? Lanes::from(r0) : Lanes(1.0F);
    diffuse_ *= static_cast<float>(brdf_.kd / kPi<double>);
    mean_r0_ = mean(r0);
    longest_um_ = um.back();
    wavelengths_um_ = std::move(um);
    mixture_ = lobe_mixture(brdf_, mean_r0_, longest_um_);
  }

  /// f·factor, without the delta; 0 below the horizon.
  Lanes evaluate(const LocalDirection& i, const LocalDirection& o, double factor) const {
    if (i.z <= 0 || o.z <= 0) return Lanes(0.0F);
    Lanes f = diffuse_;
    if (has_lobe()) {
      const Directions<double> given = reduce(i.x, i.y, i.z, o.x, o.y, o.z),
                               w = brdf_.retro ? turned_back(given) : given;
      const FloatLanes cos_d(static_cast<float>(w.cos_d));
      f *= static_cast<float>(factor);
      if (diffracts()) {
        const FloatLanes scale(static_cast<float>(brdf_.ks * factor));
        for (std::size_t b = 0; b < N; ++b)
          f.part[b] += scale * reflectance(cos_d, b) * lobe_shape(lanes_brdf_.lobe, w, wavelength_um_.part[b]);
      } else {
        const FloatLanes scale(static_cast<float>(brdf_.ks * factor * lobe_shape(brdf_.lobe, w, longest_um_)));
        for (std::size_t b = 0; b < N; ++b) f.part[b] += scale * reflectance(cos_d, b);
      }
      return f;
    }
    return f *= static_cast<float>(factor);
  }

  /// Density of sample()'s directions that are no delta, per steradian.
  double pdf(const LocalDirection& i, const LocalDirection& o) const {
    if (!(i.z > 0) || !(o.z > 0)) return 0;
    return (1 - delta_share(o.z)) * mixture_.pdf(i, o);
  }

  /// A mixture of the coherent delta, a cosine lobe and the lobe's own sampler. Empty when the drawn direction lies below the
  /// horizon (it carries nothing) or the surface is black.
  std::optional<Sample> sample(const LocalDirection& o, Random& random) const {
    const double share = delta_share(o.z), choice = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
    if (choice < share) {
      const LocalDirection i = brdf_.retro ? o : LocalDirection{-o.x, -o.y, o.z};
      return Sample{i, coherent(o.z, 1 / share), 0, true};
    }
    const auto drawn = mixture_.sample(o, (choice - share) / (1 - share), u1, u2);
    const double pdf_per_sr = (1 - share) * drawn.pdf_per_sr;
    if (!(pdf_per_sr > 0)) return {};
    return Sample{drawn.direction, evaluate(drawn.direction, o, drawn.direction.z / pdf_per_sr), pdf_per_sr, false};
  }

 private:
  /// A coherent share below this is lost in the rounding of float radiances.
  static constexpr double kLeastCoherent = 1e-9;

  bool has_lobe() const { return !std::holds_alternative<Lambert>(brdf_.lobe) && brdf_.ks > 0; }
  bool diffracts() const { return brdf_.diffracts(); }
  FloatLanes reflectance(const FloatLanes& cos_d, std::size_t b) const {
    return facet_reflectance(lanes_brdf_.lobe, cos_d, surface_[b]);
  }

  static double mean(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }

  /// Share of the samples that are the coherent delta, in proportion to its energy, but neither it nor the rest starved.
  double delta_share(double cos_o) const {
    if (!has_lobe() || !has_delta(brdf_.lobe)) return 0;
    const double coherent_share = mean_coherent_share(cos_o);
    if (coherent_share < kLeastCoherent) return 0;
    const double diffuse = brdf_.kd * (brdf_.diffuse_times_r0() ? mean_r0_ : 1), lobe = brdf_.ks * mean_r0_;
    if (diffuse == 0 && std::holds_alternative<Mirror>(brdf_.lobe)) return 1;
    return std::clamp(lobe * coherent_share / (diffuse + lobe), 0.05, 0.9);
  }

  double mean_coherent_share(double cos_o) const {
    double sum = 0;
    for (const double um : wavelengths_um_) sum += coherent_share(brdf_.lobe, cos_o, um);
    return sum / static_cast<double>(wavelengths_um_.size());
  }

  Lanes coherent(double cos_o, double factor) const {
    const FloatLanes cosine(static_cast<float>(cos_o)), scale(static_cast<float>(factor));
    Lanes energy;
    for (std::size_t b = 0; b < N; ++b)
      energy.part[b] = scale * coherent_energy(lanes_brdf_, cosine, surface_[b], wavelength_um_.part[b]);
    return energy;
  }

  Brdf<double> brdf_;
  Brdf<FloatLanes> lanes_brdf_;
  std::vector<Interface<FloatLanes>> surface_;  ///< one a batch of wavelengths
  Lanes wavelength_um_, diffuse_;               ///< diffuse_ = kd·ρd/π
  std::vector<double> wavelengths_um_;
  LobeMixture<double> mixture_;
  double mean_r0_ = 1, longest_um_ = 1;
};

}  // namespace gonio
