#pragma once
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace hemomag::case_ {

/// What a quantity measures; `unit` is the SI unit it is converted to.
struct Dimension {
  const char* noun;     ///< "a length"
  const char* unit;     ///< UDUNITS-2 spelling of the SI unit
  const char* example;  ///< "27 um"
};

namespace dimension {
inline constexpr Dimension length{"a length", "m", "27 um"};
inline constexpr Dimension time{"a time", "s", "0.5 s"};
inline constexpr Dimension velocity{"a velocity", "m/s", "1 mm/s"};
inline constexpr Dimension rate{"a rate", "s-1", "200 s-1"};
inline constexpr Dimension viscosity{"a viscosity", "Pa.s", "1.2 mPa.s"};
inline constexpr Dimension density{"a density", "kg/m3", "1000 kg/m3"};
inline constexpr Dimension tension{"a tension", "N/m", "6.3 uN/m"};
inline constexpr Dimension pressure{"a pressure", "N/m2", "249 N/m2"};
inline constexpr Dimension energy{"an energy", "J", "5e-19 J"};
inline constexpr Dimension field{"a magnetic field", "T", "0.05 T"};
inline constexpr Dimension field_gradient{"a field gradient", "T/m", "4000 T/m"};
inline constexpr Dimension current{"a current", "A", "2 A"};
inline constexpr Dimension magnetisation{"a magnetisation", "A/m", "446 kA/m"};
inline constexpr Dimension frequency{"a frequency", "Hz", "10 Hz"};
inline constexpr Dimension force_density{"a force density", "N/m3", "2e4 N/m3"};
inline constexpr Dimension per_length{"an inverse length", "m-1", "3.84 um-1"};
}  // namespace dimension

/// "27 um" -> 2.7e-5. The number is read by std::from_chars, the unit alone by UDUNITS-2.
/// @throws Error saying what is wrong, without position
double quantity(std::string_view text, const Dimension& dimension);

}  // namespace hemomag::case_
