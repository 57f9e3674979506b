#pragma once
#include <functional>
#include <span>

#include "energy/energy_table.h"

namespace gonio {

/// A place of a table and its error there, the worst of some surfaces.
struct TableError {
  double theta_deg = 0, alpha = 0, error = 0;
  std::size_t surface = 0;
};

/// What a table loses against the quadrature it stands for.
struct TableCheck {
  TableError dense;   ///< the worst on a grid some times denser each way (0: none)
  TableError random;  ///< the worst of random places
  /// How far the random places go beyond the dense grid (or stay below it, negative).
  double margin() const { return random.error - dense.error; }
};

/// `surfaces`: those whose R the nodes hold (node_error() small). The truth at a place is that of 64 nodes for the same lobe measure to 1e-7, whatever the surface; the lobe
/// measure itself is judged by other quadratures (tests). Random places: a third even in θ, in cos θ and in ln cos θ, all even in ln alpha.
TableCheck check_table(const EnergyTable& table, std::span<const Interface<double>> surfaces, std::size_t times_denser,
                       std::size_t random_places, const std::function<void(double)>& done = {});

}  // namespace gonio
