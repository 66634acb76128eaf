// SPDX-License-Identifier: MIT
#include "exact/arrays.h"

#include <utility>

namespace meshhood::inline v0_1 {
namespace {

template <class T, class Allocator>
void borrow(std::span<const T>& span, const std::vector<T, Allocator>& array) {
  span = array;
}

void borrow(PositionsInOrder& span, const OrderedPositions& array) { span = view_of(array); }

}  // namespace

PositionsInOrder view_of(const OrderedPositions& positions) {
  return std::visit([](const auto& xyz) -> PositionsInOrder { return std::span(xyz); }, positions);
}

IndexView view_of(const IndexData& data) {
  IndexView view;
  view.frame = data.frame;
  for_each_array([](ArrayInfo, auto& span, const auto& array) { borrow(span, array); }, view, data);
  if (!view.groups.empty()) derive(view);
  return view;
}

std::shared_ptr<IndexView> make_view(IndexData data) {
  // Moving an array does not change its address.
  auto view = std::make_shared<IndexView>(view_of(data));
  view->owner = std::make_shared<const ConnectivityData>(static_cast<ConnectivityData&&>(data));
  view->geometry = std::make_shared<GeometryData>(static_cast<GeometryData&&>(data));
  return view;
}

void set_geometry(IndexView& view, std::shared_ptr<GeometryData> geometry) {
  IndexView next = view;
  next.frame = geometry->frame;
  borrow(next.positions, geometry->positions);
  borrow(next.leaves, geometry->leaves);
  borrow(next.groups, geometry->groups);
  borrow(next.mean_radii, geometry->mean_radii);
  derive(next);
  next.geometry = std::move(geometry);
  view = std::move(next);
}

}  // namespace meshhood::inline v0_1
