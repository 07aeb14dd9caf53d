#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "base/vec3.hpp"
#include "case/keys.hpp"

namespace hemomag::case_ {

/// A parsed file, its name, and which keys came from --set.
struct Source {
  std::string path;
  toml::table root;
  std::map<const toml::node*, std::string> overridden;

  /// FILE:LINE:COL of a node.
  std::string place(const toml::node& node) const;
  /// @throws CaseError "FILE:LINE:COL: key: problem", or "--set key: problem", with
  /// the key at fault if it is another one
  [[noreturn]] void fail(const toml::node& node, const std::string& key,
                         const std::string& problem) const;
};

/// What a node is, in words: "a list".
const char* type_name(const toml::node& node);

/// One table of the file, read key by key and checked against the table of keys (keys.hpp); what
/// that does not know is refused when it is opened. Every refusal is a CaseError with its place.
class Table {
public:
  Table(const Source& source, const toml::table* table, std::string schema, std::string path);

  bool has(const char* name) const { return table_ && table_->contains(name); }
  const toml::node& node(const char* name) const { return *table_->get(name); }

  /// The value as it is written in the file or, absent, as its default is written in the table of
  /// keys.
  std::string word(const char* name) const;
  bool flag(const char* name) const;
  double number(const char* name) const;
  double quantity(const char* name) const;
  std::optional<double> optional_quantity(const char* name) const;
  std::array<double, 3> vector(const char* name) const;
  /// A vector of length one; empty without the key and a default.
  std::optional<Vec3> direction(const char* name) const;

  /// True when the key holds this one of its words, e.g. "never".
  bool is_word(const char* name, const char* word) const;
  /// A key that means nothing beside what other keys say.
  void refuse_if_given(const char* name, const std::string& problem) const;

  [[noreturn]] void fail(const char* name, const std::string& problem) const;
  /// Report a file that could not be used; `wanted` is what is accepted, where its reader does not
  /// say.
  [[noreturn]] void fail_reading(const char* name, const std::string& reason,
                                 const char* wanted) const;
  /// Report a key that is missing, at the header of its table (1:1 when there is none).
  [[noreturn]] void missing(const char* name, const std::string& problem) const;
  void require(const char* name) const;
  std::string full(const char* name) const { return path_.empty() ? name : path_ + "." + name; }

private:
  void refuse_unknown() const;
  [[noreturn]] void wrong_type(const char* name, const Key& key) const;
  double read(const char* name, const Key& key, const toml::node& n) const;
  double in_range(const char* name, const Key& key, double value) const;

  const Source& source_;
  const toml::table* table_;
  std::string schema_, path_;
};

/// The table [name].
Table section(const Source& source, const char* name);

/// The entries of [[path]], which `node` holds, checked as the table `schema`; none without it.
std::vector<Table> entries(const Source& source, const toml::node* node, const char* schema,
                           const char* path);

}  // namespace hemomag::case_
