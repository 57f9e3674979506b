// What tables are measured against: quadrature, sampling, the small tables of renderers.
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "assess/table_speed.h"
#include "assess/timing.h"
#include "brdf/sampling.h"
#include "energy/directional_reflectance.h"

namespace gonio {
namespace {

constexpr double kWavelength_um = 0.55;
constexpr double kLargestAngle_deg = 89.99;  // of directional_reflectance()

std::vector<std::size_t> first_places(const JudgedPlaces& judged, std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t p = 0; p < judged.places.size() && chosen.size() < count; ++p)
    if (judged.places[p].theta_deg() <= kLargestAngle_deg) chosen.push_back(p);
  return chosen;
}

using Method = std::function<std::vector<double>(const TablePlace&, std::span<const JudgingSurface>)>;

/// White facets apart: a spectrum is all perfect or not at all.
std::vector<double> by_slopes(const LobeFamily& family, const TablePlace& at, std::span<const JudgingSurface> surfaces,
                              double tolerance) {
  SpectralSurface spectra[2];
  for (const JudgingSurface& one : surfaces) {
    SpectralSurface& spectrum = spectra[one.interface.perfect ? 0 : 1];
    spectrum.interfaces.push_back(one.interface), spectrum.wavelength_um.push_back(kWavelength_um);
  }
  std::vector<double> e;  // white facets stand first among the common surfaces
  for (const SpectralSurface& one : spectra)
    if (one.size() > 0)
      for (const Estimate& value : directional_reflectance(family.lobe(at.alpha), at.theta_deg(), one, tolerance))
        e.push_back(value.value);
  return e;
}

TableSpeedRow integrated_row(const JudgedPlaces& judged, const std::vector<std::size_t>& chosen, std::string way,
                             double tolerance, const Method& method) {
  std::vector<double> errors(chosen.size(), 0);
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t c) {
    const std::vector<double> e = method(judged.places[chosen[c]], common_surfaces());
    for (std::size_t s = 0; s < e.size(); ++s) errors[c] = std::max(errors[c], std::abs(e[s] - judged.e[chosen[c]][s]));
  });
  const ErrorSpread spread = spread_of(std::move(errors));
  const std::size_t timed = std::min<std::size_t>(chosen.size(), 30);
  const auto run = [&] {
    for (std::size_t c = 0; c < timed; ++c) {
      const std::vector<double> e = method(judged.places[chosen[c]], {&common_surfaces()[1], 1});
      keep(e);
    }
  };
  return {std::string(judged.family->name),
          std::move(way),
          fmt::format("{:.0e}", tolerance),
          0,
          least_ns(run, 2, 3) / static_cast<double>(timed),
          spread,
          judged.places[chosen[spread.worst]]};
}

double sampled(const BrdfSampler<double>& sampler, double cos_theta, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return (static_cast<double>(random() >> 12) + 0.5) * 0x1p-52; };  // within 0 and 1
  const LocalDirection eye{std::sqrt((1 - cos_theta) * (1 + cos_theta)), 0, cos_theta};
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double u0 = uniform(), u1 = uniform(), u2 = uniform();
    if (const auto one = sampler.sample(eye, u0, u1, u2)) sum += one->f * one->i.z / one->pdf;
  }
  return sum / static_cast<double>(count);
}

TableSpeedRow sampled_row(const JudgedPlaces& judged, const std::vector<std::size_t>& chosen, std::size_t count) {
  constexpr std::size_t kSeeds = 4;
  const auto& surfaces = common_surfaces();
  const auto estimate = [&](std::size_t c, std::uint64_t seed) {
    const TablePlace& at = judged.places[chosen[c]];
    const Brdf<double> brdf{judged.family->lobe(at.alpha)};
    const BrdfSampler<double> sampler(brdf, surfaces[c % surfaces.size()].interface, kWavelength_um);
    return sampled(sampler, at.cos_theta, count, seed);
  };
  std::vector<double> errors(chosen.size() * kSeeds);
  tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t run) {
    const std::size_t c = run / kSeeds;
    errors[run] = std::abs(estimate(c, 1 + run) - judged.e[chosen[c]][c % surfaces.size()]);
  });
  const ErrorSpread spread = spread_of(std::move(errors));
  std::size_t next = 0;
  const double ns = least_ns([&] { keep(estimate(next++ % chosen.size(), 1)); }, 20, 3);
  return {std::string(judged.family->name),
          "sampling",
          fmt::format("{:.0e}", static_cast<double>(count)),
          0,
          ns,
          spread,
          judged.places[chosen[spread.worst / kSeeds]]};
}

