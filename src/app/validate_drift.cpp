#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/carrier_run.hpp"
#include "app/validation.hpp"
#include "ibm/delta_kernel.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"

// One carrier pulled through fluid (the paper's Fig. 7) and let go.

namespace hemomag::app {
namespace {

using std::numbers::pi;

// ---- drift

constexpr double each_tolerance = 0.01;   // relative, of the issue: every radius and place
constexpr double mean_tolerance = 0.005;  // of the mean over places
constexpr double pull = 1e-7;  // so weak that a carrier stays where it is and inertia is nothing
constexpr std::array<double, 6> radii_nm{10, 20, 40, 60, 80, 125};

/// Hasimoto (J. Fluid Mech. 5:317, 1959): mobility of a sphere in a periodic cube at rest on the
/// whole, over Stokes'.
double hasimoto(double a, double L) {
  return 1 - 2.837297 * a / L + 4 * pi / 3 * std::pow(a / L, 3);
}

/// One carrier in one box, whose place and radius can be changed.
class Pulled {
public:
  Pulled(CarrierRun::Setup setup, int axis, double viscosity)
      : axis_(static_cast<std::size_t>(axis)), viscosity_(viscosity), radii_(setup.radii),
        run_([&] {
          Vec3 F;
          F[axis_] = pull;
          setup.forces = {format("fix pull all addforce %.17g %.17g %.17g", F.x, F.y, F.z)};
          return setup;
        }()) {}

  /// Let the flow around the carrier at x become steady.
  void settle(const Vec3& x, int block) {
    run_.place(0, x);
    run_.command("set type * type 1");
    constexpr double steady = 2e-5;  // relative change over a block
    double now = speed(block), before = 0;
    for (int k = 0; k < 200 && std::fabs(now - before) > steady * std::fabs(now); ++k) {
      before = now;
      now = speed(block);
    }
  }

  /// Velocity over Stokes' of a carrier of the k-th radius here. The fluid feels the pull alone, so
  /// that its flow is the same for every radius.
  double over_stokes(std::size_t k) {
    run_.command(format("set type * type %zu", k + 1));
    const double u = speed(2);
    run_.command("set type * type 1");
    return u * 6 * pi * viscosity_ * radii_[k] / pull;
  }

private:
  /// Mean of the last two of some steps: what changes its sign in every step is not damped (it is
  /// excited by kernels that give even and odd nodes unlike shares).
  double speed(int steps) {
    run_.run(steps - 1);
    const double u = run_.v()[0][axis_];
    run_.run(1);
    return (u + run_.v()[0][axis_]) / 2;
  }

