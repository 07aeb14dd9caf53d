#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/cell_run.hpp"
#include "app/published.hpp"
#include "app/rigid_body.hpp"
#include "app/stretching.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"

// One red cell between plates that move in opposite directions, viscosity contrast 1: Figs. 5b and
// 5c. At low capillary number Ca = eta shear R/mu0 it tumbles as a solid would, above a threshold
// its membrane treads around a nearly steady shape. Lengths in um, times in units of 1/shear.

namespace hemomag::app {
namespace {

using case_::Hinges;
using case_::StressFree;

constexpr double viscosity = 1.2e-3;  // Pa s
constexpr double mu0 = 6.3e-6;        // N/m
constexpr double radius = 3.91e-6;    // m
constexpr double dx = 0.5;            // um
constexpr double look_every = 0.25;   // strain; a cell turns by less than a quarter meanwhile

double shear_rate_of(double Ca) { return Ca * mu0 / (viscosity * radius); }
double stress_of(double Ca) { return Ca * mu0 / radius; }  // Pa

/// Thickness over diameter of the spheroid whose moments are those of the cell.
constexpr double spheroid_r = 0.324;

/// Shear per step [-]: the cell's Reynolds number is 0.5, less where the membrane is stiff against
/// the flow so that (k_d + k_a + 2 mu0)/(2 eta) stays below 4.5 in lattice units.
double shear_per_step(double Ca) {
  const double reynolds = std::min(0.5, 10 * Ca);
  return reynolds / 6 * std::pow(dx * 1e-6 / radius, 2);
}

/// What a cell did, looked at every `look_every`.
struct History {
  double Ca = 0;
  std::vector<double> time, inclination, phase;  // 1/shear; degrees, counted over turns
  std::vector<std::vector<Vec3>> x;              // vertices [um] at each look
  std::array<double, 3> semi_axes{};             // at the end
};

History shear(const std::string& out, double Ca, double strain, StressFree stress_free,
              Hinges hinges) {
  const double per_step = shear_per_step(Ca), rate = shear_rate_of(Ca);
  const CellRun::Options options{.dx = dx,
                                 .dt = per_step / rate,
                                 .hinges = hinges,
                                 .stress_free = stress_free,
                                 .shear_rate = rate};
  CellRun cell(out, CellRun::rest_mesh(options.vertices).x, options);
  const long steps = std::lround(look_every / per_step);
  History h;
  h.Ca = Ca;
  while (h.time.empty() || h.time.back() < strain) {
    cell.run(steps);
    const CellRun::Motion m = cell.motion();
    h.time.push_back(cell.time() * rate);
    h.inclination.push_back(m.inclination);
    h.phase.push_back(m.phase);
    h.x.push_back(cell.x());
    h.semi_axes = m.semi_axes;
  }
  return h;
}

/// When a falling angle passes a - k turn for k = 0, 1, 2 ..., first at or below its value at
/// `from`. An elongated body passes the flow's direction slowly and the gradient's quickly: take a
/// at the gradient for sharp times.
std::vector<double> passages(const std::vector<double>& time, const std::vector<double>& angle,
                             double a, double turn, double from) {
  std::vector<double> when;
  double next = 0;
  bool started = false;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] < from) continue;
    if (!started) {
      next = a + turn * std::floor((angle[i - 1] - a) / turn);
      started = true;
    }
    while (angle[i] <= next) {
      when.push_back(time[i - 1] +
                     (time[i] - time[i - 1]) * (angle[i - 1] - next) / (angle[i - 1] - angle[i]));
      next -= turn;
    }
  }
  return when;
}

/// Mean time of a whole turn, 0 when the angle has not passed twice.
double whole_turn(const std::vector<double>& when, double turn) {
  if (when.size() < 2) return 0;
  return (when.back() - when.front()) / static_cast<double>(when.size() - 1) * (360 / turn);
}

/// The long axis turns over by half turns, two a period.
double tumbling_period(const History& h, double from) {
  return whole_turn(passages(h.time, h.inclination, -90, 180, from), 180);
}
double treading_period(const History& h, double from) {
  return whole_turn(passages(h.time, h.phase, -90, 360, from), 360);
}

/// How far an angle has fallen since `from`.
double fall(const History& h, const std::vector<double>& angle, double from) {
  const auto i = static_cast<std::size_t>(std::lower_bound(h.time.begin(), h.time.end(), from) -
                                          h.time.begin());
  return angle[i] - angle.back();
}

enum class Regime { tumbling, treading, neither };

