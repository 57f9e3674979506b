#include "assess/interpolation_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "assess/interpolation_error.h"
#include "base/files.h"
#include "fit/gnuplot.h"
#include "materials/interpolated_entry.h"

namespace gonio {
namespace {

constexpr std::array kColours{"#000000", "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9", "#707070"};

std::string csv_of(const std::vector<LeaveOutError>& errors) {
  std::string csv =
      "id,class,column,variant,points_kept,points_predicted,max_relative_to_range,rms_relative_to_range\n";
  for (const LeaveOutError& e : errors)
    csv += fmt::format("{},{},{},{},{},{},{:.4e},{:.4e}\n", e.id, e.data_class, e.column, name_of(e.variant), e.kept,
                       e.predicted, e.max, e.rms);
  return csv;
}

std::string csv_of(const std::vector<ClassError>& classes) {
  std::string csv = "class,points,variant,columns,median_rms,p90_rms,worst_max\n";
  for (const ClassError& c : classes)
    csv += fmt::format("{},{},{},{},{:.4e},{:.4e},{:.4e}\n", c.data_class, c.equidistant ? "equidistant" : "all",
                       name_of(c.variant), c.columns, c.median_rms, c.p90_rms, c.worst_max);
  return csv;
}

std::vector<std::string> class_names(const std::vector<ClassError>& classes) {
  std::vector<std::string> names;
  for (const ClassError& c : classes)
    if (std::find(names.begin(), names.end(), c.data_class) == names.end()) names.push_back(c.data_class);
  return names;
}

/// A class under a variant: over all its columns, over the equidistant ones for sprague; null where there is none.
const ClassError* result_of(const std::vector<ClassError>& classes, const std::string& name, Interpolation variant) {
  for (const ClassError& c : classes)
    if (c.data_class == name && c.variant == variant && c.equidistant == (variant == Interpolation::sprague)) return &c;
  return nullptr;
}

/// One cluster a class, one point a variant: the median, with a line up to the 90th percentile.
std::string error_chart(const std::vector<ClassError>& classes) {
  const std::vector<std::string> names = class_names(classes);
  std::string tics, data, plot;
  for (std::size_t n = 0; n < names.size(); ++n) {
    std::string label = names[n];
    for (auto at = label.find_first_of(" -"); at != label.npos; at = label.find_first_of(" -"))
      label.replace(at, 1, "\\n");
    tics += fmt::format("{}\"{}\" {}", n == 0 ? "" : ", ", label, n + 1);
  }
  for (std::size_t v = 0; v < std::size(kInterpolations); ++v) {
    data += fmt::format("$d{} << EOD\n", v);
    for (std::size_t n = 0; n < names.size(); ++n)
      if (const ClassError* c = result_of(classes, names[n], kInterpolations[v]))
        data +=
            fmt::format("{:.2f} {:.4e} {:.4e}\n", static_cast<double>(n + 1) + 0.12 * (static_cast<double>(v) - 2.5),
                        c->median_rms, c->p90_rms);
    data += "EOD\n";
    plot += fmt::format("{}$d{} using 1:2:2:3 with yerrorbars lc rgb '{}' pt {} lw 2 title '{}'", v == 0 ? "" : ", ", v,
                        kColours[v], v + 4, name_of(kInterpolations[v]));
  }
  return gnuplot_svg(
      data + fmt::format("set logscale y\nset format y '10^{{%T}}'\nset grid y lc rgb '#c8c8c8'\nset key "
                         "outside top center horizontal\nset xtics ({})\nset xrange [0.4:{:.1f}]\nset yrange "
                         "[3e-6:1]\nset bmargin 4\nset "
                         "ylabel 'rms error / range: median, line to 90 %'\nplot {}\n",
                         tics, static_cast<double>(names.size()) + 0.6, plot),
      1180, 480);
}

struct Cost {
  Interpolation variant;
  int points;
  bool equidistant;
  double nanoseconds;
};

std::vector<Cost> costs() {
  std::vector<Cost> list;
  for (const Interpolation variant : kInterpolations)
    for (const int points : {31, 401})
      for (const bool equidistant : {true, false})
        if (equidistant || variant != Interpolation::sprague)
          list.push_back({variant, points, equidistant, nanoseconds_per_lookup(variant, points, equidistant)});
  return list;
}

std::string csv_of(const std::vector<Cost>& costs) {
  std::string csv = "variant,points,steps,ns_per_lookup\n";
  for (const Cost& c : costs)
    csv += fmt::format("{},{},{},{:.3g}\n", name_of(c.variant), c.points, c.equidistant ? "equal" : "unequal",
                       c.nanoseconds);
  return csv;
}

/// Error against cost in a table of 401 points: of optical constants with unequal steps, of the others with equal ones.
std::string speed_chart(const std::vector<ClassError>& classes, const std::vector<Cost>& costs) {
  const std::vector<std::string> names = class_names(classes);
  std::string data, plot;
  for (std::size_t n = 0; n < names.size(); ++n) {
    data += fmt::format("$d{} << EOD\n", n);
    const bool equal = !names[n].starts_with("optical-constants");
    for (std::size_t v = 0; v < std::size(kInterpolations); ++v)
      for (const Cost& cost : costs)
        if (cost.variant == kInterpolations[v] && cost.points == 401 && cost.equidistant == equal)
          if (const ClassError* c = result_of(classes, names[n], cost.variant))
            data += fmt::format("{:.4g} {:.4e} {}\n", cost.nanoseconds, c->median_rms, v + 4);
    data += "EOD\n";
    const char* colour = kColours[n % kColours.size()];
    plot += fmt::format(
        "{}$d{} using 1:2:3 with points pt variable ps 1.2 lw 2 lc rgb '{}' notitle, NaN with points pt "
        "7 lc rgb '{}' title '{}'",
        n == 0 ? "" : ", ", n, colour, colour, gnuplot_text(names[n]));
  }
  for (std::size_t v = 0; v < std::size(kInterpolations); ++v)
    plot += fmt::format(", NaN with points pt {} lc rgb '#000000' title '{}'", v + 4, name_of(kInterpolations[v]));
  return gnuplot_svg(data +
                         "set logscale xy\nset format y '10^{%T}'\nset grid lc rgb '#c8c8c8'\nset key outside right\n"
                         "set xlabel 'ns a lookup'\nset ylabel 'median rms error / range'\nset xrange "
                         "[1:2000]\nset yrange [3e-6:1]\nplot " +
                         plot + "\n",
                     1000, 520);
}

std::string text_of(const std::vector<LeaveOutError>& errors, const std::vector<ClassError>& classes) {
  int resampled_constants = 0, resampled_lamps = 0;
  for (const LeaveOutError* e : resampled_columns(errors)) {
    resampled_constants += e->data_class.starts_with("optical-constants");
    resampled_lamps += e->data_class == "illuminant";
  }
  std::string text = fmt::format(
      "# What interpolation loses\n\n"
      "Every second point of every table of the database is left out and predicted from the others. Errors are "
      "relative "
      "to the column's range\n(largest minus least value); the table shows the median, over the columns of a class, of "
      "the rms error. `gonio assess speed interpolation`\nsets it against the cost of a lookup. Steps here are twice "
      "those of the data, so that errors at the data's own steps are smaller.\nSprague stands for equidistant columns "
      "alone; classes.csv compares all variants on those.\n\n"
      "Set in bold: the default of single values of a class, the least median of the variants that take every column "
      "(to 2 %). Columns that their\nsources resampled linearly are left out, for they flatter linear: {} of "
      "optical constants, {} of lamps, and daylight's basis, which is defined\nas linear between its points. Between "
      "the lines of lamps all variants fail alike. Cubics may dip below 0 where the quantity cannot: single\nvalues "
      "are "
      "clipped there. Cost decides nothing but against barycentric rational functions: the others are piecewise "
      "polynomials, all looked up\nalike. Colour sums are linear between points for every class: that rule defines "
      "them.\n\n| class | columns |",
      resampled_constants, resampled_lamps);
  for (const Interpolation v : kInterpolations) text += fmt::format(" {} |", name_of(v));
  text += "\n|---|---|---|---|---|---|---|---|\n";
  for (const std::string& name : class_names(classes)) {
    text += fmt::format("| {} | {} |", name, result_of(classes, name, Interpolation::linear)->columns);
    for (const Interpolation v : kInterpolations) {
      const ClassError* c = result_of(classes, name, v);
      const std::string mark = v == default_interpolation(name) ? "**" : "";
      text += c ? fmt::format(" {}{:.2e}{} |", mark, c->median_rms, mark) : " |";
    }
    text += "\n";
  }
  return text + "\n![errors](errors.svg)\n";
}

std::vector<ClassError> write_errors(const std::filesystem::path& folder) {
  make_folder(folder);
  const std::vector<LeaveOutError> errors = leave_out_errors(Database::bundled());
  std::vector<ClassError> classes = errors_by_class(errors);
  write_file(folder / "errors.csv", csv_of(errors));
  write_file(folder / "classes.csv", csv_of(classes));
  write_file(folder / "errors.svg", error_chart(classes));
  write_file(folder / "README.md", text_of(errors, classes));
  return classes;
}

}  // namespace

void write_interpolation_errors(const std::filesystem::path& folder) { write_errors(folder); }

void write_interpolation_speed(const std::filesystem::path& folder) {
  const std::vector<ClassError> classes = write_errors(folder);
  const std::vector<Cost> measured = costs();
  write_file(folder / "speed.csv", csv_of(measured));
  write_file(folder / "speed.svg", speed_chart(classes, measured));
}

}  // namespace gonio
