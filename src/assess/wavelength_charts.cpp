#include "assess/wavelength_charts.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "assess/wavelength_nodes.h"
#include "base/error.h"
#include "base/files.h"
#include "fit/gnuplot.h"
#include "spectrum/wavelength_rules.h"

namespace gonio {
namespace {

constexpr int kCounts[] = {4, 5, 6, 7, 8, 9, 10, 12, 14, 16};
constexpr int kRuleCounts[] = {4, 6, 8, 10, 12, 14, 16, 20, 24, 32, 40, 50, 64};
constexpr const char* kLights[] = {"D65", "A", "FL11"};
constexpr int kMostLampNodes = 20;
constexpr double kLampTolerance = 0.1;

/// The cases the page quotes, how many starts the thorough search gets for each, and what a plain local search over
/// whole nanometres was known to reach at two bounces (0: nothing known).
struct Quoted {
  const char* light;
  int bounces, count, starts;
  double known;
};
constexpr Quoted kQuoted[] = {{"D65", 2, 8, 12, 0.50}, {"A", 2, 8, 12, 0.33}, {"FL11", 2, 10, 24, 0.09},
                              {"D65", 3, 8, 40, 0},    {"A", 3, 8, 8, 0},     {"FL11", 3, 10, 24, 0}};

struct Rule {
  WavelengthRule rule;
  const char* name;
};
constexpr Rule kRules[] = {{WavelengthRule::uniform, "uniform"},
                           {WavelengthRule::gauss_legendre, "Gauss-Legendre"},
                           {WavelengthRule::observer, "proportional to the observer"}};

struct Point {
  std::string light, method;
  int bounces = 0;
  std::size_t nodes = 0;
  double worst = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<FoundNodes> search(bool thorough, const std::function<void(const std::string&)>& progress,
                               std::string& timing) {
  std::vector<FoundNodes> found;
  const auto add = [&](const std::string& light, int bounces, const char* how, const auto& choose) {
    const auto start = std::chrono::steady_clock::now();
    const SceneProducts products(reference_scene(light), bounces);
    found.push_back({light, bounces, how, choose(products)});
    timing += fmt::format("{},{},{},{},{:.3f}\n", light, bounces, how, found.back().nodes.nodes_nm.size(),
                          seconds_since(start));
  };
  for (const char* light : kLights)
    for (const int count : kCounts)
      add(light, 2, "quick", [&](const SceneProducts& products) { return choose_wavelengths(products, count); });
  for (const std::string& light : reference_lamps()) {
    progress(light);
    add(light, 3, "fewest",
        [&](const SceneProducts& products) { return fewest_wavelengths(products, kLampTolerance, kMostLampNodes); });
  }
  for (const Quoted& q : kQuoted) {
    if (!thorough) continue;
    progress(fmt::format("{}, {} bounces, {} nodes: {} starts", q.light, q.bounces, q.count, q.starts));
    WavelengthSearch search;
    search.thorough_starts = q.starts;
    add(q.light, q.bounces, "thorough",
        [&](const SceneProducts& products) { return choose_wavelengths(products, q.count, search); });
  }
  return found;
}

/// Every error of the page, computed from nodes and weights alone.
std::vector<Point> errors_of(const std::vector<FoundNodes>& found) {
  std::map<std::pair<std::string, int>, std::vector<const FoundNodes*>> scenes;
  for (const FoundNodes& f : found) scenes[{f.light, f.bounces}].push_back(&f);
  const std::vector<std::pair<std::pair<std::string, int>, std::vector<const FoundNodes*>>> list(scenes.begin(),
                                                                                                 scenes.end());
  std::vector<std::vector<Point>> points(list.size());
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t s) {
    const auto& [light, bounces] = list[s].first;
    const SpectralScene scene = reference_scene(light);
    const SceneProducts products(scene, bounces);
    for (const FoundNodes* f : list[s].second)
      points[s].push_back(
          {light, f->how, bounces, f->nodes.nodes_nm.size(), node_differences(products, f->nodes).maxCoeff()});
    if (bounces != 2) return;
    for (const Rule& rule : kRules)
      for (const int count : kRuleCounts)
        points[s].push_back({light, rule.name, bounces, static_cast<std::size_t>(count),
                             rule_weights(products, scene.observer, rule.rule, count).worst_e2000});
  });
  std::vector<Point> all;
  for (const auto& part : points) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::string csv_of(const std::vector<Point>& points) {
  std::string csv = "light,bounces,method,nodes,worst_delta_E_2000\n";
  for (const Point& p : points)
    csv += fmt::format("{},{},{},{},{:.5f}\n", p.light, p.bounces, p.method, p.nodes, p.worst);
  return csv;
}

std::string panel(const std::vector<Point>& points, const std::string& light) {
  std::string data, plot;
  int number = 0;
  const auto series = [&](const std::string& method, const char* title, const char* style) {
    const std::string name = fmt::format("$d_{}_{}", light, number++);
    data += name + " << EOD\n";
    for (const Point& p : points)
      if (p.light == light && p.bounces == 2 && p.method == method)
        data += fmt::format("{} {:.5f}\n", p.nodes, p.worst);
    data += "EOD\n";
    plot += fmt::format("{}{} with {} title '{}'", plot.empty() ? "" : ", ", name, style, title);
  };
  series("quick", "chosen for the scene", "linespoints lc rgb '#D55E00' pt 7 lw 3");
  if (std::any_of(points.begin(), points.end(), [](const Point& p) { return p.method == "thorough"; }))
    series("thorough", "the same, thorough search", "points lc rgb '#000000' pt 3 ps 1.4 lw 2");
  series("uniform", "uniform", "linespoints lc rgb '#0072B2' pt 4 lw 2");
  series("Gauss-Legendre", "Gauss-Legendre", "linespoints lc rgb '#009E73' pt 6 lw 2");
  series("proportional to the observer", "proportional to the observer", "linespoints lc rgb '#CC79A7' pt 8 lw 2");
  return data + fmt::format("set title 'under {}'\nplot {}\n", gnuplot_text(light), plot);
}

std::string chart(const std::vector<Point>& points) {
  std::string script =
      "set multiplot layout 1,3\nset logscale xy\nset xrange [3.6:70]\nset yrange [0.03:100]\nset xtics (4, 6, 8, 12, "
      "16, 24, 32, 64)\nset grid lc rgb '#c8c8c8'\nset xlabel 'nodes' offset 0,0.5\nset ylabel 'worst ΔE_{2000}'\nset "
      "key "
      "outside bottom center maxrows 5\n";
  for (const char* light : kLights) script += panel(points, light);
  return gnuplot_svg(script + "unset multiplot\n", 1280, 560);
}

std::string quoted_table(const std::vector<Point>& points) {
  std::string text =
      "| light | bounces | nodes | worst ΔE_2000, quick | thorough | known before |\n|---|---|---|---|---|---|\n";
  for (const Quoted& q : kQuoted) {
    const auto cell = [&](const char* method) -> std::string {
      for (const Point& p : points)
        if (p.light == q.light && p.bounces == q.bounces && p.nodes == static_cast<std::size_t>(q.count) &&
            p.method == method)
          return fmt::format("{:.3f}", p.worst);
      return "";
    };
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", q.light, q.bounces, q.count, cell("quick"),
                        cell("thorough"), q.known > 0 ? fmt::format("{:.2f}", q.known) : "");
  }
  return text;
}

std::string lamps_text(const std::vector<Point>& points) {
  std::map<std::size_t, int> lamps;
  std::string beyond;
  int count = 0;
  for (const Point& p : points) {
    if (p.method != "fewest") continue;
    ++count;
    if (p.worst <= kLampTolerance && p.nodes <= 16)
      ++lamps[p.nodes];
    else
      beyond += fmt::format("{}{} ({}: {:.3f})", beyond.empty() ? "" : ", ", p.light, p.nodes, p.worst);
  }
  std::string text = fmt::format(
      "Every light of the database ({}), three bounces, worst ΔE_2000 within {:g}, quick "
      "search (errors.csv, `fewest`):\n\n| nodes |",
      count, kLampTolerance);
  std::string rule = "|---|", row = "| lights |";
  for (const auto& [nodes, number] : lamps)
    text += fmt::format(" {} |", nodes), rule += "---|", row += fmt::format(" {} |", number);
  return text + "\n" + rule + "\n" + row + "\n\n" +
         (beyond.empty() ? "None needs more than 16.\n"
                         : "More than 16 by the quick search (nodes: what they reach): " + beyond + ".\n");
}

void write_page(const std::vector<FoundNodes>& found, const std::filesystem::path& folder) {
  make_folder(folder);
  const std::vector<Point> points = errors_of(found);
  write_file(folder / "nodes.csv", nodes_csv(found));
  write_file(folder / "errors.csv", csv_of(points));
  write_file(folder / "errors.svg", chart(points));
  write_file(
      folder / "README.md",
      "# As few wavelengths as the scene needs\n\n"
      "The scene: the 24 ColorChecker patches (Ohta) and gold, silver, copper, aluminium and iron at normal "
      "incidence, with all their products of two\nbounces (464 spectra) or three (4,959), observer CIE 1931. "
      "Nodes and non-negative weights are chosen together so that the worst ΔE_2000\nagainst the sum at 1 nm, "
      "its white for both, is least; spectra after one bounce more count half. The rules that do not know the "
      "scene are\njudged by a white of their own, which flatters them. nodes.csv holds all nodes and weights "
      "(of radiance, lamp scaled to at most 1); `gonio\nreport wavelengths` computes every error from it again, "
      "`gonio assess speed wavelengths --thorough` searches. Searches end in different places: `thorough` stands for "
      "the best nodes that any\nlong search has found so far, `quick` for what choose_wavelengths finds in about "
      "0.1 s. `known before`: a plain local search over whole\nnanometres, two bounces.\n\n" +
          quoted_table(points) + "\n" + lamps_text(points) + "\n![nodes against error](errors.svg)\n");
}

}  // namespace

void search_wavelengths(const std::filesystem::path& folder, bool thorough,
                        const std::function<void(const std::string&)>& progress) {
  std::string timing = "light,bounces,search,nodes,seconds_with_products\n";
  const std::vector<FoundNodes> found = search(thorough, progress, timing);
  write_page(found, folder);
  write_file(folder / "timing.csv", timing);
}

void write_wavelength_errors(const std::filesystem::path& from, const std::filesystem::path& folder) {
  write_page(read_nodes(from / "nodes.csv"), folder);
}

}  // namespace gonio
