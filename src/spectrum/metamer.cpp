#include "spectrum/metamer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kRounding = 1e-9;

/// What is summed: 6 rows (X, Y, Z under both lights, each Y-normalised) over whole nanometres.
Eigen::MatrixXd tristimulus_rows(const Spectrum& at, const Spectrum& first, const Spectrum& second,
                                 const Observer& observer) {
  const auto count = static_cast<Eigen::Index>(at.wavelength_nm.size());
  Eigen::MatrixXd rows(6, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double nm = at.wavelength_nm[static_cast<std::size_t>(i)];
    const Xyz<double> eye = observer.at(nm);
    const Eigen::Vector3d xyz(eye.x, eye.y, eye.z);
    rows.block<3, 1>(0, i) = first.at(nm) * xyz;
    rows.block<3, 1>(3, i) = second.at(nm) * xyz;
  }
  for (const int y : {1, 4}) rows.middleRows(y - 1, 3) *= 100 / rows.row(y).sum();
  return rows;
}

/// Columns: the smoothest blacks that shift X, Y or Z by one under the second light.
Eigen::MatrixXd smoothest_blacks(const Eigen::MatrixXd& rows) {
  const Eigen::Index count = rows.cols();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 6, count + 6);
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    const Eigen::Vector3d second_difference(1, -2, 1);
    system.block<3, 3>(i - 1, i - 1) += second_difference * second_difference.transpose();
  }
  system.block(count, 0, 6, count) = rows;
  system.block(0, count, count, 6) = rows.transpose();
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(count + 6, 3);
  wanted.bottomRows(3).setIdentity();
  return system.partialPivLu().solve(wanted).topRows(count);
}

/// How far r + t·b stays within 0 and 1, t >= 0.
double farthest(const std::vector<double>& r, const Eigen::VectorXd& black) {
  double t = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double b = black[static_cast<Eigen::Index>(i)];
    if (b > 0) t = std::min(t, std::max(0.0, 1 - r[i]) / b);
    if (b < 0) t = std::min(t, std::max(0.0, r[i]) / -b);
  }
  return std::isfinite(t) ? t : 0;
}

Spectrum sampled(const Factor& data, double lo_nm, double hi_nm) {
  Spectrum r;
  for (double nm = lo_nm; nm <= hi_nm; ++nm) {
    r.wavelength_nm.push_back(nm), r.value.push_back(data.at(nm));
    if (!(r.value.back() >= -kRounding && r.value.back() <= 1 + kRounding))
      throw input_error("{}: reflectance {} at {} nm; a metamer expects 0 to 1", data.name, r.value.back(), nm);
  }
  return r;
}

Factor factor_of(const Spectrum& r, const std::string& name) {
  return {r.lo_nm(), r.hi_nm(), [&r](double nm) { return r.at(nm); }, name};
}

/// Directions of the shift (X, Y, Z): the corners, edges and faces of a cube.
std::vector<Eigen::Vector3d> directions() {
  std::vector<Eigen::Vector3d> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) all.emplace_back(x, y, z);
  return all;
}

double rms_second_difference(const Eigen::VectorXd& black) {
  const Eigen::Index count = black.size() - 2;
  return std::sqrt((black.head(count) - 2 * black.segment(1, count) + black.tail(count)).squaredNorm() / double(count));
}

/// Rank of the six rows: below six the second light shows nothing that the first does not.
bool independent(const Eigen::MatrixXd& rows) {
  const Eigen::VectorXd singular = rows.jacobiSvd().singularValues();
  return singular[5] > 1e-9 * singular[0];
}

}  // namespace

Metamer metamer_of(const Factor& data, const Spectrum& first, const Spectrum& second, const Observer& observer,
                   bool allow_partial) {
  const ColorSum under_first = color_of(data, first, observer, allow_partial),
                 under_second = color_of(data, second, observer, allow_partial);
  Metamer metamer;
  metamer.original =
      sampled(data, std::max(under_first.lo_nm, under_second.lo_nm), std::min(under_first.hi_nm, under_second.hi_nm));
  const Spectrum& r = metamer.original;
  if (r.value.size() < 9)
    throw input_error("{}: {} common wavelengths; a metamer expects more", data.name, r.value.size());
  const Eigen::MatrixXd rows = tristimulus_rows(r, first, second, observer);
  if (!independent(rows))
    throw input_error("{}: the two lights show the same of it; a metamer expects two different lights", data.name);
  const Eigen::MatrixXd blacks = smoothest_blacks(rows);

  const auto seen = [&](const Spectrum& spectrum, const Spectrum& light) {
    return color_of(factor_of(spectrum, data.name), light, observer, true);
  };
  const auto difference = [](const ColorSum& p, const ColorSum& q) {
    return color_difference(color_values(p), color_values(q)).e2000;
  };
  metamer.first_original = seen(r, first), metamer.second_original = seen(r, second);
  metamer.reflectance = r;
  metamer.second = metamer.second_original;
  metamer.delta_e_second = metamer.roughness_added = 0;
  for (const Eigen::Vector3d& direction : directions()) {
    const Eigen::VectorXd black = blacks * direction;
    const double t = farthest(r.value, black);
    Spectrum candidate = r;
    for (std::size_t i = 0; i < candidate.value.size(); ++i)
      candidate.value[i] = std::clamp(r.value[i] + t * black[static_cast<Eigen::Index>(i)], 0.0, 1.0);
    const ColorSum color = seen(candidate, second);
    const double delta_e = difference(color, metamer.second_original);
    if (delta_e <= metamer.delta_e_second) continue;
    metamer.reflectance = candidate, metamer.second = color, metamer.delta_e_second = delta_e;
    metamer.roughness_added = t * rms_second_difference(black);
  }
  metamer.first = seen(metamer.reflectance, first);
  metamer.delta_e_first = difference(metamer.first, metamer.first_original);
  return metamer;
}

}  // namespace gonio
