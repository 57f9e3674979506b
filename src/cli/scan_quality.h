#pragma once
#include <optional>

#include "fit/scan_quality.h"

namespace gonio::cli {

/// What `measurements info` says of a scan's own consistency; nothing where there is nothing to compare.
void print_quality(const ScanQuality& quality, const std::optional<NoiseEstimate>& noise);

}  // namespace gonio::cli
