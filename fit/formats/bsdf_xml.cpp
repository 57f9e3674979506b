#include "fit/formats/bsdf_xml.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <vector>

#include "base/error.h"
#include "base/number.h"

namespace gonio {
namespace {

constexpr std::size_t kMostPoints = 100'000;
constexpr int kDeepest = 24;  // halvings of a tree: a square of 2⁻²⁴ is below any measurement

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= 32) text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= 32) text.remove_suffix(1);
  return text;
}

/// The file and the document made of it: every complaint names its line.
struct Document {
  std::string_view text;
  const std::string& file;
  pugi::xml_document xml;

  std::ptrdiff_t line_at(std::ptrdiff_t offset) const {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
    return 1 + std::count(text.begin(), end, '\n');
  }
  std::ptrdiff_t line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

  pugi::xml_node child(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node found = parent.child(name);
    if (!found)
      throw input_error("{}:{}: <{}> has no <{}>; expected one", file, line_of(parent), shown(parent.name()), name);
    return found;
  }
  /// The text of an element that holds nothing else.
  std::string_view content(const pugi::xml_node& node) const {
    const pugi::xml_node inside = node.first_child();
    if (!inside || inside.next_sibling() || inside.type() != pugi::node_pcdata)
      throw input_error("{}:{}: <{}> holds no plain text; expected text alone", file, line_of(node),
                        shown(node.name()));
    return inside.value();
  }
  std::string_view word(const pugi::xml_node& parent, const char* name) const {
    return trimmed(content(child(parent, name)));
  }
  double number(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node node = child(parent, name);
    const std::string_view digits = trimmed(content(node));
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      throw input_error("{}:{}: <{}> is `{}`; expected a finite number", file, line_of(node), name, shown(digits));
    return value;
  }
};

/// Numbers and braces of a ScatteringData, separated by white space or commas.
struct Values {
  const Document& document;
  std::string_view all, left;
  std::ptrdiff_t begins;  ///< offset of its first byte in the file

  Values(const Document& from, const pugi::xml_node& node)
      : document(from), all(from.content(node)), left(all), begins(node.first_child().offset_debug()) {}

  std::ptrdiff_t line() const { return document.line_at(begins + std::ssize(all) - std::ssize(left)); }
  char peek() {
    while (!left.empty() && (static_cast<unsigned char>(left.front()) <= 32 || left.front() == ','))
      left.remove_prefix(1);
    return left.empty() ? '\0' : left.front();
  }
  void expect(char brace) {
    if (peek() != brace)
      throw input_error("{}:{}: `{}`; expected {}", document.file, line(), shown(left.substr(0, 10)), brace);
    left.remove_prefix(1);
  }
  double number() {
    if (peek() == '\0')
      throw input_error("{}:{}: ScatteringData ends here; expected another number", document.file, line());
    double value = 0;
    const auto [end, error] = std::from_chars(left.data(), left.data() + left.size(), value);
    const bool ends =
        end == left.data() + left.size() || static_cast<unsigned char>(*end) <= 32 || std::strchr(",{}", *end);
    if (error != std::errc() || !ends || !std::isfinite(value))
      throw input_error("{}:{}: `{}` is no number; expected a finite BRDF in 1/sr", document.file, line(),
                        shown(left.substr(0, 20)));
    left.remove_prefix(static_cast<std::size_t>(end - left.data()));
    return value;
  }
  void expect_end() {
    if (peek() != '\0')
      throw input_error("{}:{}: `{}` after the data; expected its end", document.file, line(),
                        shown(left.substr(0, 20)));
  }
};

/// A direction of the Klems basis.
struct Patch {
  double theta_deg, phi_deg;
};

