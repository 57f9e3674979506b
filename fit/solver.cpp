#include "fit/solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
  std::vector<std::vector<Eigen::Index>> linear;  ///< of each block, 0 = kd, 1 = ks
};

struct Step {
  std::vector<double> roughness;
  std::vector<std::array<double, 2>> linear;
  double predicted = 0;  ///< decrease of the cost in the linear model
};

/// The damped Gauss-Newton step, the blocks of kd and ks eliminated one after the other. Small matrices of fixed room: nothing is allocated
/// a block, of which a spectrum has many.
Step damped_step(const std::vector<GramMatrix>& gram, const Active& active, double damping) {
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostColumns, kMostColumns>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostColumns, 1>;
  using Cross = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, kMostColumns, 2>;
  const Eigen::Index columns = gram[0].cols(), varied = columns - 3, residual = columns - 1;
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
    Eigen::Matrix2d square, inverse;
    Eigen::Vector2d gradient;
    Cross cross;
  };
  std::vector<Block> blocks(gram.size());
  for (std::size_t b = 0; b < gram.size(); ++b) {
    Block& block = blocks[b];
    block.square.setIdentity(), block.gradient.setZero(), block.cross.setZero(count, 2);
    for (const Eigen::Index j : active.linear[b]) {
      block.square(j, j) = gram[b](varied + j, varied + j);
      block.gradient[j] = gram[b](varied + j, residual);
      for (Eigen::Index i = 0; i < count; ++i) block.cross(i, j) = gram[b](place(i), varied + j);
    }
    if (active.linear[b].size() == 2) block.square(0, 1) = block.square(1, 0) = gram[b](varied, varied + 1);
    Eigen::Matrix2d damped = block.square;
    damped.diagonal() *= 1 + damping + 1e-14;
    // Scaled to a unit diagonal first, as kd and ks differ by decades.
    const Eigen::Vector2d scale = damped.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::Matrix2d unit = scale.asDiagonal() * damped * scale.asDiagonal();
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
    const Eigen::Vector2d linear = -(block.inverse * (block.gradient + block.cross.transpose() * change));
    step.linear.push_back({linear[0], linear[1]});
    step.predicted -= block.gradient.dot(linear) + 0.5 * linear.dot(block.square * linear);
    if (count > 0) step.predicted -= change.dot(block.cross * linear);
  }
  return step;
}

}  // namespace

LaneFit::LaneFit(const FitProblem& problem, std::span<const std::size_t> points)
    : problem_(problem), points_(problem, points) {
  std::size_t blocks = 1;
  for (const FreeParameter& p : problem.free)
    if (p.linear && p.group != FreeParameter::kShared) blocks = std::max(blocks, p.group + 1);
  linear_.assign(blocks, {kHeld, kHeld});
  const auto& parameters = problem.model.info().parameters;
  const auto diffuse = [&](std::size_t place) { return parameters[place].name == "kd" ? 0U : 1U; };
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].name == "kd" || parameters[i].name == "ks") held_[diffuse(i)] = problem.values[i];
  if (std::none_of(parameters.begin(), parameters.end(), [](auto& p) { return p.name == "ks"; })) held_[1] = 0;
  std::size_t index = kHeld;
  for (std::size_t i = 0; i < problem.free.size(); ++i) {
    const FreeParameter& p = problem.free[i];
    if (p.place == FreeParameter::kIndex) {
      index = i;
    } else if (!p.linear) {
      roughness_.push_back(i), varied_.push_back(p.place);
    } else if (p.group == FreeParameter::kShared) {
      for (auto& block : linear_) block[diffuse(p.place)] = i;
    } else {
      linear_[p.group][diffuse(p.place)] = i;
    }
  }
  if (index != kHeld) roughness_.push_back(index);

  const bool free_n = index != kHeld;
  if (!free_n) reflectance_ = facet_reflectances(points_, {problem.model, problem.values, varied_, {}});
  const bool by_r0 = make_brdf<double>(problem.model, problem.values).diffuse_times_r0();
  for (const LaneGroup& group : points_.groups) diffuse_.push_back((by_r0 ? group.surface.r0() : 1.0) / kPi<double>);
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
      for (std::size_t j = 0; j < 2; ++j)
        if (const std::size_t i = linear_[b][j]; i != kHeld)
          at.linear[b][j] = x[i] <= std::log(free[i].lo) ? 0 : std::min(std::exp(x[i]), free[i].hi);
  };
  place(here);
  if (!here.evaluate(true)) {
    ++solution.rejected;
    solution.x = std::move(x), solution.cost = std::numeric_limits<double>::infinity();
    return solution;
  }

  const auto residual_column = Eigen::Index(roughness_.size()) + 2;
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
      for (std::size_t j = 0; j < 2; ++j) {
        if (linear_[b][j] == kHeld) continue;
        const double gradient = at.gram[b](residual_column - 2 + Eigen::Index(j), residual_column);
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
    const Step step = damped_step(here.gram, active_at(here), damping);
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
      for (std::size_t j = 0; j < 2; ++j)
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
    for (std::size_t j = 0; j < 2; ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld) x[i] = std::log(std::max(here.linear[b][j], free[i].lo));
  solution.x = std::move(x), solution.cost = here.cost;
  return solution;
}