  std::size_t axis_;
  double viscosity_;
  std::vector<double> radii_;
  CarrierRun run_;
};

/// Speeds over what they should be, by radius and place.
struct Drift {
  std::string where;
  double dx_nm;
  std::vector<std::vector<double>> corrected, uncorrected;  ///< [radius][place]
};

std::vector<double> in_nodes(double dx_nm) {
  std::vector<double> a(radii_nm.begin(), radii_nm.end());
  for (double& radius : a) radius /= dx_nm;
  return a;
}

/// @param expected  of radius a in nodes, over Stokes'
template <class Expected> void measure(Drift& d, Pulled& carrier, Expected expected) {
  const auto a = in_nodes(d.dx_nm);
  const double R = ibm::hydrodynamic_radius(ibm::DeltaKernel::cosine4, 3.0 / 16);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double ratio = carrier.over_stokes(k);
    // With the friction 6 pi mu a instead of the bare one the carrier would slip by F/(6 pi mu a).
    const double uncorrected = ratio - (1 - a[k] / R) + 1;
    d.corrected[k].push_back(ratio / expected(a[k]));
    d.uncorrected[k].push_back(uncorrected / expected(a[k]));
  }
}

Drift empty_drift(std::string where, double dx_nm) {
  return {std::move(where), dx_nm, std::vector<std::vector<double>>(radii_nm.size()),
          std::vector<std::vector<double>>(radii_nm.size())};
}

/// Places in a cell of the lattice, from a node.
const std::array<Vec3, 6> offsets{{{0, 0, 0},
                                   {0.5, 0.5, 0.5},
                                   {0.25, 0.25, 0.25},
                                   {0.5, 0, 0},
                                   {0, 0.5, 0.25},
                                   {0.1, 0.35, 0.7}}};

Drift in_periodic_box(double dx_nm) {
  constexpr int L = 24, middle = L / 2;
  CarrierRun::Setup s;
  s.nodes = {L, L, L};
  s.radii = in_nodes(dx_nm);
  const Vec3 node{middle + 0.5, middle + 0.5, middle + 0.5};
  s.x = {node};
  s.fluid = format("tau 1.0 force %.17g 0 0", -pull / (1.0 * L * L * L));
  Pulled carrier(s, 0, 1.0 / 6);
  Drift d = empty_drift("periodic box", dx_nm);
  for (const Vec3& offset : offsets) {
    carrier.settle(node + offset, 200);
    measure(d, carrier, [](double a) { return hasimoto(a, L); });
  }
  return d;
}

/// Across the gap of 24 um in a box of 12 um x 12 um along the plates: 1 - c a by the exact Green
/// function between two plates.
Drift in_slit(double dx_nm) {
  struct Height {
    double z_um, c_per_um;
  };
  constexpr std::array<Height, 3> heights{{{12, 0.2439}, {9, 0.2449}, {6, 0.2576}}};
  const double dx = dx_nm / 1000;
  const int side = static_cast<int>(std::lround(12 / dx)), gap = 2 * side, middle = side / 2;
  CarrierRun::Setup s;
  s.nodes = {side, side, gap};
  s.walls = CarrierRun::Setup::Walls::plates;
  s.radii = in_nodes(dx_nm);
  s.x = {{side / 2.0, side / 2.0, gap / 2.0}};
  s.fluid = "tau 3.0";  // steady flow of trt does not depend on it, and comes sooner
  Pulled carrier(s, 2, 2.5 / 3);
  Drift d = empty_drift("slit", dx_nm);
  std::size_t place = 0;
  for (const Height& at : heights)
    for (int k = 0; k < (at.z_um == 12 ? 3 : 1); ++k) {
      // Along the plates every place is as good as another; across, half a node hardly matters.
      const Vec3 o = offsets[place++];
      const double across = at.z_um == 12 ? o.z : 0;
      carrier.settle({middle + 0.5 + o.x, middle + 0.5 + o.y, at.z_um / dx + across}, 250);
      measure(d, carrier, [&](double a) { return 1 - at.c_per_um * a * dx; });
    }
  return d;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

double worst_of(const std::vector<double>& v) {
  return *std::max_element(v.begin(), v.end(),
                           [](double a, double b) { return std::fabs(a - 1) < std::fabs(b - 1); });
}

void report(std::vector<Finding>& found, const Drift& d) {
  const char* source = d.where == "slit" ? "Stokes, slit factor" : "Stokes, Hasimoto 1959";
  const std::string head = d.where + format(", dx %g um, ", d.dx_nm / 1000);
  for (std::size_t k = 0; k < radii_nm.size(); ++k)
    found.push_back(
        {"particle-drift",
         head + format("a %g nm, worst of %zu places", radii_nm[k], d.corrected[k].size()),
         worst_of(d.corrected[k]), 1, each_tolerance, "", source});
  for (std::size_t k = 0; k < radii_nm.size(); ++k)
    found.push_back({"particle-drift", head + format("a %g nm, mean", radii_nm[k]),
                     mean(d.corrected[k]), 1, mean_tolerance, "", source});
  const double R = ibm::hydrodynamic_radius(ibm::DeltaKernel::cosine4, 3.0 / 16);
  for (const std::size_t k : {std::size_t{4}, std::size_t{5}})
    found.push_back(
        printed("particle-drift", head + format("a %g nm, friction not corrected", radii_nm[k]),
                mean(d.uncorrected[k]), 1 + radii_nm[k] / d.dx_nm / R, "", "1 + a/R, unbounded"));
}

void draw_drift(const std::vector<Drift>& all, const std::string& out) {
  io::make_directory(out);
  io::CsvFile csv(out + "/particle_drift.csv",
                  "slit,dx_um,radius_nm,place,speed_over_expected,uncorrected_over_expected");
  using Style = io::Series::Style;
  // V goes as the radius squared: the magnetic force as its cube.
  const auto scaled = [](double nm) { return std::pow(nm / 80, 2); };
  io::Series stokes{"Eq. 42", "black", {}, {}, {}, Style::line};
  for (double nm = 0; nm <= 130; nm += 2) stokes.x.push_back(nm), stokes.y.push_back(scaled(nm));
  io::Diagram speeds{
      "drift of one carrier", "radius (nm)", "V/V0, V0 = V at 80 nm", {stokes}, {}, {}};
  io::Diagram errors{
      "against Stokes with box or slit factor", "radius (nm)", "error (%)", {}, {0, 140}, {-2, 45}};
  const char* colours[] = {"#c0392b", "#e67e22", "#1f77b4", "#16a085"};
  std::size_t colour = 0;
  for (const Drift& d : all) {
    const std::string name = d.where + format(", dx %g um", d.dx_nm / 1000);
    io::Series ours{name, colours[colour], {}, {}, {}, Style::dots};
    io::Series raw{"", colours[colour++], {}, {}, {}, Style::circles};
    io::Series v = ours, v_raw = raw;
    for (std::size_t k = 0; k < radii_nm.size(); ++k) {
      for (std::size_t p = 0; p < d.corrected[k].size(); ++p) {
        csv.row({d.where == "slit" ? 1.0 : 0.0, d.dx_nm / 1000, radii_nm[k], static_cast<double>(p),
                 d.corrected[k][p], d.uncorrected[k][p]});
        ours.x.push_back(radii_nm[k]), ours.y.push_back(100 * (d.corrected[k][p] - 1));
      }
      raw.x.push_back(radii_nm[k]), raw.y.push_back(100 * (mean(d.uncorrected[k]) - 1));
      v.x.push_back(radii_nm[k]), v.y.push_back(scaled(radii_nm[k]) * mean(d.corrected[k]));
      v_raw.x.push_back(radii_nm[k]);
      v_raw.y.push_back(scaled(radii_nm[k]) * mean(d.uncorrected[k]));
    }
    speeds.series.push_back(v), speeds.series.push_back(v_raw);
    errors.series.push_back(ours), errors.series.push_back(raw);
  }
  errors.series.back().label = speeds.series.back().label = "open: friction not corrected";
  io::replace_file(out + "/particle_drift.svg", io::draw_diagrams({speeds, errors}));
}

/// Mean mobility over the cell of every kernel in every scheme, by Gauss-Lobatto quadrature with
/// three points an axis on [0, 1/2]^3 (the rest is a mirror image; y and z may be exchanged).
void kernels_and_schemes(std::vector<Finding>& found) {
  constexpr int L = 16, middle = L / 2;
  struct Scheme {
    const char* name;
    const char* options;
    double viscosity, magic;  // magic 0: the exponential scheme
    double tau;
  };
  constexpr std::array<Scheme, 4> schemes{
      {{"trt", "scheme trt tau 1.0", 1.0 / 6, 3.0 / 16, 1},
       {"bgk", "scheme bgk tau 1.0", 1.0 / 6, 0.25, 1},
       {"exponential", "scheme exponential tau 0.5", 1.0 / 6, 0, 0.5},
       {"exponential", "scheme exponential tau 1.0", 1.0 / 3, 0, 1}}};
  const std::array<double, 3> at{0, 0.25, 0.5}, weight{1.0 / 6, 4.0 / 6, 1.0 / 6};
  for (const Scheme& scheme : schemes)
    for (const char* name : {"cosine4", "peskin4", "roma3", "linear2"}) {
      const auto kernel = ibm::delta_kernel(name);
      const double R = scheme.magic > 0 ? ibm::hydrodynamic_radius(kernel, scheme.magic)
                                        : ibm::exponential_radius(kernel, scheme.tau);
      CarrierRun::Setup s;
      s.nodes = {L, L, L};
      s.radii = {R / 2};
      const Vec3 node{middle + 0.5, middle + 0.5, middle + 0.5};
      s.x = {node};
      s.fluid =
          format("%s kernel %s force %.17g 0 0", scheme.options, name, -pull / (1.0 * L * L * L));
      Pulled carrier(s, 0, scheme.viscosity);
      double sum = 0, worst = 1;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t k = 0; k <= j; ++k) {
            carrier.settle(node + Vec3{at[i], at[j], at[k]}, 100);
            const double ratio = carrier.over_stokes(0) / hasimoto(R / 2, L);
            sum += (j == k ? 1 : 2) * weight[i] * weight[j] * weight[k] * ratio;
            if (std::fabs(ratio - 1) > std::fabs(worst - 1)) worst = ratio;
          }
      const std::string head = format("%s tau %g, %s, a = R/2, ", scheme.name, scheme.tau, name);
      found.push_back({"particle-drift", head + "mean over cell", sum, 1, mean_tolerance, "",
                       "Stokes, Hasimoto 1959"});
      found.push_back(
          printed("particle-drift", head + "worst place", worst, 1, "", "Stokes, Hasimoto 1959"));
    }
}

std::vector<Finding> particle_drift(const std::string& out) {
  std::vector<Finding> found;
  std::vector<Drift> all{in_periodic_box(250), in_periodic_box(500), in_slit(500), in_slit(250)};
  for (const Drift& d : all) report(found, d);
  kernels_and_schemes(found);
  draw_drift(all, out);
  return found;
}

// ---- let go

constexpr double relaxation_tolerance = 0.01;  // relative, of the issue
constexpr double round_off = 1e-12;            // relative: some roundings a step over 2,000 steps

std::vector<Finding> relaxation_drag(const std::string& out) {
  const char* name = "relaxation-drag";
  const char* source = "exp(-Gamma t/m)";
  constexpr double a = 0.4, eta = 1.0 / 6, v0 = 1e-3;
  constexpr int L = 32;
  const double gamma = 6 * pi * eta * a;
  std::vector<Finding> found;
  io::make_directory(out);
  io::CsvFile csv(out + "/relaxation_drag.csv",
                  "two_way,m_over_gamma_steps,step,v_over_v0,exponential");
  using Style = io::Series::Style;
  io::Diagram diagram{"a carrier let go in fluid at rest", "t Gamma/m", "v/v0", {}, {0, 5}, {0, 1}};
  io::Series law{"exp(-Gamma t/m)", "black", {}, {}, {}, Style::line};
  for (double t = 0; t <= 5; t += 0.05) law.x.push_back(t), law.y.push_back(std::exp(-t));
  diagram.series.push_back(law);
  CarrierRun::Setup s;
  s.nodes = {L, L, L};
  s.radii = {a};
  s.x = {{16.3, 15.9, 16.1}};
  const char* colours[] = {"#c0392b", "#1f77b4", "#16a085"};
  std::size_t colour = 0;
  for (const double time : {0.5, 8.0, 100.0}) {
    s.drag = format("feedback no inertia 1 %.17g", time * gamma);
    CarrierRun run(s);
    run.command(format("velocity all set %.17g 0 0", v0));
    const Vec3 start = run.x()[0];
    io::Series ours{
        format("one-way, m/Gamma = %g steps", time), colours[colour++], {}, {}, {}, Style::dots};
    double worst = 0;
    const int every = std::max(1, static_cast<int>(time / 4));
    for (int t = 0; t <= 5 * time + every; t += every) {
      if (t > 0) run.run(every);
      const double now = run.v()[0].x / v0, expected = std::exp(-t / time);
      worst = std::max(worst, std::fabs(now / expected - 1));
      csv.row({0, time, static_cast<double>(t), now, expected});
      if (t <= 5 * time) ours.x.push_back(t / time), ours.y.push_back(now);
    }
    run.run(static_cast<long>(30 * time) + 5);
    diagram.series.push_back(ours);
    found.push_back({name, format("one-way, m/Gamma = %g steps: worst v over the law's", time),
                     1 + worst, 1, relaxation_tolerance, "", source});
    found.push_back({name, format("one-way, m/Gamma = %g steps: way over v0 m/Gamma", time),
                     (run.x()[0].x - start.x) / (v0 * time), 1, relaxation_tolerance, "",
                     "integral of the law"});
  }

  // Two-way the fluid near the carrier moves along: the total momentum stays, the carrier follows
  // the exponential with its bare friction only until the fluid has begun to move, and the mass
  // that is braked is its own alone: the lattice holds the fluid it displaces.
  constexpr double time = 20;
  const double R = ibm::hydrodynamic_radius(ibm::DeltaKernel::cosine4, 3.0 / 16);
  const double bare = gamma / (1 - a / R), mass = time * bare;
  s.drag = format("inertia 1 %.17g", mass);
  CarrierRun run(s);
  run.command(format("velocity all set %.17g 0 0", v0));
  io::Series ours{
      format("two-way, m/Gamma = %g steps", time), "#8e44ad", {}, {}, {}, Style::circles};
  double lost = 0, tenth = 0;
  for (int t = 0; t <= 2000; ++t) {
    if (t > 0) {
      run.run(1);
      const double total = mass * run.v()[0].x + run.fluid_momentum().x;
      lost = std::max(lost, std::fabs(total / (mass * v0) - 1));
    }
    const double now = run.v()[0].x / v0;
    if (t == 2) tenth = now;
    csv.row({1, time, static_cast<double>(t), now, std::exp(-t / time)});
    if (t % 5 == 0 && t <= 5 * time) ours.x.push_back(t / time), ours.y.push_back(now);
  }
  diagram.series.push_back(ours);
  found.push_back({name, "two-way: carrier's and fluid's momentum over 2,000 steps", 1 + lost, 1,
                   round_off, "", "conserved"});
  found.push_back(printed(name, "two-way: v/v0 after 0.1 m/Gamma", tenth, std::exp(-0.1), "",
                          "bare friction, fluid still at rest"));
  found.push_back(printed(name, "two-way: v/v0 after 5 m/Gamma (the fluid's momentum carries it)",
                          ours.y.back(), std::exp(-5), "", source));
  io::replace_file(out + "/relaxation_drag.svg", io::draw_diagrams({diagram}));
  return found;
}

}  // namespace

std::vector<Validation> drift_validations() {
  return {{"particle-drift", "one carrier pulled through fluid", particle_drift},
          {"relaxation-drag", "a carrier with inertia let go", relaxation_drag}};
}

}  // namespace hemomag::app
