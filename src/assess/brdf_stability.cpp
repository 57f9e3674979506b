#include "assess/brdf_stability.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "energy/directional_reflectance.h"

namespace gonio {
namespace {

BrdfPoint rounded_point(BrdfPoint p, Precision precision) {
  for (double& value : p.values) value = rounded(value, precision);
  for (UnitVector<double>* v : {&p.i, &p.o})
    *v = {rounded(v->x, precision), rounded(v->y, precision), rounded(v->z, precision)};
  p.surface.n = rounded(p.surface.n, precision), p.surface.k = rounded(p.surface.k, precision);
  p.wavelength_um = rounded(p.wavelength_um, precision);
  return p;
}

double error_of(double f, double exact, double faintest) {
  if (!std::isfinite(f) || f < 0) return INFINITY;
  return exact > faintest ? std::abs(f - exact) / exact : -1;
}

EnergyMap energy_map(std::string name, std::string label, double lo, double hi,
                     const std::function<Lobe<double>(double)>& lobe) {
  EnergyMap map{std::move(name), {std::move(label), lo, hi}, 14, 13, {}};
  map.cells.resize(map.columns * map.rows);
  tbb::parallel_for(std::size_t(0), map.cells.size(), [&](std::size_t cell) {
    const double x = map.x.at(double(cell % map.columns) / double(map.columns - 1));
    const double theta = cell / map.columns == map.rows - 1 ? 89 : 7.5 * double(cell / map.columns);
    const SpectralSurface mirror{{perfect_interface<double>()}, {0.55}};
    map.cells[cell] = {x, theta, directional_reflectance(lobe(std::pow(10, x)), theta, mirror, 1e-4).front().value};
  });
  return map;
}

}  // namespace

BrdfPoint sweep_point(const StabilitySweep& sweep, double x, double y, Precision precision) {
  return rounded_point(sweep.point(x, y), precision);
}

StabilityMap stability_map(const StabilitySweep& sweep, std::size_t columns, std::size_t rows) {
  StabilityMap map{columns, rows, std::vector<StabilityCell>(columns * rows)};
  tbb::parallel_for(std::size_t(0), map.cells.size(), [&](std::size_t c) {
    const double x = sweep.x.at(double(c % columns) / double(columns - 1)),
                 y = sweep.y.at(double(c / columns) / double(rows - 1));
    map.cells[c] = {x, y, {}};
    for (const Precision precision : {Precision::single, Precision::twofold}) {
      const bool single = precision == Precision::single;
      const BrdfPoint point = rounded_point(sweep.point(x, y), precision);
      const double exact = reference_values(sweep.spec, {&point, 1}).front(), faintest = single ? 1e-30 : 1e-290;
      const double published = (single ? sweep.published_single : sweep.published_double)(point);
      const auto path = single ? NumberPath::float_lanes : NumberPath::double_scalar;
      const double ours = own_evaluator(sweep.spec, path)({&point, 1}).front();
      map.cells[c].error[single ? 0 : 2] = error_of(published, exact, faintest);
      map.cells[c].error[single ? 1 : 3] = error_of(ours, exact, faintest);
    }
  });
  return map;
}

bool fails(const StabilitySweep& sweep, const StabilityCell& cell, std::size_t panel) {
  const double bar =
      panel < 2 ? error_bar(sweep.spec, Precision::single).faint : error_bar(sweep.spec, Precision::twofold).bright;
  return cell.error[panel] > bar;
}

std::vector<EnergyMap> energy_maps() {
  const std::string slope = "log_{10} slope rms m", alpha = "log_{10} alpha",
                    height = "log_{10} sigma/lambda, T = 10 lambda";
  std::vector<EnergyMap> maps;
  maps.push_back(energy_map("pseudo-realistic", slope, -2, 0.5,
                            [](double m) { return Lobe<double>(PseudoRealistic<double>{m}); }));
  maps.push_back(energy_map("torrance-sparrow smith-correlated", slope, -2, 0.5,
                            [](double m) { return Lobe<double>(TorranceSparrow<double>{std::sqrt(2.0) * m}); }));
  maps.push_back(energy_map("torrance-sparrow none", slope, -2, 0.5, [](double m) {
    return Lobe<double>(TorranceSparrow<double>{std::sqrt(2.0) * m, Shadowing::none});
  }));
  maps.push_back(
      energy_map("cook-torrance-1981", alpha, -2, 0.5, [](double a) { return Lobe<double>(CookTorrance<double>{a}); }));
  maps.push_back(energy_map("ward-duer-2006", alpha, -2, 0.5, [](double a) {
    return Lobe<double>(Ward<double>{a, a, WardForm::duer_2006});
  }));
  maps.push_back(energy_map("beckmann-kirchhoff", height, -2, 0.5, [](double s) {
    return Lobe<double>(BeckmannKirchhoff<double>{0.55 * s, 5.5});
  }));
  return maps;
}

std::string eval_line(const ModelSpec& spec, const BrdfPoint& at, std::string_view precision) {
  std::string line = fmt::format("printf 'ix,iy,iz,ox,oy,oz\\n{},{},{},{},{},{}\\n' | gonio eval {}", at.i.x, at.i.y,
                                 at.i.z, at.o.x, at.o.y, at.o.z, spec.info().name);
  for (std::size_t p = 0; p < at.values.size(); ++p)
    line += fmt::format(" --set {}={}", spec.info().parameters[p].name, at.values[p]);
  if (!spec.info().shadowings.empty()) line += fmt::format(" --set shadowing={}", name_of(spec.shadowing));
  if (spec.retro) line += " --set retro=yes";
  if (spec.form > 0) line += fmt::format(" --variant {}", spec.variant());
  if (at.surface.perfect)
    line += " --material perfect";
  else
    line += fmt::format(" --n {} --k {}", at.surface.n, at.surface.k);
  return line + fmt::format(" --at {} --precision {}", at.wavelength_um * 1000, precision);
}

}  // namespace gonio
