// The page of what kd and ks may be: its limits against the quadrature's, its behaviours against the renderer's, its rooms against bounds.
#include "assess/conservation_limits.h"

#include <algorithm>

#include "assess/conservation_rooms.h"
#include "catch.h"
#include "energy/energy_tables.h"
#include "energy/lobe_families.h"
#include "energy/material_energy.h"
#include "materials/database.h"

using namespace gonio;

namespace {

bool have_tables() { return bundled_energy_table(lobe_family("pseudo-realistic")) != nullptr; }

const MetalSurface& find(const std::vector<MetalSurface>& metals, std::string_view symbol) {
  return *std::ranges::find(metals, symbol, &MetalSurface::symbol);
}

const ConservationModel& pseudo_realistic() { return conservation_models()[0]; }
const ConservationModel& torrance_sparrow() { return conservation_models()[1]; }

}  // namespace

TEST_CASE("Conservation limits: the tables' are the quadrature's, on the conserving side", "[assess][energy][tables]") {
  if (!have_tables()) return;
  const MetalSurface white = white_facets();
  const SlopeLimits table = slope_limits(pseudo_realistic(), 1, white);
  CHECK(table.ks_max < 1 / 1.149);
  const auto quadrature = [](const MetalSurface& metal, double m) {
    return conservation_limits(Brdf<double>{PseudoRealistic<double>{m}}, metal.samples, limit_angles_deg());
  };
  const double white_ks = quadrature(white, 1).ks_max;
  CHECK(table.ks_max <= white_ks);
  CHECK(table.ks_max > white_ks - 2e-4);
  // Rubidium's n is so small that the tables' polynomials miss its R: the limit must make up for it.
  const MetalSurface rubidium = find(conservation_metals(), "Rb");
  CHECK(rubidium.node_error > kMostNodeError);
  const Limits slow = quadrature(rubidium, 0.5);
  const SlopeLimits fast = slope_limits(pseudo_realistic(), 0.5, rubidium);
  CHECK(fast.ks_max <= slow.ks_max);
  CHECK(fast.ks_max > slow.ks_max - 3e-3);
}

TEST_CASE("Conservation limits: metals are bounded by F = 1, and fall where E grows", "[assess][energy][tables]") {
  if (!have_tables()) return;
  const std::vector<MetalSurface> metals = conservation_metals();
  CHECK(metals.size() > 30);
  CHECK(find(metals, "Au").id == "Au_Johnson");
  CHECK(std::ranges::find(metals, "V", &MetalSurface::symbol) == metals.end());  // the eye's, not vanadium
  for (const MetalSurface& metal : metals) {
    INFO(metal.symbol);
    const bool white = metal.symbol == "F = 1";
    for (const double m : {0.01, 0.2, 2.0}) {
      const SlopeLimits smooth = slope_limits(torrance_sparrow(), m, metal);
      CHECK(smooth.ks_max >= (white ? 1 - 1.1 * EnergyTable::kError : 1));
      CHECK(smooth.kd_max <= std::max(0.0, 1 - smooth.largest_e));
    }
    double before = 0;
    for (const double m : {0.05, 0.1, 0.2, 0.4, 0.8}) {
      const SlopeLimits at = slope_limits(pseudo_realistic(), m, metal);
      CHECK(at.ks_max <= 1 / at.largest_e);
      CHECK(at.largest_e > before);
      CHECK(at.ks_max >= slope_limits(pseudo_realistic(), m, metals.front()).ks_max * (1 - 1e-3));
      before = at.largest_e;
    }
  }
}

TEST_CASE("Conservation limits: gold turns diffuse where the renderer says so", "[assess][energy][tables]") {
  if (!have_tables()) return;
  const MetalSurface gold = find(conservation_metals(), "Au");
  const SlopeLimits at = slope_limits(pseudo_realistic(), 0.2, gold);
  const Brdf<double> lobe{PseudoRealistic<double>{0.2}, 0, 0.5};
  const MaterialEnergy energy({lobe}, gold.samples.surface, CompensationKind::none);
  const auto balance = [&](double kd) {
    return energy_balance(energy, {{Brdf<double>{lobe.lobe, kd, 0.5}}}, gold.samples);
  };
  CHECK(balance(at.turning_kd * 0.999).behaviour() == std::string("specular"));
  CHECK(balance(at.turning_kd * 1.001).behaviour() == std::string("diffuse"));
  CHECK(balance(at.kd_max_at_half).total <= 1);
  CHECK(balance(at.kd_max_at_half).total > 1 - 2e-4);
}

TEST_CASE("Conservation limits: a closed room settles inside the limit and grows beyond it",
          "[assess][render][tables]") {
  if (!have_tables()) return;
  double deep[2];
  for (const double factor : {0.6, 1.2}) {
    for (const int depth : {2, 8, 32}) {
      const RoomMean room = room_mean(factor, depth);
      INFO(factor << " " << depth);
      CHECK(room.mean > room.least);  // by far more than its standard error
      CHECK(room.mean < room.most);
      deep[factor > 1] = room.mean;
    }
  }
  CHECK(deep[0] < 2.5);
  CHECK(deep[1] > 150);
}
