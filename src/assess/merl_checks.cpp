#include "assess/merl_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/files.h"
#include "fit/scan.h"

namespace gonio {
namespace {

std::size_t table_of(std::string_view name) {
  return static_cast<std::size_t>(&published_table(name) - published_tables().data());
}

/// |log10 ratio| of two tables over the materials of both.
std::vector<double> apart(const std::vector<MerlFit>& fits, std::string_view one, std::string_view other,
                          std::size_t half) {
  std::map<std::string, double> first;
  for (const MerlFit& fit : fits)
    if (fit.table == table_of(one) && !fit.no_lobe) first[fit.material] = fit.f[half];
  std::vector<double> decades;
  for (const MerlFit& fit : fits)
    if (fit.table == table_of(other) && !fit.no_lobe && first.contains(fit.material))
      decades.push_back(std::abs(std::log10(fit.f[half] / first[fit.material])));
  return decades;
}

/// The largest, over the tables, of |median deviation|: a factor that a convention misses would show whole.
double worst_scale(const std::vector<MerlDeviation>& deviations, std::size_t half) {
  double worst = 0;
  for (std::size_t t = 0; t < published_tables().size(); ++t)
    worst = std::max(worst, std::abs(quantile(decades_of(deviations, t, half), 0.5)));
  return worst;
}

double count_above(const std::vector<MerlFit>& fits, std::size_t angle, double limit) {
  return static_cast<double>(
      std::count_if(fits.begin(), fits.end(), [&](const MerlFit& fit) { return fit.energy[angle] > limit; }));
}

double median_energy(const std::vector<MerlFit>& fits, std::string_view material) {
  std::vector<double> energies;
  for (const MerlFit& fit : fits)
    if (fit.material == material) energies.push_back(fit.energy[0]);
  return quantile(energies, 0.5);
}

bool gaussian_tail(std::size_t table) {
  const std::string_view model = published_tables()[table].model;
  return model.starts_with("ward") || model == "torrance-sparrow" || model == "he-1991";
}

/// From the parameters of the two tables at the ends.
std::string why_apart(const MerlFit& lowest, const MerlFit& highest, std::size_t half) {
  const std::string low(published_tables()[lowest.table].name), high(published_tables()[highest.table].name);
  if (kMerlHalfDeg[half] >= 10 && lowest.kd < 1e-3)
    return fmt::format(
        "{}: kd = {:g}{}", low, lowest.kd,
        gaussian_tail(lowest.table) ? " and a Gaussian tail: nothing is left there" : ", and its lobe ends before");
  if (half > 0) return "one lobe for core and flank: each table keeps another of the two";
  return fmt::format("{}: {:.0f} times less already at 1°, a core that the measurement hardly resolves{}", high,
                     highest.f[0] / highest.f[1],
                     low == "ngan-lafortune" ? "; Lafortune's lobe sinks away from grazing" : "");
}

/// Lafortune's lobe against Cook-Torrance's (both Ngan's, green) in the mirror direction of an incidence: nine tenths
/// of |log10 ratio| over the materials whose c_xy > c_z.
double lafortune_apart(double theta_i) {
  std::map<std::string, double> faceted;
  for (const PublishedFit& fit : read_published(published_table("ngan-cook-torrance")))
    if (fit.channel == "g") faceted[fit.material] = merl_value(fit, theta_i, theta_i);
  std::vector<double> decades;
  for (const PublishedFit& fit : read_published(published_table("ngan-lafortune"))) {
    const ModelInfo& info = fit.spec.info();
    if (fit.channel == "g" && fit.values[info.index_of("c_x")] > fit.values[info.index_of("c_z")])
      decades.push_back(std::abs(std::log10(merl_value(fit, theta_i, theta_i) / faceted[fit.material])));
  }
  return quantile(decades, 0.9);
}

/// The largest |log10| of a table's aluminium over its measurement.
double off_aluminium(std::string_view table) {
  const std::vector<double> measured = measured_aluminium();
  const PublishedFit fit = published_fit(fmt::format("{}/aluminium/g", table));
  double worst = 0;
  for (std::size_t h = 0; h < measured.size(); ++h)
    worst = std::max(worst, std::abs(std::log10(merl_value(fit, kMerlThetaI - 2 * kMerlHalfDeg[h]) / measured[h])));
  return worst;
}

double nearest_other_to_aluminium() {
  double nearest = 1e9;
  for (const PublishedTable& table : published_tables())
    if (!table.model.starts_with("low-")) nearest = std::min(nearest, off_aluminium(table.name));
  return nearest;
}

}  // namespace

std::vector<double> decades_of(const std::vector<MerlDeviation>& deviations, std::size_t table, std::size_t half) {
  std::vector<double> all;
  for (const MerlDeviation& d : deviations)
    if (d.table == table) all.push_back(d.decades[half]);
  return all;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

std::vector<Claim> merl_claims(const std::vector<MerlFit>& fits, const std::vector<MerlDeviation>& deviations) {
  const auto median_apart = [&](const char* a, const char* b, std::size_t half) {
    return quantile(apart(fits, a, b, half), 0.5);
  };
  constexpr std::size_t kPeak = 0, kCore = 2, kFlank = 3, kTail = 4;
  return {
      {"every table's scale is read aright (a lost π is 0.50)", "largest median deviation of a table, decades, 2°",
       worst_scale(deviations, kCore), 0, 0.15},
      {"… and 5°", "the same", worst_scale(deviations, kFlank), 0, 0.15},
      {"… and 10°", "the same", worst_scale(deviations, kTail), 0, 0.15},
      {"at the mirror direction too", "the same at 0°", worst_scale(deviations, kPeak), 0, 0.15},
      {"Low's two lobes fitted by one metric agree (E1)", "Cook-Torrance and Ashikhmin-Shirley, median decades at 2°",
       median_apart("low-cook-torrance-e1", "low-ashikhmin-shirley-e1", kCore), 0, 0.05},
      {"… (E2)", "the same", median_apart("low-cook-torrance-e2", "low-ashikhmin-shirley-e2", kCore), 0, 0.05},
      {"Low's smooth and microfacet fits agree", "median decades at 10°",
       median_apart("low-smooth", "low-microfacet", kTail), 0, 0.1},
      {"two papers' Cook-Torrance agree", "Ngan and Low (E2), median decades at 2°",
       median_apart("ngan-cook-torrance", "low-cook-torrance-e2", kCore), 0, 0.15},
      {"He's lobe is Cook-Torrance's here", "Ngan's two, median decades at 2°",
       median_apart("ngan-he", "ngan-cook-torrance", kCore), 0, 0.1},
      {"Lafortune's lobe follows Cook-Torrance's (Ngan's two)",
       "nine tenths of decades where c_xy > c_z, mirror direction of 45°", lafortune_apart(45), 0, 0.3},
      {"… nearer towards grazing: c_xy > c_z stands for Fresnel's rise", "the same at 70° over that at 45°",
       lafortune_apart(70) / lafortune_apart(45), 0, 1},
      {"Low's ABC lobes follow measured aluminium over five decades", "largest decades off, smooth",
       off_aluminium("low-smooth"), 0, 0.3},
      {"… microfacet", "the same", off_aluminium("low-microfacet"), 0, 0.3},
      {"… another lobe does too", "the same, the nearest of the other tables", nearest_other_to_aluminium(), 0, 0.3},
      {"the metric decides the fit more than the model: E1 against E2",
       "Low's Cook-Torrance, nine tenths of decades at 2°",
       quantile(apart(fits, "low-cook-torrance-e1", "low-cook-torrance-e2", kCore), 0.9), 0.3, 9},
      {"every fit keeps energy at 10°", "fits with E > 1", count_above(fits, 0, 1), 0, 0},
      {"… and at 75°", "fits with E > 1", count_above(fits, 1, 1), 0, 0},
      {"… at 10° if MERL's scale is π too small", "fits with E > 1/π", count_above(fits, 0, 1 / kPi<double>), 0, 0},
      {"MERL's scale is absolute: teflon reflects as PTFE does (0.99)", "median E of teflon at 10°",
       median_energy(fits, "teflon"), 0.9, 1.05},
  };
}

std::vector<MerlSpread> merl_spreads(const std::vector<MerlFit>& fits, const std::vector<MerlDeviation>&) {
  std::map<std::string, std::vector<const MerlFit*>> by_material;
  for (const MerlFit& fit : fits)
    if (!fit.no_lobe) by_material[fit.material].push_back(&fit);
  std::vector<MerlSpread> worst;
  for (const std::size_t half : {std::size_t(0), std::size_t(3), std::size_t(5)}) {
    std::vector<MerlSpread> all;
    for (const auto& [material, tables] : by_material) {
      const auto [low, high] = std::minmax_element(
          tables.begin(), tables.end(), [&](const MerlFit* a, const MerlFit* b) { return a->f[half] < b->f[half]; });
      all.push_back({material, half, std::log10((*high)->f[half] / (*low)->f[half]), (*low)->table, (*high)->table,
                     why_apart(**low, **high, half)});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const MerlSpread& a, const MerlSpread& b) { return a.decades > b.decades; });
    worst.insert(worst.end(), all.begin(), all.begin() + 5);
  }
  return worst;
}

std::vector<double> measured_aluminium() {
  std::map<double, double> scan;  // θ_o on the mirror side, log10 f
  for (const ScanPoint& p : read_measurement(data_folder("measurements") / "aluminium-merl").points)
    if (p.theta_i_deg == kMerlThetaI && std::abs(std::abs(p.phi_deg()) - 180) < 1e-9)
      scan[p.theta_o_deg] = std::log10(p.f_per_sr);
  std::vector<double> values;
  for (const double half : kMerlHalfDeg) {
    const double theta = kMerlThetaI - 2 * half;
    const auto above = scan.lower_bound(theta);
    if (above == scan.begin() || above == scan.end())
      throw input_error("aluminium-merl: no point next to {}°; expected a scan about 45°", theta);
    const auto below = std::prev(above);
    const double share = (theta - below->first) / (above->first - below->first);
    values.push_back(std::pow(10.0, below->second + share * (above->second - below->second)));
  }
  return values;
}

}  // namespace gonio
