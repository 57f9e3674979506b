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
using Block = NormalEquations::Block;
using Triangle = NormalEquations::Triangle;
constexpr std::size_t kLinearEntries = (kMostLinear + 1) * (kMostLinear + 2) / 2;
using LinearTriangle = std::array<double, kLinearEntries>;
using LinearLanes = std::array<DoubleLanes, kLinearEntries>;

/// What one block of batches adds: the triangle of the Gram matrix row by row, the cost last. kColumns 0: as many as the block says; one lobe
/// has its loop without choices.
template <Metric kMetric, Loss kLoss, std::size_t kColumns, bool kOneLobe>
GONIO_ONE_LOOP void add_block(const Block& block, Triangle& sums) {
  const LanePoints& points = *block.points;
  const std::size_t lobes = kOneLobe ? 1 : block.lobes;
  const std::size_t columns = kColumns > 0 ? kColumns : block.columns, varied = columns - lobes - 2;
  const std::size_t entries = columns * (columns + 1) / 2;
  constexpr std::size_t kRoom = kColumns > 0 ? kColumns : kMost;
  std::array<DoubleLanes, kRoom*(kRoom + 1) / 2> sum;
  std::fill_n(sum.begin(), entries, DoubleLanes(0.0));
  DoubleLanes cost(0.0);
  const auto value = block.value;
  const auto& slope = block.slope;
  const DoubleLanes constant(block.linear[0] * block.diffuse), scale(block.linear[1]), floor(block.floor_per_sr),
      d(block.diffuse);
  const double loss_width = block.loss_width;
  for (std::size_t batch = block.from; batch < block.to; ++batch) {
    DoubleLanes f = multiply_add(scale, value[0][batch], constant);
    if constexpr (!kOneLobe)
      for (std::size_t l = 1; l < lobes; ++l) f = multiply_add(DoubleLanes(block.linear[l + 1]), value[l][batch], f);
    const Compared<DoubleLanes> at = compared_at<kMetric>(f, points.weight[batch], floor);
    const DoubleLanes r = (at.value - points.compared[batch]) * points.confidence[batch];
    const Robust robust = robust_in_lanes<kLoss>(r, loss_width);
    cost += robust.cost;
    const DoubleLanes by_f = at.slope * points.confidence[batch];
    std::array<DoubleLanes, kRoom> column;
    for (std::size_t j = 0; j < varied; ++j) {
      if constexpr (kOneLobe) {
        column[j] = by_f * scale * slope[0][j][batch];
      } else {  // n is every lobe's
        DoubleLanes all(0.0);
        for (std::size_t l = 0; l < lobes; ++l)
          if (slope[l][j] != nullptr) all = multiply_add(DoubleLanes(block.linear[l + 1]), slope[l][j][batch], all);
        column[j] = by_f * all;
      }
    }
    column[varied] = by_f * d;
    for (std::size_t l = 0; l < lobes; ++l) column[varied + 1 + l] = by_f * value[l][batch];
    column[varied + 1 + lobes] = r;
    for (std::size_t i = 0, at_sum = 0; i < columns; ++i) {
      const DoubleLanes weighted = kLoss == Loss::none ? column[i] : column[i] * robust.weight;
      for (std::size_t j = 0; j <= i; ++j, ++at_sum) sum[at_sum] = multiply_add(weighted, column[j], sum[at_sum]);
    }
  }
  for (std::size_t i = 0; i < entries; ++i) sums[i] = xsimd::hadd(sum[i]);
  sums[entries] = xsimd::hadd(cost);
}

template <Metric kMetric, Loss kLoss>
void add_columns(const Block& block, Triangle& sums) {
  const auto run = [&]<std::size_t kColumns, bool kOneLobe>() {
    add_block<kMetric, kLoss, kColumns, kOneLobe>(block, sums);
  };
  if (block.lobes > 1) return run.template operator()<0, false>();
  switch (block.columns) {
    case 3:
      return run.template operator()<3, true>();
    case 4:
      return run.template operator()<4, true>();
    case 5:
      return run.template operator()<5, true>();
    default:
      return run.template operator()<0, true>();
  }
}

template <Metric kMetric>
void add_loss(Loss loss, const Block& block, Triangle& sums) {
  if (loss == Loss::none) return add_columns<kMetric, Loss::none>(block, sums);
  if (loss == Loss::huber) return add_columns<kMetric, Loss::huber>(block, sums);
  add_columns<kMetric, Loss::cauchy>(block, sums);
}

/// The same of the linear problem near the data.
template <Metric kMetric>
GONIO_ONE_LOOP void add_guess(const Block& block, LinearTriangle& sums) {
  const LanePoints& points = *block.points;
  const std::size_t columns = block.lobes + 2;
  LinearLanes sum;
  sum.fill(DoubleLanes(0.0));
  const DoubleLanes floor(block.floor_per_sr), d(block.diffuse);
  for (std::size_t batch = block.from; batch < block.to; ++batch) {
    const DoubleLanes y = points.measured[batch];
    const DoubleLanes positive = larger_of(DoubleLanes(xsimd::abs(y)), DoubleLanes(1e-12));
    const DoubleLanes by_f =
        compared_at<kMetric>(positive, points.weight[batch], floor).slope * points.confidence[batch];
    std::array<DoubleLanes, kMostLinear + 1> column;
    column[0] = by_f * d;
    for (std::size_t l = 0; l < block.lobes; ++l) column[l + 1] = by_f * block.value[l][batch];
    column[block.lobes + 1] = by_f * y;
    for (std::size_t i = 0, at = 0; i < columns; ++i)
      for (std::size_t j = 0; j <= i; ++j, ++at) sum[at] = multiply_add(column[i], column[j], sum[at]);
  }
  for (std::size_t i = 0; i < columns * (columns + 1) / 2; ++i) sums[i] = xsimd::hadd(sum[i]);
}

}  // namespace

