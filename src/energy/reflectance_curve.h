#pragma once
#include <functional>
#include <span>
#include <vector>

#include "energy/energy_grid.h"

namespace gonio {

/// E(θ) of one lobe on one surface at one wavelength, at the columns of EnergyGrid.
class ReflectanceCurve {
 public:
  ReflectanceCurve() = default;  ///< 0 everywhere
  /// One value a column, from grazing to the normal.
  explicit ReflectanceCurve(std::vector<double> e) : e_(std::move(e)), grid_{.columns = e_.size()} {}
  /// Of a function of cos θ, asked at the columns.
  static ReflectanceCurve of(const std::function<double(double cos_theta)>& e,
                             std::size_t columns = EnergyGrid{}.columns);

  bool empty() const { return e_.empty(); }
  std::span<const double> values() const { return e_; }
  double cos_theta(std::size_t column) const { return grid_.cos_theta(column); }

  /// cos_theta 0 to 1.
  double operator()(double cos_theta) const {
    if (e_.empty()) return 0;
    const CubicTaps<double> at(grid_.column_of(cos_theta), e_.size());
    double sum = 0;
    for (std::size_t c = 0; c < at.weight.size(); ++c) sum += at.weight[c] * e_[at.first + c];
    return sum;
  }
  /// Of many, in lanes.
  void at(std::span<const float> cos_theta, std::span<float> e) const;

  /// Hemispherical mean, 2∫ E cosθ sinθ dθ: what is reflected of uniform light.
  double mean() const;
  /// The largest value and the cosine where it is reached.
  struct Largest {
    double value = 0, cos_theta = 1;
  };
  Largest largest() const;

  ReflectanceCurve& add(const ReflectanceCurve& other, double factor);

 private:
  std::vector<double> e_;
  EnergyGrid grid_;
};

}  // namespace gonio
