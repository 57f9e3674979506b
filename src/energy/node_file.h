#pragma once
#include <filesystem>

#include "energy/node_table.h"

namespace gonio {

/// An OpenEXR file, a pixel a place of the grid (columns the angle, rows m): channels cos_d_0 … cos_d_7, weight_0 … weight_7, E (on white
/// facets), theta_deg; attributes for model, shadowing, m of the rows, version and a checksum of all of these. A CSV of E beside it.
void write_node_table(const NodeTable& table, const std::filesystem::path& exr);

/// InputError, `file: …`: no such file, another version, another model's name, a checksum that its numbers do not have.
NodeTable read_node_table(const std::filesystem::path& exr);

}  // namespace gonio