/// One band of the zenith angle.
std::vector<Patch> band(const Document& document, const pugi::xml_node& block, double lower_deg, double& upper_deg) {
  const pugi::xml_node bounds = document.child(block, "ThetaBounds");
  const double theta = document.number(block, "Theta"), lower = document.number(bounds, "LowerTheta");
  const double count = document.number(block, "nPhis");
  upper_deg = document.number(bounds, "UpperTheta");
  constexpr double kSame = 1e-4;  // degrees, of bounds as printed
  if (std::abs(lower - lower_deg) > kSame || !(upper_deg > lower) || !(upper_deg <= 90 + kSame) ||
      !(theta >= lower && theta <= upper_deg))
    throw input_error("{}:{}: a band from {} to {} with its middle at {}; expected one from {} to at most 90 degrees",
                      document.file, document.line_of(block), lower, upper_deg, theta, lower_deg);
  if (!(count >= 1 && count <= 10000) || count != std::floor(count))
    throw input_error("{}:{}: nPhis is {}; expected a whole number of 1 to 10000", document.file,
                      document.line_of(block), count);
  std::vector<Patch> patches;
  for (int k = 0; k < count; ++k) patches.push_back({theta, 360 * k / count});
  return patches;
}

std::vector<Patch> basis_of(const Document& document, const pugi::xml_node& definition, std::string_view name) {
  for (const pugi::xml_node& basis : definition.children("AngleBasis")) {
    if (document.word(basis, "AngleBasisName") != name) continue;
    std::vector<Patch> patches;
    double bound = 0;
    for (const pugi::xml_node& block : basis.children("AngleBasisBlock")) {
      double upper = 0;
      const std::vector<Patch> more = band(document, block, bound, upper);
      patches.insert(patches.end(), more.begin(), more.end());
      bound = upper;
    }
    if (patches.empty())
      throw input_error("{}:{}: <AngleBasis> has no bands; expected AngleBasisBlock", document.file,
                        document.line_of(basis));
    return patches;
  }
  throw input_error("{}:{}: no <AngleBasis> is named `{}`; expected one", document.file, document.line_of(definition),
                    shown(name));
}

void add_point(Measurement& scan, const Patch& in, const Patch& out, double f) {
  ScanPoint point;
  point.theta_i_deg = in.theta_deg;
  point.phi_i_deg = in.phi_deg;
  point.theta_o_deg = out.theta_deg;
  point.phi_o_deg = out.phi_deg;
  point.f_per_sr = f;
  if (in.theta_deg < 90 && out.theta_deg < 90)
    scan.points.push_back(point);
  else
    ++scan.left_out["zenith angle of 90 degrees"];
}

void read_matrix(const Document& document, const pugi::xml_node& definition, const pugi::xml_node& block, bool columns,
                 Measurement& scan) {
  const std::vector<Patch> in = basis_of(document, definition, document.word(block, "ColumnAngleBasis"));
  const std::vector<Patch> out = basis_of(document, definition, document.word(block, "RowAngleBasis"));
  Values values(document, document.child(block, "ScatteringData"));
  if (in.size() > values.all.size() || out.size() > values.all.size() / in.size() + 1)
    throw input_error("{}:{}: ScatteringData is too short for {} by {} numbers; expected them all", document.file,
                      values.line(), out.size(), in.size());
  const std::size_t count = in.size() * out.size(), stride = (count + kMostPoints - 1) / kMostPoints;
  for (std::size_t k = 0; k < count; ++k) {
    const double f = values.number();
    const Patch& towards = in[columns ? k % in.size() : k / out.size()];
    const Patch& eye = out[columns ? k / in.size() : k % out.size()];
    if (k % stride == 0) add_point(scan, {towards.theta_deg, std::fmod(towards.phi_deg + 180, 360)}, eye, f);
  }
  values.expect_end();
  scan.conventions.push_back(
      "directions: the middles of the basis' patches; the light at the azimuth opposite to its column's");
  if (stride > 1)
    scan.conventions.push_back(fmt::format("thinned: every {}th number, to at most {} points", stride, kMostPoints));
}

