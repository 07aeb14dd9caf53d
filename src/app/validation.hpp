#pragma once
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
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
  /// A gate's miss fails the validation. A shortfall is a miss that is known and explained: shown
  /// as one against its tolerance, it fails nothing. A printed number has no tolerance.
  enum class Kind { gate, shortfall, printed } kind = Kind::gate;
  double error() const { return measured > expected ? measured - expected : expected - measured; }
  bool pass() const { return kind == Kind::printed || error() <= tolerance; }
  bool fails() const { return kind == Kind::gate && !pass(); }
};

/// A number to be read beside another.
inline Finding printed(std::string name, std::string quantity, double measured, double expected,
                       std::string unit, std::string source) {
  return {std::move(name),   std::move(quantity),   measured, expected, 0, std::move(unit),
          std::move(source), Finding::Kind::printed};
}

struct Validation {
  std::string name;
  std::string about;
  std::function<std::vector<Finding>(const std::string& out)> run;  ///< out: directory of figures

  /// @param f  takes the directory of figures, or nothing if it draws none
  template <class Run>
  Validation(std::string name_, std::string about_, Run f)
      : name(std::move(name_)), about(std::move(about_)) {
    if constexpr (std::is_invocable_v<Run, const std::string&>)
      run = std::move(f);
    else
      run = [f = std::move(f)](const std::string&) { return f(); };
  }
};

/// All validations, in the order they run.
const std::vector<Validation>& validations();

/// Those of the fluid (validate_fluid.cpp), of curved walls (validate_curved.cpp), of the membrane
/// without a fluid (validate_moduli.cpp, validate_stretch.cpp), of one cell in the fluid
/// (validate_cell.cpp, validate_shear.cpp), and of carriers: their motion in fluid
/// (validate_drift.cpp), the forces between them (validate_dipole.cpp) and chains of them
/// (validate_chain.cpp).
std::vector<Validation> fluid_validations();
std::vector<Validation> curved_validations();
std::vector<Validation> moduli_validations();
std::vector<Validation> stretch_validations();
std::vector<Validation> cell_validations();
std::vector<Validation> shear_validations();
std::vector<Validation> drift_validations();
std::vector<Validation> dipole_validations();
std::vector<Validation> chain_validations();
/// Of magnetic fields (validate_field.cpp).
std::vector<Validation> field_validations();
/// Of dense starting states (validate_packing.cpp).
std::vector<Validation> packing_validations();
/// Of the adhesion of two cells (validate_separation.cpp).
std::vector<Validation> separation_validations();
/// Of contact between carriers and cells (validate_no_leak.cpp).
std::vector<Validation> no_leak_validations();
/// Of sheared blood (validate_layer.cpp).
std::vector<Validation> layer_validations();

/// Run the named ones (all if none) and print them, as a table or as one JSON object a line. Rank 0
/// works alone.
/// @param out  directory of figures and their data, made when one is drawn
/// @return 0, 1 if one failed, 2 if a name is unknown
int validate(const std::vector<std::string>& names, bool json, const std::string& out);

}  // namespace hemomag::app