/// By the last `window`: a cell whose long axis turned over tumbles, one whose membrane went half
/// around a long axis that did not treads.
Regime regime(const History& h, double window) {
  const double from = h.time.back() - window;
  if (fall(h, h.inclination, from) > 150) return Regime::tumbling;
  if (fall(h, h.phase, from) > 150) return Regime::treading;
  return Regime::neither;
}

constexpr double transient = 12;        // strain until the start is forgotten
constexpr double window = 26;           // strain: more than a half turn of either motion
constexpr double tumbling_strain = 38;  // two half turns of the axis and the transient
constexpr double treading_strain = 75;  // two turns of the membrane and the transient

// ---- frequencies

constexpr double period_tolerance = 0.12;                    // of the issue, around Jeffery
constexpr double treading_low = 0.17, treading_high = 0.30;  // of the issue, omega/shear

struct Point {
  double Ca, frequency;  // turns per 1/shear
};

io::Series in_hertz(const char* label, const char* colour, io::Series::Style style,
                    const std::vector<Point>& points) {
  io::Series s{label, colour, {}, {}, {}, style};
  for (const Point& p : points) {
    s.x.push_back(shear_rate_of(p.Ca));
    s.y.push_back(p.frequency * shear_rate_of(p.Ca));
  }
  return s;
}

io::Series reduced(const char* label, const char* colour, io::Series::Style style,
                   const std::vector<Point>& points) {
  io::Series s{label, colour, {}, {}, {}, style};
  for (const Point& p : points) {
    s.x.push_back(p.Ca);
    s.y.push_back(2 * std::numbers::pi * p.frequency);
  }
  return s;
}

/// Keller & Skalak (1982), fluid ellipsoid of semi-axes 3.91, 1.28, 3.91 um without elasticity at
/// viscosity contrast 1: omega = 0.296 shear.
constexpr double keller_skalak = 0.296 / (2 * std::numbers::pi);

void draw_frequencies(const std::string& out, const std::vector<Point>& tumbling,
                      const std::vector<Point>& treading, const JefferyOrbit& rigid, double low,
                      double high) {
  using enum io::Series::Style;
  std::vector<Point> fischer;
  fischer.reserve(fischer_2015.size());
  for (const auto& p : fischer_2015)
    fischer.push_back(
        {fischer_2015_viscosity * p.shear_rate * radius / mu0, p.frequency_over_shear});
  const std::vector<Point> ks{{0.0, keller_skalak}, {1.05, keller_skalak}};
  const std::vector<Point> as_rigid{{0.0, 1 / rigid.period()}, {1.05, 1 / rigid.period()}};
  std::vector<Point> fischer_here;
  for (const Point& p : fischer)
    if (p.Ca < 1.1) fischer_here.push_back(p);
  const char *red = "#c0392b", *blue = "#1f77b4", *green = "#2e8b57";
  io::Diagram hertz{"frequency of a cell in shear, 1.2 mPa s",
                    "shear rate (1/s)",
                    "frequency (1/s)",
                    {in_hertz("tumbling", blue, dots, tumbling),
                     in_hertz("tank-treading", red, dots, treading),
                     in_hertz("Fischer 2015 at equal Ca", "black", circles, fischer_here),
                     in_hertz("Keller-Skalak", green, dashes, ks),
                     in_hertz("rigid cell", blue, dashes, as_rigid)},
                    {0, 1450},
                    {0, 100}};
  hertz.shaded = {shear_rate_of(low), shear_rate_of(high)};
  io::Diagram ratio{
      "the same over the shear rate",
      "Ca",
      "2 pi frequency / shear rate",
      {reduced("tumbling", blue, dots, tumbling), reduced("tank-treading", red, dots, treading),
       reduced("Fischer 2015", "black", circles, fischer_here),
       reduced("Keller-Skalak", green, dashes, ks), reduced("rigid cell", blue, dashes, as_rigid)},
      {0, 1.1},
      {0, 0.7}};
  ratio.shaded = {low, high};
  io::replace_file(out + "/shear_cell_5b.svg", io::draw_diagrams({hertz, ratio}));
}

