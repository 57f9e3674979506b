#pragma once
// The RGL material database's .bsdf files: BRDFs on an adaptive grid of directions.
// Dupuy & Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", ACM TOG 37(6), 2018,
// doi:10.1145/3272127.3275059; https://rgl.epfl.ch/materials.
//
// Directions, from unit vectors i (light, whose zenith and azimuth the tables are ordered by), o (eye), m = (i + o)/|i + o|:
//   u(θ, φ) = (√(2θ/π), (φ + π)/2π), with φ = φ_m, or φ_m - φ_i for an isotropic material (phi_i of at most two nodes);
//   s = the inverse of the warp whose density is `vndf` at (φ_i, θ_i), taken at u(m)           (section 4.3);
//   f_r·cos_o = spectra(φ_i, θ_i, λ; s) · ndf(u(m)) / (4·sigma(u(i)))                          (with `jacobian`; without, spectra alone).
// `spectra` and `luminance` stand on uniform nodes of s, all tables are linear between nodes. An azimuth range of π or π/2 says that
// the material does not change when turned by 180°, or also mirrored at x and y: directions are brought into the range.
// f_r in sr⁻¹, angles in radians, wavelengths in nm.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/unit_vector.h"
#include "fit/formats/square_warp.h"
#include "fit/scan.h"

namespace gonio {

/// Nodes of one slice, or of the only one: `height` rows (azimuth or s_y) of `width` (zenith or s_x).
struct RglGrid {
  std::size_t height = 0, width = 0;
  std::vector<float> values;
};

/// What a file holds, as it stands there.
struct RglTable {
  std::vector<float> phi_i, theta_i;  ///< radians, increasing
  std::vector<float> wavelengths_nm;  ///< increasing
  RglGrid ndf, sigma;                 ///< one slice
  RglGrid vndf, luminance;            ///< a slice each phi_i, theta_i (faster)
  RglGrid spectra;                    ///< a slice each phi_i, theta_i, wavelength (fastest)
  std::string description;
  bool jacobian = true;
};

/// InputError `file: offset N: …` for anything but a whole file of that kind.
RglTable parse_rgl(std::string_view bytes, const std::string& file);
/// The file; parse_rgl() gives the same table back, bit by bit.
std::string rgl_file(const RglTable& table);

/// A table made ready to be evaluated.
class RglBrdf {
 public:
  explicit RglBrdf(RglTable table);

  const RglTable& table() const { return table_; }
  bool isotropic() const { return table_.phi_i.size() <= 2; }

  /// f_r in sr⁻¹ of unit vectors above the horizon, at any wavelength (held at the ends of the table).
  double f(const UnitVector<double>& i, const UnitVector<double>& o, double wavelength_nm) const;
  /// Per steradian of o: the density of a renderer that draws s by `luminance`.
  double pdf(const UnitVector<double>& i, const UnitVector<double>& o) const;

  /// A stored node: light, eye (below the horizon where z <= 0) and f_r.
  struct Node {
    UnitVector<double> i, o, m;
  };
  Node node(std::size_t phi, std::size_t theta, std::size_t row, std::size_t column) const;
  double f_at(const Node& node, std::size_t phi, std::size_t theta, std::size_t wavelength, std::size_t row,
              std::size_t column) const;

 private:
  struct Place;
  Place place(UnitVector<double> i, UnitVector<double> o) const;
  double microfacet_factor(const UnitVector<double>& i, const SquarePoint& u_m) const;

  RglTable table_;
  SquareWarp warp_, luminance_;
  int reduction_ = 1;
};

/// The nodes as a scan, thinned to at most kMostRglPoints; those below the horizon or at 90° are left out and counted.
inline constexpr std::size_t kMostRglPoints = 100'000;
Measurement read_rgl(std::string_view bytes, const std::string& file);

/// A BRDF to be written: f_r in sr⁻¹ towards the eye o for light from i, at the wavelength with that index.
struct RglSource {
  std::function<double(const UnitVector<double>& i, const UnitVector<double>& o, std::size_t wavelength)> f;
  std::vector<double> wavelengths_nm;  ///< increasing, within 100 and 100000 nm
  std::string description;
};

/// How finely. Zeros: chosen by whether the source is isotropic.
struct RglResolution {
  std::size_t theta_i = 0, phi_i = 0, samples = 0, normals_theta = 0, normals_phi = 0;
};

/// Tables of a source. The normals' distribution D is the one whose microfacets reflect back what the source does (section 4.2, power
/// iteration), with shares of √D, ⁴√D and a cosine lobe added so that faint directions have nodes too; the density of the samples and what
/// the reader multiplies by come from the same D, so this changes only where the nodes are. Whether the source is isotropic, or symmetric in
/// azimuth, is found by trying. At the nodes the tables give the source to float's rounding; nodes below the horizon hold what keeps
/// the cells at the horizon smooth and not negative.
/// InputError for a source that is not finite or negative, or reflects nothing.
RglTable make_rgl(const RglSource& source, const RglResolution& resolution = {});

}  // namespace gonio
