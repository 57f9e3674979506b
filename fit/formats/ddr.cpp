#include "fit/formats/ddr.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/number.h"
#include "base/unit_vector.h"

namespace gonio {
namespace {

constexpr std::size_t kMostPoints = 100'000;

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}
/// As a message may show it.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text;
}

/// The file's words one after the other, comments skipped; `line` is that of the word last taken.
struct Words {
  std::string_view left;
  const std::string& file;
  int line = 1;

  /// The next word without taking it; empty at the end.
  std::string_view peek() {
    while (!left.empty()) {
      if (left.front() == ';') {
        left.remove_prefix(std::min(left.find('\n'), left.size()));
      } else if (static_cast<unsigned char>(left.front()) <= 32) {
        if (!std::isspace(static_cast<unsigned char>(left.front())))
          throw input_error("{}:{}: is not text (byte {}); expected an Integra table", file, line, int(left.front()));
        line += left.front() == '\n';
        left.remove_prefix(1);
      } else {
        std::size_t end = 0;
        while (end < left.size() && static_cast<unsigned char>(left[end]) > 32 && left[end] != ';') ++end;
        return left.substr(0, end);
      }
    }
    return {};
  }
  std::string_view take(std::string_view what) {
    const std::string_view word = peek();
    if (word.empty()) throw input_error("{}:{}: ends here; expected {}", file, line, what);
    left.remove_prefix(word.size());
    return word;
  }
  double number(std::string_view what) {
    const std::string_view word = take(what);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      throw input_error("{}:{}: {} is `{}`; expected a finite number", file, line, what, shown(word));
    return value;
  }
  /// A count that the rest of the file has room for (two bytes a value).
  std::size_t count(std::string_view what) {
    const std::string_view word = take(what);
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value == 0)
      throw input_error("{}:{}: count of {} is `{}`; expected a whole number of 1 or more", file, line, what,
                        shown(word));
    if (value > left.size() / 2)
      throw input_error("{}:{}: count of {} is {}; expected at most {}, which the file has room for", file, line, what,
                        value, left.size() / 2);
    return value;
  }
};

enum class Symmetry { axial, directional, plane, none, none_4d };

struct Header {
  std::string source;
  std::optional<Symmetry> symmetry;
  std::string color;  // bw, rgb, spectral
  std::size_t channels = 0;
  std::optional<bool> intensity;
  bool relative = false;
  std::vector<double> psi, sigma, phi, theta;
  std::string symmetry_name;
};

std::vector<double> angles(Words& words, const std::string& name, double hi) {
  std::vector<double> values(words.count(name));
  for (double& value : values) {
    value = words.number(name);
    if (!(value >= 0 && value <= hi))
      throw input_error("{}:{}: {} is {}; expected 0 to {} degrees", words.file, words.line, name, value, hi);
    if (&value != values.data() && !(value > *(&value - 1)))
      throw input_error("{}:{}: {} is {} after {}; expected increasing angles", words.file, words.line, name, value,
                        *(&value - 1));
  }
  return values;
}

void read_symmetry(Words& words, Header& header) {
  header.symmetry_name = words.take("a symmetry");
  const std::string name = lower(header.symmetry_name);
  if (name == "axisymmetrical")
    header.symmetry = Symmetry::axial;
  else if (name == "dirsymmetrical")
    header.symmetry = Symmetry::directional;
  else if (name == "planesymmetrical")
    header.symmetry = Symmetry::plane;
  else if (name == "asymmetrical")
    header.symmetry = Symmetry::none;
  else
    throw input_error(
        "{}:{}: TypeSym is `{}`; expected AxiSymmetrical, DirSymmetrical, PlaneSymmetrical or ASymmetrical", words.file,
        words.line, shown(name));
  if (header.symmetry == Symmetry::none && lower(words.peek()) == "4d") {
    words.take("4D");
    header.symmetry = Symmetry::none_4d;
    header.symmetry_name += " 4D";
  }
}

