#pragma once
// What an evaluation loses: against the models' own formulas in 50 digits, given exactly the numbers that it received
// (unit vectors, parameters, index and wavelength already rounded to its precision).
#include <functional>
#include <span>

#include "assess/brdf_points.h"

namespace gonio {

/// How f is computed: the library's three number types.
enum class NumberPath { double_scalar, double_lanes, float_lanes };
std::string_view name_of(NumberPath path);
Precision precision_of(NumberPath path);

struct PointError {
  BrdfPoint point;
  double f, exact, relative;
};

/// A measured case. `relative` counts where f is bright: above 1e-290 for double, above 1e-6 of the set's peak for
/// float (the largest f of its directions), whose faint class runs from there down to 1e-30.
struct CaseError {
  std::string name, path;
  ModelSpec spec;
  std::size_t points = 0, bright = 0, faint = 0;
  /// Points where f itself is no better known than its input, so not counted above: next to the critical angle of a
  /// thinner medium, and to where Schlick's D reaches 0. Their largest error, beside the set's peak.
  std::size_t ill_conditioned = 0;
  double largest_ill = 0;
  double largest = 0, percentile_999 = 0, mean = 0, largest_faint = 0;
  std::size_t not_finite = 0, negative = 0;  ///< anywhere, ill-conditioned and vanishing f included
  double reciprocity = 0;         ///< largest |f(i,o) - f(o,i)|/f where bright or faint; 0 for models that claim none
  std::vector<PointError> worst;  ///< the largest errors, first those that are no numbers
};

/// f of each point; the numbers given are exact in the evaluator's precision.
using BrdfEvaluator = std::function<std::vector<double>(std::span<const BrdfPoint>)>;

/// The library's own evaluation of a case along a path, from the vectors on.
BrdfEvaluator own_evaluator(const ModelSpec& spec, NumberPath path);
/// Any formula of one point at a time, run in parallel.
BrdfEvaluator pointwise(std::function<double(const BrdfPoint&)> f);

/// The 50-digit values, in parallel.
std::vector<double> reference_values(const ModelSpec& spec, std::span<const BrdfPoint> points);

struct MeasureOptions {
  std::size_t worst = 3;
  bool reciprocal = true;  ///< measure the defect (where the model claims to have none)
};
/// `evaluator` against `exact` = reference_values(spec, points); points of whole sets.
CaseError measure(const ModelSpec& spec, Precision precision, std::string path, const BrdfEvaluator& evaluator,
                  std::span<const BrdfPoint> points, std::span<const double> exact, const MeasureOptions& options = {});

struct ErrorOptions {
  PointOptions points;
  MeasureOptions measure;
  std::function<bool(const ModelSpec&)> wanted;  ///< all cases where empty
};
/// Every case of brdf_cases() along the three paths.
std::vector<CaseError> brdf_errors(const ErrorOptions& options);

/// The error allowed: what the project promises (double 1e-12, float 5e-6 and 5e-5 where faint; the diffraction series
/// and He 1e-10 and 2e-5).
struct ErrorBar {
  double bright, faint;
};
ErrorBar error_bar(const ModelSpec& spec, Precision precision);

}  // namespace gonio
