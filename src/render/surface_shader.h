#pragma once
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "brdf/lanes.h"
#include "brdf/lobe_sum.h"
#include "brdf/sum_sampling.h"
#include "energy/material_energy.h"
#include "render/random.h"
#include "render/spectral_lanes.h"

namespace gonio {

/// A BRDF, or a sum of lobes, at the scene's wavelengths. i towards the light, o towards the eye, in the surface's
/// frame. The geometry is reduced once, in double; the wavelengths follow side by side, with their own kd and ks.
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

  /// `values`: one list for all wavelengths, or one for each (kd and ks differ); `surfaces`: the interface at each. `energy`: E of the lobes, for the
  /// choice between them, and compensations; without it the choice goes by R0.
  SurfaceShader(const LobeSum& model, std::span<const std::vector<double>> values,
                std::span<const Interface<double>> surfaces, std::span<const double> wavelengths_nm,
                const MaterialEnergy* energy = nullptr) {
    std::vector<double> n, k, r0;
    for (const Interface<double>& surface : surfaces) {
      n.push_back(surface.n);
      k.push_back(surface.k);
      r0.push_back(surface.r0());
    }
    for (const double nm : wavelengths_nm) wavelengths_um_.push_back(nm * 1e-3);
    const Lanes lanes_n = Lanes::from(n), lanes_k = Lanes::from(k);
    for (std::size_t b = 0; b < N; ++b)
      surface_.push_back({lanes_n.part[b], lanes_k.part[b], surfaces.front().perfect});
    wavelength_um_ = Lanes::from(wavelengths_um_);
    mean_r0_ = mean(r0);
    const std::vector<double> means = mean_values(model, values);
    const std::vector<Brdf<double>> lobes = make_brdfs(model, means);
    for (std::size_t j = 0; j < lobes.size(); ++j) {
      lobes_.push_back({lobes[j], spread_brdf<FloatLanes>(model.lobes()[j], model.values_of(j, means))});
      has_lobe_ = has_lobe_ || lobes_[j].is_lit();
      has_delta_ = has_delta_ || lobes_[j].may_be_delta();
    }
    diffuse_ = lobes[0].diffuse_times_r0() ? Lanes::from(r0) : Lanes(1.0F);
    diffuse_ *= static_cast<float>(lobes[0].kd / kPi<double>);
    set_spectra(model, values, means);
    mixture_ = SumMixture(lobes, wavelengths_um_.back());
    set_energy(energy);
  }
  /// Of values that serve all wavelengths.
  SurfaceShader(const LobeSum& model, const std::vector<double>& values, std::span<const Interface<double>> surfaces,
                std::span<const double> wavelengths_nm, const MaterialEnergy* energy = nullptr)
      : SurfaceShader(model, std::span(&values, 1), surfaces, wavelengths_nm, energy) {}

  /// f·factor, without the delta; 0 below the horizon.
  Lanes evaluate(const LocalDirection& i, const LocalDirection& o, double factor) const {
    if (i.z <= 0 || o.z <= 0) return Lanes(0.0F);
    Lanes f = diffuse_;
    f *= static_cast<float>(factor);
    if (!has_lobe_) return f;
    const Directions<double> given = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
    for (const ShadedLobe& lobe : lobes_)
      if (lobe.is_lit()) {
        add_lobe(f, lobe, lobe.brdf.retro ? turned_back(given) : given, factor);
        if (lobe.compensation) add_compensation(f, lobe, i, o, factor);
      }
    return f;
  }

  /// Density of sample()'s directions that are no delta, per steradian.
  double pdf(const LocalDirection& i, const LocalDirection& o) const {
    if (!(i.z > 0) || !(o.z > 0)) return 0;
    return (1 - delta_shares(o.z).sum) * mixture_.pdf(i, o, shares_towards(o));
  }

  /// A mixture of the coherent deltas, a cosine lobe and the lobes' own samplers. Empty when the drawn direction lies
  /// below the horizon (it carries nothing) or the surface is black.
  std::optional<Sample> sample(const LocalDirection& o, Random& random) const {
    const DeltaShares shares = delta_shares(o.z);
    const double choice = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
    if (choice < shares.sum) return delta_sample(o, shares, choice);
    const auto drawn = mixture_.sample(o, shares_towards(o), (choice - shares.sum) / (1 - shares.sum), u1, u2);
    const double pdf_per_sr = (1 - shares.sum) * drawn.pdf_per_sr;
    if (!(pdf_per_sr > 0)) return {};
    return Sample{drawn.direction, evaluate(drawn.direction, o, drawn.direction.z / pdf_per_sr), pdf_per_sr, false};
  }

 private:
  /// A coherent share below this is lost in the rounding of float radiances.
  static constexpr double kLeastCoherent = 1e-9;
  static constexpr double kLeastEnergy = 1e-6;  ///< of a lobe, so that what its curve rounds to nothing is sampled

