#include "case/read_magnetic.hpp"

#include <algorithm>

namespace hemomag::case_ {
namespace {

using Words = std::vector<std::string>;

/// Which fields a key belongs to; other keys belong to all.
struct Owner {
  const char* key;
  Words fields;
};

const std::vector<Owner>& owners() {
  static const std::vector<Owner> all = {{"B0", {"uniform", "gradient", "rotating"}},
                                         {"axis", {"uniform", "gradient"}},
                                         {"gradient", {"gradient", "quadrupole"}},
                                         {"zero_at", {"gradient", "quadrupole"}},
                                         {"plane", {"quadrupole", "rotating"}}};
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

/// The field of one table; none is no source.
void read_field(Case& c, const Table& t) {
  const std::string field = t.word("field");
  refuse_others(t, field);
  if (field == "none") {
    for (const char* key : {"frequency", "time", "start", "duration"})
      t.refuse_if_given(key, "needs a field; accepted: leave it out");
    return;
  }
  MagneticSource s;
  s.field = field == "uniform"      ? FieldKind::uniform
            : field == "gradient"   ? FieldKind::gradient
            : field == "quadrupole" ? FieldKind::quadrupole
                                    : FieldKind::rotating;
  s.B0 = t.quantity("B0");
  s.axis = t.word("axis")[0] - 'x';
  s.plane = t.word("plane");
  if (s.field == FieldKind::gradient || s.field == FieldKind::quadrupole) read_gradient(s, t, c);
  read_time(s, t);
  c.magnetic.sources.push_back(s);
}

}  // namespace

void read_magnetic(Case& c, const Source& source) {
  const Table t = section(source, "magnetic");
  if (!source.root.contains("magnetic")) return;
  c.magnetic.dipoles = t.flag("dipoles");
  if (!t.has("source")) {
    read_field(c, t);
    return;
  }
  for (const Key& key : keys())
    if (key.table == std::string("magnetic") && key.name != std::string("dipoles") &&
        key.name != std::string("source"))
      t.refuse_if_given(key.name, "excludes [[magnetic.source]]; accepted: in an entry of it");
  for (const Table& entry : entries(source, &t.node("source"), "magnetic", "magnetic.source")) {
    for (const char* key : {"dipoles", "source"})
      entry.refuse_if_given(key, "belongs to [magnetic]; accepted: there");
    read_field(c, entry);
  }
}

}  // namespace hemomag::case_
