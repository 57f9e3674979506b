// Broken files of every format, made here by changing good ones: each is refused with file, line and expectation.
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "fit/formats/formats.h"
#include "fit/formats/readers.h"
#include "fit/formats/writers.h"

using namespace gonio;

namespace {

struct Sample {
  const char *format, *name;
  bool counted;  ///< it says how many rows it has, so that a missing one shows
};
constexpr Sample kSamples[] = {
    {"astm", "painted.astm", true}, {"zemax", "vinyl.bsdf", true}, {"lighttools", "coated.lighttools.bsdf", true},
    {"alta", "retro.alta", false},  {"ssdd", "blue.ssdd", true},   {"table", "he.txt", true}};

std::string content(const Sample& sample) {
  return read_file(std::filesystem::path(GONIO_SOURCE_DIR) / "tests/fit/samples" / sample.name);
}

/// All that was refused, so that each counts once.
std::set<std::pair<std::string, std::string>> refused;

void check_refused(const std::string& format, const std::string& bytes, const std::string& place = ":") {
  std::string message = "accepted";
  try {
    format_named(format).read(bytes, "broken.file");
  } catch (const InputError& error) {
    message = error.what();
  }
  INFO(format << " " << message << "\n" << (bytes.size() < 2000 ? bytes : ""));
  const bool binary = format == "merl";
  CHECK(message.starts_with(binary ? "broken.file: offset " : "broken.file:"));
  if (!binary) {
    int line = 0;
    const char* start = message.data() + std::min<std::size_t>(message.size(), 12);
    const auto [end, error] = std::from_chars(start, message.data() + message.size(), line);
    CHECK(line >= 1);
    CHECK((end != message.data() + message.size() && *end == ':'));
  }
  CHECK(message.find("expected") != message.npos);
  CHECK(message.find('\n') == message.npos);
  CHECK(message.find(place) != message.npos);
  if (message != "accepted") refused.emplace(format, bytes);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at + 1));
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += lines[k];
  return text;
}

bool is_comment(const std::string& line) { return line.starts_with("# ") && line.find(": ") == line.npos; }

/// Where each number of the text starts and how long it is.
std::vector<std::pair<std::size_t, std::size_t>> numbers_in(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = text.find_first_not_of(" \t\n,", at);
    if (start == text.npos) break;
    const std::size_t end = std::min(text.size(), text.find_first_of(" \t\n,", start));
    double value;
    const auto [last, error] = std::from_chars(text.data() + start, text.data() + end, value);
    if (error == std::errc() && last == text.data() + end) found.emplace_back(start, end - start);
    at = end;
  }
  return found;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), with);
}

}  // namespace

TEST_CASE("files that end too soon are refused", "[fit][formats]") {
  for (const Sample& sample : kSamples) {
    const std::vector<std::string> lines = lines_of(content(sample));
    std::size_t whole = 0;  // an SSDD file may end after its first block; without a count, rows may be missing
    for (std::size_t count = 0; count < lines.size(); ++count) {
      const std::string text = joined(lines, count);
      const bool first_block = sample.name == std::string("blue.ssdd") && count >= 22 && count < 24;
      const bool row_missing = !sample.counted && count >= 7;
      if (first_block || row_missing)
        ++whole;
      else
        check_refused(sample.format, text);
    }
    CHECK(whole <= 2);
  }
}

TEST_CASE("a number replaced by what is none is refused, wherever it stands", "[fit][formats]") {
  for (const Sample& sample : kSamples) {
    const std::string good = content(sample);
    for (const auto& [start, size] : numbers_in(good)) {
      if (good.substr(0, start).ends_with("# PARAM2: ")) continue;  // within a comment
      for (const std::string with : {"abc", "nan", "inf", "1e999", "0x1", "1.5.2", "-"})
        check_refused(sample.format, std::string(good).replace(start, size, with));
    }
  }
}

TEST_CASE("lines that stand twice are refused", "[fit][formats]") {
  for (const Sample& sample : kSamples) {
    const std::vector<std::string> lines = lines_of(content(sample));
    for (std::size_t at = 0; at < lines.size(); ++at) {
      const bool harmless = is_comment(lines[at]) || lines[at] == "\n" || lines[at].starts_with("#ALTA") ||
                            lines[at].starts_with("# PARAM2") || (!sample.counted && lines[at][0] != '#');
      if (harmless) continue;
      check_refused(sample.format, joined(lines, at + 1) + lines[at] +
                                       joined(lines, lines.size()).substr(joined(lines, at + 1).size()));
    }
  }
}

