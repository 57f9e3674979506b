// Polarised reflection and refraction against Jones calculus written out here with std::complex, and against textbook numbers.
#include <complex>
#include <random>

#include "brdf/directions.h"
#include "catch.h"
#include "optics/fresnel_amplitudes.h"

using namespace gonio;

namespace {

using Real = long double;
using C = std::complex<Real>;

/// The amplitudes as textbooks print them (Born & Wolf §1.5; Bohren & Huffman §2.7).
struct Printed {
  C r_s, r_p, t_s, t_p;
};
Printed printed(double c, double n, double k) {
  const C index(n, k);
  const Real cosine = c, sine2 = 1 - cosine * cosine;
  C w = std::sqrt(index * index - sine2);
  if (w.imag() < 0) w = -w;
  return {(cosine - w) / (cosine + w), (index * index * cosine - w) / (index * index * cosine + w),
          Real(2) * cosine / (cosine + w), Real(2) * index * cosine / (index * index * cosine + w)};
}

/// Stokes vector of a field: I, Q, U, V from intensities behind analysers (0°, 90°, ±45°, circular).
std::array<Real, 4> stokes_of(const C& s, const C& p) {
  const Real r = 1 / std::sqrt(Real(2));
  const auto behind = [&](const C& a, const C& b) { return std::norm(std::conj(a) * s + std::conj(b) * p); };
  return {
      behind(1, 0) + behind(0, 1), behind(1, 0) - behind(0, 1), behind(r, r) - behind(r, -r),
      // right: E_s = cos ωt, E_p = cos(ωt + 90°), clockwise for who sees s to the right, p upwards: E_p = -i·E_s with e^{-iωt}
      behind(r, C(0, -r)) - behind(r, C(0, r))};
}

void same(const Complex<double>& got, const C& expected, double bar) {
  CHECK(std::abs(C(got.re, got.im) - expected) <= bar);
}

const std::pair<double, double> kIndices[] = {{1.5, 0},   {1.0001, 0}, {1 / 1.5, 0}, {0.97, 6.7},
                                              {0.2, 3.3}, {4, 0.05},   {1.33, 1e-9}};

}  // namespace

TEST_CASE("Fresnel's amplitudes equal the textbook's, and their squares the reflectances", "[optics]") {
  for (const auto& [n, k] : kIndices)
    for (const double theta : {0.0, 1e-4, 20.0, 41.0, 56.0, 75.0, 89.0, 89.99}) {
      const double c = cos_deg(theta);
      INFO(n << " + " << k << "i at " << theta);
      const Printed exact = printed(c, n, k);
      const FresnelAmplitudes<double> r = fresnel_amplitudes(c, n, k);
      same(r.s, exact.r_s, 2e-15);
      same(r.p, exact.r_p, 2e-15);
      const Polarised<double> shares = fresnel(c, n, k);
      CHECK(norm(r.s) == Approx(shares.s).epsilon(1e-13));
      CHECK(norm(r.p) == Approx(shares.p).epsilon(1e-12).margin(1e-30));
      if (k > 0) continue;
      const FresnelAmplitudes<double> t = transmission_amplitudes(c, n);
      same(t.s, exact.t_s, 4e-15);
      same(t.p, exact.t_p, 4e-15);
      const double flux = refracted_root(c, n, 0.0).re / c;
      CHECK(norm(t.s) * flux == Approx(dielectric_shares(c, n).transmitted.s).epsilon(1e-12));
      CHECK(norm(t.p) * flux == Approx(dielectric_shares(c, n).transmitted.p).epsilon(1e-12));
    }
  for (const auto& [n, k] : kIndices) {  // grazing: everything turns back, both fields reversed in (s, p)
    same(fresnel_amplitudes(0.0, n, k).s, -1, 1e-15);
    same(fresnel_amplitudes(0.0, n, k).p, -1, 1e-15);
  }
  CHECK(std::isfinite(fresnel_amplitudes(0.0, 1.0, 0.0).p.re));
}

TEST_CASE("An interface's Mueller matrix does to light what its amplitudes do to the field", "[optics]") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  for (const auto& [n, k] : kIndices)
    for (const double theta : {0.0, 15.0, 41.0, 56.0, 80.0, 89.5}) {
      const double c = cos_deg(theta);
      const Printed r = printed(c, n, k);
      const Mueller<double> reflected = reflection_mueller(c, {n, k}), refracted = refraction_mueller(c, n);
      const double flux = refracted_root(c, n, 0.0).re / c;
      for (int i = 0; i < 10; ++i) {
        const C s(gauss(random), gauss(random)), p(gauss(random), gauss(random));
        const auto in = stokes_of(s, p), out = stokes_of(r.r_s * s, r.r_p * p),
                   through = stokes_of(r.t_s * s, r.t_p * p);
        const Stokes<double> light{double(in[0]), double(in[1]), double(in[2]), double(in[3])};
        const Stokes<double> got = reflected * light, passed = refracted * light;
        for (int e = 0; e < 4; ++e) {
          INFO(n << " + " << k << "i at " << theta << ", element " << e);
          CHECK(std::abs(got[e] - double(out[e])) <= 1e-14 * light[0]);
          if (k == 0) CHECK(std::abs(passed[e] - flux * double(through[e])) <= 1e-14 * light[0]);
        }
      }
    }
}