  /// A lobe of the sum in both number types, kd and ks the means over the wavelengths.
  struct ShadedLobe {
    Brdf<double> brdf;
    Brdf<FloatLanes> lanes;
    Lanes ks_over_mean{1.0F};  ///< 1 where one ks serves all
    ReflectanceCurve e{};      ///< mean over wavelengths and azimuths, ks = 1
    std::optional<Compensation> compensation{};
    Lanes compensated{0.0F};  ///< ks·C
    double mean_colour = 0;

    bool is_lit() const { return !std::holds_alternative<Lambert>(brdf.lobe) && brdf.ks > 0; }
    bool may_be_delta() const { return is_lit() && has_delta(brdf.lobe); }
  };

  /// Shares of the samples that are a lobe's coherent delta, and their sum.
  struct DeltaShares {
    std::array<double, LobeSum::kMostLobes> of{};
    double sum = 0;
  };

  static double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  /// kd and ks are means; the others are alike at every wavelength.
  static std::vector<double> mean_values(const LobeSum& model, std::span<const std::vector<double>> values) {
    std::vector<double> means = values.front();
    if (values.size() == 1) return means;
    for (std::size_t p = 0; p < means.size(); ++p)
      if (model.is_diffuse(p) || model.is_scale(p)) means[p] = mean(spectrum(values, p));
    return means;
  }
  static std::vector<double> spectrum(std::span<const std::vector<double>> values, std::size_t parameter) {
    std::vector<double> all;
    for (const std::vector<double>& list : values) all.push_back(list[parameter]);
    return all;
  }

  /// kd and ks of each wavelength over their means.
  void set_spectra(const LobeSum& model, std::span<const std::vector<double>> values, std::span<const double> means) {
    if (values.size() == 1) return;
    for (std::size_t p = 0; p < means.size(); ++p) {
      if (!(means[p] > 0)) continue;
      std::vector<double> relative = spectrum(values, p);
      for (double& value : relative) value /= means[p];
      const Lanes lanes = Lanes::from(relative);
      if (model.is_diffuse(p)) diffuse_ *= lanes;
      if (model.is_scale(p)) lobes_[model.place(p).lobe].ks_over_mean = lanes;
    }
  }

  void set_energy(const MaterialEnergy* energy) {
    for (std::size_t j = 0; energy && j < lobes_.size(); ++j) {
      ShadedLobe& lobe = lobes_[j];
      const LobeEnergy& known = energy->lobes[j];
      for (std::size_t w = 0; w < known.wavelengths(); ++w)
        lobe.e.add(known.at(w).around(), 1 / static_cast<double>(known.wavelengths()));
      if (energy->compensations.empty()) continue;
      lobe.compensation = energy->compensations[j];
      lobe.compensated = Lanes::from(lobe.compensation->colour());
      lobe.compensated *= lobe.ks_over_mean;
      lobe.compensated *= static_cast<float>(lobe.brdf.ks);
      lobe.mean_colour = mean(lobe.compensation->colour());
    }
    std::size_t parts = lobes_[0].brdf.kd > 0 ? 1 : 0;
    for (const ShadedLobe& lobe : lobes_) parts += (lobe.is_lit() ? 1 : 0) + (lobe.compensation ? 1 : 0);
    fixed_shares_ = parts <= 1 || !energy;
    shares_ = shares_towards_anew({0, 0, 1});
  }

  /// Shares of the parts among the samples for light towards the eye o: what each reflects of it.
  SumMixture::Shares shares_towards(const LocalDirection& o) const {
    return fixed_shares_ ? shares_ : shares_towards_anew(o);
  }
  SumMixture::Shares shares_towards_anew(const LocalDirection& o) const {
    SumMixture::Shares energies{};
    for (std::size_t j = 0; j < lobes_.size(); ++j) {
      const ShadedLobe& lobe = lobes_[j];
      const PartEnergies<double> roughly = part_energies(lobe.brdf, mean_r0_);
      energies[0] += roughly.diffuse;
      if (!lobe.is_lit() || std::holds_alternative<Mirror>(lobe.brdf.lobe)) continue;
      energies[j + 1] = lobe.e.empty() ? roughly.lobe : lobe.brdf.ks * std::max(lobe.e(o.z), kLeastEnergy);
      if (lobe.compensation)
        energies[0] += lobe.brdf.ks * lobe.mean_colour * std::max(0.0, lobe.compensation->lost(o.z));
    }
    return SumMixture::shares(energies);
  }

