// RGL .bsdf files: written, read back, evaluated at their nodes and between them, and broken ones refused.
#include "fit/formats/rgl.h"

#include <algorithm>
#include <cstring>

#include "fit/formats/square_warp.h"
#include "fit/formats/tensor_file.h"
#include "format_samples.h"

using namespace gonio;
using namespace gonio::test;

namespace {

UnitVector<double> direction_deg(double theta, double phi) {
  const double t = theta * M_PI / 180, p = phi * M_PI / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// |log10 f/f'| between nodes, sorted: zenith angles to 80°.
std::vector<double> errors_between_nodes(const SampleBrdf& source, const RglBrdf& written) {
  std::vector<double> errors;
  for (double theta_i = 1; theta_i < 80; theta_i += 11)
    for (double theta_o = 1.5; theta_o < 80; theta_o += 7)
      for (double phi = 0; phi < 360; phi += 23)
        for (const double phi_i : {13.0, 130.0, 250.0}) {
          const UnitVector<double> i = direction_deg(theta_i, phi_i), o = direction_deg(theta_o, phi_i + phi);
          errors.push_back(std::abs(std::log10(std::max(written.f(i, o, 550), 1e-30) / source(i, o, 1))));
        }
  std::sort(errors.begin(), errors.end());
  return errors;
}
double share(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// The largest relative error at the nodes above the horizon, of f by index and of f found through the warp.
std::pair<double, double> errors_at_nodes(const SampleBrdf& source, const RglBrdf& written) {
  const RglTable& table = written.table();
  double by_index = 0, by_direction = 0;
  for (std::size_t phi = 0; phi < table.phi_i.size(); ++phi)
    for (std::size_t theta = 0; theta < table.theta_i.size(); ++theta)
      for (std::size_t row = 1; row + 1 < table.spectra.height; ++row)
        for (std::size_t column = 1; column + 1 < table.spectra.width; ++column) {
          const RglBrdf::Node node = written.node(phi, theta, row, column);
          if (!(node.o.z > 1e-3)) continue;
          const double f = source(node.i, node.o, 1);
          by_index = std::max(by_index, std::abs(written.f_at(node, phi, theta, 1, row, column) / f - 1));
          by_direction = std::max(by_direction, std::abs(written.f(node.i, node.o, table.wavelengths_nm[1]) / f - 1));
        }
  return {by_index, by_direction};
}

bool same(const RglTable& a, const RglTable& b) {
  const auto equal = [](const RglGrid& p, const RglGrid& q) {
    return p.height == q.height && p.width == q.width && p.values == q.values;
  };
  return a.phi_i == b.phi_i && a.theta_i == b.theta_i && a.wavelengths_nm == b.wavelengths_nm &&
         a.jacobian == b.jacobian && a.description == b.description && equal(a.ndf, b.ndf) && equal(a.sigma, b.sigma) &&
         equal(a.vndf, b.vndf) && equal(a.luminance, b.luminance) && equal(a.spectra, b.spectra);
}

template <class T>
std::string patched(std::string bytes, std::size_t at, T value) {
  REQUIRE(at + sizeof(T) <= bytes.size());
  std::memcpy(bytes.data() + at, &value, sizeof(T));
  return bytes;
}

/// The file of `table` with one field changed.
std::string changed(const RglTable& table, std::string_view name, const std::function<void(Tensor&)>& change) {
  const std::string bytes = rgl_file(table);
  std::vector<Tensor> fields = parse_tensor_file(bytes, "FILE");
  for (Tensor& field : fields)
    if (field.name == name) change(field);
  return tensor_file(fields);
}

}  // namespace

TEST_CASE("the square's warp: its inverse undoes it, and areas go as the density's integral", "[fit][rgl]") {
  const std::vector<float> values{0, 1, 3, 2, 5, 0, 0, 4, 1, 1, 2, 2, /* second slice */ 1,
                                  1, 1, 1, 0, 0, 0, 9, 3, 0, 0, 0};
  const SquareWarp warp(values, 3, 4);
  for (const double next : {0.0, 0.25, 1.0}) {
    const SliceMix mix = mix_of({0, 0}, {0, next}, 2);
    for (double x = 0.03; x < 1; x += 0.13)
      for (double y = 0.02; y < 1; y += 0.17) {
        const SquarePoint warped = warp.sample(mix, {x, y}), back = warp.invert(mix, warped);
        CHECK(back.x == Approx(x).margin(1e-12));
        CHECK(back.y == Approx(y).margin(1e-12));
        // The map's Jacobian, by differences, is one over the density.
        const double h = 1e-6;
        const SquarePoint px = warp.sample(mix, {x + h, y}), py = warp.sample(mix, {x, y + h});
        const double area = ((px.x - warped.x) * (py.y - warped.y) - (px.y - warped.y) * (py.x - warped.x)) / (h * h);
        CHECK(area * warp.density(mix, warped) == Approx(1).epsilon(2e-3));
      }
  }
}

TEST_CASE("an RGL file is read back bit by bit", "[fit][rgl]") {
  for (const SampleBrdf& brdf : {SampleBrdf{}, SampleBrdf{0.2, 0.5, 0, 0.9}}) {
    const RglTable table = small_rgl(brdf);
    const std::string bytes = rgl_file(table);
    CHECK(same(parse_rgl(bytes, "FILE"), table));
    CHECK(rgl_file(parse_rgl(bytes, "FILE")) == bytes);
  }
}

TEST_CASE("a written BRDF is the source at the nodes and near it between them: isotropic", "[fit][rgl]") {
  struct Case {
    double alpha, diffuse, median, nearly_all;
  };
  // Bounds a little above what was found: log10 errors, median and 99 %.
  for (const Case& c : {Case{0.3, 0, 3e-4, 0.015}, Case{0.3, 0.1, 3e-4, 0.015}, Case{0.1, 0.1, 1.5e-3, 0.03},
                        Case{1, 0.5, 3e-4, 0.01}}) {
    const SampleBrdf source{c.alpha, c.alpha, c.diffuse, 0.6};
    const RglBrdf written(make_rgl(sample_source(source)));
    REQUIRE(written.isotropic());
    const auto [by_index, by_direction] = errors_at_nodes(source, written);
    CHECK(by_index < 1e-6);
    CHECK(by_direction < 1e-4);
    const std::vector<double> errors = errors_between_nodes(source, written);
    INFO("alpha " << c.alpha << ", log10 errors: median " << share(errors, 0.5) << ", 99 % " << share(errors, 0.99)
                  << ", largest " << errors.back());
    CHECK(share(errors, 0.5) < c.median);
    CHECK(share(errors, 0.99) < c.nearly_all);
  }
}

TEST_CASE("a written BRDF is the source at the nodes and near it between them: anisotropic", "[fit][rgl]") {
  const SampleBrdf source{0.2, 0.4, 0.05, 0.6};
  const RglBrdf written(make_rgl(sample_source(source)));
  REQUIRE_FALSE(written.isotropic());
  CHECK(written.table().phi_i.back() - written.table().phi_i.front() == Approx(M_PI / 2));
  const auto [by_index, by_direction] = errors_at_nodes(source, written);
  CHECK(by_index < 1e-6);
  CHECK(by_direction < 1e-2);
  const std::vector<double> errors = errors_between_nodes(source, written);
  INFO("log10 errors: median " << share(errors, 0.5) << ", 99 % " << share(errors, 0.99) << ", largest "
                               << errors.back());
  CHECK(share(errors, 0.5) < 5e-3);
  CHECK(share(errors, 0.99) < 0.08);
}

TEST_CASE("a Gaussian lobe keeps its form down to 1e-4 of its peak", "[fit][rgl]") {
  // Normals of Beckmann, alpha = 0.2, without shadowing: f = D/(4·cos_i·cos_o).
  const auto f = [](const UnitVector<double>& i, const UnitVector<double>& o, std::size_t) {
    const UnitVector<double> m = normalised(i.x + o.x, i.y + o.y, i.z + o.z);
    const double tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z);
    return std::exp(-tan2 / 0.04) / (M_PI * 0.04 * std::pow(m.z, 4)) / (4 * i.z * o.z);
  };
  const RglBrdf written(make_rgl({f, {550}, ""}));
  double sum = 0;
  int count = 0;
  for (double theta_i = 0; theta_i < 76; theta_i += 15)
    for (double theta_o = 0; theta_o < 76; theta_o += 3)
      for (double phi = 0; phi <= 180; phi += 20) {
        const UnitVector<double> i = direction_deg(theta_i, 40), o = direction_deg(theta_o, 40 + phi);
        if (f(i, o, 0) < 1e-4 * f(direction_deg(75, 0), direction_deg(75, 180), 0)) continue;
        const double error = std::log10(std::max(written.f(i, o, 550), 1e-30) / f(i, o, 0));
        sum += error * error;
        ++count;
      }
  INFO("rms of log10: " << std::sqrt(sum / count) << " of " << count);
  CHECK(count > 500);
  CHECK(std::sqrt(sum / count) < 0.01);
}

TEST_CASE("the directions drawn through a written file's tables have density 1 in all", "[fit][rgl]") {
  const RglBrdf written(make_rgl(sample_source({0.3, 0.3, 0.2, 0.6})));
  const UnitVector<double> i = direction_deg(35, 20);
  double sum = 0;
  constexpr int kRows = 400, kColumns = 800;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double z = (row + 0.5) / kRows, phi = 360 * (column + 0.5) / kColumns;
      sum += written.pdf(i, direction_deg(std::acos(z) * 180 / M_PI, phi)) * 2 * M_PI / (kRows * kColumns);
    }
  CHECK(sum == Approx(1).margin(0.02));  // what the samples below the horizon carry is missing
}

