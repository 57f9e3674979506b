#pragma once
#include "materials/database.h"
#include "spectrum/interpolation.h"

namespace gonio {

/// The variant that reports/interpolation justifies for single values of a class of data: a kind of entry, or
/// "optical-constants n", "optical-constants k". Colour sums are linear between points all the same.
Interpolation default_interpolation(std::string_view data_class);

/// "optical-constants n" for that kind's column n, and so on; the kind itself otherwise.
std::string data_class_of(const Entry& entry, std::size_t column);

/// A column of an entry at a wavelength by a variant; beyond its table only where an extension is given, and marked. A
/// formula is evaluated, never interpolated, and never extended. Values not known do not count as points. Where a cubic
/// dips below 0 and the quantity cannot (all kinds but rgb-observer and daylight-basis), it is 0.
/// InputError as Entry::at and Interpolator.
Interpolated interpolated(const Entry& entry, double wavelength_nm, std::size_t column, Interpolation variant,
                          std::optional<Extension> extension = {});

}  // namespace gonio
