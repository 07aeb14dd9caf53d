#pragma once
#include <string>

#include "case/case.hpp"

namespace hemomag::case_ {

/// Where the cells run alone, in the directory of the run, and what they leave there.
inline constexpr const char* layer_directory = "layer";
inline constexpr const char* layer_summary = "layer/summary.json";

/// The case of layer = "measured" without its carriers and field, for analysis.layer_run, whose
/// second half is averaged. It has no measured layer itself, and its text reads as it is.
Case cells_alone(const Case& c);

/// The cell-free layer that such a run measured [m]. @throws Error when the file has none
double layer_of(const std::string& summary_path);

}  // namespace hemomag::case_
