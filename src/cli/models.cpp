#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "brdf/polarised.h"
#include "cli/commands.h"
#include "fit/published_parameters.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Of the model's first variant.
std::string_view polarisation_of(const ModelInfo& info) {
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters) values.push_back(p.fallback.value_or(p.fit_lo));
  return name_of(polarisation_law(make_brdf<double>({info.id}, values)));
}

Json describe(const ModelInfo& info) {
  Json parameters = Json::array();
  for (const ParameterInfo& p : info.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"meaning", p.meaning},
                          {"range", {p.lo, p.hi}},
                          {"fit_range", {p.fit_lo, p.fit_hi}},
                          {"default", p.fallback ? Json(*p.fallback) : Json(nullptr)}});
  return {{"name", info.name},
          {"summary", info.summary},
          {"formula", info.formula},
          {"source", info.source},
          {"parameters", parameters},
          {"shadowing", info.shadowings},
          {"variants", info.variants},
          {"needs_wavelength", info.needs_wavelength},
          {"polarisation", polarisation_of(info)},
          {"claims",
           {{"reciprocal", info.reciprocal},
            {"conserving", info.conserving},
            {"bounded_at_grazing", info.bounded_at_grazing},
            {"variants_not_reciprocal", info.variants_not_reciprocal}}}};
}

void print_card(const ModelInfo& info) {
  fmt::print("{}: {}\n  {}\n  source: {}\n", info.name, info.summary, info.formula, info.source);
  for (const ParameterInfo& p : info.parameters)
    fmt::print("  {:<15} {:<3} [{:g}, {:g}]  {}; {}\n", p.name, p.unit, p.lo, p.hi, p.meaning,
               p.fallback ? fmt::format("default {:g}", *p.fallback) : "no default");
  if (!info.shadowings.empty())
    fmt::print("  shadowing       {} (default {})\n", fmt::join(info.shadowings, ", "), name_of(ModelSpec{}.shadowing));
  fmt::print("  variants        {}\n", fmt::join(info.variants, ", "));
  const std::string exceptions = info.variants_not_reciprocal.empty()
                                     ? ""
                                     : fmt::format(" (variant {}: not)", fmt::join(info.variants_not_reciprocal, ", "));
  fmt::print("  polarisation    {}\n", polarisation_of(info));
  fmt::print("  claims          {}{}, {}, {}{}\n\n", info.reciprocal ? "reciprocal" : "not reciprocal", exceptions,
             info.conserving ? "conserving for kd + ks <= 1" : "not conserving by itself (see `gonio table limits`)",
             info.bounded_at_grazing ? "bounded at grazing" : "unbounded at grazing",
             info.needs_wavelength ? "; needs the wavelength" : "");
}

/// `published`: the tables; `published:TABLE`: its materials.
void print_published(std::string_view name, bool json) {
  Json all = Json::array();
  const auto colon = name.find(':');
  if (colon == name.npos) {
    for (const PublishedTable& table : published_tables())
      all.push_back(
          {{"table", table.name}, {"model", table.model}, {"variant", table.variant}, {"shadowing", table.shadowing}});
  } else {
    for (const PublishedFit& fit : read_published(published_table(name.substr(colon + 1)))) {
      Json one{{"material", fit.material}, {"channel", fit.channel}, {"model", fit.spec.info().name}};
      for (std::size_t i = 0; i < fit.values.size(); ++i)
        one[std::string(fit.spec.info().parameters[i].name)] = fit.values[i];
      if (!fit.surface.perfect) one["n"] = fit.surface.n;
      all.push_back(one);
    }
  }
  if (json) {
    std::cout << all.dump(2) << '\n';
    return;
  }
  for (const Json& one : all) {
    std::string line;
    for (const auto& [key, value] : one.items())
      line += fmt::format("{}{} {}", line.empty() ? "" : ", ", key, value.dump());
    fmt::print("{}\n", line);
  }
}

}  // namespace

void add_models(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("models", "Models, parameters with units and ranges, variants, claims");
  command->footer(
      "Example: gonio models torrance-sparrow\nPublished fits of measured materials: gonio models published, gonio "
      "models "
      "published:ngan-ward,\nthen gonio eval published:ngan-ward/blue-acrylic/g");
  add_common(*command, common);
  auto name = std::make_shared<std::string>();
  command->add_option("name", *name, "One model only");
  command->callback([&common, name] {
    if (name->starts_with("published")) return print_published(*name, common.json);
    if (!name->empty()) {
      const ModelInfo& info = model(*name);
      if (common.json)
        std::cout << describe(info).dump(2) << '\n';
      else
        print_card(info);
      return;
    }
    if (common.json) {
      Json all = Json::array();
      for (const ModelInfo& info : models()) all.push_back(describe(info));
      std::cout << all.dump(2) << '\n';
      return;
    }
    for (const ModelInfo& info : models()) print_card(info);
  });
}

}  // namespace gonio::cli
