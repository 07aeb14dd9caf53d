#pragma once
#include <memory>
#include <vector>

#include "lattice/field_table.hpp"
#include "magnetic/field_at.hpp"

namespace hemomag::magnetic {

/// Tricubic spline through the values of a table: of fourth order in B and third in its gradient,
/// which is smooth across the cells (B has continuous second derivatives). Not-a-knot at the faces
/// of the grid; a little beyond them the outermost cell's polynomial goes on.
/// div B and curl B vanish only as far as the table resolves the field.
class TableField {
public:
  /// @param origin     where the table's own origin lies
  /// @param per_metre  units of length in a metre
  /// @param per_tesla  units of field in a tesla
  TableField(const lattice::FieldTable& table, const Vec3& origin, double per_metre,
             double per_tesla);

  FieldAt operator()(const Vec3& x) const;
  Vec3 low() const { return first_; }
  Vec3 high() const;

private:
  Vec3 first_, spacing_;
  std::array<std::size_t, 3> n_;
  std::shared_ptr<const std::vector<Vec3>> coefficients_;  // [n + 2 along each axis], x fastest
};

}  // namespace hemomag::magnetic
