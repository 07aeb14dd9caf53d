#include "case/same_case.hpp"

#include <filesystem>
#include <map>
#include <sstream>

#include <toml++/toml.h>

#include "case/case_file.hpp"

namespace hemomag::case_ {
namespace {

/// Every value of a table by its path, as text. Entries of a list of tables are numbered as in
/// messages.
void flatten(const toml::node& node, const std::string& path,
             std::map<std::string, std::string>& values) {
  if (const auto* table = node.as_table()) {
    for (const auto& [name, value] : *table)
      flatten(value, (path.empty() ? "" : path + ".") + std::string(name.str()), values);
  } else if (const auto* list = node.as_array(); list && list->is_array_of_tables()) {
    for (std::size_t k = 0; k < list->size(); ++k)
      flatten(*list->get(k), entry_path(path.c_str(), k, list->size()), values);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    values[path] = text.str();
  }
}

std::map<std::string, std::string> values_of(const std::string& text) {
  std::map<std::string, std::string> values;
  flatten(toml::parse(text), "", values);
  return values;
}

bool may_change(const std::string& key) {
  return key == "title" || key == "analysis.average_from" || key.rfind("run.", 0) == 0 ||
         key.rfind("output.", 0) == 0;
}

}  // namespace

void require_same_case(const Case& c, const std::string& before) {
  const auto was = values_of(before), is = values_of(c.text);
  const auto refuse = [&](const std::string& key, const std::string& old) {
    throw CaseError(position(c, key) + ": the run was started with " + old +
                    "; accepted with --resume: the same, and changes of run, output and title");
  };
  for (const auto& [key, value] : is) {
    if (may_change(key)) continue;
    const auto old = was.find(key);
    if (old == was.end()) refuse(key, "none");
    if (old->second != value) refuse(key, old->second);
  }
  for (const auto& [key, value] : was)
    if (!may_change(key) && !is.contains(key)) refuse(key, value);
}

void require_room_for_output(const Case& c, const std::string& before, const std::string& out) {
  const auto was = values_of(before);
  const auto off = [&](const std::string& name) {
    const auto given = was.find("output." + name);
    return given != was.end() && given->second.find("never") != std::string::npos;
  };
  const auto check = [&](const char* name, bool on, bool was_off, const char* file) {
    const std::string path = out + "/" + file;
    if (on && was_off && std::filesystem::exists(path))
      throw CaseError(position(c, std::string("output.") + name) +
                      ": was \"never\" when the checkpoint was written, and " + path +
                      " of an earlier part of the run would be lost; accepted: \"never\", or that "
                      "file elsewhere");
  };
  const bool fields_off = off("fields");
  check("fields", c.output.fields.has_value(), fields_off, "fields");
  check("series", c.output.series.has_value(), off("series"), "margination.csv");
  check("cells", c.output.cells.has_value(),
        was.contains("output.cells") ? off("cells") : fields_off, "cells.csv");
  check("profiles", c.output.profiles.has_value(), off("profiles"), "profiles.csv");
}

}  // namespace hemomag::case_
