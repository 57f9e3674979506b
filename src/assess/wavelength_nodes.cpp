#include "assess/wavelength_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/files.h"
#include "fit/csv.h"
#include "materials/color_entries.h"

namespace gonio {

SpectralScene reference_scene(const std::string& light) {
  const Database& database = Database::bundled();
  SpectralScene scene{{}, {light_of(database.find(light))}, observer_of(database.find("1931-2"))};
  for (const std::string& id : database.ids())
    if (id.starts_with("colorchecker-ohta-")) scene.reflectances.push_back(factor_of(id));
  for (const char* metal : {"Au_Johnson", "Ag_Johnson", "Cu_Johnson", "Al_Rakic", "Fe_Johnson"})
    scene.reflectances.push_back(factor_of(metal));
  return scene;
}

std::vector<std::string> reference_lamps() {
  const Database& database = Database::bundled();
  const Observer observer = observer_of(database.find("1931-2"));
  std::vector<std::string> ids;
  for (const Entry* entry : database.all()) {
    if (entry->kind != "illuminant" || entry->user) continue;
    try {
      color_of({380, 780, [](double) { return 1.0; }}, light_of(*entry), observer);
      ids.push_back(entry->id);
    } catch (const InputError&) {  // no light to see by: a printer's lamp ends at 560 nm
    }
  }
  return ids;
}

std::string nodes_csv(const std::vector<FoundNodes>& found) {
  std::string csv = "light,bounces,search,nm,x,y,z\n";
  for (const FoundNodes& f : found)
    for (std::size_t j = 0; j < f.nodes.nodes_nm.size(); ++j) {
      const auto w = f.nodes.weight.row(static_cast<Eigen::Index>(j));
      csv += fmt::format("{},{},{},{:.4f},{:.9f},{:.9f},{:.9f}\n", f.light, f.bounces, f.how, f.nodes.nodes_nm[j], w[0],
                         w[1], w[2]);
    }
  return csv;
}

std::vector<FoundNodes> read_nodes(const std::filesystem::path& file) {
  const std::string text = read_file(file), name = file.string();
  const CsvTable table = read_csv(text, name);
  constexpr std::string_view kHeader[] = {"light", "bounces", "search", "nm", "x", "y", "z"};
  if (!std::equal(table.header.begin(), table.header.end(), std::begin(kHeader), std::end(kHeader)))
    throw input_error("{}:{}: other columns; expected light,bounces,search,nm,x,y,z", name, table.header_line);
  std::vector<FoundNodes> found;
  std::vector<std::array<double, 3>> weights;
  const auto close = [&] {
    if (found.empty()) return;
    Eigen::MatrixXd& weight = found.back().nodes.weight;
    weight.resize(static_cast<Eigen::Index>(weights.size()), 3);
    for (std::size_t j = 0; j < weights.size(); ++j)
      for (int c = 0; c < 3; ++c) weight(static_cast<Eigen::Index>(j), c) = weights[j][static_cast<std::size_t>(c)];
    weights.clear();
  };
  for (const CsvRow& row : table.rows) {
    const auto number = [&](std::size_t c) { return csv_number(row.cells[c], kHeader[c], name, row.line); };
    const int bounces = static_cast<int>(number(1));
    const double nm = number(3);
    // Nodes increase within a set; the next set starts again from short waves, or says so by its name.
    if (found.empty() || found.back().light != row.cells[0] || found.back().bounces != bounces ||
        found.back().how != row.cells[2] || nm <= found.back().nodes.nodes_nm.back()) {
      close();
      found.push_back({std::string(row.cells[0]), bounces, std::string(row.cells[2]), {}});
    }
    found.back().nodes.nodes_nm.push_back(nm);
    weights.push_back({number(4), number(5), number(6)});
  }
  close();
  return found;
}

}  // namespace gonio
