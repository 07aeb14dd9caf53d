#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "membrane/whole_cell.hpp"

// The elasticity of a flat periodic sheet of the membrane's springs and triangles.

namespace hemomag::app {

/// A flat periodic triangulation in the plane z = 0. Corners lie `images` boxes away.
struct Sheet {
  struct Corner {
    int vertex;
    std::array<int, 2> image;
  };
  double width = 0, height = 0;  ///< of the box, along x and y
  std::vector<Vec3> x;
  std::vector<std::array<Corner, 3>> triangles;  ///< counter-clockwise
};

/// Equilateral triangles of side `edge`, `columns` x 2 `double_rows` vertices.
Sheet regular_sheet(int columns, int double_rows, double edge);

/// A random Delaunay triangulation evened by Lloyd's steps, of `vertices` vertices with the area of
/// equilateral triangles of side `edge`.
Sheet irregular_sheet(int vertices, double edge, std::uint64_t seed);

/// Elasticity in the plane: stress = C strain in the order xx, yy, xy with xy the engineering shear
/// [force/length].
struct Elasticity {
  std::array<std::array<double, 3>, 3> C{};

  /// The same in axes turned by an angle [degrees].
  Elasticity turned(double degrees) const;
  double shear() const { return C[2][2]; }
  /// Force per length over strain in a pull along x, free across.
  double youngs() const;
  /// Of equal extension along x and y: stress per relative change of area.
  double area() const { return (C[0][0] + C[1][1] + 2 * C[0][1]) / 4; }
};

/// Second derivatives of the sheet's energy by its strain, its vertices relaxed in every state.
Elasticity elasticity(const Sheet& sheet, const membrane::Moduli& moduli);

}  // namespace hemomag::app