TEST_CASE("an RGL file becomes a scan that says how it was read", "[fit][rgl]") {
  const SampleBrdf source{0.3, 0.3, 0.1, 0.6};
  const Measurement scan = format_named("rgl").read(rgl_file(make_rgl(sample_source(source))), "FILE");
  CHECK(scan.points.size() <= kMostRglPoints);
  CHECK(scan.points.size() > 10000);
  CHECK(scan.wavelengths() == std::vector<double>{450, 550, 650});
  double largest = 0;
  for (const ScanPoint& p : scan.points) {
    const std::size_t wavelength = p.wavelength_nm < 500 ? 0 : p.wavelength_nm < 600 ? 1 : 2;
    const double f =
        source(direction_deg(p.theta_i_deg, p.phi_i_deg), direction_deg(p.theta_o_deg, p.phi_o_deg), wavelength);
    if (p.theta_o_deg < 89) largest = std::max(largest, std::abs(p.f_per_sr / f - 1));
  }
  CHECK(largest < 1e-5);
  std::string all;
  for (const std::string& convention : scan.conventions) all += convention + "\n";
  for (const char* word : {"quantity", "absolute", "radians", "x axis", "thinned"}) CHECK(all.find(word) != all.npos);
}

TEST_CASE("the three formats are told apart by their first bytes", "[fit][rgl]") {
  const std::string rgl = rgl_file(small_rgl()).substr(0, 4096),
                    ddr = "TypeSym ASymmetrical\nTypeData Luminance Absolute\n",
                    xml = "<?xml version=\"1.0\"?>\n<WindowElement>";
  for (const auto& [name, head] : {std::pair{"rgl", rgl}, {"ddr", ddr}, {"bsdf-xml", xml}})
    for (const char* other : {"rgl", "ddr", "bsdf-xml"})
      CHECK(format_named(other).recognises(head) == (std::string_view(name) == other));
}

