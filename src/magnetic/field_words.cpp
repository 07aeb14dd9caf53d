#include "magnetic/field_words.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"

namespace hemomag::magnetic {
namespace {

constexpr const char* sources =
    "none, uniform BX BY BZ, gradient AXIS SLOPE ZERO, "
    "quadrupole PLANE SLOPE X Y Z, rotating PLANE B0 FREQUENCY, block, cylinder, coil, coil_pair, "
    "wire, table (docs/styles/fix_hemo_field.md), each "
    "followed by sine FREQUENCY, ramp START LENGTH or pulse START "
    "LENGTH";

/// The words of one source, taken one after the other.
class Words {
public:
  Words(std::span<const std::string> words, std::size_t& at) : words_(words), at_(at) {}

  /// Begin with the name of a source or a time factor.
  const std::string& name() { return name_ = words_[at_++]; }
  bool next_is(const char* word) const { return at_ < words_.size() && words_[at_] == word; }

  const std::string& word(const char* what) {
    if (at_ >= words_.size()) throw Error(name_ + " ends before " + what);
    return words_[at_++];
  }

  double number(const char* what) {
    const std::string& text = word(what);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      throw Error(name_ + ": '" + text + "' is not a number; accepted: " + what);
    return value;
  }

  double positive(const char* what) {
    const double value = number(what);
    if (!(value > 0)) throw Error(name_ + ": " + what + " must be above 0");
    return value;
  }

  Vec3 vector(const char* x, const char* y, const char* z) {
    Vec3 v;
    v.x = number(x), v.y = number(y), v.z = number(z);
    return v;
  }

  Vec3 direction(const char* x, const char* y, const char* z) {
    const Vec3 v = vector(x, y, z);
    if (!(norm(v) > 0)) throw Error(name_ + ": a direction of length zero; accepted: another");
    return v;
  }

  /// Centre and axis of a body of revolution.
  Frame frame() {
    const Vec3 centre = vector("X", "Y", "Z");
    return Frame::along(centre, direction("AX", "AY", "AZ"));
  }

  int axis() {
    const std::string& text = word("AXIS");
    if (text != "x" && text != "y" && text != "z")
      throw Error(name_ + ": '" + text + "' is not an axis; accepted: x, y, z");
    return text[0] - 'x';
  }

  /// Two axes, "zx": the first and the second of the plane.
  std::array<int, 2> plane() {
    const std::string& text = word("PLANE");
    const auto letter = [&](std::size_t k) { return text[k] >= 'x' && text[k] <= 'z'; };
    if (text.size() != 2 || !letter(0) || !letter(1) || text[0] == text[1])
      throw Error(name_ + ": '" + text + "' is not a plane; accepted: two axes, e.g. xy");
    return {text[0] - 'x', text[1] - 'x'};
  }

private:
  std::span<const std::string> words_;
  std::size_t& at_;
  std::string name_;
};

std::vector<Source> block(Words& words) {
  const Vec3 J = words.vector("JX", "JY", "JZ");
  Vec3 edges;
  edges.x = words.positive("LX"), edges.y = words.positive("LY"), edges.z = words.positive("LZ");
  const Vec3 centre = words.vector("X", "Y", "Z"), axis = words.direction("AX", "AY", "AZ");
  const Vec3 across = words.direction("CX", "CY", "CZ");
  if (norm(cross(axis, across)) < 1e-6 * norm(axis) * norm(across))
    throw Error("block: (CX, CY, CZ) is along (AX, AY, AZ); accepted: another direction");
  const Frame frame = Frame::along(centre, axis, across);
  return {{BlockMagnet{frame, 0.5 * edges, frame.components(J)}, {}}};
}

/// Two loops on one axis, each half of DISTANCE from (X, Y, Z); the second is ahead.
std::vector<Source> coil_pair(Words& words) {
  const double first = words.number("CURRENT1"), second = words.number("CURRENT2");
  const double radius = words.positive("DIAMETER") / 2, half = words.positive("DISTANCE") / 2;
  Frame behind = words.frame(), ahead = behind;
  behind.origin = ahead.place({0, 0, -half});
  ahead.origin = ahead.place({0, 0, half});
  return {{CurrentLoop{behind, radius, first}, {}}, {CurrentLoop{ahead, radius, second}, {}}};
}

std::vector<Source> read_shape(Words& words, const TableReader& read_table) {
  const std::string& kind = words.name();
  if (kind == "none") return {};
  if (kind == "uniform") return {{UniformField{words.vector("BX", "BY", "BZ")}, {}}};
  if (kind == "gradient") {
    const int axis = words.axis();
    const double slope = words.number("SLOPE");
    return {{AxialGradient{axis, slope, words.number("ZERO")}, {}}};
  }
  if (kind == "quadrupole") {
    const auto [u, v] = words.plane();
    const double slope = words.number("SLOPE");
    return {{Quadrupole{u, v, slope, words.vector("X", "Y", "Z")}, {}}};
  }
  if (kind == "rotating") {
    const auto [u, v] = words.plane();
    const double B0 = words.number("B0");
    return rotating(u, v, B0, words.number("FREQUENCY"));
  }
  if (kind == "block") return block(words);
  if (kind == "cylinder") {
    const double J = words.number("J"), diameter = words.positive("DIAMETER"),
                 length = words.positive("LENGTH");
    return {{CylinderMagnet{words.frame(), diameter / 2, length / 2, J}, {}}};
  }
  if (kind == "coil") {
    const double current = words.number("CURRENT"), diameter = words.positive("DIAMETER");
    return {{CurrentLoop{words.frame(), diameter / 2, current}, {}}};
  }
  if (kind == "coil_pair") return coil_pair(words);
  if (kind == "wire") {
    const double current = words.number("CURRENT");
    return {{StraightWire{words.frame(), current}, {}}};
  }
  if (kind == "table") {
    const std::string file = words.word("FILE");
    const double per_metre = words.positive("PER_METRE"), per_tesla = words.positive("PER_TESLA");
    const Vec3 origin = words.vector("X", "Y", "Z");
    return {{TableField(*read_table(file), origin, per_metre, per_tesla), {}}};
  }
  throw Error("'" + kind + "' is unknown; accepted: " + sources);
}

/// Time factors may be combined, but a source has one oscillation and one envelope.
void read_factors(Words& words, std::vector<Source>& shapes) {
  using Envelope = TimeFactor::Envelope;
  for (;;) {
    if (words.next_is("sine")) {
      words.name();
      const double frequency = words.number("FREQUENCY");
      for (Source& s : shapes) {
        if (s.factor.oscillates())
          throw Error("sine: the field oscillates already; accepted: one sine, not of a rotating "
                      "field");
        s.factor.frequency = frequency;
        s.factor.phase = 0.25;
      }
    } else if (words.next_is("ramp") || words.next_is("pulse")) {
      const Envelope envelope = words.name() == "ramp" ? Envelope::ramp : Envelope::pulse;
      const double start = words.number("START"), length = words.positive("LENGTH");
      for (Source& s : shapes) {
        if (s.factor.envelope != Envelope::constant)
          throw Error("ramp and pulse exclude each other; accepted: one of the two");
        s.factor.envelope = envelope;
        s.factor.start = start;
        s.factor.length = length;
      }
    } else {
      return;
    }
  }
}

}  // namespace

void read_source(std::span<const std::string> text, std::size_t& at, Field& field,
                 const TableReader& read_table) {
  Words words(text, at);
  std::vector<Source> shapes = read_shape(words, read_table);
  read_factors(words, shapes);
  for (const Source& source : shapes) field.add(source);
}

}  // namespace hemomag::magnetic
