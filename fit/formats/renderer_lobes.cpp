#include "fit/formats/renderer_lobes.h"

#include <cmath>

namespace gonio {
namespace {

/// α²·tan²θ of a direction.
double stretched(const UnitVector<double>& w, double alpha_x, double alpha_y) {
  return (square(alpha_x * w.x) + square(alpha_y * w.y)) / square(w.z);
}

double ggx_g1(double s) { return 2 / (1 + std::sqrt(1 + s)); }
double ggx_lambda(double s) { return (std::sqrt(1 + s) - 1) / 2; }

/// Walter et al. 2007, eq. (27)'s rational form, a = 1/(α·tanθ).
double beckmann_g1(double s) {
  const double a = 1 / std::sqrt(s);
  if (!(a < 1.6)) return 1;
  return (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a);
}

}  // namespace

double renderer_lobe(RendererLobe lobe, const UnitVector<double>& i, const UnitVector<double>& o, double alpha_x,
                     double alpha_y, const Interface<double>& surface) {
  const UnitVector<double> m = normalised(i.x + o.x, i.y + o.y, i.z + o.z);
  const double area = kPi<double> * alpha_x * alpha_y, slopes = square(m.x / alpha_x) + square(m.y / alpha_y),
               cos2 = square(m.z);
  const double s_i = stretched(i, alpha_x, alpha_y), s_o = stretched(o, alpha_x, alpha_y);
  double d = 0, g = 0;
  if (lobe == RendererLobe::mitsuba_beckmann) {
    d = std::exp(-slopes / cos2) / (area * square(cos2));
    g = beckmann_g1(s_i) * beckmann_g1(s_o);
  } else {
    d = 1 / (area * square(slopes + cos2));
    g = lobe == RendererLobe::pbrt_ggx ? 1 / (1 + ggx_lambda(s_i) + ggx_lambda(s_o)) : ggx_g1(s_i) * ggx_g1(s_o);
  }
  return d * g * surface.reflectance(dot(i, m)) / (4 * i.z * o.z);
}

}  // namespace gonio
