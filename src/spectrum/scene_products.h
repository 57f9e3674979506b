#pragma once
#include <Eigen/Core>
#include <vector>

#include "spectrum/colorimetry.h"

namespace gonio {

/// A scene as its colours see it: what light meets between a lamp and the eye.
struct SpectralScene {
  std::vector<Factor> reflectances;
  std::vector<Spectrum> lights;
  Observer observer;
};

/// Spectra after one bounce more than asked for count with their error divided by this: few spectra can be matched
/// exactly by weights that are wrong for everything else, and are not when those watch.
inline constexpr double kOneBounceMore = 2;

/// Every spectrum that can reach the eye: each light times every product of 1 to `bounces` reflectances of the scene
/// (in any order, repeats allowed), C(N + bounces, bounces) - 1 products a light, and those after one bounce more
/// (evenly chosen, where they are over 6,000), with their colours summed at 1 nm by the rule of colorimetry.h over the
/// range common to all the data. Colours are scaled as ColorWeights are: Y = 1 for radiance 1 everywhere.
class SceneProducts {
 public:
  /// InputError as color_of: no common range, no light, more than kMostLeftOut left out; or more than 200,000 spectra.
  SceneProducts(const SpectralScene& scene, int bounces);

  double lo_nm() const { return lo_nm_; }
  double hi_nm() const { return hi_nm_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }  ///< lights × products
  int bounces() const { return bounces_; }

  /// Whether a spectrum has one bounce more than asked for.
  bool is_watching(Eigen::Index row) const { return rows_[static_cast<std::size_t>(row)] % products_ >= watching_; }

  /// These spectra alone (by their place here).
  SceneProducts some(const std::vector<Eigen::Index>& rows) const;

  /// The radiance of every spectrum at a wavelength within the range: linear between whole nanometres for each
  /// reflectance and light, then multiplied.
  Eigen::VectorXd radiance(double nm) const;
  /// Whether a light shines there enough to carry a weight.
  bool is_lit(double nm) const;

  const Eigen::MatrixXd& target() const { return target_; }  ///< size() × 3: XYZ at 1 nm
  /// differences(), squared, near each target as a quadratic form in XYZ: its elements xx, xy, xz, yy, yz, zz.
  const Eigen::MatrixXd& metric() const { return metric_; }
  /// ΔE_2000 of each spectrum between other tristimulus values (size() × 3) and its target, white from the 1 nm sum;
  /// after one bounce more, divided by kOneBounceMore.
  Eigen::VectorXd differences(const Eigen::MatrixXd& xyz) const;
  /// The same with each light's white from other sums (lights × 3), as a quadrature with a white of its own.
  Eigen::VectorXd differences(const Eigen::MatrixXd& xyz, const Eigen::MatrixXd& whites) const;
  /// The white of each light in the 1 nm sum, lights × 3; and its radiance at a wavelength.
  const Eigen::MatrixXd& whites() const { return whites_; }
  Eigen::VectorXd white_radiance(double nm) const;

 private:
  void sum_targets(const Observer& observer);
  void measure_metric();
  Eigen::VectorXd every_radiance(double nm) const;
  void list_products(int reflectances);
  Eigen::Index light_of(Eigen::Index row) const { return rows_[static_cast<std::size_t>(row)] / products_; }
  double share_of(Eigen::Index row) const { return is_watching(row) ? 1 / kOneBounceMore : 1; }

  int bounces_;
  double lo_nm_, hi_nm_;
  Eigen::Index products_ = 0, watching_ = 0;  ///< of each light; the first with one bounce more
  Eigen::MatrixXd base_, light_;              ///< whole nanometres × reflectances, × lights (each at most 1)
  std::vector<int> parent_, factor_;  ///< product p = product parent_[p] (or 1 for -1) times reflectance factor_[p]
  std::vector<Eigen::Index> rows_;    ///< the spectra kept: light × products_ + product
  Eigen::MatrixXd target_, metric_, whites_;
  std::vector<Lab<double>> lab_;
};

}  // namespace gonio
