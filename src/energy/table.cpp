#include "energy/table.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "base/error.h"
#include "base/files.h"
#include "brdf/brdf.h"
#include "energy/directional_reflectance.h"

namespace gonio {

ReflectanceTable make_reflectance_table(const ModelSpec& spec, double tolerance) {
  const ModelInfo& info = spec.info();
  if (info.parameters.front().name != "m")
    throw input_error("{}: has no table over m; expected pseudo-realistic or torrance-sparrow", info.name);
  ReflectanceTable table{spec, {}, {}, {}, {}};
  constexpr int kAngles = 46, kSlopes = 24;
  for (int i = 0; i < kAngles; ++i) {
    const double share = 1 - double(i) / (kAngles - 1);  // quadratic: closer towards grazing
    table.theta_deg.push_back(89.99 * (1 - share * share));
  }
  for (int i = 0; i < kSlopes; ++i) table.slope_rms.push_back(0.01 * std::pow(200.0, double(i) / (kSlopes - 1)));
  table.e.resize(kAngles * kSlopes);
  table.error.resize(kAngles * kSlopes);
  const SpectralSurface perfect{{perfect_interface<double>()}, {0.55}};
  tbb::parallel_for(0, kAngles * kSlopes, [&](int cell) {
    const double m = table.slope_rms[static_cast<std::size_t>(cell / kAngles)];
    std::vector<double> values;
    for (const ParameterInfo& p : info.parameters) values.push_back(p.fallback.value_or(m));  // kd = 0, ks = 1
    const Brdf<double> brdf = make_brdf<double>(spec, values);
    const Estimate e =
        directional_reflectance(brdf.lobe, table.theta_deg[static_cast<std::size_t>(cell % kAngles)], perfect, tolerance)[0];
    table.e[static_cast<std::size_t>(cell)] = e.value;
    table.error[static_cast<std::size_t>(cell)] = e.error;
  });
  return table;
}

namespace {

std::string as_csv(const ReflectanceTable& table) {
  std::string text = "theta_deg,m,E,error\n";
  for (std::size_t row = 0; row < table.slope_rms.size(); ++row)
    for (std::size_t column = 0; column < table.theta_deg.size(); ++column)
      text += fmt::format("{},{},{},{}\n", table.theta_deg[column], table.slope_rms[row], table.at(row, column),
                          table.error[row * table.theta_deg.size() + column]);
  return text;
}

}  // namespace

void write_reflectance_table(const ReflectanceTable& table, const std::filesystem::path& exr) {
  std::filesystem::path csv = exr;
  csv.replace_extension(".csv");
  if (csv == exr) throw input_error("{}: has the extension of its CSV; expected a name such as T.exr", exr.string());
  const int width = static_cast<int>(table.theta_deg.size()), height = static_cast<int>(table.slope_rms.size());
  std::vector<float> e(table.e.begin(), table.e.end()), error(table.error.begin(), table.error.end());
  Imf::Header header(width, height);
  header.insert("model", Imf::StringAttribute(std::string(table.spec.info().name)));
  if (!table.spec.info().shadowings.empty())
    header.insert("shadowing", Imf::StringAttribute(std::string(name_of(table.spec.shadowing))));
  header.insert("quantity", Imf::StringAttribute("directional reflectance of the lobe, F = 1, ks = 1 (dimensionless)"));
  header.insert("theta_deg", Imf::StringAttribute(fmt::format("{}", fmt::join(table.theta_deg, " "))));
  header.insert("slope_rms_m", Imf::StringAttribute(fmt::format("{}", fmt::join(table.slope_rms, " "))));
  Imf::FrameBuffer buffer;
  for (const auto& [name, data] : {std::pair{"E", &e}, std::pair{"error", &error}}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(data->data()), sizeof(float), sizeof(float) * std::size_t(width)));
  }
  WholeFile file(exr);
  {
    Imf::OutputFile out(file.temporary().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(height);
  }
  write_file(csv, as_csv(table));
  file.commit();
}

}  // namespace gonio
