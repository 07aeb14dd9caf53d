#pragma once
#include <span>
#include <vector>

#include "analysis/inside.hpp"

// What the space between two plates holds, by the height z above the lower one. Sums over the
// triangles of all ranks may be added.

namespace hemomag::analysis {

/// Add to volume[k] what closed surfaces enclose in the slab k h <= z < (k + 1) h.
///
/// A column of height z is inside as often as its ray upwards leaves more surfaces than it enters,
/// so the enclosed area at z is the sum over triangles of the projected area of their part above z,
/// with the sign of the normal's z. Between the corners' heights that part is a quadratic of z, and
/// its integral over a slab is exact. Where a triangle lies along x and y does not matter.
/// @param triangles  corners counter-clockwise seen from outside
/// @param h          thickness of a slab
void add_enclosed_volume(std::span<const SurfaceTriangle> triangles, double h,
                         std::span<double> volume);

/// Height, measured from the first value's side of the profile, where a hematocrit profile first
/// reaches half of its mean over the middle half of the channel, linear between the middles of
/// slabs; 0 when it does already in the first slab, half the height when it never does.
/// @param hematocrit  of slabs of equal thickness h
double half_core_height(std::span<const double> hematocrit, double h);

/// Running mean and standard deviation of a vector of values (Welford 1962).
class Moments {
public:
  void add(std::span<const double> values);
  long count() const { return count_; }
  double mean(std::size_t k) const { return k < mean_.size() ? mean_[k] : 0; }
  /// Of the values about their mean, with count - 1; 0 below two.
  double deviation(std::size_t k) const;

  /// All it holds: count, means, sums of squares; and the same again from them.
  std::vector<double> state() const;
  static Moments from(std::span<const double> state);

private:
  long count_ = 0;
  std::vector<double> mean_, square_;  // of the values; sum of squares about the mean
};

}  // namespace hemomag::analysis
