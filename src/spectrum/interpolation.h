#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace gonio {

/// How values between the points of a table are found. `gonio assess speed interpolation` measures what each loses.
/// Colour sums are linear between points whatever is chosen here (colorimetry.h).
enum class Interpolation {
  linear,
  pchip,                 ///< monotone cubic: F. N. Fritsch & J. Butland, SIAM J. Sci. Stat. Comput. 5, 300 (1984)
  akima,                 ///< modified Akima ("makima") cubic: H. Akima, J. ACM 17, 589 (1970)
  natural_cubic,         ///< cubic spline, no curvature at its ends
  barycentric_rational,  ///< M. S. Floater & K. Hormann, Numer. Math. 107, 315 (2007), order 3
  sprague,               ///< quintic of CIE 167:2005, for equidistant points
};

inline constexpr Interpolation kInterpolations[] = {Interpolation::linear,
                                                    Interpolation::pchip,
                                                    Interpolation::akima,
                                                    Interpolation::natural_cubic,
                                                    Interpolation::barycentric_rational,
                                                    Interpolation::sprague};

/// "linear", "pchip", "akima", "natural-cubic", "barycentric-rational", "sprague".
std::string_view name_of(Interpolation variant);
std::optional<Interpolation> interpolation_named(std::string_view name);

/// The fewest points a variant needs.
std::size_t fewest_points(Interpolation variant);
/// Steps equal to a billionth of the whole.
bool is_equidistant(const std::vector<double>& x);

/// What stands beyond a table where that is asked for.
enum class Extension { nearest, linear };  ///< the end's value (CIE 015:2018), or the line through the last two points

struct Interpolated {
  double value;
  bool extrapolated;  ///< outside the table; every result that used it says so
};

/// y(x) between points, x increasing.
class Interpolator {
 public:
  /// InputError for too few points, x that does not increase, values that are not finite, or sprague on unequal steps.
  Interpolator(Interpolation variant, std::vector<double> x, std::vector<double> y);
  Interpolator(Interpolator&&) noexcept;
  ~Interpolator();

  double lo() const;
  double hi() const;
  /// InputError outside lo() to hi(); a point gives its own value.
  double at(double x) const;
  /// Beyond the points too, and says so.
  Interpolated at(double x, Extension extension) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gonio