void read_color(Words& words, Header& header) {
  header.color = lower(words.take("a colour model"));
  if (header.color == "bw")
    header.channels = 1;
  else if (header.color == "rgb")
    header.channels = 3;
  else if (header.color == "spectral")
    header.channels = words.count("wavelengths");
  else
    throw input_error("{}:{}: TypeColorModel is `{}`; expected BW, RGB or spectral", words.file, words.line,
                      shown(header.color));
}

void read_type(Words& words, Header& header) {
  const std::string type = lower(words.take("Luminance or Intensity"));
  if (type != "luminance" && type != "intensity")
    throw input_error("{}:{}: TypeData is `{}`; expected Luminance or Intensity", words.file, words.line, shown(type));
  header.intensity = type == "intensity";
  const std::string scale = lower(words.take("Absolute or Relative"));
  if (scale != "absolute" && scale != "relative")
    throw input_error("{}:{}: TypeData {} is `{}`; expected Absolute or Relative", words.file, words.line, type,
                      shown(scale));
  header.relative = scale == "relative";
}

bool begins_block(const std::string& word) {
  return word == "bw" || word == "wl" || word == "red" || word == "gre" || word == "green" || word == "blu" ||
         word == "blue";
}

template <class T>
void once(const Words& words, const T& already, std::string_view name) {
  bool given;
  if constexpr (requires { already.has_value(); })
    given = already.has_value();
  else
    given = !already.empty();
  if (given) throw input_error("{}:{}: {} appears twice; expected it once", words.file, words.line, name);
}

void read_entry(Words& words, Header& header) {
  const std::string given(words.take("a keyword")), word = lower(given);
  if (word == "source") {
    once(words, header.source, given);
    header.source = shown(words.take("a source"));
  } else if (word == "typesym") {
    once(words, header.symmetry, given);
    read_symmetry(words, header);
  } else if (word == "typecolormodel") {
    once(words, header.color, given);
    read_color(words, header);
  } else if (word == "typedata") {
    once(words, header.intensity, given);
    read_type(words, header);
  } else if (word == "psi") {
    once(words, header.psi, given);
    header.psi = angles(words, "psi", 360);
  } else if (word == "sigma") {
    once(words, header.sigma, given);
    header.sigma = angles(words, "sigma", 90);
  } else if (word == "phi") {
    once(words, header.phi, given);
    header.phi = angles(words, "phi", 360);
  } else if (word == "theta") {
    once(words, header.theta, given);
    header.theta = angles(words, "theta", 180);
  } else {
    throw input_error(
        "{}:{}: keyword `{}`; expected one of an Integra reflection table (sigmaT belongs to transmission)", words.file,
        words.line, shown(given));
  }
}

Header read_header(Words& words) {
  Header header;
  while (!begins_block(lower(words.peek()))) read_entry(words, header);
  const auto require = [&](bool given, std::string_view name) {
    if (!given) throw input_error("{}:{}: {} is missing; expected it before the data", words.file, words.line, name);
  };
  require(header.symmetry.has_value(), "TypeSym");
  require(!header.color.empty(), "TypeColorModel");
  require(header.intensity.has_value(), "TypeData");
  require(!header.sigma.empty(), "sigma");
  require(!header.phi.empty(), "phi");
  require(!header.theta.empty(), "theta");
  if (header.psi.empty() == (header.symmetry == Symmetry::none_4d))
    throw input_error("{}:{}: psi is {}; expected it with TypeSym ASymmetrical 4D and only then", words.file,
                      words.line, header.psi.empty() ? "missing" : "given");
  if (header.psi.empty()) header.psi = {0};
  return header;
}

/// One channel: values by psi, sigma, phi, theta, its wavelength where it has one.
struct Block {
  double wavelength_nm = kNotStated;
  std::vector<double> factors, values;
};

