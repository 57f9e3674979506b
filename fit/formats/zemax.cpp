// Tabular BSDF of Zemax and Radiant Imaging (R. Rykowski, BSDF Data Interchange File Format Specification, 2008, Zemax
// knowledge base): keywords in a fixed order, each angle list counted, then for each sample rotation and each angle of
// incidence `TIS value` and a row of ScatterRadial values for each ScatterAzimuth. Scatter angles are about the mirror
// direction: azimuth 0 from there towards the normal, counter-clockwise. Degrees, values in sr⁻¹.
#include <algorithm>
#include <array>

#include "base/error.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"
#include "fit/formats/text.h"

namespace gonio {
namespace {

struct Grid {
  bool symmetrical = false, tristimulus = false;
  std::vector<double> rotation, incidence, azimuth, radial;
};

std::string_view one_of(Words& words, std::string_view name, std::initializer_list<std::string_view> allowed,
                        const std::string& file) {
  words.expect(name);
  const Words::Word word = words.next(name);
  for (const std::string_view text : allowed)
    if (word.text == text) return text;
  throw input_error("{}:{}: {} is `{}`; expected {}", file, word.line, name, printable(word.text),
                    fmt::format("{}", fmt::join(allowed, " or ")));
}

std::vector<double> angles(Words& words, std::string_view name, double lo, double hi) {
  words.expect(name);
  return words.counted_list(name, lo, hi);
}

Grid read_grid(Words& words, const std::string& file) {
  Grid grid;
  one_of(words, "Source", {"Measured"}, file);
  grid.symmetrical = one_of(words, "Symmetry",
                            {"PlaneSymmetrical", "Asymmetrical", "ASymmetrical", "Asymmetrical4D", "ASymmetrical4D"},
                            file) == "PlaneSymmetrical";
  grid.tristimulus = one_of(words, "SpectralContent", {"Monochrome", "XYZ"}, file) == "XYZ";
  if (one_of(words, "ScatterType", {"BRDF", "BTDF"}, file) == "BTDF")
    throw input_error("{}:{}: ScatterType is BTDF; expected BRDF (reflection)", file, words.line());
  grid.rotation = angles(words, "SampleRotation", -360, 360);
  grid.incidence = angles(words, "AngleOfIncidence", 0, 90);
  grid.azimuth = angles(words, "ScatterAzimuth", 0, grid.symmetrical ? 180 : 360);
  grid.radial = angles(words, "ScatterRadial", 0, 180);
  return grid;
}

/// One block of values, DataBegin to DataEnd; into `points` where it is the block asked for.
void read_block(Words& words, const Grid& grid, PointCollector* points, const std::string& file) {
  words.expect("DataBegin");
  const double values = double(grid.rotation.size()) * double(grid.incidence.size()) *
                        (double(grid.azimuth.size()) * double(grid.radial.size()) + 2);
  if (values > double(words.left()))
    throw input_error("{}:{}: the angles ask for {} words of data and {} are left; expected as many", file,
                      words.line(), values, words.left());
  for (const double rotation : grid.rotation)
    for (const double incidence : grid.incidence) {
      words.expect("TIS");
      const double tis = words.number("TIS");
      if (!(tis >= 0)) throw input_error("{}:{}: TIS is {}; expected 0 or more", file, words.line(), tis);
      for (const double azimuth : grid.azimuth)
        for (const double radial : grid.radial) {
          const double value = words.number("the value");
          if (points != nullptr)
            points->add_of_grid(from_mirror_deg(incidence, rotation, radial, azimuth), kNotStated, value, words.line());
        }
    }
  words.expect("DataEnd");
}

}  // namespace

bool is_zemax(std::string_view head) {
  return head.find("AngleOfIncidence") != head.npos && head.find("ScatterAzimuth") != head.npos;
}

Measurement read_zemax(std::string_view bytes, const std::string& file) {
  Words words(bytes, file, '#');
  const Grid grid = read_grid(words, file);
  PointCollector points({}, file);
  points.scan().conventions = {
      "quantity: brdf", "angles: degrees",
      "azimuth: ScatterRadial and ScatterAzimuth about the mirror direction, 0 towards the normal, counter-clockwise "
      "against that direction; SampleRotation is phi_i",
      "scale: absolute, sr^-1",
      grid.tristimulus ? "channel: Y of X, Y, Z" : "channel: monochrome, wavelength not stated"};
  if (grid.symmetrical)
    points.scan().conventions.push_back("symmetry: plane of incidence; the other half is not repeated");
  constexpr std::array kTristimulus{"TristimulusX", "TristimulusY", "TristimulusZ"};
  if (!grid.tristimulus) {
    words.expect("Monochrome");
    read_block(words, grid, &points, file);
  }
  for (std::size_t k = 0; grid.tristimulus && k < kTristimulus.size(); ++k) {
    words.expect(kTristimulus[k]);
    read_block(words, grid, k == 1 ? &points : nullptr, file);
  }
  if (const Words::Word* word = words.peek())
    throw input_error("{}:{}: `{}` stands after DataEnd; expected the end of the file", file, word->line,
                      printable(word->text));
  return points.finish(words.line());
}

}  // namespace gonio
