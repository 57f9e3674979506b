#pragma once
// n and k from the reflectance at normal incidence alone (Kramers-Kronig), with what the finite band leaves open.
//
// r = (N-1)/(N+1) = √R·e^{iφ}; with L = ln √R and ω0 the frequency asked for,
//   φ(ω0) = -(2ω0/π) P∫_0^∞ L(ω)/(ω² - ω0²) dω = -(1/π) ∫_0^∞ dL/dω · ln|(ω + ω0)/(ω - ω0)| dω,
//   n = (1-R)/(1 - 2√R·cos φ + R),  k = 2√R·sin φ/(1 - 2√R·cos φ + R)          (F. Wooten, Optical Properties of
// Solids, 1972, §6; Maillot 1996, §I.1.2, where the root is missing in print.)
// Between the points ln R is taken linear in ln ω. Then each segment integrates in closed form (Legendre's chi_2) and
// the singularity at ω0 needs no quadrature and no cut.
//
// Outside the band R is unknown; it is assumed (Assumption) and the result says what that costs: with R between
// `least_longer` and 1 at longer wavelengths, between `least_shorter`·(λ/λ_min)^4 and 1 at shorter ones, φ lies
// between phase_lo and phase_hi. What leaving out every second point changes (of the phase, and of R between points) is
// added; n_lo … k_hi are the extremes over all that. An index known at one wavelength (subtractive Kramers-Kronig; R.
// K. Ahrenkiel, J. Opt. Soc. Am. 61, 1651 (1971)) narrows the interval and chooses the decay. Where it is all of [0,
// π], the transform adds nothing to R.
#include <optional>
#include <vector>

#include "spectrum/spectrum.h"

namespace gonio {

/// χ_2(z) = Σ z^(2j+1)/(2j+1)², 0 <= z <= 1: ∫_0^z artanh(t)/t dt.
double legendre_chi2(double z);

/// n and k known at one wavelength within the band, by ellipsometry say.
struct KnownIndex {
  double wavelength_nm, n, k;
};

/// The default decay is the one of least mean error over Rakić's eleven metals cut to 300-1100 nm and to the visible
/// (reports/kramers-kronig); free electrons (4) are far from it so near the band.
struct KramersKronigAssumption {
  bool hagen_rubens = false;  ///< at longer wavelengths 1 - R falls as ω^½ (a conductor); otherwise R stays as it was
  double decay_exponent = 1.5;  ///< at shorter wavelengths R ~ ω^-exponent (4: free electrons; 0: R stays as it was)
  std::optional<KnownIndex> known = {};  ///< chooses the exponent instead, so that the phase is right there (a fitted
                                         ///< number, of any sign)
  double least_longer = 0.01;            ///< the smallest R thought possible at longer wavelengths
  double least_shorter = 0.01;           ///< and at shorter ones, falling with ω^-4
};

struct KramersKronigIndex {
  double reflectance, phase;  ///< φ in radians, 0 to π
  double n, k;
  double phase_lo, phase_hi, n_lo, n_hi, k_lo, k_hi;
};

class KramersKronig {
 public:
  /// Reflectances over wavelengths in nm, at least three points. InputError for R <= 0 or R > 1 or an assumption out of
  /// range.
  explicit KramersKronig(const Spectrum& reflectance, const KramersKronigAssumption& assumption = {});

  /// Requires a wavelength within the band.
  KramersKronigIndex at(double wavelength_nm) const;
  /// The assumed one, or the one that `known` asks for.
  double decay_exponent() const { return decay_exponent_; }
  double lo_nm() const;
  double hi_nm() const;

 private:
  struct Curve {  ///< ln √R over increasing frequency (1/nm)
    std::vector<double> frequency, log_amplitude;
  };
  struct Interval {
    double lo, hi;
  };
  static double log_amplitude_at(const Curve& curve, double frequency);
  /// How far ln √R between the points may be off, from leaving out every second of them.
  double amplitude_error(double frequency) const;
  /// The phase of a curve that stays as it is outside its points.
  double band_phase(const Curve& curve, double frequency) const;
  /// And with the assumed decay at high frequencies.
  double assumed_phase(const Curve& curve, double frequency) const;
  double exponent_through(const KnownIndex& known) const;
  /// What ln √R outside the band weighs in the phase: one unit of it at lower frequencies, one at higher ones, and its
  /// fall by 2·ln ω there. With a known phase, what is left of them once that is subtracted (in proportion to ω: the
  /// kernel keeps its sign, so that the extremes of R still give the extremes of the phase).
  struct Outside {
    double low, high, fall;
  };
  Outside outside(double frequency) const;
  double interpolation_error(double frequency) const;
  /// Between what bounds the phase lies for every R allowed outside the band.
  Interval possible_phase(double frequency) const;

  KramersKronigAssumption assumption_;
  double decay_exponent_;
  Curve band_, extended_;  ///< the data; with its extension at low frequency
  Curve even_, odd_;       ///< every second point of it, extended: how sure the interpolation is
};

/// The phase of r for an index.
double phase_of_index(double n, double k);

/// n + ik from the reflectance and phase of the amplitude r; phase 0 to π, where R = 1 and phase = 0 have no index.
struct IndexOfReflection {
  double n, k;
};
IndexOfReflection index_of_reflection(double reflectance, double phase);

}  // namespace gonio
