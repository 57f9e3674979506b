// Scans with a known flaw, fitted as a user would: what comes out, and whether gonio says that it is wrong.
#include <algorithm>
#include <cmath>

#include "assess/fit_stability.h"
#include "brdf/brdf.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kNoise = 0.02;

/// A sound scan and what a flaw makes of it.
struct AtlasCase {
  std::string name, title, flaw;
  ModelSpec made_by, fitted;
  std::vector<double> values;                                 ///< of the model that made the scan
  std::vector<double> truth;                                  ///< in the fitted model's parameters
  ScanPlan plan;                                              ///< of the flawed scan
  std::function<void(Measurement&, const AtlasCase&)> spoil;  ///< changes its values; may be empty
  std::string fitted_material = "Au";
  bool free_n = false;
  std::string made_of = "Au";
};

ModelSpec spec_of(std::string_view name) { return {model(name).id}; }

/// The detector averages f over a round aperture (full angle, degrees) about each direction: rings of equal solid angle.
void see_through_aperture(Measurement& scan, const AtlasCase& c, double aperture_deg) {
  constexpr int kRings = 24, kRound = 48;
  const Brdf<double> brdf = make_brdf<double>(c.made_by, c.values);
  const Interface<double> surface = SurfaceMaterial(c.made_of).at(550);
  const auto evaluated = [&](const ScanPoint& p, const UnitVector<double>& o) {
    const double theta = p.theta_i_deg;
    const UnitVector<double> i{sin_deg(theta), 0, cos_deg(theta)};
    return evaluate(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), surface, 0.55);
  };
  for (ScanPoint& p : scan.points) {
    const double clean = evaluate(brdf, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()), surface, 0.55);
    const double s = sin_deg(p.theta_o_deg), z = cos_deg(p.theta_o_deg), side = p.phi_deg() == 180 ? -1 : 1;
    double sum = 0;
    for (int ring = 0; ring < kRings; ++ring)
      for (int a = 0; a < kRound; ++a) {
        const double away = std::tan(0.5 * aperture_deg * kPi<double> / 180) * std::sqrt((ring + 0.5) / kRings);
        const double u = away * std::cos(2 * kPi<double> * a / kRound),
                     v = away * std::sin(2 * kPi<double> * a / kRound);
        sum += evaluated(p, normalised(side * (s + u * z), v, z - u * s));
      }
    p.f_per_sr *= sum / (kRings * kRound) / clean;
  }
}

/// The detector shows no more than a share of the brightest value.
void saturate(Measurement& scan, double share) {
  double brightest = 0;
  for (const ScanPoint& p : scan.points) brightest = std::max(brightest, p.f_per_sr);
  for (ScanPoint& p : scan.points) p.f_per_sr = std::min(p.f_per_sr, share * brightest);
}

