#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "fit/formats/rgl.h"

namespace gonio {
namespace {

constexpr double kQuarterTurn = 1.57079632679489661923, kTurn = 4 * kQuarterTurn;
constexpr double kMostZenith = 89.5 / 90 * kQuarterTurn;  // where retro-reflection is still asked for

UnitVector<double> direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
double angle_of_u(double u) { return u * u * kQuarterTurn; }
double azimuth_of_u(double u) { return (2 * u - 1) * kTurn / 2; }
double solid_angle_of_u(double u) { return kTurn * kTurn / 2 * u * std::sin(angle_of_u(u)); }

/// f of the source, refused where it is no BRDF.
double checked(const RglSource& source, const UnitVector<double>& i, const UnitVector<double>& o,
               std::size_t wavelength) {
  const double f = source.f(i, o, wavelength);
  if (!(f >= 0) || !std::isfinite(f))
    throw input_error("f_r is {} at theta_i {:.3f}, theta_o {:.3f} degrees; expected a finite value of 0 or more", f,
                      std::acos(i.z) * 90 / kQuarterTurn, std::acos(o.z) * 90 / kQuarterTurn);
  return f;
}

double mean_over_wavelengths(const RglSource& source, const UnitVector<double>& i, const UnitVector<double>& o) {
  double sum = 0;
  for (std::size_t w = 0; w < source.wavelengths_nm.size(); ++w) sum += checked(source, i, o, w);
  return sum / static_cast<double>(source.wavelengths_nm.size());
}

/// What azimuth does to a source.
enum class Symmetry { isotropic, quarter, none };

/// Tried on pairs of directions spread over the hemisphere; equal to 1e-9.
Symmetry symmetry_of(const RglSource& source) {
  bool isotropic = true, quarter = true;
  for (int k = 0; k < 40; ++k) {
    const auto turn = [&](double irrational) { return std::fmod((k + 1) * irrational, 1.0); };
    const UnitVector<double> i = direction(1.4 * std::sqrt(turn(0.6180339887)), kTurn * turn(0.7548776662));
    const UnitVector<double> o = direction(1.4 * std::sqrt(turn(0.5698402910)), kTurn * turn(0.8191725134));
    const double angle = kTurn * turn(0.6710436067), c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const UnitVector<double>& d) {
      return UnitVector<double>{c * d.x - s * d.y, s * d.x + c * d.y, d.z};
    };
    const auto flipped_x = [](const UnitVector<double>& d) { return UnitVector<double>{-d.x, d.y, d.z}; };
    const auto flipped_y = [](const UnitVector<double>& d) { return UnitVector<double>{d.x, -d.y, d.z}; };
    const double f = mean_over_wavelengths(source, i, o), tolerance = 1e-9 * f + 1e-300;
    const auto same = [&](const auto& change) {
      return std::abs(mean_over_wavelengths(source, change(i), change(o)) - f) <= tolerance;
    };
    quarter = quarter && same(flipped_x) && same(flipped_y);
    isotropic = isotropic && same(turned) && same(flipped_y);
  }
  return isotropic ? Symmetry::isotropic : quarter ? Symmetry::quarter : Symmetry::none;
}

RglResolution resolved(const RglResolution& asked, Symmetry symmetry) {
  const bool isotropic = symmetry == Symmetry::isotropic;
  const auto either = [](std::size_t given, std::size_t usual) { return given > 0 ? given : usual; };
  return {either(asked.theta_i, isotropic ? 24 : 14),
          isotropic ? 1 : either(asked.phi_i, symmetry == Symmetry::quarter ? 9 : 33),
          either(asked.samples, isotropic ? 64 : 48), either(asked.normals_theta, isotropic ? 512 : 192),
          isotropic ? 2 : either(asked.normals_phi, 97)};
}

/// Nodes of the angle of incidence, denser towards grazing where more happens: 0 to 89°.
std::vector<float> incidence_nodes(std::size_t count) {
  std::vector<float> nodes;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0;
    nodes.push_back(static_cast<float>(89.0 / 90 * kQuarterTurn * (1.25 * t - 0.25 * t * t)));
  }
  return nodes;
}