TEST_CASE("mueller_of is Jones calculus for any element", "[optics]") {
  std::mt19937_64 random(6);
  std::normal_distribution<double> gauss;
  const auto draw = [&] { return Complex<double>{gauss(random), gauss(random)}; };
  const auto wide = [](const Complex<double>& z) { return C(z.re, z.im); };
  for (int i = 0; i < 200; ++i) {
    const Jones<double> j{draw(), draw(), draw(), draw()};
    const Complex<double> s = draw(), p = draw();
    const auto in = stokes_of(wide(s), wide(p));
    const auto out =
        stokes_of(wide(j.ss) * wide(s) + wide(j.sp) * wide(p), wide(j.ps) * wide(s) + wide(j.pp) * wide(p));
    const Stokes<double> got =
        mueller_of(j) * Stokes<double>{double(in[0]), double(in[1]), double(in[2]), double(in[3])};
    for (int e = 0; e < 4; ++e) CHECK(got[e] == Approx(double(out[e])).epsilon(1e-12).margin(1e-12));
    CHECK(unpolarised_intensity_of(j) == Approx(mueller_of(j).m[0][0]).epsilon(1e-15));
    const LinearLight<double> light{std::cos(0.1 * i), std::sin(0.1 * i)};
    CHECK(intensity_of(j, light) == Approx((mueller_of(j) * light.stokes())[0]).epsilon(1e-11));
  }
}

TEST_CASE("Known points: Brewster, the mirror at the normal, total reflection, Fresnel's rhomb, Malus", "[optics]") {
  // Brewster: fully s, m12 = +1.
  const double tangent = 1.5, cosine = 1 / std::sqrt(1 + tangent * tangent);
  const Mueller<double> brewster = reflection_mueller(cosine, {1.5, 0});
  CHECK(brewster.m[0][1] / brewster.m[0][0] == Approx(1).epsilon(1e-15));
  CHECK(std::abs(brewster.m[2][2]) < 1e-16);
  // At the normal p turns over and right becomes left.
  for (const auto& [n, k] : kIndices) {
    const Mueller<double> normal = reflection_mueller(1.0, {n, k});
    CHECK(normal.m[2][2] == Approx(-normal_reflectance(n, k)).epsilon(1e-12));
    CHECK(normal.m[3][3] == Approx(-normal_reflectance(n, k)).epsilon(1e-12));
    CHECK(std::abs(normal.m[0][1]) < 1e-15);
  }
  CHECK(reflection_mueller(0.3, perfect_interface<double>()).m[2][2] == -1);
  // Total reflection, Born & Wolf §1.5.4 (60): tan(δ/2) = cos θ·√(sin²θ - n²)/sin²θ, δ = δ_s - δ_p.
  for (const double theta : {42.0, 51.3, 60.0, 89.0}) {
    const double n = 1 / 1.5, s2 = square(sin_deg(theta)),
                 delta = 2 * std::atan(cos_deg(theta) * std::sqrt(s2 - n * n) / s2);
    const Mueller<double> m = reflection_mueller(cos_deg(theta), {n, 0});
    CHECK(m.m[2][2] == Approx(std::cos(delta)).margin(1e-14));
    CHECK(m.m[3][2] == Approx(std::sin(delta)).margin(1e-14));
    CHECK(m.m[2][3] == Approx(-std::sin(delta)).margin(1e-14));
  }
  // Born & Wolf §1.5.4: for n = 1.51 two total reflections at 54°37' (or 48°37') make linear light circular.
  for (const double theta : {54 + 37 / 60.0, 48 + 37 / 60.0}) {
    const Mueller<double> once = reflection_mueller(cos_deg(theta), {1 / 1.51, 0});
    const Stokes<double> out = (once * once) * Stokes<double>{1, 0, 1, 0};
    CHECK(out[3] == Approx(1).margin(1e-5));
    CHECK(std::abs(out[2]) < 3e-3);
  }
  // Malus: linear light seen from a frame turned by ψ; the share along its s is cos²(α - ψ).
  for (const double alpha : {0.0, 0.4, 1.9})
    for (const double psi : {0.0, 0.3, -1.2}) {
      const LinearLight<double> light{std::cos(alpha), std::sin(alpha)};
      const Stokes<double> seen = stokes_rotation(std::cos(2 * psi), std::sin(2 * psi)) * light.stokes();
      CHECK(0.5 * (seen[0] + seen[1]) == Approx(square(std::cos(alpha - psi))).margin(1e-15));
      CHECK(seen[3] == 0);
    }
}

TEST_CASE("Linear polarisation at any azimuth: eq. (3), its mean is the unpolarised reflectance", "[optics]") {
  for (const auto& [n, k] : kIndices)
    for (const double theta : {0.0, 30.0, 56.0, 85.0}) {
      const double c = cos_deg(theta);
      const Printed r = printed(c, n, k);
      const Polarised<double> shares = fresnel(c, n, k);
      double mean = 0;
      const int steps = 12;
      for (int i = 0; i < steps; ++i) {
        const double alpha = kPi<double> * i / steps;
        const LinearLight<double> light{std::cos(alpha), std::sin(alpha)};
        const double share = linear_share(shares, light);
        const double field =
            double(std::norm(r.r_s * Real(light.cos_alpha)) + std::norm(r.r_p * Real(light.sin_alpha)));
        CHECK(share == Approx(field).epsilon(1e-12).margin(1e-30));
        CHECK((reflection_mueller(c, {n, k}) * light.stokes())[0] == Approx(share).epsilon(1e-12).margin(1e-15));
        mean += share / steps;
      }
      CHECK(mean == Approx(shares.unpolarised()).epsilon(1e-14));
    }
}
