#include "energy/node_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/digest.h"
#include "base/error.h"
#include "base/files.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 1;
constexpr std::size_t kMostSide = 4096;

std::string channel(std::size_t number) {
  const std::size_t nodes = CosNodes::kCount;
  return fmt::format("{}_{}", number < nodes ? "cos_d" : "weight", number % nodes);
}

std::string shadowing_of(const ModelSpec& spec) {
  return spec.info().shadowings.empty() ? "none given" : std::string(name_of(spec.shadowing));
}

std::string checksum(const NodeTable& table) {
  std::uint64_t digest = digest_of(fmt::format("{}|{}|{}|{}|{}", kVersion, table.spec().info().name,
                                               shadowing_of(table.spec()), table.grid().rows, table.grid().columns));
  for (std::size_t cell = 0; cell < table.cells(); ++cell)
    for (const float number : table.numbers(cell))
      digest = digest_of({reinterpret_cast<const char*>(&number), sizeof number}, digest);
  return fmt::format("{:016x}", digest);
}

float white(const NodeTable& table, std::size_t cell) {
  float sum = 0;
  for (std::size_t i = 0; i < CosNodes::kCount; ++i) sum += table.numbers(cell)[CosNodes::kCount + i];
  return sum;
}

std::string csv_of(const NodeTable& table) {
  std::string text = "theta_deg,m,E\n";
  for (std::size_t cell = 0; cell < table.cells(); ++cell)
    text += fmt::format("{:.8g},{:.8g},{:.8g}\n", table.theta_deg(cell), table.width(cell), white(table, cell));
  return text;
}

std::string text_of(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
  if (!attribute) throw input_error("attribute {} is missing; expected a table of nodes", name);
  return attribute->value();
}

ModelSpec spec_of(const Imf::Header& header) {
  ModelSpec spec;
  spec.id = model(text_of(header, "model")).id;
  if (const std::string shadowing = text_of(header, "shadowing"); !spec.info().shadowings.empty())
    set_shadowing(spec, shadowing);
  return spec;
}

NodeTable read_pixels(const fs::path& path) {
  Imf::InputFile in(path.string().c_str(), 1);
  const Imf::Header& header = in.header();
  const auto* version = header.findTypedAttribute<Imf::IntAttribute>("gonio_nodes");
  if (!version || version->value() != kVersion)
    throw input_error("is no table of nodes of version {}; expected one made by `gonio table nodes`", kVersion);
  const auto box = header.dataWindow();
  const auto columns = static_cast<std::size_t>(box.max.x - box.min.x) + 1,
             rows = static_cast<std::size_t>(box.max.y - box.min.y) + 1;
  if (rows > kMostSide || columns > kMostSide || box.min.x != 0 || box.min.y != 0)
    throw input_error("{} x {} places; expected at most {} each way", rows, columns, kMostSide);
  std::vector<NodeTable::Numbers> cells(rows * columns);
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < NodeTable::kNumbers; ++i) {
    if (!header.channels().findChannel(channel(i).c_str()))
      throw input_error("channel {} is missing; expected a table of nodes", channel(i));
    buffer.insert(channel(i), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&cells[0].number[i]), sizeof cells[0],
                                         sizeof cells[0] * columns));
  }
  in.setFrameBuffer(buffer);
  in.readPixels(0, static_cast<int>(rows) - 1);
  NodeTable table(spec_of(header), {rows, columns}, std::move(cells));
  if (checksum(table) != text_of(header, "checksum"))
    throw input_error("its numbers have another checksum than it says; expected an unchanged file");
  return table;
}

}  // namespace

void write_node_table(const NodeTable& table, const fs::path& exr) {
  fs::path csv = exr;
  csv.replace_extension(".csv");
  if (csv == exr) throw input_error("{}: has the extension of its CSV; expected a name such as N.exr", exr.string());
  const std::size_t columns = table.grid().columns, rows = table.grid().rows;
  std::vector<float> e, theta, widths;
  for (std::size_t cell = 0; cell < table.cells(); ++cell)
    e.push_back(white(table, cell)), theta.push_back(static_cast<float>(table.theta_deg(cell)));
  for (std::size_t row = 0; row < rows; ++row) widths.push_back(static_cast<float>(table.width(row * columns)));
  Imf::Header header(static_cast<int>(columns), static_cast<int>(rows));
  header.insert("gonio_nodes", Imf::IntAttribute(kVersion));
  header.insert("model", Imf::StringAttribute(std::string(table.spec().info().name)));
  header.insert("shadowing", Imf::StringAttribute(shadowing_of(table.spec())));
  header.insert("quantity", Imf::StringAttribute("E(theta; m) = sum of weight_i R(cos_d_i), ks = 1 (dimensionless)"));
  header.insert("slope_rms_m", Imf::StringAttribute(fmt::format("{}", fmt::join(widths, " "))));
  header.insert("checksum", Imf::StringAttribute(checksum(table)));
  Imf::FrameBuffer buffer;
  const auto add = [&](const std::string& name, const float* first, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(first)), stride,
                                   stride * columns));
  };
  for (std::size_t i = 0; i < NodeTable::kNumbers; ++i)
    add(channel(i), &table.numbers(0)[i], sizeof(NodeTable::Numbers));
  add("E", e.data(), sizeof(float)), add("theta_deg", theta.data(), sizeof(float));
  WholeFile file(exr);
  {
    Imf::OutputFile out(file.temporary().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(static_cast<int>(rows));
  }
  write_file(csv, csv_of(table));
  file.commit();
}

NodeTable read_node_table(const fs::path& exr) {
  if (!fs::is_regular_file(exr)) throw input_error("{}: cannot be read; expected a table of nodes", exr.string());
  try {
    return read_pixels(exr);
  } catch (const InputError& error) {
    throw input_error("{}: {}", exr.string(), error.what());
  } catch (const std::exception& error) {
    throw input_error("{}: is no readable OpenEXR file ({}); expected a table of nodes", exr.string(), error.what());
  }
}

}  // namespace gonio
