#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/number.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "fit/profile.h"
#include "surface/instrument.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SurfaceStatisticsArguments {
  std::string profile, detrend = "line", wavelengths = "400,550,700", out;
  std::optional<double> stylus_um, optical_um;
};

Json to_json(const Estimate& e) {
  return {{"value", e.value}, {"interval95", e.interval95 ? Json{e.interval95->first, e.interval95->second} : Json(nullptr)}};
}

std::string line_of(const char* name, const Estimate& e, const char* unit, const char* meaning) {
  const std::string interval =
      e.interval95 ? fmt::format("[{:.4g}, {:.4g}]", e.interval95->first, e.interval95->second) : "too few stretches";
  return fmt::format("{:<22} {:>11.5g} {:<5} {:<24} {}\n", name, e.value, unit, interval, meaning);
}

Detrend detrend_from(const std::string& name) {
  if (name == "mean") return Detrend::mean;
  return name == "parabola" ? Detrend::parabola : Detrend::line;
}

/// Heights in half-sigma bins, beside the Gaussian of the same sigma.
std::string histogram_csv(const std::vector<HeightProfile>& profiles, double sigma_um) {
  constexpr int kBins = 17;  // -4.25 to 4.25 sigma
  std::vector<std::size_t> counts(kBins);
  std::size_t total = 0;
  for (const HeightProfile& profile : profiles)
    for (const double z : profile.z_um) {
      const double bin = std::floor(z / (0.5 * sigma_um) + 0.5 * kBins);
      ++total;
      if (bin >= 0 && bin < kBins) ++counts[static_cast<std::size_t>(bin)];
    }
  std::string text = "z_um,count,gaussian_count\n";
  for (int bin = 0; bin < kBins; ++bin) {
    const double s = 0.5 * (bin - kBins / 2), half = 0.25 / std::sqrt(2.0);
    const double share = 0.5 * (std::erf(s / std::sqrt(2.0) + half) - std::erf(s / std::sqrt(2.0) - half));
    text += fmt::format("{},{},{}\n", s * sigma_um, counts[static_cast<std::size_t>(bin)], share * static_cast<double>(total));
  }
  return text;
}

std::string autocorrelation_csv(const Roughness& r, double step_um) {
  std::string text = "lag_um,autocorrelation,gaussian\n";
  for (std::size_t j = 0; j < r.autocorrelation.size(); ++j) {
    const double lag = static_cast<double>(j) * step_um;
    text += fmt::format("{},{},{}\n", lag, r.autocorrelation[j], std::exp(-square(lag / r.correlation_um.value)));
  }
  return text;
}

std::vector<HeightProfile> seen_by_instrument(std::vector<HeightProfile> profiles, const SurfaceStatisticsArguments& arguments) {
  for (HeightProfile& profile : profiles) {
    if (arguments.stylus_um) profile = stylus_trace(profile, *arguments.stylus_um);
    if (arguments.optical_um) profile = averaged(profile, *arguments.optical_um);
  }
  return profiles;
}

/// What is wrong with the heights as a whole is said of the file they came from.
Roughness roughness_of_file(const std::vector<HeightProfile>& profiles, const std::string& file) {
  try {
    return roughness_of(profiles);
  } catch (const InputError& error) {
    const std::string_view what = error.what(), prefix = "profile:";
    throw input_error("{}:{}", file, what.starts_with(prefix) ? what.substr(prefix.size()) : what);
  }
}

