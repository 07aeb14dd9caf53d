#include "case/overrides.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "case/case_file.hpp"

namespace hemomag::case_ {
namespace {

/// The table a --set path leads to, made if the schema has it.
toml::table& descend(Source& source, const std::vector<std::string>& parts,
                     const std::string& key) {
  toml::node* at = &source.root;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    if (auto* list = at->as_array()) {
      const bool number =
          !parts[k].empty() && parts[k].find_first_not_of("0123456789") == std::string::npos;
      const std::size_t index = number ? std::stoul(parts[k].substr(0, 9)) : 0;
      if (index >= list->size() || (!number && list->size() != 1))
        throw CaseError("--set " + key + ": there are " + std::to_string(list->size()) +
                        " entries; accepted: the number of one, from 0");
      at = list->get(index);
      if (number) continue;
    }
    auto* table = at->as_table();
    if (!table) throw CaseError("--set " + key + ": is not a key; accepted: table.key");
    const bool made = table->insert(parts[k], toml::table{}).second;  // keeps what is there
    at = table->get(parts[k]);
    if (made) source.overridden[at] = key;
  }
  if (auto* list = at->as_array()) {
    if (list->size() != 1)
      throw CaseError("--set " + key + ": there are " + std::to_string(list->size()) +
                      " entries; accepted: the number of one, from 0");
    at = list->get(0);
  }
  if (!at->is_table()) throw CaseError("--set " + key + ": is not a key; accepted: table.key");
  return *at->as_table();
}

}  // namespace

void apply_override(Source& source, const std::string& override_text) {
  const auto control = [](unsigned char c) { return std::iscntrl(c) != 0 && c != '\t'; };
  const auto odd = std::find_if(override_text.begin(), override_text.end(), control);
  if (odd != override_text.end())
    throw CaseError("--set " + std::string(override_text.begin(), odd) +
                    ": has a line break or another control character; accepted: key.path=value, "
                    "one for each --set");
  const auto equals = override_text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw CaseError("--set " + override_text + ": has no value; accepted: key.path=value");
  const std::string key = override_text.substr(0, equals), value = override_text.substr(equals + 1);
  std::vector<std::string> parts;
  std::stringstream path(key);
  for (std::string part; std::getline(path, part, '.');) parts.push_back(part);
  if (key.back() == '.') throw CaseError("--set " + key + ": is not a key; accepted: table.key");
  toml::table& table = descend(source, parts, key);
  // A TOML value, or else a plain string: --set magnetic.B0=0.05 T
  try {
    toml::table parsed = toml::parse("v = " + value);
    parsed.get("v")->visit([&](auto& v) { table.insert_or_assign(parts.back(), v); });
  } catch (const toml::parse_error&) {
    table.insert_or_assign(parts.back(), value);
  }
  source.overridden[table.get(parts.back())] = key;
}

}  // namespace hemomag::case_
