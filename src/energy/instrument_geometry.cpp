#include "energy/instrument_geometry.h"

#include <charconv>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kAnnulusHalfWidthDeg = 5;  // CIE 15: between cones of 40 and 50 degrees

/// One side of a name.
struct SideName {
  enum Kind { angle, annular, hemisphere, hemisphere_less_specular } kind = hemisphere;
  double theta_deg = 0;
};

std::string without_degree_signs(std::string_view text) {
  std::string bare(text);
  for (std::size_t at; (at = bare.find("°")) != bare.npos;) bare.erase(at, std::string_view("°").size());
  return bare;
}

SideName side_of(std::string_view text, std::string_view whole) {
  if (text == "d" || text == "h" || text == "di") return {SideName::hemisphere};
  if (text == "de") return {SideName::hemisphere_less_specular};
  SideName side{SideName::angle};
  const bool annular = text.ends_with('a');
  const std::string_view digits = annular ? text.substr(0, text.size() - 1) : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), side.theta_deg);
  if (error != std::errc{} || end != digits.data() + digits.size() || digits.empty())
    throw input_error("geometry {}: side \"{}\" is unknown; expected an angle, an angle and a, d, h, di or de", whole,
                      text);
  const double least = annular ? kAnnulusHalfWidthDeg : 0, most = annular ? 90 - kAnnulusHalfWidthDeg : 89.99;
  if (annular) side.kind = SideName::annular;
  if (!(side.theta_deg >= least && side.theta_deg <= most))
    throw input_error("geometry {}: angle {}; expected {} to {}", whole, side.theta_deg, least, most);
  return side;
}

Opening opening_of(const SideName& side, double phi_deg, double half_angle_deg) {
  switch (side.kind) {
    case SideName::angle:
      return {{side.theta_deg, phi_deg, half_angle_deg}};
    case SideName::annular:
      return {{0, phi_deg, side.theta_deg + kAnnulusHalfWidthDeg}, Cone{0, 0, side.theta_deg - kAnnulusHalfWidthDeg}};
    default:
      return {{0, phi_deg, 90}};
  }
}

}  // namespace

Cone mirror_cone(const Cone& axis, double half_angle_deg, double phi_deg) {
  return {axis.theta_deg, std::fmod(phi_deg + axis.phi_deg + 180, 360.0), half_angle_deg};
}

InstrumentGeometry instrument_geometry(std::string_view name, const InstrumentApertures& apertures) {
  const std::string bare = without_degree_signs(name);
  const std::size_t at = bare.find_first_of(":/");
  if (at == bare.npos) throw input_error("geometry {}: expected SOURCE:COLLECTOR, such as 8:di or 45:0", name);
  const SideName source = side_of(std::string_view(bare).substr(0, at), name),
                 collector = side_of(std::string_view(bare).substr(at + 1), name);
  const auto refuse_aperture = [&](const SideName& side, double half_angle_deg, std::string_view which) {
    if (half_angle_deg > 0 && side.kind != SideName::angle)
      throw input_error("geometry {}: the {} has its aperture already; expected no half angle", name, which);
  };
  refuse_aperture(source, apertures.source_half_angle_deg, "source");
  refuse_aperture(collector, apertures.half_angle_deg, "collector");
  const auto excludes = [&](const SideName& side, const SideName& other) {
    if (side.kind != SideName::hemisphere_less_specular) return false;
    if (other.kind != SideName::angle)
      throw input_error("geometry {}: de leaves out a mirror direction; expected an angle on the other side", name);
    return true;
  };
  const double phi = apertures.phi_i_deg, trap = apertures.trap_half_angle_deg;
  InstrumentGeometry geometry{opening_of(source, phi, apertures.source_half_angle_deg),
                              opening_of(collector, 180, apertures.half_angle_deg)};
  if (excludes(collector, source)) geometry.collector.stop = Cone{source.theta_deg, 180, trap};
  if (excludes(source, collector)) geometry.source.stop = mirror_cone(geometry.collector.cone, trap, phi);
  return geometry;
}

std::string nicodemus_name(const InstrumentGeometry& geometry) {
  const auto kind = [](const Opening& o) {
    return o.is_direction() ? "directional" : o.is_hemisphere() ? "hemispherical" : "conical";
  };
  const std::string source = kind(geometry.source), collector = kind(geometry.collector);
  return source == collector ? "bi" + source : source + "-" + collector;
}

}  // namespace gonio
