#pragma once
// Small files of foreign formats, made by the tests and the fuzz targets' seeds, and how a reader refuses broken ones.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "base/error.h"
#include "catch.h"
#include "fit/formats/formats.h"
#include "fit/formats/rgl.h"

namespace gonio::test {

/// GGX with correlated Smith shadowing and Schlick's reflectance over a diffuse part, from unit vectors: a formula of its own.
struct SampleBrdf {
  double alpha_x = 0.3, alpha_y = 0.3, diffuse = 0.1, r0 = 0.6;

  double operator()(const UnitVector<double>& i, const UnitVector<double>& o, std::size_t wavelength) const {
    const UnitVector<double> m = normalised(i.x + o.x, i.y + o.y, i.z + o.z);
    const double slopes = (m.x * m.x / (alpha_x * alpha_x) + m.y * m.y / (alpha_y * alpha_y)) / (m.z * m.z);
    const double d = 1 / (M_PI * alpha_x * alpha_y * std::pow(m.z, 4) * (1 + slopes) * (1 + slopes));
    const auto lambda = [&](const UnitVector<double>& w) {
      return (std::sqrt(1 + (w.x * w.x * alpha_x * alpha_x + w.y * w.y * alpha_y * alpha_y) / (w.z * w.z)) - 1) / 2;
    };
    const double start = r0 / (1 + 0.25 * static_cast<double>(wavelength));
    const double reflectance = start + (1 - start) * std::pow(1 - dot(i, m), 5);
    return diffuse / M_PI + d * reflectance / ((1 + lambda(i) + lambda(o)) * 4 * i.z * o.z);
  }
};

inline RglSource sample_source(const SampleBrdf& brdf, std::vector<double> wavelengths_nm = {450, 550, 650}) {
  return {brdf, std::move(wavelengths_nm), "made by a test"};
}

/// A small file: 3 angles of incidence, 4 by 4 samples, two wavelengths.
inline RglTable small_rgl(const SampleBrdf& brdf = {}) {
  RglTable table = make_rgl(sample_source(brdf, {500, 600}), {3, 0, 4, 8, 8});
  const std::size_t slices = table.phi_i.size() * table.theta_i.size();
  table.vndf = {2, 3, std::vector<float>(slices * 6, 1.0f)};
  return table;
}

/// The line a reader refuses with; "accepted" where it does not.
inline std::string refusal(const char* format, std::string_view bytes) {
  try {
    format_named(format).read(bytes, "FILE");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// One line that names the file and where in it, and says what was expected.
inline void check_refusal(const char* format, std::string_view bytes, std::string_view where,
                          std::string_view words = "") {
  const std::string message = refusal(format, bytes);
  INFO(message << "\nlooked for: " << words);
  CHECK(message.starts_with(where));
  CHECK(message.find("expected") != message.npos);
  CHECK(message.find('\n') == message.npos);
  CHECK(message.find(words) != message.npos);
}

/// `text` with its first `from` replaced.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != text.npos);
  return text.replace(at, from.size(), to);
}

}  // namespace gonio::test
