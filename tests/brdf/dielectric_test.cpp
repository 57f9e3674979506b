// Rough and smooth dielectrics: transmission against quadratures over normals, reciprocity, energy, sampling.
#include <random>

#include "brdf/brdf.h"
#include "brdf/dielectric_sampling.h"
#include "brdf/lanes.h"
#include "catch.h"
#include "materials/database.h"
#include "reference/digits50.h"

using namespace gonio;

namespace {

using V = UnitVector<double>;

V direction(double theta_deg, double phi) {
  const bool far = theta_deg > 90;
  const double s = sin_deg(far ? 180 - theta_deg : theta_deg), c = cos_deg(far ? 180 - theta_deg : theta_deg);
  return {s * std::cos(phi), s * std::sin(phi), far ? -c : c};
}
double tan2(const V& v) { return (v.x * v.x + v.y * v.y) / (v.z * v.z); }

/// ∫ g dω over the upper (sign 1) or lower hemisphere, midpoint rule in the angles.
template <class F>
double over_hemisphere(double sign, int steps, F g) {
  double sum = 0;
  const int turns = steps / 4;
  for (int a = 0; a < steps; ++a)
    for (int b = 0; b < turns; ++b) {
      const double theta = (a + 0.5) / steps * kPi<double> / 2, phi = 2 * kPi<double> * (b + 0.5) / turns, r = std::sin(theta);
      sum += g(V{r * std::cos(phi), r * std::sin(phi), sign * std::cos(theta)}) * r;
    }
  return sum * kPi<double> * kPi<double> / (double(steps) * turns);
}

/// Energy reflected and transmitted from i, summed over normals: the facet sends G1(i)·D·(i·h)/cos_i, split by F, dimmed by
/// G1 of where it goes.
struct Energies {
  double reflected = 0, transmitted = 0;
};
Energies by_normals(const RoughDielectric<double>& lobe, const V& i, double n) {
  Energies e;
  const int steps = n < 1 ? 1800 : 900;  // finer where total reflection begins within the lobe
  for (int a = 0; a < steps; ++a)
    for (int b = 0; b < steps / 3; ++b) {
      const double u = (a + 0.5) / steps, t = lobe.alpha * u / (1 - u), phi = 2 * kPi<double> * (b + 0.5) / (steps / 3);
      const double z = 1 / std::sqrt(1 + t * t);
      const V h{t * z * std::cos(phi), t * z * std::sin(phi), z};
      const double c = dot(i, h);
      if (c <= 0) continue;
      // dω = sin dθ dφ, tan θ = t, dθ = dt/(1+t²)
      const double solid = t * z * z * z * lobe.alpha / ((1 - u) * (1 - u)) * 2 * kPi<double> / (steps * (steps / 3));
      const double sent = lobe.density(t * t) * lobe.g1(tan2(i)) * c / i.z * solid;
      const DielectricShares<double> f = dielectric_shares(c, n);
      const V up{2 * c * h.x - i.x, 2 * c * h.y - i.y, 2 * c * h.z - i.z};
      if (up.z > 0) e.reflected += sent * f.reflected.unpolarised() * lobe.g1(tan2(up));
      const double k = c / n - f.cos_t;
      const V down{k * h.x - i.x / n, k * h.y - i.y / n, k * h.z - i.z / n};
      if (down.z < 0) e.transmitted += sent * f.transmitted.unpolarised() * lobe.g1(tan2(down));
    }
  return e;
}

Energies by_directions(const RoughDielectric<double>& lobe, const V& i, double n) {
  const int steps = n < 1 ? 3200 : 1600;
  Energies e;
  e.transmitted = over_hemisphere(-1, steps, [&](const V& o) { return -o.z * lobe.transmission(i, o, n); });
  e.reflected = over_hemisphere(1, steps, [&](const V& o) {
    const auto w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
    return o.z * lobe.shape(w) * fresnel(w.cos_d, n, 0.0).unpolarised();
  });
  return e;
}

const DielectricNormals kBoth[] = {DielectricNormals::ggx, DielectricNormals::beckmann};

}  // namespace

