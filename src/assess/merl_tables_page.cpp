#include "assess/merl_tables_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "assess/merl_checks.h"
#include "assess/merl_sheet.h"
#include "base/files.h"

namespace gonio {
namespace {

constexpr std::size_t kOnASheet = 25;

std::string table_name(std::size_t table) { return std::string(published_tables()[table].name); }

std::string values_csv(const std::vector<MerlFit>& fits) {
  std::string csv = "material,table,kd";
  for (const double half : kMerlHalfDeg) csv += fmt::format(",f_theta_h_{:g}", half);
  for (const double theta : kMerlEnergyDeg) csv += fmt::format(",energy_{:g}", theta);
  csv += '\n';
  for (const MerlFit& fit : fits) {
    csv += fmt::format("{},{},{:.4g}", fit.material, table_name(fit.table), fit.kd);
    for (const double f : fit.f) csv += fmt::format(",{:.3e}", f);
    for (const double energy : fit.energy) csv += fmt::format(",{:.3f}", energy);
    csv += '\n';
  }
  return csv;
}

/// Median and nine tenths of |decades| of each table.
std::string agreement_table(const std::vector<MerlDeviation>& deviations) {
  std::string text = "| table | materials |";
  for (const double half : kMerlHalfDeg) text += fmt::format(" {:g}° |", half);
  text += "\n|---|---|";
  for (std::size_t h = 0; h < kMerlHalfDeg.size(); ++h) text += "---|";
  text += '\n';
  for (std::size_t t = 0; t < published_tables().size(); ++t) {
    text += fmt::format("| {} | {} |", table_name(t), decades_of(deviations, t, 0).size());
    for (std::size_t h = 0; h < kMerlHalfDeg.size(); ++h) {
      std::vector<double> all = decades_of(deviations, t, h);
      for (double& d : all) d = std::abs(d);
      text += fmt::format(" {:.2f} / {:.2f} |", quantile(all, 0.5), quantile(all, 0.9));
    }
    text += '\n';
  }
  return text;
}

std::string spread_table(const std::vector<MerlSpread>& spreads) {
  std::string text = "| half vector | material | decades | lowest | highest | why |\n|---|---|---|---|---|---|\n";
  for (const MerlSpread& s : spreads)
    text += fmt::format("| {:g}° | {} | {:.2f} | {} | {} | {} |\n", kMerlHalfDeg[s.half], s.material, s.decades,
                        table_name(s.lowest), table_name(s.highest), s.why);
  return text;
}

std::string energy_table(const std::vector<MerlFit>& fits) {
  std::string text = "| material | table | E at 10° | E at 75° |\n|---|---|---|---|\n";
  for (const MerlFit& fit : fits)
    if (fit.energy[0] > 1 || fit.energy[1] > 1)
      text += fmt::format("| {} | {} | {:.3g} | {:.3g} |\n", fit.material, table_name(fit.table), fit.energy[0],
                          fit.energy[1]);
  return text;
}

std::string claims_table(const std::vector<Claim>& claims) {
  std::string text = "| statement | quantity | value | holds for | verdict |\n|---|---|---|---|---|\n";
  for (const Claim& claim : claims)
    text += fmt::format("| {} | {} | {:.3g} | {:.3g} to {:.3g} | {} |\n", claim.statement, claim.quantity, claim.value,
                        claim.lo, claim.hi, claim.holds() ? "holds" : "**does not hold**");
  return text;
}

std::string aluminium_table() {
  const std::vector<double> measured = measured_aluminium();
  std::string text = "| table |";
  for (const double half : kMerlHalfDeg) text += fmt::format(" {:g}° |", half);
  text += "\n|---|";
  for (std::size_t h = 0; h < measured.size(); ++h) text += "---|";
  text += "\n| measured, 1/sr |";
  for (const double f : measured) text += fmt::format(" {:.3g} |", f);
  text += '\n';
  for (std::size_t t = 0; t < published_tables().size(); ++t) {
    const PublishedFit fit = published_fit(table_name(t) + "/aluminium/g");
    text += fmt::format("| {} |", table_name(t));
    for (std::size_t h = 0; h < measured.size(); ++h)
      text += fmt::format(" {:.2f} |", std::log10(merl_value(fit, kMerlThetaI - 2 * kMerlHalfDeg[h]) / measured[h]));
    text += '\n';
  }
  return text;
}

std::string text_of(const std::vector<MerlFit>& fits, const std::vector<MerlDeviation>& deviations,
                    std::size_t sheets) {
  std::string text = fmt::format(
      "# The published MERL tables\n\n"
      "Ngan et al. 2005 (seven models, 86 materials), Low et al. 2012 (six, 100) and Bagher et al. 2012 (one, 100) "
      "fitted reflection models to the\n"
      "same measured materials. Their parameters (measurements/published_parameters, conventions in the README there) "
      "are evaluated here with our\n"
      "models: light at 45°, eye in the plane of incidence, green channel. {} fits. Where they agree, a reading of a "
      "paper's conventions is\n"
      "confirmed; where they do not, either the model cannot follow the material or the fit did not ask it to.\n\n"
      "## What is checked\n\n",
      fits.size());
  text += claims_table(merl_claims(fits, deviations));
  text +=
      "\nThe absolute scale of all tables is that of the MERL files, and in doubt: teflon reflects a third in every "
      "table "
      "where sintered PTFE reflects\n0.99 (NIST). Times π the white materials would come to about 1, but the red of "
      "orange and light red paint to 1.4. An energy\nbelow 1 here proves little.\n\n"
      "## Agreement\n\n"
      "|log10 f - median of all tables for the same material|: its median / nine tenths over the materials, by the "
      "angle of the half vector from the\n"
      "normal (0° is the mirror direction). 0.3 is a factor of 2. Rows of He's table whose printed index is 1.0 have "
      "no lobe and are left out.\n\n";
  text += agreement_table(deviations);
  text +=
      "\nWhere tables of one material lie furthest apart, the five worst at the mirror direction, in the flank and in "
      "the tail:\n\n";
  text += spread_table(merl_spreads(fits, deviations));
  text +=
      "\n## Energy\n\nDirectional reflectance, diffuse part, lobe and coherent part, of the brightest channel. Above "
      "1:\n\n" +
      energy_table(fits);
  text +=
      "\nNgan's He fits have indices down to 1.01: F vanishes at the normal, ρ_s (6770 for red-phenolic) makes up for "
      "it, "
      "and F rises a hundredfold\ntowards grazing. All energies are in values.csv.\n\n"
      "## Aluminium against its measurement\n\n"
      "log10 of each table's f (green) over the bundled in-plane measurement of the same material (MERL BRDF "
      "database,\nMatusik et al. 2003, CC BY-SA 4.0; luminance-like).\n"
      "Gaussian and cosine-power lobes leave the tail to kd, and are ten times off between core and tail.\n\n" +
      aluminium_table() + "\n## All materials\n";
  for (std::size_t s = 1; s <= sheets; ++s) text += fmt::format("\n![materials {0}](sheet-{0}.png)\n", s);
  return text;
}

}  // namespace

void write_merl_tables(const std::filesystem::path& folder) {
  make_folder(folder);
  const std::vector<MerlFit> fits = merl_fits();
  const std::vector<MerlDeviation> deviations = merl_deviations(fits);
  std::vector<std::vector<PublishedFit>> tables;
  for (const PublishedTable& table : published_tables()) tables.push_back(read_published(table));
  std::vector<std::string> materials;
  for (const MerlFit& fit : fits)
    if (materials.empty() || materials.back() != fit.material) materials.push_back(fit.material);
  std::size_t sheets = 0;
  for (std::size_t at = 0; at < materials.size(); at += kOnASheet) {
    const auto from = materials.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = materials.begin() + static_cast<std::ptrdiff_t>(std::min(at + kOnASheet, materials.size()));
    write_file(folder / fmt::format("sheet-{}.png", ++sheets), merl_sheet({from, to}, tables));
  }
  write_file(folder / "values.csv", values_csv(fits));
  write_file(folder / "README.md", text_of(fits, deviations, sheets));
}

}  // namespace gonio
