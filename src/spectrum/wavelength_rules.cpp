#include "spectrum/wavelength_rules.h"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

using Index = Eigen::Index;

struct Node {
  double nm, weight;  ///< of ∫ dλ
};

std::vector<Node> uniform(double lo, double hi, int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back({lo + (hi - lo) * (i + 0.5) / count, (hi - lo) / count});
  return nodes;
}

std::vector<Node> gauss_legendre(double lo, double hi, int count) {
  std::vector<Node> nodes;
  for (const double root : boost::math::legendre_p_zeros<double>(count)) {  // the non-negative ones
    const double slope = boost::math::legendre_p_prime(count, root), weight = 2 / ((1 - root * root) * slope * slope);
    const auto add = [&](double x) { nodes.push_back({(lo + hi) / 2 + (hi - lo) / 2 * x, (hi - lo) / 2 * weight}); };
    add(root);
    if (root > 0) add(-root);
  }
  std::sort(nodes.begin(), nodes.end(), [](const Node& p, const Node& q) { return p.nm < q.nm; });
  return nodes;
}

double seen(const Observer& observer, double nm) {
  const Xyz<double> eye = observer.at(nm);
  return eye.x + eye.y + eye.z;
}

std::vector<Node> observer_shares(double lo, double hi, int count, const Observer& observer) {
  std::vector<double> until{0};  // ∫ to lo + i nm, by trapezia
  for (double nm = lo; nm < hi; ++nm) until.push_back(until.back() + (seen(observer, nm) + seen(observer, nm + 1)) / 2);
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    const double wanted = until.back() * (i + 0.5) / count;
    const auto above = std::upper_bound(until.begin(), until.end(), wanted);
    const double below = *(above - 1), t = (wanted - below) / (*above - below);
    const double nm = lo + static_cast<double>(above - until.begin() - 1) + t;
    nodes.push_back({nm, until.back() / count / seen(observer, nm)});
  }
  return nodes;
}

}  // namespace

NodeWeights rule_weights(const SceneProducts& products, const Observer& observer, WavelengthRule rule, int count) {
  if (count < 1) throw input_error("{} wavelengths; expected at least 1", count);
  const double lo = products.lo_nm(), hi = products.hi_nm();
  const std::vector<Node> nodes = rule == WavelengthRule::uniform          ? uniform(lo, hi, count)
                                  : rule == WavelengthRule::gauss_legendre ? gauss_legendre(lo, hi, count)
                                                                           : observer_shares(lo, hi, count, observer);
  double luminous = 0;
  for (double nm = lo; nm <= hi; ++nm) luminous += observer.at(nm).y;
  NodeWeights result;
  result.weight.resize(count, 3);
  Eigen::MatrixXd xyz = Eigen::MatrixXd::Zero(products.size(), 3),
                  whites = Eigen::MatrixXd::Zero(products.whites().rows(), 3);
  for (int i = 0; i < count; ++i) {
    const Node& node = nodes[static_cast<std::size_t>(i)];
    const Xyz<double> eye = observer.at(node.nm);
    result.nodes_nm.push_back(node.nm);
    result.weight.row(i) = Eigen::RowVector3d(eye.x, eye.y, eye.z) * (node.weight / luminous);
    xyz += products.radiance(node.nm) * result.weight.row(i);
    whites += products.white_radiance(node.nm) * result.weight.row(i);
  }
  // A quadrature that meets no light has no white: its colours are as wrong as black is.
  result.worst_e2000 =
      whites.minCoeff() > 0 ? products.differences(xyz, whites).maxCoeff() : products.differences(0 * xyz).maxCoeff();
  return result;
}

}  // namespace gonio
