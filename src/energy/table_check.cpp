#include "energy/table_check.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Core>
#include <atomic>
#include <random>

namespace gonio {
namespace {

constexpr Eigen::Index kTruthNodes = 64;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// R of every surface as Chebyshev coefficients in √cos_d, ready for moments of a measure.
Matrix coefficients(const EnergyTable& table, std::span<const Interface<double>> surfaces) {
  const Lobe<double> lobe = table.family().lobe(0.5);
  const auto points = [](Eigen::Index i) { return (static_cast<double>(i) + 0.5) * kPi<double> / kTruthNodes; };
  Matrix all(static_cast<Eigen::Index>(surfaces.size()), kTruthNodes);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    Eigen::ArrayXd r(kTruthNodes);
    for (Eigen::Index i = 0; i < kTruthNodes; ++i)
      r[i] = facet_reflectance<double>(lobe, square(0.5 * (std::cos(points(i)) + 1)), surfaces[s]);
    for (Eigen::Index j = 0; j < kTruthNodes; ++j) {
      double sum = 0;
      for (Eigen::Index i = 0; i < kTruthNodes; ++i) sum += r[i] * std::cos(static_cast<double>(j) * points(i));
      all(static_cast<Eigen::Index>(s), j) = sum * (j == 0 ? 1.0 : 2.0) / kTruthNodes;
    }
  }
  return all;
}

Eigen::VectorXd moments(const LobeMeasure& measure) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kTruthNodes);
  for (std::size_t p = 0; p < measure.cos_d.size(); ++p) {
    const double x = 2 * std::sqrt(measure.cos_d[p]) - 1, w = measure.weight[p];
    double before = 1, now = x;
    sum[0] += w;
    for (Eigen::Index j = 1; j < kTruthNodes; ++j) {
      sum[j] += w * now;
      const double next = 2 * x * now - before;
      before = now, now = next;
    }
  }
  return sum;
}

class Judge {
 public:
  Judge(const EnergyTable& table, std::span<const Interface<double>> surfaces)
      : table_(table),
        truth_(coefficients(table, surfaces)),
        nodes_(static_cast<Eigen::Index>(surfaces.size()), kCosNodes) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const NodeValues r = reflectance_at_nodes(table.family().lobe(0.5), surfaces[s]);
      for (std::size_t i = 0; i < kCosNodes; ++i)
        nodes_(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(i)) = r[i];
    }
  }

  TableError at(double cos_theta, double alpha) const {
    const double theta_deg = std::acos(std::max(cos_theta, 1e-6)) * 180 / kPi<double>;
    const NodeValues weights = table_.weights(cos_theta, alpha);
    const Eigen::Map<const Eigen::VectorXd> w(weights.data(), kCosNodes);
    const Eigen::VectorXd difference =
        nodes_ * w - truth_ * moments(lobe_measure(table_.family().lobe(alpha), theta_deg));
    Eigen::Index worst = 0;
    const double error = difference.cwiseAbs().maxCoeff(&worst);
    return {theta_deg, alpha, error, static_cast<std::size_t>(worst)};
  }

 private:
  const EnergyTable& table_;
  Matrix truth_, nodes_;
};

struct Place {
  double cos_theta, alpha;
};

std::vector<Place> dense_places(const EnergyGrid& grid, std::size_t times) {
  if (times == 0) return {};
  const EnergyGrid denser{(grid.rows - 1) * times + 1, (grid.columns - 1) * times + 1, grid.widest};
  std::vector<Place> places;
  for (std::size_t r = 0; r < denser.rows; ++r)
    for (std::size_t c = 0; c < denser.columns; ++c) places.push_back({denser.cos_theta(c), denser.alpha(r)});
  return places;
}

std::vector<Place> random_places(const EnergyGrid& grid, std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  std::vector<Place> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = uniform(random),
                 alpha = kNarrowestAlpha * std::pow(grid.widest / kNarrowestAlpha, uniform(random));
    places.push_back({i % 3 == 0 ? std::cos(u * kPi<double> / 2) : i % 3 == 1 ? u : std::pow(10, -5 * u), alpha});
  }
  return places;
}

TableError worst_of(const Judge& judge, const std::vector<Place>& places, const std::function<void()>& one_done) {
  if (places.empty()) return {};
  std::vector<TableError> all(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t p) {
    all[p] = judge.at(places[p].cos_theta, places[p].alpha);
    one_done();
  });
  return *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
}

}  // namespace

TableCheck check_table(const EnergyTable& table, std::span<const Interface<double>> surfaces, std::size_t times_denser,
                       std::size_t random_count, const std::function<void(double)>& done) {
  const Judge judge(table, surfaces);
  const std::vector<Place> dense = dense_places(table.grid(), times_denser),
                           random = random_places(table.grid(), random_count);
  std::atomic<std::size_t> count{0};
  const std::size_t all = dense.size() + random.size();
  const auto one_done = [&] {
    if (const std::size_t now = ++count; done && now % 1000 == 0)
      done(static_cast<double>(now) / static_cast<double>(all));
  };
  return {worst_of(judge, dense, one_done), worst_of(judge, random, one_done)};
}

}  // namespace gonio
