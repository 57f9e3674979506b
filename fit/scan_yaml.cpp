#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <set>

#include "base/error.h"
#include "fit/scan.h"

namespace gonio {
namespace {

constexpr std::string_view kKeys =
    "name, source, licence, quantity, wavelength_nm, material, material_wavelength_nm, instrument, aperture_deg, "
    "uncertainty, sample";

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  return text;
}

/// One `key: value` of the file, with the place to name when it is wrong.
struct Value {
  const std::string& file;
  std::string key, text;
  int line;

  [[noreturn]] void refuse(std::string_view expected) const {
    throw input_error("{}:{}: {} is `{}`; expected {}", file, line, key, one_line(text.substr(0, 60)), expected);
  }
  double number(double lo, double hi, std::string_view expected) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= lo && value <= hi)) refuse(expected);
    return value;
  }
  std::string one_of(const std::set<std::string>& names, std::string_view expected) const {
    if (!names.contains(text)) refuse(expected);
    return text;
  }
};

void store(const Value& value, Measurement& scan) {
  const std::string& key = value.key;
  if (key == "name")
    scan.name = value.text;
  else if (key == "source")
    scan.source = value.text;
  else if (key == "licence")
    scan.licence = value.text;
  else if (key == "instrument")
    scan.instrument = value.text;
  else if (key == "uncertainty")
    scan.uncertainty = value.text;
  else if (key == "sample")
    scan.sample = value.text;
  else if (key == "material")
    scan.material = value.text;
  else if (key == "quantity")
    scan.quantity = value.one_of({"brdf", "brdf_cos", "reflectance_factor", "relative"},
                                 "brdf, brdf_cos, reflectance_factor or relative");
  else if (key == "wavelength_nm")
    scan.wavelength_nm = value.number(100, 1e5, "100 to 100000 nm");
  else if (key == "material_wavelength_nm")
    scan.material_wavelength_nm = value.number(100, 1e5, "100 to 100000 nm");
  else if (key == "aperture_deg")
    scan.aperture_deg = value.number(0, 90, "0 to 90 degrees");
  else
    throw input_error("{}:{}: unknown key `{}`; expected one of {}", value.file, value.line,
                      one_line(key.substr(0, 60)), kKeys);
}

/// Only plain keys and values are kept; a tag, an anchor or a nested value has no meaning here.
Measurement stored(const YAML::Node& root, const std::string& file) {
  if (!root.IsMap()) throw input_error("{}:1: is no list of `key: value` lines; expected {}", file, kKeys);
  Measurement scan;
  std::set<std::string> seen;
  for (const auto& pair : root) {
    const int line = std::max(0, pair.first.Mark().line) + 1;
    if (!pair.first.IsScalar())
      throw input_error("{}:{}: a key is no plain text; expected one of {}", file, line, kKeys);
    const std::string key = pair.first.Scalar();
    if (!seen.insert(key).second)
      throw input_error("{}:{}: `{}` appears twice; expected once", file, line, one_line(key.substr(0, 60)));
    if (pair.second.IsNull()) continue;  // `key:` alone = not stated
    if (!pair.second.IsScalar())
      throw input_error("{}:{}: {} is no plain text or number; expected one value", file, line,
                        one_line(key.substr(0, 60)));
    store({file, key, pair.second.Scalar(), line}, scan);
  }
  return scan;
}

}  // namespace

Measurement parse_measurement_yaml(const std::string& text, const std::string& file) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw input_error("{}:{}: is no YAML ({}); expected `key: value` lines", file, std::max(0, error.mark.line) + 1,
                      one_line(error.msg));
  }
  return stored(root, file);
}

}  // namespace gonio