TEST_CASE("a cell more or less in a row is refused", "[fit][formats]") {
  for (const Sample& sample : kSamples) {
    const std::vector<std::string> lines = lines_of(content(sample));
    const std::size_t last = sample.name == std::string("vinyl.bsdf") || sample.format == std::string("lighttools")
                                 ? lines.size() - 2
                                 : lines.size() - 1;
    for (const bool more : {true, false}) {
      std::vector<std::string> changed = lines;
      std::string& row = changed[last];
      const std::size_t cut = row.find_last_of(" \t,");
      const char separator = row.find(',') == row.npos ? ' ' : ',';
      row = more ? row.substr(0, row.size() - 1) + separator + "1\n"
                 : (cut == row.npos ? std::string("\n") : row.substr(0, cut) + "\n");
      check_refused(sample.format, joined(changed, changed.size()));
    }
  }
}

TEST_CASE("bytes that are no text are refused", "[fit][formats]") {
  for (const Sample& sample : kSamples) {
    const std::string good = content(sample);
    check_refused(sample.format, "");
    check_refused(sample.format, "\n \n");
    check_refused(sample.format, std::string("\x89PNG\r\n\x1a\n\0\0", 10), "not text");
    check_refused(sample.format, good + std::string(1, '\0'), "not text");
    check_refused(sample.format, good + "\x7f", "not text");
    check_refused(sample.format, "theta_i_deg,phi_i_deg\n1,2\n");
  }
}

