// SPDX-License-Identifier: MIT
#include "index/kd_order.h"

#include <algorithm>

namespace meshhood {
namespace {

std::size_t widest_axis(std::span<const Site> sites) {
  std::array<float, 3> low = sites[0].at;
  std::array<float, 3> high = low;
  for (const Site& site : sites) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], site.at[axis]);
      high[axis] = std::max(high[axis], site.at[axis]);
    }
  }
  const std::array<float, 3> width = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  return static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
}

template <std::size_t axis>
void cut(std::span<Site> sites, std::size_t middle) {
  std::nth_element(
      sites.begin(), sites.begin() + static_cast<std::ptrdiff_t>(middle), sites.end(),
      [](const Site& a, const Site& b) { return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.id < b.id; });
}

}  // namespace

void kd_order(std::span<Site> sites, std::size_t unit) {
  while (sites.size() > unit) {
    const std::size_t units = (sites.size() + unit - 1) / unit;
    const std::size_t middle = units / 2 * unit;
    switch (widest_axis(sites)) {
      case 0: cut<0>(sites, middle); break;
      case 1: cut<1>(sites, middle); break;
      default: cut<2>(sites, middle); break;
    }
    kd_order(sites.first(middle), unit);
    sites = sites.subspan(middle);
  }
}

void kd_order_nested(std::span<Site> sites, std::size_t fan_out) {
  if (sites.size() <= fan_out) return;
  std::size_t unit = fan_out;
  while (unit * fan_out < sites.size()) unit *= fan_out;
  kd_order(sites, unit);
  for (std::size_t begin = 0; begin < sites.size(); begin += unit) {
    kd_order_nested(sites.subspan(begin, std::min(unit, sites.size() - begin)), fan_out);
  }
}

}  // namespace meshhood
