#include "cli/cone_axis.h"

#include "base/error.h"
#include "cli/arguments.h"

namespace gonio::cli {

Cone cone_about(const std::string& axis, double theta_i_deg, double half_angle_deg) {
  if (axis == "mirror") return {theta_i_deg, 180, half_angle_deg};
  if (axis == "normal") return {0, 0, half_angle_deg};
  const std::size_t comma = axis.find(',');
  if (comma == axis.npos)
    throw input_error("--axis {}: is no direction; expected mirror, normal or THETA,PHI in degrees", axis);
  const Cone cone{number_in(axis.substr(0, comma), "--axis"), number_in(axis.substr(comma + 1), "--axis"),
                  half_angle_deg};
  if (!(cone.theta_deg >= 0 && cone.theta_deg <= 90))
    throw input_error("--axis {}: theta is {}; expected 0 to 90", axis, cone.theta_deg);
  return cone;
}

}  // namespace gonio::cli