TEST_CASE("what each format forbids is refused", "[fit][formats]") {
  struct Change {
    const char *format, *what, *with, *words;
  };
  const Change changes[] = {
      {"astm", "NUM_POINTS 4", "NUM_POINTS 5", "4 rows"},
      {"astm", "NUM_POINTS 4", "NUM_POINTS 3", "more rows"},
      {"astm", "NUM_POINTS 4", "NUM_POINTS 99999999999999999999", "NUM_POINTS"},
      {"astm", "NUM_POINTS 4\n", "", "NUM_POINTS is missing"},
      {"astm", "theta_i,phi_i", "theta_i,theta_i", "twice"},
      {"astm", "theta_s,", "theta_s,theta_r,", "twice"},
      {"astm", ",phi_s", "", "lacks an angle"},
      {"astm", ",465nm,525nm,630nm", "", "names no value"},
      {"astm", "465nm", "fog", "3 values"},
      {"astm", "465nm", "5nm", "100 to 100000"},
      {"astm", "MEAS_NAME BRDF", "MEAS_NAME BTDF", "BTDF"},
      {"astm", "APERTURE", "aperture", "no key"},
      {"astm", "APERTURE Circular", "ANGLE_UNITS turns", "degrees or radians"},
      {"astm", "APERTURE Circular", "QUANTITY brightness", "brdf_cos"},
      {"astm", "0.5235987755982988,0,0.26", "30,0,0.26", "pi/2"},
      {"astm", "0.5235987755982988,0,0.26", "-0.1,0,0.26", "theta_i is -0.1"},
      {"zemax", "Measured", "Guessed", "Source"},
      {"zemax", "PlaneSymmetrical", "Round", "Symmetry"},
      {"zemax", "  Monochrome", "  RGB", "SpectralContent"},
      {"zemax", "  Monochrome", "  XYZ", "TristimulusX"},
      {"zemax", "BRDF", "BTDF", "BTDF"},
      {"zemax", "AngleOfIncidence  2", "AngleOfIncidence  3", "expected"},
      {"zemax", "AngleOfIncidence  2", "AngleOfIncidence  1", "expected"},
      {"zemax", "AngleOfIncidence  2", "AngleOfIncidence  900000", "as many"},
      {"zemax", "AngleOfIncidence  2", "AngleOfIncidence  -2", "whole number"},
      {"zemax", "AngleOfIncidence  2\n0\t30", "AngleOfIncidence  0\n", "0 angles"},
      {"zemax", "0\t30", "30\t0", "increasing"},
      {"zemax", "0\t30", "0\t95", "95"},
      {"zemax", "0\t90\t180", "0\t90\t190", "190"},
      {"zemax", "0\t15\t60", "0\t60\t60", "increasing"},
      {"zemax", "DataBegin", "Databegin", "DataBegin"},
      {"zemax", "TIS 0.25", "TIS -1", "TIS"},
      {"zemax", "DataEnd", "DataEnd more", "after DataEnd"},
      {"lighttools", "Asymmetric", "Round", "Symmetry"},
      {"lighttools", "Monochrome", "RGB", "XYZ"},
      {"lighttools", "Monochrome", "XYZ", "TristimulusValue"},
      {"lighttools", "AOI 30", "AOI 91", "AOI"},
      {"lighttools", "POI 0", "POI 45", "POI"},
      {"lighttools", "POI 0\n", "", "not whole"},
      {"lighttools", "Side Front", "Side Top", "Front or Back"},
      {"lighttools", "ScatterType BRDF", "ScatterType BSDF", "BRDF or BTDF"},
      {"lighttools", "ScatterType BRDF", "ScatterType BTDF", "no usable point"},
      {"lighttools", "Wavelength 550", "Wavelength 0.55", "Wavelength"},
      {"lighttools", "ScatterRadial 2\n", "ScatterRadial 1\n", "expected"},
      {"lighttools", "0 45\n", "0 135\n", "135"},
      {"lighttools", "ScatterAzimuth 4\n0 90 180 270\n", "", "too early"},
      {"lighttools", "AOI 30", "Angle 30", "no keyword"},
      {"alta", "#DIM 3 1", "#DIM 4 1", "3 for"},
      {"alta", "#DIM 3 1", "#DIM 3", "expected 2"},
      {"alta", "#DIM 3 1", "#DIM 3 2", "1 or 3"},
      {"alta", "#DIM 3 1", "#DIM 1000000000 1", "whole number"},
      {"alta", "#DIM 3 1\n", "", "#VS"},
      {"alta", "#VS 1\n", "", "row has 5"},
      {"alta", "#VS 1", "#VS 3", "#VS"},
      {"alta", "#VS 1", "#VS 1 1", "#VS"},
      {"alta", "#VS 1", "#FORMAT binary", "binary"},
      {"alta", "ISOTROPIC_TV_TL_DPHI", "STARK_3D", "#PARAM_IN"},
      {"alta", "ISOTROPIC_TV_TL_DPHI", "", "no name"},
      {"alta", "ISOTROPIC_TV_TL_DPHI", "RUSIN_TH_TD_PD", "cosine"},
      {"alta", "INV_STERADIAN_COSINE_FACTOR", "ENERGY", "#PARAM_OUT"},
      {"alta", "INV_STERADIAN_COSINE_FACTOR", "RGB_COLOR", "3 for"},
      {"alta", "#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n", "", "not whole"},
      {"alta", "1.0471975511965976", "60", "pi/2"},
      {"alta", "1.0471975511965976", "-0.5", "-0.5"},
      {"alta", "0.02\n", "0.02\n#DIM 3 1\n", "among the rows"},
      {"ssdd", "VERSION 0.2", "VERSION 9", "VERSION"},
      {"ssdd", "SOFTWARE", "TOOL", "no entry"},
      {"ssdd", "DATA_TYPE brdf", "DATA_TYPE bssrdf", "DATA_TYPE"},
      {"ssdd", "DATA_TYPE specular_reflectance", "DATA_TYPE brdf", "second block"},
      {"ssdd", "COLOR_MODEL rgb", "COLOR_MODEL cmyk", "COLOR_MODEL"},
      {"ssdd", "COLOR_MODEL rgb", "COLOR_MODEL monochrome", "channels"},
      {"ssdd", "COLOR_MODEL rgb", "COLOR_MODEL spectrum", "WAVELENGTH_LIST"},
      {"ssdd", "COLOR_MODEL rgb", "COLOR_MODEL rgb\nWAVELENGTH_LIST 400", "WAVELENGTH_LIST"},
      {"ssdd", "COLOR_MODEL rgb\n", "", "COLOR_MODEL is missing"},
      {"ssdd", "spherical_coordinate_system", "plane", "PARAM_TYPE"},
      {"ssdd", "PARAM_TYPE spherical_coordinate_system\n", "", "PARAM_TYPE is missing"},
      {"ssdd", "PARAM0_LIST 0 30", "PARAM0_LIST 30 0", "increasing"},
      {"ssdd", "PARAM0_LIST 0 30", "PARAM0_LIST 0 100", "100"},
      {"ssdd", "PARAM0_LIST 0 30", "PARAM0_LIST 0 30 60", "expected"},
      {"ssdd", "PARAM0_LIST 0 30", "PARAM0_LIST", "empty"},
      {"ssdd", "PARAM0_LIST 0 30\n", "", "PARAM0_LIST is missing"},
      {"ssdd", "PARAM2_LIST 0 45\n", "", "PARAM2_LIST is missing"},
      {"ssdd", "PARAM3_LIST 0 180\n", "PARAM3_LIST 0 180\nPARAM2_LIST 0\n", "twice"},
      {"ssdd", "PARAM3_LIST 0 180", "PARAM4_LIST 5 5", "expected"},
      {"ssdd", "NAME bluish\n", "NAME bluish\nPARAM4_LIST 0 0\n", "too late"},
      {"ssdd", "NAME bluish\n", "COLOUR bluish\n", "no entry"},
      {"ssdd", "DATA ascii", "DATA binary", "DATA"},
      {"ssdd", "spherical_coordinate_system\n", "spherical_coordinate_system\nREDUCTION_TYPE reciprocity\n", "alone"},
      {"ssdd", "spherical_coordinate_system\n", "spherical_coordinate_system\nREDUCTION_TYPE magic\n",
       "REDUCTION_TYPE"},
      {"table", "# angles: degrees\n", "", "angles"},
      {"table", "# quantity: brdf_cos\n", "", "quantity"},
      {"table", "# azimuth: signed\n", "", "azimuth"},
      {"table", "# columns: theta_i theta_r value std\n", "", "columns"},
      {"table", "degrees", "gon", "radians"},
      {"table", "brdf_cos", "gloss", "quantity"},
      {"table", "signed", "north", "azimuth"},
      {"table", "signed", "180 = mirror", "phi"},
      {"table", "theta_i theta_r value std", "theta_i theta_r value phi", "signed"},
      {"table", "theta_i theta_r value std", "theta_i theta_r std value std", "twice"},
      {"table", "theta_i theta_r value std", "theta_i theta_r value fog", "fog"},
      {"table", "theta_i theta_r value std", "theta_i theta_r skip std", "value among them"},
      {"table", "theta_i theta_r value std", "theta_i theta_r value", "row has 4"},
      {"table", "points: 4", "points: 5", "4 rows"},
      {"table", "550", "0.55", "wavelength_nm"},
      {"table", "10  -30", "10  -91", "90 degrees"},
      {"table", "10  -30", "91  -30", "90 degrees"},
      {"table", "0.25   0.01", "0.25   -0.01", "std is negative"},
  };
  for (const Change& change : changes)
    for (const Sample& sample : kSamples)
      if (sample.format == std::string(change.format))
        check_refused(sample.format, replaced(content(sample), change.what, change.with), change.words);
}

