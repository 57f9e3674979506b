#pragma once
// Experiments in print against the models at their stated parameters: what each paper says should agree or fail, as
// numbers.
#include <string>
#include <utility>
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// One statement of a paper as a number of ours and the range in which it holds.
struct Claim {
  std::string statement, quantity;
  double value;
  double lo, hi;  ///< it holds for lo <= value <= hi

  bool holds() const { return value >= lo && value <= hi; }
};

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< degrees, ordinate
};

/// One plot; the ordinate on a logarithmic scale from `floor` where that is > 0.
struct Chart {
  std::string file, title, ordinate;
  double floor, top;
  double from_deg, to_deg;
  double mirror_deg;  ///< a dotted line at the mirror direction
  std::vector<Curve> curves;
};

struct Comparison {
  std::string id, title, citation, text;
  std::vector<Claim> claims;
  std::vector<Chart> charts;
};

/// Every one of PHYSICS's last section, in its order.
std::vector<Comparison> published_comparisons();

Comparison mendez_odonnell_1987();
Comparison marx_vorburger_1990();
Comparison li_torrance_2005();
Comparison he_1991();
Comparison ward_1992();
Comparison schlick_1992();

/// Power that a lobe (ks = 1) scatters in the plane of incidence, per steradian and over the incident power: f·cos_o.
/// θ_o is positive on the mirror side; past 90° it is what a theory without horizon (Beckmann-Kirchhoff) says of the
/// space behind the surface, while cos_i + cos_o > 0.
double power_per_sr(const Lobe<double>& lobe, const Interface<double>& surface, double theta_i_deg, double theta_o_deg,
                    double wavelength_um);

/// The same over θ_o = from, from + step, … to.
Curve power_curve(std::string name, const Lobe<double>& lobe, const Interface<double>& surface, double theta_i_deg,
                  double from_deg, double to_deg, double step_deg, double wavelength_um);

/// Highest point and width at half of it (linear between points; up to the ends where it never falls so far).
struct LobeShape {
  double peak_deg, peak, width_deg;
};
LobeShape shape_of(const Curve& curve);
double value_at(const Curve& curve, double degrees);
Curve relative_to(Curve curve, double value);

/// Share of ∫ P dθ_o beyond 90°.
double share_behind(const Curve& curve);

/// Beckmann-Kirchhoff in the plane of incidence (power per steradian, R = 1, without its coherent part) of a surface
/// that sums two Gaussian ones, C(τ) = (σ1²·exp(-τ²/T1²) + σ2²·exp(-τ²/T2²))/(σ1² + σ2²): both exponentials expanded,
///   π·F'²/(λ²·cos_i)·Σ_{(j,k)≠(0,0)} Pois(j; g1)·Pois(k; g2)/a·exp(-v²/(4a)), a = j/T1² + k/T2².
double two_scale_power_per_sr(double sigma1_um, double correlation1_um, double sigma2_um, double correlation2_um,
                              double theta_i_deg, double theta_o_deg, double wavelength_um);

/// What the theory asks to be large, the lesser of T/λ and 4π·r_c·cos θ/λ, r_c = T²/(2√3·σ).
double kirchhoff_validity(double sigma_um, double correlation_um, double theta_i_deg, double wavelength_um);

}  // namespace gonio