/// Seen along the vorticity: the flow to the right above, a dark spot on the membrane.
void draw_motion(const std::string& path, const History& h, double from, double length) {
  constexpr int pictures = 7;
  const auto rest = CellRun::rest_mesh(642);
  // The spot: on the rim, on the side that is seen.
  const auto along = [](const Vec3& p) { return p.y + 0.6 * p.x; };
  const auto spot =
      std::max_element(rest.x.begin(), rest.x.end(),
                       [&](const Vec3& a, const Vec3& b) { return along(a) < along(b); });
  std::vector<io::Body> bodies;
  for (int k = 0; k < pictures; ++k) {
    const double when = from + length * k / (pictures - 1);
    const auto i = std::min<std::size_t>(
        static_cast<std::size_t>(std::lower_bound(h.time.begin(), h.time.end(), when) -
                                 h.time.begin()),
        h.time.size() - 1);
    io::Body body;
    char label[40];
    std::snprintf(label, sizeof label, "t = %.1f/shear", h.time[i]);
    body.label = label;
    for (const Vec3& p : h.x[i]) body.x.push_back({p.y, -p.x, p.z});
    body.triangles = rest.triangles;
    body.marked = static_cast<int>(spot - rest.x.begin());
    bodies.push_back(std::move(body));
  }
  io::replace_file(path, io::draw_bodies(bodies, 0, 5, "5 um"));
}

void write_history(io::CsvFile& csv, const History& h) {
  for (std::size_t i = 0; i < h.time.size(); ++i)
    csv.row({h.Ca, h.time[i], h.time[i] / shear_rate_of(h.Ca), h.inclination[i], h.phase[i]});
}

/// Whether each frequency [1/s] is above the one at the next lower shear rate: number of falls.
double falls(const std::vector<Point>& points) {
  int n = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    n += points[i].frequency * points[i].Ca <= points[i - 1].frequency * points[i - 1].Ca;
  return n;
}

std::string at_Ca(double Ca, const char* what) {
  char quantity[96];
  std::snprintf(quantity, sizeof quantity, "Ca %g, %s", Ca, what);
  return quantity;
}

/// The orbit of the rigid cell. Jeffery's r is not its thickness over diameter: the rim is blunt,
/// and of two bodies of equal moments the blunter turns faster. On the spheroid itself the method
/// returns r within `r_tolerance`.
JefferyOrbit rigid_cell(std::vector<Finding>& found) {
  constexpr int coarse = 642, fine = 1442;
  constexpr double r_tolerance = 0.01 * spheroid_r;
  const char* name = "shear-cell";
  const auto orbit = [&](const membrane::RestShape& shape) {
    return rigid_orbit(membrane::evened_mesh(shape, coarse, 1),
                       membrane::evened_mesh(shape, fine, 1));
  };
  const auto spheroid = membrane::spheroid(rest_diameter, spheroid_r * rest_diameter);
  found.push_back({name, "rigid spheroid of r = 0.324: r of its orbit", orbit(spheroid).r,
                   spheroid_r, r_tolerance, "", "Jeffery 1922"});
  const JefferyOrbit rigid = orbit(membrane::red_cell_shape(rest_diameter));
  found.push_back(printed(name, "rigid biconcave cell: r of its orbit", rigid.r, spheroid_r, "",
                          "spheroid of equal moments"));
  return rigid;
}