TEST_CASE("Rough dielectric: f_t integrates to what the facets send, R + T <= 1", "[dielectric]") {
  for (const auto normals : kBoth)
    for (const double alpha : {0.3, 0.8})
      for (const double n : {1.5, 1 / 1.5, 1.2, 2.4})
        for (const double theta : {0.0, 50.0, 80.0}) {
          const RoughDielectric<double> lobe{alpha, normals};
          const V i = direction(theta, 0.4);
          const Energies truth = by_normals(lobe, i, n), got = by_directions(lobe, i, n);
          INFO("alpha " << alpha << " n " << n << " theta " << theta << ": R " << got.reflected << " T " << got.transmitted);
          CHECK(got.reflected == Approx(truth.reflected).epsilon(2e-3).margin(3e-5));
          CHECK(got.transmitted == Approx(truth.transmitted).epsilon(2e-3).margin(3e-5));
          CHECK(truth.reflected + truth.transmitted <= 1 + 1e-6);
        }
}

TEST_CASE("Rough dielectric: as alpha falls, R + T tends to 1 and R to the smooth interface's", "[dielectric]") {
  for (const auto normals : kBoth)
    for (const double n : {1.5, 1 / 1.5})
      for (const double theta : {0.0, 30.0, 60.0}) {
        const V i = direction(theta, 0);
        const double r = dielectric_shares(i.z, n).reflected.unpolarised();
        double before = 1;
        for (const double alpha : {0.1, 0.01, 0.001}) {
          const Energies e = by_normals({alpha, normals}, i, n);
          const double missing = std::abs(1 - e.reflected - e.transmitted);
          INFO("alpha " << alpha << " n " << n << " theta " << theta << ": R + T = " << e.reflected + e.transmitted);
          CHECK(missing <= before + 1e-5);
          CHECK(missing < 0.5 * alpha + 1e-5);
          if (alpha < 0.002) CHECK(e.reflected == Approx(r).epsilon(2e-2));
          before = missing;
        }
      }
}

TEST_CASE("Rough dielectric: n_i² f_t(i→o) = n_o² f_t(o→i)", "[dielectric]") {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  int lit = 0;
  for (int s = 0; s < 4000; ++s) {
    const RoughDielectric<double> lobe{std::pow(10, -2 + 2.5 * uniform(random)), kBoth[s % 2]};
    const double n = std::exp(2 * uniform(random) - 1);
    const V i = direction(89.9 * uniform(random), 6 * uniform(random)), o = direction(180 - 89.9 * uniform(random), 6 * uniform(random));
    // The other way round: the frame turned over, so that the light comes from the upper side.
    const V turned_i{o.x, o.y, -o.z}, turned_o{i.x, i.y, -i.z};
    const double there = lobe.transmission(i, o, n), back = lobe.transmission(turned_i, turned_o, 1 / n);
    INFO("n " << n << " alpha " << lobe.alpha << ": " << there << " " << n * n * back);
    REQUIRE(there >= 0);
    REQUIRE(std::isfinite(there));
    if (there > 1e-280) REQUIRE(n * n * back == Approx(there).epsilon(1e-9));  // 1/n is rounded
    lit += there > 0;
  }
  CHECK(lit > 500);
}

