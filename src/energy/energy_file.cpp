#include "energy/energy_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/digest.h"
#include "base/error.h"
#include "base/files.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using Cell = EnergyTable::Cell;

constexpr int kVersion = 2;
constexpr std::size_t kMostSide = 256;  // a small file shall not ask for much memory

std::string channel(std::size_t node) { return fmt::format("weight_{:02}", node); }

std::string checksum(const EnergyTable& table) {
  std::uint64_t digest = digest_of(fmt::format("{}|{}|{}|{}|{:a}", kVersion, table.family().name, table.grid().rows,
                                               table.grid().columns, table.grid().widest));
  for (const Cell& cell : table.cells())
    digest = digest_of({reinterpret_cast<const char*>(&cell), sizeof cell}, digest);
  return fmt::format("{:016x}", digest);
}

double white(const Cell& cell) {
  double sum = 0;
  for (const float weight : cell.weight) sum += double(weight);
  return sum;
}

struct Grids {
  std::vector<double> theta_deg, alpha;
  explicit Grids(const EnergyGrid& grid) {
    for (std::size_t c = 0; c < grid.columns; ++c)
      theta_deg.push_back(std::acos(grid.cos_theta(c)) * 180 / kPi<double>);
    for (std::size_t r = 0; r < grid.rows; ++r) alpha.push_back(grid.alpha(r));
  }
};

std::string csv_of(const EnergyTable& table, const Grids& grids) {
  std::string text = "theta_deg,alpha,E,error\n";
  for (std::size_t r = 0; r < grids.alpha.size(); ++r)
    for (std::size_t c = 0; c < grids.theta_deg.size(); ++c) {
      const Cell& cell = table.cell(r, c);
      text +=
          fmt::format("{:.10g},{:.10g},{:.8g},{:.2g}\n", grids.theta_deg[c], grids.alpha[r], white(cell), cell.error);
    }
  return text;
}

std::string text_of(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
  if (!attribute) throw input_error("attribute {} is missing; expected a table of E", name);
  return attribute->value();
}

/// Before it looks at the pixels OpenEXR makes room for whatever an attribute claims: none may be longer than the file, the
/// window no larger than a table, the layout no other than lines of one part.
void check_claims(std::string_view bytes) {
  constexpr std::size_t kStart = 8;  // magic number and version
  constexpr std::array<std::string_view, 8> kTypes{"int",   "string",    "chlist", "compression",
                                                   "box2i", "lineOrder", "float",  "v2f"};
  const auto whole = [](bool yes) {
    if (!yes) throw input_error("is no whole OpenEXR file of a table's layout; expected a table of E");
  };
  const auto text_end = [&](std::size_t from) {
    const std::size_t end = bytes.find('\0', from);
    whole(end != bytes.npos);
    return end;
  };
  whole(bytes.size() > kStart && (bytes[5] & ~0x04) == 0 && bytes[6] == 0 && bytes[7] == 0);  // 0x04: long names
  for (std::size_t at = kStart; text_end(at) != at;) {
    const std::string_view name = bytes.substr(at, text_end(at) - at);
    const std::size_t type_at = at + name.size() + 1, length_at = text_end(type_at) + 1;
    const std::string_view type = bytes.substr(type_at, length_at - 1 - type_at);
    whole(std::ranges::find(kTypes, type) != kTypes.end());  // previews and lists hold further claims
    std::int32_t length = -1;
    if (length_at + sizeof length <= bytes.size()) std::memcpy(&length, &bytes[length_at], sizeof length);
    at = length_at + sizeof length;
    whole(length >= 0 && at <= bytes.size() && static_cast<std::size_t>(length) <= bytes.size() - at);
    if (name.ends_with("Window")) {
      std::array<std::int32_t, 4> box{};
      whole(static_cast<std::size_t>(length) == sizeof box);
      std::memcpy(box.data(), &bytes[at], sizeof box);
      for (const std::int32_t side : box) whole(side >= 0 && static_cast<std::size_t>(side) < kMostSide);
    }
    at += static_cast<std::size_t>(length);
  }
}