  /// ks·C·(1 - E(i))(1 - E(o))/(π(1 - Ē)).
  void add_compensation(Lanes& f, const ShadedLobe& lobe, const LocalDirection& i, const LocalDirection& o,
                        double factor) const {
    const auto cos_2phi = [](const LocalDirection& v) {
      const double across2 = v.x * v.x + v.y * v.y;
      return across2 > 0 ? (v.x * v.x - v.y * v.y) / across2 : 1;
    };
    const auto shape = [&](std::size_t w) {
      return static_cast<float>(factor * lobe.compensation->shape(w, i.z, cos_2phi(i), o.z, cos_2phi(o)));
    };
    if (lobe.compensation->wavelengths() == 1) {
      f += lobe.compensated * shape(0);
    } else {
      std::array<double, N * kLane> shapes{};
      const std::size_t count = lobe.compensation->wavelengths();
      for (std::size_t w = 0; w < shapes.size(); ++w) shapes[w] = w < count ? double(shape(w)) : shapes[count - 1];
      f += lobe.compensated * Lanes::from(shapes);
    }
  }

  void add_lobe(Lanes& f, const ShadedLobe& lobe, const Directions<double>& w, double factor) const {
    const FloatLanes cos_d(static_cast<float>(w.cos_d));
    const auto reflectance = [&](std::size_t b) { return facet_reflectance(lobe.lanes.lobe, cos_d, surface_[b]); };
    if (lobe.brdf.diffracts()) {
      const FloatLanes scale(static_cast<float>(lobe.brdf.ks * factor));
      for (std::size_t b = 0; b < N; ++b)
        f.part[b] +=
            scale * lobe.ks_over_mean.part[b] * reflectance(b) * lobe_shape(lobe.lanes.lobe, w, wavelength_um_.part[b]);
    } else {
      const double shape = lobe_shape(lobe.brdf.lobe, w, wavelengths_um_.back());
      const FloatLanes scale(static_cast<float>(lobe.brdf.ks * factor * shape));
      for (std::size_t b = 0; b < N; ++b) f.part[b] += scale * lobe.ks_over_mean.part[b] * reflectance(b);
    }
  }

  /// In proportion to the energies of deltas and of the rest, but neither all deltas nor the rest starved.
  DeltaShares delta_shares(double cos_o) const {
    DeltaShares shares;
    if (!has_delta_) return shares;
    double diffuse = 0, glossy = 0, coherent = 0;
    for (std::size_t j = 0; j < lobes_.size(); ++j) {
      const Brdf<double>& brdf = lobes_[j].brdf;
      const PartEnergies<double> energies = part_energies(brdf, mean_r0_);
      diffuse += energies.diffuse;
      glossy += energies.lobe;
      if (!lobes_[j].may_be_delta()) continue;
      const double share = mean_coherent_share(brdf, cos_o);
      if (share >= kLeastCoherent) coherent += shares.of[j] = energies.lobe * share;
    }
    if (coherent == 0) return shares;
    const bool nothing_else = diffuse == 0 && std::holds_alternative<Mirror>(lobes_[0].brdf.lobe);
    shares.sum = nothing_else ? 1 : std::clamp(coherent / (diffuse + glossy), 0.05, 0.9);
    for (double& one : shares.of) one = one / coherent * shares.sum;
    return shares;
  }

  double mean_coherent_share(const Brdf<double>& brdf, double cos_o) const {
    double sum = 0;
    for (const double um : wavelengths_um_) sum += coherent_share(brdf.lobe, cos_o, um);
    return sum / static_cast<double>(wavelengths_um_.size());
  }

  /// `choice` below the sum of the shares takes one of the deltas.
  Sample delta_sample(const LocalDirection& o, const DeltaShares& shares, double choice) const {
    std::size_t taken = 0, last = 0;
    for (std::size_t j = 0; j < lobes_.size(); ++j)
      if (shares.of[j] > 0) last = j;
    for (; taken < last && choice >= shares.of[taken]; ++taken) choice -= shares.of[taken];
    const ShadedLobe& lobe = lobes_[taken];
    const LocalDirection i = lobe.brdf.retro ? o : LocalDirection{-o.x, -o.y, o.z};
    return {i, coherent(lobe, o.z, 1 / shares.of[taken]), 0, true};
  }

  Lanes coherent(const ShadedLobe& lobe, double cos_o, double factor) const {
    const FloatLanes cosine(static_cast<float>(cos_o)), scale(static_cast<float>(factor));
    Lanes energy;
    for (std::size_t b = 0; b < N; ++b)
      energy.part[b] =
          scale * lobe.ks_over_mean.part[b] * coherent_energy(lobe.lanes, cosine, surface_[b], wavelength_um_.part[b]);
    return energy;
  }

  std::vector<ShadedLobe> lobes_;
  std::vector<Interface<FloatLanes>> surface_;  ///< one a batch of wavelengths
  Lanes wavelength_um_, diffuse_;               ///< diffuse_ = kd·ρd/π
  std::vector<double> wavelengths_um_;
  SumMixture mixture_;
  SumMixture::Shares shares_{1};
  bool fixed_shares_ = true;
  double mean_r0_ = 1;
  bool has_lobe_ = false, has_delta_ = false;
};

}  // namespace gonio
