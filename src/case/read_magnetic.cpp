#include "case/read_magnetic.hpp"

#include <algorithm>
#include <filesystem>

#include "case/external_field.hpp"
#include "io/field_table_file.hpp"
#include "io/files.hpp"
#include "magnetic/frame.hpp"

namespace hemomag::case_ {
namespace {

using Words = std::vector<std::string>;

/// Which fields a key belongs to; other keys belong to all.
struct Owner {
  const char* key;
  Words fields;
};

const std::vector<Owner>& owners() {
  static const std::vector<Owner> all = {
      {"B0", {"uniform", "gradient", "rotating"}},
      {"axis", {"uniform", "gradient", "magnet", "coil", "wire"}},
      {"gradient", {"gradient", "quadrupole"}},
      {"zero_at", {"gradient", "quadrupole"}},
      {"plane", {"quadrupole", "rotating"}},
      {"position", {"magnet", "coil", "wire", "table"}},
      {"shape", {"magnet"}},
      {"size", {"magnet"}},
      {"across", {"magnet"}},
      {"diameter", {"magnet", "coil"}},
      {"length", {"magnet"}},
      {"remanence", {"magnet"}},
      {"magnetisation", {"magnet"}},
      {"current", {"coil", "wire"}},
      {"turns", {"coil"}},
      {"pair", {"coil"}},
      {"distance", {"coil"}},
      {"file", {"table"}}};
  return all;
}

std::string either(const Words& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "\"" : k + 1 < words.size() ? "\", \"" : "\" or \"") + words[k];
  return text + "\"";
}

/// Refuse what the chosen field does not have.
void refuse_others(const Table& t, const std::string& field) {
  for (const Owner& o : owners())
    if (std::find(o.fields.begin(), o.fields.end(), field) == o.fields.end())
      t.refuse_if_given(o.key,
                        "needs field = " + either(o.fields) + "; accepted: that, or leave it out");
}

void read_time(MagneticSource& s, const Table& t) {
  const std::string course = t.word("time");
  s.time = course == "sine"    ? TimeCourse::sine
           : course == "ramp"  ? TimeCourse::ramp
           : course == "pulse" ? TimeCourse::pulse
                               : TimeCourse::constant;
  const bool rotates = s.field == FieldKind::rotating;
  if (rotates && s.time == TimeCourse::sine)
    t.fail("time",
           "\"sine\" excludes a rotating field; accepted: \"constant\", \"ramp\", \"pulse\"");
  if (rotates || s.time == TimeCourse::sine)
    t.require("frequency");
  else
    t.refuse_if_given("frequency", "needs field = \"rotating\" or time = \"sine\"; accepted: one "
                                   "of these, or leave it out");
  s.frequency = t.optional_quantity("frequency").value_or(0);
  if (s.time == TimeCourse::ramp || s.time == TimeCourse::pulse)
    t.require("duration");
  else
    for (const char* key : {"start", "duration"})
      t.refuse_if_given(key, "needs time = \"ramp\" or \"pulse\"; accepted: one of these, or leave "
                             "it out");
  s.start = t.quantity("start");
  s.duration = t.optional_quantity("duration").value_or(0);
}

void read_gradient(MagneticSource& s, const Table& t, const Case& c) {
  s.gradient = t.optional_quantity("gradient");
  s.zero_at = t.vector("zero_at");
  if (s.field == FieldKind::gradient && std::max({s.axis.x, s.axis.y, s.axis.z}) < 1)
    t.fail("axis", "a gradient lies along one axis; accepted: \"x\", \"y\", \"z\"");
  if (s.field == FieldKind::quadrupole) {
    t.require("gradient");
    return;
  }
  if (s.gradient) t.refuse_if_given("B0", "excludes gradient; accepted: one of the two");
  if (t.has("zero_at") && !s.gradient)
    t.fail("zero_at", "needs an explicit gradient; accepted: gradient = \"... T/m\" with it");
  if (!s.gradient && c.channel.boundary != Boundary::plates)
    t.missing("gradient", "is missing; gradient = \"... T/m\" is required without plates");
}

FieldKind kind(const std::string& field) {
  return field == "uniform"      ? FieldKind::uniform
         : field == "gradient"   ? FieldKind::gradient
         : field == "quadrupole" ? FieldKind::quadrupole
         : field == "rotating"   ? FieldKind::rotating
         : field == "magnet"     ? FieldKind::magnet
         : field == "coil"       ? FieldKind::coil
         : field == "wire"       ? FieldKind::wire
                                 : FieldKind::table;
}

void read_block(MagneticSource& s, const Table& t) {
  for (const char* key : {"diameter", "length"})
    t.refuse_if_given(key, "needs shape = \"cylinder\"; accepted: that, or leave it out");
  t.require("size");
  s.size = t.vector("size");
  s.across = t.direction("across").value_or(magnetic::Frame::along({}, s.axis).axes[0]);
  if (norm(cross(s.across, s.axis)) < 1e-3)
    t.fail("across", "is along axis; accepted: a direction across it");
  s.magnetisation = t.direction("magnetisation").value_or(s.axis);
}

void read_cylinder(MagneticSource& s, const Table& t) {
  for (const char* key : {"size", "across"})
    t.refuse_if_given(key, "needs shape = \"block\"; accepted: that, or leave it out");
  t.refuse_if_given("magnetisation", "is the axis for a cylinder, there is no closed form across "
                                     "it; accepted: leave it out, or shape = \"block\"");
  t.require("diameter");
  t.require("length");
  s.diameter = t.quantity("diameter");
  s.length = t.quantity("length");
}

void read_magnet(MagneticSource& s, const Table& t) {
  t.require("remanence");
  s.remanence = t.quantity("remanence");
  s.shape = t.word("shape") == "block" ? MagnetShape::block : MagnetShape::cylinder;
  if (s.shape == MagnetShape::block)
    read_block(s, t);
  else
    read_cylinder(s, t);
}

void read_conductor(MagneticSource& s, const Table& t) {
  t.require("current");
  s.current = t.quantity("current") * t.number("turns");
  if (s.field == FieldKind::wire) return;
  t.require("diameter");
  s.diameter = t.quantity("diameter");
  const std::string pair = t.word("pair");
  s.pair = pair == "none" ? CoilPair::none : pair == "same" ? CoilPair::same : CoilPair::opposite;
  if (s.pair == CoilPair::none)
    t.refuse_if_given("distance", "needs pair = \"same\" or \"opposite\"; accepted: that, or leave "
                                  "it out");
  else
    t.require("distance");
  s.distance = t.optional_quantity("distance").value_or(0);
}

void read_table(MagneticSource& s, const Table& t, const std::string& case_path) {
  t.require("file");
  s.file = (std::filesystem::path(case_path).parent_path() / t.word("file")).string();
  if (!io::is_readable(s.file))
    t.fail("file", s.file + ": cannot be read; a readable CSV file of B on a grid is expected");
  try {
    s.table = std::make_shared<const lattice::FieldTable>(io::read_field_table(s.file));
  } catch (const Error& e) {
    t.fail_reading("file", e.what(), "a whole CSV file of B on a grid (docs/field_table.md)");
  }
}

/// The field of one table; none is no source.
void read_field(Case& c, const Table& t, const std::string& case_path) {
  const std::string field = t.word("field");
  refuse_others(t, field);
  if (field == "none") {
    for (const char* key : {"frequency", "time", "start", "duration"})
      t.refuse_if_given(key, "needs a field; accepted: leave it out");
    return;
  }
  MagneticSource s;
  s.key = t.full("");
  s.key.pop_back();  // the path of the table alone
  s.field = kind(field);
  s.B0 = t.quantity("B0");
  s.axis = *t.direction("axis");
  s.plane = t.word("plane");
  if (s.field == FieldKind::gradient || s.field == FieldKind::quadrupole) read_gradient(s, t, c);
  if (s.field == FieldKind::magnet || s.field == FieldKind::coil || s.field == FieldKind::wire)
    t.require("position");
  s.position = t.vector("position");
  if (s.field == FieldKind::magnet) read_magnet(s, t);
  if (s.field == FieldKind::coil || s.field == FieldKind::wire) read_conductor(s, t);
  if (s.field == FieldKind::table) read_table(s, t, case_path);
  read_time(s, t);
  c.magnetic.sources.push_back(s);
}

}  // namespace

