#include "fit/formats/rgl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "fit/formats/tensor_file.h"

namespace gonio {
namespace {

constexpr double kQuarterTurn = 1.57079632679489661923, kTurn = 4 * kQuarterTurn;

/// The fields of a file by name, each of a given type and number of dimensions.
struct Fields {
  std::vector<Tensor> all;
  const std::string& file;

  const Tensor& named(std::string_view name, TensorType type, std::size_t dimensions) const {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Tensor& t) { return t.name == name; });
    if (found == all.end())
      throw input_error(
          "{}: offset 18: field {} is missing; expected phi_i, theta_i, ndf, sigma, vndf, luminance, spectra, "
          "wavelengths, jacobian, description",
          file, name);
    if (found->type != type)
      throw input_error("{}: offset {}: field {} has type {}; expected {}", file, found->record, name, int(found->type),
                        int(type));
    if (found->shape.size() != dimensions)
      throw input_error("{}: offset {}: field {} has {} dimensions; expected {}", file, found->record, name,
                        found->shape.size(), dimensions);
    return *found;
  }
  void require_shape(const Tensor& field, std::initializer_list<std::uint64_t> leading) const {
    std::size_t d = 0;
    for (const std::uint64_t extent : leading) {
      if (field.shape[d] != extent)
        throw input_error("{}: offset {}: extent {} of field {} is {}; expected {}", file, field.record, d, field.name,
                          field.shape[d], extent);
      ++d;
    }
  }
};

/// Increasing numbers within a range.
std::vector<float> nodes_of(const Fields& fields, std::string_view name, double lo, double hi) {
  const Tensor& field = fields.named(name, TensorType::float32, 1);
  const std::vector<float> values = float_values(field, fields.file);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto at = [&] { return field.offset + k * sizeof(float); };
    if (!(values[k] >= lo && values[k] <= hi))
      throw input_error("{}: offset {}: {} is {}; expected {} to {}", fields.file, at(), name, values[k], lo, hi);
    if (k > 0 && !(values[k] > values[k - 1]))
      throw input_error("{}: offset {}: {} is {} after {}; expected increasing nodes", fields.file, at(), name,
                        values[k], values[k - 1]);
  }
  return values;
}

/// A table whose last two extents are a grid of at least 2 by 2.
RglGrid grid_of(const Fields& fields, std::string_view name, std::initializer_list<std::uint64_t> leading,
                bool negative_too) {
  const Tensor& field = fields.named(name, TensorType::float32, leading.size() + 2);
  fields.require_shape(field, leading);
  RglGrid grid{field.shape[leading.size()], field.shape[leading.size() + 1], {}};
  if (grid.height < 2 || grid.width < 2)
    throw input_error("{}: offset {}: field {} is {} by {}; expected at least 2 by 2", fields.file, field.record, name,
                      grid.height, grid.width);
  grid.values = float_values(field, fields.file);
  if (negative_too) return grid;
  for (std::size_t k = 0; k < grid.values.size(); ++k)
    if (grid.values[k] < 0)
      throw input_error("{}: offset {}: {} of field {} is {}; expected 0 or more", fields.file,
                        field.offset + k * sizeof(float), k, name, grid.values[k]);
  return grid;
}

void require_samples(const Fields& fields, const RglTable& table) {
  const RglGrid &s = table.spectra, &l = table.luminance;
  if (s.height != s.width || l.height != s.height || l.width != s.width)
    throw input_error("{}: offset {}: spectra is {} by {} and luminance {} by {}; expected equal squares", fields.file,
                      fields.named("spectra", TensorType::float32, 5).record, s.height, s.width, l.height, l.width);
}

/// A projected area of 0 would be divided by.
void require_area(const Fields& fields, const RglTable& table) {
  const Tensor& field = fields.named("sigma", TensorType::float32, 2);
  for (std::size_t k = 0; table.jacobian && k < table.sigma.values.size(); ++k)
    if (!(table.sigma.values[k] > 0))
      throw input_error("{}: offset {}: {} of field sigma is 0; expected more than 0", fields.file,
                        field.offset + k * sizeof(float), k);
}

double angle_of_u(double u) { return u * u * kQuarterTurn; }
double u_of_angle(double theta) { return std::sqrt(std::max(0.0, theta) / kQuarterTurn); }
double azimuth_of_u(double u) { return (2 * u - 1) * kTurn / 2; }
double u_of_azimuth(double phi) {
  const double u = phi / kTurn + 0.5;
  return u - std::floor(u);
}
/// Zenith angle from the chord, accurate next to the normal.
double zenith(const UnitVector<double>& d) {
  return 2 * std::asin(std::min(1.0, 0.5 * std::sqrt(d.x * d.x + d.y * d.y + (d.z - 1) * (d.z - 1))));
}
UnitVector<double> direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
UnitVector<double> mirrored_at(const UnitVector<double>& m, const UnitVector<double>& i) {
  const double twice = 2 * dot(m, i);
  return {twice * m.x - i.x, twice * m.y - i.y, twice * m.z - i.z};
}
/// Solid angle of normals for an area of the unit square of u: 2π²·u·sinθ.
double solid_angle_of_u(double u) { return kTurn * kTurn / 2 * u * std::sin(angle_of_u(u)); }

