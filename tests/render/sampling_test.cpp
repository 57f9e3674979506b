// The sampling routines as the renderer uses them: densities against histograms, weights against the models.
#include <algorithm>
#include <cmath>

#include "catch.h"
#include "energy/directional_reflectance.h"
#include "render/surface_shader.h"
#include "statistics.h"

using namespace gonio;

namespace {

struct Case {
  const char* name;
  LobeSum model;
  std::vector<double> values;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"lambert", ModelSpec{ModelId::lambert}, {0.8}},
      {"torrance-sparrow, rough", ModelSpec{ModelId::torrance_sparrow}, {0.5, 0, 1}},
      {"torrance-sparrow, v-cavity, kd", ModelSpec{ModelId::torrance_sparrow, Shadowing::v_cavity}, {0.2, 0.3, 0.5}},
      {"pseudo-realistic", ModelSpec{ModelId::pseudo_realistic}, {0.3, 0.4, 0.6}},
      {"beckmann-kirchhoff, coherent", ModelSpec{ModelId::beckmann_kirchhoff}, {0.04, 1.5, 0.2, 0.8}},
      {"beckmann-kirchhoff, rough", ModelSpec{ModelId::beckmann_kirchhoff}, {0.5, 2.5, 0, 1}},
      {"ggx + phong, kd", lobe_sum("ggx+phong-1975"), {0.4, 0.25, 20, 0.2, 0.5, 0.3}},
      {"two coherent lobes", lobe_sum("beckmann-kirchhoff+he-1991"), {0.04, 1.5, 0.05, 1.2, 0.1, 0.4, 0.5}},
      {"a lobe without a share", lobe_sum("pseudo-realistic+ggx+ward-1992"), {0.3, 0.2, 0.2, 0.3, 0.4, 0.3, 0.2, 0, 0.5}},
      {"forth and back",
       LobeSum({{ModelId::torrance_sparrow}, {ModelId::ggx, Shadowing::smith_correlated, 0, true}}),
       {0.2, 0.3, 0.3, 0, 0.4, 0.5}},
  };
  return all;
}

const std::vector<double> kWavelengths{400, 550, 700};
const std::vector<Interface<double>> kGold{{1.66, 1.956, false}, {0.3, 2.6, false}, {0.13, 4.0, false}};

using Shader = SurfaceShader<1>;
Shader shader_of(const Case& one) { return {one.model, one.values, kGold, kWavelengths}; }

double model_value(const LobeSum& model, const std::vector<double>& values, const Directions<double>& w,
                   std::size_t wavelength) {
  const std::vector<Brdf<double>> lobes = make_brdfs(model, values);
  return evaluate(std::span<const Brdf<double>>(lobes), w, kGold[wavelength], kWavelengths[wavelength] * 1e-3);
}