void read_channel_name(Words& words, const Header& header, std::size_t channel, Block& block) {
  const std::string word = lower(words.take("a channel"));
  const auto expect = [&](bool right, std::string_view names) {
    if (!right) throw input_error("{}:{}: channel `{}`; expected {}", words.file, words.line, shown(word), names);
  };
  if (header.color == "bw") return expect(word == "bw", "bw");
  if (header.color == "rgb")
    return channel == 0   ? expect(word == "red", "red")
           : channel == 1 ? expect(word == "gre" || word == "green", "gre")
                          : expect(word == "blu" || word == "blue", "blu");
  expect(word == "wl", "wl");
  block.wavelength_nm = words.number("wl");
  if (!(block.wavelength_nm >= 100 && block.wavelength_nm <= 1e5))
    throw input_error("{}:{}: wl is {}; expected 100 to 100000 nm", words.file, words.line, block.wavelength_nm);
}

Block read_block(Words& words, const Header& header, std::size_t channel) {
  Block block;
  read_channel_name(words, header, channel, block);
  std::string word = lower(words.take("kbdf or def"));
  if (word == "kbdf") {
    for (std::size_t k = 0; k < header.psi.size() * header.sigma.size(); ++k) {
      block.factors.push_back(words.number("kbdf"));
      if (block.factors.back() < 0)
        throw input_error("{}:{}: kbdf is {}; expected 0 or more", words.file, words.line, block.factors.back());
    }
    word = lower(words.take("def"));
  }
  if (word != "def") throw input_error("{}:{}: `{}`; expected def", words.file, words.line, shown(word));
  // The product is bounded step by step by what the file has room for.
  std::size_t count = 1;
  for (const std::size_t extent : {header.psi.size(), header.sigma.size(), header.phi.size(), header.theta.size()}) {
    if (extent > words.left.size() / 2 / count)
      throw input_error("{}:{}: has no room for the values of psi, sigma, phi and theta; expected them after def",
                        words.file, words.line);
    count *= extent;
  }
  for (std::size_t k = 0; k < count; ++k) block.values.push_back(words.number("a value"));
  word = lower(words.take("enddef"));
  if (word != "enddef")
    throw input_error("{}:{}: `{}` after {} values; expected enddef", words.file, words.line, shown(word), count);
  return block;
}

double degrees(double radians) { return radians * 180 / kPi<double>; }

/// The direction theta from the mirror direction, phi around it from the side of the normal; light at azimuth psi.
UnitVector<double> direction(double psi_deg, double sigma_deg, double phi_deg, double theta_deg) {
  const double rad = kPi<double> / 180, sp = std::sin(psi_deg * rad), cp = std::cos(psi_deg * rad);
  const double ss = std::sin(sigma_deg * rad), cs = std::cos(sigma_deg * rad), st = std::sin(theta_deg * rad);
  const double x = st * std::cos(phi_deg * rad), y = st * std::sin(phi_deg * rad), z = std::cos(theta_deg * rad);
  const double along = x * cs - z * ss, up = x * ss + z * cs;  // towards the light's azimuth, along the normal
  return {along * cp - y * sp, along * sp + y * cp, up};
}

/// Every stride-th pair of directions of one or of three channels.
struct Filler {
  const Header& header;
  const std::vector<Block>& blocks;
  Measurement& scan;
  std::size_t stride;

  double value(const Block& block, std::size_t incidence, std::size_t at) const {
    return block.values[at] * (header.relative || block.factors.empty() ? 1 : block.factors[incidence]);
  }
  double to_f(double value, double cos_o) const { return *header.intensity ? value / cos_o : value / kPi<double>; }

