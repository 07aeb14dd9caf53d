#pragma once
#include "base/vec3.hpp"
#include "fluid/plates.hpp"
#include "fluid/relaxation.hpp"
#include "fluid/sweep.hpp"
#include "fluid/wall_links.hpp"
#include "lattice/node_layout.hpp"

// The exponential scheme looks one node ahead along every direction. Where a wall is in the way,
// K g_i(x + e_i) is reflected half-way like a population: K (g_j(x) + 6 w_i e_i . u_w), j opposite
// to i. Beyond walls all numbers are zero, so that this term only has to be added to the place
// from which the sweep will read f_i(x).

namespace hemomag::fluid {

template <class Real> using SourceNumbers = std::array<Real*, sources>;  ///< at node (0, 0, 0)

/// Add `sense` (1; -1 to undo) times the term at every node of the plate's first layer.
/// @param next  the pass that will read the places
/// @return momentum given to the plate
template <class Real>
Vec3 add_reflected_source(const Plate& plate, Pass next, const Populations<Real>& f,
                          const SourceNumbers<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense);

/// The same at the links of a wall at rest.
template <class Real>
Vec3 add_reflected_source(const WallLinks<Real>& links, Pass next, const Populations<Real>& f,
                          const SourceNumbers<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense);

/// The distribution of a node, g_i - w_i, in direction i.
template <class Real>
Real source_population(const SourceNumbers<Real>& field, std::ptrdiff_t at, int i);

}  // namespace hemomag::fluid
