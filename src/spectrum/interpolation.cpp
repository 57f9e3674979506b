#include "spectrum/interpolation.h"

#include <algorithm>
#include <array>
#include <boost/math/interpolators/barycentric_rational.hpp>
#include <boost/math/interpolators/makima.hpp>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

using Values = std::vector<double>;
/// y = Σ a[i]·tⁱ over one interval, t = x - its left end.
using Piece = std::array<double, 6>;

struct Name {
  Interpolation variant;
  std::string_view name;
  std::size_t fewest;
};
constexpr Name kNames[] = {{Interpolation::linear, "linear", 2},
                           {Interpolation::pchip, "pchip", 4},
                           {Interpolation::akima, "akima", 4},
                           {Interpolation::natural_cubic, "natural-cubic", 3},
                           {Interpolation::barycentric_rational, "barycentric-rational", 4},
                           {Interpolation::sprague, "sprague", 6}};

std::vector<Piece> linear_pieces(const Values& x, const Values& y) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    pieces.push_back({y[i], (y[i + 1] - y[i]) / (x[i + 1] - x[i]), 0, 0, 0, 0});
  return pieces;
}

/// Cubic pieces from values and slopes (Hermite).
std::vector<Piece> hermite_pieces(const Values& x, const Values& y, const Values& slope) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double h = x[i + 1] - x[i], secant = (y[i + 1] - y[i]) / h;
    pieces.push_back({y[i], slope[i], (3 * secant - 2 * slope[i] - slope[i + 1]) / h,
                      (slope[i] + slope[i + 1] - 2 * secant) / (h * h), 0, 0});
  }
  return pieces;
}

template <class Cubic>
Values slopes_of(const Values& x, const Values& y) {
  const Cubic cubic{Values(x), Values(y)};
  Values slopes;
  for (const double at : x) slopes.push_back(cubic.prime(at));
  return slopes;
}

/// Slopes that make the second derivative continuous, 0 at both ends: a tridiagonal system (Thomas).
Values natural_slopes(const Values& x, const Values& y) {
  const std::size_t n = x.size();
  Values diagonal(n), above(n), right(n);
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  diagonal[0] = 2, above[0] = 1, right[0] = 3 * secant(0);
  for (std::size_t i = 1; i < n; ++i) {
    const bool last = i + 1 == n;
    const double below = last ? 1 : 1 / h(i - 1), own = last ? 2 : 2 / h(i - 1) + 2 / h(i);
    const double value = last ? 3 * secant(i - 1) : 3 * (secant(i - 1) / h(i - 1) + secant(i) / h(i));
    const double factor = below / diagonal[i - 1];
    above[i] = last ? 0 : 1 / h(i);
    diagonal[i] = own - factor * above[i - 1];
    right[i] = value - factor * right[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) right[i] = (right[i] - (i + 1 < n ? above[i] * right[i + 1] : 0)) / diagonal[i];
  return right;
}

/// CIE 167:2005: quintics whose first and second derivatives at the points are those of the five-point formulas; two
/// points are made up beyond each end.
std::vector<Piece> sprague_pieces(const Values& x, const Values& y) {
  const std::size_t n = y.size();
  const auto first = [&](const std::array<double, 6>& c, bool from_end) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) sum += c[i] * (from_end ? y[n - 1 - i] : y[i]);
    return sum / 209;
  };
  constexpr std::array<double, 6> kSecond{884, -1960, 3033, -2648, 1080, -180}, kFirst{508, -540, 488, -367, 144, -24};
  Values p{first(kSecond, false), first(kFirst, false)};
  p.insert(p.end(), y.begin(), y.end());
  p.push_back(first(kFirst, true));
  p.push_back(first(kSecond, true));
  const double h = (x.back() - x.front()) / static_cast<double>(n - 1);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double *q = &p[i], a = q[0], b = q[1], c = q[2], d = q[3], e = q[4], f = q[5];
    Piece piece{c,
                (2 * a - 16 * b + 16 * d - 2 * e) / 24,
                (-a + 16 * b - 30 * c + 16 * d - e) / 24,
                (-9 * a + 39 * b - 70 * c + 66 * d - 33 * e + 7 * f) / 24,
                (13 * a - 64 * b + 126 * c - 124 * d + 61 * e - 12 * f) / 24,
                (-5 * a + 25 * b - 50 * c + 50 * d - 25 * e + 5 * f) / 24};
    double scale = 1;
    for (double& coefficient : piece) coefficient *= scale, scale /= h;
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<Piece> pieces_of(Interpolation variant, const Values& x, const Values& y) {
  using boost::math::interpolators::makima, boost::math::interpolators::pchip;
  switch (variant) {
    case Interpolation::linear:
      return linear_pieces(x, y);
    case Interpolation::pchip:
      return hermite_pieces(x, y, slopes_of<pchip<Values>>(x, y));
    case Interpolation::akima:
      return hermite_pieces(x, y, slopes_of<makima<Values>>(x, y));
    case Interpolation::natural_cubic:
      return hermite_pieces(x, y, natural_slopes(x, y));
    case Interpolation::sprague:
      return sprague_pieces(x, y);
    case Interpolation::barycentric_rational:
      break;  // no piecewise polynomial
  }
  return {};
}

}  // namespace