/// -180° to -90°, or a whole turn; 0 alone for an isotropic source.
std::vector<float> azimuth_nodes(std::size_t count, Symmetry symmetry) {
  if (symmetry == Symmetry::isotropic) return {0.0f};
  const double span = symmetry == Symmetry::quarter ? kQuarterTurn : kTurn;
  std::vector<float> nodes;
  for (std::size_t k = 0; k < count; ++k)
    nodes.push_back(static_cast<float>(-kTurn / 2 + span * static_cast<double>(k) / static_cast<double>(count - 1)));
  return nodes;
}

double coordinate(std::size_t index, std::size_t count) {
  return static_cast<double>(index) / static_cast<double>(count - 1);
}

/// The normals' distribution as a grid over u, and the projected area of its facets; rows of azimuth, equal where isotropic.
struct Normals {
  RglGrid ndf, sigma;
  bool isotropic;

  /// Normals of a fine grid with their share of ∫ D dω (trapezoids in u); azimuths of an isotropic grid are filled in.
  struct Part {
    UnitVector<double> m;
    double weight;
  };
  std::vector<Part> parts() const {
    const std::size_t around = isotropic ? 65 : ndf.height;
    std::vector<Part> all;
    for (std::size_t y = 0; y < around; ++y)
      for (std::size_t x = 0; x < ndf.width; ++x) {
        const double u = coordinate(x, ndf.width),
                     ends = (y == 0 || y + 1 == around ? 0.5 : 1) * (x == 0 || x + 1 == ndf.width ? 0.5 : 1);
        const double area = ends / (static_cast<double>(around - 1) * static_cast<double>(ndf.width - 1));
        all.push_back({direction(angle_of_u(u), azimuth_of_u(coordinate(y, around))),
                       area * solid_angle_of_u(u) * ndf.values[(isotropic ? 0 : y) * ndf.width + x]});
      }
    return all;
  }

  /// σ(i) = ∫ D(m)·max(0, i·m) dω.
  void project() {
    const std::vector<Part> all = parts();
    for (std::size_t y = 0; y < sigma.height; ++y)
      for (std::size_t x = 0; x < sigma.width; ++x) {
        float& out = sigma.values[y * sigma.width + x];
        if (isotropic && y > 0) {
          out = sigma.values[x];
          continue;
        }
        const UnitVector<double> i =
            direction(angle_of_u(coordinate(x, sigma.width)), azimuth_of_u(coordinate(y, sigma.height)));
        double sum = 0;
        for (const Part& part : all) sum += part.weight * std::max(0.0, dot(i, part.m));
        out = static_cast<float>(sum);
      }
  }

  /// ∫ D·cosθ dω = 1.
  void normalise() {
    double sum = 0;
    for (const Part& part : parts()) sum += part.weight * part.m.z;
    for (float& d : ndf.values) d = static_cast<float>(d / sum);
  }

  /// Shares of wider lobes, √D and ⁴√D, and of an even one (found by trying on Gaussian, GGX and Ward lobes), so that faint directions have
  /// nodes too: a Gaussian's tail falls over many decades within what would else be a single cell.
  void widen() {
    Normals root = *this, fourth = *this;
    for (float& d : root.ndf.values) d = std::sqrt(d);
    for (float& d : fourth.ndf.values) d = std::sqrt(std::sqrt(d));
    root.normalise();
    fourth.normalise();
    constexpr double kRoot = 0.3, kFourth = 0.3, kEven = 0.03;
    for (std::size_t k = 0; k < ndf.values.size(); ++k)
      ndf.values[k] = static_cast<float>((1 - kRoot - kFourth - kEven) * ndf.values[k] + kRoot * root.ndf.values[k] +
                                         kFourth * fourth.ndf.values[k] + kEven * 2 / kTurn);
  }
};

