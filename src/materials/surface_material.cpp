#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "materials/database.h"

namespace gonio {
namespace {

/// The transparent medium of reflectance r0 at normal incidence: n = (1+√R0)/(1-√R0) (Cook & Torrance 1982).
/// As r0 approaches 1 its reflectance approaches 1 at every angle; from there on (noise) it is that limit.
Interface<double> interface_of_reflectance(double r0) {
  if (r0 >= 1) return perfect_interface<double>();
  const double root = std::sqrt(r0);
  return {(1 + root) / (1 - root), 0.0};
}

double extinction(const Entry& entry, double nm) {
  constexpr double kTransparent = 1e-4;
  if (!entry.has_k()) return 0;
  const std::vector<double>& known = entry.columns[1];
  const bool outside = nm < entry.wavelength_nm.front() || nm > entry.wavelength_nm.back();
  if (!entry.formula.empty() && outside && *std::max_element(known.begin(), known.end()) <= kTransparent) return 0;
  return entry.at(nm, 1);
}

}  // namespace

SurfaceMaterial::SurfaceMaterial(std::string_view id_or_alias, const Database& database) {
  id_ = "perfect";
  if (id_or_alias == id_) return;
  entry_ = &database.find(id_or_alias);
  id_ = entry_->id;
  from_reflectance_ = entry_->kind == "reflectance";
  if (!from_reflectance_ && entry_->kind != "optical-constants")
    throw input_error("{} is of kind {}; expected a material of kind optical-constants or reflectance, or `perfect`",
                      id_, entry_->kind);
}

SurfaceMaterial SurfaceMaterial::perfect() {
  SurfaceMaterial material;
  material.id_ = "perfect";
  return material;
}

double SurfaceMaterial::range_lo_nm() const { return entry_ ? entry_->range_lo_nm : 0; }
double SurfaceMaterial::range_hi_nm() const {
  return entry_ ? entry_->range_hi_nm : std::numeric_limits<double>::infinity();
}

Interface<double> SurfaceMaterial::at(double wavelength_nm) const {
  if (!entry_) return perfect_interface<double>();
  const double value = entry_->at(wavelength_nm);
  if (from_reflectance_) return interface_of_reflectance(value);
  return {value, extinction(*entry_, wavelength_nm)};
}

}  // namespace gonio
