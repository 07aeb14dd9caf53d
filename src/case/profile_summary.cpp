#include "case/profile_summary.hpp"

#include <array>

#include <nlohmann/json.hpp>

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_profiles.h"

namespace hemomag::case_ {
namespace {

using Profiles = LAMMPS_NS::FixHemoProfiles;

nlohmann::json by_plate(const std::array<Profiles::Mean, 2>& values) {
  return {{"lower", values[0].mean},
          {"lower_sd", values[0].deviation},
          {"upper", values[1].mean},
          {"upper_sd", values[1].deviation}};
}

}  // namespace

void add_profiles(nlohmann::json& summary, const Case& c, lammps::Host& host) {
  auto& entry = summary["profiles"] = nullptr;
  const auto* profiles = lammps::find_fix<Profiles>(&host.lammps(), "hemo/profiles");
  if (!profiles) return;
  const auto r = profiles->results();
  if (r.samples == 0) return;
  entry = {{"samples", r.samples},          {"hematocrit", r.hematocrit},
           {"drag_pa", by_plate(r.drag)},   {"velocity_mm_per_s", r.velocity.mean},
           {"relative_viscosity", nullptr}, {"apparent_viscosity_pa_s", nullptr}};
  if (r.relative_viscosity) {
    entry["relative_viscosity"] = *r.relative_viscosity;
    entry["apparent_viscosity_pa_s"] = *r.relative_viscosity * c.fluid.viscosity;
  }
  if (c.cells.empty()) return;
  entry["layer_um"] = c.analysis.walls == LayerWalls::both
                          ? 0.5 * (r.layer[0].mean + r.layer[1].mean)
                          : r.layer[0].mean;
  entry["layer"] = by_plate(r.layer);
  entry["layer_seen"] = by_plate(r.seen);
  entry["layer_half_core"] = {{"lower", r.half_core[0]}, {"upper", r.half_core[1]}};
}

}  // namespace hemomag::case_