LocalDirection direction(double theta_deg, double phi_deg) {
  const double theta = theta_deg * kPi<double> / 180, phi = phi_deg * kPi<double> / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

constexpr int kRings = 24, kSectors = 24, kSub = 12;  ///< cells of equal solid angle over the hemisphere

/// Integral of the density over each cell (midpoints of a fine grid), times the number of samples.
std::vector<double> expected_counts(const Shader& shader, const LocalDirection& o, double samples) {
  std::vector<double> counts(kRings * kSectors);
  constexpr double kCellSolidAngle = 2 * 3.14159265358979323846 / (kRings * kSectors * kSub * kSub);
  for (int r = 0; r < kRings * kSub; ++r) {
    for (int s = 0; s < kSectors * kSub; ++s) {
      const double z = (r + 0.5) / (kRings * kSub), phi = 2 * kPi<double> * (s + 0.5) / (kSectors * kSub);
      const double across = std::sqrt(1 - z * z);
      counts[static_cast<std::size_t>(r / kSub * kSectors + s / kSub)] +=
          shader.pdf({across * std::cos(phi), across * std::sin(phi), z}, o) * kCellSolidAngle * samples;
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("sampled directions follow their density, which integrates to the share of samples used", "[render][slow]") {
  constexpr int kSamples = 200000;
  for (const Case& one : cases()) {
    const Shader shader = shader_of(one);
    for (const double theta_deg : {0.0, 45.0, 80.0}) {
      const LocalDirection o = direction(theta_deg, 30);
      Random random(11, 0);
      std::vector<double> seen(kRings * kSectors);
      int deltas = 0, lost = 0;
      for (int s = 0; s < kSamples; ++s) {
        const auto drawn = shader.sample(o, random);
        if (!drawn) {
          ++lost;
        } else if (drawn->delta) {
          ++deltas;
          CHECK(drawn->i.x == -o.x);
        } else {
          const LocalDirection& i = drawn->i;
          double turn = std::atan2(i.y, i.x) / (2 * kPi<double>);
          turn -= std::floor(turn);
          const int ring = std::min(kRings - 1, static_cast<int>(i.z * kRings));
          const int sector = std::min(kSectors - 1, static_cast<int>(turn * kSectors));
          seen[static_cast<std::size_t>(ring * kSectors + sector)] += 1;
        }
      }
      const std::vector<double> expected = expected_counts(shader, o, kSamples);
      double integral = 0;
      for (const double count : expected) integral += count / kSamples;
      INFO(one.name << ", " << theta_deg << " degrees: density integrates to " << integral << ", used "
                    << 1.0 - double(lost + deltas) / kSamples);
      // The share used is binomial with the density's integral as its mean; 1e-4: the grid's own error.
      const double used = 1.0 - double(lost + deltas) / kSamples;
      const double deviation = std::sqrt(std::max(1e-9, used * (1 - used) / kSamples));
      CHECK(std::abs(integral - used) <= gonio::test::sidak_bound(cases().size() * 3) * deviation + 1e-4);
      CHECK(gonio::test::chi_square_agrees(seen, expected));
    }
  }
}

TEST_CASE("the shader's f is the model's, at every wavelength", "[render]") {
  for (const Case& one : cases()) {
    const Shader shader = shader_of(one);
    for (const double theta_i : {0.0, 30.0, 60.0, 85.0}) {
      for (const double theta_o : {0.0, 40.0, 75.0}) {
        for (const double phi : {0.0, 120.0, 180.0}) {
          const LocalDirection i = direction(theta_i, 0), o = direction(theta_o, phi);
          const auto w = reduce(i.x, i.y, i.z, o.x, o.y, o.z);
          std::array<float, kLane> f;
          shader.evaluate(i, o, 0.5).store(f);
          for (std::size_t l = 0; l < kWavelengths.size(); ++l) {
            const double truth = model_value(one.model, one.values, w, l);
            INFO(one.name << ", i " << theta_i << ", o " << theta_o << ", phi " << phi << ", " << kWavelengths[l]
                          << " nm");
            CHECK(double(f[l]) == Approx(0.5 * truth).epsilon(3e-5).margin(1e-9));
          }
        }
      }
    }
  }
}

TEST_CASE("a sample's weight is f cos/pdf; a delta's its energy over its share", "[render]") {
  for (const Case& one : cases()) {
    const Shader shader = shader_of(one);
    const LocalDirection o = direction(50, 0);
    Random random(3, 0);
    for (int s = 0; s < 2000; ++s) {
      const auto drawn = shader.sample(o, random);
      if (!drawn || drawn->delta) continue;
      CHECK(drawn->pdf_per_sr == Approx(shader.pdf(drawn->i, o)).epsilon(1e-12));
      std::array<float, kLane> weight, f;
      drawn->weight.store(weight);
      shader.evaluate(drawn->i, o, drawn->i.z / drawn->pdf_per_sr).store(f);
      CHECK(weight[1] == f[1]);
    }
  }
}

TEST_CASE("visible normals: rough grazing views keep bounded weights", "[render]") {
  const Case mirror{"white v-cavity", ModelSpec{ModelId::torrance_sparrow, Shadowing::v_cavity}, {0.3, 0, 1}};
  const std::vector<Interface<double>> white(3, perfect_interface<double>());
  const Shader shader(mirror.model, mirror.values, white, kWavelengths);
  Random random(5, 0);
  for (const double theta_deg : {0.0, 60.0, 89.9}) {
    for (int s = 0; s < 5000; ++s) {
      const auto drawn = shader.sample(direction(theta_deg, 10), random);
      // R = 1: the weight is G/G1 <= 1 (V-cavities shadow one side at most).
      if (drawn) CHECK(drawn->weight.largest() <= 1.0001F);
    }
  }
}

namespace {

/// A sum with a delta, and kd and ks of each wavelength; at the second the narrow lobe is gone.
const LobeSum kSpectralModel = lobe_sum("beckmann-kirchhoff+ggx");
const std::vector<std::vector<double>> kSpectralValues{
    {0.05, 1.5, 0.3, 0.2, 0.1, 0.6, 0.2}, {0.05, 1.5, 0.3, 0.2, 0.4, 0, 0.5}, {0.05, 1.5, 0.3, 0.2, 0, 0.3, 0.6}};

/// All that the model reflects from there at a wavelength, deltas included.
double reflected(std::size_t wavelength, double theta_deg) {
  const std::vector<Brdf<double>> lobes = make_brdfs(kSpectralModel, kSpectralValues[wavelength]);
  const double um = kWavelengths[wavelength] * 1e-3, cosine = cos_deg(theta_deg);
  double sum = lobes[0].kd;
  for (const Brdf<double>& lobe : lobes) {
    const SpectralSurface surface{{kGold[wavelength]}, {um}};
    sum += lobe.ks * directional_reflectance(lobe.lobe, theta_deg, surface, 1e-6, 30)[0].value;
    sum += coherent_energy(lobe, cosine, kGold[wavelength], um);
  }
  return sum;
}

}  // namespace

TEST_CASE("kd and ks of each wavelength: f is the model's there", "[render]") {
  const Shader shader(kSpectralModel, kSpectralValues, kGold, kWavelengths);
  for (const double theta_o : {0.0, 40.0, 75.0}) {
    const LocalDirection i = direction(30, 0), o = direction(theta_o, 150);
    std::array<float, kLane> f;
    shader.evaluate(i, o, 2).store(f);
    for (std::size_t l = 0; l < kWavelengths.size(); ++l) {
      const double truth = model_value(kSpectralModel, kSpectralValues[l], reduce(i.x, i.y, i.z, o.x, o.y, o.z), l);
      CHECK(double(f[l]) == Approx(2 * truth).epsilon(3e-5).margin(1e-9));
    }
  }
}

TEST_CASE("the mean weight is what the sum reflects, at every wavelength", "[render][slow]") {
  const Shader shader(kSpectralModel, kSpectralValues, kGold, kWavelengths);
  constexpr int kSamples = 200000;
  for (const double theta_deg : {10.0, 60.0}) {
    Random random(17, 0);
    std::array<double, 3> sum{}, squares{};
    for (int s = 0; s < kSamples; ++s) {
      const auto drawn = shader.sample(direction(theta_deg, 30), random);
      if (!drawn) continue;
      std::array<float, kLane> weight;
      drawn->weight.store(weight);
      for (std::size_t l = 0; l < 3; ++l) {
        sum[l] += double(weight[l]);
        squares[l] += square(double(weight[l]));
      }
    }
    for (std::size_t l = 0; l < 3; ++l) {
      const double mean = sum[l] / kSamples, deviation = std::sqrt((squares[l] / kSamples - mean * mean) / kSamples);
      INFO(theta_deg << " degrees, " << kWavelengths[l] << " nm: mean " << mean << " +- " << deviation);
      CHECK(std::abs(mean - reflected(l, theta_deg)) <= gonio::test::sidak_bound(6) * deviation + 1e-6);
    }
  }
}