TEST_CASE("sources that are no BRDF are not written", "[fit][rgl]") {
  const auto never = [](double value) {
    return RglSource{[value](const auto&, const auto&, std::size_t) { return value; }, {550}, ""};
  };
  CHECK_THROWS_AS(make_rgl(never(-1)), InputError);
  CHECK_THROWS_AS(make_rgl(never(NAN)), InputError);
  CHECK_THROWS_AS(make_rgl(never(0)), InputError);
  CHECK_THROWS_AS(make_rgl(sample_source({}, {})), InputError);
  CHECK_THROWS_AS(make_rgl(sample_source({}, {600, 500})), InputError);
}

TEST_CASE("RGL files cut short are refused wherever they end", "[fit][rgl][malformed]") {
  const std::string bytes = rgl_file(small_rgl());
  REQUIRE(refusal("rgl", bytes) == "accepted");
  for (std::size_t end = 0; end < 700; end += 7) check_refusal("rgl", bytes.substr(0, end), "FILE: offset ");
  for (std::size_t end = 700; end < bytes.size(); end += 97)
    check_refusal("rgl", bytes.substr(0, end), "FILE: offset ");
  check_refusal("rgl", bytes.substr(0, bytes.size() - 1), "FILE: offset ");
}

TEST_CASE("RGL files with a broken header are refused", "[fit][rgl][malformed]") {
  const std::string bytes = rgl_file(small_rgl());
  const std::vector<Tensor> fields = parse_tensor_file(bytes, "FILE");
  for (std::size_t k = 0; k < 12; ++k) check_refusal("rgl", patched(bytes, k, 'X'), "FILE: offset 0:", "tensor_file");
  for (const std::uint8_t version : {0, 2, 255})
    check_refusal("rgl", patched(bytes, 12, version), "FILE: offset 12:", "version");
  check_refusal("rgl", patched(bytes, 13, std::uint8_t{1}), "FILE: offset 12:", "version");
  for (const std::uint32_t count : {0u, 9u, 11u, 1000000u, 0xffffffffu})
    check_refusal("rgl", patched(bytes, 14, count), "FILE: offset ");
  for (const Tensor& field : fields) {
    const std::size_t name = field.record + 2, dimensions = name + field.name.size(), type = dimensions + 2,
                      offset = type + 1, shape = offset + 8;
    const std::string here = "FILE: offset ";
    check_refusal("rgl", patched(bytes, field.record, std::uint16_t{0xffff}), here);
    check_refusal("rgl", patched(bytes, field.record, std::uint16_t{0}), here);
    check_refusal("rgl", patched(bytes, name, '\n'), here);
    check_refusal("rgl", patched(bytes, name, 'Q'), here, "missing");
    check_refusal("rgl", patched(bytes, dimensions, std::uint16_t{0xffff}), here);
    check_refusal("rgl", patched(bytes, type, std::uint8_t{0}), here, "type");
    check_refusal("rgl", patched(bytes, type, std::uint8_t{12}), here, "type");
    check_refusal("rgl", patched(bytes, type, std::uint8_t{6}), here);
    check_refusal("rgl", patched(bytes, offset, std::uint64_t{0}), here, "within");
    check_refusal("rgl", patched(bytes, offset, std::uint64_t(bytes.size())), here, "beyond");
    check_refusal("rgl", patched(bytes, offset, ~std::uint64_t{0}), here, "beyond");
    for (const std::uint64_t extent : {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}})
      check_refusal("rgl", patched(bytes, shape, extent), here,
                    extent == 0 ? "extent of 0" : "more numbers than the file holds");
  }
}