std::vector<Finding> shear_cell(const std::string& out) {
  io::make_directory(out);
  io::CsvFile csv(out + "/shear_cell.csv", "Ca,strain,time_s,inclination_deg,phase_deg");
  const char* name = "shear-cell";
  std::vector<Finding> found;
  const JefferyOrbit rigid = rigid_cell(found);
  std::vector<Point> tumbling, treading;
  double highest_tumbling = 0, lowest_treading = 10;
  for (const double Ca : {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0}) {
    const double strain = Ca < 0.3 ? tumbling_strain : treading_strain;
    const History h = shear(out, Ca, strain, StressFree::rest_shape, Hinges::rest);
    write_history(csv, h);
    const Regime now = regime(h, window);
    const double tumble = tumbling_period(h, transient), tread = treading_period(h, transient);
    if (now == Regime::tumbling && tumble > 0) {
      tumbling.push_back({Ca, 1 / tumble});
      highest_tumbling = std::max(highest_tumbling, Ca);
    }
    if (now == Regime::treading && tread > 0) {
      treading.push_back({Ca, 1 / tread});
      // A cell that turned over again before it trod is in the intermittent window.
      if (fall(h, h.inclination, transient) < 150) lowest_treading = std::min(lowest_treading, Ca);
    }
    if (Ca == 0.02) {
      found.push_back({name, at_Ca(Ca, "tumbles: half turns of the axis in the last 26/shear"),
                       fall(h, h.inclination, h.time.back() - window) / 180,
                       2 * window / rigid.period(), 1, "", "rigid cell"});
      found.push_back({name, at_Ca(Ca, "period x shear"), tumble, rigid.period(),
                       period_tolerance * rigid.period(), "", "rigid cell, unbounded Stokes flow"});
      const double spheroid = JefferyOrbit{spheroid_r}.period();
      found.push_back({name, at_Ca(Ca, "period x shear (not a spheroid)"), tumble, spheroid,
                       period_tolerance * spheroid, "", "Jeffery, spheroid r = 0.324",
                       Finding::Kind::shortfall});
      draw_motion(out + "/shear_cell_5c_tumbling.svg", h, transient, tumble / 2);
    }
    if (Ca >= 0.5) {
      const double omega = tread > 0 ? 2 * std::numbers::pi / tread : 0;
      found.push_back({name, at_Ca(Ca, "treads: turning over of the axis in the last 26/shear"),
                       fall(h, h.inclination, h.time.back() - window), 0, 90, "deg",
                       "tank-treading"});
      found.push_back({name, at_Ca(Ca, "2 pi frequency/shear"), omega,
                       (treading_low + treading_high) / 2, (treading_high - treading_low) / 2, "",
                       "0.17 to 0.30"});
    }
    if (Ca == 1.0) draw_motion(out + "/shear_cell_5c_treading.svg", h, 40, 15);
  }
  found.push_back({name, "falls of the tumbling frequency as the shear rate rises", falls(tumbling),
                   0, 0, "", "rises"});
  found.push_back({name, "tumbling frequencies compared", static_cast<double>(tumbling.size()), 4,
                   1, "", "at least 3"});
  found.push_back({name, "falls of the treading frequency as the shear rate rises", falls(treading),
                   0, 0, "", "rises"});
  found.push_back({name, "treading frequencies compared", static_cast<double>(treading.size()), 4,
                   1, "", "at least 3"});
  for (const Point& p : treading)
    found.push_back(
        printed(name, at_Ca(p.Ca, "2 pi frequency/shear"), 2 * std::numbers::pi * p.frequency,
                2 * std::numbers::pi * keller_skalak, "", "Keller-Skalak (no elasticity)"));
  draw_frequencies(out, tumbling, treading, rigid, highest_tumbling, lowest_treading);
  return found;
}

// ---- the threshold

constexpr double lowest_Ca = 0.02, highest_Ca = 1.2;
constexpr double resolution = 1.15;  // of the bracket, high over low
constexpr double threshold_strain = 60;

std::vector<Finding> shear_threshold(const std::string& out) {
  io::make_directory(out);
  io::CsvFile csv(out + "/shear_threshold.csv", "Ca,strain,time_s,inclination_deg,phase_deg");
  const char* name = "shear-threshold";
  std::vector<Finding> found;
  for (const StressFree stress_free : {StressFree::rest_shape, StressFree::sphere})
    for (const Hinges hinges : {Hinges::rest, Hinges::flat}) {
      const auto tumbles = [&](double Ca) {
        const History h = shear(out, Ca, threshold_strain, stress_free, hinges);
        write_history(csv, h);
        return regime(h, window) == Regime::tumbling;
      };
      double low = lowest_Ca, high = highest_Ca;
      std::string head = stress_free == StressFree::sphere ? "sphere" : "biconcave";
      head += hinges == Hinges::flat ? ", flat hinges: " : ", rest hinges: ";
      const bool starts = tumbles(low), ends = !tumbles(high);
      found.push_back({name, head + "tumbles at Ca 0.02 and treads at 1.2",
                       static_cast<double>(starts + ends), 2, 0, "", "bracket"});
      if (!starts || !ends) continue;
      while (high / low > resolution) {
        const double middle = std::sqrt(low * high);
        (tumbles(middle) ? low : high) = middle;
      }
      const double Ca = std::sqrt(low * high);
      found.push_back(printed(name, head + "Ca of the threshold", Ca, 0, "", "bisected to 15 %"));
      for (const auto& p : tumbling_thresholds) {
        char source[80];
        std::snprintf(source, sizeof source, "%s at %g mPa s", p.source, p.viscosity);
        found.push_back(
            printed(name, head + "critical stress", stress_of(Ca), p.stress, "Pa", source));
      }
    }
  return found;
}

}  // namespace

std::vector<Validation> shear_validations() {
  return {{"shear-cell", "one cell in shear flow: tumbling and tank-treading", shear_cell},
          {"shear-threshold", "where tumbling gives way to tank-treading", shear_threshold}};
}

}  // namespace hemomag::app
