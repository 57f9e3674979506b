#pragma once
// What readers of foreign formats share: directions from their coordinates, and the points they collect.
#include <array>
#include <set>
#include <string>

#include "fit/scan.h"

namespace gonio {

/// Components in the surface's frame, z = normal; not necessarily of length 1.
struct Direction {
  double x = 0, y = 0, z = 1;
};

struct DirectionPair {
  Direction i, o;  ///< towards the light, towards the eye
};

Direction direction_from_deg(double theta_deg, double phi_deg);

/// Half and difference angles in degrees (S. Rusinkiewicz, A New Change of Variables for Efficient BRDF Representation,
/// 1998): h at (θ_h, φ_h); i is (θ_d, φ_d) seen from h, with φ_d = 0 in the plane of h and the normal, away from it;
/// o is the mirror image of i about h. Either may lie below the horizon.
DirectionPair from_half_difference_deg(double theta_h_deg, double phi_h_deg, double theta_d_deg, double phi_d_deg);

/// Angles about the mirror direction, in degrees: `radial_deg` away from it; `around_deg` = 0 on the side of the
/// normal, growing counter-clockwise for one who looks against the mirror direction. At normal incidence, 0 is the
/// light's azimuth. o may lie below the horizon.
DirectionPair from_mirror_deg(double theta_i_deg, double phi_i_deg, double radial_deg, double around_deg);

/// Collects points; at 90 degrees or below the horizon they are left out and counted.
class PointCollector {
 public:
  PointCollector(Measurement known, const std::string& file) : scan_(std::move(known)), file_(file) {}

  Measurement& scan() { return scan_; }
  /// `value` in the file's quantity (scan().quantity), `point.f_std_per_sr` too; `where` = "line" of the message.
  void add(ScanPoint point, double value, int line);
  /// For grids: a pair of directions met before at this wavelength is left out and counted (a pole of the grid, or
  /// 360° beside 0°).
  void add_of_grid(const DirectionPair& pair, double wavelength_nm, double value, int line);
  void leave_out(const std::string& reason) { ++scan_.left_out[reason]; }
  /// InputError when nothing was collected; groups the points by incidence.
  Measurement finish(int line);

 private:
  Measurement scan_;
  const std::string& file_;
  std::set<std::array<long long, 5>> seen_;
};

/// The point with these directions: angles in degrees, azimuths from 0 to 360. `below`: one is at or under the horizon.
ScanPoint point_of(const DirectionPair& pair, bool& below);

}  // namespace gonio
