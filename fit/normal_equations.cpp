#include "fit/normal_equations.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/one_loop.h"
#include "fit/metric.h"

namespace gonio {
namespace {

constexpr std::size_t kStretch = 128;  // batches
constexpr std::size_t kMost = kMostColumns;
using Triangle = std::array<double, kMost*(kMost + 1) / 2 + 1>;

/// What one block of batches adds: the triangle of the Gram matrix row by row, the cost last.
template <Metric kMetric, Loss kLoss, std::size_t kColumns>
GONIO_ONE_LOOP void add_block(const LanePoints& points, const DoubleLanes* value, const DoubleLanes* const* slope,
                              std::size_t given_columns, double kd, double ks, double diffuse, double floor_per_sr,
                              double loss_width, std::size_t from, std::size_t to, Triangle& sums) {
  const std::size_t columns = kColumns > 0 ? kColumns : given_columns, varied = columns - 3;
  constexpr std::size_t kRoom = kColumns > 0 ? kColumns : kMost;
  std::array<DoubleLanes, kRoom*(kRoom + 1) / 2> sum;
  sum.fill(DoubleLanes(0.0));
  DoubleLanes cost(0.0);
  const DoubleLanes constant(kd * diffuse), scale(ks), floor(floor_per_sr), d(diffuse);
  for (std::size_t batch = from; batch < to; ++batch) {
    const DoubleLanes s = value[batch], f = multiply_add(scale, s, constant);
    const Compared<DoubleLanes> at = compared_at<kMetric>(f, points.weight[batch], floor);
    const DoubleLanes r = (at.value - points.compared[batch]) * points.confidence[batch];
    const Robust robust = robust_in_lanes<kLoss>(r, loss_width);
    cost += robust.cost;
    const DoubleLanes by_f = at.slope * points.confidence[batch];
    std::array<DoubleLanes, kRoom> column;
    for (std::size_t j = 0; j < varied; ++j) column[j] = by_f * scale * slope[j][batch];
    column[varied] = by_f * d, column[varied + 1] = by_f * s, column[varied + 2] = r;
    for (std::size_t i = 0, at_sum = 0; i < columns; ++i) {
      const DoubleLanes weighted = kLoss == Loss::none ? column[i] : column[i] * robust.weight;
      for (std::size_t j = 0; j <= i; ++j, ++at_sum) sum[at_sum] = multiply_add(weighted, column[j], sum[at_sum]);
    }
  }
  const std::size_t entries = columns * (columns + 1) / 2;
  for (std::size_t i = 0; i < entries; ++i) sums[i] = xsimd::hadd(sum[i]);
  sums[entries] = xsimd::hadd(cost);
}

template <Metric kMetric, Loss kLoss, class... Rest>
void add_columns(std::size_t columns, const LanePoints& points, const DoubleLanes* value,
                 const DoubleLanes* const* slope, Rest&&... rest) {
  const auto run = [&]<std::size_t kColumns>() {
    add_block<kMetric, kLoss, kColumns>(points, value, slope, columns, rest...);
  };
  switch (columns) {
    case 3:
      return run.template operator()<3>();
    case 4:
      return run.template operator()<4>();
    case 5:
      return run.template operator()<5>();
    default:
      return run.template operator()<0>();
  }
}

template <Metric kMetric, class... Rest>
void add_loss(Loss loss, Rest&&... rest) {
  if (loss == Loss::none) return add_columns<kMetric, Loss::none>(rest...);
  if (loss == Loss::huber) return add_columns<kMetric, Loss::huber>(rest...);
  add_columns<kMetric, Loss::cauchy>(rest...);
}

template <class... Rest>
void add(Metric metric, Rest&&... rest) {
  with_metric(metric, [&]<Metric kMetric>() { add_loss<kMetric>(rest...); });
}

/// The same of the linear problem near the data.
template <Metric kMetric>
GONIO_ONE_LOOP void add_guess(const LanePoints& points, const DoubleLanes* value, double diffuse, double floor_per_sr,
                              std::size_t from, std::size_t to, std::array<double, 6>& sums) {
  std::array<DoubleLanes, 6> sum;
  sum.fill(DoubleLanes(0.0));
  const DoubleLanes floor(floor_per_sr), d(diffuse);
  for (std::size_t batch = from; batch < to; ++batch) {
    const DoubleLanes y = points.measured[batch];
    const DoubleLanes positive = larger_of(DoubleLanes(xsimd::abs(y)), DoubleLanes(1e-12));
    const DoubleLanes by_f =
        compared_at<kMetric>(positive, points.weight[batch], floor).slope * points.confidence[batch];
    const std::array<DoubleLanes, 3> column{by_f * d, by_f * value[batch], by_f * y};
    for (std::size_t i = 0, at = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++at) sum[at] = multiply_add(column[i], column[j], sum[at]);
  }
  for (std::size_t i = 0; i < 6; ++i) sums[i] = xsimd::hadd(sum[i]);
}

}  // namespace

NormalEquations::NormalEquations(const LaneFit& fit, bool with_roughness)
    : linear(fit.linear_.size(), fit.held_), fit_(&fit), varied_(with_roughness ? fit.roughness_.size() : 0) {
  for (std::size_t g = 0; g < fit.points_.groups.size(); ++g) {
    const LaneGroup& group = fit.points_.groups[g];
    for (std::size_t at = 0; at < group.batches; at += kStretch)
      stretches_.push_back({g, group.first + at, group.first + std::min(at + kStretch, group.batches)});
  }
}

/// sums(stretch number) of each, several at a time where there are many.
template <class Sums>
void NormalEquations::each_stretch(Sums&& sums) const {
  if (stretches_.size() < 8) {
    for (std::size_t i = 0; i < stretches_.size(); ++i) sums(i);
  } else {
    tbb::parallel_for(std::size_t{0}, stretches_.size(), sums);
  }
}

void NormalEquations::evaluate_lobe_at() {
  const FitProblem& problem = fit_->problem_;
  std::vector<double> values = problem.values;
  std::optional<double> n;
  for (std::size_t i = 0; i < fit_->roughness_.size(); ++i) {
    const std::size_t place = problem.free[fit_->roughness_[i]].place;
    (place == FreeParameter::kIndex ? n.emplace() : values[place]) = std::exp(roughness[i]);
  }
  evaluate_lobe(fit_->points_, {problem.model, values, fit_->varied_, n}, fit_->reflectance_, varied_ > 0, columns_);
}

bool NormalEquations::evaluate(bool new_roughness) {
  if (new_roughness) evaluate_lobe_at();
  const FitProblem& problem = fit_->problem_;
  const std::size_t columns = varied_ + 3, entries = columns * (columns + 1) / 2;
  std::array<const DoubleLanes*, kMost> slope{};
  for (std::size_t j = 0; j < varied_; ++j) slope[j] = columns_.slope[j].data();

  parts_.resize(stretches_.size());
  each_stretch([&](std::size_t i) {
    const Stretch& stretch = stretches_[i];
    const auto& [kd, ks] = linear[fit_->block_of(fit_->points_.groups[stretch.group])];
    add(problem.metric, problem.loss, columns, fit_->points_, columns_.value.data(), slope.data(), kd, ks,
        fit_->diffuse_[stretch.group], problem.floor_per_sr, problem.loss_width, stretch.from, stretch.to, parts_[i]);
  });

  gram.assign(linear.size(), GramMatrix::Zero(Eigen::Index(columns), Eigen::Index(columns)));
  cost = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    GramMatrix& sum = gram[fit_->block_of(fit_->points_.groups[stretches_[p].group])];
    for (Eigen::Index i = 0, at = 0; i < Eigen::Index(columns); ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++at) sum(i, j) += parts_[p][std::size_t(at)];
    cost += parts_[p][entries];
  }
  bool finite = std::isfinite(cost);
  for (GramMatrix& sum : gram) {
    for (Eigen::Index i = 0; i < sum.cols(); ++i)
      for (Eigen::Index j = 0; j < i; ++j) sum(j, i) = sum(i, j);
    finite = finite && sum.allFinite();
  }
  return finite;
}

std::vector<Eigen::Matrix3d> NormalEquations::linear_guess() {
  const FitProblem& problem = fit_->problem_;
  std::vector<std::array<double, 6>> parts(stretches_.size());
  each_stretch([&](std::size_t i) {
    const Stretch& stretch = stretches_[i];
    with_metric(problem.metric, [&]<Metric kMetric>() {
      add_guess<kMetric>(fit_->points_, columns_.value.data(), fit_->diffuse_[stretch.group], problem.floor_per_sr,
                         stretch.from, stretch.to, parts[i]);
    });
  });
  std::vector<Eigen::Matrix3d> sums(linear.size(), Eigen::Matrix3d::Zero());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Eigen::Matrix3d& sum = sums[fit_->block_of(fit_->points_.groups[stretches_[p].group])];
    for (Eigen::Index i = 0, at = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++at) sum(i, j) += parts[p][std::size_t(at)];
  }
  for (Eigen::Matrix3d& sum : sums) sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose().eval();
  return sums;
}

}  // namespace gonio
