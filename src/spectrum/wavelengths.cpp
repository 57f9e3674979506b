#include "spectrum/wavelengths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "spectrum/exchange.h"
#include "spectrum/node_descent.h"

namespace gonio {
namespace {

using Index = Eigen::Index;

constexpr double kCoarse_nm = 5;
constexpr std::size_t kFewCandidates = 30, kFollowed = 2;
/// Of a larger scene the search sees so many spectra, so many with one bounce more, and the worst of the rest.
constexpr std::size_t kWorkingSpectra = 300, kWorkingWatching = 300;
constexpr int kQuickRounds = 15, kRounds = 20, kSteps = 12, kKnocks = 150;

bool better(const NodeWeights& p, const NodeWeights& q) { return p.worst_e2000 < q.worst_e2000; }

/// Same numbers on every platform, which std::uniform_real_distribution does not promise.
double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// `count` wavelengths spread over where the eye sees, number 0 evenly, others at random, one in each stretch.
std::vector<double> spread(const SceneProducts& products, int count, int number, std::mt19937_64& random) {
  const double lo = std::max(products.lo_nm(), 405.0), hi = std::min(products.hi_nm(), 690.0);
  std::vector<double> nm;
  for (int i = 0; i < count; ++i) nm.push_back(lo + (hi - lo) * (i + (number == 0 ? 0.5 : unit(random))) / count);
  return nm;
}

std::vector<double> lit(const SceneProducts& products, const std::vector<double>& wanted) {
  std::vector<double> list;
  for (const double nm : wanted)
    if (nm >= products.lo_nm() && nm <= products.hi_nm() && products.is_lit(nm)) list.push_back(nm);
  return list;
}

/// Candidates of the exchange: every fifth nanometre; every one where few of those are lit (line lamps).
std::vector<double> candidates(const SceneProducts& products) {
  const auto grid = [&](double step) {
    std::vector<double> list;
    for (double nm = products.lo_nm(); nm <= products.hi_nm(); nm += step) list.push_back(nm);
    return lit(products, list);
  };
  const std::vector<double> coarse = grid(kCoarse_nm);
  return coarse.size() >= kFewCandidates ? coarse : grid(1);
}

Eigen::VectorXd equal_importance(const SceneProducts& products) {
  return Eigen::VectorXd::Constant(products.size(), 1.0 / static_cast<double>(products.size()));
}

/// Exchange once more among whole nanometres around the nodes, with the worst spectra weighing more.
NodeWeights refined(const SceneProducts& products, const NodeWeights& fit) {
  std::vector<double> near;
  for (const double nm : fit.nodes_nm)
    for (double d = -4; d <= 4; ++d) near.push_back(nm + d);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  const Exchange fine(products, lit(products, near), 0.5 * equal_importance(products) + 0.5 * fit.importance);
  const std::vector<double> nodes = fine.wavelengths(fine.improved(fine.nearest(fit.nodes_nm)));
  return std::min(fit, fit_weights(products, nodes, kQuickRounds, fit.importance), better);
}

NodeWeights quick_choice(const SceneProducts& products, const Exchange& exchange, int count,
                         const WavelengthSearch& search) {
  std::mt19937_64 random(search.seed);
  std::vector<NodeWeights> found;
  for (int start = 0; start < search.starts; ++start) {
    const Exchange::Nodes nodes = exchange.nearest(spread(products, count, start, random));
    const std::vector<double> nm = exchange.wavelengths(exchange.improved(nodes));
    if (std::any_of(found.begin(), found.end(), [&](const NodeWeights& f) { return f.nodes_nm == nm; })) continue;
    found.push_back(fit_weights(products, nm, kQuickRounds));
  }
  std::sort(found.begin(), found.end(), better);
  found.resize(std::min(found.size(), kFollowed));
  for (NodeWeights& f : found) f = descend_nodes(products, refined(products, f), kSteps, kQuickRounds);
  return *std::min_element(found.begin(), found.end(), better);
}

/// Knocks one to three nodes aside by up to 20 nm and descends again, many times over.
NodeWeights knocked(const SceneProducts& products, NodeWeights best, std::mt19937_64& random) {
  for (int knock = 0; knock < kKnocks; ++knock) {
    std::vector<double> nodes = best.nodes_nm;
    const int moved = 1 + static_cast<int>(3 * unit(random));
    for (int m = 0; m < moved; ++m) {
      const auto i = static_cast<std::size_t>(unit(random) * static_cast<double>(nodes.size()));
      nodes[i] += 40 * (unit(random) - 0.5);
    }
    std::sort(nodes.begin(), nodes.end());
    if (!nodes_allowed(products, nodes)) continue;
    NodeWeights trial = fit_weights(products, nodes, kQuickRounds, best.importance);
    if (trial.worst_e2000 > 3 * best.worst_e2000) continue;
    best = std::min(best, descend_nodes(products, std::move(trial), 20, kRounds), better);
  }
  return best;
}

/// Takes each node in turn and tries it at every third nanometre, the three best followed down, until a whole pass
/// gains less than 0.5 %.
NodeWeights thorough_choice(const SceneProducts& products, NodeWeights best, std::mt19937_64& random) {
  for (double last = 2 * best.worst_e2000; best.worst_e2000 < 0.995 * last;) {
    last = best.worst_e2000;
    for (std::size_t i = 0; i < best.nodes_nm.size(); ++i) {
      std::vector<NodeWeights> trials;
      for (double nm = products.lo_nm() + std::floor(3 * unit(random)); nm <= products.hi_nm(); nm += 3) {
        std::vector<double> nodes = best.nodes_nm;
        nodes[i] = nm;
        std::sort(nodes.begin(), nodes.end());
        if (nodes_allowed(products, nodes)) trials.push_back(fit_weights(products, nodes, 4, best.importance));
      }
      std::sort(trials.begin(), trials.end(), better);
      for (std::size_t t = 0; t < std::min<std::size_t>(trials.size(), 3); ++t)
        best = std::min(best, descend_nodes(products, trials[t], 20, kRounds), better);
    }
  }
  return best;
}

/// The spectra the search works on: all, or evenly many of each depth, with room for the worst of the rest.
class WorkingSet {
 public:
  explicit WorkingSet(const SceneProducts& all) : all_(all), taken_(static_cast<std::size_t>(all.size()), false) {
    std::vector<Index> asked, watching;
    for (Index i = 0; i < all.size(); ++i) (all.is_watching(i) ? watching : asked).push_back(i);
    take_evenly(asked, kWorkingSpectra);
    take_evenly(watching, kWorkingWatching);
  }