  void add(std::size_t psi, std::size_t sigma, std::size_t at, double phi_deg, double theta_deg) const {
    ScanPoint point;
    const UnitVector<double> o = direction(header.psi[psi], header.sigma[sigma], phi_deg, theta_deg);
    constexpr double kHorizon = 1e-6;
    if (!(o.z > kHorizon) || !(header.sigma[sigma] < 90)) {
      scan.left_out["at or below the horizon"] += static_cast<int>(header.color == "rgb" ? 1 : blocks.size());
      return;
    }
    point.theta_i_deg = header.sigma[sigma];
    point.phi_i_deg = header.psi[psi];
    point.theta_o_deg = degrees(std::acos(std::min(1.0, o.z)));
    point.phi_o_deg = degrees(std::atan2(o.y, o.x));
    const std::size_t incidence = psi * header.sigma.size() + sigma;
    if (header.color == "rgb") {
      const auto part = [&](std::size_t channel) { return value(blocks[channel], incidence, at); };
      point.f_per_sr = to_f(0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2), o.z);
      scan.points.push_back(point);
      return;
    }
    for (const Block& block : blocks) {
      point.wavelength_nm = block.wavelength_nm;
      point.f_per_sr = to_f(value(block, incidence, at), o.z);
      scan.points.push_back(point);
    }
  }
  void fill() const {
    std::size_t at = 0;
    for (std::size_t psi = 0; psi < header.psi.size(); ++psi)
      for (std::size_t sigma = 0; sigma < header.sigma.size(); ++sigma)
        for (const double phi : header.phi)
          for (const double theta : header.theta) {
            if (at % stride == 0) add(psi, sigma, at, phi, theta);
            ++at;
          }
  }
};

void state_conventions(const Header& header, std::size_t stride, Measurement& scan) {
  scan.conventions.push_back(fmt::format(
      "quantity: {}, {}", *header.intensity ? "intensity, f_r·cos(theta_o) per sr" : "luminance, pi·f_r",
      header.relative ? "relative (a factor of its own for each incidence)" : "absolute, times kbdf where given"));
  scan.conventions.push_back(
      "angles: degrees; theta from the mirror direction, phi around it with 0 towards the normal, psi the light's "
      "azimuth");
  scan.conventions.push_back(
      fmt::format("symmetry: {}; only the directions given are taken", shown(header.symmetry_name)));
  if (header.color == "rgb") scan.conventions.push_back("colour: 0.2126 R + 0.7152 G + 0.0722 B, no wavelength");
  if (stride > 1)
    scan.conventions.push_back(fmt::format("thinned: every {}th direction, to at most {} points", stride, kMostPoints));
}

}  // namespace

Measurement read_ddr(std::string_view text, const std::string& file) {
  Words words{text, file};
  const Header header = read_header(words);
  std::vector<Block> blocks;
  for (std::size_t channel = 0; channel < header.channels; ++channel) {
    blocks.push_back(read_block(words, header, channel));
    if (channel > 0 && blocks[channel].wavelength_nm <= blocks[channel - 1].wavelength_nm)
      throw input_error("{}:{}: wl is {} after {}; expected increasing wavelengths", file, words.line,
                        blocks[channel].wavelength_nm, blocks[channel - 1].wavelength_nm);
  }
  if (!words.peek().empty())
    throw input_error("{}:{}: `{}` after the last channel; expected the end of the file", file, words.line,
                      shown(words.peek()));
  Measurement scan;
  scan.source = header.source;
  scan.quantity = header.relative ? "relative" : *header.intensity ? "brdf_cos" : "reflectance_factor";
  const std::size_t numbers = blocks[0].values.size() * (header.color == "rgb" ? 1 : blocks.size());
  const std::size_t stride = (numbers + kMostPoints - 1) / kMostPoints;
  state_conventions(header, stride, scan);
  Filler{header, blocks, scan, stride}.fill();
  if (scan.points.empty())
    throw input_error("{}:{}: has no direction above the horizon; expected at least one", file, words.line);
  for (const ScanPoint& point : scan.points)
    if (!std::isfinite(point.f_per_sr))
      throw input_error("{}:{}: a value is too large as a BRDF; expected finite ones", file, words.line);
  group_by_incidence(scan);
  return scan;
}

}  // namespace gonio