TEST_CASE("RGL files with wrong fields or numbers are refused", "[fit][rgl][malformed]") {
  const RglTable table = small_rgl();
  const std::string bytes = rgl_file(table);
  std::uint64_t before = 0;
  for (const Tensor& field : parse_tensor_file(bytes, "FILE")) {
    // One field over another or over the header, one dimension more.
    check_refusal("rgl", patched(bytes, field.record + 2 + field.name.size() + 3, before), "FILE: offset ", "within");
    before = field.offset;
    check_refusal("rgl", changed(table, field.name, [](Tensor& t) { t.shape.push_back(1); }), "FILE: offset ",
                  "dimensions");
    if (field.type != TensorType::float32) continue;
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
      check_refusal("rgl", patched(bytes, field.offset, bad), fmt::format("FILE: offset {}: ", field.offset),
                    "expected");
      const std::size_t last = field.offset + field.bytes.size() - 4;
      check_refusal("rgl", patched(bytes, last, bad), fmt::format("FILE: offset {}: ", last), "expected");
    }
  }
  const auto table_with = [&](auto change) {
    RglTable other = table;
    change(other);
    return rgl_file(other);
  };
  check_refusal("rgl", table_with([](RglTable& t) { std::swap(t.theta_i[0], t.theta_i[1]); }), "FILE: offset ",
                "increasing");
  check_refusal("rgl", table_with([](RglTable& t) { t.theta_i[1] = t.theta_i[0]; }), "FILE: offset ", "increasing");
  check_refusal("rgl", table_with([](RglTable& t) { t.theta_i[2] = 60; }), "FILE: offset ", "theta_i is 60");
  check_refusal("rgl", table_with([](RglTable& t) { t.theta_i[0] = -0.1f; }), "FILE: offset ", "theta_i");
  check_refusal("rgl", table_with([](RglTable& t) { t.phi_i[0] = 200; }), "FILE: offset ", "phi_i is 200");
  check_refusal("rgl", table_with([](RglTable& t) { std::swap(t.wavelengths_nm[0], t.wavelengths_nm[1]); }),
                "FILE: offset ", "increasing");
  check_refusal("rgl", table_with([](RglTable& t) { t.wavelengths_nm[0] = 0.5f; }), "FILE: offset ", "wavelengths");
  check_refusal("rgl", table_with([](RglTable& t) { t.ndf.values[3] = -1; }), "FILE: offset ", "field ndf");
  check_refusal("rgl", table_with([](RglTable& t) { t.sigma.values[0] = 0; }), "FILE: offset ", "field sigma");
  check_refusal("rgl", table_with([](RglTable& t) { t.vndf.values[0] = -1e-20f; }), "FILE: offset ", "field vndf");
  check_refusal("rgl", table_with([](RglTable& t) { t.luminance.height = 2, t.luminance.width = 8; }), "FILE: offset ",
                "squares");
  check_refusal("rgl", table_with([](RglTable& t) { t.spectra.height = 2, t.spectra.width = 8; }), "FILE: offset ",
                "squares");
  check_refusal("rgl", table_with([](RglTable& t) { t.ndf.width *= t.ndf.height, t.ndf.height = 1; }), "FILE: offset ",
                "2 by 2");
  check_refusal("rgl", changed(table, "jacobian", [](Tensor& t) { t.bytes = "\2"; }), "FILE: offset ", "jacobian");
  check_refusal("rgl", changed(table, "jacobian", [](Tensor& t) { t.bytes = "\1\1", t.shape = {2}; }), "FILE: offset ",
                "jacobian");
  check_refusal("rgl", changed(table, "vndf", [](Tensor& t) { std::swap(t.shape[0], t.shape[1]); }), "FILE: offset ",
                "extent 0 of field vndf");
  check_refusal("rgl", changed(table, "spectra", [](Tensor& t) { std::swap(t.shape[1], t.shape[2]); }), "FILE: offset ",
                "extent 1 of field spectra");
  RglTable turned = small_rgl({0.2, 0.5, 0, 0.9});
  for (std::size_t k = 0; k < turned.phi_i.size(); ++k)
    turned.phi_i[k] = static_cast<float>(0.26 * static_cast<double>(k));
  check_refusal("rgl", rgl_file(turned), "FILE: offset ", "phi_i spans");
}
