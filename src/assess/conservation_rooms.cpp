#include "assess/conservation_rooms.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "assess/conservation_limits.h"
#include "energy/lobe_energy.h"
#include "render/render.h"

namespace gonio {
namespace {

constexpr double kGrey_nm = 550;  // F = 1 has no colour
constexpr Vector kRoomLower{-3, -3, 0}, kRoomUpper{3, 3, 4};
constexpr std::uint64_t kSeed = 1;

SceneMaterial lambert(double kd) { return {"lambert", lobe_sum("lambert"), {kd}, "perfect", {}}; }

/// Of F = 1, ks = factor·ks_max.
SceneMaterial at_its_limit_times(double factor) {
  const double ks = factor * slope_limits(conservation_models()[0], kRoomSlope, white_facets()).ks_max;
  SceneMaterial material{"pseudo-realistic", lobe_sum("pseudo-realistic"), {kRoomSlope, 0, ks}, "perfect", {}};
  material.may_gain = factor > 1;
  return material;
}

Scene lit_room(SceneMaterial walls) {
  Scene scene;
  scene.materials = {std::move(walls)};
  scene.room = Room{kRoomLower, kRoomUpper, 0, {0, "constant"}};
  scene.lights = {{{0, 0, 3.3}, 0.4, {6, "constant"}}};
  scene.wavelengths_nm = {kGrey_nm};
  return scene;
}

SpectralImage rendered(const Scene& scene, int spp, int max_depth) {
  RenderSettings settings;
  settings.spp = spp, settings.max_depth = max_depth, settings.seed = kSeed, settings.variance = false;
  return render(scene, settings).image;
}

/// Images of one size, in rows of `columns`, white between them.
SpectralImage mosaic(std::span<const SpectralImage> images, int columns) {
  constexpr int kGap = 4;
  const SpectralImage& first = images.front();
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
  SpectralImage all(columns * (first.width + kGap) - kGap, rows * (first.height + kGap) - kGap, first.wavelength_nm);
  std::fill(all.radiance.begin(), all.radiance.end(), 1e6);
  for (std::size_t i = 0; i < images.size(); ++i)
    for (int y = 0; y < first.height; ++y)
      for (int x = 0; x < first.width; ++x) {
        const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
        const auto to = all.pixel(all.index(column * (first.width + kGap) + x, row * (first.height + kGap) + y));
        std::ranges::copy(images[i].pixel(first.index(x, y)), to.begin());
      }
  return all;
}

/// Σ e^n, n = 0 … last.
double series(double e, int last) {
  double sum = 1;
  for (int n = 0; n < last; ++n) sum = 1 + e * sum;
  return sum;
}

void take_mean(RoomMean& room, const SpectralImage& image) {
  double sum = 0, sum2 = 0;
  for (const double radiance : image.radiance) sum += radiance, sum2 += radiance * radiance;
  const auto count = static_cast<double>(image.radiance.size());
  room.mean = sum / count, room.error = std::sqrt(std::max(0.0, sum2 / count - room.mean * room.mean) / count);
}

}  // namespace

RoomMean room_mean(double factor, int max_depth) {
  Scene scene;
  scene.camera = {{0, -2.9, 1.6}, {0, 0, 1.1}, 62, 64, 48};
  scene.materials = {at_its_limit_times(factor)};
  scene.room = Room{kRoomLower, kRoomUpper, 0, {1, "constant"}};
  scene.wavelengths_nm = {kGrey_nm};
  RoomMean room{.factor = factor, .max_depth = max_depth};
  take_mean(room, rendered(scene, 64, max_depth));
  const LobeEnergy energy(PseudoRealistic<double>{kRoomSlope}, white_facets().samples.surface);
  const double ks = scene.materials.front().values.back();
  const auto [least, most] = std::ranges::minmax(energy.at(0).around().values());
  room.least = series(ks * (least - energy.error()), max_depth);
  room.most = series(ks * (most + energy.error()), max_depth);
  return room;
}

std::vector<RoomMean> room_means() {
  std::vector<RoomMean> means;
  for (const double factor : kRoomFactors)
    for (const int depth : kRoomDepths) means.push_back(room_mean(factor, depth));
  return means;
}

SpectralImage spheres_in_white_room() {
  Scene scene = lit_room(lambert(0.9));
  scene.camera = {{0, -2.9, 1.3}, {0, 0.8, 0.85}, 40, 480, 150};
  double x = -2.1;
  for (const double factor : kRoomFactors) {
    scene.spheres.push_back({{x, 1, 0.62}, 0.62, scene.materials.size()});
    scene.materials.push_back(at_its_limit_times(factor));
    x += 1.4;
  }
  return rendered(scene, 80, 1000);
}

SpectralImage rooms_of_the_material() {
  std::vector<SpectralImage> rooms;
  for (const double factor : kPictureFactors)
    for (const int depth : kPictureDepths) {
      Scene scene = lit_room(at_its_limit_times(factor));
      scene.camera = {{0, -2.9, 1.6}, {0, 0, 1.1}, 62, 157, 106};
      for (const double x : {-1.5, 0.0, 1.5}) scene.spheres.push_back({{x, x == 0 ? 1.4 : 0.8, 0.7}, 0.7, 0});
      rooms.push_back(rendered(scene, 48, depth));
    }
  return mosaic(rooms, std::size(kPictureDepths));
}

SpectralImage compensated_spheres() {
  std::vector<SpectralImage> rows;
  for (const CompensationKind kind : {CompensationKind::none, CompensationKind::kulla_conty_2017}) {
    Scene scene;
    scene.camera = {{0, -9, 0}, {0, 0, 0}, 14, 480, 150};
    scene.environment = {1, "D65"};
    scene.wavelengths_nm = visible_wavelengths();
    double x = -2.3;
    for (const char* metal : {"perfect", "Ag", "Cu"}) {
      SceneMaterial material{metal, lobe_sum("torrance-sparrow"), {kCompensatedSlope, 0, 1}, metal, {}};
      material.compensation = kind;
      scene.spheres.push_back({{x, 0, 0}, 1, scene.materials.size()});
      scene.materials.push_back(std::move(material));
      x += 2.3;
    }
    rows.push_back(rendered(scene, 96, 8));
  }
  return mosaic(rows, 1);
}

}  // namespace gonio
