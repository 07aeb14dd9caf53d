#include <array>
#include <cmath>
#include <string>

#include "app/chain_run.hpp"
#include "app/published.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"

// A chain of carriers in a rotating field (the paper's Fig. 8).

namespace hemomag::app {
namespace {

constexpr const char* name = "chain";
constexpr const char* table = "RPY, kappa 60";
constexpr double turns_to_see = 4;             // of the field, as in the table
constexpr double holds = 0.92, breaks = 1.08;  // of the table's critical frequency, of the issue

bool breaks_at(const ChainRun::Options& options) {
  ChainRun chain(options);
  while (chain.turns() < turns_to_see) {
    chain.advance();
    if (chain.broken()) return true;
  }
  return false;
}

/// Between which speeds a chain begins to break.
struct Critical {
  double intact, broken;
  double middle() const { return (intact + broken) / 2; }
  double width() const { return (broken - intact) / middle(); }
};

/// Halve [intact, broken] until it is narrower than `width`.
Critical bisect(ChainRun::Options options, Critical c, double width) {
  while (c.width() > width) {
    options.speed = c.middle();
    (breaks_at(options) ? c.broken : c.intact) = options.speed;
  }
  return c;
}

/// Frequencies at which chains break (Fig. 8a). @return of the longest chain
Critical breakup(std::vector<Finding>& found, io::CsvFile& csv, io::Series& ours) {
  Critical c{holds, breaks};
  for (const int N : {3, 5, 7, 9, 11}) {
    ChainRun::Options o;
    o.carriers = N;
    o.speed = holds;
    const bool low = breaks_at(o);
    o.speed = breaks;
    const bool high = breaks_at(o);
    found.push_back({name,
                     format("N = %d intact at %g of the table's frequency (1: yes)", N, holds),
                     low ? 0.0 : 1.0, 1, 0, "", table});
    found.push_back({name, format("N = %d broken at %g of it (1: yes)", N, breaks),
                     high ? 1.0 : 0.0, 1, 0, "", table});
    c = {low ? 0.5 : holds, high ? breaks : 2.0};
    c = bisect(o, c, N == 11 ? 0.01 : 0.02);
    found.push_back(printed(name, format("N = %d, critical frequency over the table's", N),
                            c.middle(), 1, "", table));
    const double w = c.middle() * critical_frequency(N);
    ours.x.push_back(N), ours.y.push_back(w);
    csv.row({static_cast<double>(N), w, c.intact, c.broken});
  }
  found.push_back(
      {name, "N = 11, width of the bisected interval", c.width(), 0, 0.01, "", "issue"});
  return c;
}

/// What the box and the fluid's inertia change: the table knows neither.
void sensitivity(std::vector<Finding>& found) {
  ChainRun::Options o;
  o.carriers = 5;
  const Critical range{0.85, 1.15};
  for (const double box : {2.5, 3.5, 5.0}) {
    o.box = box;
    found.push_back(
        printed(name, format("N = 5, box of %g chain lengths: critical over the table's", box),
                bisect(o, range, 0.005).middle(), 1, "", table));
  }
  o.box = 2.5;
  for (const double reynolds : {0.05, 0.5}) {
    o.reynolds = reynolds;
    found.push_back(
        printed(name, format("N = 5, tip Reynolds number %g: critical over the table's", reynolds),
                bisect(o, range, 0.005).middle(), 1, "", table));
  }
}

/// The middle of the chain's plane, one and a half chains wide.
io::FlowPicture picture(ChainRun& chain, const std::string& label) {
  const int side = chain.side(), cut = side / 5;
  io::FlowPicture p;
  p.label = label;
  p.width = p.height = side - 2 * cut;
  p.radius = chain.radius();
  for (const Vec3& x : chain.x()) p.spheres.push_back({x.x - cut, x.y - cut});
  p.axis = {std::cos(chain.field_angle()), std::sin(chain.field_angle())};
  const auto u = chain.flow_in_plane();
  constexpr int every = 2;
  for (int j = cut + 1; j < side - cut; j += every)
    for (int i = cut + 1; i < side - cut; i += every) {
      const int node = j * side + i;
      const Vec3& here = u[static_cast<std::size_t>(node)];
      p.flow.push_back({i - cut + 0.5, j - cut + 0.5, here.x, here.y});
    }
  p.fastest = 0.7 * chain.tip_speed();
  p.arrow = 4;
  return p;
}

/// Straight, S-shaped, broken (Fig. 8b).
void shapes(std::vector<Finding>& found, double critical, const std::string& out) {
  std::vector<io::FlowPicture> pictures;
  io::CsvFile csv(out + "/chain_shapes.csv",
                  "speed_over_critical,bead,x_over_a,y_over_a,field_angle_rad");
  const auto keep = [&](ChainRun& chain, double share, const char* what) {
    pictures.push_back(picture(chain, format("%g of critical: ", share) + what));
    for (std::size_t k = 0; k < chain.x().size(); ++k)
      csv.row({share, static_cast<double>(k), chain.x()[k].x / chain.radius(),
               chain.x()[k].y / chain.radius(), chain.field_angle()});
  };
  constexpr double straight = 5, curved = 20;  // degrees between end and middle bonds
  for (const double share : {0.2, 0.98}) {
    ChainRun::Options o;
    o.speed = share * critical;
    ChainRun chain(o);
    bool broke = false;
    while (chain.turns() < 1.5) {
      chain.advance();
      broke = broke || chain.broken();
    }
    const std::string head = format("N = 11 at %g of critical: ", share);
    found.push_back({name, head + "intact after 1.5 turns (1: yes)", broke ? 0.0 : 1.0, 1, 0, "",
                     "the paper's Fig. 8b"});
    if (share < 0.5) {
      found.push_back({name, head + "straight, angle of end to middle bonds", chain.bend(), 0,
                       straight, "deg", "the paper's Fig. 8b"});
    } else {
      found.push_back({name, head + "S: least turn of an end bond from the middle", chain.s_shape(),
                       90, 90 - curved, "deg", "both ends turn the same way"});
    }
    found.push_back(printed(name, head + "lag behind the field", chain.lag(), 0, "deg", "-"));
    found.push_back(printed(name, head + "sub-steps", chain.substeps(), 1, "", "-"));
    keep(chain, share, share < 0.5 ? "straight" : "S-shaped");
  }
  ChainRun::Options o;
  o.speed = 1.7 * critical;
  ChainRun chain(o);
  double first = 0;
  int most = 1;
  while (chain.turns() < 1.5) {
    chain.advance();
    if (chain.fragments() > 1 && first == 0) first = chain.turns();
    if (chain.fragments() > most) {
      most = chain.fragments();
      if (pictures.size() == 3) pictures.pop_back();
      keep(chain, 1.7, "broken");
    }
  }
  found.push_back({name, "N = 11 at 1.7 of critical: broken (1: yes)", most > 1 ? 1.0 : 0.0, 1, 0,
                   "", "the paper's Fig. 8b"});
  found.push_back(printed(name, "N = 11 at 1.7 of critical: most fragments", most, 2, "",
                          "the paper's Fig. 8b"));
  found.push_back(
      printed(name, "N = 11 at 1.7 of critical: first break, turns", first, 0, "", "-"));
  io::replace_file(out + "/chain_shapes.svg", io::draw_flows(pictures));
}

void draw_breakup(const io::Series& ours, const std::string& out) {
  using Style = io::Series::Style;
  io::Series free{"free draining", "#7f8c8d", {}, {}, {}, Style::dashes};
  io::Series k30{"RPY, kappa 30", "#1f77b4", {}, {}, {}, Style::dashes};
  io::Series k60{"RPY, kappa 60", "#1f77b4", {}, {}, {}, Style::line};
  io::Series body{"slender body, R_T = 1", "black", {}, {}, {}, Style::line};
  for (const ChainPoint& p : chain_breakup)
    for (const auto& [series, w] :
         {std::pair{&free, p.free_draining}, std::pair{&k30, p.rpy_kappa30},
          std::pair{&k60, p.rpy_kappa60}, std::pair{&body, p.slender_body}})
      series->x.push_back(p.carriers), series->y.push_back(w);
  const std::vector<io::Series> all{free, k30, k60, body, ours};
  auto compensated = all;
  for (io::Series& s : compensated)
    for (std::size_t i = 0; i < s.x.size(); ++i) s.y[i] *= s.x[i] * s.x[i];
  const io::Diagram plain{
      "critical frequency of chains", "N", "omega 6 pi eta a^2/F0", all, {0, 16}, {0, 0.08}};
  const io::Diagram scaled{"the same times N^2", "N",     "N^2 omega 6 pi eta a^2/F0",
                           compensated,          {0, 16}, {0, 0.8}};
  io::replace_file(out + "/chain_breakup.svg", io::draw_diagrams({plain, scaled}));
}

std::vector<Finding> chain(const std::string& out) {
  io::make_directory(out);
  std::vector<Finding> found;
  found.push_back({name, "tip Reynolds number", ChainRun::Options{}.reynolds, 0, 0.5, "", "issue"});
  io::Series ours{"hemomag", "#c0392b", {}, {}, {}, io::Series::Style::dots};
  io::CsvFile csv(out + "/chain_breakup.csv",
                  "carriers,critical,intact_over_table,broken_over_table");
  const Critical longest = breakup(found, csv, ours);
  draw_breakup(ours, out);
  shapes(found, longest.middle(), out);
  sensitivity(found);
  return found;
}

}  // namespace

std::vector<Validation> chain_validations() {
  return {{name, "chains in a rotating field: when they break, and their shapes", chain}};
}

}  // namespace hemomag::app
