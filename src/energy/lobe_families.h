#pragma once
#include <string_view>
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// A shape of isotropic faceted lobes of one width, bounded at grazing: it has a table of E (energy/energy_table.h). Many models are
/// multiples of one: Cook & Torrance's is four times `torrance-sparrow` with V-cavities.
struct LobeFamily {
  std::string_view name;  ///< "ggx-v-cavity"
  std::string_view described;
  double widest;  ///< alpha up to which it is tabulated (m = 2, or what the model's own box holds)
  Lobe<double> (*lobe)(double alpha);
};

/// alpha from which tables reach. Gaussian slopes: alpha = √2·m; a cosine power n: √(2/n); a Gaussian of the angle: 1/c.
inline constexpr double kNarrowestAlpha = 0.01;

const std::vector<LobeFamily>& lobe_families();
/// InputError naming the known ones.
const LobeFamily& lobe_family(std::string_view name);

/// factor times a family's lobe of this width.
struct FamilyLobe {
  const LobeFamily* family;
  double alpha, factor;
};

/// A lobe as a sum of these; empty where none stands for it (another shape, anisotropic, outside the tables' widths).
std::vector<FamilyLobe> family_lobes(const Lobe<double>& lobe);

}  // namespace gonio