std::vector<AtlasCase> cases() {
  const ModelSpec facets = spec_of("torrance-sparrow");
  const ScanPlan usual;
  std::vector<AtlasCase> all;
  const std::vector<double> narrow{0.006, 0.05, 0.9};
  all.push_back({"narrow",
                 "A peak too narrow for the sampling",
                 "Slope rms 0.006, steps of 10° that miss the mirror directions by 5°: no point lies in the lobe.",
                 facets,
                 facets,
                 narrow,
                 narrow,
                 {{0, 20, 40, 60}, 80, 10, 5},
                 {}});
  all.push_back({"narrow-hit",
                 "A narrow peak that one point hits",
                 "Slope rms 0.006, steps of 10° on the mirror directions: one point an incidence lies in the lobe.",
                 facets,
                 facets,
                 narrow,
                 narrow,
                 {{0, 20, 40, 60}, 80, 10},
                 {}});
  all.push_back({"saturated",
                 "A saturated peak",
                 "The detector shows at most 30 % of the brightest value.",
                 facets,
                 facets,
                 {0.15, 0.05, 0.9},
                 {0.15, 0.05, 0.9},
                 usual,
                 [](Measurement& scan, const AtlasCase&) { saturate(scan, 0.3); }});
  AtlasCase grazing{
      "no-grazing",
      "Missing grazing angles",
      "A dielectric (BK7) whose n is fitted too, seen at theta_i up to 20° and theta_o up to 30° only: F is "
      "all but constant there, and ks takes its place.",
      facets,
      facets,
      {0.15, 0.02, 0.9},
      {0.15, 0.02, 0.9},
      {{0, 10, 20}, 30, 2.5},
      {}};
  grazing.made_of = "BK7", grazing.free_n = true;
  all.push_back(grazing);
  all.push_back({"wrong-model",
                 "The wrong model",
                 "GGX normals (alpha 0.2), fitted with Beckmann's: m of the same alpha counts as the truth.",
                 spec_of("ggx"),
                 facets,
                 {0.2, 0.2, 0.05, 0.9},
                 {0.2 / std::sqrt(2.0), 0.05, 0.9},
                 usual,
                 {}});
  all.push_back({"aperture",
                 "A peak widened by the detector's aperture",
                 "Slope rms 0.02 seen through a round aperture of 6°.",
                 facets,
                 facets,
                 {0.02, 0.05, 0.9},
                 {0.02, 0.05, 0.9},
                 {usual.incidences_deg, 80, 1},
                 [](Measurement& scan, const AtlasCase& c) { see_through_aperture(scan, c, 6); }});
  all.push_back({"stray-light",
                 "Stray light",
                 "0.02 per sr are added everywhere; the surface has no diffuse part that large.",
                 facets,
                 facets,
                 {0.15, 0.01, 0.9},
                 {0.15, 0.01, 0.9},
                 usual,
                 [](Measurement& scan, const AtlasCase&) {
                   for (ScanPoint& p : scan.points) p.f_per_sr += 0.02;
                 }});
  AtlasCase chromium{"wrong-material",
                     "The wrong material",
                     "The surface is chromium, the fit is told gold.",
                     facets,
                     facets,
                     {0.15, 0.05, 0.9},
                     {0.15, 0.05, 0.9},
                     usual,
                     {}};
  chromium.made_of = "Cr";
  all.push_back(chromium);
  return all;
}

FitResult fit_of(const AtlasCase& c, const Measurement& scan, bool sound) {
  FitRequest request;
  request.model = sound ? c.made_by : c.fitted;
  request.material = sound ? c.made_of : c.fitted_material;
  if (c.free_n && !sound) request.free_n = true, request.material.reset();
  return fit(scan, request);
}

/// A warning without its numbers.
std::string words_of(const std::string& warning) {
  std::string words;
  std::copy_if(warning.begin(), warning.end(), std::back_inserter(words),
               [](char c) { return (c < '0' || c > '9') && c != '.' && c != '-'; });
  return words;
}

/// A scan that shows the case's own lobe well: what gonio says of it is not about the flaw.
ScanPlan sound_plan(const AtlasCase& c) {
  constexpr double kNarrow = 0.02, kFineStepDeg = 0.25;
  ScanPlan plan;
  if (c.values[0] < kNarrow) plan.step_deg = kFineStepDeg;
  return plan;
}

Misled misled(const AtlasCase& c) {
  const Measurement sound = filled(planned_scan(sound_plan(c)), c.made_by, c.values, c.made_of, kNoise, 7);
  Measurement scan = filled(planned_scan(c.plan), c.made_by, c.values, c.made_of, kNoise, 7);
  if (c.spoil) c.spoil(scan, c);
  Misled found{c.name, c.title, c.flaw, fit_of(c, scan, false), {}, {}};
  for (std::size_t i = 0; i < found.result.parameters.size(); ++i) {
    const FittedParameter& p = found.result.parameters[i];
    const double truth = i < c.truth.size() ? c.truth[i] : SurfaceMaterial(c.made_of).at(550).n;
    found.parameters.push_back({p.name, truth, p.value, p.lo95, p.hi95});
  }
  const std::vector<std::string> usual = fit_of(c, sound, true).warnings;
  for (const std::string& warning : found.result.warnings) {
    const bool said_anyway =
        std::any_of(usual.begin(), usual.end(), [&](const std::string& w) { return words_of(w) == words_of(warning); });
    if (!said_anyway) found.warnings.push_back(warning);
  }
  return found;
}

}  // namespace

bool Misled::wrong() const {
  return std::any_of(parameters.begin(), parameters.end(), [](const MisledParameter& p) { return p.outside(); });
}

bool Misled::explained() const { return result.all.rms_log10 < 1.25 * kNoise / std::log(10.0); }

std::vector<Misled> failure_atlas() {
  std::vector<Misled> atlas;
  for (const AtlasCase& c : cases()) atlas.push_back(misled(c));
  return atlas;
}

}  // namespace gonio
