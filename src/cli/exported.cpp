#include "cli/exported.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.h"
#include "brdf/transmission.h"
#include "fit/formats/renderer_lobes.h"
#include "fit/formats/rgl.h"

namespace gonio::cli {
namespace {

constexpr double kFaint = 1e-4;  // of the grid's peak: below it nothing is compared

UnitVector<double> direction_deg(double theta, double phi) {
  const double p = phi * kPi<double> / 180;
  return {sin_deg(theta) * std::cos(p), sin_deg(theta) * std::sin(p), cos_deg(theta)};
}

double value_of_parameter(const ExportSource& source, std::string_view name) {
  return source.values[0][source.model.index_of(name)];
}

/// The lobe in the terms of Mitsuba and pbrt, where it is one of theirs.
struct Microfacets {
  bool ggx;
  double alpha_x, alpha_y;
};
bool smith(Shadowing shadowing) {
  return shadowing == Shadowing::smith_correlated || shadowing == Shadowing::smith_separable;
}

/// Empty: no microfacets of Beckmann or GGX with Smith's shadowing and Fresnel's F.
std::optional<Microfacets> microfacets_of(const ExportSource& source) {
  const ModelSpec& spec = source.model.first();
  if (spec.retro || !smith(spec.shadowing)) return {};
  const bool two_widths = spec.id == ModelId::ggx || spec.id == ModelId::beckmann;
  if (two_widths)
    return Microfacets{spec.id == ModelId::ggx, value_of_parameter(source, "alpha_x"),
                       value_of_parameter(source, "alpha_y")};
  if (spec.id != ModelId::torrance_sparrow) return {};
  const auto form = static_cast<FacetForm>(spec.form);
  if (form == FacetForm::schlick || form == FacetForm::schlick_d || form == FacetForm::schlick_f ||
      form == FacetForm::schlick_g)
    return {};
  const double alpha = kSqrt2<double> * source.values[0][0];
  return Microfacets{false, alpha, alpha};
}

bool is_lambert(const ExportSource& source) { return source.model.first().id == ModelId::lambert; }
double kd_of(const ExportSource& source) { return value_of_parameter(source, "kd"); }
double ks_of(const ExportSource& source) { return is_lambert(source) ? 0 : value_of_parameter(source, "ks"); }

/// "400:1.2, 500:1.1"
std::string spectrum(const ExportSource& source, double Interface<double>::*part, const char* between,
                     const char* after) {
  std::string text;
  for (std::size_t w = 0; w < source.surfaces.size(); ++w)
    text +=
        fmt::format("{}{}{}{:.9g}", w > 0 ? after : "", source.wavelengths_nm[w], between, source.surfaces[w].*part);
  return text;
}

/// A rough metal's refractive index as Mitsuba takes it: a spectrum, a number, or a perfect mirror.
std::string mitsuba_index(const ExportSource& source) {
  if (source.surfaces[0].perfect) return "  <string name=\"material\" value=\"none\"/>\n";
  const auto one = [&](const char* name, double Interface<double>::*part) {
    if (source.surfaces.size() == 1)
      return fmt::format("  <spectrum name=\"{}\" value=\"{:.9g}\"/>\n", name, source.surfaces[0].*part);
    return fmt::format("  <spectrum name=\"{}\" value=\"{}\"/>\n", name, spectrum(source, part, ":", ", "));
  };
  return one("eta", &Interface<double>::n) + one("k", &Interface<double>::k);
}

std::string indented(const std::string& text) {
  std::string out = "  ";
  for (std::size_t k = 0; k < text.size(); ++k) {
    out += text[k];
    if (text[k] == '\n' && k + 1 < text.size()) out += "  ";
  }
  return out;
}

/// Scene text and what the renderer makes of it.
struct Scene {
  std::string text, kind;
  BrdfOfPair f;
};

Scene mitsuba_diffuse(double reflectance) {
  return {
      fmt::format("<bsdf type=\"diffuse\">\n  <spectrum name=\"reflectance\" value=\"{}\"/>\n</bsdf>\n", reflectance),
      "diffuse", [reflectance](const auto&, const auto&, std::size_t) { return reflectance / kPi<double>; }};
}

Scene mitsuba_conductor(const ExportSource& source, const Microfacets& m, double scale) {
  std::string text = fmt::format(
      "<bsdf type=\"roughconductor\">\n  <string name=\"distribution\" value=\"{}\"/>\n  <float name=\"alpha_u\" "
      "value=\"{}\"/>\n"
      "  <float name=\"alpha_v\" value=\"{}\"/>\n",
      m.ggx ? "ggx" : "beckmann", m.alpha_x, m.alpha_y);
  text += mitsuba_index(source);
  if (scale != 1) text += fmt::format("  <float name=\"specular_reflectance\" value=\"{}\"/>\n", scale);
  const RendererLobe lobe = m.ggx ? RendererLobe::mitsuba_ggx : RendererLobe::mitsuba_beckmann;
  return {text + "</bsdf>\n", "roughconductor",
          [surfaces = source.surfaces, m, scale, lobe](const auto& i, const auto& o, std::size_t w) {
            return scale * renderer_lobe(lobe, i, o, m.alpha_x, m.alpha_y, surfaces[w]);
          }};
}

/// `share` of the first and 1 - `share` of the second.
BrdfOfPair blended(const BrdfOfPair& first, const BrdfOfPair& second, double share) {
  return [=](const auto& i, const auto& o, std::size_t w) {
    return share * first(i, o, w) + (1 - share) * second(i, o, w);
  };
}

/// Empty: only a table can say it.
std::optional<Scene> mitsuba_scene(const ExportSource& source) {
  if (!source.is_one_lobe()) return {};
  const double kd = kd_of(source), ks = ks_of(source);
  if (is_lambert(source)) return kd <= 1 ? std::optional(mitsuba_diffuse(kd)) : std::nullopt;
  const auto m = microfacets_of(source);
  if (!m || std::min(m->alpha_x, m->alpha_y) < 1e-4 || !(kd < 1) || !(ks > 0))
    return {};  // Mitsuba holds widths at 1e-4
  if (kd == 0) return mitsuba_conductor(source, *m, ks);
  const Scene metal = mitsuba_conductor(source, *m, ks / (1 - kd)), white = mitsuba_diffuse(1);
  return Scene{fmt::format("<bsdf type=\"blendbsdf\">\n  <float name=\"weight\" value=\"{}\"/>\n", kd) +
                   indented(metal.text) + indented(white.text) + "</bsdf>\n",
               "blendbsdf", blended(white.f, metal.f, kd)};
}

/// pbrt's index of a perfect mirror: the reflectance that it holds at 0.9999, n = 1, k = 2√R/√(1 - R).
ExportSource with_pbrt_index(ExportSource source) {
  for (Interface<double>& surface : source.surfaces)
    if (surface.perfect) surface = {1, 2 * std::sqrt(0.9999) / std::sqrt(1 - 0.9999), false};
  return source;
}

std::string pbrt_spectrum(const ExportSource& source, double Interface<double>::*part) {
  if (source.surfaces.size() > 1) return spectrum(source, part, " ", " ");
  return fmt::format("300 {0:.9g} 900 {0:.9g}", source.surfaces[0].*part);
}

std::string pbrt_conductor(const ExportSource& given, const Microfacets& m) {
  const ExportSource source = with_pbrt_index(given);
  return fmt::format(
      "\"spectrum eta\" [ {} ] \"spectrum k\" [ {} ]\n  \"float uroughness\" {} \"float vroughness\" {} \"bool "
      "remaproughness\" false",
      pbrt_spectrum(source, &Interface<double>::n), pbrt_spectrum(source, &Interface<double>::k), m.alpha_x, m.alpha_y);
}

std::string pbrt_grey(double value) {
  return fmt::format("\"spectrum reflectance\" [ 300 {0:.9g} 900 {0:.9g} ]", value);
}

/// pbrt's metals have no scale: it is a share of a mixture, the rest of which is diffuse (or black).
std::optional<Scene> pbrt_scene(const ExportSource& source) {
  if (!source.is_one_lobe()) return {};
  const double kd = kd_of(source), ks = ks_of(source);
  const BrdfOfPair white = [](const auto&, const auto&, std::size_t) { return 1 / kPi<double>; };
  if (is_lambert(source)) {
    if (kd > 1) return {};
    return Scene{"Material \"diffuse\" " + pbrt_grey(kd) + "\n", "diffuse", blended(white, white, 1 - kd)};
  }
  const auto m = microfacets_of(source);
  if (!m || !m->ggx || std::min(m->alpha_x, m->alpha_y) < 1e-3 || !(ks > 0) || kd + ks > 1)
    return {};  // smooth below 1e-3
  const BrdfOfPair metal = [surfaces = with_pbrt_index(source).surfaces, m = *m](const auto& i, const auto& o,
                                                                                 std::size_t w) {
    return renderer_lobe(RendererLobe::pbrt_ggx, i, o, m.alpha_x, m.alpha_y, surfaces[w]);
  };
  if (ks == 1) return Scene{"Material \"conductor\" " + pbrt_conductor(source, *m) + "\n", "conductor", metal};
  const double left = kd / (1 - ks);
  return Scene{fmt::format("MakeNamedMaterial \"metal\" \"string type\" \"conductor\" {}\nMakeNamedMaterial "
                           "\"diffuse\" \"string type\" \"diffuse\" {}\n"
                           "Material \"mix\" \"string materials\" [ \"diffuse\" \"metal\" ] \"float amount\" {}\n",
                           pbrt_conductor(source, *m), pbrt_grey(left), ks),
               "mix", [=](const auto& i, const auto& o, std::size_t w) {
                 return ks * metal(i, o, w) + (1 - ks) * left * white(i, o, w);
               }};
}

/// The largest share of the light that goes into a delta in the mirror direction, which no function of a pair of directions holds.
/// InputError where it is more than a hundredth, or where light is transmitted.
double delta_left_out(const ExportSource& source) {
  double most = 0;
  for (std::size_t w = 0; w < source.surfaces.size(); ++w) {
    const std::vector<Brdf<double>> lobes = make_brdfs(source.model, source.values_at(w));
    if (std::any_of(lobes.begin(), lobes.end(), transmits<double>))
      throw input_error("{}: transmits light; expected a model that only reflects", source.model.name());
    for (const double cos_i : {1.0, 0.5, 0.25, 0.1}) {
      double coherent = 0;
      for (const Brdf<double>& lobe : lobes)
        coherent += coherent_energy(lobe, cos_i, source.surfaces[w], source.wavelengths_nm[w] * 1e-3);
      most = std::max(most, coherent);
    }
  }
  constexpr double kMost = 0.01;
  if (most > kMost)
    throw input_error("{}: sends {:.3g} of the light into a delta in the mirror direction; expected at most {}",
                      source.model.name(), most, kMost);
  return most;
}

/// The table in the place of a scene's own model.
Scene table_scene(const ExportSource& source, ExportTarget target, const std::string& table_name,
                  std::string& table_bytes) {
  const RglTable table = make_rgl({source.f(), source.wavelengths_nm, source.described()});
  table_bytes = rgl_file(table);
  const auto read = std::make_shared<RglBrdf>(parse_rgl(table_bytes, table_name));
  Scene scene;
  scene.kind = target == ExportTarget::rgl ? "rgl" : "measured";
  scene.f = [read, nm = source.wavelengths_nm](const auto& i, const auto& o, std::size_t w) {
    return read->f(i, o, nm[w]);
  };
  if (target == ExportTarget::mitsuba)
    scene.text =
        fmt::format("<bsdf type=\"measured\">\n  <string name=\"filename\" value=\"{}\"/>\n</bsdf>\n", table_name);
  if (target == ExportTarget::pbrt)
    scene.text = fmt::format("Material \"measured\" \"string filename\" \"{}\"\n", table_name);
  return scene;
}

std::string without_double_dash(std::string text) {
  for (std::size_t at = text.find("--"); at != text.npos; at = text.find("--", at)) text.replace(at, 2, "- -");
  return text;
}

}  // namespace

BrdfOfPair ExportSource::f() const {
  std::vector<std::vector<Brdf<double>>> lobes;
  for (std::size_t w = 0; w < surfaces.size(); ++w) lobes.push_back(make_brdfs(model, values_at(w)));
  return [lobes, surfaces = surfaces, nm = wavelengths_nm](const auto& i, const auto& o, std::size_t w) {
    return evaluate(std::span<const Brdf<double>>(lobes[w]), reduce(i.x, i.y, i.z, o.x, o.y, o.z), surfaces[w],
                    nm[w] * 1e-3);
  };
}

std::string ExportSource::described() const {
  std::string text = fmt::format("gonio {}", model.name());
  for (const ModelSpec& spec : model.lobes()) {
    if (spec.form != 0) text += fmt::format(", variant {}", spec.variant());
    if (!spec.info().shadowings.empty()) text += fmt::format(", shadowing {}", name_of(spec.shadowing));
  }
  for (std::size_t k = 0; k < model.parameters().size(); ++k) {
    const ParameterInfo& parameter = model.parameters()[k];
    text += fmt::format(", {} {:.9g}", parameter.name, values[0][k]);
    const auto differs = [&](const std::vector<double>& list) { return list[k] != values[0][k]; };
    if (std::any_of(values.begin(), values.end(), differs))
      for (std::size_t w = 1; w < values.size(); ++w) text += fmt::format(" {:.9g}", values[w][k]);
    if (parameter.unit != "1") text += fmt::format(" {}", parameter.unit);
  }
  return text + fmt::format(", {}, at {} nm", material, fmt::join(wavelengths_nm, " "));
}

std::string ExportError::described() const {
  std::string text = fmt::format(
      "Against gonio's own: rms of log10 f {:.2g}, largest {:.2g}, of the {} values above {} of the peak (theta_i and "
      "theta_o 0 to 75 degrees by 7.5, phi by 15, phi_i by 30); ",
      rms_log10, largest_log10, pairs, kFaint);
  if (vanishing > 0) text += fmt::format("{} more vanish; ", vanishing);
  if (delta > 1e-6)
    text += fmt::format("a delta in the mirror direction, at most {:.2g} of the light, is left out; ", delta);
  return text + fmt::format("Delta E 2000 on a lit sphere (D65 at 45 degrees): mean {:.2g}, largest {:.2g}",
                            sphere.mean, sphere.largest);
}

ExportError export_error(const ExportSource& source, const BrdfOfPair& shown) {
  const BrdfOfPair exact = source.f();
  std::vector<std::pair<double, double>> values;
  double peak = 0;
  for (double phi_i = 0; phi_i <= 90; phi_i += 30)
    for (double theta_i = 0; theta_i <= 75; theta_i += 7.5)
      for (double theta_o = 0; theta_o <= 75; theta_o += 7.5)
        for (double phi = 0; phi <= 180; phi += 15)
          for (std::size_t w = 0; w < source.wavelengths_nm.size(); ++w) {
            const UnitVector<double> i = direction_deg(theta_i, phi_i), o = direction_deg(theta_o, phi_i + phi);
            values.emplace_back(exact(i, o, w), shown(i, o, w));
            peak = std::max(peak, values.back().first);
          }
  ExportError error;
  double sum = 0;
  for (const auto& [f, g] : values) {
    if (!(f > kFaint * peak)) continue;
    if (!(g > kFaint * kFaint * peak)) {
      ++error.vanishing;
      continue;
    }
    const double ratio = std::log10(g / f);
    sum += ratio * ratio;
    error.largest_log10 = std::max(error.largest_log10, std::abs(ratio));
    ++error.pairs;
  }
  error.rms_log10 = error.pairs > 0 ? std::sqrt(sum / static_cast<double>(error.pairs)) : 0;
  error.sphere = sphere_difference(exact, shown, source.wavelengths_nm);
  return error;
}

Exported exported(const ExportSource& source, ExportTarget target, const std::string& table_name) {
  const double delta = delta_left_out(source);
  std::optional<Scene> scene;
  if (target == ExportTarget::mitsuba) scene = mitsuba_scene(source);
  if (target == ExportTarget::pbrt) scene = pbrt_scene(source);
  Exported out;
  if (!scene) scene = table_scene(source, target, table_name, out.table);
  out.kind = scene->kind;
  out.error = export_error(source, scene->f);
  out.error.delta = delta;
  const std::string about = source.described() + "\n     " + out.error.described();
  if (target == ExportTarget::mitsuba)
    out.text = fmt::format("<!-- {} -->\n{}", without_double_dash(about), scene->text);
  if (target == ExportTarget::pbrt)
    out.text = fmt::format("# {}\n# {}\n{}", source.described(), out.error.described(), scene->text);
  return out;
}

}  // namespace gonio::cli