std::string_view name_of(Interpolation variant) {
  return std::find_if(std::begin(kNames), std::end(kNames), [&](const Name& n) { return n.variant == variant; })->name;
}

std::optional<Interpolation> interpolation_named(std::string_view name) {
  for (const Name& n : kNames)
    if (n.name == name) return n.variant;
  return std::nullopt;
}

std::size_t fewest_points(Interpolation variant) {
  return std::find_if(std::begin(kNames), std::end(kNames), [&](const Name& n) { return n.variant == variant; })
      ->fewest;
}

bool is_equidistant(const std::vector<double>& x) {
  if (x.size() < 2) return false;
  const double whole = x.back() - x.front(), step = whole / static_cast<double>(x.size() - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - x.front() - static_cast<double>(i) * step) > 1e-9 * whole) return false;
  return true;
}

struct Interpolator::State {
  Values x, y;
  std::vector<Piece> pieces;
  std::optional<boost::math::barycentric_rational<double>> rational;
  double steps_per_x = 0;  ///< of equidistant points: the interval is found without a search

  std::size_t interval(double at) const {
    const std::size_t last = x.size() - 2;
    if (steps_per_x > 0) {
      std::size_t i = std::min(static_cast<std::size_t>((at - x.front()) * steps_per_x), last);
      if (at < x[i]) --i;  // rounding, by one at most
      return i < last && at >= x[i + 1] ? i + 1 : i;
    }
    return std::min(static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin() - 1), last);
  }

  double value(double at) const {
    const std::size_t i = interval(at);
    if (at == x[i + 1]) return y[i + 1];
    if (rational) return at == x[i] ? y[i] : (*rational)(at);
    const double t = at - x[i];
    const Piece& a = pieces[i];
    return a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * (a[4] + t * a[5]))));
  }
};

Interpolator::Interpolator(Interpolation variant, std::vector<double> x, std::vector<double> y)
    : state_(std::make_unique<State>()) {
  if (x.size() != y.size() || x.size() < fewest_points(variant))
    throw input_error("{}: {} points, {} values; expected as many, at least {}", name_of(variant), x.size(), y.size(),
                      fewest_points(variant));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || (i > 0 && !(x[i] > x[i - 1])))
      throw input_error("{}: point {} is ({}, {}); expected finite numbers, increasing", name_of(variant), i, x[i],
                        y[i]);
  const bool equidistant = is_equidistant(x);
  if (variant == Interpolation::sprague && !equidistant)
    throw input_error("sprague: steps of x differ; expected equidistant points");
  state_->pieces = pieces_of(variant, x, y);
  if (variant == Interpolation::barycentric_rational) state_->rational.emplace(x.begin(), x.end(), y.begin(), 3);
  if (equidistant) state_->steps_per_x = static_cast<double>(x.size() - 1) / (x.back() - x.front());
  state_->x = std::move(x), state_->y = std::move(y);
}

Interpolator::Interpolator(Interpolator&&) noexcept = default;
Interpolator::~Interpolator() = default;

double Interpolator::lo() const { return state_->x.front(); }
double Interpolator::hi() const { return state_->x.back(); }

double Interpolator::at(double x) const {
  if (!(x >= lo() && x <= hi())) throw input_error("{} is outside the table; expected {} to {}", x, lo(), hi());
  return state_->value(x);
}

Interpolated Interpolator::at(double x, Extension extension) const {
  if (x >= lo() && x <= hi()) return {state_->value(x), false};
  if (!std::isfinite(x)) throw input_error("{} is no place on a table; expected a finite number", x);
  const Values &px = state_->x, &py = state_->y;
  const bool below = x < lo();
  const std::size_t end = below ? 0 : px.size() - 1, inner = below ? 1 : px.size() - 2;
  if (extension == Extension::nearest) return {py[end], true};
  return {py[end] + (x - px[end]) * (py[inner] - py[end]) / (px[inner] - px[end]), true};
}

}  // namespace gonio
