#pragma once
#include <cmath>
#include <random>

#include "fit/fit.h"

namespace gonio::test {

/// What a fit of a model would say of a scan, were these its values: no solver in between, so that the truth is known.
inline FitResult made_fit(const Measurement& scan, const LobeSum& model, const std::vector<double>& values,
                          const std::optional<std::string>& material = std::nullopt) {
  FitResult result;
  result.model = model;
  for (std::size_t k = 0; k < values.size(); ++k) {
    FittedParameter p;
    p.name = model.parameters()[k].name, p.value = values[k];
    result.parameters.push_back(p);
  }
  result.material = material;
  result.wavelength_nm = scan.wavelengths();
  result.quantity = scan.quantity, result.measurement_id = scan.id, result.name = scan.name;
  result.incidences_binned = scan.incidences_binned;
  for (const double theta : scan.incidences_deg) {
    IncidenceResiduals r;
    r.theta_i_deg = theta;
    result.by_incidence.push_back(r);
  }
  const std::vector<Brdf<double>> lobes = make_brdfs(model, values);
  for (const ScanPoint& p : scan.points) {
    FittedPoint point;
    point.theta_i_deg = p.theta_i_deg, point.theta_o_deg = p.theta_o_deg, point.phi_deg = p.phi_deg();
    point.wavelength_nm = p.wavelength_nm, point.incidence = p.incidence;
    point.measured_per_sr = p.f_per_sr, point.used = true;
    point.fitted_per_sr = evaluate(std::span<const Brdf<double>>(lobes),
                                   directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.phi_i_deg),
                                   perfect_interface<double>(), p.has_wavelength() ? p.wavelength_nm * 1e-3 : 1.0);
    result.points.push_back(point);
  }
  return result;
}

/// An n beside the model's own parameters, as a fit with a free index has it.
inline void add_index(FitResult& result, double n, double half_width) {
  FittedParameter p;
  p.name = "n", p.value = n, p.lo95 = n - half_width, p.hi95 = n + half_width;
  result.parameters.push_back(p);
}

/// The measured values replaced by the fitted ones times exp(noise·N(0, 1)).
inline void add_noise(FitResult& result, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (FittedPoint& p : result.points) p.measured_per_sr = p.fitted_per_sr * std::exp(noise * normal(random));
}

}  // namespace gonio::test
