#include "assess/table_stability.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "energy/lobe_energy.h"

namespace gonio {
namespace {

/// The middles of cells, `columns` × `rows` of them, even in the grid's coordinates.
std::vector<TablePlace> middles(const EnergyTable& table, std::size_t columns, std::size_t rows) {
  const EnergyGrid fine{2 * rows + 1, 2 * columns + 1, table.grid().widest};
  std::vector<TablePlace> places;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) places.push_back({fine.cos_theta(2 * c + 1), fine.alpha(2 * r + 1)});
  return places;
}

std::vector<WorstOfSurfaces> errors_at(const EnergyTable& table, const std::vector<TablePlace>& places) {
  const auto& surfaces = common_surfaces();
  std::vector<NodeValues> r;
  for (const JudgingSurface& one : surfaces) r.push_back(reflectance_at_nodes(table.family().lobe(0.5), one.interface));
  const std::vector<std::vector<double>> truth = true_reflectances(table.family(), places, surfaces);
  std::vector<WorstOfSurfaces> errors;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const NodeValues w = table.weights(places[p].cos_theta, places[p].alpha);
    WorstOfSurfaces worst{places[p]};
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (const double error = std::abs(sum_of_products(w, r[s]) - truth[p][s]); error > worst.error)
        worst.error = error, worst.surface = s;
    errors.push_back(worst);
  }
  return errors;
}

WorstOfSurfaces worst_of(const std::vector<WorstOfSurfaces>& all) {
  return *std::max_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.error < b.error; });
}

/// Of one width, incidences at the middles of cells.
std::vector<TablePlace> along_incidence(const EnergyTable& table, double alpha, std::size_t count) {
  std::vector<TablePlace> places = middles(table, count, 1);
  for (TablePlace& one : places) one.alpha = alpha;
  return places;
}
std::vector<TablePlace> along_width(const EnergyTable& table, double cos_theta, std::size_t count) {
  std::vector<TablePlace> places = middles(table, 1, count);
  for (TablePlace& one : places) one.cos_theta = cos_theta;
  return places;
}

void take_larger(SurfaceBeyond& of, const SurfaceBeyond& other) {
  for (double SurfaceBeyond::*error : {&SurfaceBeyond::table_error, &SurfaceBeyond::library_error,
                                       &SurfaceBeyond::stated, &SurfaceBeyond::judge_error})
    of.*error = std::max(of.*error, other.*error);
}

SpectralSurface spectrum_of(std::span<const JudgingSurface> surfaces) {
  SpectralSurface spectrum;
  for (const JudgingSurface& one : surfaces)
    spectrum.interfaces.push_back(one.interface), spectrum.wavelength_um.push_back(0.55);
  return spectrum;
}

/// The extreme surfaces with what the nodes make of them.
class Extremes {
 public:
  explicit Extremes(const Lobe<double>& lobe) {
    for (const JudgingSurface& one : extreme_surfaces()) {
      r_.push_back(reflectance_at_nodes(lobe, one.interface));
      node_error_.push_back(node_error(lobe, one.interface, r_.back()));
    }
  }

  std::vector<SurfaceBeyond> unjudged() const {
    std::vector<SurfaceBeyond> all;
    for (std::size_t s = 0; s < r_.size(); ++s) all.push_back({extreme_surfaces()[s].name, node_error_[s]});
    return all;
  }

  /// Largest errors over places of one width.
  std::vector<SurfaceBeyond> judged(const EnergyTable& table, std::span<const TablePlace> places) const {
    constexpr double kLargestAngle_deg = 89.99;  // of the judge
    const Lobe<double> lobe = table.family().lobe(places.front().alpha);
    const SpectralSurface spectrum = spectrum_of(extreme_surfaces());
    std::vector<LobeEnergy> library;
    for (const JudgingSurface& one : extreme_surfaces()) library.emplace_back(lobe, spectrum_of({&one, 1}));
    std::vector<SurfaceBeyond> all = unjudged();
    for (const TablePlace& at : places) {
      if (at.theta_deg() > kLargestAngle_deg) continue;
      const std::vector<Estimate> truth = directional_reflectance(lobe, at.theta_deg(), spectrum, 1e-7);
      const NodeValues w = table.weights(at.cos_theta, at.alpha);
      for (std::size_t s = 0; s < r_.size(); ++s)
        take_larger(all[s],
                    {"", 0, std::abs(sum_of_products(w, r_[s]) - truth[s].value),
                     std::abs(library[s].at(0)(at.cos_theta) - truth[s].value), library[s].error(), truth[s].error});
    }
    return all;
  }

 private:
  std::vector<NodeValues> r_;
  std::vector<double> node_error_;
};

}  // namespace

TableMap table_map(const EnergyTable& table, std::size_t columns, std::size_t rows) {
  return {&table, columns, rows, errors_at(table, middles(table, columns, rows))};
}

std::vector<TableEdge> table_edges(const EnergyTable& table, std::size_t places) {
  std::vector<TableEdge> edges;
  for (const auto& [name, cosine] : {std::pair("θ 0", 1.0),
                                     {"θ 89°", cos_deg(89.0)},
                                     {"θ 89.99°", cos_deg(89.99)},
                                     {"cos θ 1e-5", 1e-5},
                                     {"cos θ 1e-6", 1e-6}})
    edges.push_back({name, worst_of(errors_at(table, along_width(table, cosine, places)))});
  for (const auto& [name, alpha] : {std::pair("alpha 0.01", kNarrowestAlpha),
                                    {"alpha 0.0102", 0.0102},
                                    {"alpha √2", std::sqrt(2.0)},
                                    {"last alpha", table.grid().widest}})
    edges.push_back({name, worst_of(errors_at(table, along_incidence(table, alpha, places)))});
  return edges;
}

std::vector<BeyondBox> beyond_box(const EnergyTable& table, std::size_t widths, std::size_t incidences) {
  std::vector<BeyondBox> all;
  const auto add = [&](double from, double to) {
    for (std::size_t i = 0; i < widths; ++i) {
      const double alpha = from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(widths - 1));
      all.push_back({alpha, worst_of(errors_at(table, along_incidence(table, alpha, incidences))).error});
    }
  };
  add(0.1 * kNarrowestAlpha, kNarrowestAlpha), add(table.grid().widest, 10);
  return all;
}

std::vector<SurfaceBeyond> surfaces_beyond(const std::vector<const EnergyTable*>& tables, std::size_t side) {
  const Extremes extremes(tables.front()->family().lobe(0.5));
  std::vector<SurfaceBeyond> all = extremes.unjudged();
  for (const EnergyTable* table : tables) {
    const std::vector<TablePlace> places = middles(*table, side, side);
    std::vector<std::vector<SurfaceBeyond>> rows(side);  // a width each
    tbb::parallel_for(std::size_t{0}, side, [&](std::size_t row) {
      rows[row] = extremes.judged(*table, std::span(places).subspan(row * side, side));
    });
    for (const auto& row : rows)
      for (std::size_t s = 0; s < all.size(); ++s) take_larger(all[s], row[s]);
  }
  return all;
}

}  // namespace gonio
