// Colour formulas against published numbers.
#include "spectrum/color.h"

#include "catch.h"

using namespace gonio;

TEST_CASE("CIEDE2000 reproduces the test data of Sharma, Wu & Dalal 2005", "[spectrum]") {
  struct Pair {
    Lab<double> p, q;
    double published;
  };
  const Pair pairs[] = {
      {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
      {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
      {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
      {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
      {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
      {{50, 0, 0}, {50, -1, 2}, 2.3669},
      {{50, -1, 2}, {50, 0, 0}, 2.3669},
      {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
      {{50, 2.49, -0.001}, {50, -2.49, 0.0010}, 7.1792},
      {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
      {{50, 2.49, -0.001}, {50, -2.49, 0.0012}, 7.2195},
      {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
      {{50, -0.001, 2.49}, {50, 0.0010, -2.49}, 4.8045},
      {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
      {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
      {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
      {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
      {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
      {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
      {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
      {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
      {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
      {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
      {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
      {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
      {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
      {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
      {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
      {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
      {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
      {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
      {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
      {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
  };
  STATIC_REQUIRE(std::size(pairs) == 34);
  for (const Pair& pair : pairs) {
    INFO(pair.p.l << " " << pair.p.a << " " << pair.p.b << " against " << pair.q.l << " " << pair.q.a << " "
                  << pair.q.b);
    CHECK(delta_e_2000(pair.p, pair.q) == Approx(pair.published).margin(5.0e-5).epsilon(0));
    CHECK(delta_e_2000(pair.q, pair.p) == Approx(pair.published).margin(5.0e-5).epsilon(0));
  }
  CHECK(delta_e_2000(pairs[0].p, pairs[0].p) == 0);
}

TEST_CASE("CIELAB and CIELUV: published sRGB primaries", "[spectrum]") {
  // sRGB's red and blue: XYZ from the inverse matrix of IEC 61966-2-1, Lab and Luv as commonly tabulated (D65, 2°).
  const Xyz<double> white{0.9504559, 1, 1.0890578}, red{0.4123908, 0.2126390, 0.0193308},
      blue{0.1804808, 0.0721923, 0.9505322};
  const Lab<double> r = lab(red, white), b = lab(blue, white);
  CHECK(r.l == Approx(53.24).margin(0.01));
  CHECK(r.a == Approx(80.09).margin(0.01));
  CHECK(r.b == Approx(67.20).margin(0.01));
  CHECK(b.l == Approx(32.30).margin(0.01));
  CHECK(b.a == Approx(79.19).margin(0.01));
  CHECK(b.b == Approx(-107.86).margin(0.01));
  const Luv<double> ru = luv(red, white);
  CHECK(ru.l == Approx(53.24).margin(0.01));
  CHECK(ru.u == Approx(175.01).margin(0.02));
  CHECK(ru.v == Approx(37.75).margin(0.02));
  CHECK(delta_e_ab(r, b) == Approx(std::sqrt(square(r.l - b.l) + square(r.a - b.a) + square(r.b - b.b))));
}

TEST_CASE("CIE lightness: exact constants, continuous in value and slope at its branch", "[spectrum]") {
  const double branch = 216.0 / 24389;
  CHECK(lightness(branch) == Approx(8).epsilon(1e-14));
  CHECK(lightness(std::nextafter(branch, 1.0)) == Approx(8).epsilon(1e-14));
  CHECK(lightness(0.18) == Approx(49.4961).margin(1e-4));
  CHECK(lightness(1.0) == Approx(100).epsilon(1e-15));
  CHECK(lightness(0.001) == Approx(24389.0 / 27 * 0.001).epsilon(1e-13));  // (29/3)³·Y/Yn
  const double step = 1e-7, below = (lightness(branch) - lightness(branch - step)) / step,
               above = (lightness(branch + step) - lightness(branch)) / step;
  CHECK(below == Approx(above).epsilon(1e-4));
  CHECK(luv(Xyz<double>{0, 0, 0}, Xyz<double>{95, 100, 108}).u == 0);
}

TEST_CASE("CIELUV: u', v' of D65 and the white at its origin", "[spectrum]") {
  const Xyz<double> white{95.047, 100, 108.883};
  const Chromaticity<double> uv = uniform_chromaticity(white);
  CHECK(uv.x == Approx(0.1978).margin(5e-5));
  CHECK(uv.y == Approx(0.4683).margin(5e-5));
  const Luv<double> origin = luv(white, white);
  CHECK(origin.l == Approx(100));
  CHECK(origin.u == 0);
  CHECK(origin.v == 0);
}

TEST_CASE("Linear sRGB: primaries, white and the transfer curve of IEC 61966-2-1", "[spectrum]") {
  const Rgb<double> white = linear_srgb(Xyz<double>{0.9505, 1.0, 1.0890});
  CHECK(white.r == Approx(1).margin(2e-4));
  CHECK(white.g == Approx(1).margin(2e-4));
  CHECK(white.b == Approx(1).margin(2e-4));
  const Rgb<double> red =
      linear_srgb(Xyz<double>{0.64 / 0.33 * 0.2126, 0.2126, 0.03 / 0.33 * 0.2126});  // x 0.64, y 0.33, Y 0.2126
  CHECK(red.r == Approx(1).margin(3e-4));
  CHECK(red.g == Approx(0).margin(3e-4));
  CHECK(red.b == Approx(0).margin(3e-4));
  CHECK(srgb_encoded(0.0) == 0);
  CHECK(srgb_encoded(1.0) == Approx(1).epsilon(1e-14));
  CHECK(srgb_encoded(0.18) * 255 == Approx(117.6).margin(0.1));
  CHECK(srgb_encoded(0.002) == Approx(0.02584));
  for (double x : {0.0, 0.001, 0.0031308, 0.01, 0.2, 0.5, 1.0})
    CHECK(srgb_decoded(srgb_encoded(x)) == Approx(x).margin(3e-8));
  const auto lanes = srgb_encoded(FloatLanes(0.18f));
  CHECK(lanes.get(0) == Approx(srgb_encoded(0.18)).epsilon(1e-6));
}
