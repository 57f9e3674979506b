#include "energy/reflectance_curve.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "brdf/lanes.h"

namespace gonio {
namespace {

/// Bound of the cubic through four columns between the middle two: the larger of them and an eighth of the larger second difference.
double highest_between(std::span<const double> e, std::size_t column) {
  if (column == 0 || column + 2 >= e.size()) return std::numeric_limits<double>::infinity();
  const auto bend = [&](std::size_t c) { return std::abs(e[c - 1] - 2 * e[c] + e[c + 1]); };
  return std::max(e[column], e[column + 1]) + std::max(bend(column), bend(column + 1)) / 8;
}

}  // namespace

ReflectanceCurve ReflectanceCurve::of(const std::function<double(double)>& e, std::size_t columns) {
  const EnergyGrid grid{.columns = columns};
  std::vector<double> values;
  for (std::size_t c = 0; c < columns; ++c) values.push_back(e(grid.cos_theta(c)));
  return ReflectanceCurve(std::move(values));
}

void ReflectanceCurve::at(std::span<const float> cos_theta, std::span<float> e) const {
  constexpr std::size_t kLanes = FloatLanes::size;
  alignas(64) std::array<float, kLanes> place{};
  const std::vector<float> known(e_.begin(), e_.end());
  for (std::size_t from = 0; from < e.size(); from += kLanes) {
    const std::size_t count = std::min(kLanes, e.size() - from);
    std::copy_n(&cos_theta[from], count, place.begin());
    grid_.column_of(FloatLanes::load_aligned(place.data())).store_aligned(place.data());
    for (std::size_t i = 0; i < count; ++i) {
      const CubicTaps<float> at(place[i], known.size());
      const float* four = &known[at.first];
      e[from + i] = at.weight[0] * four[0] + at.weight[1] * four[1] + at.weight[2] * four[2] + at.weight[3] * four[3];
    }
  }
}

double ReflectanceCurve::mean() const {
  if (e_.empty()) return 0;
  // Between two columns the curve is a cubic of the column, smooth; with cosθ sinθ dθ = cos dcos, Gauss's four points are ample.
  using Gauss = boost::math::quadrature::gauss<double, 4>;
  double sum = 0;
  for (std::size_t c = 0; c + 1 < e_.size(); ++c) {
    const double lo = c == 0 ? 0 : grid_.cos_theta(c), hi = grid_.cos_theta(c + 1);
    const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double cosine = middle + side * half * Gauss::abscissa()[i];
        sum += half * Gauss::weights()[i] * 2 * cosine * (*this)(cosine);
      }
  }
  return sum;
}

ReflectanceCurve::Largest ReflectanceCurve::largest() const {
  Largest found;
  for (std::size_t c = 0; c < e_.size(); ++c)
    if (e_[c] > found.value) found = {e_[c], grid_.cos_theta(c)};
  constexpr int kBetween = 4;  // places between columns, where a cubic may rise above both
  for (std::size_t c = 0; c + 1 < e_.size(); ++c) {
    if (highest_between(e_, c) <= found.value) continue;
    const double here = grid_.cos_theta(c), next = grid_.cos_theta(c + 1);
    for (int part = 1; part < kBetween; ++part) {
      const double cosine = here + (next - here) * part / kBetween, value = (*this)(cosine);
      if (value > found.value) found = {value, cosine};
    }
  }
  return found;
}

ReflectanceCurve& ReflectanceCurve::add(const ReflectanceCurve& other, double factor) {
  if (e_.empty()) *this = ReflectanceCurve(std::vector<double>(other.e_.size(), 0));
  for (std::size_t c = 0; c < e_.size(); ++c) e_[c] += factor * other.e_[c];
  return *this;
}

}  // namespace gonio
