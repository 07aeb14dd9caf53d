#include "case/toml_table.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "case/case_file.hpp"

namespace hemomag::case_ {

std::string Source::place(const toml::node& node) const {
  const auto at = node.source().begin;
  return path + ":" + std::to_string(at.line == 0 ? 1 : at.line) + ":" +
         std::to_string(at.column == 0 ? 1 : at.column);
}

void Source::fail(const toml::node& node, const std::string& key,
                  const std::string& problem) const {
  const auto set = overridden.find(&node);
  if (set != overridden.end())
    throw CaseError("--set " + set->second + ": " + (key == set->second ? "" : key + ": ") +
                    problem);
  throw CaseError(place(node) + ": " + key + ": " + problem);
}

namespace {

/// toml++ has no double of a whole number beyond 2^53.
double as_double(const toml::node& number) {
  const auto whole = number.value_exact<std::int64_t>();
  return whole ? static_cast<double>(*whole) : *number.value<double>();
}

}  // namespace

const char* type_name(const toml::node& node) {
  switch (node.type()) {
  case toml::node_type::string:
    return "a string";
  case toml::node_type::integer:
    return "a whole number";
  case toml::node_type::floating_point:
    return "a number";
  case toml::node_type::boolean:
    return "true or false";
  case toml::node_type::array:
    return "a list";
  case toml::node_type::table:
    return "a table";
  default:
    return "a date or time";
  }
}

Table::Table(const Source& source, const toml::table* table, std::string schema, std::string path)
    : source_(source), table_(table), schema_(std::move(schema)), path_(std::move(path)) {
  if (table_) refuse_unknown();
}

std::string Table::word(const char* name) const {
  const Key& key = *find_key(schema_, name);
  if (!has(name)) return key.fallback;
  const auto text = node(name).value<std::string>();
  if (!text) wrong_type(name, key);
  std::string word = *text;
  if (key.kind == Kind::text) return word;
  for (const char* choice : key.choices)
    if (word == choice) return word;
  for (const char* choice : key.later)
    if (word == choice)
      fail(name, "\"" + word + "\" is not available in this version; accepted: " + accepted(key));
  fail(name, "\"" + word + "\" is unknown; accepted: " + accepted(key));
}

bool Table::flag(const char* name) const {
  const Key& key = *find_key(schema_, name);
  if (!has(name)) return std::string(key.fallback) == "true";
  const auto value = node(name).value_exact<bool>();
  if (!value) wrong_type(name, key);
  return *value;
}

double Table::number(const char* name) const {
  const Key& key = *find_key(schema_, name);
  if (!has(name)) return std::stod(key.fallback);
  const auto& n = node(name);
  if (!n.is_number() || (key.kind == Kind::integer && !n.is_integer())) wrong_type(name, key);
  return in_range(name, key, as_double(n));
}

double Table::quantity(const char* name) const {
  const Key& key = *find_key(schema_, name);
  if (!has(name)) return case_::quantity(key.fallback, *key.dimension);
  return in_range(name, key, read(name, key, node(name)));
}

std::optional<double> Table::optional_quantity(const char* name) const {
  if (!has(name) && *find_key(schema_, name)->fallback == '\0') return std::nullopt;
  return quantity(name);
}

std::array<double, 3> Table::vector(const char* name) const {
  const Key& key = *find_key(schema_, name);
  std::array<double, 3> v{};
  if (!has(name)) return v;
  const auto* list = node(name).as_array();
  if (!list || list->size() != 3) wrong_type(name, key);
  for (std::size_t d = 0; d < 3; ++d) v[d] = in_range(name, key, read(name, key, *list->get(d)));
  return v;
}

std::optional<Vec3> Table::direction(const char* name) const {
  const Key& key = *find_key(schema_, name);
  Vec3 v;
  const std::string word = has(name) ? node(name).value_or(std::string()) : key.fallback;
  if (!has(name) && word.empty()) return std::nullopt;
  if (word == "x" || word == "y" || word == "z") {
    v[static_cast<std::size_t>(word[0] - 'x')] = 1;
    return v;
  }
  const auto* list = node(name).as_array();
  if (!list || list->size() != 3) wrong_type(name, key);
  for (std::size_t d = 0; d < 3; ++d) {
    if (!list->get(d)->is_number()) wrong_type(name, key);
    v[d] = as_double(*list->get(d));
  }
  if (!(norm(v) > 0) || !std::isfinite(norm(v)))
    fail(name, "has no direction; accepted: " + accepted(key));
  return v / norm(v);
}

bool Table::is_word(const char* name, const char* word) const {
  return has(name) && node(name).value<std::string>() == std::optional<std::string>(word);
}

void Table::refuse_if_given(const char* name, const std::string& problem) const {
  if (has(name)) fail(name, problem);
}

void Table::fail(const char* name, const std::string& problem) const {
  if (!has(name)) missing(name, problem);  // it is the default that does not go with the rest
  source_.fail(node(name), full(name), problem);
}

void Table::fail_reading(const char* name, const std::string& reason, const char* wanted) const {
  const bool complete = reason.find("accepted") != std::string::npos;
  fail(name, complete ? reason : reason + "; accepted: " + wanted);
}

void Table::missing(const char* name, const std::string& problem) const {
  if (table_) source_.fail(*table_, full(name), problem);
  throw CaseError(source_.path + ":1:1: " + full(name) + ": " + problem);
}

void Table::require(const char* name) const {
  if (!has(name))
    missing(name, "is missing; " + accepted(*find_key(schema_, name)) + " is required");
}

void Table::refuse_unknown() const {
  for (const auto& [name, value] : *table_) {
    const std::string text(name.str());
    if (find_key(schema_, text)) continue;
    if (schema_.empty() && !nearest_name("", text).empty() && nearest_name("", text) == text)
      continue;  // a table
    const std::string near = nearest_name(schema_, text);
    std::string known;
    for (const Key& key : keys())
      if (schema_ == key.table) known += (known.empty() ? "" : ", ") + std::string(key.name);
    source_.fail(value, full(text.empty() ? "\"\"" : text.c_str()),
                 "is not a key" + (near.empty()
                                       ? "; accepted: " + known
                                       : "; did you mean " + near + "? accepted: " + known));
  }
}

void Table::wrong_type(const char* name, const Key& key) const {
  fail(name, std::string(type_name(node(name))) +
                 " is not what is meant here; accepted: " + accepted(key));
}

double Table::read(const char* name, const Key& key, const toml::node& n) const {
  const auto text = n.value<std::string>();
  if (!text)
    source_.fail(n, full(name),
                 std::string(type_name(n)) + " without a unit; accepted: " + accepted(key) +
                     " as a string");
  try {
    return case_::quantity(*text, *key.dimension);
  } catch (const Error& e) {
    source_.fail(source_.overridden.contains(&node(name)) ? node(name) : n, full(name), e.what());
  }
}

double Table::in_range(const char* name, const Key& key, double value) const {
  const bool low = key.above_min ? value > key.min : value >= key.min;
  if (!std::isfinite(value) || !low || value > key.max)
    fail(name, "is out of range; accepted: " + accepted(key));
  return value;
}

Table section(const Source& source, const char* name) {
  const toml::node* node = source.root.get(name);
  if (node && !node->is_table())
    source.fail(*node, name,
                std::string("is ") + type_name(*node) + "; a [" + name + "] table is expected");
  return Table(source, node ? node->as_table() : nullptr, name, name);
}

std::vector<Table> entries(const Source& source, const toml::node* node, const char* schema,
                           const char* path) {
  std::vector<Table> tables;
  if (!node) return tables;
  const auto* list = node->as_array();
  if (!list)
    source.fail(*node, path,
                std::string("is ") + type_name(*node) + "; [[" + path + "]] entries are expected");
  for (std::size_t k = 0; k < list->size(); ++k) {
    if (!list->get(k)->is_table())
      source.fail(*list->get(k), path, std::string("[[") + path + "]] entries are expected");
    tables.emplace_back(source, list->get(k)->as_table(), schema,
                        entry_path(path, k, list->size()));
  }
  return tables;
}

std::string entry_path(const char* name, std::size_t k, std::size_t count) {
  return count == 1 ? name : std::string(name) + "." + std::to_string(k);
}

}  // namespace hemomag::case_
