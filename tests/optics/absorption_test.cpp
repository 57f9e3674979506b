// Absorption against the thesis's Table 1, the good conductor's limit, and Beer's law.
#include "optics/absorption.h"

#include "catch.h"
#include "optics/fresnel.h"

using namespace gonio;

TEST_CASE("Table 1: depths of the intensity at 589.3 nm", "[optics]") {
  // Maillot 1996, Table 1, in cm (gold misread as 15e-5). The k are known to two digits, and glass's 29 cm asks
  // for 1.6e-7.
  struct Row {
    double k, depth_cm;
  };
  for (const Row row : {Row{1.4e-7, 32}, Row{1.5e-7, 29}, Row{0.8, 6e-6}, Row{3.2, 1.5e-6}})
    CHECK(intensity_depth(row.k, 589.3e-7) == Approx(row.depth_cm).epsilon(0.08));
  CHECK(field_depth(0.8, 500.0) == 2 * intensity_depth(0.8, 500.0));
  CHECK(std::isinf(field_depth(0.0, 500.0)));
}

TEST_CASE("A good conductor: skin depth, n = k, Hagen and Rubens", "[optics]") {
  // Copper, 5.96e7 S/m, at 1 mm (300 GHz): skin depth √(2/(ω·µ0·γ)) = 119 nm; 1 - R = 2√(2·ε0·ω/γ).
  const double conductivity = 5.96e7, nm = 1e6, omega = angular_frequency(nm);
  const ComplexIndex<double> copper = index_of_conductivity(1.0, conductivity, nm);
  CHECK(copper.n == Approx(copper.k).epsilon(1e-5));
  const double skin_m = std::sqrt(2 / (omega * kMagneticConstant * conductivity));
  CHECK(field_depth(copper.k, nm * 1e-9) == Approx(skin_m).epsilon(1e-5));
  CHECK(skin_m == Approx(119.1e-9).epsilon(2e-3));
  const double loss = 2 * std::sqrt(2 * kElectricConstant * omega / conductivity);
  CHECK(1 - normal_reflectance(copper.n, copper.k) == Approx(loss).epsilon(2e-3));
}

TEST_CASE("Conductivity: n² - k² = ε_r and 2nk = γ/(ωε0), without cancellation", "[optics]") {
  for (const double eps : {1.0, 2.25, 80.0, -20.0})
    for (const double conductivity : {1e-12, 1e-3, 5.0, 1e5, 1e9}) {
      const ComplexIndex<double> index = index_of_conductivity(eps, conductivity, 550.0);
      const double x = conductivity / (angular_frequency(550.0) * kElectricConstant);
      INFO("eps_r " << eps << ", conductivity " << conductivity);
      CHECK(2 * index.n * index.k == Approx(x).epsilon(1e-14));
      CHECK(index.n * index.n - index.k * index.k == Approx(eps).epsilon(1e-12).margin(1e-14 * x));
      CHECK((index.n > 0 && index.k > 0));
    }
  // A weak conductor: k = x/(2√ε_r) to first order, where √(√(ε²+x²) - ε) would have lost every digit.
  const double x = 1e-12 / (angular_frequency(550.0) * kElectricConstant);
  CHECK(index_of_conductivity(2.25, 1e-12, 550.0).k == Approx(x / 3).epsilon(1e-14));
}

TEST_CASE("Internal transmittance: Beer's law and the depth it defines", "[optics]") {
  const double k = 1.3e-6, nm = 632.8;
  CHECK(internal_transmittance(k, intensity_depth(k, nm), nm) == Approx(std::exp(-1.0)).epsilon(1e-14));
  CHECK(internal_transmittance(k, 3e6, nm) ==
        Approx(internal_transmittance(k, 1e6, nm) * internal_transmittance(k, 2e6, nm)).epsilon(1e-13));
  CHECK(internal_transmittance(0.0, 1e9, nm) == 1);
  // SCHOTT's N-BK7 data sheet: internal transmittance 0.997 through 10 mm at 404.7 nm is k = 9.7e-9.
  CHECK(internal_transmittance(9.7e-9, 1e7, 404.7) == Approx(0.997).margin(5e-4));
}