TEST_CASE("broken MERL files are refused by offset, before their cells are read", "[fit][formats]") {
  const auto head = [](std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::int32_t dims[3] = {a, b, c};
    return std::string(reinterpret_cast<const char*>(dims), sizeof dims);
  };
  for (std::size_t size = 0; size < 12; ++size) check_refused("merl", head(90, 90, 180).substr(0, size), "head");
  check_refused("merl", head(90, 90, 180), "34992012");
  check_refused("merl", head(90, 90, 360), "offset 8");
  check_refused("merl", head(91, 90, 180), "offset 0");
  check_refused("merl", head(90, -90, 180), "offset 4");
  check_refused("merl", head(2147483647, 2147483647, 2147483647), "offset 0");
  std::string bytes = merl_bytes([](double, double, double, int) { return 0.25; });
  check_refused("merl", bytes.substr(0, bytes.size() - 1), "ends here");
  check_refused("merl", bytes + "x", "goes on");
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double value : {nan, infinity, -infinity}) {
    std::memcpy(bytes.data() + 12 + 8 * 1000, &value, sizeof value);
    check_refused("merl", bytes, "offset 8012");
  }
  check_refused("merl", merl_bytes([](double, double, double, int) { return -1.0; }), "no cell");
}

TEST_CASE("the broken files of all formats are many", "[fit][formats]") {
  if (refused.empty()) return;  // run alone
  INFO(refused.size() << " distinct broken files were refused");
  CHECK(refused.size() >= 120);
}
