#include "spectrum/colorimetry.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace gonio {
namespace {

Xyz<double> scaled(const Xyz<double>& c, double factor) { return {c.x * factor, c.y * factor, c.z * factor}; }

void add(Xyz<double>& sum, const Xyz<double>& c, double factor) {
  sum.x += c.x * factor, sum.y += c.y * factor, sum.z += c.z * factor;
}

/// ∫S·ȳ over all the observer sees. Outside its table the light's nearest value stands in: an estimate of what is
/// missing.
double whole_luminance(const Spectrum& light, const Observer& observer) {
  double sum = 0;
  for (double nm = std::ceil(observer.lo_nm()); nm <= observer.hi_nm(); ++nm)
    sum += light.at(std::clamp(nm, light.lo_nm(), light.hi_nm())) * observer.at(nm).y;
  return sum;
}

}  // namespace

Xyz<double> Observer::at(double nm) const {
  return {interpolate(wavelength_nm, xbar, nm), interpolate(wavelength_nm, ybar, nm),
          interpolate(wavelength_nm, zbar, nm)};
}

ColorSum color_of(const Factor& data, const Spectrum& light, const Observer& observer, bool allow_partial) {
  const double lo = std::ceil(std::max({data.lo_nm, light.lo_nm(), observer.lo_nm()}));
  const double hi = std::floor(std::min({data.hi_nm, light.hi_nm(), observer.hi_nm()}));
  if (!(lo <= hi))
    throw input_error(
        "{} ({} to {} nm), light ({} to {} nm) and observer ({} to {} nm) share no wavelength; expected some",
        data.name, data.lo_nm, data.hi_nm, light.lo_nm(), light.hi_nm(), observer.lo_nm(), observer.hi_nm());
  Xyz<double> sum{0, 0, 0}, white{0, 0, 0};
  for (double nm = lo; nm <= hi; ++nm) {
    const Xyz<double> eye = observer.at(nm);
    const double power = light.at(nm);
    add(white, eye, power);
    add(sum, eye, power * data.at(nm));
  }
  if (!(white.y > 0))
    throw input_error("{}: the light has no visible power from {} to {} nm; expected some", data.name, lo, hi);
  const double left_out = std::max(0.0, 1 - white.y / whole_luminance(light, observer));
  if (left_out > kMostLeftOut && !allow_partial)
    throw input_error(
        "{}: the common range {} to {} nm leaves out {:.2f} % of the visible power; expected at most {:g} % (allow "
        "with "
        "--allow-partial)",
        data.name, lo, hi, 100 * left_out, 100 * kMostLeftOut);
  const double scale = 100 / white.y;
  return {scaled(sum, scale), scaled(white, scale), lo, hi, left_out};
}

ColorValues color_values(const ColorSum& sum) {
  return {sum.xyz, chromaticity(sum.xyz), lab(sum.xyz, sum.white), luv(sum.xyz, sum.white)};
}

ColorDifference color_difference(const ColorValues& p, const ColorValues& q) {
  return {delta_e_ab(p.lab, q.lab), delta_e_uv(p.luv, q.luv), delta_e_2000(p.lab, q.lab)};
}

ColorWeights color_weights(const std::vector<double>& wavelength_nm, const Observer& observer) {
  const std::vector<double>& w = wavelength_nm;
  assert(w.size() >= 2 && std::is_sorted(w.begin(), w.end()));
  ColorWeights weights{w, std::vector<double>(w.size()), std::vector<double>(w.size()), std::vector<double>(w.size())};
  const double lo = std::ceil(std::max(w.front(), observer.lo_nm())),
               hi = std::floor(std::min(w.back(), observer.hi_nm()));
  double total = 0;
  std::size_t above = 1;
  for (double nm = lo; nm <= hi; ++nm) {
    while (above + 1 < w.size() && w[above] < nm) ++above;
    const double t = (nm - w[above - 1]) / (w[above] - w[above - 1]);
    const Xyz<double> eye = observer.at(nm);
    total += eye.y;
    for (const auto& [node, share] : {std::pair{above - 1, 1 - t}, std::pair{above, t}})
      weights.x[node] += share * eye.x, weights.y[node] += share * eye.y, weights.z[node] += share * eye.z;
  }
  if (!(total > 0))
    throw input_error("{} to {} nm: the observer sees nothing there; expected visible wavelengths", w.front(),
                      w.back());
  for (std::vector<double>* component : {&weights.x, &weights.y, &weights.z})
    for (double& weight : *component) weight /= total;
  return weights;
}

}  // namespace gonio