EnergyTable read_pixels(const fs::path& path) {
  Imf::InputFile in(path.string().c_str(), 1);
  const Imf::Header& header = in.header();
  const auto* version = header.findTypedAttribute<Imf::IntAttribute>("gonio_energy");
  if (!version || version->value() != kVersion)
    throw input_error("is no table of E of version {}; expected one made by this version of `gonio table`", kVersion);
  const LobeFamily& family = lobe_family(text_of(header, "family"));
  const auto box = header.dataWindow();
  const auto columns = static_cast<std::size_t>(std::int64_t{box.max.x} - box.min.x) + 1,
             rows = static_cast<std::size_t>(std::int64_t{box.max.y} - box.min.y) + 1;
  if (rows > kMostSide || columns > kMostSide || box.min.x != 0 || box.min.y != 0)
    throw input_error("{} x {} places; expected at most {} each way", rows, columns, kMostSide);
  std::vector<Cell> cells(rows * columns);
  Imf::FrameBuffer buffer;
  const auto take = [&](const std::string& name, float* first) {
    if (!header.channels().findChannel(name.c_str()))
      throw input_error("channel {} is missing; expected a table of E", name);
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), sizeof(Cell), sizeof(Cell) * columns));
  };
  for (std::size_t i = 0; i < kCosNodes; ++i) take(channel(i), &cells[0].weight[i]);
  take("error", &cells[0].error);
  in.setFrameBuffer(buffer);
  in.readPixels(0, static_cast<int>(rows) - 1);
  EnergyTable table(family, {rows, columns, family.widest}, std::move(cells));
  if (checksum(table) != text_of(header, "checksum"))
    throw input_error("its numbers have another checksum than it says; expected an unchanged file");
  return table;
}

}  // namespace

void write_energy_table(const EnergyTable& table, const fs::path& exr) {
  fs::path csv = exr;
  csv.replace_extension(".csv");
  if (csv == exr) throw input_error("{}: has the extension of its CSV; expected a name such as T.exr", exr.string());
  const std::size_t columns = table.grid().columns, rows = table.grid().rows;
  const Grids grids(table.grid());
  std::vector<float> e;
  for (const Cell& cell : table.cells()) e.push_back(static_cast<float>(white(cell)));
  Imf::Header header(static_cast<int>(columns), static_cast<int>(rows));
  header.insert("gonio_energy", Imf::IntAttribute(kVersion));
  const auto say = [&](const char* name, const std::string& value) {
    header.insert(name, Imf::StringAttribute(value));
  };
  say("family", std::string(table.family().name));
  say("described", std::string(table.family().described));
  say("quantity", "E(theta; alpha) = sum of weight_i R(cos_d_i), ks = 1 (dimensionless); channel E: R = 1");
  say("theta_deg", fmt::format("{}", fmt::join(grids.theta_deg, " ")));
  say("alpha", fmt::format("{}", fmt::join(grids.alpha, " ")));
  say("cos_d", fmt::format("{}", fmt::join(cos_nodes(), " ")));
  say("largest_error", fmt::format("{}", EnergyTable::kError));
  say("checksum", checksum(table));
  Imf::FrameBuffer buffer;
  const auto add = [&](const std::string& name, const float* first, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(first)), stride,
                                   stride * columns));
  };
  for (std::size_t i = 0; i < kCosNodes; ++i) add(channel(i), &table.cells()[0].weight[i], sizeof(Cell));
  add("error", &table.cells()[0].error, sizeof(Cell)), add("E", e.data(), sizeof(float));
  WholeFile file(exr);
  {
    Imf::OutputFile out(file.temporary().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(static_cast<int>(rows));
  }
  write_file(csv, csv_of(table, grids));
  file.commit();
}

EnergyTable read_energy_table(const fs::path& exr) {
  if (!fs::is_regular_file(exr)) throw input_error("{}: cannot be read; expected a table of E", exr.string());
  try {
    check_claims(read_file(exr));
    return read_pixels(exr);
  } catch (const InputError& error) {
    throw input_error("{}: {}", exr.string(), error.what());
  } catch (const std::exception& error) {
    throw input_error("{}: is no readable OpenEXR file ({}); expected a table of E", exr.string(), error.what());
  }
}

void check_is_current(const EnergyTable& table) {
  constexpr std::size_t kProbes = 5;  // each way
  const EnergyGrid& grid = table.grid();
  for (std::size_t r = 0; r < kProbes; ++r)
    for (std::size_t c = 0; c < kProbes; ++c) {
      const std::size_t row = r * (grid.rows - 1) / (kProbes - 1), column = c * (grid.columns - 1) / (kProbes - 1);
      const Cell anew = EnergyTable::made(table.family(), grid.cos_theta(column), grid.alpha(row));
      const Cell& held = table.cell(row, column);
      for (std::size_t i = 0; i < kCosNodes; ++i)
        if (!(std::abs(anew.weight[i] - held.weight[i]) <= 1e-5F))
          throw input_error(
              "{}: a stale table, at alpha {:.4g} and {:.4g} degrees weight {} is {}; expected {} (make it anew)",
              table.family().name, grid.alpha(row), std::acos(grid.cos_theta(column)) * 180 / kPi<double>, i,
              held.weight[i], anew.weight[i]);
    }
}

}  // namespace gonio
