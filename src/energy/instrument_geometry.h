#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "energy/instrument_reflectance.h"

namespace gonio {

/// What a geometry's name leaves open. The half angles are those of sides named by an angle.
struct InstrumentApertures {
  double phi_i_deg = 0;  ///< from the grain, of the source's axis
  double source_half_angle_deg = 0, half_angle_deg = 0;
  double trap_half_angle_deg = 4;  ///< what `de` leaves out; an instrument's own where it is known
};

/// "8:de", "di:8", "45:0", "45a:0", "d:d", with source:collector as CIE 15 and ASTM E1767 write them ("/" and "°" may
/// stand too). A side is
///   an angle   a direction, or a cone about it; the collector's on the mirror side of the source
///   45a        annular: all directions 40 to 50 degrees from the normal (any angle, ±5)
///   d, h, di   the hemisphere, specular included
///   de         the hemisphere, less a cone about the mirror direction of the other side's angle: specular excluded
/// InputError for anything else, and for an aperture of a side that is named by no angle.
InstrumentGeometry instrument_geometry(std::string_view name, const InstrumentApertures& apertures = {});

/// The mirror direction of `axis`, whose azimuth is taken from phi_deg.
Cone mirror_cone(const Cone& axis, double half_angle_deg, double phi_deg = 0);

/// "directional-conical", "biconical", …: the name that Nicodemus gives it.
std::string nicodemus_name(const InstrumentGeometry& geometry);

}  // namespace gonio