/// 1, 2 or 4: into how many parts symmetry divides the turn.
int reduction_of(const std::vector<float>& phi_i) {
  if (phi_i.size() <= 2) return 1;
  return static_cast<int>(std::lround(kTurn / (static_cast<double>(phi_i.back()) - phi_i.front())));
}

void require_reduction(const Fields& fields, const RglTable& table) {
  const int parts = reduction_of(table.phi_i);
  if (parts != 1 && parts != 2 && parts != 4)
    throw input_error("{}: offset {}: phi_i spans {} radians; expected a turn, half or a quarter of one", fields.file,
                      fields.named("phi_i", TensorType::float32, 1).offset, table.phi_i.back() - table.phi_i.front());
}

}  // namespace

RglTable parse_rgl(std::string_view bytes, const std::string& file) {
  const Fields fields{parse_tensor_file(bytes, file), file};
  RglTable table;
  const Tensor& jacobian = fields.named("jacobian", TensorType::uint8, 1);
  fields.require_shape(jacobian, {1});
  if (jacobian.bytes[0] != 0 && jacobian.bytes[0] != 1)
    throw input_error("{}: offset {}: jacobian is {}; expected 0 or 1", file, jacobian.offset, int(jacobian.bytes[0]));
  table.jacobian = jacobian.bytes[0] == 1;
  table.description = fields.named("description", TensorType::uint8, 1).bytes;
  constexpr double kRounding = 1e-6;  // of a node at the end of its range, float
  table.theta_i = nodes_of(fields, "theta_i", 0, kQuarterTurn + kRounding);
  table.phi_i = nodes_of(fields, "phi_i", -kTurn / 2 - kRounding, kTurn + kRounding);
  table.wavelengths_nm = nodes_of(fields, "wavelengths", 100, 1e5);
  const std::uint64_t phi = table.phi_i.size(), theta = table.theta_i.size(), wavelengths = table.wavelengths_nm.size();
  table.ndf = grid_of(fields, "ndf", {}, false);
  table.sigma = grid_of(fields, "sigma", {}, false);
  table.vndf = grid_of(fields, "vndf", {phi, theta}, false);
  table.luminance = grid_of(fields, "luminance", {phi, theta}, true);
  table.spectra = grid_of(fields, "spectra", {phi, theta, wavelengths}, true);
  require_samples(fields, table);
  require_area(fields, table);
  require_reduction(fields, table);
  return table;
}

std::string rgl_file(const RglTable& table) {
  const std::uint64_t phi = table.phi_i.size(), theta = table.theta_i.size(), wavelengths = table.wavelengths_nm.size();
  std::vector<std::string> data;  // the fields' bytes, held until the file is made
  data.reserve(10);
  std::vector<Tensor> fields;
  const auto add = [&](const char* name, TensorType type, std::vector<std::uint64_t> shape, std::string bytes) {
    data.push_back(std::move(bytes));
    fields.push_back({name, type, std::move(shape), data.back(), 0, 0});
  };
  const auto add_grid = [&](const char* name, std::vector<std::uint64_t> shape, const RglGrid& grid) {
    shape.push_back(grid.height);
    shape.push_back(grid.width);
    add(name, TensorType::float32, std::move(shape), float_bytes(grid.values));
  };
  const std::string description = table.description.empty() ? " " : table.description;
  add("description", TensorType::uint8, {description.size()}, description);
  add("jacobian", TensorType::uint8, {1}, std::string(1, table.jacobian ? '\1' : '\0'));
  add("phi_i", TensorType::float32, {phi}, float_bytes(table.phi_i));
  add("theta_i", TensorType::float32, {theta}, float_bytes(table.theta_i));
  add("wavelengths", TensorType::float32, {wavelengths}, float_bytes(table.wavelengths_nm));
  add_grid("ndf", {}, table.ndf);
  add_grid("sigma", {}, table.sigma);
  add_grid("vndf", {phi, theta}, table.vndf);
  add_grid("luminance", {phi, theta}, table.luminance);
  add_grid("spectra", {phi, theta, wavelengths}, table.spectra);
  return tensor_file(fields);
}

/// A pair of directions in the table's coordinates.
struct RglBrdf::Place {
  NodeShare phi, theta;
  SliceMix mix;
  UnitVector<double> i, m;
  SquarePoint u_m, s;
};

