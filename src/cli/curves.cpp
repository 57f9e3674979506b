#include "cli/curves.h"

#include "base/error.h"
#include "base/files.h"
#include "fit/csv.h"

namespace gonio::cli {

bool names_a_file(const std::string& id_or_file) { return id_or_file.ends_with(".csv"); }

Curves read_curves(const std::string& file) {
  const std::string text = read_file(file);
  const CsvTable table = read_csv(text, file);
  if (table.header[0] != "wavelength_nm" || table.header.size() < 2)
    throw input_error("{}:{}: header is not of a spectral table; expected wavelength_nm and one or more columns", file,
                      table.header_line);
  Curves curves;
  for (std::size_t c = 1; c < table.header.size(); ++c) {
    if (table.header[c].empty())
      throw input_error("{}:{}: column {} has no name; expected one", file, table.header_line, c + 1);
    curves.name.emplace_back(table.header[c]);
  }
  curves.value.resize(curves.name.size());
  for (const CsvRow& row : table.rows) {
    const double nm = csv_number(row.cells[0], "wavelength_nm", file, row.line);
    const double before = curves.wavelength_nm.empty() ? 0 : curves.wavelength_nm.back();
    if (!(nm > before))
      throw input_error("{}:{}: wavelength_nm is {}; expected more than {}", file, row.line, nm, before);
    curves.wavelength_nm.push_back(nm);
    for (std::size_t c = 0; c < curves.name.size(); ++c)
      curves.value[c].push_back(csv_number(row.cells[c + 1], curves.name[c], file, row.line));
  }
  if (curves.wavelength_nm.size() < 2)
    throw input_error("{}:{}: {} rows; expected at least two", file, table.header_line, curves.wavelength_nm.size());
  return curves;
}

}  // namespace gonio::cli
