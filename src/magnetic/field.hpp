#pragma once
#include <variant>
#include <vector>

#include "magnetic/block_magnet.hpp"
#include "magnetic/plain_fields.hpp"
#include "magnetic/round_sources.hpp"
#include "magnetic/table_field.hpp"
#include "magnetic/time_factor.hpp"

// External magnetic fields and their exact gradients, in units where the vacuum permeability mu* is
// one.

namespace hemomag::magnetic {

/// A steady field: what a source makes when its time factor is one.
using Shape = std::variant<UniformField, AxialGradient, Quadrupole, BlockMagnet, CylinderMagnet,
                           CurrentLoop, StraightWire, TableField>;

struct Source {
  Shape shape;
  TimeFactor factor;
};

inline FieldAt evaluate(const Shape& shape, const Vec3& x) {
  return std::visit([&](const auto& s) { return s(x); }, shape);
}

/// A sum of sources at one instant, t = 0 at first. No source: no field.
/// A field that rotates is two uniform ones, a quarter of a turn apart (`rotating`).
class Field {
public:
  Field() = default;
  explicit Field(std::vector<Source> sources) : sources_(std::move(sources)) { set_time(0); }

  const std::vector<Source>& sources() const { return sources_; }
  void add(const Source& source) {
    sources_.push_back(source);
    weights_.push_back(source.factor.at(0));
  }

  /// Everything evaluated from here on is the field at time t.
  void set_time(double t) {
    weights_.resize(sources_.size());
    for (std::size_t k = 0; k < sources_.size(); ++k) weights_[k] = sources_[k].factor.at(t);
  }

  FieldAt operator()(const Vec3& x) const {
    FieldAt sum;
    for (std::size_t k = 0; k < sources_.size(); ++k)
      if (weights_[k] != 0) add_scaled(sum, weights_[k], evaluate(sources_[k].shape, x));
    return sum;
  }

private:
  std::vector<Source> sources_;
  std::vector<double> weights_;
};

/// B0 (cos 2 pi f t e_u + sin 2 pi f t e_v).
inline std::vector<Source> rotating(int u, int v, double B0, double frequency) {
  UniformField cosine, sine;
  cosine.B[static_cast<std::size_t>(u)] = B0;
  sine.B[static_cast<std::size_t>(v)] = B0;
  return {{cosine, {frequency, 0}}, {sine, {frequency, 0.25}}};
}

}  // namespace hemomag::magnetic
