#include "assess/model_choice_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "fit/choose.h"
#include "fit/gnuplot.h"
#include "fit/scan.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string id, name;
  ModelChoice choice;

  const Candidate& chosen() const { return choice.candidates[choice.chosen]; }
  const Candidate& best() const { return choice.candidates[choice.best]; }
  const Candidate& ward() const { return single("ward-1992"); }
  /// The best of single lobes.
  const Candidate& best_single() const {
    const Candidate* found = nullptr;
    for (const Candidate& c : choice.candidates)
      if (!c.result.model.is_sum() && (!found || c.held_out_log10 < found->held_out_log10)) found = &c;
    return *found;
  }
  const Candidate& single(std::string_view model) const {
    return *std::find_if(choice.candidates.begin(), choice.candidates.end(), [&](const Candidate& c) {
      return !c.result.model.is_sum() && c.result.model.name() == model && !c.result.model.first().retro;
    });
  }
  Excess ward_over_chosen() const { return excess_over(choice, ward(), chosen()); }
};

std::vector<fs::path> bundled() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(data_folder("measurements")))
    if (fs::exists(entry.path() / "scan.csv")) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

Row row_of(const fs::path& path, const std::function<void(const std::string&)>& progress) {
  const Measurement scan = read_measurement(path);
  progress(scan.id);
  return {scan.id, scan.name, choose_model(scan, FitRequest(), all_candidates(scan))};
}

std::string table_of(const std::vector<Row>& rows) {
  std::string text =
      "| measurement | chosen | parameters | left out: rms log10 | best single lobe | Ward 1992 | Ward's excess |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const Excess excess = row.ward_over_chosen();
    text += fmt::format("| {} | {} | {} | {:.3g} | {} ({:.3g}) | {:.3g} | {:.2g} ± {:.1g} |\n", row.id,
                        row.chosen().result.model.described(), row.chosen().parameters, row.chosen().held_out_log10,
                        row.best_single().result.model.described(), row.best_single().held_out_log10,
                        row.ward().held_out_log10, excess.mean, excess.error);
  }
  return text;
}

std::string choices_csv(const std::vector<Row>& rows) {
  std::string csv = "measurement,model,parameters,rms_log10,held_out_rms_log10,worse_than_best,standard_error,chosen\n";
  for (const Row& row : rows)
    for (const Candidate& c : row.choice.candidates)
      csv += fmt::format("{},{},{},{:.4g},{:.4g},{:.3g},{:.3g},{}\n", row.id, c.result.model.described(), c.parameters,
                         c.result.all.rms_log10, c.held_out_log10, c.worse, c.uncertain,
                         &c == &row.chosen() ? "yes" : "no");
  return csv;
}

/// A line a material: Ward's error, the best single lobe's, the chosen model's.
std::string chart(const std::vector<Row>& rows) {
  std::string data = "$d << EOD\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& r = rows[i];
    data += fmt::format("{} {} {} {} {}\n", rows.size() - i, r.ward().held_out_log10, r.best_single().held_out_log10,
                        r.chosen().held_out_log10, r.id);
  }
  const std::string script =
      data +
      "EOD\nset title 'Error of scans left out of the fit'\nset logscale x\nset xlabel 'rms of "
      "log_{10}(fitted/measured)'\n"
      "set xrange [0.004:1]\nset yrange [0.4:" +
      fmt::format("{}.6]\n", rows.size()) +
      "set grid x lw 0.6 lc rgb '#DDDDDD'\nset key outside top left horizontal reverse Left\n"
      "set lmargin 34\nset tics out nomirror\nset border 1 lc rgb '#404040'\n"
      "plot $d using 4:1:($2-$4):(0):ytic(5) with vectors nohead lc rgb '#BBBBBB' lw 2 notitle,\\\n"
      "  $d using 2:1 with points pt 6 ps 1.1 lc rgb '#D55E00' lw 2 title 'kd + one Ward lobe',\\\n"
      "  $d using 3:1 with points pt 4 ps 1.1 lc rgb '#0072B2' lw 2 title 'best single lobe',\\\n"
      "  $d using 4:1 with points pt 7 ps 1.1 lc rgb '#009E73' title 'chosen by auto'\n";
  return gnuplot_svg(script, 900, 100 + 38 * int(rows.size()));
}

std::string page(const std::vector<Row>& rows) {
  std::string text =
      "# Which model each bundled measurement needs\n\n"
      "`gonio fit MEASUREMENT --model auto` for every scan in measurements/: all models with a diffuse part, lobes "
      "turned back "
      "towards the light among them, then sums of the best. Whole incidences are left out in turn; chosen is the model "
      "with the "
      "fewest parameters that those cannot tell from the best one (one standard error, between scans of one incidence "
      "and 30° of "
      "azimuth). The last column is how far the mean squared log10 error of a diffuse part with one Ward lobe exceeds "
      "that of "
      "the chosen model on the same left-out scans, with its standard error.\n\n" +
      table_of(rows) +
      "\n![Errors of left-out scans](errors.svg)\n\nEvery candidate: [choices.csv](choices.csv). Remade by `gonio "
      "report "
      "model-choice`. Errors so small that a fit of another start or machine may be the better one by chance can "
      "change the "
      "choice.\n\n";
  for (const Row& row : rows) text += fmt::format("- **{}** ({}): {}.\n", row.id, row.name, row.choice.sentence);
  return text;
}

}  // namespace

void write_model_choice(const fs::path& folder, const std::function<void(const std::string&)>& progress) {
  std::vector<Row> rows;
  for (const fs::path& path : bundled()) rows.push_back(row_of(path, progress));
  make_folder(folder);
  write_file(folder / "choices.csv", choices_csv(rows));
  write_file(folder / "errors.svg", chart(rows));
  write_file(folder / "README.md", page(rows));
}

}  // namespace gonio
