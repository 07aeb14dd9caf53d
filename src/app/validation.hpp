#pragma once
#include <functional>
#include <string>
#include <vector>

// `hemomag validate`: comparisons with theory, each a list of findings.

namespace hemomag::app {

/// One number against what it should be.
struct Finding {
  std::string name;  ///< of the validation
  std::string quantity;
  double measured = 0;
  double expected = 0;
  double tolerance = 0;  ///< of |measured - expected|
  std::string unit;
  std::string source;  ///< of the expectation
  double error() const { return measured > expected ? measured - expected : expected - measured; }
  bool pass() const { return error() <= tolerance; }
};

struct Validation {
  std::string name;
  std::string about;
  std::function<std::vector<Finding>()> run;
};

/// All validations, in the order they run.
const std::vector<Validation>& validations();

/// Those of the fluid (validate_fluid.cpp) and of curved walls (validate_curved.cpp).
std::vector<Validation> fluid_validations();
std::vector<Validation> curved_validations();

/// Run the named ones (all if none) and print them, as a table or as one JSON object a line. Rank 0
/// works alone.
/// @return 0, 1 if one failed, 2 if a name is unknown
int validate(const std::vector<std::string>& names, bool json);

}  // namespace hemomag::app
