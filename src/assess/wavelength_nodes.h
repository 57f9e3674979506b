#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "spectrum/wavelengths.h"

namespace gonio {

/// The 24 ColorChecker patches and five metals at normal incidence under a light of the database, observer CIE 1931.
SpectralScene reference_scene(const std::string& light);

/// Every bundled light that shines over enough of the visible range for a colour sum.
std::vector<std::string> reference_lamps();

/// What a search found, as a row a node of nodes.csv: light,bounces,search,nm,x,y,z.
struct FoundNodes {
  std::string light;
  int bounces = 0;
  std::string how;  ///< quick, fewest or thorough
  NodeWeights nodes;
};
std::string nodes_csv(const std::vector<FoundNodes>& found);
/// InputError for a file of another form.
std::vector<FoundNodes> read_nodes(const std::filesystem::path& file);

}  // namespace gonio
