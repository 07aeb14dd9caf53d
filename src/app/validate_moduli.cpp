#include <algorithm>
#include <cmath>

#include "app/sheet.hpp"
#include "app/stretching.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"

// Elasticity of the flat network against Eq. 21 and the sums that follow from it.

namespace hemomag::app {
namespace {

constexpr double edge = 0.2225;             // um, the mean at 3286 vertices
constexpr double regular_tolerance = 0.01;  // relative, of the issue; differences are good to 1e-4
constexpr double isotropy = 0.03;           // spread over directions, relative

struct Spread {
  double least, most;
  double relative() const { return 2 * (most - least) / (most + least); }
};

template <class Modulus> Spread spread(const Elasticity& e, Modulus modulus) {
  Spread s{modulus(e), modulus(e)};
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double m = modulus(e.turned(degrees));
    s.least = std::min(s.least, m), s.most = std::max(s.most, m);
  }
  return s;
}

double shear_of(const Elasticity& e) { return e.shear(); }
double youngs_of(const Elasticity& e) { return e.youngs(); }

void draw(const std::string& out, const Elasticity& regular, const Elasticity& irregular,
          double mu0, double Y) {
  io::make_directory(out);
  io::CsvFile csv(out + "/moduli.csv",
                  "angle_deg,shear_regular_uN_m,shear_irregular_uN_m,youngs_regular_uN_m,"
                  "youngs_irregular_uN_m");
  std::vector<double> angle, shear[2], youngs[2];
  for (int degrees = 0; degrees <= 180; degrees += 5) {
    angle.push_back(degrees);
    std::size_t k = 0;
    for (const auto* e : {&regular, &irregular}) {
      shear[k].push_back(e->turned(degrees).shear());
      youngs[k++].push_back(e->turned(degrees).youngs());
    }
    csv.row({angle.back(), shear[0].back(), shear[1].back(), youngs[0].back(), youngs[1].back()});
  }
  using enum io::Series::Style;
  const auto diagram = [&](const char* title, const std::vector<double>* values, double expected) {
    return io::Diagram{title,
                       "direction (degrees)",
                       std::string(title) + " (uN/m)",
                       {{"regular sheet", "#1f77b4", angle, values[0], {}, dots},
                        {"irregular sheet", "#c0392b", angle, values[1], {}, circles},
                        {"Eq. 21", "black", {0, 180}, {expected, expected}, {}, line}},
                       {0, 180},
                       {0, 1.6 * expected}};
  };
  io::replace_file(out + "/moduli.svg", io::draw_diagrams({diagram("shear modulus", shear, mu0),
                                                           diagram("Young's modulus", youngs, Y)}));
}

std::vector<Finding> moduli(const std::string& out) {
  const membrane::Moduli m = table_1();
  const double K = 2 * m.mu0 + m.k_a + m.k_d, Y = 4 * K * m.mu0 / (K + m.mu0);
  const Elasticity regular = elasticity(regular_sheet(8, 4, edge), m);
  const Elasticity irregular = elasticity(irregular_sheet(1500, edge, 1), m);
  draw(out, regular, irregular, m.mu0, Y);

  const char* source = "Eq. 21; K = 2 mu0 + k_a + k_d, Y = 4 K mu0/(K + mu0)";
  std::vector<Finding> found;
  for (const double angle : {0.0, 15.0, 45.0}) {
    const Elasticity e = regular.turned(angle);
    char head[64];
    std::snprintf(head, sizeof head, "regular sheet, %g degrees, ", angle);
    found.push_back({"moduli", std::string(head) + "shear modulus", e.shear(), m.mu0,
                     regular_tolerance * m.mu0, "uN/m", source});
    found.push_back({"moduli", std::string(head) + "Young's modulus", e.youngs(), Y,
                     regular_tolerance * Y, "uN/m", source});
  }
  found.push_back({"moduli", "regular sheet, area modulus", regular.area(), K,
                   regular_tolerance * K, "uN/m", source});
  const Spread shear = spread(irregular, shear_of), youngs = spread(irregular, youngs_of);
  found.push_back(printed("moduli", "irregular sheet, shear modulus, mean",
                          0.5 * (shear.least + shear.most), m.mu0, "uN/m", source));
  found.push_back(printed("moduli", "irregular sheet, Young's modulus, mean",
                          0.5 * (youngs.least + youngs.most), Y, "uN/m", source));
  found.push_back(
      printed("moduli", "irregular sheet, area modulus", irregular.area(), K, "uN/m", source));
  found.push_back({"moduli", "irregular sheet, shear modulus, spread over angles", shear.relative(),
                   0, isotropy, "", "isotropic"});
  found.push_back({"moduli", "irregular sheet, Young's modulus, spread over angles",
                   youngs.relative(), 0, isotropy, "", "isotropic"});
  return found;
}

}  // namespace

std::vector<Validation> moduli_validations() {
  return {{"moduli", "elasticity of flat sheets against Eq. 21", moduli}};
}

}  // namespace hemomag::app