/// Section 4.2: f(m, m)·cosθ = F·D(m)/(4·σ(m)) where shadowing is that of the projected area, so D is the fixed point of
/// f(m, m)·cosθ_m·σ[D](m).
Normals distribution_of(const RglSource& source, const RglResolution& resolution, bool isotropic) {
  Normals normals{{resolution.normals_phi, resolution.normals_theta, {}},
                  {isotropic ? 2ul : 33ul, isotropic ? 96ul : 48ul, {}},
                  isotropic};
  RglGrid &ndf = normals.ndf, &sigma = normals.sigma;
  ndf.values.assign(ndf.height * ndf.width, 1.0f);
  sigma.values.assign(sigma.height * sigma.width, 1.0f);
  std::vector<double> back;
  double most = 0;
  for (std::size_t y = 0; y < ndf.height; ++y)
    for (std::size_t x = 0; x < ndf.width; ++x) {
      const double theta = angle_of_u(coordinate(x, ndf.width));
      const UnitVector<double> m = direction(std::min(theta, kMostZenith), azimuth_of_u(coordinate(y, ndf.height)));
      back.push_back(mean_over_wavelengths(source, m, m) * std::max(0.0, std::cos(theta)));
      most = std::max(most, back.back());
    }
  if (!(most > 0)) back.assign(back.size(), 1.0);  // nothing returns: even
  constexpr int kIterations = 6;
  for (int k = 0; k < kIterations; ++k) {
    normals.project();
    for (std::size_t y = 0; y < ndf.height; ++y)
      for (std::size_t x = 0; x < ndf.width; ++x) {
        const SquarePoint u{coordinate(x, ndf.width), coordinate(y, ndf.height)};
        const double area = bilinear(sigma.values, 0, sigma.height, sigma.width, u);
        ndf.values[y * ndf.width + x] = static_cast<float>(back[y * ndf.width + x] * area / (most > 0 ? most : 1));
      }
    normals.normalise();
  }
  normals.widen();
  normals.project();
  return normals;
}

/// D(m)·max(0, i·m) per area of the unit square: what the samples are spread by.
RglGrid visible_normals(const RglTable& table, bool isotropic) {
  RglGrid vndf{isotropic ? 64ul : 96ul, isotropic ? 256ul : 128ul, {}};
  for (const float phi_i : table.phi_i)
    for (const float theta_i : table.theta_i) {
      const UnitVector<double> i = direction(theta_i, phi_i);
      for (std::size_t y = 0; y < vndf.height; ++y)
        for (std::size_t x = 0; x < vndf.width; ++x) {
          const SquarePoint u{coordinate(x, vndf.width), coordinate(y, vndf.height)};
          const UnitVector<double> m = direction(angle_of_u(u.x), azimuth_of_u(u.y) + (isotropic ? phi_i : 0));
          const double d = bilinear(table.ndf.values, 0, table.ndf.height, table.ndf.width, u);
          vndf.values.push_back(static_cast<float>(d * std::max(0.0, dot(i, m)) * solid_angle_of_u(u.x)));
        }
    }
  return vndf;
}

/// The nodes below the horizon of one slice (NaN so far): straight on from the two before them in their row or column, held between
/// 0 (no interpolated value is negative) and the nearest one; 0 where there are none.
void continue_below(float* values, std::size_t samples) {
  const std::vector<float> seen(values, values + samples * samples);
  const auto at = [&](std::ptrdiff_t row, std::ptrdiff_t column) {
    const auto n = static_cast<std::ptrdiff_t>(samples);
    return row < 0 || column < 0 || row >= n || column >= n ? NAN : seen[static_cast<std::size_t>(row * n + column)];
  };
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (!std::isnan(seen[k])) continue;
    const auto row = static_cast<std::ptrdiff_t>(k / samples), column = static_cast<std::ptrdiff_t>(k % samples);
    double sum = 0;
    int count = 0;
    for (const auto& [down, right] : {std::pair{0, 1}, {0, -1}, {1, 0}, {-1, 0}}) {
      const float near = at(row + down, column + right), far = at(row + 2 * down, column + 2 * right);
      if (std::isnan(near) || std::isnan(far)) continue;
      sum += std::clamp(2.0 * near - far, 0.0, 1.0 * near);
      ++count;
    }
    values[k] = count > 0 ? static_cast<float>(sum / count) : 0.0f;
  }
}

