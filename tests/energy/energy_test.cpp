#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "base/error.h"
#include "catch.h"
#include "energy/limits.h"

using namespace gonio;
using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;

namespace {

const SpectralSurface kPerfect{{perfect_interface<double>()}, {0.55}};

/// ∫ f cos_o dω_o over the angles of o themselves, cut at the mirror direction and multiples of the lobe's width: another
/// road than either of the library's.
double over_angles(const Lobe<double>& lobe, double theta_i_deg, double alpha) {
  const double width = 2 * alpha * 180 / kPi<double>;
  const auto over_theta = [&](double delta_deg) {
    const auto f = [&](double theta_o) {
      const Directions<double> w = directions_from_deg(theta_i_deg, theta_o, 180 - delta_deg);
      return lobe_shape(lobe, w, 0.55) * cos_deg(theta_o) * sin_deg(theta_o);
    };
    std::vector<double> cuts{0, 90 - 1e-9};
    for (const double k : {-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0})
      cuts.push_back(std::clamp(theta_i_deg + k * width, 0.0, 90 - 1e-9));
    for (const double theta : {80.0, 88.0, 89.5, 89.95}) cuts.push_back(theta);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      if (cuts[i + 1] > cuts[i]) sum += Rule::integrate(f, cuts[i], cuts[i + 1], 7, 1e-9);
    return sum * kPi<double> / 180;
  };
  std::vector<double> cuts{0, 180};
  for (const double k : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0})
    cuts.push_back(std::min(180.0, k * width / std::max(sin_deg(theta_i_deg), 0.2)));
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (cuts[i + 1] > cuts[i]) sum += Rule::integrate(over_theta, cuts[i], cuts[i + 1], 5, 1e-8);
  return 2 * sum * kPi<double> / 180;
}

}  // namespace

TEST_CASE("E agrees with quadrature over the outgoing angles, F = 1, m 0.02 to 1, 0 to 89 degrees", "[energy]") {
  double worst = 0;
  for (const Shadowing shadowing : {Shadowing::v_cavity, Shadowing::smith_separable})
    for (const double m : {0.02, 0.3, 1.0})
      for (const double theta : {0.0, 45.0, 75.0, 89.0}) {
        const Lobe<double> lobe = TorranceSparrow<double>{std::sqrt(2.0) * m, shadowing};
        const Estimate e = directional_reflectance(lobe, theta, kPerfect)[0];
        const double other = over_angles(lobe, theta, std::sqrt(2.0) * m);
        INFO(name_of(shadowing) << " m " << m << " theta " << theta << ": " << e.value << " ± " << e.error
                                << " against " << other);
        CHECK(e.converged);
        CHECK(std::abs(e.value - other) < 1e-6);
        worst = std::max(worst, std::abs(e.value - other));
      }
  INFO("largest difference " << worst);
  CHECK(worst < 1e-6);
}

TEST_CASE("The two methods agree on faceted lobes", "[energy]") {
  for (const double m : {0.05, 0.2, 0.6, 1.0})
    for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
      const Lobe<double> lobe = TorranceSparrow<double>{std::sqrt(2.0) * m, Shadowing::smith_correlated};
      const double slopes = reflectance_over_slopes(lobe, theta, kPerfect, 1e-9)[0].value;
      const double cosines = reflectance_over_direction_cosines(lobe, theta, kPerfect, 1e-9)[0].value;
      INFO("m " << m << " theta " << theta);
      CHECK(std::abs(slopes - cosines) < 1e-7);
    }
}

TEST_CASE("The pseudo-realistic model: √(2π)·m for small m, 1.149 at m = 1 and 89 degrees", "[energy]") {
  // PHYSICS, Reflection models 2.
  CHECK(directional_reflectance(PseudoRealistic<double>{0.001}, 0, kPerfect)[0].value ==
        Approx(std::sqrt(2 * kPi<double>) * 0.001).epsilon(1e-5));
  CHECK(directional_reflectance(PseudoRealistic<double>{1.0}, 89, kPerfect)[0].value == Approx(1.149).margin(5e-4));
}

