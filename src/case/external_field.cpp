#include "case/external_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "case/lattice_units.hpp"
#include "magnetic/clearance.hpp"
#include "magnetic/field_words.hpp"

namespace hemomag::case_ {
namespace {

constexpr int points_per_axis = 25;    // of a survey
constexpr int instants_of_a_run = 32;  // of a field that changes
constexpr int instants_of_a_period = 16;

/// Number of the coordinate axis that a gradient lies along.
std::size_t axis_number(const MagneticSource& s) {
  return s.axis.x == 1 ? 0 : s.axis.y == 1 ? 1 : 2;
}

/// The words of one source, SI turned into lattice units.
class SourceWords {
public:
  explicit SourceWords(const Case& c) : c_(c), units_(lattice_units(c)) {}

  std::vector<std::string> write(const MagneticSource& s) {
    switch (s.field) {
    case FieldKind::uniform:
      uniform(s);
      break;
    case FieldKind::gradient:
      gradient(s);
      break;
    case FieldKind::quadrupole:
      add("quadrupole"), add(s.plane.c_str());
      add(*s.gradient * units_.dx / units_.magnetic_field());
      place(s.zero_at);
      break;
    case FieldKind::rotating:
      add("rotating"), add(s.plane.c_str());
      add(s.B0 / units_.magnetic_field()), add(s.frequency * units_.dt);
      break;
    case FieldKind::magnet:
      magnet(s);
      break;
    case FieldKind::coil:
      coil(s);
      break;
    case FieldKind::wire:
      add("wire"), add(s.current * current_unit());
      place(s.position), direction(s.axis);
      break;
    case FieldKind::table:
      add("table"), add(table_copy(s).c_str());
      add(1 / units_.dx), add(1 / units_.magnetic_field());
      place(s.position);
      break;
    }
    time(s);
    return words_;
  }

private:
  void add(const char* word) { words_.emplace_back(word); }
  void add(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", number);
    words_.emplace_back(text);
  }
  void place(const std::array<double, 3>& x) {
    for (const double metres : x) add(metres / units_.dx);
  }

  void uniform(const MagneticSource& s) {
    add("uniform");
    direction(s.B0 / units_.magnetic_field() * s.axis);
  }

  void gradient(const MagneticSource& s) {
    const char axis[2] = {"xyz"[axis_number(s)], 0};
    const GradientField g = gradient_field(c_, s);
    add("gradient"), add(axis);
    add(g.slope * units_.dx / units_.magnetic_field()), add(g.zero / units_.dx);
  }

