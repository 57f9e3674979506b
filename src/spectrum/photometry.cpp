#include "spectrum/photometry.h"

#include <algorithm>

#include "base/error.h"

namespace gonio {

double radiant(const Spectrum& per_nm, double lo_nm, double hi_nm) {
  double sum = 0;
  for (double nm = std::ceil(std::max(lo_nm, per_nm.lo_nm())); nm <= std::min(hi_nm, per_nm.hi_nm()); ++nm)
    sum += per_nm.at(nm);
  return sum;
}

double luminous(const Spectrum& per_nm, const Spectrum& efficiency, double efficacy) {
  const double lo = std::ceil(std::max(per_nm.lo_nm(), efficiency.lo_nm()));
  const double hi = std::min(per_nm.hi_nm(), efficiency.hi_nm());
  if (!(lo <= hi))
    throw input_error("the light ({} to {} nm) and the eye ({} to {} nm) share no wavelength; expected some",
                      per_nm.lo_nm(), per_nm.hi_nm(), efficiency.lo_nm(), efficiency.hi_nm());
  double sum = 0;
  for (double nm = lo; nm <= hi; ++nm) sum += per_nm.at(nm) * efficiency.at(nm);
  return efficacy * sum;
}

double photopic(const Spectrum& per_nm, const Spectrum& v) { return luminous(per_nm, v, kPhotopicEfficacy); }
double scotopic(const Spectrum& per_nm, const Spectrum& v_prime) {
  return luminous(per_nm, v_prime, kScotopicEfficacy);
}

double radiometric_scale(const Spectrum& shape, const Spectrum& efficiency, double efficacy, double wanted) {
  const double carried = luminous(shape, efficiency, efficacy);
  if (!(carried > 0)) throw input_error("the light has no visible power; expected some");
  return wanted / carried;
}

Xyz<double> absolute_xyz(const Spectrum& per_nm, const Observer& observer) {
  const auto through = [&](const std::vector<double>& curve) {
    return luminous(per_nm, {observer.wavelength_nm, curve}, kPhotopicEfficacy);
  };
  return {through(observer.xbar), through(observer.ybar), through(observer.zbar)};
}

LuminousEfficacy luminous_efficacy(const Spectrum& light, const Spectrum& v, const Spectrum& v_prime) {
  const double watts = radiant(light);
  if (!(watts > 0)) throw input_error("the light has no power; expected some");
  return {photopic(light, v) / watts, scotopic(light, v_prime) / watts};
}

}  // namespace gonio
