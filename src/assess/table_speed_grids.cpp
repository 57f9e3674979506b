// Lookups on a grid of E: the library's cubic beside its rivals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assess/table_speed.h"
#include "assess/timing.h"
#include "brdf/lanes.h"

namespace gonio {
namespace {

/// Taps as CubicTaps has them (energy/energy_grid.h).
struct LinearTaps {
  static constexpr std::size_t kCount = 2;
  std::size_t first;
  std::array<float, kCount> weight;

  LinearTaps(float place, std::size_t count) {
    const float below = std::clamp(std::floor(place), 0.0F, static_cast<float>(count - kCount));
    first = static_cast<std::size_t>(below);
    weight = {1 - (place - below), place - below};
  }
};

/// Smooth through the middle two; beyond the ends the values go on straight.
struct CatmullRomTaps {
  static constexpr std::size_t kCount = 4;
  std::size_t first;
  std::array<float, kCount> weight;

  CatmullRomTaps(float place, std::size_t count) {
    const float below = std::clamp(std::floor(place), 0.0F, static_cast<float>(count - 2)), t = place - below;
    const std::array<float, kCount> w{t * (t - 0.5F * (1 + t * t)), 1 + t * t * (1.5F * t - 2.5F),
                                      t * (0.5F + t * (2 - 1.5F * t)), 0.5F * t * t * (t - 1)};
    first = static_cast<std::size_t>(below);
    if (first == 0) {
      weight = {w[1] + 2 * w[0], w[2] - w[0], w[3], 0};
    } else if (first + 2 == count) {
      first -= 2, weight = {0, w[0], w[1] - w[3], w[2] + 2 * w[3]};
    } else {
      first -= 1, weight = w;
    }
  }
};

/// As SurfaceEnergyTable::reflectances(): places in lanes, taps one by one.
template <class Taps>
void look_up(const EnergyGrid& grid, const std::vector<float>& known, std::span<const float> cos_theta,
             std::span<const float> alpha, std::span<float> e) {
  constexpr std::size_t kLanes = FloatLanes::size;
  alignas(64) std::array<float, kLanes> c{}, w{};
  for (std::size_t from = 0; from < e.size(); from += kLanes) {
    const std::size_t count = std::min(kLanes, e.size() - from);
    std::copy_n(&cos_theta[from], count, c.begin());
    std::copy_n(&alpha[from], count, w.begin());
    grid.column_of(FloatLanes::load_aligned(c.data())).store_aligned(c.data());
    grid.row_of(FloatLanes::load_aligned(w.data())).store_aligned(w.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Taps row(w[i], grid.rows), column(c[i], grid.columns);
      const float* at = &known[row.first * grid.columns + column.first];
      float sum = 0;
      for (std::size_t r = 0; r < Taps::kCount; ++r, at += grid.columns) {
        float along = 0;
        for (std::size_t t = 0; t < Taps::kCount; ++t) along += column.weight[t] * at[t];
        sum += row.weight[r] * along;
      }
      e[from + i] = sum;
    }
  }
}

struct Asked {
  std::vector<float> cos_theta, alpha, e;
  explicit Asked(std::span<const TablePlace> places) : e(places.size()) {
    for (const TablePlace& one : places)
      cos_theta.push_back(static_cast<float>(one.cos_theta)), alpha.push_back(static_cast<float>(one.alpha));
  }
};

NodeValues nodes_of(const EnergyTable& table, std::size_t surface) {
  return reflectance_at_nodes(table.family().lobe(0.5), common_surfaces()[surface].interface);
}

using Lookup = std::function<void(Asked&)>;

/// A row of a table; errors are those of the places.
TableSpeedRow row_of(const EnergyTable& table, std::string way, std::string setting, double bytes, double ns,
                     std::vector<double> errors, std::span<const TablePlace> places) {
  const ErrorSpread spread = spread_of(std::move(errors));
  return {std::string(table.family().name),        std::move(way), std::move(setting),  bytes / 1024,
          ns / static_cast<double>(places.size()), spread,         places[spread.worst]};
}
std::string setting_of(const EnergyGrid& grid) { return fmt::format("{} x {}", grid.rows, grid.columns); }
double bytes_of(const EnergyGrid& grid) { return static_cast<double>(grid.rows * grid.columns * sizeof(float)); }

/// Errors from a lookup made for each surface in turn, time from that of the last.
TableSpeedRow judged_row(const EnergyTable& table, const JudgedPlaces& judged, std::string way,
                         const std::function<Lookup(const NodeValues& r)>& made) {
  Asked asked(judged.places);
  std::vector<double> errors(judged.places.size(), 0);
  Lookup lookup;
  for (std::size_t s = 0; s < common_surfaces().size(); ++s) {
    lookup = made(nodes_of(table, s));
    lookup(asked);
    for (std::size_t p = 0; p < errors.size(); ++p)
      errors[p] = std::max(errors[p], std::abs(double(asked.e[p]) - judged.e[p][s]));
  }
  const double ns = least_ns([&] { lookup(asked), keep(asked.e[0]); });
  return row_of(table, std::move(way), setting_of(table.grid()), bytes_of(table.grid()), ns, std::move(errors),
                judged.places);
}

template <class Taps>
std::function<Lookup(const NodeValues&)> rival(const EnergyTable& table) {
  return [&table](const NodeValues& r) -> Lookup {
    return [grid = table.grid(), e = table.values(r)](Asked& asked) {
      look_up<Taps>(grid, e, asked.cos_theta, asked.alpha, asked.e);
    };
  };
}

/// The curve of each place's width, asked there; the time is that of one curve asked at every place.
TableSpeedRow curve_row(const EnergyTable& table, const JudgedPlaces& judged) {
  std::vector<double> errors(judged.places.size(), 0);
  for (std::size_t s = 0; s < common_surfaces().size(); ++s) {
    const NodeValues r = nodes_of(table, s);
    for (std::size_t p = 0; p < errors.size(); ++p) {
      const TablePlace& at = judged.places[p];
      errors[p] = std::max(errors[p], std::abs(table.curve(at.alpha, r)(at.cos_theta) - judged.e[p][s]));
    }
  }
  Asked asked(judged.places);
  const ReflectanceCurve curve = table.curve(0.3, nodes_of(table, 0));
  const double ns = least_ns([&] { curve.at(asked.cos_theta, asked.e), keep(asked.e[0]); });
  return row_of(table, "table of one width, cubic", fmt::format("{}", table.grid().columns),
                static_cast<double>(curve.values().size_bytes()), ns, std::move(errors), judged.places);
}

TableSpeedRow material_row(const EnergyTable& table, const JudgedPlaces& judged) {
  const std::size_t surfaces = common_surfaces().size();
  std::vector<NodeValues> r;
  for (std::size_t s = 0; s < surfaces; ++s) r.push_back(nodes_of(table, s));
  std::vector<double> errors(judged.places.size(), 0);
  for (std::size_t p = 0; p < errors.size(); ++p) {
    const NodeValues w = table.weights(judged.places[p].cos_theta, judged.places[p].alpha);
    for (std::size_t s = 0; s < surfaces; ++s)
      errors[p] = std::max(errors[p], std::abs(sum_of_products(w, r[s]) - judged.e[p][s]));
  }
  const double ns = least_ns([&] {
    for (const TablePlace& at : judged.places) {
      const double e = sum_of_products(table.weights(at.cos_theta, at.alpha), r[0]);
      keep(e);
    }
  });
  return row_of(table, "table of every material, cubic", fmt::format("{} x {}", setting_of(table.grid()), kCosNodes),
                static_cast<double>(table.bytes()), ns, std::move(errors), judged.places);
}

}  // namespace

JudgedPlaces::JudgedPlaces(const LobeFamily& of, std::size_t count)
    : family(&of), places(random_table_places(of.widest, count)), e(true_reflectances(of, places, common_surfaces())) {}

std::vector<TableSpeedRow> grid_rows(const EnergyTable& table, const JudgedPlaces& judged) {
  const auto library = [&](const NodeValues& r) -> Lookup {
    return
        [one = SurfaceEnergyTable(table, r)](Asked& asked) { one.reflectances(asked.cos_theta, asked.alpha, asked.e); };
  };
  return {judged_row(table, judged, "table, cubic", library),
          judged_row(table, judged, "table, linear", rival<LinearTaps>(table)),
          judged_row(table, judged, "table, Catmull-Rom", rival<CatmullRomTaps>(table))};
}

std::vector<TableSpeedRow> other_table_rows(const EnergyTable& table, const JudgedPlaces& judged) {
  return {curve_row(table, judged), material_row(table, judged)};
}

TableSpeedRow white_row(const EnergyTable& table, const JudgedPlaces& judged) {
  std::vector<TablePlace> places;
  std::vector<double> truth, errors;
  for (std::size_t p = 0; p < judged.places.size(); ++p)
    if (judged.places[p].alpha <= 1) places.push_back(judged.places[p]), truth.push_back(judged.e[p][0]);
  Asked asked(places);
  const SurfaceEnergyTable white(table, nodes_of(table, 0));
  const double ns = least_ns([&] { white.reflectances(asked.cos_theta, asked.alpha, asked.e), keep(asked.e[0]); });
  for (std::size_t p = 0; p < truth.size(); ++p) errors.push_back(std::abs(double(asked.e[p]) - truth[p]));
  return row_of(table, "gonio", setting_of(table.grid()), bytes_of(table.grid()), ns, std::move(errors), places);
}

}  // namespace gonio
