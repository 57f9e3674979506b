#include "fit/plausibility.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/sampling.h"
#include "energy/directional_reflectance.h"
#include "fit/fitted_material.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kMuchMore = 10;     // how ≫ is read
constexpr double kMostHidden = 0.1;  // share that shadowing would take
constexpr double kWideSlopes = 1;    // alpha
constexpr double kMostCosineLoss =
    5;  // r_c needed at grazing grows without limit; beyond this only the normal's is named

/// A lobe of a fit, and where the scan looked at it.
struct Seen {
  const ModelSpec& spec;
  const Brdf<double>& brdf;
  double theta_max_deg;
  std::optional<double> longest_um;

  std::string_view name() const { return spec.info().name; }
};

/// σ and T of a Gaussian autocorrelation.
struct Heights {
  double sigma_um, correlation_um;
  double radius_of_curvature_um() const { return square(correlation_um) / (2 * std::sqrt(3.0) * sigma_um); }
};

std::optional<Heights> heights_of(const Lobe<double>& lobe) {
  if (const auto* one = std::get_if<BeckmannKirchhoff<double>>(&lobe))
    return Heights{one->sigma_um, one->correlation_um};
  if (const auto* one = std::get_if<HeTorrance<double>>(&lobe)) return Heights{one->sigma0_um, one->correlation_um};
  return std::nullopt;
}

void tangent_plane(const Seen& seen, std::vector<std::string>& found) {
  const std::optional<Heights> heights = heights_of(seen.brdf.lobe);
  if (!heights || !seen.longest_um) return;
  const double lambda = *seen.longest_um, waves = 4 * kPi<double> * heights->radius_of_curvature_um() / lambda;
  if (!(heights->correlation_um > lambda))
    found.push_back(fmt::format(
        "{}: T = {:.3g} um is no longer than the wavelength ({:.3g} um), which a tangent plane needs (k T > 6: "
        "Ulaby, Moore & Fung 1982)",
        seen.name(), heights->correlation_um, lambda));
  const double cosine = std::max(cos_deg(seen.theta_max_deg), 1 / kMostCosineLoss);
  if (waves * cosine < kMuchMore)
    found.push_back(fmt::format(
        "{}: sigma and T make a radius of curvature of {:.3g} um, 4 pi r cos(theta) = {:.3g} wavelengths at {:.3g} "
        "degrees; a tangent plane needs many (10: Maillot 1996 after Brekhovskikh)",
        seen.name(), heights->radius_of_curvature_um(), waves * cosine, std::acos(cosine) * 180 / kPi<double>));
}

void no_shadowing(const Seen& seen, double alpha, std::vector<std::string>& found) {
  const Lobe<double>& lobe = seen.brdf.lobe;
  if (!std::holds_alternative<BeckmannKirchhoff<double>>(lobe) && !std::holds_alternative<Stogryn<double>>(lobe))
    return;
  const double tan2 = square(sin_deg(seen.theta_max_deg) / cos_deg(seen.theta_max_deg));
  const double hidden = 1 - 1 / (1 + smith_lambda(tan2, alpha));
  if (hidden > kMostHidden)
    found.push_back(fmt::format(
        "{} has no shadowing, which slopes of m = {:.3g} would need: at {:.3g} degrees they hide {:.2g} of the "
        "surface (Smith 1967)",
        seen.name(), alpha / std::sqrt(2.0), seen.theta_max_deg, hidden));
}

/// What facets of reflectance 1 lose at the normal, where the model claims to lose nothing else.
std::string missing_light(const Seen& seen) {
  if (!seen.spec.info().conserving) return "";
  const SpectralSurface perfect{{perfect_interface<double>()}, {seen.longest_um.value_or(1)}};
  const double lost = 1 - directional_reflectance(seen.brdf.lobe, 0, perfect, 1e-3).front().value;
  return lost > 0.01 ? fmt::format(", {:.2g} of it at the normal on perfect facets", lost) : "";
}

