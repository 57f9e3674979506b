#include "assess/merl_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "energy/directional_reflectance.h"

namespace gonio {
namespace {

constexpr double kUm = 1;  // the unit of He's lengths, and unused by the rest

bool has_no_lobe(const PublishedFit& fit) { return !fit.surface.perfect && fit.surface.n == 1; }

using Energies = std::array<double, kMerlEnergyDeg.size()>;

/// Directional reflectance of the lobe alone, coherent part included.
Energies lobe_energies(const PublishedFit& fit) {
  Energies energies{};
  if (has_no_lobe(fit)) return energies;
  Brdf<double> brdf = make_brdf<double>(fit.spec, fit.values);
  brdf.ks = 1;
  const SpectralSurface surface{{fit.surface}, {kUm}};
  for (std::size_t e = 0; e < energies.size(); ++e)
    energies[e] = directional_reflectance(brdf.lobe, kMerlEnergyDeg[e], surface, 1e-4)[0].value +
                  coherent_energy(brdf, cos_deg(kMerlEnergyDeg[e]), fit.surface, kUm);
  return energies;
}

/// Whether two fits have one lobe, up to its scale.
bool same_lobe(const PublishedFit& a, const PublishedFit& b) {
  const auto& parameters = a.spec.info().parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p)  // Low's A is a scale too, but inside the lobe
    if (parameters[p].name != "kd" && parameters[p].name != "ks" && a.values[p] != b.values[p]) return false;
  return a.surface.n == b.surface.n;
}

MerlFit summary_of(const PublishedFit& fit, std::size_t table) {
  MerlFit summary{fit.material, table, make_brdf<double>(fit.spec, fit.values).kd, {}, {}, has_no_lobe(fit)};
  for (std::size_t h = 0; h < kMerlHalfDeg.size(); ++h)
    summary.f[h] = merl_value(fit, kMerlThetaI - 2 * kMerlHalfDeg[h]);
  return summary;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The three channels of a material are neighbours in a table, and mostly differ by kd and ks alone.
void add_table(std::size_t table, std::vector<MerlFit>& all) {
  const std::vector<PublishedFit> rows = read_published(published_tables()[table]);
  std::vector<std::size_t> first(rows.size());  // the row whose lobe this one has
  for (std::size_t r = 0; r < rows.size(); ++r) first[r] = r > 0 && same_lobe(rows[r], rows[r - 1]) ? first[r - 1] : r;
  std::vector<Energies> lobes(rows.size());
  tbb::parallel_for(std::size_t(0), rows.size(), [&](std::size_t r) {
    if (first[r] == r) lobes[r] = lobe_energies(rows[r]);
  });
  std::map<std::string, MerlFit> materials;
  for (const PublishedFit& row : rows)
    if (row.channel == "g") materials.emplace(row.material, summary_of(row, table));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Brdf<double> brdf = make_brdf<double>(rows[r].spec, rows[r].values);
    Energies& energy = materials.at(rows[r].material).energy;
    for (std::size_t e = 0; e < energy.size(); ++e)
      energy[e] = std::max(energy[e], brdf.kd + brdf.ks * lobes[first[r]][e]);
  }
  for (const auto& [name, fit] : materials) all.push_back(fit);
}

}  // namespace

double merl_value(const PublishedFit& fit, double theta_o_deg, double theta_i_deg) {
  const auto w = directions_from_deg(theta_i_deg, std::abs(theta_o_deg), theta_o_deg < 0 ? 0.0 : 180.0);
  return evaluate(make_brdf<double>(fit.spec, fit.values), w, fit.surface, kUm);
}

std::vector<MerlFit> merl_fits() {
  std::vector<MerlFit> all;
  for (std::size_t t = 0; t < published_tables().size(); ++t) add_table(t, all);
  std::stable_sort(all.begin(), all.end(), [](const MerlFit& a, const MerlFit& b) { return a.material < b.material; });
  return all;
}

std::vector<MerlDeviation> merl_deviations(const std::vector<MerlFit>& fits) {
  std::map<std::string, std::vector<const MerlFit*>> by_material;
  for (const MerlFit& fit : fits)
    if (!fit.no_lobe) by_material[fit.material].push_back(&fit);
  std::vector<MerlDeviation> deviations;
  for (const auto& [material, tables] : by_material) {
    std::array<double, kMerlHalfDeg.size()> middle{};
    for (std::size_t h = 0; h < middle.size(); ++h) {
      std::vector<double> logs;
      for (const MerlFit* fit : tables) logs.push_back(std::log10(fit->f[h]));
      middle[h] = median(logs);
    }
    for (const MerlFit* fit : tables) {
      deviations.push_back({material, fit->table, {}});
      for (std::size_t h = 0; h < middle.size(); ++h) deviations.back().decades[h] = std::log10(fit->f[h]) - middle[h];
    }
  }
  return deviations;
}

}  // namespace gonio
