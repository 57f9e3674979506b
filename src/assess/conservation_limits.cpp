#include "assess/conservation_limits.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "energy/energy_tables.h"
#include "materials/database.h"

namespace gonio {
namespace {

/// The metals of the periodic table that are no short-lived radioactive ones.
constexpr std::array kMetals{"Ag", "Al", "Au", "Ba", "Be", "Bi", "Ca", "Cd", "Ce", "Co", "Cr", "Cs", "Cu",
                             "Dy", "Er", "Eu", "Fe", "Ga", "Gd", "Hf", "Hg", "Ho", "In", "Ir", "K",  "La",
                             "Li", "Lu", "Mg", "Mn", "Mo", "Na", "Nb", "Nd", "Ni", "Os", "Pb", "Pd", "Pr",
                             "Pt", "Rb", "Re", "Rh", "Ru", "Sc", "Sm", "Sn", "Sr", "Ta", "Tb", "Th", "Ti",
                             "Tl", "Tm", "U",  "V",  "W",  "Y",  "Yb", "Zn", "Zr"};
constexpr double kHalf = 0.5;

SurfaceSamples visible_samples(const SurfaceMaterial& material) {
  SurfaceSamples samples;
  for (double nm = kVisibleLo_nm; nm <= kVisibleHi_nm; nm += kVisibleStep_nm) {
    if (nm < material.range_lo_nm() || nm > material.range_hi_nm()) continue;
    samples.wavelength_nm.push_back(nm);
    samples.surface.interfaces.push_back(material.at(nm));
    samples.surface.wavelength_um.push_back(nm / 1000);
  }
  return samples;
}

MetalSurface metal_of(std::string symbol, std::string id, SurfaceSamples samples) {
  MetalSurface metal{std::move(symbol), std::move(id), std::move(samples), {}};
  const Lobe<double> any = PseudoRealistic<double>{1};  // both models have Fresnel's R
  for (const Interface<double>& interface : metal.samples.surface.interfaces) {
    metal.at_nodes.push_back(reflectance_at_nodes(any, interface));
    const double error = node_error(any, interface, metal.at_nodes.back());
    if (error > kMostNodeError) metal.node_error = std::max(metal.node_error, error);
  }
  return metal;
}

/// A lobe's table, asked at its width.
struct TableOfLobe {
  const EnergyTable* table;
  FamilyLobe lobe;

  ReflectanceCurve::Largest largest(const NodeValues& r) const { return table->curve(lobe.alpha, r).largest(); }
};

TableOfLobe table_of(const ConservationModel& model, double slope_rms) {
  const std::vector<FamilyLobe> lobes = family_lobes(model.lobe(slope_rms));
  const EnergyTable* table = lobes.size() == 1 ? bundled_energy_table(*lobes.front().family) : nullptr;
  if (!table) throw input_error("no table of E for {}, m = {:g}; expected the build's tables", model.name, slope_rms);
  return {table, lobes.front()};
}

/// What is lost of E: the table's error, and that of R times all that white facets reflect.
double error_of(const TableOfLobe& table, const MetalSurface& metal) {
  NodeValues white;
  white.fill(1);
  return EnergyTable::kError + (metal.node_error > 0 ? metal.node_error * table.largest(white).value : 0);
}

}  // namespace

const std::array<ConservationModel, 2>& conservation_models() {
  static const std::array<ConservationModel, 2> models{
      {{"pseudo-realistic", [](double m) -> Lobe<double> { return PseudoRealistic<double>{m}; }},
       {"torrance-sparrow", [](double m) -> Lobe<double> { return TorranceSparrow<double>{kSqrt2<double> * m}; }}}};
  return models;
}

MetalSurface white_facets() { return metal_of("F = 1", "perfect", {{0}, {{perfect_interface<double>()}, {0}}}); }

std::vector<MetalSurface> conservation_metals() {
  std::vector<MetalSurface> metals{white_facets()};
  const Database& database = Database::bundled();
  for (const std::string symbol : kMetals) {
    // `V` is an eye's sensitivity: an alias alone says nothing.
    if (!database.contains(symbol) || !database.full_id(symbol).starts_with(symbol + "_")) continue;
    const Entry& entry = database.find(symbol);
    if (entry.kind != "optical-constants" || !entry.has_k()) continue;
    SurfaceSamples samples = visible_samples(SurfaceMaterial(symbol));
    if (!samples.wavelength_nm.empty()) metals.push_back(metal_of(symbol, entry.id, std::move(samples)));
  }
  return metals;
}

std::vector<double> conservation_slopes() {
  constexpr int kSlopes = 40;
  constexpr double kLeast = 0.01, kLargest = 2;
  std::vector<double> slopes;
  for (int i = 0; i < kSlopes; ++i) slopes.push_back(kLeast * std::pow(kLargest / kLeast, i / double(kSlopes - 1)));
  return slopes;
}

SlopeLimits slope_limits(const ConservationModel& model, double slope_rms, const MetalSurface& metal) {
  const TableOfLobe table = table_of(model, slope_rms);
  const bool times_r0 = Brdf<double>{table.lobe.family->lobe(1)}.diffuse_times_r0();
  const double error = error_of(table, metal), infinity = std::numeric_limits<double>::infinity();
  SlopeLimits limits{.slope_rms = slope_rms, .kd_max = infinity, .kd_max_at_half = infinity};
  double least_rho_d = infinity;
  for (std::size_t w = 0; w < metal.at_nodes.size(); ++w) {
    const auto largest = table.largest(metal.at_nodes[w]);
    const double rho_d = times_r0 ? metal.samples.surface.interfaces[w].r0() : 1, bound = largest.value + error;
    // E differs between wavelengths as ρd does: each has its own kd.
    limits.kd_max = std::min(limits.kd_max, (1 - bound) / rho_d);
    limits.kd_max_at_half = std::min(limits.kd_max_at_half, (1 - kHalf * bound) / rho_d);
    least_rho_d = std::min(least_rho_d, rho_d);
    if (largest.value <= limits.largest_e) continue;
    limits.largest_e = largest.value, limits.wavelength_nm = metal.samples.wavelength_nm[w];
    limits.theta_deg = std::acos(largest.cos_theta) * 180 / kPi<double>;
  }
  limits.ks_max = 1 / (limits.largest_e + error);
  limits.kd_max = std::max(0.0, limits.kd_max), limits.kd_max_at_half = std::max(0.0, limits.kd_max_at_half);
  limits.turning_kd = kHalf * limits.largest_e / least_rho_d;
  return limits;
}

std::vector<MetalLimits> metal_limits(const std::vector<MetalSurface>& metals) {
  const std::vector<double> slopes = conservation_slopes();
  std::vector<MetalLimits> all;
  for (std::size_t model = 0; model < conservation_models().size(); ++model)
    for (const MetalSurface& metal : metals) all.push_back({model, &metal, std::vector<SlopeLimits>(slopes.size())});
  tbb::parallel_for(std::size_t{0}, all.size() * slopes.size(), [&](std::size_t at) {
    MetalLimits& one = all[at / slopes.size()];
    const std::size_t s = at % slopes.size();
    one.over_slopes[s] = slope_limits(conservation_models()[one.model], slopes[s], *one.metal);
  });
  return all;
}

}  // namespace gonio
