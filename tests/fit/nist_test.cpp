// The higher-difficulty problems of NIST's Statistical Reference Datasets for nonlinear regression: certified to 11
// digits by NIST, in 128-bit arithmetic. Data, starts and certified values are in tests/fit/nist.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "catch.h"
#include "fit/least_squares_jet.h"

using namespace gonio;

namespace {

struct Reference {
  std::vector<double> y, x;
  std::vector<double> start1, start2, certified;
  double sum_of_squares = 0;
};

/// Lines `rss value`, `bN start1 start2 certified deviation`, `y x`; # opens a comment.
Reference read_reference(const std::string& name) {
  std::ifstream file(std::string(GONIO_SOURCE_DIR) + "/tests/fit/nist/" + name + ".txt");
  REQUIRE(file.good());
  Reference reference;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first.empty() || first[0] == '#') continue;
    double a = 0, b = 0, c = 0;
    words >> a;
    if (first == "rss") {
      reference.sum_of_squares = a;
    } else if (first[0] == 'b') {
      words >> b >> c;
      reference.start1.push_back(a), reference.start2.push_back(b), reference.certified.push_back(c);
    } else {
      reference.y.push_back(std::stod(first)), reference.x.push_back(a);
    }
    REQUIRE_FALSE(words.fail());
  }
  return reference;
}

// The models as NIST prints them; b[0] is its b1. T carries derivatives in Number.
struct Mgh09 {
  static constexpr int kParameters = 4;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]);
  }
};
struct Thurber {
  static constexpr int kParameters = 7;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (Number(1) + x * (b[4] + x * (b[5] + x * b[6])));
  }
};
struct BoxBod {
  static constexpr int kParameters = 2;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] * (Number(1) - exp(-b[1] * x));
  }
};
struct Rat42 {
  static constexpr int kParameters = 3;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] / (Number(1) + exp(b[1] - b[2] * x));
  }
};
struct Mgh10 {
  static constexpr int kParameters = 3;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] * exp(b[1] / (x + b[2]));
  }
};
struct Eckerle4 {
  static constexpr int kParameters = 3;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    const T t = (x - b[2]) / b[1];
    return b[0] / b[1] * exp(-(t * t) / Number(2));
  }
};
struct Rat43 {
  static constexpr int kParameters = 4;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] / pow(Number(1) + exp(b[1] - b[2] * x), Number(1) / b[3]);
  }
};
struct Bennett5 {
  static constexpr int kParameters = 3;
  template <class T, class Number>
  T operator()(const T* b, Number x) const {
    return b[0] * pow(b[1] + x, Number(-1) / b[2]);
  }
};

template <class Model>
ResidualFunction residuals_of(const Reference& reference) {
  const auto residuals = [x = reference.x, y = reference.y]<class T>(const T* b, T* residual) {
    using Number = typename T::Scalar;
    for (std::size_t k = 0; k < x.size(); ++k) residual[k] = Model()(b, Number(x[k])) - Number(y[k]);
  };
  return residual_function<Model::kParameters>(residuals, static_cast<int>(reference.y.size()));
}

/// NIST's measure of agreement: -log10 of the relative error, at most the 11 digits that are certified.
double digits(double value, double certified) {
  return std::min(11.0, -std::log10(std::abs(value / certified - 1) + 1e-300));
}

struct Digits {
  double parameters = 11, sum_of_squares = 11;  ///< the worst parameter's
};

Digits digits_of(const LeastSquaresResult& result, const Reference& reference) {
  Digits reached;
  reached.sum_of_squares = digits(result.sum_of_squares, reference.sum_of_squares);
  for (std::size_t j = 0; j < result.x.size(); ++j)
    reached.parameters = std::min(reached.parameters, digits(result.x[j], reference.certified[j]));
  return reached;
}

/// A thousandth to a thousand times the size of the start, with its sign: the certified values are up to 357 times
/// smaller (MGH10) and 214 times larger (BoxBOD) than NIST's first starts.
std::vector<Range> box_around(const std::vector<double>& start) {
  std::vector<Range> box;
  for (const double b : start) box.push_back({std::min(b / 1000, b * 1000), std::max(b / 1000, b * 1000)});
  return box;
}

constexpr int kStarts = 64;

template <class Model>
void check(const std::string& name) {
  const Reference reference = read_reference(name);
  REQUIRE(reference.certified.size() == Model::kParameters);
  const ResidualFunction function = residuals_of<Model>(reference);
  const auto judge = [&](const LeastSquaresResult& result, const std::string& how) {
    const Digits reached = digits_of(result, reference);
    std::ostringstream line;
    line << name << ", " << how << ": " << reached.parameters << " digits of the worst parameter, "
         << reached.sum_of_squares << " of the sum of squares; " << result.iterations << " iterations, "
         << result.polishing_steps << " polishing steps, " << result.rejected << " refused, "
         << result.starts_at_this_minimum << " of " << result.starts << " starts ended here";
    INFO(line.str());
    if (std::getenv("GONIO_SHOW_DIGITS") != nullptr) std::cout << line.str() << '\n';
    CHECK(reached.parameters >= 10);
    CHECK(reached.sum_of_squares >= 10);
  };
  for (const auto& [method, words] :
       {std::pair{TrustRegion::levenberg_marquardt, "Levenberg-Marquardt"}, std::pair{TrustRegion::dogleg, "dogleg"}}) {
    LeastSquaresOptions options;
    options.method = method;
    judge(minimise(function, reference.start2, {}, options), std::string("second start, ") + words);
    judge(minimise_from_many(function, reference.start1, box_around(reference.start1), kStarts, options),
          std::string("many starts about the first, ") + words);
  }
}

}  // namespace

TEST_CASE("the hard certified regressions are met to 10 digits", "[fit][nist]") {
  SECTION("MGH09") { check<Mgh09>("mgh09"); }
  SECTION("Thurber") { check<Thurber>("thurber"); }
  SECTION("BoxBOD") { check<BoxBod>("boxbod"); }
  SECTION("Rat42") { check<Rat42>("rat42"); }
  SECTION("MGH10") { check<Mgh10>("mgh10"); }
  SECTION("Eckerle4") { check<Eckerle4>("eckerle4"); }
  SECTION("Rat43") { check<Rat43>("rat43"); }
  SECTION("Bennett5") { check<Bennett5>("bennett5"); }
}
