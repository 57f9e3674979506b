#pragma once
#include <filesystem>

#include "energy/energy_table.h"

namespace gonio {

/// The tables that come with gonio (made by the build: tables/FAMILY.exr), each read when first asked for. nullptr where there is no such file
/// or gonio is not installed with it: then E is integrated. InputError for a file that is damaged, of another version, or stale (made of other lobes). Thread-safe.
const EnergyTable* bundled_energy_table(const LobeFamily& family);

/// Makes every family's table in a folder; those there that are whole and current are kept, so that a run cut short is taken up again.
/// `says` hears a line for each, `done` the share of all that is made.
void make_energy_tables(const std::filesystem::path& folder, const std::function<void(const std::string&)>& says,
                        const std::function<void(double)>& done = {});

}  // namespace gonio
