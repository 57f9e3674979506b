// MERL BRDF database, `.binary` (W. Matusik, H. Pfister, M. Brand, L. McMillan, A Data-Driven Reflectance Model, 2003, and
// the database's own notes): three 32-bit numbers 90, 90, 180, then three channels of 90·90·180 doubles, little-endian,
// φ_d running fastest, then θ_d, then θ_h. Cells: θ_h from (k/90)²·90° to ((k+1)/90)²·90°, θ_d and φ_d in steps of 1°
// (φ_d from 0 to 180°, the rest by reciprocity). Values times 1/1500 (red), 1.15/1500 (green), 1.66/1500 (blue) are f_r in
// sr⁻¹; negative ones mark cells without a measurement.
#include "fit/formats/merl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "base/error.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"

namespace gonio {
namespace {

static_assert(std::endian::native == std::endian::little, "MERL files are read as they lie in memory");

constexpr std::size_t kHead = 12, kChannels = 3, kGreen = 1;
constexpr double kMostPoints = 100000;

double value_at(std::string_view bytes, std::size_t index) {
  double value;
  std::memcpy(&value, bytes.data() + kHead + index * sizeof value, sizeof value);
  return value;
}

void require_grid(std::string_view bytes, const std::string& file, const MerlGrid& grid) {
  if (bytes.size() < kHead)
    throw input_error("{}: offset {}: the file ends in its head; expected three 32-bit numbers", file, bytes.size());
  std::int32_t dims[3];
  std::memcpy(dims, bytes.data(), sizeof dims);
  const std::int32_t expected[3] = {grid.theta_h, grid.theta_d, grid.phi_d};
  for (std::size_t k = 0; k < 3; ++k)
    if (dims[k] != expected[k])
      throw input_error("{}: offset {}: the grid is {} x {} x {}; expected {} x {} x {}", file, 4 * k, dims[0], dims[1],
                        dims[2], expected[0], expected[1], expected[2]);
  const std::size_t size = kHead + kChannels * grid.cells() * sizeof(double);
  if (bytes.size() != size)
    throw input_error("{}: offset {}: the file {}; expected {} bytes in all", file, std::min(bytes.size(), size),
                      bytes.size() < size ? "ends here" : "goes on", size);
}

void require_finite(std::string_view bytes, const std::string& file, const MerlGrid& grid) {
  for (std::size_t at = 0; at < kChannels * grid.cells(); ++at)
    if (!std::isfinite(value_at(bytes, at)))
      throw input_error("{}: offset {}: the value is not finite; expected a number", file, kHead + 8 * at);
}

/// The smallest step that leaves at most 100,000 of `usable` cells and shares no factor with the grid's 90 and 180, so
/// that every angle of the grid is met.
std::size_t thinning(std::size_t usable) {
  auto step = static_cast<std::size_t>(std::ceil(std::max(1.0, static_cast<double>(usable) / kMostPoints)));
  while (std::gcd(step, std::size_t{30}) != 1) ++step;
  return step;
}

struct Cell {
  ScanPoint point;
  bool below = false;
};

Cell cell_of(std::size_t index, const MerlGrid& grid) {
  const MerlAngles a = merl_angles_deg(index, grid);
  Cell cell;
  cell.point = point_of(from_half_difference_deg(a.theta_h_deg, 0, a.theta_d_deg, a.phi_d_deg), cell.below);
  return cell;
}

}  // namespace

MerlAngles merl_angles_deg(std::size_t index, const MerlGrid& grid) {
  const auto n_d = static_cast<std::size_t>(grid.theta_d), n_phi = static_cast<std::size_t>(grid.phi_d);
  const double h = (static_cast<double>(index / (n_phi * n_d)) + 0.5) / grid.theta_h;
  const double d = (static_cast<double>(index / n_phi % n_d) + 0.5) / grid.theta_d;
  const double phi = (static_cast<double>(index % n_phi) + 0.5) / grid.phi_d;
  return {h * h * 90, d * 90, phi * 180};
}

Measurement read_merl_grid(std::string_view bytes, const std::string& file, const MerlGrid& grid) {
  require_grid(bytes, file, grid);
  require_finite(bytes, file, grid);
  const std::size_t cells = grid.cells();
  int below = 0, negative = 0;
  std::vector<bool> usable(cells);
  for (std::size_t at = 0; at < cells; ++at) {
    const bool under = cell_of(at, grid).below, none = value_at(bytes, kGreen * cells + at) < 0;
    below += under, negative += !under && none;
    usable[at] = !under && !none;
  }
  const auto count = static_cast<std::size_t>(std::count(usable.begin(), usable.end(), true));
  const std::size_t step = thinning(count);
  PointCollector points({}, file);
  Measurement& scan = points.scan();
  for (std::size_t at = 0; at < cells; at += step)
    if (usable[at]) points.add(cell_of(at, grid).point, value_at(bytes, kGreen * cells + at) * kMerlScale[kGreen], 0);
  scan.left_out["below the horizon"] = below;
  scan.left_out["negative: no measurement"] = negative;
  scan.left_out["thinned"] = static_cast<int>(count - scan.points.size());
  std::erase_if(scan.left_out, [](const auto& reason) { return reason.second == 0; });
  scan.conventions = {
      "quantity: brdf, values times 1.15/1500",
      "angles: half and difference angles at the middles of the cells, theta_h = 90 ((k + 1/2)/90)^2 degrees",
      "azimuth: phi_d = 0 in the plane of half vector and normal; isotropic, phi_i of no meaning",
      "scale: absolute, sr^-1",
      "channel: green, wavelength not stated",
      fmt::format("thinning: every {}th cell of the file's order ({} of {} usable ones)", step, scan.points.size(),
                  count)};
  if (scan.points.empty())
    throw input_error("{}: offset {}: no cell holds a value; expected some of 0 or more", file,
                      kHead + 8 * kGreen * cells);
  return points.finish(0);
}

bool is_merl(std::string_view head) {
  constexpr std::int32_t kDims[3] = {90, 90, 180};
  return head.size() >= kHead && std::memcmp(head.data(), kDims, kHead) == 0;
}

Measurement read_merl(std::string_view bytes, const std::string& file) { return read_merl_grid(bytes, file, {}); }

}  // namespace gonio
