#include "spectrum/scene_products.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kMostSpectra = 200000, kMostWatching = 6000;
constexpr double kLeastLight = 1e-4;  ///< of a light's largest value: below it a weight would have to be huge

Xyz<double> row_of(const Eigen::MatrixXd& m, Index row) { return {m(row, 0), m(row, 1), m(row, 2)}; }

}  // namespace

SceneProducts::SceneProducts(const SpectralScene& scene, int bounces) : bounces_(bounces) {
  if (scene.reflectances.empty() || scene.lights.empty() || bounces < 1)
    throw input_error("{} reflectances, {} lights, {} bounces; expected at least one of each",
                      scene.reflectances.size(), scene.lights.size(), bounces);
  lo_nm_ = scene.observer.lo_nm(), hi_nm_ = scene.observer.hi_nm();
  for (const Factor& factor : scene.reflectances)
    lo_nm_ = std::max(lo_nm_, factor.lo_nm), hi_nm_ = std::min(hi_nm_, factor.hi_nm);
  for (const Spectrum& light : scene.lights)
    lo_nm_ = std::max(lo_nm_, light.lo_nm()), hi_nm_ = std::min(hi_nm_, light.hi_nm());
  lo_nm_ = std::ceil(lo_nm_), hi_nm_ = std::floor(hi_nm_);
  const Factor white{lo_nm_, hi_nm_, [](double) { return 1.0; }, "the scene"};
  for (const Spectrum& light : scene.lights) color_of(white, light, scene.observer);  // refuses what is left out

  const Index rows = static_cast<Index>(hi_nm_ - lo_nm_) + 1, count = static_cast<Index>(scene.reflectances.size());
  base_.resize(rows, count);
  light_.resize(rows, static_cast<Index>(scene.lights.size()));
  for (Index i = 0; i < rows; ++i) {
    const double nm = lo_nm_ + static_cast<double>(i);
    for (Index r = 0; r < count; ++r) base_(i, r) = scene.reflectances[static_cast<std::size_t>(r)].at(nm);
    for (Index l = 0; l < light_.cols(); ++l) light_(i, l) = scene.lights[static_cast<std::size_t>(l)].at(nm);
  }
  for (Index l = 0; l < light_.cols(); ++l) light_.col(l) /= light_.col(l).maxCoeff();

  list_products(static_cast<int>(count));
  sum_targets(scene.observer);
  measure_metric();
}

void SceneProducts::list_products(int reflectances) {
  const auto extend = [&](int parent, int first) {
    for (int r = first; r < reflectances; ++r) parent_.push_back(parent), factor_.push_back(r);
  };
  extend(-1, 0);
  std::size_t first = 0;
  for (int depth = 2; depth <= bounces_; ++depth) {
    const std::size_t last = parent_.size();
    for (std::size_t p = first; p < last; ++p) extend(static_cast<int>(p), factor_[p]);
    first = last;
    if (parent_.size() * static_cast<std::size_t>(light_.cols()) > kMostSpectra)
      throw input_error("{} reflectances to {} bounces give over {} spectra; expected fewer", reflectances, bounces_,
                        kMostSpectra);
  }
  const std::size_t last = parent_.size();
  watching_ = static_cast<Index>(last);
  std::size_t deeper = 0;
  for (std::size_t p = first; p < last; ++p) deeper += static_cast<std::size_t>(reflectances - factor_[p]);
  const std::size_t every = deeper / kMostWatching + 1;
  std::size_t number = 0;
  for (std::size_t p = first; p < last; ++p)
    for (int r = factor_[p]; r < reflectances; ++r)
      if (number++ % every == 0) parent_.push_back(static_cast<int>(p)), factor_.push_back(r);
  products_ = static_cast<Index>(parent_.size());
  for (Index i = 0; i < products_ * light_.cols(); ++i) rows_.push_back(i);
}

SceneProducts SceneProducts::some(const std::vector<Index>& rows) const {
  SceneProducts part = *this;
  part.rows_.clear(), part.lab_.clear();
  for (const Index i : rows) {
    part.rows_.push_back(rows_[static_cast<std::size_t>(i)]);
    part.lab_.push_back(lab_[static_cast<std::size_t>(i)]);
  }
  part.target_ = target_(rows, Eigen::all);
  part.metric_ = metric_(rows, Eigen::all);
  return part;
}

Eigen::VectorXd SceneProducts::radiance(double nm) const {
  if (size() == products_ * light_.cols()) return every_radiance(nm);
  return every_radiance(nm)(rows_);
}

