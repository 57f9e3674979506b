// What `gonio assess speed brdf` compares with what: the loop that ratios refer to, counts of operations, fronts, Schlick's claims.
#include "assess/brdf_speed_cases.h"
#include "catch.h"

using namespace gonio;

TEST_CASE("The plain loop is the same formula as torrance-sparrow", "[assess]") {
  const Brdf<double> brdf{TorranceSparrow<double>{0.3}, 0.0, 1.0};
  const Interface<double> gold{0.21, 3.272};
  for (const double theta : {5.0, 40.0, 80.0}) {
    const UnitVector<double> i{sin_deg(theta), 0, cos_deg(theta)}, o{-0.36, 0.48, 0.8};
    CHECK(plain_beckmann(i, o, 0.3, gold.n, gold.k) ==
          Approx(evaluate(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), gold, 0.55)).epsilon(1e-13));
  }
}

TEST_CASE("Operations are counted from the formula's own code", "[assess]") {
  const auto x = [](double value) { return Counted(value); };
  const OperationCount root = operations_of([&] { square(x(3)) + sqrt(x(2)) / x(5) * x(7); });
  CHECK(root.multiply == 2);
  CHECK(root.add == 1);
  CHECK(root.divide == 1);
  CHECK(root.root == 1);
  // F of a conductor: two roots, one division beside that of its fraction.
  const OperationCount fresnel = operations_of([&] { (void)unpolarised_reflectance(x(0.5), x(0.2), x(3.0)).value(); });
  CHECK(fresnel.root == 2);
  CHECK(fresnel.divide == 2);
  CHECK(fresnel.exponential == 0);
}

TEST_CASE("A Pareto front holds what nothing beats in both", "[assess]") {
  std::vector<SpeedRow> rows(4);
  rows[0].ns = 1, rows[0].largest = 1e-3;
  rows[1].ns = 2, rows[1].largest = 1e-2;  // slower and worse than the first
  rows[2].ns = 3, rows[2].largest = 1e-9;
  rows[3].ns = 4, rows[3].largest = 1e-9;
  const std::vector<SpeedRow> front = pareto_front(rows);
  REQUIRE(front.size() == 2);
  CHECK(front[0].ns == 1);
  CHECK(front[1].ns == 3);
}

TEST_CASE("Schlick's D: a mean error of about 1.3 % of the peak, whatever its relative error", "[assess]") {
  const SchlickClaim claim = schlick_claim();
  CHECK(claim.mean > 0.005);  // PHYSICS: about 1.3 % (the mean depends on the angles taken)
  CHECK(claim.mean < 0.02);
  CHECK(claim.largest > 5 * claim.mean);
  CHECK(claim.relative_largest >= 1);  // 0 where D is not, and far above it next to grazing at alpha = 0.7
  CHECK(claim.share_of_zeros > 0);
}

TEST_CASE("On a sphere the exact form differs from itself by nothing, Schlick's from it by something", "[assess]") {
  ModelSpec exact{ModelId::torrance_sparrow}, schlick = exact;
  set_variant(schlick, "schlick");
  const std::vector<double> values = middle_values(exact.info());
  CHECK(visible_error(exact, exact, values).largest == 0);
  CHECK(visible_error(schlick, exact, values).largest > 1);
  CHECK(exact_form(schlick).variant() == "exact");
}