RglBrdf::RglBrdf(RglTable table) : table_(std::move(table)) {
  warp_ = SquareWarp(table_.vndf.values, table_.vndf.height, table_.vndf.width);
  std::vector<float> luminance = table_.luminance.values;
  for (float& value : luminance) value = std::max(value, 0.0f);
  luminance_ = SquareWarp(luminance, table_.luminance.height, table_.luminance.width);
  reduction_ = reduction_of(table_.phi_i);
}

RglBrdf::Place RglBrdf::place(UnitVector<double> i, UnitVector<double> o) const {
  if (reduction_ >= 2) {  // into the range of azimuths, -180° to -90° or to 0°
    const double turn_y = i.y > 0 ? -1 : 1, turn_x = reduction_ == 4 ? (i.x > 0 ? -1 : 1) : turn_y;
    i = {turn_x * i.x, -std::abs(i.y), i.z};  // -0 at the end of the range: its azimuth is -180°
    o = {turn_x * o.x, turn_y * o.y, o.z};
  }
  Place p;
  p.i = i;
  p.m = normalised(i.x + o.x, i.y + o.y, i.z + o.z);
  const double phi_i = std::atan2(i.y, i.x), phi_m = std::atan2(p.m.y, p.m.x);
  p.phi = between(table_.phi_i, phi_i);
  p.theta = between(table_.theta_i, zenith(i));
  p.mix = mix_of(p.phi, p.theta, table_.theta_i.size());
  p.u_m = {u_of_angle(zenith(p.m)), u_of_azimuth(isotropic() ? phi_m - phi_i : phi_m)};
  p.s = warp_.invert(p.mix, p.u_m);
  return p;
}

double RglBrdf::microfacet_factor(const UnitVector<double>& i, const SquarePoint& u_m) const {
  if (!table_.jacobian) return 1;
  const SquarePoint u_i{u_of_angle(zenith(i)), u_of_azimuth(std::atan2(i.y, i.x))};
  return bilinear(table_.ndf.values, 0, table_.ndf.height, table_.ndf.width, u_m) /
         (4 * bilinear(table_.sigma.values, 0, table_.sigma.height, table_.sigma.width, u_i));
}

double RglBrdf::f(const UnitVector<double>& i, const UnitVector<double>& o, double wavelength_nm) const {
  const Place p = place(i, o);
  const NodeShare at = between(table_.wavelengths_nm, wavelength_nm);
  const std::size_t wavelengths = table_.wavelengths_nm.size(), size = table_.spectra.height * table_.spectra.width;
  const auto spectrum = [&](std::size_t slice, std::size_t wavelength) {
    return bilinear(table_.spectra.values, (slice * wavelengths + wavelength) * size, table_.spectra.height,
                    table_.spectra.width, p.s);
  };
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (p.mix.share[k] == 0) continue;
    double value = spectrum(p.mix.slice[k], at.before);
    if (at.next > 0) value += at.next * (spectrum(p.mix.slice[k], at.before + 1) - value);
    sum += p.mix.share[k] * value;
  }
  return sum * microfacet_factor(p.i, p.u_m) / o.z;
}

double RglBrdf::pdf(const UnitVector<double>& i, const UnitVector<double>& o) const {
  const Place p = place(i, o);
  const double jacobian = std::max(solid_angle_of_u(p.u_m.x), 1e-6) * 4 * dot(p.i, p.m);
  return warp_.density(p.mix, p.u_m) * luminance_.density(p.mix, p.s) / jacobian;
}

RglBrdf::Node RglBrdf::node(std::size_t phi, std::size_t theta, std::size_t row, std::size_t column) const {
  const std::size_t slice = phi * table_.theta_i.size() + theta;
  const auto last = static_cast<double>(table_.spectra.width - 1);
  const SquarePoint u = warp_.sample({{slice, slice, slice, slice}, {1, 0, 0, 0}},
                                     {static_cast<double>(column) / last, static_cast<double>(row) / last});
  const double phi_i = table_.phi_i[phi], phi_m = azimuth_of_u(u.y) + (isotropic() ? phi_i : 0);
  Node node{direction(table_.theta_i[theta], phi_i), {}, direction(angle_of_u(u.x), phi_m)};
  node.o = mirrored_at(node.m, node.i);
  return node;
}

double RglBrdf::f_at(const Node& node, std::size_t phi, std::size_t theta, std::size_t wavelength, std::size_t row,
                     std::size_t column) const {
  const std::size_t slice = (phi * table_.theta_i.size() + theta) * table_.wavelengths_nm.size() + wavelength;
  const std::size_t width = table_.spectra.width, size = table_.spectra.height * width;
  const double phi_i = std::atan2(node.i.y, node.i.x), phi_m = std::atan2(node.m.y, node.m.x);
  const SquarePoint u_m{u_of_angle(zenith(node.m)), u_of_azimuth(isotropic() ? phi_m - phi_i : phi_m)};
  return table_.spectra.values[slice * size + row * width + column] * microfacet_factor(node.i, u_m) / node.o.z;
}

