#include "energy/compensation.h"

#include <boost/math/quadrature/gauss.hpp>

#include "base/error.h"

namespace gonio {
namespace {

bool reciprocal(const Lobe<double>& lobe) { return !std::holds_alternative<PhongHighlight<double>>(lobe); }

/// The lobe with all reflectance that it holds itself taken for 1.
Lobe<double> whitened(const Lobe<double>& lobe) {
  Lobe<double> white = lobe;
  if (auto* one = std::get_if<AshikhminShirley<double>>(&white)) one->f0 = 1 - 1e-6, one->rd = 0;
  return white;
}

/// R̄ = 2∫ R(cos) cos d cos, what facets reflect of uniform light; 1 where the parameters hold the reflectance.
double mean_reflectance(const Lobe<double>& lobe, const Interface<double>& surface) {
  if (const auto* one = std::get_if<AshikhminShirley<double>>(&lobe))
    return one->f0 + (1 - one->f0) / 21;  // Schlick's law
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  double sum = 0;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      const double root = 0.5 * (1 + side * Gauss::abscissa()[i]), cosine = square(root);  // close next to grazing
      sum += 0.5 * Gauss::weights()[i] * 4 * root * cosine * facet_reflectance<double>(lobe, cosine, surface);
    }
  return sum;
}

SpectralSurface white_surface(const Lobe<double>& lobe, const SpectralSurface& surface) {
  const std::size_t count = diffracts(lobe) ? surface.size() : 1;
  return {std::vector(count, perfect_interface<double>()),
          {surface.wavelength_um.begin(), surface.wavelength_um.begin() + static_cast<std::ptrdiff_t>(count)}};
}

/// The lobe's E and its delta's, which is no loss.
AzimuthalCurve with_delta(const AzimuthalCurve& e, const Lobe<double>& lobe, double wavelength_um) {
  if (!has_delta(lobe)) return e;
  ReflectanceCurve sum = e.around();
  sum.add(ReflectanceCurve::of([&](double cosine) { return coherent_share(lobe, cosine, wavelength_um); }), 1);
  return AzimuthalCurve(std::move(sum));
}

}  // namespace

CompensationKind compensation_from(std::string_view name) {
  if (name == "none") return CompensationKind::none;
  if (name == "kulla-conty-2017") return CompensationKind::kulla_conty_2017;
  throw input_error("{}: unknown compensation; expected none or kulla-conty-2017", name);
}

Compensation::Compensation(const Lobe<double>& lobe, const SpectralSurface& surface) {
  if (unbounded_at_grazing(lobe))
    throw input_error("E grows without bound next to grazing; expected a lobe with E <= 1 to compensate");
  if (!reciprocal(lobe)) throw input_error("the lobe is not reciprocal; expected one that is to compensate");
  const Lobe<double> white_lobe = whitened(lobe);
  const SpectralSurface white = white_surface(lobe, surface);
  const LobeEnergy energy(white_lobe, white);
  for (std::size_t w = 0; w < white.size(); ++w) {
    White one{with_delta(energy.at(w), lobe, white.wavelength_um[w])};
    const auto largest = one.e.largest();
    if (largest.value > 1 + energy.error())
      throw input_error(
          "E is {:.6g} at {:.4g} degrees on facets that reflect everything; expected a lobe with E <= 1 to compensate",
          largest.value, std::acos(largest.cos_theta) * 180 / kPi<double>);
    // The mean of what missing() gives, so that the two together reflect 1 exactly.
    const double lost =
        ReflectanceCurve::of([&](double cosine) { return std::max(0.0, 1 - one.e.around()(cosine)); }).mean();
    one.factor = lost > 0 ? 1 / (kPi<double> * lost) : 0;
    white_.push_back(std::move(one));
  }
  for (std::size_t w = 0; w < surface.size(); ++w) {
    const double mean = white_[white_.size() > 1 ? w : 0].e.mean(), r = mean_reflectance(lobe, surface.interfaces[w]);
    const double absorbed = 1 - r * (1 - mean);
    colour_.push_back(absorbed > 0 ? square(r) * mean / absorbed : 1.0);
  }
}

}  // namespace gonio
