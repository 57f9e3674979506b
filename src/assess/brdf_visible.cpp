// What an error looks like: a sphere of gold, its colours by a variant beside those by the exact form.
#include <cmath>

#include "assess/brdf_speed.h"
#include "materials/color_entries.h"

namespace gonio {
namespace {

/// A pixel of the sphere: unit vectors towards light and eye in the frame of its normal.
struct Pixel {
  UnitVector<double> i, o;
};

/// The lit half of what the eye (along z) sees of the sphere, the light at 45° to the right.
std::vector<Pixel> pixels() {
  constexpr int kAcross = 28;
  const double half = std::sqrt(0.5);
  std::vector<Pixel> lit;
  for (int row = 0; row < kAcross; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const double x = (2 * column + 1.0) / kAcross - 1, y = (2 * row + 1.0) / kAcross - 1, z2 = 1 - x * x - y * y;
      if (z2 <= 0) continue;
      const double z = std::sqrt(z2), cos_i = half * (x + z);
      if (cos_i <= 1e-3) continue;
      // Components along t, the tangent away from the eye's point on the sphere, and b, across it; light and eye have no y.
      const double r = std::sqrt(x * x + y * y), t_x = r > 0 ? x * z / r : 1, t_z = -r, b_x = r > 0 ? -y / r : 0;
      lit.push_back({{half * (t_x + t_z), half * b_x, cos_i}, {t_z, 0, z}});
    }
  return lit;
}

/// XYZ of every pixel, in units of a white Lambert surface facing the light.
std::vector<Xyz<double>> colours(const ModelSpec& spec, const std::vector<double>& values, Xyz<double>& white) {
  const Database& database = Database::bundled();
  const SurfaceMaterial gold("Au", database);
  const Spectrum light = light_of(database.find("D65"));
  std::vector<double> wavelength_nm;
  for (double nm = 380; nm <= 780; nm += 10) wavelength_nm.push_back(nm);
  const ColorWeights weights = color_weights(wavelength_nm, observer_of(database.find("1931-2")));
  std::vector<Interface<double>> surfaces;
  std::vector<double> power;
  for (const double nm : wavelength_nm) surfaces.push_back(gold.at(nm)), power.push_back(light.at(nm));
  white = weights.xyz(power.data());
  const Brdf<double> brdf = make_brdf<double>(spec, values);
  std::vector<Xyz<double>> seen;
  for (const Pixel& p : pixels()) {
    const Directions<double> w = reduce(p.i.x, p.i.y, p.i.z, p.o.x, p.o.y, p.o.z);
    std::vector<double> radiance;
    for (std::size_t c = 0; c < wavelength_nm.size(); ++c)
      radiance.push_back(power[c] * kPi<double> * p.i.z * evaluate(brdf, w, surfaces[c], wavelength_nm[c] * 1e-3));
    seen.push_back(weights.xyz(radiance.data()));
  }
  return seen;
}

Xyz<double> scaled(const Xyz<double>& c, double factor) { return {c.x * factor, c.y * factor, c.z * factor}; }

}  // namespace

VisibleError visible_error(const ModelSpec& spec, const ModelSpec& exact, const std::vector<double>& values) {
  Xyz<double> white{};
  const std::vector<Xyz<double>> truth = colours(exact, values, white), seen = colours(spec, values, white);
  double brightest = 0;
  for (const Xyz<double>& one : truth) brightest = std::max(brightest, one.y);
  if (brightest <= 0) return {0, 0};
  VisibleError error{0, 0};
  for (std::size_t p = 0; p < truth.size(); ++p) {
    const double factor = white.y / brightest;
    const double e = delta_e_2000(lab(scaled(truth[p], factor), white), lab(scaled(seen[p], factor), white));
    error.mean += e / static_cast<double>(truth.size());
    error.largest = std::max(error.largest, e);
  }
  return error;
}

}  // namespace gonio
