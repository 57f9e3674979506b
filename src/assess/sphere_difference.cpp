#include "assess/sphere_difference.h"

#include <algorithm>
#include <cmath>

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

/// XYZ of every pixel; `light_power` at the wavelengths, a white Lambert surface facing the light has π·f = 1.
std::vector<Xyz<double>> colours(const BrdfOfPair& f, const ColorWeights& weights,
                                 const std::vector<double>& light_power, bool grey) {
  std::vector<Xyz<double>> seen;
  for (const Pixel& p : pixels()) {
    std::vector<double> radiance;
    for (std::size_t c = 0; c < light_power.size(); ++c)
      radiance.push_back(light_power[c] * kPi<double> * p.i.z * f(p.i, p.o, grey ? 0 : c));
    seen.push_back(weights.xyz(radiance.data()));
  }
  return seen;
}

Xyz<double> scaled(const Xyz<double>& c, double factor) { return {c.x * factor, c.y * factor, c.z * factor}; }

}  // namespace

VisibleError sphere_difference(const BrdfOfPair& exact, const BrdfOfPair& shown,
                               const std::vector<double>& wavelengths_nm) {
  const Database& database = Database::bundled();
  const bool grey = wavelengths_nm.size() < 2;
  std::vector<double> nodes = wavelengths_nm;
  if (grey) {
    nodes.clear();
    for (double nm = 380; nm <= 780; nm += 10) nodes.push_back(nm);
  }
  const ColorWeights weights = color_weights(nodes, observer_of(database.find("1931-2")));
  const Spectrum light = light_of(database.find("D65"));
  std::vector<double> power;
  for (const double nm : nodes) power.push_back(light.at(nm));
  const Xyz<double> white = weights.xyz(power.data());
  const std::vector<Xyz<double>> truth = colours(exact, weights, power, grey),
                                 seen = colours(shown, weights, power, grey);
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
