#pragma once
// reference: the models' own templates in 50 digits, the judge of the other number types. Slow; instantiated once, here.
#include <span>
#include <string>

#include "base/unit_vector.h"
#include "brdf/transmission.h"

namespace gonio {

/// A 50-digit result: rounded to double, and its decimal digits.
struct Digits {
  double value;
  std::string text;
};

/// f_r at exactly the doubles given: angles in degrees (zenith < 90), parameters in the model's order, n and k, µm.
Digits reference_evaluate(const ModelSpec& spec, std::span<const double> values, double theta_i_deg, double theta_o_deg,
                          double phi_deg, const Interface<double>& surface, double wavelength_um, double phi_i_deg = 0);

/// The same at directions already reduced (cosines and tangents taken as exact).
Digits reference_evaluate(const ModelSpec& spec, std::span<const double> values, const Directions<double>& w,
                          const Interface<double>& surface, double wavelength_um);

/// f at exactly the doubles given, as a Mueller matrix, and of linearly polarised light; theta_o_deg above 90 is transmission,
/// `lobe_per_sr` as in evaluate_mueller().
struct PolarisedValue {
  Mueller<double> mueller;
  double linear;
};
PolarisedValue reference_polarised(const ModelSpec& spec, std::span<const double> values, double theta_i_deg,
                                   double theta_o_deg, double phi_deg, const Interface<double>& surface,
                                   double wavelength_um, double phi_i_deg = 0,
                                   const LinearLight<double>& light = {1, 0}, double lobe_per_sr = 0);

/// At unit vectors towards light and eye (z > 0; whatever they lack of unit length is taken as given), reduced in 50 digits as well:
/// the judge of a path that received exactly these numbers.
double reference_value(const ModelSpec& spec, std::span<const double> values, const UnitVector<double>& i,
                       const UnitVector<double>& o, const Interface<double>& surface, double wavelength_um);

/// R_s and R_p at exactly these doubles; the angle in degrees, 0 to 90.
Polarised<double> reference_fresnel(double theta_deg, double n, double k);

}  // namespace gonio
