#pragma once
#include <optional>
#include <span>
#include <vector>

#include "brdf/lanes.h"
#include "brdf/sampling.h"
#include "render/random.h"
#include "render/spectral_lanes.h"

namespace gonio {

/// How directions are drawn at a surface: a mixture of the coherent delta, a cosine lobe and the model's half-vector
/// lobe.
struct SamplingShares {
  double delta, cosine;  ///< of all samples; of those that are no delta
};

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
    alpha_ = sampling_alpha(brdf_.lobe, longest_um_);
  }

  /// f·factor, without the delta; 0 below the horizon.
  Lanes evaluate(const LocalDirection& i, const LocalDirection& o, double factor) const {
    if (i.z <= 0 || o.z <= 0) return Lanes(0.0F);
    Lanes f = diffuse_;
    if (has_lobe()) {
      const Directions<double> w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
      const FloatLanes cos_d(static_cast<float>(w.cos_d));
      f *= static_cast<float>(factor);
      if (diffracts()) {
        const FloatLanes scale(static_cast<float>(brdf_.ks * factor));
        for (std::size_t b = 0; b < N; ++b)
          f.part[b] += scale * reflectance(cos_d, b) * lobe_shape(lanes_brdf_.lobe, w, wavelength_um_.part[b]);
      } else {
        const FloatLanes scale(static_cast<float>(brdf_.ks * factor * lobe_shape(brdf_.lobe, w, longest_um_)));
        for (std::size_t b = 0; b < N; ++b)
          f.part[b] += scale * reflectance(cos_d, b);
      }
      return f;
    }
    return f *= static_cast<float>(factor);
  }

  /// Density of sample()'s directions that are no delta, per steradian.
  double pdf(const LocalDirection& i, const LocalDirection& o) const {
    const SamplingShares shares = shares_at(o);
    return (1 - shares.delta) * density(i, o, shares.cosine);
  }

  /// Empty when the drawn direction lies below the horizon (it carries nothing) or the surface is black.
  std::optional<Sample> sample(const LocalDirection& o, Random& random) const {
    const SamplingShares shares = shares_at(o);
    const double choice = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
    if (choice < shares.delta) return Sample{{-o.x, -o.y, o.z}, coherent(o.z, 1 / shares.delta), 0, true};
    LocalDirection i;
    if (choice < shares.delta + (1 - shares.delta) * shares.cosine) {
      i = sample_cosine(u1, u2).direction;
    } else {
      const auto drawn = sample_visible_normal(alpha_, o, random.uniform(), u1, u2);
      if (!drawn) return {};
      i = drawn->direction;
    }
    const double pdf_per_sr = (1 - shares.delta) * density(i, o, shares.cosine);
    if (!(i.z > 0) || !(pdf_per_sr > 0)) return {};
    return Sample{i, evaluate(i, o, i.z / pdf_per_sr), pdf_per_sr, false};
  }

 private:
  /// Where the lobe's tails are wider than its sampling density (diffraction, GGX, cosine powers), this share of cosine samples bounds the
  /// weights.
  static constexpr double kDefensiveShare = 0.2;
  /// A coherent share below this is lost in the rounding of float radiances.
  static constexpr double kLeastCoherent = 1e-9;

  bool has_lobe() const { return !std::holds_alternative<Lambert>(brdf_.lobe) && brdf_.ks > 0; }
  bool diffracts() const { return brdf_.diffracts(); }
  FloatLanes reflectance(const FloatLanes& cos_d, std::size_t b) const { return facet_reflectance(lanes_brdf_.lobe, cos_d, surface_[b]); }

  static double mean(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }

  double density(const LocalDirection& i, const LocalDirection& o, double cosine_share) const {
    const double lobe = cosine_share < 1 ? visible_normal_pdf(alpha_, i, o) : 0;
    return cosine_share * cosine_pdf(i) + (1 - cosine_share) * lobe;
  }

  /// In proportion to the energies, diffuse against lobe, each at least a tenth so that neither is starved.
  SamplingShares shares_at(const LocalDirection& o) const {
    if (!has_lobe()) return {0, 1};
    const double diffuse = brdf_.kd * (brdf_.diffuse_times_r0() ? mean_r0_ : 1), lobe = brdf_.ks * mean_r0_;
    double cosine = diffuse > 0 ? std::clamp(diffuse / (diffuse + lobe), 0.1, 0.9) : 0;
    if (tails_fit_the_sampler(brdf_.lobe)) return {0, cosine};
    cosine = std::max(cosine, kDefensiveShare);
    if (!has_delta(brdf_.lobe)) return {0, cosine};
    const double coherent_share = mean_coherent_share(o.z);
    if (coherent_share < kLeastCoherent) return {0, cosine};
    return {std::clamp(lobe * coherent_share / (diffuse + lobe), 0.05, 0.9), cosine};
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
  double mean_r0_ = 1, longest_um_ = 1, alpha_ = 1;
};

}  // namespace gonio
