#include "assess/conservation_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/conservation_charts.h"
#include "base/files.h"
#include "energy/compensation.h"
#include "energy/energy_table.h"
#include "image/png.h"
#include "materials/database.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kNamed{"F = 1", "Ag", "Al", "Au", "Cu", "Zn", "Fe", "W", "Zr"};
constexpr double kSpheresExposure = 0.6, kRoomsExposure = 0.5, kFurnaceExposure = 0.7;

/// A limit never rounds up.
double down(double limit) { return std::floor(limit * 1e4) / 1e4; }

std::string_view name_of(const MetalLimits& one) { return conservation_models()[one.model].name; }

const SlopeLimits& nearest(const MetalLimits& one, double slope_rms) {
  return *std::ranges::min_element(one.over_slopes, {},
                                   [&](const SlopeLimits& at) { return std::abs(std::log(at.slope_rms / slope_rms)); });
}

std::string limits_csv(const std::vector<MetalLimits>& all) {
  std::string csv =
      "model,metal,data,lo_nm,hi_nm,m,max_E,theta_deg,wavelength_nm,ks_max,kd_max_ks_1,kd_max_ks_0.5,turning_kd_ks_0."
      "5\n";
  for (const MetalLimits& one : all)
    for (const SlopeLimits& at : one.over_slopes) {
      const std::vector<double>& nm = one.metal->samples.wavelength_nm;
      csv +=
          fmt::format("{},{},{},{:g},{:g},{:.4g},{:.5f},{:.0f},{:g},{:.4f},{:.4f},{:.4f},{:.4f}\n", name_of(one),
                      one.metal->symbol, one.metal->id, nm.front(), nm.back(), at.slope_rms, at.largest_e, at.theta_deg,
                      at.wavelength_nm, down(at.ks_max), down(at.kd_max), down(at.kd_max_at_half), at.turning_kd);
    }
  return csv;
}

std::string rooms_csv(const std::vector<RoomMean>& means) {
  std::string csv = "ks_over_ks_max,max_depth,mean_radiance,least,most\n";
  for (const RoomMean& room : means)
    csv += fmt::format("{:g},{},{:.2g},{:.3g},{:.3g}\n", room.factor, room.max_depth, room.mean, room.least, room.most);
  return csv;
}

const MetalLimits& find(const std::vector<MetalLimits>& all, std::size_t model, std::string_view symbol) {
  return *std::ranges::find_if(
      all, [&](const MetalLimits& one) { return one.model == model && one.metal->symbol == symbol; });
}

std::string limits_table(const std::vector<MetalLimits>& all, std::size_t model) {
  std::string text = "| |", line = "|---|";
  constexpr double kShown[]{0.01, 0.05, 0.1, 0.2, 0.5, 1, 2};
  for (const double m : kShown) text += fmt::format(" m = {:.3g} |", nearest(all.front(), m).slope_rms), line += "---|";
  text += '\n' + line + '\n';
  for (const std::string_view symbol : kNamed) {
    const MetalLimits& one = find(all, model, symbol);
    text += fmt::format("| {} |", symbol);
    for (const double m : kShown) text += fmt::format(" {:.4f} |", down(nearest(one, m).ks_max));
    text += '\n';
  }
  return text;
}

std::string behaviour_table(const std::vector<MetalSurface>& metals) {
  std::string text = "| | turns diffuse at kd | kd_max (ks = 0.5) | |\n|---|---|---|---|\n";
  for (const MetalSurface& metal : metals) {
    if (std::ranges::find(kNamed, std::string_view(metal.symbol)) == kNamed.end()) continue;
    const SlopeLimits at = slope_limits(conservation_models()[0], 0.2, metal);
    text += fmt::format("| {} | {:.4f} | {:.4f} | {} |\n", metal.symbol, at.turning_kd, down(at.kd_max_at_half),
                        at.turning_kd < at.kd_max_at_half ? "either" : "always specular");
  }
  return text;
}

std::string rooms_table(const std::vector<RoomMean>& means) {
  std::string text = "| ks / ks_max |", line = "|---|";
  for (const int depth : kRoomDepths) text += fmt::format(" {} reflections |", depth), line += "---|";
  text += '\n' + line;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (i == 0 || means[i].factor != means[i - 1].factor) text += fmt::format("\n| {:g} |", means[i].factor);
    text += fmt::format(" {:.2g} ({:.2g} to {:.2g}) |", means[i].mean, means[i].least, means[i].most);
  }
  return text + '\n';
}