/// Values over ndf/(4·sigma) at the nodes of s, as the reader's own warp places them.
void fill_spectra(const RglSource& source, RglTable& table, std::size_t samples) {
  const std::size_t wavelengths = source.wavelengths_nm.size(), size = samples * samples;
  table.spectra = {samples, samples,
                   std::vector<float>(table.phi_i.size() * table.theta_i.size() * wavelengths * size, 1.0f)};
  table.luminance = {samples, samples, std::vector<float>(table.phi_i.size() * table.theta_i.size() * size, 1.0f)};
  const RglBrdf places(table);  // spectra of 1: f_at() there is ndf/(4·sigma·cos_o)
  for (std::size_t phi = 0; phi < table.phi_i.size(); ++phi)
    for (std::size_t theta = 0; theta < table.theta_i.size(); ++theta)
      for (std::size_t row = 0; row < samples; ++row)
        for (std::size_t column = 0; column < samples; ++column) {
          const RglBrdf::Node node = places.node(phi, theta, row, column);
          const bool seen = node.o.z > 1e-9 && dot(node.i, node.m) > 0;
          const double unit = seen ? places.f_at(node, phi, theta, 0, row, column) : 1;
          const std::size_t slice = phi * table.theta_i.size() + theta, at = row * samples + column;
          double mean = 0;
          for (std::size_t w = 0; w < wavelengths; ++w) {
            const double value = seen ? checked(source, node.i, node.o, w) / unit : NAN;
            table.spectra.values[(slice * wavelengths + w) * size + at] = static_cast<float>(value);
            mean += value / static_cast<double>(wavelengths);
          }
          table.luminance.values[slice * size + at] = seen ? static_cast<float>(mean) : 0.0f;
        }
  for (std::size_t first = 0; first < table.spectra.values.size(); first += size)
    continue_below(&table.spectra.values[first], samples);
}

void require_wavelengths(const RglSource& source) {
  if (source.wavelengths_nm.empty()) throw input_error("no wavelength; expected at least one");
  for (std::size_t w = 0; w < source.wavelengths_nm.size(); ++w) {
    const double nm = source.wavelengths_nm[w];
    if (!(nm >= 100 && nm <= 1e5))
      throw input_error("{} nm: no wavelength of the format; expected 100 to 100000 nm", nm);
    if (w > 0 && !(static_cast<float>(nm) > static_cast<float>(source.wavelengths_nm[w - 1])))
      throw input_error("{} nm after {} nm; expected increasing wavelengths", nm, source.wavelengths_nm[w - 1]);
  }
}

}  // namespace

RglTable make_rgl(const RglSource& source, const RglResolution& asked) {
  require_wavelengths(source);
  const Symmetry symmetry = symmetry_of(source);
  const bool isotropic = symmetry == Symmetry::isotropic;
  const RglResolution resolution = resolved(asked, symmetry);
  RglTable table;
  table.description = source.description;
  table.wavelengths_nm.assign(source.wavelengths_nm.begin(), source.wavelengths_nm.end());
  table.theta_i = incidence_nodes(resolution.theta_i);
  table.phi_i = azimuth_nodes(resolution.phi_i, symmetry);
  Normals normals = distribution_of(source, resolution, isotropic);
  table.ndf = std::move(normals.ndf);
  table.sigma = std::move(normals.sigma);
  table.vndf = visible_normals(table, isotropic);
  fill_spectra(source, table, resolution.samples);
  if (std::none_of(table.spectra.values.begin(), table.spectra.values.end(), [](float v) { return v > 0; }))
    throw input_error("the BRDF reflects nothing; expected f_r above 0 somewhere");
  return table;
}

}  // namespace gonio
