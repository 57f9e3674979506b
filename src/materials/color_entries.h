#pragma once
// What colorimetry needs, taken from entries of the database.
#include "materials/database.h"
#include "spectrum/colorimetry.h"

namespace gonio {

/// A light's relative power. InputError for an entry of another kind.
Spectrum light_of(const Entry& entry);

/// The colour-matching functions of an observer. InputError for an entry of another kind.
Observer observer_of(const Entry& entry);

/// What of a material is seen: its reflectance or transmittance, or for optical constants (and `perfect`) the
/// reflectance at normal incidence in air. InputError for lights and eyes. The factor refers to the database.
Factor factor_of(std::string_view id_or_alias, const Database& database = Database::bundled());

}  // namespace gonio
