// Bradford's adaptation against published matrices.
#include "spectrum/adaptation.h"

#include "catch.h"

using namespace gonio;

TEST_CASE("White goes to white, and the way back leads back", "[spectrum]") {
  const Xyz<double> a{1.0985, 1, 0.35585}, d65{0.95047, 1, 1.08883}, colour{0.3, 0.2, 0.15};
  const Xyz<double> white = bradford_adapted(a, a, d65),
                    back = bradford_adapted(bradford_adapted(colour, a, d65), d65, a);
  CHECK(white.x == Approx(d65.x).epsilon(1e-14));
  CHECK(white.z == Approx(d65.z).epsilon(1e-14));
  CHECK(back.x == Approx(colour.x).epsilon(1e-14));
  CHECK(back.y == Approx(colour.y).epsilon(1e-14));
}

TEST_CASE("D50 to D65: B. Lindbloom's published Bradford matrix", "[spectrum]") {
  const double published[3][3] = {
      {0.9555766, -0.0230393, 0.0631636}, {-0.0282895, 1.0099416, 0.0210077}, {0.0122982, -0.0204830, 1.3299098}};
  const Xyz<double> d50{0.96422, 1, 0.82521}, d65{0.95047, 1, 1.08883};
  const Xyz<double> columns[3] = {bradford_adapted({1, 0, 0}, d50, d65), bradford_adapted({0, 1, 0}, d50, d65),
                                  bradford_adapted({0, 0, 1}, d50, d65)};
  for (int c = 0; c < 3; ++c) {
    CHECK(columns[c].x == Approx(published[0][c]).margin(1e-7).epsilon(0));
    CHECK(columns[c].y == Approx(published[1][c]).margin(1e-7).epsilon(0));
    CHECK(columns[c].z == Approx(published[2][c]).margin(1e-7).epsilon(0));
  }
}

TEST_CASE("sRGB's white is white in sRGB", "[spectrum]") {
  const Rgb<double> white = linear_srgb(srgb_white<double>());
  for (const double channel : {white.r, white.g, white.b}) CHECK(channel == Approx(1).margin(2e-4));
}