void read_magnetic(Case& c, const Source& source) {
  const Table t = section(source, "magnetic");
  if (!source.root.contains("magnetic")) return;
  c.magnetic.dipoles = t.flag("dipoles");
  if (!t.has("source")) {
    read_field(c, t, source.path);
    return;
  }
  for (const Key& key : keys())
    if (key.table == std::string("magnetic") && key.name != std::string("dipoles") &&
        key.name != std::string("source"))
      t.refuse_if_given(key.name, "excludes [[magnetic.source]]; accepted: in an entry of it");
  for (const Table& entry : entries(source, &t.node("source"), "magnetic", "magnetic.source")) {
    for (const char* key : {"dipoles", "source"})
      entry.refuse_if_given(key, "belongs to [magnetic]; accepted: there");
    read_field(c, entry, source.path);
  }
}

bool point_at_table_copies(Source& source, const Case& c) {
  std::vector<std::string> copies;
  for (const MagneticSource& s : c.magnetic.sources)
    if (s.table) copies.push_back(table_copy(s));
  if (copies.empty()) return false;
  toml::table& all = *source.root["magnetic"].as_table();
  std::size_t next = 0;
  const auto point = [&](toml::table& t) {
    if (t.contains("file")) t.insert_or_assign("file", copies[next++]);
  };
  if (auto* list = all.get_as<toml::array>("source"))
    for (auto& entry : *list) point(*entry.as_table());
  else
    point(all);
  return true;
}

}  // namespace hemomag::case_
