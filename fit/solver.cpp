#include "fit/solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "fit/normal_equations.h"

namespace gonio {
namespace {

constexpr int kMostSteps = 200, kMostLinearSteps = 20;
constexpr double kLongestStep = 2;      // of a logarithm
constexpr double kSettledStep = 1e-15;  // of a logarithm, or of kd and ks as a share

/// Which of a place's numbers may move: not those at an end of their box that the cost pushes against.
struct Active {
  std::vector<Eigen::Index> roughness;
  std::vector<std::vector<Eigen::Index>> linear;  ///< of each block, 0 = kd, 1 … = ks of each lobe
};

struct Step {
  std::vector<double> roughness;
  std::vector<Linear> linear;
  double predicted = 0;  ///< decrease of the cost in the linear model
};

/// The damped Gauss-Newton step, the blocks of kd and ks (kLinear numbers each) eliminated one after the other. Small matrices of fixed
/// room: nothing is allocated a block, of which a spectrum has many.
template <int kLinear>
Step damped_step_of(const std::vector<GramMatrix>& gram, const Active& active, double damping) {
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostColumns, kMostColumns>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostColumns, 1>;
  using Cross = Eigen::Matrix<double, Eigen::Dynamic, kLinear, Eigen::ColMajor, kMostColumns, kLinear>;
  using Square = Eigen::Matrix<double, kLinear, kLinear>;
  using Few = Eigen::Matrix<double, kLinear, 1>;
  const Eigen::Index columns = gram[0].cols(), varied = columns - kLinear - 1, residual = columns - 1;
  const auto& moving = active.roughness;
  const auto count = Eigen::Index(moving.size());
  const auto place = [&](Eigen::Index i) { return moving[std::size_t(i)]; };

  Small undamped = Small::Zero(count, count);
  Column gradient = Column::Zero(count);
  for (const GramMatrix& block : gram)
    for (Eigen::Index i = 0; i < count; ++i) {
      gradient[i] += block(place(i), residual);
      for (Eigen::Index j = 0; j < count; ++j) undamped(i, j) += block(place(i), place(j));
    }
  Small normal = undamped;
  const double largest = count > 0 ? normal.diagonal().maxCoeff() : 0;
  for (Eigen::Index i = 0; i < count; ++i) normal(i, i) += damping * std::max({normal(i, i), 1e-18 * largest, 1e-300});
  Column right = -gradient;

  // A part of kd or ks that may not move has the equation 1·change = 0.
  struct Block {
    Square square, inverse;
    Few gradient;
    Cross cross;
  };
  std::vector<Block> blocks(gram.size());
  for (std::size_t b = 0; b < gram.size(); ++b) {
    Block& block = blocks[b];
    block.square.setIdentity(), block.gradient.setZero(), block.cross.setZero(count, kLinear);
    for (const Eigen::Index j : active.linear[b]) {
      for (const Eigen::Index k : active.linear[b]) block.square(j, k) = gram[b](varied + j, varied + k);
      block.gradient[j] = gram[b](varied + j, residual);
      for (Eigen::Index i = 0; i < count; ++i) block.cross(i, j) = gram[b](place(i), varied + j);
    }
    Square damped = block.square;
    damped.diagonal() *= 1 + damping + 1e-14;
    // Scaled to a unit diagonal first, as kd and ks differ by decades.
    const Few scale = damped.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Square unit = scale.asDiagonal() * damped * scale.asDiagonal();
    block.inverse = scale.asDiagonal() * unit.inverse() * scale.asDiagonal();
    if (count > 0) {
      normal -= block.cross * block.inverse * block.cross.transpose();
      right += block.cross * (block.inverse * block.gradient);
    }
  }

  Step step;
  Column change = Column::Zero(count);
  if (count > 0) change = normal.ldlt().solve(right);
  step.roughness.assign(std::size_t(varied), 0.0);
  for (Eigen::Index i = 0; i < count; ++i) step.roughness[std::size_t(place(i))] = change[i];
  if (count > 0) step.predicted -= gradient.dot(change) + 0.5 * change.dot(undamped * change);
  for (const Block& block : blocks) {
    const Few linear = -(block.inverse * (block.gradient + block.cross.transpose() * change));
    Linear& to = step.linear.emplace_back();
    for (int j = 0; j < kLinear; ++j) to[std::size_t(j)] = linear[j];
    step.predicted -= block.gradient.dot(linear) + 0.5 * linear.dot(block.square * linear);
    if (count > 0) step.predicted -= change.dot(block.cross * linear);
  }
  return step;
}

Step damped_step(std::size_t linear, const std::vector<GramMatrix>& gram, const Active& active, double damping) {
  if (linear == 2) return damped_step_of<2>(gram, active, damping);
  if (linear == 3) return damped_step_of<3>(gram, active, damping);
  return damped_step_of<4>(gram, active, damping);
}

using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostLinear, 1>;

/// Least squares of few columns, none negative: the best of all choices of columns that are not 0, the whole first. The last row and
/// column of the Gram matrix are the values to be met; columns not `free` keep what `linear` holds.
void solve_nonnegative(const LinearGram& gram, const std::vector<Eigen::Index>& free, Linear& linear) {
  const Eigen::Index last = gram.cols() - 1;
  const auto rest = [&](Eigen::Index j) {
    double value = gram(j, last);
    for (Eigen::Index k = 0; k < last; ++k)
      if (std::find(free.begin(), free.end(), k) == free.end()) value -= linear[std::size_t(k)] * gram(j, k);
    return value;
  };
  Few right(Eigen::Index(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) right[Eigen::Index(j)] = rest(free[j]);
  Linear best = linear;
  for (const Eigen::Index j : free) best[std::size_t(j)] = 0;
  const Linear none = best;
  double most = 0;
  for (unsigned chosen = (1U << free.size()) - 1; chosen > 0; --chosen) {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < free.size(); ++j)
      if (chosen & (1U << j)) columns.push_back(j);
    const auto size = Eigen::Index(columns.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostLinear, kMostLinear> unit(size, size);
    Few scale(size), b(size);
    for (Eigen::Index i = 0; i < size; ++i)
      scale[i] = 1 / std::sqrt(std::max(gram(free[columns[std::size_t(i)]], free[columns[std::size_t(i)]]), 1e-300));
    for (Eigen::Index i = 0; i < size; ++i) {
      b[i] = scale[i] * right[Eigen::Index(columns[std::size_t(i)])];
      for (Eigen::Index j = 0; j < size; ++j)
        unit(i, j) = scale[i] * scale[j] * gram(free[columns[std::size_t(i)]], free[columns[std::size_t(j)]]);
    }
    const auto factors = unit.ldlt();
    if (!(factors.vectorD().minCoeff() > 1e-12)) continue;  // columns that cannot be told apart
    const Few found = factors.solve(b);
    if (!(found.minCoeff() >= 0)) continue;
    const double won = found.dot(b);
    if (!(won > most)) continue;
    most = won, best = none;
    for (Eigen::Index i = 0; i < size; ++i) best[std::size_t(free[columns[std::size_t(i)]])] = scale[i] * found[i];
    if (columns.size() == free.size()) break;
  }
  linear = best;
}

}  // namespace

LaneFit::LaneFit(const FitProblem& problem, std::span<const std::size_t> points)
    : problem_(problem), points_(problem, points), lobes_(problem.model.lobes().size()) {
  find_places();
  open_aperture(points);
  bool by_r0 = false;
  for (std::size_t l = 0; l < lobes_.size(); ++l) {
    const std::vector<double> own = problem.model.values_of(l, problem.values);
    const ModelSpec& spec = problem.model.lobes()[l];
    if (l == 0) by_r0 = make_brdf<double>(spec, own).diffuse_times_r0();
    const bool free_n = lobes_[l].roughness.size() > lobes_[l].varied.size();
    const auto reflectances = [&](const LanePoints& at) {
      const LobeAt lobe{spec, own, lobes_[l].varied, {}, {}};
      lobes_[l].reflectance.push_back(free_n ? std::vector<DoubleLanes>() : facet_reflectances(at, lobe));
    };
    if (nodes_.empty()) reflectances(points_);
    for (const LanePoints& node : nodes_) reflectances(node);
  }
  for (const LaneGroup& group : points_.groups) diffuse_.push_back((by_r0 ? group.surface.r0() : 1.0) / kPi<double>);
}

void LaneFit::find_places() {
  const LobeSum& model = problem_.model;
  std::size_t blocks = 1;
  for (const FreeParameter& p : problem_.free)
    if (p.linear && p.group != FreeParameter::kShared) blocks = std::max(blocks, p.group + 1);
  linear_.assign(blocks, {});
  for (auto& block : linear_) block.fill(kHeld);
  // Which of kd, ks of each lobe.
  const auto column = [&](std::size_t place) { return model.is_diffuse(place) ? 0 : 1 + model.place(place).lobe; };
  for (std::size_t i = 0; i < model.parameters().size(); ++i)
    if (model.is_diffuse(i) || model.is_scale(i)) held_[column(i)] = problem_.values[i];
  std::size_t index = kHeld, absorption = kHeld;
  for (std::size_t i = 0; i < problem_.free.size(); ++i) {
    const FreeParameter& p = problem_.free[i];
    if (p.of_surface()) {
      (p.place == FreeParameter::kIndex ? index : absorption) = i;
    } else if (!p.linear) {
      const LobeSum::Place own = model.place(p.place);
      lobes_[own.lobe].varied.push_back(own.parameter), lobes_[own.lobe].roughness.push_back(roughness_.size());
      roughness_.push_back(i);
    } else if (p.group == FreeParameter::kShared) {
      for (auto& block : linear_) block[column(p.place)] = i;
    } else {
      linear_[p.group][column(p.place)] = i;
    }
  }
  for (const std::size_t i : {index, absorption}) {
    if (i == kHeld) continue;
    for (Lobe& lobe : lobes_) lobe.roughness.push_back(roughness_.size());
    roughness_.push_back(i);
  }
  if (roughness_.size() + linear_count() + 1 > kMostColumns)
    throw input_error("{}: {} shape parameters to fit at once; expected at most {}", model.name(), roughness_.size(),
                      kMostColumns - 1 - linear_count());
}

void LaneFit::open_aperture(std::span<const std::size_t> points) {
  for (const ApertureNode& node : problem_.aperture) nodes_.emplace_back(problem_, points, &node);
  for (std::size_t batch = 0; batch < points_.batches() && !nodes_.empty(); ++batch) {
    DoubleLanes sum(0.0);
    for (const LanePoints& node : nodes_) sum += node.share[batch];
    for (LanePoints& node : nodes_) node.share[batch] /= sum;
  }
}

Solution LaneFit::solve(std::vector<double> x, double tolerance) const {
  Solution solution;
  const auto& free = problem_.free;
  NormalEquations here(*this, true), there(*this, true);
  const auto place = [&](NormalEquations& at) {
    at.roughness.clear();
    for (const std::size_t i : roughness_)
      at.roughness.push_back(std::clamp(x[i], std::log(free[i].lo), std::log(free[i].hi)));
    for (std::size_t b = 0; b < linear_.size(); ++b)
      for (std::size_t j = 0; j < linear_count(); ++j)
        if (const std::size_t i = linear_[b][j]; i != kHeld)
          at.linear[b][j] = x[i] <= std::log(free[i].lo) ? 0 : std::min(std::exp(x[i]), free[i].hi);
  };
  place(here);
  if (!here.evaluate(true)) {
    ++solution.rejected;
    solution.x = std::move(x), solution.cost = std::numeric_limits<double>::infinity();
    return solution;
  }

  const auto residual_column = Eigen::Index(roughness_.size() + linear_count());
  const auto active_at = [&](const NormalEquations& at) {
    Active active;
    for (std::size_t i = 0; i < roughness_.size(); ++i) {
      double gradient = 0;
      for (const auto& block : at.gram) gradient += block(Eigen::Index(i), residual_column);
      const FreeParameter& box = free[roughness_[i]];
      const bool blocked = (at.roughness[i] <= std::log(box.lo) && gradient >= 0) ||
                           (at.roughness[i] >= std::log(box.hi) && gradient <= 0);
      if (!blocked) active.roughness.push_back(Eigen::Index(i));
    }
    for (std::size_t b = 0; b < linear_.size(); ++b) {
      active.linear.emplace_back();
      for (std::size_t j = 0; j < linear_count(); ++j) {
        if (linear_[b][j] == kHeld) continue;
        const double gradient = at.gram[b](Eigen::Index(roughness_.size() + j), residual_column);
        const bool blocked =
            (at.linear[b][j] <= 0 && gradient >= 0) || (at.linear[b][j] >= free[linear_[b][j]].hi && gradient <= 0);
        if (!blocked) active.linear.back().push_back(Eigen::Index(j));
      }
    }
    return active;
  };

  double damping = 1e-3, growth = 2;
  int small_steps = 0;
  while (solution.iterations < kMostSteps && !solution.converged) {
    ++solution.iterations;
    const Step step = damped_step(linear_count(), here.gram, active_at(here), damping);
    double longest = 0, share = 0;
    for (const double change : step.roughness) longest = std::max(longest, std::abs(change));
    const double shrink = longest > kLongestStep ? kLongestStep / longest : 1;
    there.roughness = here.roughness, there.linear = here.linear;
    for (std::size_t i = 0; i < roughness_.size(); ++i) {
      const FreeParameter& box = free[roughness_[i]];
      there.roughness[i] =
          std::clamp(here.roughness[i] + shrink * step.roughness[i], std::log(box.lo), std::log(box.hi));
    }
    for (std::size_t b = 0; b < linear_.size(); ++b)
      for (std::size_t j = 0; j < linear_count(); ++j)
        if (const std::size_t i = linear_[b][j]; i != kHeld) {
          there.linear[b][j] = std::clamp(here.linear[b][j] + shrink * step.linear[b][j], 0.0, free[i].hi);
          share = std::max(share,
                           std::abs(there.linear[b][j] - here.linear[b][j]) / std::max(here.linear[b][j], free[i].lo));
        }
    const bool still = longest <= kSettledStep && share <= kSettledStep;
    // Nothing left to win by the linear model, or a step below rounding: an end. A step that promises no gain comes from columns that
    // cannot be told apart, and is damped.
    if (still || (step.predicted >= 0 && step.predicted < 1e-16 * here.cost)) {
      solution.converged = true;
      break;
    }
    if (!(step.predicted > 0)) {
      damping *= growth, growth *= 2;
      if (damping > 1e20) break;
      continue;
    }
    const bool finite = there.evaluate(true);
    solution.rejected += !finite;
    if (!finite || !(there.cost < here.cost)) {
      if (finite && there.cost - here.cost <= 1e-13 * here.cost && step.predicted < 1e-11 * here.cost) {
        solution.converged = true;
        break;
      }
      damping *= growth, growth *= 2;
      if (damping > 1e20) break;
      continue;
    }
    const double won = here.cost - there.cost, ratio = won / (step.predicted * shrink * (2 - shrink));
    damping = std::max(damping * std::max(1.0 / 9, 1 - std::pow(2 * std::min(ratio, 1.0) - 1, 3)), 1e-12);
    growth = 2;
    std::swap(here, there);
    // Far from rounding a small gain must repeat, so that a short step of a damped solver is not taken for the end.
    small_steps = won <= tolerance * here.cost ? small_steps + 1 : 0;
    solution.converged = small_steps >= 2 || here.cost < 1e-30 * double(points_.count);
  }

  for (std::size_t i = 0; i < roughness_.size(); ++i) x[roughness_[i]] = here.roughness[i];
  for (std::size_t b = 0; b < linear_.size(); ++b)
    for (std::size_t j = 0; j < linear_count(); ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld) x[i] = std::log(std::max(here.linear[b][j], free[i].lo));
  solution.x = std::move(x), solution.cost = here.cost;
  return solution;
}

double LaneFit::eliminate(std::vector<double>& x) const {
  NormalEquations here(*this, false);
  const auto& free = problem_.free;
  for (const std::size_t i : roughness_) here.roughness.push_back(x[i]);
  bool finite = here.evaluate(true);
  const std::vector<LinearGram> guess = here.linear_guess();
  Active active;
  bool any = false;
  for (std::size_t b = 0; b < linear_.size(); ++b) {
    auto& moving = active.linear.emplace_back();
    for (std::size_t j = 0; j < linear_count(); ++j)
      if (linear_[b][j] != kHeld) moving.push_back(Eigen::Index(j)), any = true;
    solve_nonnegative(guess[b], moving, here.linear[b]);
    for (std::size_t j = 0; j < linear_count(); ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld)
        here.linear[b][j] = std::clamp(here.linear[b][j], free[i].lo, free[i].hi);
  }
  if (any) {
    finite = here.evaluate(false);
    double damping = 1e-3;
    for (int step = 0; step < kMostLinearSteps && finite && damping < 1e6; ++step) {
      const Step change = damped_step(linear_count(), here.gram, active, damping);
      const std::vector<Linear> before = here.linear;
      const double cost = here.cost;
      const auto grams = here.gram;
      for (std::size_t b = 0; b < linear_.size(); ++b)
        for (std::size_t j = 0; j < linear_count(); ++j)
          if (const std::size_t i = linear_[b][j]; i != kHeld) {
            // At most a factor 20 a step, as if in logarithms.
            const double now = before[b][j], next = now + change.linear[b][j];
            here.linear[b][j] = std::clamp(std::clamp(next, 0.05 * now, 20 * now), free[i].lo, free[i].hi);
          }
      if (!here.evaluate(false) || !(here.cost < cost)) {
        here.linear = before, here.gram = grams, here.cost = cost, damping *= 10;
        continue;
      }
      damping *= 0.1;
      if (cost - here.cost < 1e-4 * cost) break;
    }
  }
  for (std::size_t b = 0; b < linear_.size(); ++b)
    for (std::size_t j = 0; j < linear_count(); ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld) x[i] = std::log(std::max(here.linear[b][j], free[i].lo));
  return finite && std::isfinite(here.cost) ? here.cost : std::numeric_limits<double>::infinity();
}

Linearised LaneFit::linearise(const std::vector<double>& x) const {
  const auto& free = problem_.free;
  NormalEquations at(*this, true);
  for (const std::size_t i : roughness_) at.roughness.push_back(x[i]);
  for (std::size_t b = 0; b < linear_.size(); ++b)
    for (std::size_t j = 0; j < linear_count(); ++j)
      if (linear_[b][j] != kHeld) at.linear[b][j] = std::exp(x[linear_[b][j]]);
  Linearised result;
  result.finite = at.evaluate(true);
  result.residual = Eigen::VectorXd::Zero(Eigen::Index(problem_.points.size()));
  result.jacobian = Eigen::MatrixXd::Zero(Eigen::Index(problem_.points.size()), Eigen::Index(free.size()));
  for (std::size_t g = 0; g < points_.groups.size(); ++g) {
    const LaneGroup& group = points_.groups[g];
    const auto& places = linear_[block_of(group)];
    const Linear& linear = at.linear[block_of(group)];
    for_each_index(group.batches, [&](std::size_t i) {
      const std::size_t batch = group.first + i;
      for (std::size_t lane = 0; lane < LanePoints::kWidth; ++lane) {
        const std::size_t p = points_.point[batch * LanePoints::kWidth + lane];
        if (p == LanePoints::kNoPoint) continue;
        double f = linear[0] * diffuse_[g];
        for (std::size_t l = 0; l < lobes_.size(); ++l) f += linear[l + 1] * at.columns()[l].value[batch].get(lane);
        const FitPoint& point = problem_.points[p];
        const double by_f = problem_.compared_slope(f, point) * point.confidence;
        const auto row = Eigen::Index(p);
        result.residual[row] = (problem_.compared(f, point) - points_.compared[batch].get(lane)) * point.confidence;
        const auto add = [&](std::size_t place, double slope) {
          if (place != kHeld) result.jacobian(row, Eigen::Index(place)) += by_f * slope;
        };
        add(places[0], linear[0] * diffuse_[g]);
        for (std::size_t l = 0; l < lobes_.size(); ++l) {
          add(places[l + 1], linear[l + 1] * at.columns()[l].value[batch].get(lane));
          for (std::size_t j = 0; j < lobes_[l].roughness.size(); ++j)
            add(roughness_[lobes_[l].roughness[j]], linear[l + 1] * at.columns()[l].slope[j][batch].get(lane));
        }
      }
    });
  }
  result.finite = result.finite && result.residual.allFinite() && result.jacobian.allFinite();
  return result;
}

Solution solve(const FitProblem& problem, std::vector<double> x, double tolerance) {
  return LaneFit(problem, every_point(problem)).solve(std::move(x), tolerance);
}

Linearised linearise(const FitProblem& problem, const std::vector<double>& x) {
  return LaneFit(problem, every_point(problem)).linearise(x);
}

}  // namespace gonio