namespace {

/// How many nodes are skipped along each index, so that not too many are left.
struct Strides {
  std::size_t wavelength = 1, phi = 1, sample = 1;
};
std::size_t kept(std::size_t count, std::size_t stride) { return (count + stride - 1) / stride; }

Strides strides_of(const RglTable& table) {
  Strides s;
  const auto left = [&] {
    const std::size_t across = kept(table.spectra.width, s.sample);
    return kept(table.wavelengths_nm.size(), s.wavelength) * kept(table.phi_i.size(), s.phi) * table.theta_i.size() *
           across * across;
  };
  while (left() > kMostRglPoints) {
    const std::size_t w = kept(table.wavelengths_nm.size(), s.wavelength), p = kept(table.phi_i.size(), s.phi);
    if (w > 5)
      ++s.wavelength;
    else if (kept(table.spectra.width, s.sample) > 12 || (w == 1 && p == 1))
      ++s.sample;
    else if (p > 1)
      ++s.phi;
    else
      ++s.wavelength;
    if (w == 1 && p == 1 && kept(table.spectra.width, s.sample) <= 2) break;
  }
  return s;
}

void state_conventions(const RglTable& table, const Strides& strides, Measurement& scan) {
  scan.conventions.push_back(table.jacobian
                                 ? "quantity: f_r·cos(theta_o) over ndf/(4·sigma), per sr; divided out to f_r, absolute"
                                 : "quantity: f_r·cos(theta_o), per sr; divided by the cosine to f_r, absolute");
  scan.conventions.push_back(
      "angles: radians in the file; phi_i and phi_m from the x axis (isotropic: phi_m from phi_i)");
  scan.conventions.push_back(
      "directions: the nodes of spectra, carried through the warp by vndf and mirrored at their normals");
  if (strides.wavelength > 1 || strides.phi > 1 || strides.sample > 1)
    scan.conventions.push_back(
        fmt::format("thinned: every {}th wavelength, {}th azimuth and {}th node each way, to at most {} points",
                    strides.wavelength, strides.phi, strides.sample, kMostRglPoints));
}

double degrees(double radians) { return radians * 90 / kQuarterTurn; }

ScanPoint scan_point(const RglBrdf::Node& node, double wavelength_nm, double f) {
  ScanPoint point;
  point.theta_i_deg = degrees(zenith(node.i));
  point.phi_i_deg = degrees(std::atan2(node.i.y, node.i.x));
  point.theta_o_deg = degrees(zenith(node.o));
  point.phi_o_deg = degrees(std::atan2(node.o.y, node.o.x));
  point.wavelength_nm = wavelength_nm;
  point.f_per_sr = f;
  return point;
}

}  // namespace

Measurement read_rgl(std::string_view bytes, const std::string& file) {
  const RglBrdf brdf(parse_rgl(bytes, file));
  const RglTable& table = brdf.table();
  Measurement scan;
  scan.name = table.description;
  for (char& c : scan.name)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  scan.quantity = "brdf";
  const Strides strides = strides_of(table);
  state_conventions(table, strides, scan);
  const std::size_t wavelengths = table.wavelengths_nm.size(), across = table.spectra.width;
  for (std::size_t phi = 0; phi < table.phi_i.size(); phi += strides.phi)
    for (std::size_t theta = 0; theta < table.theta_i.size(); ++theta)
      for (std::size_t row = 0; row < across; row += strides.sample)
        for (std::size_t column = 0; column < across; column += strides.sample) {
          const RglBrdf::Node node = brdf.node(phi, theta, row, column);
          constexpr double kHorizon = 1e-4;  // cosines below it are grazing or below
          if (!(node.i.z > kHorizon && node.o.z > kHorizon)) {
            ++scan.left_out["at or below the horizon"];
            continue;
          }
          for (std::size_t w = 0; w < wavelengths; w += strides.wavelength)
            scan.points.push_back(
                scan_point(node, table.wavelengths_nm[w], brdf.f_at(node, phi, theta, w, row, column)));
        }
  if (scan.points.empty())
    throw input_error("{}: offset 0: has no node above the horizon; expected at least one", file);
  for (const ScanPoint& point : scan.points)
    if (!std::isfinite(point.f_per_sr))
      throw input_error("{}: offset 0: f_r is not finite at a node; expected finite values", file);
  group_by_incidence(scan);
  return scan;
}

}  // namespace gonio