double LaneFit::eliminate(std::vector<double>& x) const {
  NormalEquations here(*this, false);
  const auto& free = problem_.free;
  for (const std::size_t i : roughness_) here.roughness.push_back(x[i]);
  bool finite = here.evaluate(true);
  const std::vector<Eigen::Matrix3d> guess = here.linear_guess();
  for (std::size_t b = 0; b < linear_.size(); ++b) {
    const bool kd = linear_[b][0] != kHeld, ks = linear_[b][1] != kHeld;
    const Eigen::Matrix3d& s = guess[b];
    const auto alone = [&](int j, double rest) { return s(j, j) > 0 ? std::max(0.0, rest / s(j, j)) : 0.0; };
    auto& [diffuse, lobe] = here.linear[b];
    if (kd && ks) {
      const double determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(0, 1);
      const bool apart = determinant > 1e-12 * s(0, 0) * s(1, 1);
      diffuse = apart ? (s(1, 1) * s(0, 2) - s(0, 1) * s(1, 2)) / determinant : -1;
      lobe = apart ? (s(0, 0) * s(1, 2) - s(0, 1) * s(0, 2)) / determinant : -1;
      if (!(diffuse >= 0 && lobe >= 0)) {
        const double only_kd = alone(0, s(0, 2)), only_ks = alone(1, s(1, 2));
        const bool better = only_kd * s(0, 2) >= only_ks * s(1, 2);
        diffuse = better ? only_kd : 0, lobe = better ? 0 : only_ks;
      }
    } else if (kd) {
      diffuse = alone(0, s(0, 2) - lobe * s(0, 1));
    } else if (ks) {
      lobe = alone(1, s(1, 2) - diffuse * s(0, 1));
    }
    for (std::size_t j = 0; j < 2; ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld)
        here.linear[b][j] = std::clamp(here.linear[b][j], free[i].lo, free[i].hi);
  }
  if (linear_.size() > 1 || linear_[0][0] != kHeld || linear_[0][1] != kHeld) {
    finite = here.evaluate(false);
    double damping = 1e-3;
    for (int step = 0; step < kMostLinearSteps && finite && damping < 1e6; ++step) {
      Active active;
      for (std::size_t b = 0; b < linear_.size(); ++b) {
        active.linear.emplace_back();
        for (std::size_t j = 0; j < 2; ++j)
          if (linear_[b][j] != kHeld) active.linear.back().push_back(Eigen::Index(j));
      }
      const Step change = damped_step(here.gram, active, damping);
      std::vector<std::array<double, 2>> before = here.linear;
      const double cost = here.cost;
      const auto grams = here.gram;
      for (std::size_t b = 0; b < linear_.size(); ++b)
        for (std::size_t j = 0; j < 2; ++j)
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
    for (std::size_t j = 0; j < 2; ++j)
      if (const std::size_t i = linear_[b][j]; i != kHeld) x[i] = std::log(std::max(here.linear[b][j], free[i].lo));
  return finite && std::isfinite(here.cost) ? here.cost : std::numeric_limits<double>::infinity();
}

Linearised LaneFit::linearise(const std::vector<double>& x) const {
  const auto& free = problem_.free;
  NormalEquations at(*this, true);
  for (const std::size_t i : roughness_) at.roughness.push_back(x[i]);
  for (std::size_t b = 0; b < linear_.size(); ++b)
    for (std::size_t j = 0; j < 2; ++j)
      if (linear_[b][j] != kHeld) at.linear[b][j] = std::exp(x[linear_[b][j]]);
  Linearised result;
  result.finite = at.evaluate(true);
  result.residual = Eigen::VectorXd::Zero(Eigen::Index(problem_.points.size()));
  result.jacobian = Eigen::MatrixXd::Zero(Eigen::Index(problem_.points.size()), Eigen::Index(free.size()));
  for (std::size_t g = 0; g < points_.groups.size(); ++g) {
    const LaneGroup& group = points_.groups[g];
    const auto& linear = linear_[block_of(group)];
    const double kd = at.linear[block_of(group)][0], ks = at.linear[block_of(group)][1];
    for_each_index(group.batches, [&](std::size_t i) {
      const std::size_t batch = group.first + i;
      for (std::size_t lane = 0; lane < LanePoints::kWidth; ++lane) {
        const std::size_t p = points_.point[batch * LanePoints::kWidth + lane];
        if (p == LanePoints::kNoPoint) continue;
        const FitPoint& point = problem_.points[p];
        const double s = at.columns().value[batch].get(lane), f = kd * diffuse_[g] + ks * s;
        const double by_f = problem_.compared_slope(f, point) * point.confidence;
        const auto row = Eigen::Index(p);
        result.residual[row] = (problem_.compared(f, point) - points_.compared[batch].get(lane)) * point.confidence;
        for (std::size_t j = 0; j < roughness_.size(); ++j)
          result.jacobian(row, Eigen::Index(roughness_[j])) = by_f * ks * at.columns().slope[j][batch].get(lane);
        if (linear[0] != kHeld) result.jacobian(row, Eigen::Index(linear[0])) = by_f * kd * diffuse_[g];
        if (linear[1] != kHeld) result.jacobian(row, Eigen::Index(linear[1])) = by_f * ks * s;
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
