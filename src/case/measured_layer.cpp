#include "case/measured_layer.hpp"

#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "base/error.hpp"

namespace hemomag::case_ {
namespace {

constexpr int samples = 200;  // of the layer, in the whole run

std::string seconds(double s) {
  std::ostringstream text;
  text.precision(12);
  text << s << " s";
  return text.str();
}

}  // namespace

Case cells_alone(const Case& c) {
  const double duration = c.analysis.layer_run;
  Case alone = c;
  alone.title = c.title + ": the cells alone";
  alone.carriers.clear();
  alone.magnetic = {};
  alone.analysis.measured = false;
  alone.analysis.average_from = duration / 2;
  alone.run = {duration, std::nullopt, c.run.checkpoint};
  alone.output = {std::nullopt, std::nullopt, std::nullopt, duration / samples};

  toml::table text = toml::parse(c.text);
  text.insert_or_assign("title", alone.title);
  text.erase("carrier");
  text.erase("magnetic");
  toml::table analysis{{"average_from", seconds(duration / 2)}};
  if (const auto walls = text["analysis"]["walls"].value<std::string>())
    analysis.insert("walls", *walls);
  text.insert_or_assign("analysis", analysis);
  text.insert_or_assign("run", toml::table{{"time", seconds(duration)}});
  text.insert_or_assign("output", toml::table{{"fields", "never"},
                                              {"series", "never"},
                                              {"cells", "never"},
                                              {"profiles", seconds(duration / samples)}});
  std::ostringstream out;
  out << text << "\n";
  alone.text = out.str();
  return alone;
}

double layer_of(const std::string& path) {
  std::ifstream file(path);
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  const nlohmann::json::json_pointer layer("/profiles/layer_um");
  if (summary.is_discarded() || !summary.contains(layer) || !summary[layer].is_number())
    throw Error(path + ": has no measured layer");
  return summary[layer].get<double>() * 1e-6;
}

}  // namespace hemomag::case_
