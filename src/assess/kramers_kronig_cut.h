#pragma once
// How badly Kramers-Kronig fails on a cut band: metals whose n and k are known are given as their reflectance alone,
// over a band, and what comes back between 380 and 780 nm (as far as the band reaches) is compared.
#include <string>
#include <vector>

#include "optics/absorption.h"
#include "optics/kramers_kronig.h"

namespace gonio {

struct CutBand {
  std::string name;  ///< "whole", "200-2000", …, "360-830 & 589.3"; "table" for the whole of a table
  double lo_nm, hi_nm;
  double decay_exponent;
  double known_nm = 0;  ///< n and k given at this wavelength, which then chooses the exponent; 0: nowhere
};

struct CutRow {
  std::string metal, source;  ///< chemical symbol; "Drude-Lorentz" or a database id
  CutBand band;
  double median, worst;           ///< |ΔN|/|N|
  double worst_n, worst_k;        ///< |Δn|, |Δk|
  double worst_r75;               ///< |ΔR| at 75°, which R at the normal does not fix
  double interval_rad;            ///< mean width of the stated interval of the phase
  double share_held, share_open;  ///< of the wavelengths: truth within the interval; interval no less than 0.99π
};

/// One point of a metal's curve: the truth and what came back.
struct CutPoint {
  double wavelength_nm;
  ComplexIndex<double> truth;
  KramersKronigIndex found;
};

/// The bands every Drude-Lorentz metal is cut to, the whole one first.
const std::vector<CutBand>& cut_bands();

/// Rakić's eleven metals over each of cut_bands().
std::vector<CutRow> drude_lorentz_cuts();
/// Tabulated metals of the database: over all their table, and cut to the visible.
std::vector<CutRow> tabulated_cuts();
/// The mean of |ΔN|/|N| over the eleven metals for each exponent of the assumed decay, a band at a time: which to take.
struct DecayRow {
  std::string band;
  double decay_exponent, mean_error;
};
std::vector<DecayRow> decay_exponents();

/// One of Rakić's metals (by symbol) over a band.
std::vector<CutPoint> cut_points(const std::string& metal, const CutBand& band);

}  // namespace gonio
