#include "energy/energy_tables.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "energy/energy_file.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

std::string file_of(const LobeFamily& family) { return fmt::format("{}.exr", family.name); }

bool is_current(const fs::path& file) {
  if (!fs::is_regular_file(file)) return false;
  try {
    const EnergyTable table = read_energy_table(file);
    const EnergyGrid asked{.widest = table.family().widest};
    check_is_current(table);
    return table.grid().rows == asked.rows && table.grid().columns == asked.columns;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

const EnergyTable* bundled_energy_table(const LobeFamily& family) {
  static std::mutex reading;
  static std::map<std::string_view, std::optional<EnergyTable>> read;
  const std::scoped_lock lock(reading);
  const auto known = read.find(family.name);
  if (known != read.end()) return known->second ? &*known->second : nullptr;
  std::optional<EnergyTable> table;
  if (const auto file = find_data_file("tables/" + file_of(family))) {
    table = read_energy_table(*file);
    check_is_current(*table);  // some milliseconds: a table of other lobes than this program's would be silently wrong
  }
  const auto& kept = read.emplace(family.name, std::move(table)).first->second;
  return kept ? &*kept : nullptr;
}

void make_energy_tables(const fs::path& folder, const std::function<void(const std::string&)>& says,
                        const std::function<void(double)>& done) {
  make_folder(folder);
  for (const LobeFamily& family : lobe_families()) {
    const fs::path file = folder / file_of(family);
    if (is_current(file)) {
      says(fmt::format("{}: there", file.string()));
      continue;
    }
    const EnergyTable table(family, [&](double share) {
      if (done)
        done((static_cast<double>(&family - lobe_families().data()) + share) /
             static_cast<double>(lobe_families().size()));
    });
    write_energy_table(table, file);
    says(fmt::format("{}: {} KiB", file.string(), table.bytes() / 1024));
  }
}

}  // namespace gonio