TEST_CASE("Beckmann-Kirchhoff is not conserving away from the normal: 1.02 at 75 degrees, 1.7 at 89", "[energy]") {
  // PHYSICS, Reflection models 4: σ/λ = 0.2, T/λ = 3, coherent and incoherent together.
  const BeckmannKirchhoff<double> lobe{0.2 * 0.55, 3 * 0.55};
  for (const auto& [theta, expected, margin] : {std::tuple{75.0, 1.02, 0.005}, std::tuple{89.0, 1.7, 0.05}}) {
    const double e =
        directional_reflectance(lobe, theta, kPerfect)[0].value + lobe.coherent_share(cos_deg(theta), 0.55);
    CHECK(e == Approx(expected).margin(margin));
  }
}

TEST_CASE("Limits: a conserving white lobe, a broken one, a diffuse one", "[energy]") {
  const SurfaceSamples samples{{0}, kPerfect};
  const Brdf<double> white{TorranceSparrow<double>{std::sqrt(2.0) * 0.02, Shadowing::smith_correlated}, 0, 1};
  const Limits conserving = conservation_limits(white, samples, limit_angles_deg());
  CHECK(conserving.holds());
  CHECK(conserving.ks_max == Approx(1).margin(1e-6));
  const Brdf<double> rough{PseudoRealistic<double>{1.0}, 0, 1};
  const Limits broken = conservation_limits(rough, samples, limit_angles_deg());
  CHECK_FALSE(broken.holds());
  CHECK(broken.ks_max == Approx(1 / broken.worst_total).epsilon(1e-6));
  CHECK(broken.worst_total > 1.149);
  CHECK(broken.kd_max == 0);
  const Brdf<double> half{PseudoRealistic<double>{1.0}, 0, 0.5};
  CHECK(conservation_limits(half, samples, limit_angles_deg()).kd_max ==
        Approx(1 - 0.5 * broken.worst_total).margin(1e-6));
  CHECK(conservation_limits({Lambert{}, 1, 0}, samples, {0.0}).kd_max == 1);
  CHECK_FALSE(conservation_limits({Lambert{}, 1.01, 0}, samples, {0.0}).holds());
}

TEST_CASE("Limits of a lobe that is unbounded at grazing", "[energy][slow]") {
  const SurfaceSamples samples{{0}, kPerfect};
  const Brdf<double> kirchhoff{BeckmannKirchhoff<double>{0.5, 5}, 0, 1};
  const Limits unbounded = conservation_limits(kirchhoff, samples, limit_angles_deg());
  CHECK_FALSE(unbounded.holds());
  CHECK(unbounded.theta_max_deg == 75);
}

TEST_CASE("Many wavelengths at once give what each gives alone", "[energy][slow]") {
  SpectralSurface surface;
  for (int i = 0; i < 11; ++i) {
    surface.interfaces.push_back({0.2 + 0.1 * i, 3.0 - 0.2 * i});
    surface.wavelength_um.push_back(0.4 + 0.03 * i);
  }
  for (const Lobe<double>& lobe : {Lobe<double>(TorranceSparrow<double>{0.4, Shadowing::v_cavity}),
                                   Lobe<double>(BeckmannKirchhoff<double>{0.2, 3})}) {
    const auto together = directional_reflectance(lobe, 50, surface);
    for (std::size_t i = 0; i < surface.size(); i += 5) {
      const double alone =
          directional_reflectance(lobe, 50, {{surface.interfaces[i]}, {surface.wavelength_um[i]}})[0].value;
      CHECK(together[i].value == Approx(alone).margin(2e-7));
    }
  }
}

TEST_CASE("the part that dominates under uniform light is told", "[energy][limits]") {
  const SurfaceSamples glass{{550}, {{{1.5, 0, false}}, {0.55}}};
  const auto limits = [&](double kd, double ks) {
    return conservation_limits(Brdf<double>{TorranceSparrow<double>{0.3}, kd, ks}, glass, {0, 45, 80});
  };
  const Limits lobe_only = limits(0, 1);
  CHECK(std::string(lobe_only.behaviour()) == "specular");
  CHECK(lobe_only.lobes_most == Approx(1 / lobe_only.ks_max).margin(1e-5));
  CHECK(std::string(limits(0.1, 0.6).behaviour()) == "specular");
  CHECK(std::string(limits(0.3, 0.6).behaviour()) == "diffuse");  // E of glass is 0.32 at most
  CHECK(std::string(limits(0.6, 0.3).behaviour()) == "diffuse");
  CHECK(limits(0.6, 0.3).diffuse_least == 0.6);
}