TEST_CASE("Rough dielectric: double and float lanes against 50 digits, index match and grazing included", "[dielectric]") {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_double = 0, worst_float = 0;
  for (int s = 0; s < 6000; ++s) {
    const float alpha = float(std::pow(10, -4 + 5 * uniform(random)));
    const float n = float(1 + (s % 3 ? 1 : -0.5) * std::pow(10, -4 * uniform(random)));
    const double theta = s % 4 ? 89 * uniform(random) : 90 - std::pow(10, -4 + 4 * uniform(random));
    V i = direction(theta, 6 * uniform(random));
    // A refracted direction about a normal drawn near the surface's own.
    const double t = alpha * std::pow(10, -2 + 2.5 * uniform(random)), phi = 6 * uniform(random);
    const V h = normalised(t * std::cos(phi), t * std::sin(phi), 1.0);
    const double c = dot(i, h);
    const auto f = dielectric_shares(c, double(n));
    if (c <= 0 || f.cos_t <= 0) continue;
    const double k = c / n - f.cos_t;
    V o{k * h.x - i.x / n, k * h.y - i.y / n, k * h.z - i.z / n};
    if (o.z >= -1e-6 || i.z < 1e-6) continue;
    const auto narrow = [](double x) {
      volatile float y = float(x);  // GCC 12 at -O2 drops a plain double -> float -> double
      return double(y);
    };
    const auto rounded = [&](const V& v) { return V{narrow(v.x), narrow(v.y), narrow(v.z)}; };
    for (const bool single : {false, true}) {
      const V a = single ? rounded(i) : i, b = single ? rounded(o) : o;
      for (const auto normals : kBoth) {
        const auto wide = [](const V& v) { return UnitVector<Digits50>{v.x, v.y, v.z}; };
        const RoughDielectric<Digits50> judge{Digits50(alpha), normals};
        const double exact = judge.transmission(wide(a), wide(b), Digits50(n)).convert_to<double>();
        if (single) {
          const auto lanes = [](const V& v) { return UnitVector<FloatLanes>{float(v.x), float(v.y), float(v.z)}; };
          const float got = RoughDielectric<FloatLanes>{FloatLanes(alpha), normals}.transmission(lanes(a), lanes(b), FloatLanes(n)).get(0);
          REQUIRE(got >= 0);
          const double peak = judge.transmission({0, 0, 1}, {0, 0, -1}, Digits50(n)).convert_to<double>();
          if (exact > 1e-6 * peak && exact > 1e-30 && exact < 1e37) worst_float = std::max(worst_float, std::abs(got / exact - 1));
        } else {
          const double got = RoughDielectric<double>{double(alpha), normals}.transmission(a, b, double(n));
          REQUIRE(got >= 0);
          if (exact > 1e-290) worst_double = std::max(worst_double, std::abs(got / exact - 1));
        }
      }
    }
  }
  INFO("double " << worst_double << ", float " << worst_float);
  CHECK(worst_double < 1e-12);
  CHECK(worst_float < 5e-6);
}

TEST_CASE("Rough dielectric: visible normals, reflected and refracted, follow their pdf", "[dielectric]") {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double n : {1.5, 1 / 1.5})
    for (const double alpha : {0.2, 0.7})
      for (const double theta : {0.0, 60.0, 89.0}) {
        const RoughDielectric<double> lobe{alpha};
        const V v = direction(theta, 0.7);
        const int samples = 100000, rings = 6, sectors = 6, fine = 100;
        std::vector<double> counts(2 * rings * sectors), expected(counts.size());
        double mean = 0, square_sum = 0;
        const auto cell = [&](const V& o) {
          const int ring = std::min(rings - 1, int(o.z * o.z * rings));
          const int sector = std::min(sectors - 1, int((std::atan2(o.y, o.x) / (2 * kPi<double>)+0.5) * sectors));
          return std::size_t(((o.z < 0) * rings + ring) * sectors + sector);
        };
        for (int s = 0; s < samples; ++s) {
          const auto one = sample_dielectric(lobe, v, n, uniform(random), uniform(random), uniform(random));
          mean += one.weight / samples;
          square_sum += one.weight * one.weight / samples;
          if (!(one.weight > 0)) continue;
          ++counts[cell(one.direction)];
          if (!one.transmitted) continue;
          REQUIRE(lobe.transmission(v, one.direction, n) * -one.direction.z / one.pdf_per_sr == Approx(one.weight).epsilon(1e-7));
        }
        const Energies truth = by_normals(lobe, v, n);
        INFO("n " << n << " alpha " << alpha << " theta " << theta << ": mean " << mean);
        CHECK(std::abs(mean - truth.reflected - truth.transmitted) < 4 * std::sqrt((square_sum - mean * mean) / samples) + 2e-4);
        for (const double sign : {1.0, -1.0})  // cell by cell, so that no step straddles a border
          for (int ring = 0; ring < rings; ++ring)
            for (int a = 0; a < fine; ++a) {
              const double z0 = std::sqrt(ring / double(rings)), z1 = std::sqrt((ring + 1) / double(rings));
              const double z = z0 + (z1 - z0) * (a + 0.5) / fine, r = std::sqrt(1 - z * z);
              for (int b = 0; b < sectors * fine; ++b) {
                const double phi = 2 * kPi<double> * ((b + 0.5) / (sectors * fine) - 0.5);
                const V o{r * std::cos(phi), r * std::sin(phi), sign * z};
                expected[cell(o)] += dielectric_pdf(lobe, v, o, n) * (z1 - z0) / fine * 2 * kPi<double> / (sectors * fine) * samples;
              }
            }
        double chi2 = 0;
        int used = 0;
        for (std::size_t k = 0; k < counts.size(); ++k)
          if (expected[k] > 30) chi2 += std::pow(counts[k] - expected[k], 2) / expected[k], ++used;
        INFO("chi2 " << chi2 << " on " << used);
        CHECK(chi2 < used + 5 * std::sqrt(2.0 * used) + 10);  // a false alarm about once in 1e5
      }
}

