#include "app/flow_runs.hpp"
#include "app/validation.hpp"

// Plane flows and decaying flows with exact solutions.

namespace hemomag::app {
namespace {

const char* const walls = "exact solution; half-way bounce-back with Lambda = 3/16";

/// Plates along each axis, the upper one moving, from rest to the steady state.
std::vector<Finding> couette() {
  const std::pair<const char*, Relaxation> schemes[] = {
      {"TRT, tau 0.7", {0.7, 3.0 / 16}},
      {"TRT, tau 1", {1.0, 3.0 / 16}},
      {"TRT, tau 1.5", {1.5, 3.0 / 16}},
      {"exponential, tau 0.5", Relaxation::exponential(0.5)}};
  std::vector<Finding> found;
  for (const int axis : {0, 1, 2})
    for (const auto& [name, relaxation] : schemes) {
      const auto a = static_cast<std::size_t>(axis), along = (a + 1) % 3;
      constexpr int H = 16;
      constexpr double U = 0.05;
      std::array<int, 3> n{4, 4, 4};
      n[a] = H;
      FluidParameters p;
      p.relaxation = relaxation;
      p.plate_axis = axis;
      p.plate_velocity[1][along] = U;
      const auto fluid = make_fluid(n, p);
      fluid->initialise(at_rest);
      run(*fluid, static_cast<int>(30 * H * H / (pi * pi * fluid->viscosity())));
      const double error = largest_error(*fluid, [&](const Vec3& x) {
        Vec3 u;
        u[along] = U * x[a] / H;
        return u;
      });
      found.push_back({"couette", std::string("error over U, plates ") + "xyz"[axis] + ", " + name,
                       error / U, 0, exact, "", walls});
    }
  // Single precision: a profile that is there at the start must stay.
  struct Kept {
    const char* what;
    Relaxation relaxation;
    solver::Precision precision;
    int H;
    double speed, tolerance;
  };
  const Kept kept[] = {{"exponential, tau 0.5, error over U", Relaxation::exponential(0.5),
                        solver::Precision::double_, 16, 0.05, exact},
                       {"TRT in single, H 96, error over U = 5e-4",
                        {1.0, 3.0 / 16},
                        solver::Precision::single_,
                        96,
                        5e-4,
                        1e-5},
                       {"exponential in single, H 96, U = 5e-4", Relaxation::exponential(0.5),
                        solver::Precision::single_, 96, 5e-4, 1e-5}};
  for (const Kept& k : kept) {
    FluidParameters p;
    p.relaxation = k.relaxation;
    p.precision = k.precision;
    p.plate_axis = 2;
    p.plate_velocity[1] = {0, k.speed, 0};
    const auto fluid = make_fluid({16, 4, k.H}, p);
    const auto profile = [&](const Vec3& x) { return Vec3{0, k.speed * x.z / k.H, 0}; };
    fluid->initialise([&](const Vec3& x) {
      Flow flow;
      flow.first = profile(x);
      flow.second[2] = {0, k.speed / k.H, 0};
      return flow;
    });
    run(*fluid, 20000);
    found.push_back({"couette", k.what, largest_error(*fluid, profile) / k.speed, 0, k.tolerance,
                     "", "exact solution, kept for 20,000 steps"});
  }
  return found;
}

/// Error of the start of Couette flow at nu t/H^2 = 0.1, over U.
double startup_error(const Relaxation& relaxation, int H) {
  constexpr double U = 0.01;
  FluidParameters p;
  p.relaxation = relaxation;
  p.plate_axis = 2;
  p.plate_velocity[1] = {0, U, 0};
  const auto owner = make_fluid({4, 4, H}, p);
  FluidSolver& fluid = *owner;
  fluid.initialise(at_rest);
  const int steps = static_cast<int>(0.1 * H * H / fluid.viscosity());
  run(fluid, steps);
  const double t = (steps - 1) * fluid.viscosity() / (static_cast<double>(H) * H);
  return largest_error(fluid,
                       [&](const Vec3& x) {
                         double u = x.z / H;
                         for (int n = 1; n < 60; ++n)
                           u += 2 / (n * pi) * (n % 2 ? -1 : 1) * std::sin(n * pi * x.z / H) *
                                std::exp(-n * n * pi * pi * t);
                         return Vec3{0, U * u, 0};
                       }) /
         U;
}

std::vector<Finding> couette_startup() {
  const char* source = "series of the start of plane Couette flow";
  std::vector<Finding> found;
  const std::pair<const char*, Relaxation> schemes[] = {
      {"TRT", {1.0, 3.0 / 16}}, {"exponential", Relaxation::exponential(0.5)}};
  for (const auto& [name, relaxation] : schemes) {
    double error[3];
    for (int k = 0; k < 3; ++k) error[k] = startup_error(relaxation, 16 << k);
    const std::string scheme = name;
    found.push_back(
        {"couette-startup", scheme + ", error over U, H = 64", error[2], 0, 1e-3, "", source});
    found.push_back({"couette-startup", scheme + ", order of convergence, H = 16, 32",
                     std::log2(error[0] / error[1]), 2, 0.2, "", source});
    found.push_back({"couette-startup", scheme + ", order of convergence, H = 32, 64",
                     std::log2(error[1] / error[2]), 2, 0.2, "", source});
  }
  return found;
}

/// Error over the peak of a flow that a body force drives between plates.
double poiseuille_error(const Relaxation& relaxation, int H) {
  constexpr double peak = 0.02;
  FluidParameters p;
  p.relaxation = relaxation;
  p.plate_axis = 2;
  const double nu = relaxation.viscosity(), g = 8 * nu * peak / (H * H);
  p.relaxation.force[1] = g;
  const auto fluid = make_fluid({4, 4, H}, p);
  fluid->initialise(at_rest);
  run(*fluid, static_cast<int>(30 * H * H / (pi * pi * nu)) + 200);
  return largest_error(*fluid,
                       [&](const Vec3& x) {
                         return Vec3{0, g * x.z * (H - x.z) / (2 * nu), 0};
                       }) /
         peak;
}

std::vector<Finding> poiseuille() {
  std::vector<Finding> found;
  for (const double tau : {0.55, 1.0, 2.0, 5.0})
    found.push_back({"poiseuille", with("TRT, error over peak", "tau", tau),
                     poiseuille_error({tau, 3.0 / 16}, 12), 0, exact, "", walls});
  // Other schemes slip at half-way walls, by an amount that falls with the square of the spacing.
  const std::pair<std::string, Relaxation> others[] = {
      {"BGK, tau 1", Relaxation::bgk(1.0)}, {"exponential, tau 0.5", Relaxation::exponential(0.5)}};
  for (const auto& [name, relaxation] : others) {
    double error[3];
    for (int k = 0; k < 3; ++k) error[k] = poiseuille_error(relaxation, 12 << k);
    for (int k = 0; k < 2; ++k)
      found.push_back({"poiseuille", with((name + ", order of convergence").c_str(), "H", 12 << k),
                       std::log2(error[k] / error[k + 1]), 2, 0.1, "", "second-order walls"});
  }
  return found;
}

/// Viscosity over (tau - 1/2)/3 from the decay of a transverse wave of length L, carried along by a
/// flow U.
double shear_wave_viscosity(const Relaxation& relaxation, int L, double U) {
  const double k = 2 * pi / L;
  FluidParameters p;
  p.relaxation = relaxation;
  const auto owner = make_fluid({L, 4, 4}, p);
  FluidSolver& fluid = *owner;
  fluid.initialise([&](const Vec3& x) {
    Flow flow;
    flow.first = {U, 1e-4 * std::sin(k * x.x), 0};
    flow.second[0] = {0, 1e-4 * k * std::cos(k * x.x), 0};
    return flow;
  });
  const auto amplitude = [&] {
    double s = 0, c = 0;
    const auto u = velocity(fluid);
    for (int x = 0; x < L; ++x) {
      s += u[static_cast<std::size_t>(x)].y * std::sin(k * (x + 0.5));
      c += u[static_cast<std::size_t>(x)].y * std::cos(k * (x + 0.5));
    }
    return std::hypot(s, c);
  };
  const int t = std::max(20, static_cast<int>(1 / (fluid.viscosity() * k * k)));
  run(fluid, t);
  const double early = amplitude();
  run(fluid, t);
  return std::log(early / amplitude()) / (k * k * t) / fluid.viscosity();
}

std::vector<Finding> shear_wave() {
  // An independent program's values of the discrete scheme: viscosity over (tau - 1/2)/3 at L = 16,
  // 32, 64, 128.
  struct Row {
    const char* scheme;
    Relaxation relaxation;
    double value[4];
  };
  const Row rows[] = {
      {"TRT", {0.55, 3.0 / 16}, {0.99371, 0.99843, 0.99961, 0.99990}},
      {"TRT", {0.60, 3.0 / 16}, {0.99409, 0.99852, 0.99963, 0.99991}},
      {"TRT", {1.00, 3.0 / 16}, {1.00657, 1.00162, 1.00040, 1.00010}},
      {"TRT", {1.50, 3.0 / 16}, {1.05013, 1.01154, 1.00283, 1.00070}},
      {"TRT", {2.00, 3.0 / 16}, {1.14472, 1.02899, 1.00693, 1.00171}},
      {"BGK", Relaxation::bgk(0.55), {1.01279, 1.00318, 1.00080, 1.00020}},
      {"BGK", Relaxation::bgk(1.00), {0.99996, 1.00000, 1.00000, 1.00000}},
      {"BGK", Relaxation::bgk(1.50), {0.95732, 0.99009, 0.99757, 0.99940}},
      {"BGK", Relaxation::bgk(2.00), {0.87748, 0.97281, 0.99348, 0.99839}},
      {"exponential", Relaxation::exponential(0.1), {0.8235, 0.9505, 0.9873, 0.9968}},
      {"exponential", Relaxation::exponential(0.3), {0.9532, 0.9883, 0.9971, 0.9993}},
      {"exponential", Relaxation::exponential(0.5), {0.9663, 0.9917, 0.9979, 0.9995}},
      {"exponential", Relaxation::exponential(1.0), {0.9350, 0.9846, 0.9962, 0.9991}},
      {"exponential", Relaxation::exponential(2.0), {0.7475, 0.9428, 0.9866, 0.9967}}};
  std::vector<Finding> found;
  for (const Row& row : rows)
    for (int k = 0; k < 4; ++k) {
      const int L = 16 << k;
      found.push_back({"shear-wave",
                       with(with(row.scheme, "tau", row.relaxation.tau).c_str(), "L", L),
                       shear_wave_viscosity(row.relaxation, L, 0), row.value[k], 1e-4, "",
                       "table of the discrete scheme"});
    }
  const double at32 = shear_wave_viscosity({1.0, 3.0 / 16}, 32, 0),
               at64 = shear_wave_viscosity({1.0, 3.0 / 16}, 64, 0);
  found.push_back({"shear-wave", "order of convergence, TRT, tau 1",
                   std::log2((at32 - 1) / (at64 - 1)), 2, 0.1, "", "second-order scheme"});
  return found;
}

/// Viscosity over (tau - 1/2)/3 from the decay of a Taylor-Green vortex.
double taylor_green_viscosity(const Relaxation& relaxation, int L) {
  const double k = 2 * pi / L,
               speed = 0.16 / L;  // diffusive scaling: the Mach number falls with the spacing
  FluidParameters p;
  p.relaxation = relaxation;
  const auto owner = make_fluid({L, L, 4}, p);
  FluidSolver& fluid = *owner;
  fluid.initialise([&](const Vec3& x) {
    const double sx = std::sin(k * x.x), cx = std::cos(k * x.x), sy = std::sin(k * x.y),
                 cy = std::cos(k * x.y);
    Flow flow;
    flow.first = {speed * sx * cy, -speed * cx * sy, 0};
    flow.second[0] = {speed * k * cx * cy, speed * k * sx * sy, 0};
    flow.second[1] = {-speed * k * sx * sy, -speed * k * cx * cy, 0};
    return flow;
  });
  const auto amplitude = [&] {
    double a = 0;
    const auto u = velocity(fluid);
    for (int y = 0; y < L; ++y)
      for (int x = 0; x < L; ++x) {
        const int node = y * L + x;
        a +=
            u[static_cast<std::size_t>(node)].x * std::sin(k * (x + 0.5)) * std::cos(k * (y + 0.5));
      }
    return a;
  };
  const int t = static_cast<int>(0.5 / (fluid.viscosity() * k * k));
  run(fluid, t);
  const double early = amplitude();
  run(fluid, t);
  return std::log(early / amplitude()) / (2 * k * k * t) / fluid.viscosity();
}

std::vector<Finding> taylor_green() {
  const Relaxation trt{1.0, 3.0 / 16};
  const double coarse = taylor_green_viscosity(trt, 32), middle = taylor_green_viscosity(trt, 64),
               fine = taylor_green_viscosity(trt, 128);
  const char* source = "exp(-2 nu k^2 t)";
  // The scheme's own error is 0.4 % at L = 32 (waves along the diagonal) and falls fourfold a
  // refinement.
  return {{"taylor-green", "viscosity over nu, L = 32", coarse, 1, 5e-3, "", source},
          {"taylor-green", "viscosity over nu, L = 128", fine, 1, 3e-4, "", source},
          {"taylor-green", "order of convergence, L = 32, 64",
           std::log2((coarse - 1) / (middle - 1)), 2, 0.1, "", source},
          {"taylor-green", "order of convergence, L = 64, 128",
           std::log2((middle - 1) / (fine - 1)), 2, 0.1, "", source}};
}

/// Mass over many steps of a driven, sheared flow.
std::vector<Finding> mass() {
  std::vector<Finding> found;
  const std::pair<const char*, Relaxation> schemes[] = {
      {"TRT", {1.0, 3.0 / 16}}, {"exponential", Relaxation::exponential(0.5)}};
  for (const auto& [name, relaxation] : schemes) {
    FluidParameters p;
    p.relaxation = relaxation;
    p.plate_axis = 2;
    p.plate_velocity[1] = {0.02, 0.05, 0};
    p.relaxation.force[0] = 1e-5;
    const auto fluid = make_fluid({12, 12, 12}, p);
    fluid->initialise([](const Vec3& x) {
      Flow flow;
      flow.first = {0.02 * std::sin(2 * pi * x.y / 12), 0.02 * std::cos(2 * pi * x.x / 12), 0};
      return flow;
    });
    const double before = fluid->excess_mass();
    run(*fluid, 10000);
    found.push_back({"mass", std::string(name) + ", drift a node over 10,000 steps",
                     (fluid->excess_mass() - before) / (12 * 12 * 12), 0, 1e-12, "",
                     "conservation"});
  }
  return found;
}

std::vector<Finding> galilean() {
  const double still = shear_wave_viscosity({1.0, 3.0 / 16}, 64, 0);
  std::vector<Finding> found;
  for (const double U : {0.02, 0.05, 0.1})
    found.push_back({"galilean", with("viscosity change in a flow", "U", U),
                     shear_wave_viscosity({1.0, 3.0 / 16}, 64, U) / still - 1, -3 * U * U,
                     0.2 * 3 * U * U, "", "cubic defect of the D3Q19 equilibrium, -3 U^2"});
  return found;
}

}  // namespace

std::vector<Validation> fluid_validations() {
  return {{"couette", "plates along every axis, steady", couette},
          {"couette-startup", "plates from rest against the series", couette_startup},
          {"poiseuille", "body force between plates, four relaxation times", poiseuille},
          {"shear-wave", "viscosity of a decaying wave", shear_wave},
          {"taylor-green", "decay of a vortex", taylor_green},
          {"mass", "conservation", mass},
          {"galilean", "viscosity in a moving frame", galilean}};
}

}  // namespace hemomag::app
