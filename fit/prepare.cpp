#include "fit/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "fit/aperture.h"
#include "fit/scan_quality.h"
#include "materials/database.h"

namespace gonio {
namespace {

/// What a scan of unknown scale may need: kd and ks in units of its brightest point, and some decades around.
constexpr double kRelativeDecades = 1e3;

/// Whether n and k of a database material enter.
bool needs_surface(const FitResult& result) {
  return result.material && *result.material != "perfect" && result.model.first().id != ModelId::lambert;
}

void resolve_wavelength(const Measurement& scan, FitResult& result) {
  result.wavelength_nm = scan.wavelengths();
  if (!result.wavelength_nm.empty()) return;
  if (result.model.needs_wavelength() && !scan.material_wavelength_nm)
    throw input_error(
        "{}: {} needs the wavelength, which is not stated; expected wavelength_nm in measurement.yaml or the scan",
        scan.id, result.model.name());
  if (needs_surface(result) && !scan.material_wavelength_nm)
    throw input_error(
        "{}: n and k of {} need a wavelength, which is not stated; expected wavelength_nm or material_wavelength_nm "
        "in measurement.yaml",
        scan.id, *result.material);
  result.assumed_wavelength_nm = scan.material_wavelength_nm;
}

void resolve_material(const Measurement& scan, const FitRequest& request, FitResult& result) {
  if (request.free_k && !request.free_n) throw input_error("k: cannot be freed alone; expected n and k");
  if (request.free_n) {
    if (request.material)
      throw input_error("{}: both a material and a free n are asked for; expected one of them", *request.material);
    return;
  }
  const std::optional<std::string> asked = request.material ? request.material : scan.material;
  if (!asked) return;
  result.material = SurfaceMaterial(*asked).id();
}

void say_what_is_assumed(const Measurement& scan, const FitRequest& request, FitResult& result) {
  const bool has_lobe = result.model.first().id != ModelId::lambert;
  if (has_lobe && !result.material && !request.free_n)
    result.warnings.push_back("no material is known: F = 1 at every angle, and ks includes the reflectance");
  if (result.assumed_wavelength_nm && (needs_surface(result) || result.model.needs_wavelength()))
    result.warnings.push_back(
        fmt::format("the wavelength is not stated; {} at {} nm is assumed",
                    result.material ? fmt::format("n and k of {}", *result.material) : std::string("evaluation"),
                    *result.assumed_wavelength_nm));
  if (needs_surface(result) && SurfaceMaterial(*result.material).from_reflectance())
    result.warnings.push_back(
        fmt::format("F from reflectance: n of {} is derived from its R0, k = 0", *result.material));
  if (scan.quantity == "relative")
    result.warnings.push_back(
        "the scan is relative: kd and ks are in its own unit, and energy conservation cannot be judged");
  if (result.wavelength_nm.size() > 1 && request.spectral.empty())
    result.warnings.push_back(
        fmt::format("one set of parameters is shared by {} wavelengths", result.wavelength_nm.size()));
}

std::vector<FitPoint> all_points(const Measurement& scan, const FitResult& result) {
  const SurfaceMaterial material =
      needs_surface(result) ? SurfaceMaterial(*result.material) : SurfaceMaterial::perfect();
  const auto nm_of = [&](const ScanPoint& row) {
    return row.has_wavelength() ? row.wavelength_nm : result.assumed_wavelength_nm.value_or(1000);
  };
  std::map<double, Interface<double>> surfaces;
  for (const ScanPoint& row : scan.points)
    if (const double nm = nm_of(row); !surfaces.contains(nm)) surfaces.emplace(nm, material.at(nm));
  std::vector<FitPoint> points(scan.points.size());
  for_each_index(points.size(), [&](std::size_t i) {
    const ScanPoint& row = scan.points[i];
    FitPoint& point = points[i];
    point.directions = directions_from_deg(row.theta_i_deg, row.theta_o_deg, row.phi_deg(), row.phi_i_deg);
    const double nm = nm_of(row);
    point.wavelength_um = nm * 1e-3;
    point.surface = surfaces.at(nm);
    point.f_per_sr = row.f_per_sr;
    point.weight = result.weighting == Weighting::cosine ? point.directions.cos_o : 1;
    const auto& all = result.wavelength_nm;
    const auto at = std::lower_bound(all.begin(), all.end(), nm);
    point.group = at != all.end() && *at == nm ? static_cast<std::size_t>(at - all.begin()) : 0;
  });
  return points;
}

std::optional<std::size_t> held_incidence(const Measurement& scan, const FitRequest& request) {
  const auto& angles = scan.incidences_deg;
  if (request.hold_out == HoldOut::none) return std::nullopt;
  if (request.hold_out == HoldOut::middle_incidence)
    return angles.size() >= 3 ? std::optional(angles.size() / 2) : std::nullopt;
  if (!(request.hold_out_deg >= 0 && request.hold_out_deg < 90))
    throw input_error("hold-out {}: no incidence angle; expected 0 to below 90 degrees, or none", request.hold_out_deg);
  if (angles.size() < 2)
    throw input_error("{}: has one incidence angle only; expected two or more to leave one out", scan.id);
  const auto nearest = std::min_element(angles.begin(), angles.end(), [&](double a, double b) {
    return std::abs(a - request.hold_out_deg) < std::abs(b - request.hold_out_deg);
  });
  if (std::abs(*nearest - request.hold_out_deg) > (scan.incidences_binned ? 5.0 : 0.5))
    throw input_error("hold-out {}: {} has no such incidence angle; expected one of {}", request.hold_out_deg, scan.id,
                      fmt::join(angles, ", "));
  return static_cast<std::size_t>(nearest - angles.begin());
}

/// The scan's noise floor: the smallest standard deviation it states, else a thousandth of its smallest positive value.
double default_floor(const Measurement& scan) {
  double smallest_std = std::numeric_limits<double>::infinity(), smallest = smallest_std;
  for (const ScanPoint& point : scan.points) {
    if (point.f_std_per_sr > 0) smallest_std = std::min(smallest_std, point.f_std_per_sr);
    if (point.f_per_sr > 0) smallest = std::min(smallest, point.f_per_sr);
  }
  return std::isfinite(smallest_std) ? smallest_std : std::isfinite(smallest) ? 1e-3 * smallest : 0;
}

/// Which of the parameters have a value of their own at each wavelength: kd, or every lobe's ks.
std::vector<bool> spectral_places(const FitRequest& request, const FitResult& result) {
  const LobeSum& model = request.model;
  std::vector<bool> spectral(model.parameters().size(), false);
  for (const std::string& name : request.spectral) {
    if (name != "kd" && name != "ks") throw input_error("{}: cannot differ between wavelengths; expected kd, ks", name);
    if (result.wavelength_nm.size() < 2)
      throw input_error("{} of each wavelength: the scan states {}; expected two or more wavelengths", name,
                        result.wavelength_nm.size());
    for (std::size_t i = 0; i < spectral.size(); ++i)
      if (name == "kd" ? model.is_diffuse(i) : model.is_scale(i)) spectral[i] = true;
  }
  return spectral;
}

/// kd or ks of each wavelength, named after it.
void add_spectral(const FreeParameter& shared, const std::vector<double>& wavelength_nm,
                  std::vector<FreeParameter>& free) {
  for (std::size_t group = 0; group < wavelength_nm.size(); ++group) {
    free.push_back(shared);
    free.back().name = fmt::format("{}@{:g}nm", shared.name, wavelength_nm[group]), free.back().group = group;
  }
}

/// n, and k with it where asked for: the boxes hold every dielectric, or every metal too.
void add_index(const FitRequest& request, std::vector<FreeParameter>& free) {
  if (request.model.first().id == ModelId::lambert)
    throw input_error("n: lambert has no lobe; expected a model with Fresnel reflection");
  for (const ParameterInfo& p : request.model.parameters())
    if (p.name == "n" || (request.free_k && p.name == "k"))
      throw input_error("{0}: {1} has a parameter of this name; expected a model without one to free the surface's {0}",
                        p.name, request.model.name());
  const bool metals = request.free_k;
  free.push_back({FreeParameter::kIndex, "n", "1", metals ? 0.02 : 1.01, metals ? 10.0 : 3.0, false});
  if (request.free_k) free.push_back({FreeParameter::kAbsorption, "k", "1", 1e-3, 15, false});
}

std::vector<FreeParameter> free_parameters(const Measurement& scan, const FitRequest& request,
                                           const FitResult& result) {
  const LobeSum& model = request.model;
  for (const auto& [name, value] : request.held) {
    const ParameterInfo& p = model.parameters()[model.index_of(name)];
    if (!(value >= p.lo && value <= p.hi))
      throw input_error("{}={}: outside the box of {}; expected {} to {}", name, value, model.name(), p.lo, p.hi);
  }
  double brightest = 0;
  for (const ScanPoint& point : scan.points) brightest = std::max(brightest, point.f_per_sr);
  const double unit = scan.quantity == "relative" && brightest > 0 ? kPi<double> * brightest : 1;
  const std::vector<bool> spectral = spectral_places(request, result);
  std::vector<FreeParameter> free;
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    const ParameterInfo& p = model.parameters()[i];
    if (request.held.contains(std::string(p.name))) continue;
    const double scale = p.linear ? unit : 1, wider = p.linear && unit != 1 ? kRelativeDecades : 1;
    const FreeParameter parameter{i,
                                  std::string(p.name),
                                  std::string(p.unit),
                                  p.fit_lo * scale / wider,
                                  p.fit_hi * scale * wider,
                                  model.is_diffuse(i) || model.is_scale(i)};
    if (spectral[i])
      add_spectral(parameter, result.wavelength_nm, free);
    else
      free.push_back(parameter);
  }
  if (request.free_n) add_index(request, free);
  return free;
}

FitProblem empty_problem(const Measurement& scan, const FitRequest& request, const FitResult& result) {
  FitProblem problem;
  problem.model = request.model;
  problem.metric = request.metric;
  problem.floor_per_sr = result.floor_per_sr;
  problem.free = free_parameters(scan, request, result);
  problem.aperture = aperture_nodes(request.aperture);
  for (const ParameterInfo& p : request.model.parameters()) {
    const auto held = request.held.find(std::string(p.name));
    problem.values.push_back(held != request.held.end() ? held->second : p.fallback.value_or(p.fit_lo));
  }
  return problem;
}

/// Under the likelihood every point counts by its standard deviation: the request's share of its value, else the one it states, else a share
/// of its value that repeats or reciprocal pairs show.
void set_confidence(const Measurement& scan, const FitRequest& request, FitResult& result,
                    std::vector<FitPoint>& points) {
  if (request.metric != Metric::likelihood) return;
  const bool stated =
      std::all_of(scan.points.begin(), scan.points.end(), [](const ScanPoint& p) { return p.f_std_per_sr > 0; });
  if (!stated && !(request.relative_sd > 0)) {
    const std::optional<NoiseEstimate> noise = noise_estimate(scan);
    if (!noise)
      throw input_error(
          "{}: the standard deviation of its values is not known; expected brdf_std_per_sr > 0 in every row, 8 repeats "
          "or reciprocal pairs, or --noise SHARE",
          scan.id);
    result.relative_sd = noise->relative_sd;
    result.warnings.push_back(
        fmt::format("standard deviations are not stated: {:.3g} of each value, from {} pairs of {}", noise->relative_sd,
                    noise->pairs, noise->from == "repeats" ? "repeats" : "reciprocal directions"));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = result.relative_sd * (std::abs(scan.points[i].f_per_sr) + result.floor_per_sr);
    points[i].confidence = 1 / (result.relative_sd > 0 ? share : scan.points[i].f_std_per_sr);
  }
}

}  // namespace