NormalEquations::NormalEquations(const LaneFit& fit, bool with_roughness)
    : linear(fit.linear_.size(), fit.held_),
      fit_(&fit),
      varied_(with_roughness ? fit.roughness_.size() : 0),
      columns_(fit.lobes_.size()) {
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

/// The mean over the aperture in place of the centre.
void NormalEquations::average(std::size_t lobe, const LobeAt& at) {
  LobeColumns& mean = columns_[lobe];
  for (std::size_t q = 0; q < fit_->nodes_.size(); ++q) {
    const LanePoints& points = fit_->nodes_[q];
    LobeColumns& here = q == 0 ? mean : node_;
    evaluate_lobe(points, at, fit_->lobes_[lobe].reflectance[q], varied_ > 0, here);
    const auto add = [&](std::vector<DoubleLanes>& to, const std::vector<DoubleLanes>& from) {
      for (std::size_t b = 0; b < to.size(); ++b)
        to[b] = q == 0 ? points.share[b] * from[b] : multiply_add(points.share[b], from[b], to[b]);
    };
    add(mean.value, here.value);
    for (std::size_t j = 0; j < mean.slope.size(); ++j) add(mean.slope[j], here.slope[j]);
  }
}

void NormalEquations::evaluate_lobes() {
  const FitProblem& problem = fit_->problem_;
  std::vector<double> values = problem.values;
  std::optional<double> n, k;
  for (std::size_t i = 0; i < fit_->roughness_.size(); ++i) {
    const std::size_t place = problem.free[fit_->roughness_[i]].place;
    double& to = place == FreeParameter::kIndex        ? n.emplace()
                 : place == FreeParameter::kAbsorption ? k.emplace()
                                                       : values[place];
    to = std::exp(roughness[i]);
  }
  for (std::size_t l = 0; l < columns_.size(); ++l) {
    const LaneFit::Lobe& lobe = fit_->lobes_[l];
    const std::vector<double> own = problem.model.values_of(l, values);
    const LobeAt at{problem.model.lobes()[l], own, lobe.varied, n, k};
    if (fit_->nodes_.empty())
      evaluate_lobe(fit_->points_, at, lobe.reflectance[0], varied_ > 0, columns_[l]);
    else
      average(l, at);
  }
}

NormalEquations::Block NormalEquations::block_of(const Stretch& stretch) const {
  Block block{&fit_->points_, columns_.size(), varied_ + columns_.size() + 2};
  for (std::size_t l = 0; l < columns_.size(); ++l) {
    block.value[l] = columns_[l].value.data();
    for (std::size_t j = 0; j < columns_[l].slope.size(); ++j)
      block.slope[l][fit_->lobes_[l].roughness[j]] = columns_[l].slope[j].data();
  }
  block.linear = linear[fit_->block_of(fit_->points_.groups[stretch.group])];
  block.diffuse = fit_->diffuse_[stretch.group];
  block.floor_per_sr = fit_->problem_.floor_per_sr, block.loss_width = fit_->problem_.loss_width;
  block.from = stretch.from, block.to = stretch.to;
  return block;
}

bool NormalEquations::evaluate(bool new_roughness) {
  if (new_roughness) evaluate_lobes();
  const FitProblem& problem = fit_->problem_;
  const std::size_t columns = varied_ + columns_.size() + 2, entries = columns * (columns + 1) / 2;
  parts_.resize(stretches_.size());
  each_stretch([&](std::size_t i) {
    const Block block = block_of(stretches_[i]);
    with_metric(problem.metric, [&]<Metric kMetric>() { add_loss<kMetric>(problem.loss, block, parts_[i]); });
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

std::vector<LinearGram> NormalEquations::linear_guess() {
  const FitProblem& problem = fit_->problem_;
  std::vector<LinearTriangle> parts(stretches_.size());
  each_stretch([&](std::size_t i) {
    const Block block = block_of(stretches_[i]);
    with_metric(problem.metric, [&]<Metric kMetric>() { add_guess<kMetric>(block, parts[i]); });
  });
  const auto size = Eigen::Index(columns_.size() + 2);
  std::vector<LinearGram> sums(linear.size(), LinearGram::Zero(size, size));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    LinearGram& sum = sums[fit_->block_of(fit_->points_.groups[stretches_[p].group])];
    for (Eigen::Index i = 0, at = 0; i < size; ++i)
      for (Eigen::Index j = 0; j <= i; ++j, ++at) sum(i, j) += parts[p][std::size_t(at)];
  }
  for (LinearGram& sum : sums)
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < i; ++j) sum(j, i) = sum(i, j);
  return sums;
}

}  // namespace gonio
