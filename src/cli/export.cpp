#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/exported.h"
#include "cli/subject.h"

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ExportArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::string target, out;
  std::vector<double> at_nm;
};

/// Those asked for, sorted; else where the material is known of 380 to 720 nm by 20; else the fit's own; else one.
std::vector<double> wavelengths_of(const Subject& subject, std::vector<double> asked) {
  if (!asked.empty()) {
    std::sort(asked.begin(), asked.end());
    asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
    for (double& nm : asked) nm = subject.wavelength_for(nm);
    return asked;
  }
  const bool database = subject.surface.needs_wavelength();
  if (!subject.needs_wavelength()) return {550};
  if (subject.fitted && (!database || subject.is_spectral()) && !subject.fitted->wavelength_nm.empty())
    return subject.fitted->wavelength_nm;
  const double lo = database ? subject.surface.material().range_lo_nm() : 0,
               hi = database ? subject.surface.material().range_hi_nm() : 1e9;
  std::vector<double> all;
  for (double nm = 380; nm <= 720; nm += 20)
    if (nm >= lo && nm <= hi) all.push_back(nm);
  if (all.empty())
    throw input_error("{}: is not known between 380 and 720 nm; expected --at NM", subject.surface.name());
  return all;
}

ExportSource source_of(const Subject& subject, const std::vector<double>& asked_nm) {
  ExportSource source{subject.model.sum, {}, wavelengths_of(subject, asked_nm), {}, subject.surface.name()};
  for (const double nm : source.wavelengths_nm) {
    source.surfaces.push_back(subject.surface.at(nm));
    if (subject.is_spectral() || source.values.empty()) source.values.push_back(subject.values_at(nm));
  }
  return source;
}

ExportTarget target_of(const std::string& name) {
  return name == "rgl" ? ExportTarget::rgl : name == "mitsuba" ? ExportTarget::mitsuba : ExportTarget::pbrt;
}

void run_export(const ExportArguments& arguments, const Common& common) {
  const ExportSource source = source_of(make_subject(arguments.model, arguments.surface), arguments.at_nm);
  const ExportTarget target = target_of(arguments.target);
  fs::path table = arguments.out;
  if (target != ExportTarget::rgl) table.replace_extension(".bsdf");
  if (target != ExportTarget::rgl && table == fs::path(arguments.out))
    throw input_error("--out {}: ends in .bsdf, as the table beside it would; expected another ending", arguments.out);
  const Exported made = exported(source, target, table.filename().string());
  if (!made.table.empty()) write_file(table, made.table);
  if (target != ExportTarget::rgl) write_file(arguments.out, made.text);
  if (common.json) {
    Json answer{{"to", arguments.target},
                {"kind", made.kind},
                {"out", arguments.out},
                {"table", made.table.empty() ? Json(nullptr) : Json(table.string())},
                {"wavelength_nm", source.wavelengths_nm},
                {"rms_log10", made.error.rms_log10},
                {"largest_log10", made.error.largest_log10},
                {"values", made.error.pairs},
                {"vanishing", made.error.vanishing},
                {"delta_left_out", made.error.delta},
                {"delta_e_2000", {{"mean", made.error.sphere.mean}, {"largest", made.error.sphere.largest}}}};
    std::cout << answer.dump(2) << '\n';
  } else {
    std::cout << made.kind << ": " << source.described() << '\n' << made.error.described() << '\n';
  }
}

}  // namespace

void add_export(CLI::App& app, Common& common) {
  auto* command =
      app.add_subcommand("export", "Write a fit or a model for another renderer, and say what that costs in accuracy");
  command->footer(
      "Example: gonio export out/fit.json --to mitsuba -o material.xml\n"
      "rgl: a .bsdf table of the RGL database's kind, which Mitsuba's and pbrt's `measured` materials read.\n"
      "mitsuba: a <bsdf> of Mitsuba 3: diffuse, roughconductor (ggx, beckmann) or a blend of both. pbrt: a Material of "
      "pbrt-v4: diffuse, conductor\n"
      "(GGX) or a mix. Other models, sums of lobes, and kd or ks that differ between wavelengths become `measured`, "
      "with the table beside the file (same name, .bsdf).\n"
      "A header states rms log10 and Delta E 2000 of what the renderer evaluates against gonio's own. Models with a "
      "delta, or that\n"
      "transmit, are refused.");
  add_common(*command, common);
  auto arguments = std::make_shared<ExportArguments>();
  arguments->model.add_to(*command);
  arguments->surface.add_to(*command);
  command->add_option("--to", arguments->target, "rgl, mitsuba or pbrt")
      ->required()
      ->check(CLI::IsMember({"rgl", "mitsuba", "pbrt"}));
  command->add_option("-o,--out", arguments->out, "The file to write")->required();
  command->add_option("--at", arguments->at_nm,
                      "Wavelengths in nm (default: 380 to 720 by 20 where the material is known, or the fit's)");
  command->callback([&common, arguments] { run_export(*arguments, common); });
}

}  // namespace gonio::cli
