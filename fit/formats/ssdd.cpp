// Surface Scattering Distribution Data, version 0.2 (R. Kimura, SSDD file format specification, 2023-08-14, libbsdf):
// VERSION and a file header, then up to four blocks of meta-data (DATA_TYPE … DATA) with a table each, a colour a line,
// PARAM0 running fastest. Of the blocks the brdf is read; the others are checked and left out. Binary tables are
// refused: the specification does not say whether their numbers have 4 or 8 bytes.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/error.h"
#include "fit/csv.h"
#include "fit/formats/collect.h"
#include "fit/formats/readers.h"
#include "fit/formats/text.h"

namespace gonio {
namespace {

constexpr std::array<std::string_view, 10> kOrder{"DATA_TYPE",      "COLOR_MODEL", "WAVELENGTH_LIST", "PARAM_TYPE",
                                                  "REDUCTION_TYPE", "PARAM0_LIST", "PARAM1_LIST",     "PARAM2_LIST",
                                                  "PARAM3_LIST",    "PARAM4_LIST"};
constexpr std::array<std::string_view, 5> kTexts{"NAME", "SOURCE_TYPE", "DEVICE", "CREATION_DATE", "MEASUREMENT_DATE"};

struct Entry {
  std::string_view key, value;
  int line = 1;
};

Entry entry_of(const TextLine& at) {
  const std::size_t gap = at.text.find_first_of(" \t");
  if (gap == at.text.npos) return {at.text, {}, at.line};
  std::string_view value = at.text.substr(gap + 1);
  while (!value.empty() && (value.front() == ' ' || value.front() == '\t')) value.remove_prefix(1);
  return {at.text.substr(0, gap), value, at.line};
}

struct Block {
  std::map<std::string_view, Entry> entries;
  std::array<std::vector<double>, 5> lists;
  std::vector<double> wavelengths_nm;
  std::size_t channels = 1, used = 0;
  int line = 1;

  std::string_view value(std::string_view key) const {
    const auto found = entries.find(key);
    return found == entries.end() ? std::string_view{} : found->second.value;
  }
};

/// Lines without comments and blank ones.
class Lines {
 public:
  Lines(std::string_view bytes, const std::string& file) : file_(file) {
    for (const TextLine& at : text_lines(bytes, file)) {
      if (!at.text.empty() && at.text[0] != '#') lines_.push_back(at);
      last_ = at.line;
    }
  }
  const TextLine* peek() const { return at_ < lines_.size() ? &lines_[at_] : nullptr; }
  TextLine next(std::string_view expected) {
    if (at_ == lines_.size()) throw input_error("{}:{}: the file ends here; expected {}", file_, last_, expected);
    return lines_[at_++];
  }
  std::size_t left() const { return lines_.size() - at_; }

