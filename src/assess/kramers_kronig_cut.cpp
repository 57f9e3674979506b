#include "assess/kramers_kronig_cut.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "materials/database.h"
#include "optics/drude_lorentz.h"
#include "optics/fresnel.h"

namespace gonio {
namespace {

using IndexCurve = std::function<ComplexIndex<double>(double nm)>;

const double kDecay = KramersKronigAssumption{}.decay_exponent;
constexpr double kSodium = 589.3;  // nm, where single indices are often known
constexpr int kSamples = 101;      // of the visible, judged

std::vector<double> geometric(double lo, double hi, int count) {
  std::vector<double> nm;
  for (int i = 0; i < count; ++i) nm.push_back(lo * std::pow(hi / lo, i / (count - 1.0)));
  return nm;
}

IndexCurve curve_of(const DrudeLorentz& metal) {
  return [&metal](double nm) { return drude_lorentz_index(metal, kElectronvoltNanometre / nm); };
}

std::vector<CutPoint> points_of(const IndexCurve& index, const std::vector<double>& table, const CutBand& band) {
  Spectrum reflectance;
  for (const double nm : table)
    if (nm >= band.lo_nm && nm <= band.hi_nm) {
      const ComplexIndex<double> x = index(nm);
      reflectance.wavelength_nm.push_back(nm), reflectance.value.push_back(normal_reflectance(x.n, x.k));
    }
  KramersKronigAssumption assumption{.decay_exponent = band.decay_exponent};
  if (band.known_nm > 0) assumption.known = {band.known_nm, index(band.known_nm).n, index(band.known_nm).k};
  const KramersKronig transform(reflectance, assumption);
  std::vector<CutPoint> points;
  const double lo = std::max(380.0, transform.lo_nm()), hi = std::min(780.0, transform.hi_nm());
  for (const double nm : geometric(lo, hi, kSamples)) points.push_back({nm, index(nm), transform.at(nm)});
  return points;
}

/// 800 points a decade of the whole band; 400 of a cut one.
std::vector<double> table_of(const CutBand& band) {
  return geometric(band.lo_nm, band.hi_nm, band.name == "whole" ? 8001 : 400);
}

double relative_error(const CutPoint& p) {
  return std::hypot(p.found.n - p.truth.n, p.found.k - p.truth.k) / std::hypot(p.truth.n, p.truth.k);
}

CutRow row_of(const std::string& metal, const std::string& source, const CutBand& band,
              const std::vector<CutPoint>& points) {
  CutRow row{metal, source, band, 0, 0, 0, 0, 0, 0, 0, 0};
  const double cos_75 = std::cos(75 * kPi<double> / 180), share = 1.0 / static_cast<double>(points.size());
  std::vector<double> errors;
  for (const CutPoint& p : points) {
    const double rounding = 1e-9 * (p.truth.n + p.truth.k);
    errors.push_back(relative_error(p));
    row.worst_n = std::max(row.worst_n, std::abs(p.found.n - p.truth.n));
    row.worst_k = std::max(row.worst_k, std::abs(p.found.k - p.truth.k));
    const double off =
        fresnel(cos_75, p.found.n, p.found.k).unpolarised() - fresnel(cos_75, p.truth.n, p.truth.k).unpolarised();
    row.worst_r75 = std::max(row.worst_r75, std::abs(off));
    const double width = p.found.phase_hi - p.found.phase_lo;
    row.interval_rad += share * width;
    row.share_open += width >= 0.99 * kPi<double> ? share : 0;
    const bool held = p.found.n_lo - rounding <= p.truth.n && p.truth.n <= p.found.n_hi + rounding &&
                      p.found.k_lo - rounding <= p.truth.k && p.truth.k <= p.found.k_hi + rounding;
    row.share_held += held ? share : 0;
  }
  std::sort(errors.begin(), errors.end());
  row.median = errors[errors.size() / 2], row.worst = errors.back();
  return row;
}

/// Metals with n and k over the visible; the specimens named are those the database recommends or of one source.
constexpr const char* kTables[][2] = {{"Ag", "Ag_Johnson"}, {"Au", "Au_Johnson"},  {"Cu", "Cu_Johnson"},
                                      {"Al", "Al_Rakic"},   {"Be", "Be_Rakic_BB"}, {"Cr", "Cr_Johnson"},
                                      {"Ni", "Ni_Johnson"}, {"Pd", "Pd_Johnson"},  {"Pt", "Pt_Tselin"},
                                      {"Ti", "Ti_Johnson"}, {"W", "W_Weaver"},     {"Fe", "Fe_Johnson"}};

}  // namespace

const std::vector<CutBand>& cut_bands() {
  static const std::vector<CutBand> bands{{"whole", 1e-2, 1e8, 4},
                                          {"200-2000", 200, 2000, kDecay},
                                          {"300-1100", 300, 1100, kDecay},
                                          {"360-830", 360, 830, kDecay},
                                          {"360-830 & 589.3", 360, 830, kDecay, kSodium}};
  return bands;
}

std::vector<CutRow> drude_lorentz_cuts() {
  std::vector<CutRow> rows;
  for (const DrudeLorentz& metal : kRakicMetals)
    for (const CutBand& band : cut_bands())
      rows.push_back(
          row_of(std::string(metal.metal), "Drude-Lorentz", band, points_of(curve_of(metal), table_of(band), band)));
  return rows;
}

std::vector<CutRow> tabulated_cuts() {
  std::vector<CutRow> rows;
  for (const auto& [metal, id] : kTables) {
    const SurfaceMaterial material(id);
    const IndexCurve index = [&material](double nm) {
      const Interface<double> x = material.at(nm);
      return ComplexIndex<double>{x.n, x.k};
    };
    for (const CutBand& band : {CutBand{"table", 0, 1e9, kDecay}, CutBand{"360-830", 360, 830, kDecay},
                                CutBand{"360-830 & 589.3", 360, 830, kDecay, kSodium}})
      rows.push_back(row_of(metal, material.id(), band, points_of(index, material.entry()->wavelength_nm, band)));
  }
  return rows;
}

std::vector<DecayRow> decay_exponents() {
  std::vector<DecayRow> rows;
  for (const CutBand& cut : cut_bands()) {
    if (cut.name == "whole" || cut.known_nm > 0) continue;
    for (double exponent = 0; exponent <= 4; exponent += 0.5) {
      CutBand band = cut;
      band.decay_exponent = exponent;
      double sum = 0;
      for (const DrudeLorentz& metal : kRakicMetals)
        for (const CutPoint& p : points_of(curve_of(metal), table_of(band), band)) sum += relative_error(p);
      rows.push_back({band.name, exponent, sum / static_cast<double>(kRakicMetals.size() * kSamples)});
    }
  }
  return rows;
}

std::vector<CutPoint> cut_points(const std::string& metal, const CutBand& band) {
  const auto found =
      std::find_if(kRakicMetals.begin(), kRakicMetals.end(), [&](const auto& m) { return m.metal == metal; });
  if (found == kRakicMetals.end())
    throw input_error("{}: no Drude-Lorentz parameters; expected one of Rakić's metals", metal);
  return points_of(curve_of(*found), table_of(band), band);
}

}  // namespace gonio
