#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace gonio {

/// Whether the scan has enough points in the plane of incidence to be drawn as curves.
bool has_in_plane_curves(const FitResult& result);

/// Measured points and fitted curves in the plane of incidence, one colour an incidence angle; SVG.
std::string in_plane_svg(const FitResult& result, bool logarithmic);

/// Fitted against measured value of every point, with the line where they agree; SVG.
std::string scatter_svg(const FitResult& result);

struct Plot {
  std::string file, caption;  ///< name inside the folder; what it shows
};

/// Writes the plots that suit the scan: in-plane-log.svg and in-plane-linear.svg where it has curves,
/// fitted-against-measured.svg and residuals.svg.
std::vector<Plot> write_plots(const FitResult& result, const std::filesystem::path& folder);

}  // namespace gonio