Prepared prepare(const Measurement& scan, const FitRequest& request, FitResult& result) {
  result.model = request.model;
  result.metric = request.metric, result.aperture = request.aperture, result.relative_sd = request.relative_sd;
  const bool plain = request.metric == Metric::log || request.metric == Metric::likelihood;
  if (request.metric == Metric::likelihood && request.weighting == Weighting::cosine)
    throw input_error("weighting cosine: the likelihood weighs by the standard deviations; expected none");
  result.weighting = request.weighting.value_or(plain ? Weighting::none : Weighting::cosine);
  result.measurement_id = scan.id, result.name = scan.name, result.source = scan.source, result.licence = scan.licence;
  result.quantity = scan.quantity;
  result.left_out = scan.left_out;
  if (request.floor_per_sr && !(*request.floor_per_sr >= 0 && std::isfinite(*request.floor_per_sr)))
    throw input_error("floor {}: no noise floor; expected 0 or more per sr", *request.floor_per_sr);
  result.floor_per_sr = request.floor_per_sr.value_or(default_floor(scan));
  resolve_material(scan, request, result);
  resolve_wavelength(scan, result);
  say_what_is_assumed(scan, request, result);

  Prepared ready{empty_problem(scan, request, result), all_points(scan, result), {}, {}, held_incidence(scan, request)};
  set_confidence(scan, request, result, ready.points);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const bool positive = scan.points[i].f_per_sr > 0 || request.metric != Metric::log;
    const bool held = ready.held_incidence && scan.points[i].incidence == *ready.held_incidence;
    if (!positive) ++result.left_out["value <= 0 under the log metric"];
    ready.held_out.push_back(held && positive);
    ready.used.push_back(!held && positive);
    if (ready.used.back()) ready.problem.points.push_back(ready.points[i]);
  }
  result.points_used = static_cast<int>(ready.problem.points.size());
  if (ready.problem.points.size() < std::max<std::size_t>(1, ready.problem.free.size()))
    throw input_error("{}: {} usable points; expected at least {}, as many as parameters", scan.id, result.points_used,
                      std::max<std::size_t>(1, ready.problem.free.size()));
  return ready;
}

}  // namespace gonio
