// BSDF text files of LightTools. The program's own manual is not public; the keywords are those that its exported files
// and public readers of them share: Symmetry, SpectralContent, ScatterAzimuth and ScatterRadial (counted lists), then
// between DataBegin and DataEnd blocks of AOI, POI, Side, Wavelength, ScatterType[, TristimulusValue], TIS and the values,
// a row of ScatterRadial values for each ScatterAzimuth. Scatter angles are about the normal; the light of an isotropic
// file comes from azimuth 90 degrees.
#include <algorithm>
#include <optional>

#include "base/error.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"
#include "fit/formats/text.h"

namespace gonio {
namespace {

constexpr double kLightAzimuthDeg = 90;

struct Grid {
  bool tristimulus = false;
  std::vector<double> azimuth, radial;
};

struct Block {
  std::optional<double> aoi, poi, wavelength_nm;
  std::string_view side, type, tristimulus;
  int line = 1;
};

[[noreturn]] void refuse(const Words::Word& word, std::string_view key, std::string_view expected,
                         const std::string& file) {
  throw input_error("{}:{}: {} is `{}`; expected {}", file, word.line, key, printable(word.text), expected);
}

Grid read_grid(Words& words, const std::string& file) {
  Grid grid;
  bool symmetry = false, content = false;
  for (;;) {
    const Words::Word key = words.next("DataBegin");
    const auto once = [&](bool given) {
      if (given) throw input_error("{}:{}: {} appears twice; expected once", file, key.line, printable(key.text));
    };
    if (key.text == "DataBegin") break;
    if (key.text == "Source") {
      if (const Words::Word word = words.next("Measured"); word.text != "Measured")
        refuse(word, "Source", "Measured", file);
    } else if (key.text == "Symmetry") {
      once(symmetry);
      symmetry = true;
      if (const Words::Word word = words.next("Asymmetric"); word.text != "Asymmetric")
        refuse(word, "Symmetry", "Asymmetric", file);
    } else if (key.text == "SpectralContent") {
      once(content);
      content = true;
      const Words::Word word = words.next("Monochrome");
      if (word.text != "Monochrome" && word.text != "XYZ") refuse(word, key.text, "Monochrome or XYZ", file);
      grid.tristimulus = word.text == "XYZ";
    } else if (key.text == "ScatterAzimuth") {
      once(!grid.azimuth.empty());
      grid.azimuth = words.counted_list(key.text, 0, 360);
    } else if (key.text == "ScatterRadial") {
      once(!grid.radial.empty());
      grid.radial = words.counted_list(key.text, 0, 90);
    } else {
      throw input_error(
          "{}:{}: `{}` is no keyword here; expected Symmetry, SpectralContent, ScatterAzimuth, ScatterRadial or "
          "DataBegin",
          file, key.line, printable(key.text));
    }
  }
  if (!symmetry || !content || grid.azimuth.empty() || grid.radial.empty())
    throw input_error(
        "{}:{}: DataBegin comes too early; expected Symmetry, SpectralContent, ScatterAzimuth, ScatterRadial before",
        file, words.line());
  return grid;
}

double number_between(Words& words, std::string_view key, double lo, double hi, const std::string& file) {
  const double value = words.number(key);
  if (!(value >= lo && value <= hi))
    throw input_error("{}:{}: {} is {}; expected {} to {}", file, words.line(), key, value, lo, hi);
  return value;
}

std::string_view text_of(Words& words, std::string_view key, std::initializer_list<std::string_view> allowed,
                         const std::string& file) {
  const Words::Word word = words.next(key);
  for (const std::string_view text : allowed)
    if (word.text == text) return text;
  refuse(word, key, fmt::format("{}", fmt::join(allowed, " or ")), file);
}

void require_whole(const Block& block, const Grid& grid, const std::string& file) {
  if (!block.aoi || !block.poi || block.side.empty() || block.type.empty() ||
      block.tristimulus.empty() == grid.tristimulus)
    throw input_error("{}:{}: the block's head is not whole at TIS; expected AOI, POI, Side, ScatterType{}", file,
                      block.line, grid.tristimulus ? ", TristimulusValue" : "");
}

/// A key and its value in a block's head; false at TIS.
bool read_head(Words& words, const Words::Word& key, Block& block, const std::string& file) {
  const auto once = [&](bool given) {
    if (given) throw input_error("{}:{}: {} appears twice in a block; expected once", file, key.line, key.text);
  };
  block.line = key.line;
  if (key.text == "TIS") return false;
  if (key.text == "AOI") {
    once(block.aoi.has_value());
    block.aoi = number_between(words, "AOI", 0, 90, file);
  } else if (key.text == "POI") {
    once(block.poi.has_value());
    block.poi = number_between(words, "POI", 0, 0, file);
  } else if (key.text == "Wavelength") {
    once(block.wavelength_nm.has_value());
    block.wavelength_nm = number_between(words, "Wavelength", 100, 1e5, file);
  } else if (key.text == "Side") {
    once(!block.side.empty());
    block.side = text_of(words, "Side", {"Front", "Back"}, file);
  } else if (key.text == "ScatterType") {
    once(!block.type.empty());
    block.type = text_of(words, "ScatterType", {"BRDF", "BTDF"}, file);
  } else if (key.text == "TristimulusValue") {
    once(!block.tristimulus.empty());
    block.tristimulus = text_of(words, "TristimulusValue", {"TrisX", "TrisY", "TrisZ"}, file);
  } else {
    throw input_error("{}:{}: `{}` is no keyword of a block; expected AOI, POI, Side, Wavelength, ScatterType or TIS",
                      file, key.line, printable(key.text));
  }
  return true;
}

void read_values(Words& words, const Grid& grid, const Block& block, PointCollector& points, const std::string& file) {
  require_whole(block, grid, file);
  if (!(words.number("TIS") >= 0)) throw input_error("{}:{}: TIS is negative; expected 0 or more", file, words.line());
  if (double(grid.azimuth.size()) * double(grid.radial.size()) > double(words.left()))
    throw input_error("{}:{}: the file ends within a block; expected {} x {} values", file, words.line(),
                      grid.azimuth.size(), grid.radial.size());
  const bool used = block.side == "Front" && block.type == "BRDF";
  const bool channel = !grid.tristimulus || block.tristimulus == "TrisY";
  for (const double azimuth : grid.azimuth)
    for (const double radial : grid.radial) {
      const double value = words.number("the value");
      if (!used) {
        points.leave_out("back side or transmission");
      } else if (channel) {
        points.add_of_grid({direction_from_deg(*block.aoi, kLightAzimuthDeg), direction_from_deg(radial, azimuth)},
                           block.wavelength_nm.value_or(kNotStated), value, words.line());
      }
    }
}

}  // namespace

bool is_lighttools(std::string_view head) {
  return head.find("AngleOfIncidence") == head.npos && head.find("ScatterAzimuth") != head.npos &&
         head.find("Symmetry") != head.npos;
}

Measurement read_lighttools(std::string_view bytes, const std::string& file) {
  Words words(bytes, file, '#');
  const Grid grid = read_grid(words, file);
  PointCollector points({}, file);
  points.scan().conventions = {"quantity: brdf", "angles: degrees",
                               "azimuth: ScatterRadial and ScatterAzimuth about the normal; the light comes from "
                               "azimuth 90 (POI 0), so azimuth 270 is the mirror side",
                               "scale: absolute, sr^-1",
                               grid.tristimulus ? "channel: Y of X, Y, Z" : "channel: monochrome"};
  Block block;
  for (bool open = false;;) {
    const Words::Word key = words.next("AOI or DataEnd");
    if (key.text == "DataEnd" && !open) break;
    open = read_head(words, key, block, file);
    if (open) continue;
    read_values(words, grid, block, points, file);
    block = {};
  }
  if (const Words::Word* word = words.peek())
    throw input_error("{}:{}: `{}` stands after DataEnd; expected the end of the file", file, word->line,
                      printable(word->text));
  Measurement& scan = points.scan();
  const auto stated = std::count_if(scan.points.begin(), scan.points.end(), [](auto& p) { return p.has_wavelength(); });
  if (stated != 0 && stated != std::ssize(scan.points))
    throw input_error("{}:{}: some blocks state a Wavelength; expected all or none", file, words.line());
  return points.finish(words.line());
}

}  // namespace gonio
