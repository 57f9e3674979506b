// The inversions behind visible normals, put back into the equations that they solve; samples as numbers: continuous, the same in lanes; whole BRDFs.
#include "brdf/visible_slopes.h"

#include <cmath>

#include "brdf/direction_samplers.h"
#include "brdf/sampling_cases.h"
#include "catch.h"
#include "render/random.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// Share of azimuths below ψ in [0, π] on one side: ∫ min(2, max(0, 1 + e·cos ψ)) dψ/(2π), in closed form.
double cavity_share(double e, double psi) {
  const double pi = kPi<double>;
  if (e <= 1) return (psi + e * std::sin(psi)) / (2 * pi);
  const double first = std::acos(1 / e), last = pi - first;
  if (psi <= first) return psi / pi;
  const double x = std::min(psi, last);
  return (first + x + e * (std::sin(x) - std::sin(first))) / (2 * pi);
}

template <class T>
double worst_azimuth() {
  double worst = 0;
  for (double exponent = -6; exponent <= 6; exponent += 0.05)
    for (const double e :
         {std::pow(10, exponent), 1 - std::pow(10, -std::abs(exponent) - 1), 1 + std::pow(10, -std::abs(exponent) - 1)})
      for (double u = 1e-4; u < 0.5; u *= 1.1) {
        const auto lower = cavity_azimuth(T(e), T(u)), upper = cavity_azimuth(T(e), T(1 - u));
        if constexpr (std::is_same_v<T, double>) CHECK(std::abs(std::hypot(lower.sine, lower.cosine) - 1) < 1e-14);
        const double own = 1 + 0.01 * e;  // the closed form itself loses digits in e·(sin ψ - sin ψ₁)
        worst = std::max(
            worst, std::abs(0.5 - cavity_share(double(T(e)), std::atan2(-double(lower.sine), double(lower.cosine))) -
                            double(T(u))) /
                       own);
        worst = std::max(
            worst, std::abs(0.5 + cavity_share(double(T(e)), std::atan2(double(upper.sine), double(upper.cosine))) -
                            double(T(1 - u))) /
                       own);
      }
  return worst;
}

