#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "brdf/sampling.h"

namespace gonio {

/// The density from which the directions of a sum are drawn that are no delta: the mixtures of its lobes, in proportion
/// to their energies, none that reflects below a tenth of an equal share. Of one lobe it is that lobe's own.
class SumMixture {
 public:
  SumMixture() = default;
  SumMixture(std::span<const Brdf<double>> lobes, double r0, double wavelength_um) {
    double total = 0;
    for (const Brdf<double>& lobe : lobes) {
      const auto [diffuse, glossy] = part_energies(lobe, r0);
      parts_.push_back({lobe_mixture(lobe, r0, wavelength_um), diffuse + glossy});
      total += diffuse + glossy;
    }
    set_shares(total);
  }

  /// u0 chooses the lobe, and what is left of it chooses within the lobe.
  DirectionSample<double> sample(const LocalDirection& o, double u0, double u1, double u2) const {
    std::size_t taken = 0;
    for (; taken + 1 < parts_.size() && u0 >= parts_[taken].share; ++taken) u0 -= parts_[taken].share;
    const Part& part = parts_[taken];
    const double inner = part.share > 0 ? std::min(u0 / part.share, kBelowOne) : u0;  // rounding may reach 1
    DirectionSample<double> drawn = part.mixture.sample(o, inner, u1, u2);
    if (parts_.size() > 1 && drawn.pdf_per_sr > 0) drawn.pdf_per_sr = pdf(drawn.direction, o);
    return drawn;
  }

  /// Per steradian, both above the horizon.
  double pdf(const LocalDirection& i, const LocalDirection& o) const {
    double sum = 0;
    for (const Part& part : parts_) sum += part.share * part.mixture.pdf(i, o);
    return sum;
  }

 private:
  static constexpr double kBelowOne = 1 - 0x1p-53, kLeastOfEqual = 0.1;
  struct Part {
    LobeMixture<double> mixture;
    double share;
  };

  void set_shares(double total) {
    if (!(total > 0)) {  // black: anything will do
      for (Part& part : parts_) part.share = &part == parts_.data() ? 1 : 0;
      return;
    }
    const double least = kLeastOfEqual / static_cast<double>(parts_.size());
    double sum = 0;
    for (Part& part : parts_) {
      part.share = part.share > 0 ? std::max(part.share / total, least) : 0;
      sum += part.share;
    }
    for (Part& part : parts_) part.share /= sum;
  }

  std::vector<Part> parts_;
};

}  // namespace gonio