/// Shirley & Chiu 1997, concentric map of the unit square to the unit disk: rings of squares become circles.
Patch on_hemisphere(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1, quarter = kPi<double> / 4;
  double r = 0, phi = 0;
  if (std::abs(a) > std::abs(b)) {
    r = std::abs(a);
    phi = quarter * (b / a) + (a < 0 ? 4 * quarter : 0);
  } else if (b != 0) {
    r = std::abs(b);
    phi = quarter * ((b < 0 ? 6 : 2) - a / b);
  }
  return {std::asin(std::min(1.0, r)) * 45 / quarter, phi * 45 / quarter};
}

/// A leaf: the middle of its box and its value.
struct Leaf {
  std::array<double, 4> middle;
  double f;
};

/// Reads a tree's leaves in the order of the file.
struct TreeReader {
  Values& values;
  int axes;
  std::vector<Leaf> leaves;

  void tree(const std::array<double, 4>& corner, double size, int depth) {
    values.expect('{');
    if (values.peek() == '{') {
      if (depth >= kDeepest)
        throw input_error("{}:{}: the tree is deeper than {}; expected fewer halvings", values.document.file,
                          values.line(), kDeepest);
      for (unsigned branch = 0; branch < 1u << axes; ++branch) {
        std::array<double, 4> at = corner;
        for (int axis = 0; axis < axes; ++axis)
          if (branch & 1u << axis) at[axis] += size / 2;
        tree(at, size / 2, depth + 1);
      }
    } else {
      grid(corner, size);
    }
    values.expect('}');
  }
  void grid(const std::array<double, 4>& corner, double size) {
    std::vector<double> numbers;
    while (values.peek() != '}') numbers.push_back(values.number());
    int levels = 0;
    while (axes * levels < 40 && std::size_t{1} << axes * levels < numbers.size()) ++levels;
    if (std::size_t{1} << axes * levels != numbers.size())
      throw input_error("{}:{}: {} values between braces; expected a power of {}", values.document.file, values.line(),
                        numbers.size(), 1 << axes);
    const std::size_t across = std::size_t{1} << levels;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      Leaf leaf{corner, numbers[k]};
      std::size_t left = k;
      for (int axis = axes - 1; axis >= 0; --axis, left /= across)
        leaf.middle[axis] += size * (static_cast<double>(left % across) + 0.5) / static_cast<double>(across);
      leaves.push_back(leaf);
    }
  }
};

void read_tree(const Document& document, const pugi::xml_node& block, int axes, Measurement& scan) {
  if (const std::string_view basis = document.word(block, "AngleBasis"); basis != "LBNL/Shirley-Chiu")
    throw input_error("{}:{}: AngleBasis is `{}`; expected LBNL/Shirley-Chiu", document.file,
                      document.line_of(block.child("AngleBasis")), shown(basis));
  Values values(document, document.child(block, "ScatteringData"));
  TreeReader reader{values, axes, {}};
  reader.tree({0, 0, 0, 0}, 1, 0);
  values.expect_end();
  const std::size_t stride = (reader.leaves.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t k = 0; k < reader.leaves.size(); k += stride) {
    const std::array<double, 4>& at = reader.leaves[k].middle;
    if (axes == 3 && at[0] >= 0.5) {
      // Only half of the first axis is used; a leaf that spans it all stands at a sine of ½.
      if (at[0] > 0.5) continue;
      add_point(scan, {30, 180}, on_hemisphere(at[1], at[2]), reader.leaves[k].f);
      continue;
    }
    const Patch in = axes == 3 ? Patch{std::asin(1 - 2 * at[0]) * 180 / kPi<double>, 0} : on_hemisphere(at[0], at[1]);
    add_point(scan, {in.theta_deg, std::fmod(in.phi_deg + 180, 360)}, on_hemisphere(at[axes - 2], at[axes - 1]),
              reader.leaves[k].f);
  }
  scan.conventions.push_back(
      "directions: the middles of the tree's leaves; the light opposite to the direction in, azimuths from the x axis");
  if (stride > 1)
    scan.conventions.push_back(fmt::format("thinned: every {}th leaf, to at most {} points", stride, kMostPoints));
}

