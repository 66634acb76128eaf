// SPDX-License-Identifier: MIT
#pragma once

/// Makes views of matrices of Eigen, such as `V` and `F` of libigl, in either storage order and without a copy. The
/// header is empty unless Eigen is found.
///
///     Eigen::MatrixXd V;  // #V by 3
///     Eigen::MatrixXi F;  // #F by 3
///     const auto index = meshhood::build(meshhood::mesh_view(V, F));

#if __has_include(<Eigen/Core>)

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {

namespace detail {

/// Whether a matrix owns its coefficients. A `Ref` to constants may: it copies what it cannot refer to.
template <class M>
struct OwnsCoefficients : std::is_base_of<Eigen::PlainObjectBase<M>, M> {};
template <class M, int Options, class Stride>
struct OwnsCoefficients<Eigen::Ref<const M, Options, Stride>> : std::true_type {};

template <class M>
void check_columns(const M& matrix, const char* name) {
  if (matrix.cols() == 3) return;
  raise(ErrorCode::InvalidMesh, std::string(name) + " has " + std::to_string(matrix.cols()) + " columns, expected 3");
}

}  // namespace detail

/// A matrix of Eigen whose coefficients lie in memory that outlives the expression: an lvalue, or a view of one (`Map`,
/// `Block`, `Ref` to a matrix that may change). A temporary matrix is not.
template <class M>
concept BorrowedMatrix = std::derived_from<std::remove_cvref_t<M>, Eigen::DenseBase<std::remove_cvref_t<M>>> &&
                         (std::remove_cvref_t<M>::Flags & Eigen::DirectAccessBit) != 0 &&
                         (std::is_lvalue_reference_v<M> || !detail::OwnsCoefficients<std::remove_cvref_t<M>>::value);

/// Borrows `V`, #V by 3, float or double. Throws Error{InvalidMesh} if it has other than three columns.
template <BorrowedMatrix M>
[[nodiscard]] PositionsView positions_view(M&& V) {
  detail::check_columns(V, "V");
  return PositionsView::strided(V.data(), static_cast<std::size_t>(V.rows()), static_cast<std::size_t>(V.rowStride()),
                                static_cast<std::size_t>(V.colStride()));
}

/// Borrows `F`, #F by 3, integers of 16 to 64 bits. Throws Error{InvalidMesh} if it has other than three columns.
template <BorrowedMatrix M>
[[nodiscard]] FacesView triangles_view(M&& F) {
  detail::check_columns(F, "F");
  const auto rows = static_cast<std::size_t>(F.rows());
  const auto row_stride = static_cast<std::size_t>(F.rowStride());
  const auto column_stride = static_cast<std::size_t>(F.colStride());
  const std::size_t size = rows == 0 ? 0 : (rows - 1) * row_stride + 2 * column_stride + 1;
  return FacesView::strided_triangles(std::span(F.data(), size), rows, row_stride, column_stride);
}

/// Borrows the mesh of `V` and `F`. Throws as the functions above.
template <BorrowedMatrix Positions, BorrowedMatrix Triangles>
[[nodiscard]] MeshView mesh_view(Positions&& V, Triangles&& F) {
  return {positions_view(V), triangles_view(F)};
}

}  // namespace meshhood::inline v0_1

#endif