  bool is_all() const { return static_cast<Index>(rows_.size()) == all_.size(); }
  SceneProducts products() const { return is_all() ? all_ : all_.some(rows_); }

  /// Takes in the worst of the spectra left out; false when none of them is worse than those inside.
  bool widen(const NodeWeights& fit) {
    const Eigen::VectorXd error = node_differences(all_, fit);
    std::vector<std::pair<double, Index>> outside;
    for (Index i = 0; i < all_.size(); ++i)
      if (!taken_[static_cast<std::size_t>(i)] && error[i] > 0.9 * fit.worst_e2000) outside.emplace_back(error[i], i);
    std::sort(outside.begin(), outside.end(), std::greater<>());
    for (std::size_t k = 0; k < std::min<std::size_t>(outside.size(), 60); ++k) take(outside[k].second);
    return !outside.empty() && outside.front().first > fit.worst_e2000 * 1.002;
  }

 private:
  void take_evenly(const std::vector<Index>& list, std::size_t most) {
    const double step = std::max(1.0, static_cast<double>(list.size()) / static_cast<double>(most));
    for (double i = 0; i < static_cast<double>(list.size()); i += step) take(list[static_cast<std::size_t>(i)]);
  }

  void take(Index row) {
    taken_[static_cast<std::size_t>(row)] = true;
    rows_.push_back(row);
  }