/// The visible reflection block of the front, else of the back; what else there is goes into the notes.
pugi::xml_node reflection_of(const Document& document, const pugi::xml_node& layer, Measurement& scan) {
  pugi::xml_node front, back;
  for (const pugi::xml_node& data : layer.children("WavelengthData")) {
    const std::string_view range = document.word(data, "Wavelength");
    if (range != "Visible") {
      scan.notes.push_back(fmt::format("WavelengthData `{}` is ignored", shown(range)));
      continue;
    }
    for (const pugi::xml_node& block : data.children("WavelengthDataBlock")) {
      const std::string_view side = document.word(block, "WavelengthDataDirection");
      pugi::xml_node* kept = side == "Reflection Front" ? &front : side == "Reflection Back" ? &back : nullptr;
      if (!kept) {
        scan.notes.push_back(fmt::format("`{}` is ignored", shown(side)));
        continue;
      }
      if (*kept)
        throw input_error("{}:{}: `{}` appears twice; expected it once", document.file, document.line_of(block), side);
      *kept = block;
    }
  }
  if (front && back) scan.notes.push_back("`Reflection Back` is ignored beside the front's");
  if (!front && !back)
    throw input_error(
        "{}:{}: no visible reflection; expected a WavelengthDataBlock of Reflection Front or Reflection Back",
        document.file, document.line_of(layer));
  scan.conventions.push_back(fmt::format("side: {}, as WINDOW names it (Radiance's front is the file's back)",
                                         front ? "Reflection Front" : "Reflection Back"));
  return front ? front : back;
}

}  // namespace

Measurement read_bsdf_xml(std::string_view text, const std::string& file) {
  Document document{text, file, {}};
  const pugi::xml_parse_result result =
      document.xml.load_buffer(text.data(), text.size(), pugi::parse_minimal, pugi::encoding_utf8);
  if (!result)
    throw input_error("{}:{}: {}; expected well-formed XML", file, document.line_at(result.offset),
                      result.description());
  const pugi::xml_node root = document.xml.document_element();
  if (std::strcmp(root.name(), "WindowElement") != 0)
    throw input_error("{}:{}: the root is <{}>; expected <WindowElement>", file, document.line_of(root),
                      shown(root.name()));
  const pugi::xml_node layer = document.child(document.child(root, "Optical"), "Layer");
  const pugi::xml_node definition = document.child(layer, "DataDefinition");
  const std::string_view structure = document.word(definition, "IncidentDataStructure");
  Measurement scan;
  if (const pugi::xml_node material = layer.child("Material"); material && material.child("Name"))
    scan.name = shown(document.word(material, "Name"));
  scan.quantity = "brdf";
  const pugi::xml_node block = reflection_of(document, layer, scan);
  if (const std::string_view type = document.word(block, "ScatteringDataType"); type != "BRDF")
    throw input_error("{}:{}: ScatteringDataType is `{}`; expected BRDF", file, document.line_of(block), shown(type));
  scan.conventions.push_back(
      "quantity: BRDF without cosine, per sr, absolute; averaged over the visible range, so without a wavelength");
  scan.conventions.push_back("angles: degrees; azimuths counter-clockwise from the x axis");
  if (structure == "Columns" || structure == "Rows")
    read_matrix(document, definition, block, structure == "Columns", scan);
  else if (structure == "TensorTree3" || structure == "TensorTree4")
    read_tree(document, block, structure == "TensorTree3" ? 3 : 4, scan);
  else
    throw input_error("{}:{}: IncidentDataStructure is `{}`; expected Columns, Rows, TensorTree3 or TensorTree4", file,
                      document.line_of(definition), shown(structure));
  if (scan.points.empty())
    throw input_error("{}:{}: has no direction below 90 degrees; expected at least one", file, document.line_of(block));
  group_by_incidence(scan);
  return scan;
}

}  // namespace gonio