Eigen::VectorXd SceneProducts::every_radiance(double nm) const {
  const Index row = std::clamp<Index>(static_cast<Index>(nm - lo_nm_), 0, base_.rows() - 2);
  const double t = nm - lo_nm_ - static_cast<double>(row);
  const Eigen::RowVectorXd reflectance = (1 - t) * base_.row(row) + t * base_.row(row + 1);
  const Eigen::VectorXd power = white_radiance(nm);
  Eigen::VectorXd values(products_ * light_.cols());
  for (Index p = 0; p < products_; ++p) {
    const auto i = static_cast<std::size_t>(p);
    values[p] = reflectance[factor_[i]] * (parent_[i] < 0 ? 1.0 : values[parent_[i]]);
  }
  for (Index l = light_.cols(); l-- > 0;) values.segment(l * products_, products_) = power[l] * values.head(products_);
  return values;
}

Eigen::VectorXd SceneProducts::white_radiance(double nm) const {
  const Index row = std::clamp<Index>(static_cast<Index>(nm - lo_nm_), 0, base_.rows() - 2);
  const double t = nm - lo_nm_ - static_cast<double>(row);
  return (1 - t) * light_.row(row) + t * light_.row(row + 1);
}

bool SceneProducts::is_lit(double nm) const { return white_radiance(nm).maxCoeff() >= kLeastLight; }

void SceneProducts::sum_targets(const Observer& observer) {
  double luminous = 0;
  target_ = Eigen::MatrixXd::Zero(size(), 3);
  whites_ = Eigen::MatrixXd::Zero(light_.cols(), 3);
  for (double nm = lo_nm_; nm <= hi_nm_; ++nm) {
    const Xyz<double> eye = observer.at(nm);
    const Eigen::RowVector3d columns(eye.x, eye.y, eye.z);
    luminous += eye.y;
    target_.noalias() += radiance(nm) * columns;
    whites_.noalias() += white_radiance(nm) * columns;
  }
  target_ /= luminous;
  whites_ /= luminous;
}

void SceneProducts::measure_metric() {
  metric_.resize(size(), 6);
  lab_.resize(static_cast<std::size_t>(size()));
  const double step = 1e-3;  // in L*, a*, b*: far above rounding, far below where the form bends
  for (Index i = 0; i < size(); ++i) {
    const Xyz<double> white = row_of(whites_, light_of(i)), xyz = row_of(target_, i);
    const Lab<double> at = lab_[static_cast<std::size_t>(i)] = lab(xyz, white);
    const auto form = [&](double l, double a, double b) {
      return square(delta_e_2000(at, Lab<double>{at.l + l * step, at.a + a * step, at.b + b * step}) / step);
    };
    const double ll = form(1, 0, 0), aa = form(0, 1, 0), bb = form(0, 0, 1);
    Eigen::Matrix3d m;
    m << ll, (form(1, 1, 0) - ll - aa) / 2, (form(1, 0, 1) - ll - bb) / 2,  //
        0, aa, (form(0, 1, 1) - aa - bb) / 2,                               //
        0, 0, bb;
    m.triangularView<Eigen::StrictlyLower>() = m.transpose();
    const auto slope = [](double t) { return t > 216.0 / 24389 ? 1 / (3 * square(std::cbrt(t))) : 841.0 / 108; };
    const double sx = slope(xyz.x / white.x) / white.x, sy = slope(xyz.y / white.y) / white.y,
                 sz = slope(xyz.z / white.z) / white.z;
    Eigen::Matrix3d jacobian;
    jacobian << 0, 116 * sy, 0, 500 * sx, -500 * sy, 0, 0, 200 * sy, -200 * sz;
    m = jacobian.transpose() * m * jacobian;
    metric_.row(i) << m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2);
    metric_.row(i) *= square(share_of(i));
  }
}

Eigen::VectorXd SceneProducts::differences(const Eigen::MatrixXd& xyz) const { return differences(xyz, whites_); }

Eigen::VectorXd SceneProducts::differences(const Eigen::MatrixXd& xyz, const Eigen::MatrixXd& whites) const {
  Eigen::VectorXd result(size());
  for (Index i = 0; i < size(); ++i)
    result[i] =
        share_of(i) * delta_e_2000(lab_[static_cast<std::size_t>(i)], lab(row_of(xyz, i), row_of(whites, light_of(i))));
  return result;
}

}  // namespace gonio
