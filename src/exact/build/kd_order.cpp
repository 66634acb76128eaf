// SPDX-License-Identifier: MIT
#include "exact/build/kd_order.h"

#include <algorithm>
#include <vector>

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
void cut_at(std::span<Site> sites, std::size_t middle) {
  std::nth_element(
      sites.begin(), sites.begin() + static_cast<std::ptrdiff_t>(middle), sites.end(),
      [](const Site& a, const Site& b) { return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.id < b.id; });
}

/// Cuts across the widest side and returns where.
std::size_t cut(std::span<Site> sites, std::size_t unit) {
  const std::size_t units = (sites.size() + unit - 1) / unit;
  const std::size_t middle = units / 2 * unit;
  switch (widest_axis(sites)) {
    case 0: cut_at<0>(sites, middle); break;
    case 1: cut_at<1>(sites, middle); break;
    default: cut_at<2>(sites, middle); break;
  }
  return middle;
}

using Runs = std::vector<std::span<Site>>;

/// Cuts each run in two, unless it is too short.
Runs cut_each(const Runs& runs, std::size_t unit, TaskContext& task) {
  Runs halves(2 * runs.size());
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) {
    const std::size_t middle = runs[i].size() > unit ? cut(runs[i], unit) : 0;
    halves[2 * i] = runs[i].first(middle);
    halves[2 * i + 1] = runs[i].subspan(middle);
  });
  return halves;
}

}  // namespace

void kd_order(std::span<Site> sites, std::size_t unit) {
  while (sites.size() > unit) {
    const std::size_t middle = cut(sites, unit);
    kd_order(sites.first(middle), unit);
    sites = sites.subspan(middle);
  }
}

void kd_order(std::span<Site> sites, std::size_t unit, TaskContext& task) {
  // Enough for threads of unequal speed to end at the same time, and no more than is worth a thread's while.
  constexpr std::size_t kRunsPerThread = 8;
  constexpr std::size_t kShortestRun = 2000;
  Runs runs{sites};
  while (runs.size() < kRunsPerThread * task.threads() && sites.size() / runs.size() > kShortestRun) {
    runs = cut_each(runs, unit, task);
  }
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) { kd_order(runs[i], unit); });
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
