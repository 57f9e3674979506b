#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/lobe_sum.h"
#include "fit/scan.h"

namespace gonio {

/// How measured and modelled values are compared, point by point. f0 (per sr) keeps the logarithm finite.
///   log       ln(f + f0) - ln(y + f0)       linear    f - y       cuberoot  f^(1/3) - y^(1/3)
///   likelihood  (f - y)/s, s the standard deviation of y: its least squares are the most likely parameters where errors are normal
enum class Metric { log, linear, cuberoot, likelihood };
/// `cosine` compares f·cos θ_o (what a detector of fixed aperture sees) instead of f; under `log` it would cancel.
enum class Weighting { none, cosine };

/// What becomes of large residuals: nothing, or a loss that grows more slowly beyond a width (Huber 1964; Cauchy's).
enum class Loss { none, huber, cauchy };

std::string_view name_of(Loss loss);
Loss loss_from(std::string_view name);  ///< InputError for an unknown name
std::string_view name_of(Metric metric);
std::string_view name_of(Weighting weighting);
Metric metric_from(std::string_view name);        ///< InputError for an unknown name
Weighting weighting_from(std::string_view name);  ///< InputError for an unknown name

/// What every number type sees of a point.
struct FitPoint {
  Directions<double> directions;
  Interface<double> surface;
  double wavelength_um = 1;  ///< 1 where no wavelength is needed
  double f_per_sr = 0;
  double weight = 1;      ///< cos θ_o or 1
  double confidence = 1;  ///< what the residual is multiplied by: 1, or 1/s (Metric::likelihood)
  std::size_t group = 0;  ///< which wavelength
};

/// A parameter that the fit varies, on a logarithmic scale inside its box.
struct FreeParameter {
  /// `place` of n and of k of the surface, which are none of the model's.
  static constexpr std::size_t kIndex = static_cast<std::size_t>(-1), kAbsorption = static_cast<std::size_t>(-2);
  std::size_t place = 0;  ///< in the model's parameters, or one of these
  std::string name, unit;
  double lo = 0, hi = 0;
  bool linear = false;          ///< kd or a ks (a lobe's own factor moves in its logarithm, like a roughness)
  std::size_t group = kShared;  ///< the wavelength (FitPoint::group) whose kd or ks it is

  static constexpr std::size_t kShared = static_cast<std::size_t>(-1);

  bool of_surface() const { return place == kIndex || place == kAbsorption; }
};

/// Another direction that a point's value comes from: source and detector moved off their centres by tangents of small angles, in the
/// plane of the zenith and across it. Nodes of one aperture: fit/aperture.h.
struct ApertureNode {
  double weight = 1;
  std::array<double, 2> source{}, detector{};
};
/// The pair of directions there, and the node's weight in the mean of f over the projected solid angle: 0 below the horizon.
Directions<double> through(const ApertureNode& node, const Directions<double>& centre, double& weight);

/// f_r of lobes that add up, as an aperture sees it (no nodes: the centre alone).
double seen(std::span<const Brdf<double>> lobes, const Directions<double>& centre, const Interface<double>& surface,
            double wavelength_um, std::span<const ApertureNode> aperture);

/// A least-squares problem: points, model, metric, which parameters vary. x holds the logarithms of the free parameters; kd or ks of 0
/// stands at the logarithm of its box's lower end.
class FitProblem {
 public:
  LobeSum model;
  Metric metric = Metric::log;
  double floor_per_sr = 0;  ///< f0
  Loss loss = Loss::none;
  double loss_width = 1;  ///< in the residuals' unit
  std::vector<FitPoint> points;
  std::vector<FreeParameter> free;
  std::vector<double> values;          ///< of all the model's parameters; the free ones are replaced
  std::vector<ApertureNode> aperture;  ///< what f is averaged over; empty: the centre alone

  /// f_r of each point.
  std::vector<double> predict(std::span<const double> x) const { return predict(x, points); }
  std::vector<double> predict(std::span<const double> x, std::span<const FitPoint> at) const;

  /// ψ of the metric: what is compared. The cosine is part of it, the floor too.
  double compared(double f_per_sr, const FitPoint& point) const;
  /// dψ/df.
  double compared_slope(double f_per_sr, const FitPoint& point) const;

  /// All the model's parameters, of one wavelength.
  std::vector<double> values_at(std::span<const double> x, std::size_t group = 0) const;
  std::optional<Interface<double>> surface_at(std::span<const double> x) const;  ///< n (and k, else 0), where free
};

}  // namespace gonio
