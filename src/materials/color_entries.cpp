#include "materials/color_entries.h"

#include "base/error.h"

namespace gonio {

Spectrum light_of(const Entry& entry) {
  if (entry.kind != "illuminant") throw input_error("{} is of kind {}; expected an illuminant", entry.id, entry.kind);
  return {entry.wavelength_nm, entry.columns[0]};
}

Observer observer_of(const Entry& entry) {
  if (entry.kind != "observer") throw input_error("{} is of kind {}; expected an observer", entry.id, entry.kind);
  return {entry.wavelength_nm, entry.columns[0], entry.columns[1], entry.columns[2]};
}

Factor factor_of(std::string_view id_or_alias, const Database& database) {
  if (id_or_alias == "perfect") return {0, 1e9, [](double) { return 1.0; }, "perfect"};
  const Entry& entry = database.find(id_or_alias);
  if (entry.kind == "reflectance" || entry.kind == "transmittance")
    return {entry.range_lo_nm, entry.range_hi_nm, [&entry](double nm) { return entry.at(nm); }, entry.id};
  if (entry.kind != "optical-constants")
    throw input_error("{} is of kind {}; expected optical-constants, reflectance or transmittance", entry.id,
                      entry.kind);
  return {entry.range_lo_nm, entry.range_hi_nm,
          [material = SurfaceMaterial(entry.id, database)](double nm) { return material.at(nm).r0(); }, entry.id};
}

}  // namespace gonio