void run_surface(const SurfaceStatisticsArguments& arguments, const Common& common) {
  const std::vector<double> wavelengths_nm = number_list(arguments.wavelengths, "--wavelengths", 1, 1e6);
  std::vector<HeightProfile> profiles =
      seen_by_instrument(parse_profiles(read_file(arguments.profile), arguments.profile), arguments);
  for (HeightProfile& profile : profiles) profile = detrended(profile, detrend_from(arguments.detrend));
  const Roughness r = roughness_of_file(profiles, arguments.profile);
  const double sigma_um = r.sigma_um.value, step_um = profiles.front().step_um;
  if (!arguments.out.empty()) {
    make_folder(arguments.out);
    write_file(std::filesystem::path(arguments.out) / "histogram.csv", histogram_csv(profiles, sigma_um));
    write_file(std::filesystem::path(arguments.out) / "autocorrelation.csv", autocorrelation_csv(r, step_um));
  }
  Json rayleigh = Json::array();
  std::string text = line_of("sigma_um", r.sigma_um, "um", "rms height") +
                     line_of("correlation_um", r.correlation_um, "um", "T, 1/e of the autocorrelation") +
                     line_of("m", r.slope_rms, "1", "rms slope of the profile") +
                     line_of("curvature_per_um", r.curvature_per_um, "1/um", "rms curvature") +
                     line_of("radius_um", r.radius_um, "um", "radius of curvature, 1/curvature");
  text += fmt::format("of a Gaussian autocorrelation: m = {:.5g}, alpha = {:.5g}, curvature = {:.5g} 1/um\n", r.gaussian_slope,
                      std::sqrt(2.0) * r.gaussian_slope, r.gaussian_curvature_per_um);
  text += fmt::format("autocorrelation: rms difference {:.3g} from exp(-tau^2/T^2)\nheights: skewness {:.3g}, excess kurtosis {:.3g}; "
                      "chance of moments as far from a Gaussian's: {:.3g}\n",
                      r.autocorrelation_misfit, r.skewness, r.excess_kurtosis, r.gaussian_p);
  text += "Rayleigh's criterion, sigma against lambda/(8 cos theta):\n";
  for (const double nm : wavelengths_nm) {
    const double angle = rayleigh_angle_deg(nm / 1000, sigma_um), height = rayleigh_height_um(nm / 1000, 0);
    rayleigh.push_back({{"wavelength_nm", nm}, {"smooth_height_um_at_normal", height}, {"smooth_above_theta_deg", angle}});
    text += fmt::format("  {:g} nm: smooth below {:.4g} um at the normal; this surface is smooth {}\n", nm, height,
                        angle > 0 ? fmt::format("above {:.2f} deg", angle) : "at every angle");
  }
  for (const std::string& warning : r.warnings) text += fmt::format("warning: {}\n", warning);
  if (!common.json) {
    std::cout << text;
    return;
  }
  std::cout << Json{{"profile", arguments.profile}, {"profiles", profiles.size()}, {"step_um", step_um}, {"detrend", arguments.detrend},
                    {"sigma_um", to_json(r.sigma_um)}, {"correlation_um", to_json(r.correlation_um)}, {"m", to_json(r.slope_rms)},
                    {"curvature_per_um", to_json(r.curvature_per_um)}, {"radius_um", to_json(r.radius_um)},
                    {"gaussian_m", r.gaussian_slope}, {"gaussian_curvature_per_um", r.gaussian_curvature_per_um},
                    {"skewness", r.skewness}, {"excess_kurtosis", r.excess_kurtosis}, {"gaussian_p", r.gaussian_p},
                    {"autocorrelation_misfit", r.autocorrelation_misfit}, {"rayleigh", rayleigh}, {"warnings", r.warnings}}
                   .dump(2)
            << '\n';
}

}  // namespace

void add_surface(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("surface", "Roughness of height profiles: sigma, T, m, curvature, Rayleigh's criterion");
  command->footer("Example: gonio surface profile.csv --detrend line --wavelengths 450,550,650 --out out/surface\n"
                  "Columns: x_um, z_um (or _nm, _mm) at equal steps[, profile]. Intervals are 95 %, from stretches of the profile;\n"
                  "their counted coverage is 92-95 % at 200 T or longer, 86-92 % at 60 T. --stylus-radius-um and --optical-width-um\n"
                  "show what such an instrument would have drawn of this profile. --out writes histogram.csv, autocorrelation.csv.");
  add_common(*command, common);
  auto arguments = std::make_shared<SurfaceStatisticsArguments>();
  command->add_option("profile", arguments->profile, "CSV file of heights")->required();
  command->add_option("--detrend", arguments->detrend, "What is taken off first")
      ->check(CLI::IsMember({"mean", "line", "parabola"}))->capture_default_str();
  command->add_option("--wavelengths", arguments->wavelengths, "Wavelengths in nm for Rayleigh's criterion")->capture_default_str();
  command->add_option("--stylus-radius-um", arguments->stylus_um, "Trace of a tip of this radius")->check(CLI::Range(1e-3, 1e4));
  command->add_option("--optical-width-um", arguments->optical_um, "Average under exp(-x^2/w^2)")->check(CLI::Range(1e-3, 1e4));
  command->add_option("-o,--out", arguments->out, "Folder for the histogram and the autocorrelation");
  command->callback([&common, arguments] { run_surface(*arguments, common); });
}

}  // namespace gonio::cli
