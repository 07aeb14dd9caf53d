#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"
#include "magnetic/field.hpp"
#include "magnetic/moment.hpp"

namespace hemomag::case_ {

/// The fields of a case as `fix hemo/field` takes them, in lattice units.
std::vector<std::string> field_words(const Case& c);

/// Name of a table in the run directory: that of its key with the original's ending.
std::string table_copy(const MagneticSource& source);

/// What these words mean: the very field of the run, in lattice units.
magnetic::Field external_field(const Case& c);
/// One of them alone.
magnetic::Field external_field(const Case& c, const MagneticSource& source);

/// Slope of |B| [T/m] of a gradient and where it vanishes [m] along its axis; the default is B0 (1
/// - z/H).
struct GradientField {
  double slope = 0;
  double zero = 0;
};
GradientField gradient_field(const Case& c, const MagneticSource& source);

/// Largest moment of a carrier and its slope, in lattice units.
magnetic::Magnetisation magnetisation(const Case& c, const Carrier& carrier);

/// The field at points throughout the box, its faces included, and at instants throughout the run:
/// what the card judges.
class FieldSurvey {
public:
  explicit FieldSurvey(const Case& c);

  /// Call visit(FieldAt) for every point and instant, lattice units.
  template <class Visit> void for_each(Visit visit) const {
    for (const auto& at_point : shapes_)
      for (const auto& weights : weights_) {
        magnetic::FieldAt sum;
        for (std::size_t k = 0; k < weights.size(); ++k)
          magnetic::add_scaled(sum, weights[k], at_point[k]);
        visit(sum);
      }
  }

private:
  std::vector<std::vector<magnetic::FieldAt>> shapes_;  // [point][source], without time factor
  std::vector<std::vector<double>> weights_;            // [instant][source]
};

}  // namespace hemomag::case_
