#include "fit/formats/square_warp.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

struct Cell {
  std::size_t index;
  double within;  // 0 to 1
};

/// The cell of a coordinate among `nodes` equidistant nodes over [0, 1].
Cell cell_of(double coordinate, std::size_t nodes) {
  const double scaled = std::clamp(coordinate, 0.0, 1.0) * static_cast<double>(nodes - 1);
  const std::size_t index = std::min(static_cast<std::size_t>(scaled), nodes - 2);
  return {index, scaled - static_cast<double>(index)};
}

/// t in [0, 1] with a·t + (b - a)·t²/2 = area: where a density that goes linearly from a to b has that integral. Formed without
/// a difference of roots; the middle of what is given where there is no density.
double linear_quantile(double a, double b, double area) {
  const double root = std::sqrt(std::max(0.0, a * a + 2 * (b - a) * area));
  return a + root > 0 ? std::clamp(2 * area / (a + root), 0.0, 1.0) : 0.5;
}

/// Largest cell whose integral does not exceed the target.
template <class Integral>
std::size_t find_cell(std::size_t nodes, double target, const Integral& integral) {
  std::size_t low = 0, high = nodes - 2;
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (integral(middle) <= target)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

}  // namespace

NodeShare between(const std::vector<float>& nodes, double value) {
  if (nodes.size() < 2) return {0, 0};
  const auto after = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
  const auto before = static_cast<std::size_t>(after - nodes.begin()) - 1;
  const double lo = nodes[before], hi = nodes[before + 1];
  return {before, std::clamp((value - lo) / (hi - lo), 0.0, 1.0)};
}

SliceMix mix_of(const NodeShare& first, const NodeShare& second, std::size_t second_count) {
  const std::size_t row = first.before * second_count, step_1 = first.next > 0 ? second_count : 0,
                    step_2 = second.next > 0 ? 1 : 0;
  const std::size_t slice = row + second.before;
  return {{slice, slice + step_2, slice + step_1, slice + step_1 + step_2},
          {(1 - first.next) * (1 - second.next), (1 - first.next) * second.next, first.next * (1 - second.next),
           first.next * second.next}};
}

SquareWarp::SquareWarp(const std::vector<float>& values, std::size_t height, std::size_t width)
    : height_(height),
      width_(width),
      values_(values.begin(), values.end()),
      rows_(values.size()),
      marginal_(values.size() / width) {
  const std::size_t slice_size = height * width;
  for (std::size_t slice = 0; slice * slice_size < values.size(); ++slice) {
    double* density = &values_[slice * slice_size];
    double* rows = &rows_[slice * slice_size];
    double* marginal = &marginal_[slice * height];
    const auto integrate = [&] {
      for (std::size_t y = 0; y < height; ++y) {
        rows[y * width] = 0;
        for (std::size_t x = 1; x < width; ++x)
          rows[y * width + x] = rows[y * width + x - 1] + 0.5 * (density[y * width + x - 1] + density[y * width + x]);
        marginal[y] = y == 0 ? 0 : marginal[y - 1] + 0.5 * (rows[y * width - 1] + rows[(y + 1) * width - 1]);
      }
      return marginal[height - 1];
    };
    double total = integrate();
    if (!(total > 0)) {
      std::fill(density, density + slice_size, 1.0);
      total = integrate();
    }
    for (std::size_t k = 0; k < slice_size; ++k) density[k] /= total, rows[k] /= total;
    for (std::size_t y = 0; y < height; ++y) marginal[y] /= total;
  }
}

double SquareWarp::mixed(const std::vector<double>& table, std::size_t stride, std::size_t index,
                         const SliceMix& mix) const {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += mix.share[k] * table[mix.slice[k] * stride + index];
  return sum;
}

double SquareWarp::value(const SliceMix& mix, std::size_t row, std::size_t column) const {
  return mixed(values_, height_ * width_, row * width_ + column, mix);
}

double SquareWarp::row_integral(const SliceMix& mix, std::size_t row, std::size_t column) const {
  return mixed(rows_, height_ * width_, row * width_ + column, mix);
}

SquarePoint SquareWarp::sample(const SliceMix& mix, SquarePoint uniform) const {
  const double target = std::clamp(uniform.y, 0.0, 1.0);
  const auto marginal = [&](std::size_t y) { return mixed(marginal_, height_, y, mix); };
  const std::size_t row = find_cell(height_, target, marginal);
  const double y = linear_quantile(row_integral(mix, row, width_ - 1), row_integral(mix, row + 1, width_ - 1),
                                   target - marginal(row));
  const auto conditional = [&](std::size_t x) {
    return (1 - y) * row_integral(mix, row, x) + y * row_integral(mix, row + 1, x);
  };
  const double along = std::clamp(uniform.x, 0.0, 1.0) * conditional(width_ - 1);
  const std::size_t column = find_cell(width_, along, conditional);
  const auto density = [&](std::size_t x) { return (1 - y) * value(mix, row, x) + y * value(mix, row + 1, x); };
  const double x = linear_quantile(density(column), density(column + 1), along - conditional(column));
  return {(static_cast<double>(column) + x) / static_cast<double>(width_ - 1),
          (static_cast<double>(row) + y) / static_cast<double>(height_ - 1)};
}

SquarePoint SquareWarp::invert(const SliceMix& mix, SquarePoint warped) const {
  const Cell x = cell_of(warped.x, width_), y = cell_of(warped.y, height_);
  const auto across = [&](double below, double above) { return (1 - y.within) * below + y.within * above; };
  const auto density = [&](std::size_t column) {
    return across(value(mix, y.index, column), value(mix, y.index + 1, column));
  };
  const double a = density(x.index), b = density(x.index + 1);
  const double along = across(row_integral(mix, y.index, x.index), row_integral(mix, y.index + 1, x.index)) +
                       x.within * (a + 0.5 * x.within * (b - a));
  const double below = row_integral(mix, y.index, width_ - 1), above = row_integral(mix, y.index + 1, width_ - 1);
  const double whole = across(below, above);
  return {
      whole > 0 ? std::min(along / whole, 1.0) : warped.x,
      std::min(mixed(marginal_, height_, y.index, mix) + y.within * (below + 0.5 * y.within * (above - below)), 1.0)};
}

double SquareWarp::density(const SliceMix& mix, SquarePoint warped) const {
  const Cell x = cell_of(warped.x, width_), y = cell_of(warped.y, height_);
  const double below = (1 - x.within) * value(mix, y.index, x.index) + x.within * value(mix, y.index, x.index + 1);
  const double above =
      (1 - x.within) * value(mix, y.index + 1, x.index) + x.within * value(mix, y.index + 1, x.index + 1);
  return ((1 - y.within) * below + y.within * above) * static_cast<double>(width_ - 1) *
         static_cast<double>(height_ - 1);
}

double bilinear(const std::vector<float>& values, std::size_t first, std::size_t height, std::size_t width,
                SquarePoint at) {
  const Cell x = cell_of(at.x, width), y = cell_of(at.y, height);
  const float* row = &values[first + y.index * width + x.index];
  const double below = (1 - x.within) * row[0] + x.within * row[1];
  const double above = (1 - x.within) * row[width] + x.within * row[width + 1];
  return (1 - y.within) * below + y.within * above;
}

}  // namespace gonio
