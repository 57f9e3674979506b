#include "fit/profile.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/error.h"
#include "fit/csv.h"

namespace gonio {
namespace {

constexpr std::size_t kFewestPoints = 16;
constexpr double kStepTolerance = 0.01, kLargestUm = 1e9;

struct Column {
  std::size_t index;
  double to_um;
  std::string name;
};

Column length_column(const CsvTable& table, char axis, const std::string& file) {
  std::optional<Column> found;
  for (std::size_t c = 0; c < table.header.size(); ++c)
    for (const auto& [unit, to_um] : {std::pair{"_um", 1.0}, {"_nm", 1e-3}, {"_mm", 1e3}}) {
      if (table.header[c] != axis + std::string(unit)) continue;
      if (found)
        throw input_error("{}:{}: columns {} and {}; expected one of them", file, table.header_line, found->name,
                          table.header[c]);
      found = Column{c, to_um, std::string(table.header[c])};
    }
  if (!found)
    throw input_error("{0}:{1}: no column {2}_um; expected {2}_um, {2}_nm or {2}_mm", file, table.header_line, axis);
  return *found;
}

double length_um(const CsvRow& row, const Column& column, const std::string& file) {
  const double um = csv_number(row.cells[column.index], column.name, file, row.line) * column.to_um;
  if (std::abs(um) > kLargestUm)
    throw input_error("{}:{}: {} is {} um; expected at most {:g}", file, row.line, column.name, um, kLargestUm);
  return um;
}

/// The step from first to last point; every point within 1 % of a step of its place.
double equal_step(const std::vector<double>& x, const std::vector<int>& line, const std::string& file) {
  if (x.size() < kFewestPoints)
    throw input_error("{}:{}: a profile of {} points; expected at least {}", file, line.back(), x.size(),
                      kFewestPoints);
  const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1])) throw input_error("{}:{}: x does not rise; expected rising x", file, line[i]);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - x.front() - step * static_cast<double>(i)) > kStepTolerance * step)
      throw input_error("{}:{}: x is {:g} um; expected equal steps of {:g} um", file, line[i], x[i], step);
  return step;
}

}  // namespace

std::vector<HeightProfile> parse_profiles(std::string_view text, const std::string& file) {
  const CsvTable table = read_csv(text, file);
  const Column x_column = length_column(table, 'x', file), z_column = length_column(table, 'z', file);
  const auto named = std::find(table.header.begin(), table.header.end(), "profile");
  const auto name_of = [&](const CsvRow& row) {
    if (named == table.header.end()) return std::string();
    return std::string(row.cells[std::size_t(named - table.header.begin())]);
  };
  if (table.rows.empty()) throw input_error("{}:{}: no rows; expected heights", file, table.header_line);
  std::vector<HeightProfile> profiles;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < table.rows.size();) {
    HeightProfile profile{name_of(table.rows[i]), 0, {}};
    if (!seen.insert(profile.name).second)
      throw input_error("{}:{}: a profile begins a second time; expected its rows together", file, table.rows[i].line);
    std::vector<double> x;
    std::vector<int> line;
    for (; i < table.rows.size() && name_of(table.rows[i]) == profile.name; ++i) {
      x.push_back(length_um(table.rows[i], x_column, file)), line.push_back(table.rows[i].line);
      profile.z_um.push_back(length_um(table.rows[i], z_column, file));
    }
    profile.step_um = equal_step(x, line, file);
    if (!profiles.empty() && std::abs(profile.step_um / profiles.front().step_um - 1) > kStepTolerance)
      throw input_error("{}:{}: a step of {:g} um; expected {:g} um as before", file, line.front(), profile.step_um,
                        profiles.front().step_um);
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace gonio