void steep_slopes(const Seen& seen, double alpha, std::vector<std::string>& found) {
  const Lobe<double>& lobe = seen.brdf.lobe;
  const bool other_widths =
      std::holds_alternative<LowSmooth<double>>(lobe) || std::holds_alternative<LowMicrofacet<double>>(lobe);
  if (!seen.brdf.facets() || other_widths || !(alpha > kWideSlopes)) return;
  found.push_back(fmt::format(
      "{}: slopes of alpha = {:.3g} (m = {:.3g}) send much light to other facets first, and a single scattering "
      "leaves that out{}",
      seen.name(), alpha, alpha / std::sqrt(2.0), missing_light(seen)));
}

}  // namespace

std::vector<std::string> implausible_lobes(const FitResult& result) {
  std::vector<std::string> found;
  const FittedMaterial material = fitted_material(result);
  const std::optional<double> nm =
      result.wavelength_nm.empty() ? result.assumed_wavelength_nm : std::optional(result.wavelength_nm.back());
  double theta_max_deg = 0;
  for (const FittedPoint& p : result.points)
    if (p.used) theta_max_deg = std::max({theta_max_deg, p.theta_i_deg, p.theta_o_deg});
  const std::vector<Brdf<double>> lobes = material.brdfs(nm);
  for (std::size_t j = 0; j < lobes.size(); ++j) {
    if (!(lobes[j].ks > 0) || std::holds_alternative<Lambert>(lobes[j].lobe) ||
        std::holds_alternative<Mirror>(lobes[j].lobe))
      continue;
    const Seen seen{result.model.lobes()[j], lobes[j], theta_max_deg, nm ? std::optional(*nm * 1e-3) : std::nullopt};
    const std::optional<Heights> heights = heights_of(lobes[j].lobe);
    const double alpha = heights ? 2 * heights->sigma_um / heights->correlation_um
                                 : slope_extent(lobes[j].lobe, seen.longest_um.value_or(1)).widest;
    tangent_plane(seen, found), no_shadowing(seen, alpha, found), steep_slopes(seen, alpha, found);
  }
  return found;
}

std::vector<std::string> implausible_index(const FitResult& result, const std::optional<std::string>& material) {
  std::vector<std::string> found;
  const std::optional<double> n = result.index();
  if (!n) return found;
  const std::optional<double> k = result.absorption();
  constexpr double kLow = 1.2, kHigh = 2.6, kOpaque = 0.1, kSame = 1.05;
  if (!k && !(*n >= kLow && *n <= kHigh))
    found.push_back(fmt::format(
        "fitted n = {:.4g} is no dielectric's ({} to {}): the scan's absolute level, or a metal, may be in it", *n,
        kLow, kHigh));
  const double nm = result.wavelength_nm.empty() ? result.assumed_wavelength_nm.value_or(0)
                                                 : result.wavelength_nm[result.wavelength_nm.size() / 2];
  if (!material || !(nm > 0)) return found;
  const SurfaceMaterial named(*material);
  if (named.is_perfect() || !(nm >= named.range_lo_nm() && nm <= named.range_hi_nm())) return found;
  const Interface<double> known = named.at(nm);
  const FittedParameter& fitted = *result.find("n");
  if (k) {
    // Neither alone: what they reflect at the normal is what a scan is sure of.
    const double r0 = Interface<double>{*n, *k, false}.r0();
    if (std::max(r0 / known.r0(), known.r0() / r0) > kSame)
      found.push_back(
          fmt::format("fitted n = {:.4g}, k = {:.4g} reflect {:.3g} at the normal, and {} {:.3g} at {:g} nm", *n, *k,
                      r0, named.id(), known.r0(), nm));
  } else if (known.k > kOpaque)
    found.push_back(fmt::format("n = {:.4g} was fitted with k = 0, and {} has n = {:.4g}, k = {:.4g} at {:g} nm", *n,
                                named.id(), known.n, known.k, nm));
  else if (std::max(*n / known.n, known.n / *n) > kSame && !(known.n >= fitted.lo95 && known.n <= fitted.hi95))
    found.push_back(
        fmt::format("fitted n = {:.4g} (95 %: {:.4g} to {:.4g}) is {:.3g} times that of {} at {:g} nm, {:.4g}", *n,
                    fitted.lo95, fitted.hi95, *n / known.n, named.id(), nm, known.n));
  return found;
}

}  // namespace gonio