template <class T>
double worst_slope() {
  double worst = 0;
  for (double exponent = -6; exponent <= 4; exponent += 0.1) {
    const double o_z = std::pow(10, exponent), norm = std::hypot(o_z, 1.0), z = double(T(o_z / norm)),
                 kappa = double(T(1 / norm));
    const auto above = [&](double x) {
      return z * 0.5 * std::erfc(x) + kappa / (2 * std::sqrt(kPi<double>)) * std::exp(-x * x);
    };
    const double area = above(-z / kappa);
    for (double u = 1e-5; u < 1; u += u < 0.5 ? 0.3 * u : 0.3 * (1 - u)) {
      if (1 - u < 1e-5) break;
      const double x = double(visible_gaussian_slope(T(z), T(kappa), T(area), T(u)));
      worst = std::max(worst, std::abs(above(x) / area - double(T(u))));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("Sines and cosines of a turn in lanes: the numbers' last places, its ends included", "[brdf][sampling]") {
  double worst = 0, worst_float = 0;
  for (int i = 0; i <= 4096; ++i) {
    const double u = i / 4096.0;
    const auto angle = 2 * 3.141592653589793238462643383279502884L * static_cast<long double>(u);
    const auto sine = double(std::sin(angle)), cosine = double(std::cos(angle));
    const auto in_double = sine_cosine_of_turn(DoubleLanes(u));
    const auto in_float = sine_cosine_of_turn(FloatLanes(float(u)));
    worst = std::max({worst, std::abs(in_double.sine.get(0) - sine), std::abs(in_double.cosine.get(0) - cosine)});
    worst_float =
        std::max({worst_float, std::abs(in_float.sine.get(0) - sine), std::abs(in_float.cosine.get(0) - cosine)});
  }
  CHECK(worst < 5e-16);
  CHECK(worst_float < 1.5e-7);
}

TEST_CASE("Azimuths of cavities and visible Gaussian slopes solve their equations", "[brdf][sampling]") {
  const double azimuth = worst_azimuth<double>(), slope = worst_slope<double>();
  const double float_azimuth = worst_azimuth<float>(), float_slope = worst_slope<float>();
  INFO(fmt::format("azimuth {:.2e}, in float {:.2e}; slope {:.2e}, in float {:.2e}", azimuth, float_azimuth, slope,
                   float_slope));
  CHECK(azimuth < 1e-14);
  CHECK(float_azimuth < 4e-7);  // a float's u itself is known to 6e-8
  CHECK(slope < 3e-13);
  CHECK(float_slope < 4e-7);
  double worst = 0;
  for (double u = 1e-12; u < 1 - 1e-6; u += u < 0.5 ? 0.2 * u : 0.2 * (1 - u))
    worst = std::max(worst, std::abs(0.5 * std::erfc(gaussian_slope(u)) / std::min(u, 1.0) - 1));
  INFO(fmt::format("Gaussian slope {:.2e}", worst));
  CHECK(worst < 1e-10);  // relative, down to u = 1e-12
}

TEST_CASE("Samples are continuous in their two numbers, and the same in float and double lanes", "[brdf][sampling]") {
  for (const SamplingCase& one : sampling_cases({0.5}, {0, 40, 89}, 0.3)) {
    const auto mixture = lobe_mixture(one.brdf(), kMetal.r0(), kUm);
    const auto lanes =
        lobe_mixture(spread_brdf<DoubleLanes>(one.spec, one.values), DoubleLanes(kMetal.r0()), DoubleLanes(kUm));
    const auto floats = lobe_mixture(spread_brdf<FloatLanes>(one.spec, one.values), FloatLanes(float(kMetal.r0())),
                                     FloatLanes(float(kUm)));
    const UnitVector<double> o = one.eye();
    const double width = slope_extent(one.brdf().lobe, kUm).widest;
    Random random(2027, 0);
    double jump = 0, lanes_apart = 0, floats_apart = 0;
    const auto apart = [](const UnitVector<double>& a, const UnitVector<double>& b) {
      return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    };
    for (int s = 0; s < 300; ++s) {
      const double u0 = random.uniform(), u1 = 0.01 + 0.98 * random.uniform(), u2 = 0.01 + 0.98 * random.uniform(),
                   step = 1e-9;
      const auto here = mixture.sample(o, u0, u1, u2).direction;
      jump = std::max({jump, apart(here, mixture.sample(o, u0, u1 + step, u2).direction),
                       apart(here, mixture.sample(o, u0, u1, u2 + step).direction)});
      const auto wide =
          lanes.sample(spread<DoubleLanes>(o), DoubleLanes(u0), DoubleLanes(u1), DoubleLanes(u2)).direction;
      lanes_apart = std::max(lanes_apart, apart(here, lane(wide, 0)));
      const auto single =
          floats.sample(spread<FloatLanes>(o), FloatLanes(float(u0)), FloatLanes(float(u1)), FloatLanes(float(u2)));
      if (std::isfinite(single.direction.x.get(0)))  // beside a choice u0 may round to the other lobe
        floats_apart += apart(here, {single.direction.x.get(0), single.direction.y.get(0), single.direction.z.get(0)}) >
                        2e-3 * std::max(width, 0.01);
      else
        floats_apart += 300;
    }
    INFO(one.name << ": jump " << jump << ", lanes apart " << lanes_apart << ", floats apart " << floats_apart
                  << " of 300, width " << width);
    CHECK(jump < 1e-5 * std::max(width, 1e-3));
    CHECK(lanes_apart < 1e-9);
    CHECK(floats_apart <= 3);
  }
}

TEST_CASE("sample of a whole Brdf: diffuse part, lobe, delta and retro together give its reflectance",
          "[brdf][sampling]") {
  std::size_t checked = 0;
  for (const ModelId id : {ModelId::lambert, ModelId::mirror, ModelId::beckmann_kirchhoff, ModelId::he_1991,
                           ModelId::torrance_sparrow, ModelId::ggx})
    for (const bool retro : {false, true})
      for (const double theta : {20.0, 75.0}) {
        ModelSpec spec{id};
        spec.retro = retro && id != ModelId::lambert;
        std::vector<double> values = values_at(spec.info(), 0.4, 0.25);
        if (has_delta(make_brdf<double>(spec, values).lobe) && id != ModelId::mirror) values[0] = 0.04;
        const Brdf<double> brdf = make_brdf<double>(spec, values);
        const BrdfSampler<double> sampler(brdf, kMetal, kUm);
        const UnitVector<double> o = SamplingCase{spec, values, theta, ""}.eye();
        Random random(2028, 0);
        const int samples = 60000;
        double mean = 0, squares = 0, other = 0, other_squares = 0;
        int deltas = 0;
        for (int s = 0; s < samples; ++s) {
          const auto one = sampler.sample(o, random.uniform(), random.uniform(), random.uniform());
          if (one && one->delta) {
            ++deltas;
            CHECK(one->pdf == sampler.delta_share(o.z));
            CHECK(one->i.x == (spec.retro ? o.x : -o.x));
          } else if (one) {
            CHECK(one->pdf == Approx(sampler.pdf(one->i, o)).epsilon(1e-12));
          }
          const double weight = !one ? 0 : one->delta ? one->f / one->pdf : one->f * one->i.z / one->pdf;
          mean += weight / samples, squares += weight * weight / samples;
          // The same by uniform directions, which know nothing of the lobe.
          const auto uniform = HemisphereSampler<double>{}.sample(o, 0.5, random.uniform(), random.uniform());
          const auto& i = uniform.direction;
          const double plain =
              evaluate(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), kMetal, kUm) * i.z / uniform.pdf_per_sr;
          other += plain / samples, other_squares += plain * plain / samples;
        }
        other += coherent_energy(brdf, o.z, kMetal, kUm);
        const double plain_mean = other - coherent_energy(brdf, o.z, kMetal, kUm);
        const double error = std::sqrt((squares - mean * mean + other_squares - plain_mean * plain_mean) / samples);
        INFO(spec.info().name << (spec.retro ? " retro " : " ") << theta << ": " << mean << " against " << other
                              << " ± " << error);
        CHECK(std::abs(mean - other) < 4.2 * error + 1e-12);  // 24 comparisons: a false alarm once in 1600
        CHECK((deltas > 0) == (coherent_energy(brdf, o.z, kMetal, kUm) > 1e-9));
        ++checked;
      }
  CHECK(checked == 24);
}
