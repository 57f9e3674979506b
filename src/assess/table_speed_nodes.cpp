// How many fixed cosines R needs.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "assess/table_speed.h"

namespace gonio {
namespace {

/// R at `nodes` Chebyshev points of √cos_d, and its polynomial at places between them, as energy/cos_nodes.h has it for twenty.
class NodeRule {
 public:
  explicit NodeRule(std::size_t nodes) : between_(4 * nodes + 1, nodes) {
    const auto angle = [&](std::size_t i) {
      return (static_cast<double>(i) + 0.5) * kPi<double> / static_cast<double>(nodes);
    };
    for (std::size_t i = 0; i < nodes; ++i) at_.push_back(square(0.5 * (std::cos(angle(i)) + 1)));
    for (Eigen::Index p = 0; p < between_.rows(); ++p) {
      const double place = static_cast<double>(p) * kPi<double> / static_cast<double>(between_.rows() - 1);
      checked_.push_back(square(0.5 * (std::cos(place) + 1)));
      for (std::size_t i = 0; i < nodes; ++i) {
        double sum = 0.5;
        for (std::size_t j = 1; j < nodes; ++j)
          sum += std::cos(static_cast<double>(j) * place) * std::cos(static_cast<double>(j) * angle(i));
        between_(p, static_cast<Eigen::Index>(i)) = 2 * sum / static_cast<double>(nodes);
      }
    }
  }

  double error(const Interface<double>& surface) const {
    return (between_ * r(surface, at_) - r(surface, checked_)).cwiseAbs().maxCoeff();
  }

 private:
  static Eigen::VectorXd r(const Interface<double>& surface, const std::vector<double>& cos_d) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(cos_d.size()));
    for (std::size_t i = 0; i < cos_d.size(); ++i) values[static_cast<Eigen::Index>(i)] = surface.reflectance(cos_d[i]);
    return values;
  }
  std::vector<double> at_, checked_;
  Eigen::MatrixXd between_;
};

}  // namespace

NodeCountRow node_count_row(std::size_t nodes, std::span<const Interface<double>> surfaces) {
  const NodeRule rule(nodes);
  std::vector<double> errors;
  for (const Interface<double>& one : surfaces) errors.push_back(rule.error(one));
  std::sort(errors.begin(), errors.end());
  const auto beyond = errors.end() - std::upper_bound(errors.begin(), errors.end(), kMostNodeError);
  const EnergyGrid grid;
  NodeCountRow row{nodes, errors.size(), static_cast<std::size_t>(beyond)};
  row.kib =
      static_cast<double>(grid.rows * grid.columns * (nodes + 1) * sizeof(float)) / 1024;  // and the cell's own error
  if (!errors.empty())
    row.largest = errors.back(), row.median = errors[errors.size() / 2], row.p99 = errors[errors.size() * 99 / 100];
  return row;
}

}  // namespace gonio
