#pragma once
#include <span>
#include <string>

#include "assess/conservation_limits.h"
#include "assess/conservation_rooms.h"

namespace gonio {

/// ks_max against m, a curve a metal, those of `named` in colour and with their names; one model's limits.
std::string ks_chart(std::span<const MetalLimits> limits, std::span<const std::string_view> named);
/// The plane of kd and m at ks = 0.5: specular, diffuse, and where more light leaves than arrives.
std::string behaviour_chart(const MetalLimits& metal);
/// Mean radiance of the closed room against the reflections of a path.
std::string room_chart(std::span<const RoomMean> means);

}  // namespace gonio