/// What single scattering reflects of uniform light, and with what is given back, at one wavelength.
std::string compensation_table() {
  std::string text = "| | Ē, single scattering | with what it loses given back |\n|---|---|---|\n";
  const Lobe<double> lobe = conservation_models()[1].lobe(kCompensatedSlope);
  for (const char* id : {"perfect", "Ag", "Cu"}) {
    constexpr double kGreen_nm = 550;
    const SpectralSurface surface{{SurfaceMaterial(id).at(kGreen_nm)}, {kGreen_nm / 1000}};
    const LobeEnergy energy(lobe, surface);
    const Compensation compensation(lobe, surface);
    const ReflectanceCurve given_back = ReflectanceCurve::of([&](double c) { return compensation.reflectance(0, c); });
    text += fmt::format("| {} | {:.3f} | {:.3f} |\n", std::string_view(id) == "perfect" ? "F = 1" : id,
                        energy.at(0).mean(), energy.at(0).mean() + given_back.mean());
  }
  return text;
}

std::string limits_text(const std::vector<MetalSurface>& metals, const std::vector<MetalLimits>& all) {
  const SlopeLimits white = slope_limits(conservation_models()[0], 1, metals.front());
  std::string symbols, hard;
  for (std::size_t i = 1; i < metals.size(); ++i) {
    symbols += (i > 1 ? " " : "") + metals[i].symbol;
    if (metals[i].node_error > 0) hard += (hard.empty() ? "" : ", ") + metals[i].symbol;
  }
  return fmt::format(
             "# What kd and ks may be\n\n"
             "No more light may leave a surface than arrives: kd·ρ_d + ks·E(θ, λ) <= 1 at every incidence and "
             "wavelength (Maillot 1996, eq. (43)); ρ_d is R0 in\n"
             "`pseudo-realistic`, 1 elsewhere. E is that of the tables that the build makes, {} to {} nm in steps of "
             "{} nm as far as the data reach. Every limit is lowered by the\n"
             "tables' error ({:g} in E; more for {}, whose R no polynomial of the tables follows) and rounded "
             "down, so that what is printed conserves. All of it: "
             "[limits.csv](limits.csv). For any other material: `gonio table limits`.\n\n"
             "The {} metals are the metallic elements whose symbol names optical constants of the database: {}.\n\n"
             "## ks alone\n\n"
             "`pseudo-realistic` multiplies R by P, which is no density over solid angle: E is about √(2π)·m·R for "
             "gentle slopes, so that ks may be 40 at m = 0.01, and\n"
             "exceeds 1 for steep ones. With F = 1 and m = 1, E reaches {:.4f} at {:.0f}°, and ks <= {:.4f}. F = 1 "
             "bounds every metal. E at grazing is where nearly all are worst,\n"
             "and R there is close to 1 for each: metals differ little while m is small.\n\n"
             "![Largest ks, pseudo-realistic](ks-pseudo-realistic.svg)\n\n",
             kVisibleLo_nm, kVisibleHi_nm, kVisibleStep_nm, EnergyTable::kError, hard, metals.size() - 1, symbols,
             white.largest_e, white.theta_deg, down(white.ks_max)) +
         limits_table(all, 0) +
         "\n`torrance-sparrow` has a normalised density and Smith's masking: E <= max R, so that ks = 1 is "
         "safe for every metal (for F = 1 less the tables' error), and what more there may be is what R loses.\n\n"
         "![Largest ks, torrance-sparrow](ks-torrance-sparrow.svg)\n\n" +
         limits_table(all, 1);
}

std::string behaviour_text(const std::vector<MetalSurface>& metals, const MetalLimits& gold) {
  const SlopeLimits at = slope_limits(conservation_models()[0], 0.2, *gold.metal);
  return fmt::format(
             "\n## kd beside ks\n\n"
             "A material behaves diffusely where kd·min R0 > ks·max E, else specularly (§III.8). Gold at m = 0.2 with "
             "ks "
             "= 0.5 turns diffuse at kd = {:.4f}, and breaks (43)\n"
             "beyond kd = {:.4f}. On rougher gold the limit comes first: no diffuse behaviour is left that conserves "
             "energy.\n\n"
             "![Behaviour of gold](behaviour-gold.svg)\n\nThe same at m = 0.2, ks = 0.5:\n\n",
             at.turning_kd, down(at.kd_max_at_half)) +
         behaviour_table(metals);
}

