#include "spectrum/color_temperature.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>

namespace gonio {
namespace {

constexpr double kColdest = 1000, kHottest = 1e5;  // K
constexpr double kMostMired = 1e6 / kColdest, kLeastMired = 1e6 / kHottest;
constexpr int kSteps = 200;  // of the first search; the distance has one minimum between neighbours

double squared_distance(const Chromaticity<double>& p, const Chromaticity<double>& q) {
  return square(p.x - q.x) + square(p.y - q.y);
}

}  // namespace

double planck_relative(double wavelength_nm, double kelvin) {
  const double x = kSecondRadiationConstant * 1e9 / kelvin;
  const double ratio = 560 / wavelength_nm;
  return ratio * ratio * ratio * ratio * ratio * std::expm1(x / 560) / std::expm1(x / wavelength_nm);
}

Chromaticity<double> ucs_1960(const Xyz<double>& c) {
  const Chromaticity<double> uniform = uniform_chromaticity(c);
  return {uniform.x, uniform.y * 2 / 3};
}

Chromaticity<double> planckian_ucs(double kelvin, const Observer& observer) {
  Xyz<double> sum{0, 0, 0};
  for (double nm = std::ceil(observer.lo_nm()); nm <= observer.hi_nm(); ++nm) {
    const double power = planck_relative(nm, kelvin);
    const Xyz<double> eye = observer.at(nm);
    sum.x += power * eye.x, sum.y += power * eye.y, sum.z += power * eye.z;
  }
  return ucs_1960(sum);
}

ColorTemperature color_temperature(const Chromaticity<double>& uv, const Observer& observer) {
  // Searched in reciprocal temperature, in which the locus is run through at nearly even speed.
  const auto mired = [](int i) { return kLeastMired + (kMostMired - kLeastMired) * i / kSteps; };
  const auto distance = [&](double m) { return squared_distance(uv, planckian_ucs(1e6 / m, observer)); };
  int nearest = 0;
  double least = distance(mired(0));
  for (int i = 1; i <= kSteps; ++i)
    if (const double d = distance(mired(i)); d < least) least = d, nearest = i;
  const double from = mired(std::max(0, nearest - 1)), to = mired(std::min(kSteps, nearest + 1));
  const double found = boost::math::tools::brent_find_minima(distance, from, to, 30).first;
  const double margin = 1e-5 * (kMostMired - kLeastMired) / kSteps;
  const bool at_the_end = found - kLeastMired < margin || kMostMired - found < margin;

  const Chromaticity<double> foot = planckian_ucs(1e6 / found, observer);
  // Above: on the side of the locus where v is greater. Its direction is that of falling temperature, u increasing.
  const Chromaticity<double> on = planckian_ucs(1e6 / (found * (1 + 1e-4)), observer);
  const double side = (on.x - foot.x) * (uv.y - foot.y) - (on.y - foot.y) * (uv.x - foot.x);
  const double duv = std::copysign(std::sqrt(squared_distance(uv, foot)), side);
  return {1e6 / found, duv, at_the_end, !at_the_end && std::abs(duv) <= 0.05};
}

ColorTemperature color_temperature(const Xyz<double>& c, const Observer& observer) {
  return color_temperature(ucs_1960(c), observer);
}

}  // namespace gonio
