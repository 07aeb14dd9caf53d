#include "app/validation.hpp"

#include <algorithm>
#include <cstdio>

#include <mpi.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace hemomag::app {
namespace {

const char* kind_name(Finding::Kind kind) {
  using enum Finding::Kind;
  return kind == gate ? "gate" : kind == shortfall ? "known shortfall" : "printed";
}

const char* verdict(const Finding& f) {
  if (f.kind == Finding::Kind::printed) return "printed";
  if (f.pass()) return "pass";
  return f.fails() ? "FAIL" : "MISS (known)";
}

void print(const Finding& f, bool json) {
  if (json) {
    const nlohmann::ordered_json line{{"name", f.name},         {"quantity", f.quantity},
                                      {"measured", f.measured}, {"expected", f.expected},
                                      {"error", f.error()},     {"tolerance", f.tolerance},
                                      {"unit", f.unit},         {"pass", f.pass()},
                                      {"source", f.source},     {"kind", kind_name(f.kind)}};
    std::printf("%s\n", line.dump().c_str());
  } else {
    char tolerance[16] = "-";
    if (f.kind != Finding::Kind::printed)
      std::snprintf(tolerance, sizeof tolerance, "%.1e", f.tolerance);
    std::printf("%-16s %-62s %12.6g %12.6g %9.1e %9s %-6s %s\n", f.name.c_str(), f.quantity.c_str(),
                f.measured, f.expected, f.error(), tolerance, f.unit.c_str(), verdict(f));
  }
  std::fflush(stdout);
}

}  // namespace

const std::vector<Validation>& validations() {
  static const std::vector<Validation> all = [] {
    auto list = fluid_validations();
    for (auto* more : {curved_validations, moduli_validations, stretch_validations,
                       cell_validations, shear_validations, packing_validations,
                       separation_validations, no_leak_validations, layer_validations,
                       drift_validations, dipole_validations, chain_validations, field_validations})
      for (auto& v : more()) list.push_back(std::move(v));
    return list;
  }();
  return all;
}

int validate(const std::vector<std::string>& names, bool json, const std::string& out) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  for (const std::string& name : names)
    if (std::none_of(validations().begin(), validations().end(),
                     [&](const Validation& v) { return v.name == name; })) {
      std::string known;
      for (const Validation& v : validations()) known += (known.empty() ? "" : ", ") + v.name;
      if (rank == 0)
        std::fprintf(stderr,
                     "hemomag validate: %s is not a validation of this version; accepted: %s\n",
                     name.c_str(), known.c_str());
      return 2;
    }
  int code = 0;
  if (rank == 0) {
    if (!json)
      std::printf("%-16s %-62s %12s %12s %9s %9s\n", "validation", "quantity", "measured",
                  "expected", "error", "tolerance");
    int passed = 0, failed = 0, missed = 0;
    for (const Validation& v : validations()) {
      if (!names.empty() && std::find(names.begin(), names.end(), v.name) == names.end()) continue;
      try {
        for (const Finding& f : v.run(out)) {
          print(f, json);
          ++(f.pass() ? passed : f.fails() ? failed : missed);
        }
      } catch (const Error& e) {
        std::fprintf(stderr, "hemomag validate %s: %s\n", v.name.c_str(), e.what());
        ++failed;
      }
    }
    if (!json && missed > 0)
      std::printf("%d passed, %d failed, %d known shortfalls\n", passed, failed, missed);
    if (!json && missed == 0) std::printf("%d passed, %d failed\n", passed, failed);
    code = failed > 0 ? 1 : 0;
  }
  MPI_Bcast(&code, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return code;
}

}  // namespace hemomag::app
