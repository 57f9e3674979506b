#include "reference/reference.h"

#include "reference/digits50.h"

namespace gonio {
namespace {

Digits as_digits(const Digits50& x) { return {x.convert_to<double>(), x.str(40)}; }

Interface<Digits50> in_50(const Interface<double>& surface) {
  return {Digits50(surface.n), Digits50(surface.k), surface.perfect};
}

Brdf<Digits50> brdf_in_50(const ModelSpec& spec, std::span<const double> values) {
  return make_brdf<Digits50>(spec, std::vector<Digits50>(values.begin(), values.end()));
}

Digits50 value_in_50(const ModelSpec& spec, std::span<const double> values, const Directions<Digits50>& w,
                     const Interface<double>& surface, double wavelength_um) {
  return evaluate(brdf_in_50(spec, values), w, in_50(surface), Digits50(wavelength_um));
}

Mueller<double> rounded(const Mueller<Digits50>& exact) {
  Mueller<double> nearest{};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) nearest.m[row][column] = exact.m[row][column].convert_to<double>();
  return nearest;
}

}  // namespace

Digits reference_evaluate(const ModelSpec& spec, std::span<const double> values, double theta_i_deg, double theta_o_deg,
                          double phi_deg, const Interface<double>& surface, double wavelength_um, double phi_i_deg) {
  const auto w = directions_from_deg<Digits50>(Digits50(theta_i_deg), Digits50(theta_o_deg), Digits50(phi_deg),
                                               Digits50(phi_i_deg));
  return as_digits(value_in_50(spec, values, w, surface, wavelength_um));
}

Digits reference_evaluate(const ModelSpec& spec, std::span<const double> values, const Directions<double>& w,
                          const Interface<double>& surface, double wavelength_um) {
  const Directions<Digits50> exact{Digits50(w.cos_i),  Digits50(w.cos_o),  Digits50(w.cos_d), Digits50(w.tan2_h),
                                   Digits50(w.tan2_i), Digits50(w.tan2_o), Digits50(w.ix),    Digits50(w.iy),
                                   Digits50(w.ox),     Digits50(w.oy),     Digits50(w.hx),    Digits50(w.hy)};
  return as_digits(value_in_50(spec, values, exact, surface, wavelength_um));
}

double reference_value(const ModelSpec& spec, std::span<const double> values, const UnitVector<double>& i,
                       const UnitVector<double>& o, const Interface<double>& surface, double wavelength_um) {
  const auto w = reduce(Digits50(i.x), Digits50(i.y), Digits50(i.z), Digits50(o.x), Digits50(o.y), Digits50(o.z));
  return value_in_50(spec, values, w, surface, wavelength_um).convert_to<double>();
}

PolarisedValue reference_polarised(const ModelSpec& spec, std::span<const double> values, double theta_i_deg,
                                   double theta_o_deg, double phi_deg, const Interface<double>& surface,
                                   double wavelength_um, double phi_i_deg, const LinearLight<double>& light,
                                   double lobe_per_sr) {
  const Brdf<Digits50> brdf = brdf_in_50(spec, values);
  const Interface<Digits50> interface = in_50(surface);
  const Digits50 theta_i(theta_i_deg), theta_o(theta_o_deg), phi(phi_deg), um(wavelength_um), extra(lobe_per_sr);
  const Azimuth<Digits50> azimuth = azimuth_from_deg(phi);
  const LinearLight<Digits50> field{Digits50(light.cos_alpha), Digits50(light.sin_alpha)};
  if (theta_o_deg > 90) {
    const auto i = direction_from_deg(theta_i, Azimuth<Digits50>{Digits50(0), Digits50(2)}),
               o = direction_from_deg(theta_o, azimuth);
    return {rounded(transmission_mueller(brdf, i, o, azimuth, interface)),
            transmission_linear(brdf, i, o, azimuth, interface, field).convert_to<double>()};
  }
  const auto w = directions_from_deg(theta_i, theta_o, phi, Digits50(phi_i_deg));
  return {rounded(evaluate_mueller(brdf, w, azimuth, interface, um, extra)),
          evaluate_linear(brdf, w, azimuth, interface, um, field, extra).convert_to<double>()};
}

Polarised<double> reference_fresnel(double theta_deg, double n, double k) {
  const auto r = fresnel(cos_deg(Digits50(theta_deg)), Digits50(n), Digits50(k));
  return {r.s.convert_to<double>(), r.p.convert_to<double>()};
}

}  // namespace gonio