  const SceneProducts& all_;
  std::vector<bool> taken_;
  std::vector<Index> rows_;
};

/// The nodes found on part of a scene, fitted to all of it: what was left out and turns out worst is taken in.
NodeWeights for_all(const SceneProducts& all, WorkingSet& set, NodeWeights fit) {
  if (set.is_all()) return fit;
  for (int round = 0; round < 6 && set.widen(fit); ++round) {
    const SceneProducts part = set.products();
    fit = descend_nodes(part, fit_weights(part, fit.nodes_nm, kRounds), kSteps, kRounds);
  }
  return fit_weights(all, fit.nodes_nm, 2 * kRounds);
}

void check_count(int count, std::size_t candidates) {
  if (count < 2 || count > 64 || static_cast<std::size_t>(count) > candidates)
    throw input_error("{} wavelengths; expected 2 to {}", count, std::min<std::size_t>(64, candidates));
}

}  // namespace

NodeWeights choose_wavelengths(const SceneProducts& products, int count, const WavelengthSearch& search) {
  WorkingSet set(products);
  const SceneProducts part = set.products();
  const Exchange exchange(part, candidates(part), equal_importance(part));
  check_count(count, exchange.candidates_nm().size());
  NodeWeights best = quick_choice(part, exchange, count, search);
  if (search.thorough_starts == 0) return for_all(products, set, best);

  std::vector<NodeWeights> found(static_cast<std::size_t>(search.thorough_starts), for_all(products, set, best));
  const SceneProducts wide = set.products();
  tbb::parallel_for(0, search.thorough_starts, [&](int start) {
    std::seed_seq seed{search.seed, static_cast<std::uint64_t>(start)};
    std::mt19937_64 random(seed);
    std::vector<double> nodes = best.nodes_nm;
    for (int attempt = 0; start > 0 && attempt < 1000; ++attempt)
      if (nodes_allowed(wide, nodes = spread(wide, count, start, random))) break;
    if (!nodes_allowed(wide, nodes)) nodes = best.nodes_nm;
    NodeWeights fit = descend_nodes(wide, fit_weights(wide, nodes, kRounds), 20, kRounds);
    fit = knocked(wide, thorough_choice(wide, std::move(fit), random), random);
    fit = thorough_choice(wide, std::move(fit), random);
    WorkingSet own = set;
    fit = polished(products, for_all(products, own, std::move(fit)));
    auto& slot = found[static_cast<std::size_t>(start)];
    slot = std::min(slot, fit, better);
  });
  return *std::min_element(found.begin(), found.end(), better);
}

NodeWeights fewest_wavelengths(const SceneProducts& products, double tolerance_e2000, int most,
                               const WavelengthSearch& search) {
  WorkingSet set(products);
  const SceneProducts part = set.products();
  const Exchange exchange(part, candidates(part), equal_importance(part));
  most = std::min<int>(most, static_cast<int>(exchange.candidates_nm().size()));
  check_count(most, exchange.candidates_nm().size());
  int too_few = 1, enough = most + 1;
  NodeWeights best;
  while (enough - too_few > 1) {
    // Small counts are cheap: upwards in steps until one holds, then halving.
    const int count =
        enough <= most ? (too_few + enough) / 2 : std::min(most, too_few == 1 ? 5 : too_few + too_few / 3 + 1);
    NodeWeights fit = for_all(products, set, quick_choice(part, exchange, count, search));
    const bool holds = fit.worst_e2000 <= tolerance_e2000;
    (holds ? enough : too_few) = count;
    if (holds || count == most) best = std::move(fit);
  }
  return best;
}

ColorWeights color_weights(const NodeWeights& nodes) {
  const auto column = [&](Index c) {
    return std::vector<double>(nodes.weight.col(c).begin(), nodes.weight.col(c).end());
  };
  return {nodes.nodes_nm, column(0), column(1), column(2)};
}

}  // namespace gonio
