#include "case/same_case.hpp"

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
  return key == "title" || key.rfind("run.", 0) == 0 || key.rfind("output.", 0) == 0;
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

}  // namespace hemomag::case_
