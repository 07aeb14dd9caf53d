#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "app/carrier_run.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"
#include "magnetic/dipole.hpp"

// Forces between carriers: the law, the style that applies it, and what its cut-off neglects.

namespace hemomag::app {
namespace {

using std::numbers::pi;

constexpr const char* name = "dipole-pair";
constexpr double d = 0.5;                 // contact distance, nodes: 125 nm at dx 0.5 um
constexpr double default_cutoff = 6 * d;  // 12 radii
constexpr double m = 0.3;                 // moment of each carrier

class Random {
public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }

private:
  std::mt19937_64 bits_{11};
};

/// Five-point central difference of f at 0 over a step eps^(1/5) length.
template <class Function> double slope(double length, Function f) {
  const double h = std::pow(std::numeric_limits<double>::epsilon(), 0.2) * length;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

// ---- the laws

constexpr double gradient_tolerance = 1e-9;  // relative to the force, of the issue

/// |F + dU/dx_j|/|F| of a pair at r.
template <class Law> double gradient_error(const Vec3& r, double length, Law law) {
  const Vec3 F = law(r).on_j;
  Vec3 error = F;
  for (std::size_t a = 0; a < 3; ++a)
    error[a] += slope(length, [&](double h) {
      Vec3 moved = r;
      moved[a] += h;
      return law(moved).energy;
    });
  return norm(error) / norm(F);
}

void laws(std::vector<Finding>& found) {
  Random random;
  constexpr int pairs = 10000;
  double dipole = 0, soft = 0, paper = 0;
  long unequal = 0;
  for (int k = 0; k < pairs; ++k) {
    const Vec3 mi = random.in_cube(1), mj = random.in_cube(1);
    Vec3 e = random.in_cube(1);
    e *= 1 / norm(e);
    const Vec3 r = random.uniform(0.9, 6) * d * e;
    const auto law = [&](const Vec3& x) { return magnetic::dipole_dipole(mi, mj, x); };
    dipole = std::max(dipole, gradient_error(r, norm(r), law));
    const Vec3 there = law(r).on_j, back = magnetic::dipole_dipole(mj, mi, -r).on_j;
    unequal += there.x != -back.x || there.y != -back.y || there.z != -back.z;
    soft =
        std::max(soft, gradient_error(random.uniform(0.9, 1.3) * d * e, d / 30, [](const Vec3& x) {
                   return magnetic::soft_repulsion(2, 30, d, x);
                 }));
    constexpr double sigma = 0.05 * d;
    paper = std::max(paper, gradient_error((d + random.uniform(0.5, 0.9) * sigma) * e, 0.1 * sigma,
                                           [](const Vec3& x) {
                                             return magnetic::paper_repulsion(0.1, sigma, d, x);
                                           }));
  }
  const char* source = "energy's gradient";
  found.push_back({name, "Eq. 24, 10,000 pairs: worst |F + dU/dx|/|F|", dipole, 0,
                   gradient_tolerance, "", source});
  found.push_back({name, "soft repulsion: the same", soft, 0, gradient_tolerance, "", source});
  found.push_back({name, "Eq. 26: the same", paper, 0, gradient_tolerance, "", source});
  found.push_back({name, "Eq. 24: pairs whose two forces differ in a bit",
                   static_cast<double>(unequal), 0, 0, "", "third law"});
}

// ---- the style

CarrierRun::Setup bare_pairs(int side, double cutoff, const std::string& coefficients) {
  CarrierRun::Setup s;  // without fluid and drag: forces are those of the pair style
  s.nodes = {side, side, side};
  s.pair = format("hemo/dipole %.17g", cutoff);
  s.pair_coeff = format("* * %.17g ", d) + coefficients;
  s.forces = {format("fix field all hemo/field susceptibility 1 1 uniform 0 0 %.17g", m)};
  return s;
}

constexpr double style_tolerance = 1e-13;  // relative: r is the difference of places up to 16

/// The style's forces on random pairs, also across the box's borders.
void style(std::vector<Finding>& found) {
  Random random;
  auto s = bare_pairs(16, default_cutoff, "soft 30");
  s.x = {{8, 8, 8}, {9, 8, 8}};
  CarrierRun run(s);
  double worst = 0, unequal = 0;
  for (int k = 0; k < 200; ++k) {
    Vec3 e = random.in_cube(1);
    e *= 1 / norm(e);
    const Vec3 x = random.in_cube(7.9) + Vec3{8, 8, 8}, r = random.uniform(0.95, 5.5) * d * e;
    run.place(0, x);
    run.place(1, x + r);
    run.run(0);
    const auto f = run.f();
    const Vec3 moment{0, 0, m};
    const Vec3 law = magnetic::dipole_dipole(moment, moment, r).on_j +
                     magnetic::soft_repulsion(magnetic::contact_pull(m, m, d), 30, d, r).on_j;
    worst = std::max(worst, norm(f[1] - law) / norm(law));
    unequal += f[0].x != -f[1].x || f[0].y != -f[1].y || f[0].z != -f[1].z;
  }
  found.push_back({name, "pair_style hemo/dipole, 200 pairs: worst error over the force", worst, 0,
                   style_tolerance, "", "the laws"});
  found.push_back({name, "pair_style hemo/dipole: pairs whose two forces differ in a bit", unequal,
                   0, 0, "", "third law"});
}

// ---- what the cut-off neglects

/// Load on the joint in the middle of a straight chain of 32 along the field, over the contact
/// pull.
double middle_load(double cutoff) {
  constexpr int n = 32;
  auto s = bare_pairs(60, cutoff, "soft 30");
  for (int k = 0; k < n; ++k) s.x.push_back({30, 30, 30 + d * (k - 0.5 * (n - 1))});
  CarrierRun run(s);
  run.run(0);
  const auto f = run.f();
  double sum = 0;  // of the left half: what is between its own carriers cancels
  for (std::size_t k = 0; k < n / 2; ++k) sum += f[k].z;
  const double pull = magnetic::contact_pull(m, m, d);
  return sum / pull + 1;  // touching carriers push with one contact pull
}

struct Suspension {
  double rms_error, worst_error, rms_force;  ///< over the contact pull
};

/// Carriers at random places, as many a volume as 10,000 in 27 x 36 x 24 um.
class RandomCarriers {
public:
  RandomCarriers() {
    Random random;
    while (x_.size() < 2000) {
      const Vec3 p = random.in_cube(half);
      if (std::none_of(x_.begin(), x_.end(), [&](const Vec3& q) { return norm(p - q) < 1.5 * d; }))
        x_.push_back(p);
    }
    const Vec3 moment{0, 0, m};
    all_.resize(x_.size());
    for (std::size_t i = 0; i < x_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 F = magnetic::dipole_dipole(moment, moment, x_[i] - x_[j]).on_j;
        all_[i] += F;
        all_[j] -= F;
      }
  }

  /// Against the sum over all pairs; repulsion is nothing at 1.5 d.
  Suspension with_cutoff(double cutoff) const {
    auto s = bare_pairs(side, cutoff, "soft 100");
    for (const Vec3& p : x_) s.x.push_back(p + Vec3{side / 2.0, side / 2.0, side / 2.0});
    CarrierRun run(s);
    run.run(0);
    const auto f = run.f();
    Suspension sum{};
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double error = norm(f[k] - all_[k]);
      sum.rms_error += error * error;
      sum.rms_force += norm2(all_[k]);
      sum.worst_error = std::max(sum.worst_error, error);
    }
    const double pull = magnetic::contact_pull(m, m, d), n = static_cast<double>(f.size());
    return {std::sqrt(sum.rms_error / n) / pull, sum.worst_error / pull,
            std::sqrt(sum.rms_force / n) / pull};
  }

private:
  static constexpr double half = 16.7;  // 2,000 in a cube of 33.4 nodes of 0.5 um
  static constexpr int side = 80;       // periodic images are beyond every cut-off tried
  std::vector<Vec3> x_, all_;
};

void truncation(std::vector<Finding>& found, io::Diagram& diagram, const std::string& out) {
  io::CsvFile csv(out + "/dipole_truncation.csv",
                  "cutoff_over_radius,pair,chain_load_error,suspension_rms,suspension_worst");
  io::Series pair{"aligned pair beyond it", "black", {}, {}},
      chain{"joint of a chain of 32", "#c0392b", {}, {}}, rms{"suspension, RMS", "#1f77b4", {}, {}};
  chain.style = rms.style = io::Series::Style::dots;
  const RandomCarriers carriers;
  double full_load = 0;
  for (int n = 1; n < 32; ++n) full_load += std::min(n, 32 - n) / std::pow(n, 4);
  for (const double radii : {6.0, 8.0, 12.0, 16.0, 24.0}) {
    // A distance that lies on the cut-off would be in or out by rounding.
    const double cutoff = radii * d / 2, of_pair = magnetic::neglected_pull(d, cutoff);
    const double load = middle_load(cutoff * (1 + 1e-9)), of_chain = full_load - load;
    const Suspension s = carriers.with_cutoff(cutoff);
    csv.row({radii, of_pair, of_chain, s.rms_error, s.worst_error});
    pair.x.push_back(radii), pair.y.push_back(std::log10(of_pair));
    chain.x.push_back(radii), chain.y.push_back(std::log10(of_chain));
    rms.x.push_back(radii), rms.y.push_back(std::log10(s.rms_error));
    if (cutoff != default_cutoff) continue;
    const char* head = "default cut-off, 12 radii, over the contact pull: ";
    found.push_back(printed(name, std::string(head) + "aligned pair", of_pair, 0, "", "neglected"));
    found.push_back(printed(name, std::string(head) + "joint of 32", load, full_load, "",
                            "sum over all pairs"));
    found.push_back(
        printed(name, std::string(head) + "suspension RMS", s.rms_error, 0, "", "neglected"));
    found.push_back(
        printed(name, std::string(head) + "suspension worst", s.worst_error, 0, "", "neglected"));
    found.push_back(printed(name, "RMS force in that suspension over the contact pull", s.rms_force,
                            0, "", "2,000 random carriers"));
  }
  diagram = {"what a cut-off neglects",
             "cut-off over radius",
             "log10 of the share of the contact pull",
             {pair, chain, rms},
             {0, 26},
             {-6, 0}};
}

// ---- two carriers in motion

constexpr double approach_tolerance = 1e-3;  // relative: 8,000 explicit steps
constexpr double rest_tolerance = 1e-6;      // relative to d: decays by 5 % a step

/// Two carriers in line with the field, one-way, so that both have the mobility 1/(6 pi mu a): r^5
/// = r0^5 - 10 C t/Gamma with the force C/r^4; at the end they rest at d.
void approach(std::vector<Finding>& found, double kappa) {
  constexpr double radius = d / 2, r0 = 3 * d, r1 = 1.6 * d;
  constexpr long steps = 8000;
  const double gamma = 6 * pi * radius / 6;
  const double C = (std::pow(r0, 5) - std::pow(r1, 5)) * gamma / (10 * steps);
  const double moment = std::sqrt(C * 4 * pi / 6);
  CarrierRun::Setup s;
  s.nodes = {16, 16, 16};
  s.radii = {radius};
  s.pair = "hemo/dipole 4.0";
  s.pair_coeff = format("* * %.17g soft %g", d, kappa);
  s.drag = "feedback no";
  s.forces = {format("fix field all hemo/field susceptibility 1 1 uniform 0 0 %.17g", moment)};
  s.x = {{8.2, 8.1, 8.3}, {8.2, 8.1, 8.3 + r0}};
  CarrierRun run(s);
  run.run(steps);
  const auto distance = [&] { return norm(run.x()[1] - run.x()[0]); };
  found.push_back({name, format("kappa %g: distance after an approach from 3 d", kappa),
                   distance() / d, r1 / d, approach_tolerance * r1 / d, "d", "r^5 law"});
  run.run(20000);
  found.push_back({name, format("kappa %g: distance at rest", kappa), distance() / d, 1,
                   rest_tolerance, "d", "pull = push at r = d"});
}

io::Diagram forces_of_distance() {
  using Style = io::Series::Style;
  const double pull = magnetic::contact_pull(m, m, d);
  const Vec3 moment{0, 0, m};
  io::Series line{"Eq. 24, in line", "black", {}, {}, {}, Style::line};
  io::Series side{"Eq. 24, side by side", "black", {}, {}, {}, Style::dashes};
  io::Series k30{"in line, soft, kappa 30", "#c0392b", {}, {}}, k60{"kappa 60", "#e67e22", {}, {}};
  io::Series paper{"in line, Eq. 26 at 0.1 T", "#1f77b4", {}, {}};
  // epsilon = 0.1 kBT and sigma = 0.1 a against the pull of 125 nm carriers at 0.1 T, 3.75 pN.
  const double epsilon = 0.1 * 4.14e-21 / (3.75e-12 * 250e-9) * pull * d, sigma = 0.05 * d;
  for (double r = 0.96; r <= 1.6; r += 0.002) {
    const Vec3 along{0, 0, r * d}, across{r * d, 0, 0};
    const double f = magnetic::dipole_dipole(moment, moment, along).on_j.z;
    const auto add = [&](io::Series& s, double F) {
      constexpr double highest = 1.2;  // the repulsions go on far beyond the diagram
      if (std::fabs(F) < highest * pull) s.x.push_back(r), s.y.push_back(F / pull);
    };
    add(line, f);
    add(side, magnetic::dipole_dipole(moment, moment, across).on_j.x);
    add(k30, f + magnetic::soft_repulsion(pull, 30, d, along).on_j.z);
    add(k60, f + magnetic::soft_repulsion(pull, 60, d, along).on_j.z);
    if (r > 1.01) add(paper, f + magnetic::paper_repulsion(epsilon, sigma, d, along).on_j.z);
  }
  return {"force between two carriers",  "r/d",       "force over the contact pull (> 0: apart)",
          {line, side, k30, k60, paper}, {0.95, 1.6}, {-1.2, 3}};
}

std::vector<Finding> dipole_pair(const std::string& out) {
  io::make_directory(out);
  std::vector<Finding> found;
  laws(found);
  style(found);
  io::Diagram neglected;
  truncation(found, neglected, out);
  approach(found, 30);
  approach(found, 60);
  io::replace_file(out + "/dipole_pair.svg", io::draw_diagrams({forces_of_distance(), neglected}));
  return found;
}

}  // namespace

std::vector<Validation> dipole_validations() {
  return {{name, "forces between two carriers, and what their cut-off neglects", dipole_pair}};
}

}  // namespace hemomag::app