/// E of white facets, rows even in alpha or √alpha, 0 to 1, columns even in cos θ, 0 to 1.
class EvenTable {
 public:
  EvenTable(const LobeFamily& family, std::size_t side, bool root) : side_(side), root_(root), e_(side * side) {
    constexpr double kNarrowest = 1e-3, kGrazing = 1e-6;  // stand for 0, where the lobe is a mirror and E a limit
    tbb::parallel_for(std::size_t{0}, e_.size(), [&](std::size_t i) {
      const double u = static_cast<double>(i / side) / static_cast<double>(side - 1);
      const TablePlace at{std::max(static_cast<double>(i % side) / static_cast<double>(side - 1), kGrazing),
                          std::max(root ? u * u : u, kNarrowest)};
      e_[i] = static_cast<float>(lobe_measure(family.lobe(at.alpha), at.theta_deg(), 1e-6).total());
    });
  }

  float operator()(float cos_theta, float alpha) const {
    const float last = static_cast<float>(side_ - 1), x = cos_theta * last,
                y = (root_ ? std::sqrt(alpha) : alpha) * last;
    const std::size_t c = std::min(static_cast<std::size_t>(x), side_ - 2),
                      r = std::min(static_cast<std::size_t>(y), side_ - 2);
    const float s = x - static_cast<float>(c), t = y - static_cast<float>(r);
    const float* at = &e_[r * side_ + c];
    return (1 - t) * ((1 - s) * at[0] + s * at[1]) + t * ((1 - s) * at[side_] + s * at[side_ + 1]);
  }
  double kib() const { return static_cast<double>(e_.size() * sizeof(float)) / 1024; }

 private:
  std::size_t side_;
  bool root_;
  std::vector<float> e_;
};

TableSpeedRow renderer_row(const JudgedPlaces& judged, std::size_t side, bool root) {
  const EvenTable table(*judged.family, side, root);
  std::vector<double> errors;
  std::vector<TablePlace> places;
  std::vector<std::pair<float, float>> asked;
  for (std::size_t p = 0; p < judged.places.size(); ++p) {
    const TablePlace& at = judged.places[p];
    if (at.alpha > 1) continue;
    places.push_back(at);
    asked.emplace_back(static_cast<float>(at.cos_theta), static_cast<float>(at.alpha));
    errors.push_back(std::abs(double(table(asked.back().first, asked.back().second)) - judged.e[p][0]));
  }
  const ErrorSpread spread = spread_of(std::move(errors));
  std::vector<float> e(asked.size());
  const double ns = least_ns([&] {
    for (std::size_t p = 0; p < asked.size(); ++p) e[p] = table(asked[p].first, asked[p].second);
    keep(e[0]);
  });
  return {std::string(judged.family->name),
          root ? "bilinear, even in the root of alpha" : "bilinear, even in alpha",
          fmt::format("{} x {}", side, side),
          table.kib(),
          ns / static_cast<double>(asked.size()),
          spread,
          places[spread.worst]};
}

}  // namespace

std::vector<TableSpeedRow> quadrature_rows(const JudgedPlaces& judged, std::size_t count) {
  const std::vector<std::size_t> chosen = first_places(judged, count);
  const LobeFamily& family = *judged.family;
  std::vector<TableSpeedRow> rows;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    rows.push_back(integrated_row(judged, chosen, "quadrature of E", tolerance, [&](const auto& at, auto surfaces) {
      return by_slopes(family, at, surfaces, tolerance);
    }));
    rows.push_back(
        integrated_row(judged, chosen, "quadrature of the lobe", tolerance, [&](const auto& at, auto surfaces) {
          return summed(lobe_measure(family.lobe(at.alpha), at.theta_deg(), tolerance), surfaces);
        }));
  }
  return rows;
}

std::vector<TableSpeedRow> sampling_rows(const JudgedPlaces& judged, std::size_t count) {
  const std::vector<std::size_t> chosen = first_places(judged, count);
  std::vector<TableSpeedRow> rows;
  for (const std::size_t samples : {100, 1000, 10000, 100000}) rows.push_back(sampled_row(judged, chosen, samples));
  return rows;
}

std::vector<TableSpeedRow> renderer_rows(const JudgedPlaces& judged, std::span<const std::size_t> sides) {
  std::vector<TableSpeedRow> rows;
  for (const std::size_t side : sides)
    for (const bool root : {false, true}) rows.push_back(renderer_row(judged, side, root));
  return rows;
}

}  // namespace gonio