double worst_error(const std::vector<RoomMean>& means) {
  double worst = 0;
  for (const RoomMean& room : means) worst = std::max(worst, room.error / room.mean);
  return worst;
}

std::string rooms_text(const std::vector<RoomMean>& means) {
  return fmt::format(
             "\n## Inside, at and beyond the limit\n\n"
             "`pseudo-realistic`, F = 1, m = {:g}, where E hardly depends on the incidence ({:.4f} is ks_max). A "
             "closed "
             "room of nothing but this material, whose walls shine 1:\n"
             "the mean radiance at the eye, in brackets what it must lie between, Σ (ks·E)^n with the least and the "
             "largest E over the incidence. Inside the limit the light settles;\n"
             "beyond it each reflection adds more than the last, and the image is as bright as paths are long. "
             "Standard errors of "
             "the means: up to {:.0f} %.\n\n",
             kRoomSlope, down(slope_limits(conservation_models()[0], kRoomSlope, white_facets()).ks_max),
             100 * worst_error(means)) +
         rooms_table(means) +
         "\n![Mean radiance of a closed room](rooms.svg)\n\n"
         "Rooms and spheres of this material under one lamp, all with one exposure. Rows: ks = 0.6, 1 and 1.2 ks_max; "
         "columns: at most 4, 16 and 64 reflections.\n"
         "Beyond the limit the image floods white.\n\n![Rooms of the material](rooms.png)\n\n"
         "One object beyond the limit does not flood a room whose walls (Lambert, 0.9) take more than it adds, but "
         "shines like a lamp: ks = 0.6, 1, 1.2, 1.5 ks_max.\n\n![Spheres in a white room](spheres.png)\n\n"
         "`gonio render` refuses such materials unless it is told `--energy allow-gain`.\n";
}

std::string compensation_text() {
  return fmt::format(
             "\n## What single scattering loses\n\n"
             "Conserving is not enough: light that meets a second facet is lost to `torrance-sparrow` (m = {:g}). In "
             "uniform light, F = 1, silver and copper; above as they are,\n"
             "below with `compensation: kulla-conty-2017`. F = 1 then vanishes before the background, as it must (but "
             "for what its neighbour takes); "
             "copper is brighter and redder, for light reflected twice is coloured twice. Of uniform light at 550 "
             "nm:\n\n",
             kCompensatedSlope) +
         compensation_table() + "\n![Without and with compensation](compensation.png)\n";
}

}  // namespace

void write_conservation_limits(const fs::path& folder, const std::function<void(const std::string&)>& progress) {
  make_folder(folder);
  progress("limits");
  const std::vector<MetalSurface> metals = conservation_metals();
  const std::vector<MetalLimits> all = metal_limits(metals);
  for (std::size_t model = 0; model < conservation_models().size(); ++model)
    write_file(folder / fmt::format("ks-{}.svg", conservation_models()[model].name),
               ks_chart(std::span(all).subspan(model * metals.size(), metals.size()), kNamed));
  const MetalLimits& gold = find(all, 0, "Au");
  write_file(folder / "behaviour-gold.svg", behaviour_chart(gold));
  write_file(folder / "limits.csv", limits_csv(all));
  progress("rooms");
  const std::vector<RoomMean> means = room_means();
  write_file(folder / "rooms.svg", room_chart(means));
  write_file(folder / "rooms.csv", rooms_csv(means));
  write_png(folder / "rooms.png", rooms_of_the_material(), kRoomsExposure);
  progress("spheres");
  write_png(folder / "spheres.png", spheres_in_white_room(), kSpheresExposure);
  write_png(folder / "compensation.png", compensated_spheres(), kFurnaceExposure);
  write_file(folder / "README.md",
             limits_text(metals, all) + behaviour_text(metals, gold) + rooms_text(means) + compensation_text());
}

}  // namespace gonio