 private:
  const std::string& file_;
  std::vector<TextLine> lines_;
  std::size_t at_ = 0;
  int last_ = 1;
};

std::vector<double> list_of(const Entry& entry, double lo, double hi, bool increasing, const std::string& file) {
  std::vector<double> list;
  for (const std::string_view word : words_of(entry.value)) {
    const double number = csv_number(word, entry.key, file, entry.line);
    if (!(number >= lo && number <= hi) || (increasing && !list.empty() && !(number > list.back())))
      throw input_error("{}:{}: {} holds {}; expected {}numbers from {} to {}", file, entry.line, entry.key, number,
                        increasing ? "increasing " : "", lo, hi);
    list.push_back(number);
  }
  if (list.empty()) throw input_error("{}:{}: {} is empty; expected numbers", file, entry.line, entry.key);
  return list;
}

void require_one_of(const Block& block, std::string_view key, std::initializer_list<std::string_view> allowed,
                    const std::string& file) {
  const auto found = block.entries.find(key);
  if (found == block.entries.end())
    throw input_error("{}:{}: {} is missing; expected {}", file, block.line, key,
                      fmt::format("{}", fmt::join(allowed, " or ")));
  if (std::find(allowed.begin(), allowed.end(), found->second.value) == allowed.end())
    throw input_error("{}:{}: {} is `{}`; expected {}", file, found->second.line, key, printable(found->second.value),
                      fmt::format("{}", fmt::join(allowed, " or ")));
}

/// DATA_TYPE to DATA: known keys, each once, in the specified order.
Block read_entries(Lines& lines, const std::string& file) {
  Block block;
  std::size_t rank = 0;
  for (bool first = true;; first = false) {
    const Entry entry = entry_of(lines.next("DATA"));
    block.line = entry.line;
    if (first && entry.key != "DATA_TYPE")
      throw input_error("{}:{}: `{}` stands here; expected DATA_TYPE", file, entry.line, printable(entry.key));
    if (!block.entries.emplace(entry.key, entry).second)
      throw input_error("{}:{}: {} appears twice; expected once", file, entry.line, printable(entry.key));
    if (entry.key == "DATA") return block;
    const auto place = std::find(kOrder.begin(), kOrder.end(), entry.key);
    if (place == kOrder.end()) {
      if (std::find(kTexts.begin(), kTexts.end(), entry.key) == kTexts.end())
        throw input_error("{}:{}: `{}` is no entry of meta-data; expected those up to DATA", file, entry.line,
                          printable(entry.key));
      rank = kOrder.size();
      continue;
    }
    const auto here = static_cast<std::size_t>(place - kOrder.begin());
    if (here < rank)
      throw input_error("{}:{}: {} comes too late; expected the specified order", file, entry.line, entry.key);
    rank = here;
  }
}

void read_colours(Block& block, const std::string& file) {
  require_one_of(block, "COLOR_MODEL", {"monochrome", "rgb", "xyz", "spectrum"}, file);
  const std::string_view model = block.value("COLOR_MODEL");
  const bool listed = block.entries.contains("WAVELENGTH_LIST");
  if (listed != (model == "spectrum"))
    throw input_error("{}:{}: WAVELENGTH_LIST is {}; expected it with COLOR_MODEL spectrum alone", file, block.line,
                      listed ? "given" : "missing");
  if (listed) block.wavelengths_nm = list_of(block.entries.at("WAVELENGTH_LIST"), 100, 1e5, true, file);
  block.channels = listed ? block.wavelengths_nm.size() : model == "monochrome" ? 1 : 3;
  block.used = block.channels == 3 && !listed ? 1 : 0;
}

void read_parameters(Block& block, const std::string& file) {
  const bool scatter = block.value("DATA_TYPE") == "brdf" || block.value("DATA_TYPE") == "btdf";
  if (scatter)
    require_one_of(block, "PARAM_TYPE",
                   {"spherical_coordinate_system", "specular_coordinate_system", "half_difference_coordinate_system"},
                   file);
  const std::string_view type = block.value("PARAM_TYPE");
  double around = 360;
  for (const std::string_view word : words_of(block.value("REDUCTION_TYPE"))) {
    if (word != "bilateral_symmetry" && word != "reciprocity")
      throw input_error("{}:{}: REDUCTION_TYPE is `{}`; expected bilateral_symmetry or reciprocity", file, block.line,
                        printable(word));
    if (word == "reciprocity" && !type.starts_with("half"))
      throw input_error(
          "{}:{}: REDUCTION_TYPE is reciprocity; expected it with half_difference_coordinate_system alone", file,
          block.line);
    around /= 2;
  }
  const std::array<double, 5> most{90, 360, type.starts_with("specular") ? 180.0 : 90.0, around, 90};
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string key = fmt::format("PARAM{}_LIST", k);
    const auto found = block.entries.find(key);
    if (found != block.entries.end()) {
      block.lists[k] = list_of(found->second, k == 4 ? -90 : 0, most[k], k != 4, file);
    } else if (k == 1) {
      block.lists[k] = {0};  // isotropic
    } else if (k == 0 || (scatter && k != 4)) {
      throw input_error("{}:{}: {} is missing; expected a list of angles in degrees", file, block.line, key);
    } else if (k != 4) {
      block.lists[k] = {0};
    }
  }
  for (const double offset : block.lists[4])
    if (offset != 0 || block.lists[4].size() != block.lists[0].size())
      throw input_error("{}:{}: PARAM4_LIST holds {}; expected no offsets from the mirror direction in reflection",
                        file, block.line, offset);
}

DirectionPair directions(const Block& block, const std::array<double, 4>& p) {
  const std::string_view type = block.value("PARAM_TYPE");
  if (type.starts_with("half")) return from_half_difference_deg(p[0], p[1], p[2], p[3]);
  if (type.starts_with("specular")) return from_mirror_deg(p[0], p[1], p[2], p[3]);
  return {direction_from_deg(p[0], p[1]), direction_from_deg(p[2], p[3])};
}

void add_colour(const TextLine& row, const Block& block, const DirectionPair* pair, PointCollector& points,
                const std::string& file) {
  const std::vector<std::string_view> words = words_of(row.text);
  if (words.size() != block.channels)
    throw input_error("{}:{}: {} numbers stand here; expected {} (the channels of COLOR_MODEL)", file, row.line,
                      words.size(), block.channels);
  for (std::size_t c = 0; c < words.size(); ++c) {
    const double value = csv_number(words[c], "the value", file, row.line);
    if (pair == nullptr) continue;
    if (!block.wavelengths_nm.empty())
      points.add_of_grid(*pair, block.wavelengths_nm[c], value, row.line);
    else if (c == block.used)
      points.add_of_grid(*pair, kNotStated, value, row.line);
  }
}

void read_table(Lines& lines, const Block& block, bool used, PointCollector& points, const std::string& file) {
  const auto& lists = block.lists;
  const double rows =
      double(lists[0].size()) * double(lists[1].size()) * double(lists[2].size()) * double(lists[3].size());
  if (rows > double(lines.left()))
    throw input_error("{}:{}: the lists ask for {} rows and {} are left; expected as many", file, block.line, rows,
                      lines.left());
  for (const double p3 : lists[3])
    for (const double p2 : lists[2])
      for (const double p1 : lists[1])
        for (const double p0 : lists[0]) {
          const TextLine row = lines.next("a row of values");
          const DirectionPair pair = used ? directions(block, {p0, p1, p2, p3}) : DirectionPair{};
          add_colour(row, block, used ? &pair : nullptr, points, file);
        }
}

void set_conventions(const Block& block, Measurement& scan) {
  const std::string_view type = block.value("PARAM_TYPE"), model = block.value("COLOR_MODEL");
  scan.name = block.value("NAME"), scan.instrument = block.value("DEVICE");
  scan.conventions = {
      "quantity: brdf", "angles: degrees",
      type.starts_with("half")
          ? "azimuth: half and difference angles (Rusinkiewicz), 0 in the plane of half vector and normal"
      : type.starts_with("specular")
          ? "azimuth: about the mirror direction, 0 towards the normal, counter-clockwise"
          : "azimuth: both directions in one frame, phi = PARAM3 - PARAM1, 180 = mirror side",
      "scale: absolute, sr^-1",
      model == "rgb"          ? "channel: G of R, G, B"
      : model == "xyz"        ? "channel: Y of X, Y, Z"
      : model == "monochrome" ? "channel: monochrome, wavelength not stated"
                              : "channel: every wavelength"};
  if (!block.value("REDUCTION_TYPE").empty())
    scan.conventions.push_back(
        fmt::format("symmetry: {}; the rest is not repeated", printable(block.value("REDUCTION_TYPE"))));
}

void read_file_header(Lines& lines, const std::string& file) {
  const Entry version = entry_of(lines.next("VERSION"));
  if (version.key != "VERSION" || (version.value != "0.1" && version.value != "0.2"))
    throw input_error("{}:{}: `{} {}` stands here; expected VERSION 0.1 or 0.2", file, version.line,
                      printable(version.key), printable(version.value));
  std::set<std::string_view> seen;
  while (lines.peek() != nullptr && entry_of(*lines.peek()).key != "DATA_TYPE") {
    const Entry entry = entry_of(lines.next("DATA_TYPE"));
    if (entry.key != "SOFTWARE" && entry.key != "API" && entry.key != "DATE")
      throw input_error("{}:{}: `{}` is no entry of the file header; expected SOFTWARE, API, DATE or DATA_TYPE", file,
                        entry.line, printable(entry.key));
    if (!seen.insert(entry.key).second)
      throw input_error("{}:{}: {} appears twice; expected once", file, entry.line, entry.key);
  }
}

}  // namespace

bool is_ssdd(std::string_view head) { return head.starts_with("VERSION ") && head.find("DATA_TYPE ") != head.npos; }

Measurement read_ssdd(std::string_view bytes, const std::string& file) {
  Lines lines(bytes, file);
  read_file_header(lines, file);
  PointCollector points({}, file);
  std::set<std::string_view> types;
  int line = 1;
  do {
    Block block = read_entries(lines, file);
    line = block.line;
    require_one_of(block, "DATA_TYPE", {"brdf", "btdf", "specular_reflectance", "specular_transmittance"}, file);
    require_one_of(block, "DATA", {"ascii"}, file);
    const std::string_view type = block.value("DATA_TYPE");
    if (!types.insert(type).second)
      throw input_error("{}:{}: a second block of {}; expected each once", file, line, type);
    read_colours(block, file);
    read_parameters(block, file);
    const bool used = type == "brdf";
    if (used)
      set_conventions(block, points.scan());
    else
      points.scan().notes.push_back(fmt::format("block {} is not used", type));
    read_table(lines, block, used, points, file);
  } while (lines.peek() != nullptr);
  return points.finish(line);
}

}  // namespace gonio
