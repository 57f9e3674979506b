#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "brdf/lobe_sum.h"
#include "brdf/sampling.h"

namespace gonio {

/// The density from which the directions of a sum are drawn that are no delta: a cosine lobe for its diffuse part, and each lobe's own sampler, in shares that may
/// differ from one direction to the next.
class SumMixture {
 public:
  /// The diffuse part first, then the lobes.
  static constexpr std::size_t kMostParts = LobeSum::kMostLobes + 1;
  using Shares = std::array<double, kMostParts>;

  SumMixture() = default;
  SumMixture(std::span<const Brdf<double>> lobes, double wavelength_um) {
    for (const Brdf<double>& lobe : lobes) parts_.push_back({lobe_sampler(lobe.lobe, wavelength_um), 0.0, lobe.retro});
  }

  /// In proportion to what the parts reflect, none that reflects below a tenth of an equal share. Without a part that does anything will do.
  static Shares shares(const Shares& energies) {
    double total = 0;
    std::size_t lit = 0;
    for (const double energy : energies) total += energy, lit += energy > 0 ? 1 : 0;
    if (!(total > 0)) return {1};
    const double least = 0.1 / static_cast<double>(lit);
    Shares all{};
    double sum = 0;
    for (std::size_t p = 0; p < kMostParts; ++p)
      if (energies[p] > 0) sum += all[p] = std::max(energies[p] / total, least);
    for (double& share : all) share /= sum;
    return all;
  }

  /// u0 chooses the part, and what is left of it chooses within.
  DirectionSample<double> sample(const LocalDirection& o, const Shares& shares, double u0, double u1, double u2) const {
    constexpr double kBelowOne = 1 - 0x1p-53;
    std::size_t taken = 0, last = 0;
    for (std::size_t p = 0; p < kMostParts; ++p)
      if (shares[p] > 0) last = p;
    for (; taken < last && u0 >= shares[taken]; ++taken) u0 -= shares[taken];
    const double inner = std::min(u0 / shares[taken], kBelowOne);  // rounding may reach 1
    DirectionSample<double> drawn =
        taken == 0 ? CosineSampler<double>{}.sample(o, inner, u1, u2) : parts_[taken - 1].sample(o, inner, u1, u2);
    if (drawn.pdf_per_sr > 0) drawn.pdf_per_sr = pdf(drawn.direction, o, shares);
    return drawn;
  }

  /// Per steradian, both above the horizon.
  double pdf(const LocalDirection& i, const LocalDirection& o, const Shares& shares) const {
    double sum = shares[0] * i.z / kPi<double>;
    for (std::size_t j = 0; j < parts_.size(); ++j)
      if (shares[j + 1] > 0) sum += shares[j + 1] * parts_[j].pdf(i, o);
    return sum;
  }

 private:
  std::vector<LobeMixture<double>> parts_;  ///< a lobe's sampler each, without a cosine lobe
};

}  // namespace gonio
