// Every dispersion formula of the database against the formula as refractiveindex.info prints it, in 50 digits.
#include <cmath>

#include "catch.h"
#include "materials/database.h"
#include "optics/dispersion.h"
#include "oracles/fifty_digits.h"

using namespace gonio;
using oracle::Real;

namespace {

using Coefficients = std::vector<double>;

/// Σ over pairs from c[first] on.
template <class Term>
Real over_pairs(const Coefficients& c, std::size_t first, Term term) {
  Real sum = 0;
  for (std::size_t i = first; i + 1 < c.size(); i += 2) sum += term(Real(c[i]), Real(c[i + 1]));
  return sum;
}

Real printed_index(const std::string& name, const Coefficients& c, double wavelength_um) {
  const Real w(wavelength_um), w2 = w * w, c0(c[0]);
  const auto power = [&](const Real& a, const Real& b) -> Real { return a * pow(w, b); };
  if (name == "sellmeier")
    return sqrt(1 + c0 + over_pairs(c, 1, [&](const Real& a, const Real& b) -> Real { return a * w2 / (w2 - b * b); }));
  if (name == "sellmeier-2")
    return sqrt(1 + c0 + over_pairs(c, 1, [&](const Real& a, const Real& b) -> Real { return a * w2 / (w2 - b); }));
  if (name == "polynomial") return sqrt(c0 + over_pairs(c, 1, power));
  if (name == "cauchy") return c0 + over_pairs(c, 1, power);
  if (name == "gases")
    return 1 + c0 + over_pairs(c, 1, [&](const Real& a, const Real& b) -> Real { return a / (b - 1 / w2); });
  if (name == "refractiveindex-info") {
    Real square = c0 + Real(c[1]) * pow(w, Real(c[2])) / (w2 - pow(Real(c[3]), Real(c[4])));
    if (c.size() > 5) square += Real(c[5]) * pow(w, Real(c[6])) / (w2 - pow(Real(c[7]), Real(c[8])));
    return sqrt(Real(square + over_pairs(c, 9, power)));
  }
  if (name == "herzberger") {
    const Real l = 1 / (w2 - Real("0.028"));
    return c0 + c[1] * l + c[2] * l * l + c[3] * w2 + c[4] * w2 * w2 + c[5] * w2 * w2 * w2;
  }
  if (name == "retro") {
    const Real s = c0 + c[1] * w2 / (w2 - c[2]) + c[3] * w2;
    return sqrt(Real((1 + 2 * s) / (1 - s)));
  }
  const Real d = w - c[4];  // exotic
  return sqrt(Real(c0 + c[1] / (w2 - c[2]) + c[3] * d / (d * d + c[5])));
}

double relative_error(double value, const Real& truth) { return abs(Real(value) / truth - 1).convert_to<double>(); }

}  // namespace

TEST_CASE("Every formula of the database is its printed form to 1e-14", "[materials]") {
  int formulas = 0;
  for (const Entry* entry : Database::bundled().all()) {
    if (entry->formula.empty()) continue;
    ++formulas;
    double worst = 0;
    for (int i = 0; i <= 16; ++i) {
      const double nm = std::lerp(entry->range_lo_nm, entry->range_hi_nm, i / 16.0);
      worst =
          std::max(worst, relative_error(entry->at(nm), printed_index(entry->formula, entry->coefficients, nm * 1e-3)));
    }
    INFO(entry->id << " (" << entry->formula << "): " << worst);
    CHECK(worst < 1e-14);
  }
  CHECK(formulas == 248);
}

TEST_CASE("Formulas 7 to 9, which no bundled entry has, likewise", "[materials]") {
  struct Case {
    const char* name;
    Coefficients c;
  };
  for (const Case& one : {Case{"herzberger", {3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9, 1e-13}},
                          Case{"retro", {0.452505, 0.09939, 0.070537, -0.00015}},
                          Case{"exotic", {2.51527, 0.0240, 0.0300, 0.0202, 1.52, 0.08771}}})
    for (double um = 0.5; um < 5; um += 0.37)
      CHECK(relative_error(refractive_index<double>(*dispersion_named(one.name), one.c, um),
                           printed_index(one.name, one.c, um)) < 1e-14);
}