TEST_CASE("Smooth dielectric: shares, Snell, total reflection, Brewster", "[dielectric]") {
  for (const double n : {1.5, 1 / 1.5, 1.000001, 2.4})
    for (const double theta : {0.0, 30.0, 56.0, 89.9, 89.9999}) {
      const double c = cos_deg(theta), s = sin_deg(theta);
      const auto shares = dielectric_shares(c, n);
      const auto fifty = dielectric_shares(Digits50(c), Digits50(n));
      CHECK(shares.reflected.s + shares.transmitted.s == Approx(1).epsilon(1e-12));
      CHECK(shares.reflected.p + shares.transmitted.p == Approx(1).epsilon(1e-12));
      CHECK(shares.reflected.s == Approx(fresnel(c, n, 0.0).s).epsilon(1e-9));
      CHECK(shares.reflected.p == Approx(fresnel(c, n, 0.0).p).epsilon(1e-9).margin(1e-20));
      CHECK(shares.transmitted.p == Approx(fifty.transmitted.p.convert_to<double>()).epsilon(1e-12));
      const V t = refracted(direction(theta, 1.0), n);
      if (s > n) {
        CHECK(shares.reflected.s == 1);
        CHECK(shares.transmitted.p == 0);
        CHECK(t.z == 0);
      } else {
        CHECK(std::hypot(t.x, t.y) * n == Approx(s).margin(1e-14));
        CHECK(dot(t, t) == Approx(1).epsilon(1e-10));
      }
    }
  CHECK(dielectric_shares(std::cos(std::atan(1.5)), 1.5).reflected.p < 1e-30);
}

TEST_CASE("Smooth dielectric: dispersion bends blue more; a slab absorbs what Beer's law says", "[dielectric]") {
  const SurfaceMaterial glass("BK7");
  const auto bent_deg = [&](double nm) { return std::asin(std::hypot(refracted(direction(45, 0), glass.at(nm).n).x, 0.0)) * 180 / kPi<double>; };
  // asin(sin 45°/n), n of BK7's printed Sellmeier coefficients (Schott) at F and C: 1.522380, 1.514322 (catalogue).
  CHECK(bent_deg(486.13) == Approx(27.67622).epsilon(5e-6));
  CHECK(bent_deg(656.27) == Approx(27.83624).epsilon(5e-6));
  // No absorption: R + T = 1 and T = (1-r)/(1+r); strong absorption: R = r, T = 0.
  for (const double c : {1.0, 0.7, 0.05}) {
    const double r = dielectric_shares(c, 1.5).reflected.s;
    const auto clear = slab_shares(c, 1.5, 0.0, 1e6, 500.0), dark = slab_shares(c, 1.5, 0.01, 1e7, 500.0);
    CHECK(clear.transmitted.s == Approx((1 - r) / (1 + r)).epsilon(1e-12));
    CHECK(clear.reflected.s + clear.transmitted.s == Approx(1).epsilon(1e-12));
    CHECK(dark.reflected.s == Approx(r).epsilon(1e-12));
    CHECK(dark.transmitted.s < 1e-30);
  }
  // 1 mm, k = 1e-5, 500 nm, normal incidence: t = exp(-0.2513274...), both faces 4 %.
  const double t = std::exp(-4 * kPi<double> * 1e-5 * 1e6 / 500);
  const auto slab = slab_shares(1.0, 1.5, 1e-5, 1e6, 500.0);
  CHECK(slab.transmitted.s == Approx(0.96 * 0.96 * t / (1 - 0.0016 * t * t)).epsilon(1e-12));
  CHECK(slab.reflected.p == Approx(0.04 + 0.04 * 0.96 * 0.96 * t * t / (1 - 0.0016 * t * t)).epsilon(1e-12));
  // Below the critical angle from inside nothing passes.
  CHECK(slab_shares(0.1, 1 / 1.5, 0.0, 1.0, 500.0).transmitted.s == 0);
}
