#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "case/units.hpp"

// The one table of the case file: every key with its kind, range, default and meaning. The reader
// checks by it, and docs/case_file.md is compared with it by a test.

namespace hemomag::case_ {

enum class Kind { text, integer, number, flag, choice, quantity, vector, direction, tables };

struct Key {
  const char* table;  ///< "" for the top level
  const char* name;
  Kind kind;
  const Dimension* dimension;  ///< of a quantity or vector
  double min, max;             ///< in SI; exclusive at min when above_min
  bool above_min;
  const char* fallback;  ///< as written in a file; "" none, "required" for required keys
  std::vector<const char*> choices;  ///< accepted words
  std::vector<const char*> later;    ///< words that belong to a later version
  const char* help;
};

std::span<const Key> keys();

/// The key, or nullptr.
const Key* find_key(const std::string& table, const std::string& name);

/// The known name nearest to a misspelt one in a table (top-level tables for table ""), or "".
std::string nearest_name(const std::string& table, const std::string& name);

/// What is accepted, in words.
std::string accepted(const Key& key);

}  // namespace hemomag::case_