  void direction(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void length(double metres) { add(metres / units_.dx); }

  /// Lattice units of a current in an ampere: mu* I is a field times a length.
  double current_unit() const {
    return vacuum_permeability / (units_.magnetic_field() * units_.dx);
  }

  void magnet(const MagneticSource& s) {
    const double J = s.remanence / units_.magnetic_field();
    if (s.shape == MagnetShape::block) {
      add("block"), direction(J * s.magnetisation), place(s.size);
      place(s.position), direction(s.axis), direction(s.across);
    } else {
      add("cylinder"), add(J), length(s.diameter), length(s.length);
      place(s.position), direction(s.axis);
    }
  }

  void coil(const MagneticSource& s) {
    const double current = s.current * current_unit();
    if (s.pair == CoilPair::none) {
      add("coil"), add(current), length(s.diameter);
    } else {
      add("coil_pair"), add(current), add(s.pair == CoilPair::same ? current : -current);
      length(s.diameter), length(s.distance);
    }
    place(s.position), direction(s.axis);
  }

  void time(const MagneticSource& s) {
    if (s.time == TimeCourse::constant) return;
    if (s.time == TimeCourse::sine) {
      add("sine"), add(s.frequency * units_.dt);
      return;
    }
    add(s.time == TimeCourse::ramp ? "ramp" : "pulse");
    add(s.start / units_.dt), add(s.duration / units_.dt);
  }

  const Case& c_;
  LatticeUnits units_;
  std::vector<std::string> words_;
};

/// Times at which a field may be strongest: throughout the run, at the start, and at the ends of
/// ramps and pulses, and throughout a period from each of these on.
std::vector<double> instants(const magnetic::Field& field, double last) {
  std::vector<double> events{0}, all;
  for (const auto& source : field.sources())
    if (source.factor.envelope != magnetic::TimeFactor::Envelope::constant)
      for (const double share : {0.0, 0.5, 1.0})
        events.push_back(source.factor.start + share * source.factor.length);
  const bool steady = std::all_of(field.sources().begin(), field.sources().end(),
                                  [](const auto& s) { return s.factor.steady(); });
  if (steady) return {0};
  for (int k = 1; k <= instants_of_a_run; ++k) all.push_back(last * k / instants_of_a_run);
  for (const double event : events) {
    all.push_back(event);
    for (const auto& source : field.sources())
      for (int k = 1; source.factor.oscillates() && k < instants_of_a_period; ++k)
        all.push_back(event + k / (instants_of_a_period * source.factor.frequency));
  }
  std::erase_if(all, [&](double t) { return t < 0 || t > last; });
  return all;
}

}  // namespace

std::vector<std::string> field_words(const Case& c) {
  std::vector<std::string> all;
  for (const MagneticSource& s : c.magnetic.sources)
    for (std::string& word : SourceWords(c).write(s)) all.push_back(std::move(word));
  if (all.empty()) all.emplace_back("none");
  return all;
}

magnetic::Field external_field(const Case& c, const MagneticSource& s) {
  const std::vector<std::string> words = SourceWords(c).write(s);
  magnetic::Field field;
  std::size_t at = 0;
  magnetic::read_source(words, at, field, [&](const std::string&) { return s.table; });
  return field;
}

magnetic::Field external_field(const Case& c) {
  magnetic::Field field;
  for (const MagneticSource& s : c.magnetic.sources) {
    const magnetic::Field alone = external_field(c, s);
    for (const magnetic::Source& source : alone.sources()) field.add(source);
  }
  return field;
}

std::string table_copy(const MagneticSource& s) { return s.key + ".csv"; }

magnetic::Magnetisation magnetisation(const Case& c, const Carrier& carrier) {
  const LatticeUnits units = lattice_units(c);
  const double dx3 = std::pow(units.dx, 3);
  const double moment_si = carrier.saturation_magnetisation * magnetic_volume(carrier);
  return {susceptible_volume(carrier) / dx3,
          moment_si * vacuum_permeability / (units.magnetic_field() * dx3)};
}

GradientField gradient_field(const Case& c, const MagneticSource& s) {
  const std::size_t axis = axis_number(s);
  if (s.gradient) return {*s.gradient, s.zero_at[axis]};
  return {s.B0 / c.channel.size[axis], c.channel.size[axis]};
}

FieldSurvey::FieldSurvey(const Case& c) {
  const magnetic::Field field = external_field(c);
  const auto n = nodes(c);
  const int last = points_per_axis - 1;
  const auto place = [&](int k, std::size_t d) { return static_cast<double>(k) / last * n[d]; };
  const auto take = [&](const Vec3& x) {
    auto& at = shapes_.emplace_back();
    for (const auto& source : field.sources()) at.push_back(magnetic::evaluate(source.shape, x));
  };
  // Where a body is nearest a field that no grid of points might meet can be strongest.
  const Vec3 low, high = {1.0 * n[0], 1.0 * n[1], 1.0 * n[2]};
  for (const auto& source : field.sources())
    if (const auto gap = magnetic::gap(source.shape, low, high)) take(gap->in_box);
  for (int i = 0; i <= last; ++i)
    for (int j = 0; j <= last; ++j)
      for (int k = 0; k <= last; ++k) take({place(i, 0), place(j, 1), place(k, 2)});
  for (const double t : instants(field, static_cast<double>(steps(c)))) {
    auto& weights = weights_.emplace_back();
    for (const auto& source : field.sources()) weights.push_back(source.factor.at(t));
  }
}

}  // namespace hemomag::case_
