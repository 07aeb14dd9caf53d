#include <cstdio>

#include <nlohmann/json.hpp>

#include "app/bench.hpp"
#include "app/timing.hpp"
#include "magnetic/field.hpp"

namespace hemomag::app {
namespace {

using magnetic::Frame;

lattice::FieldTable table_of(const magnetic::BlockMagnet& magnet) {
  constexpr std::size_t n = 40;
  lattice::FieldTable table{{n, n, n}, {0, 0, 0}, {1, 1, 1}, {}};
  for (std::size_t k = 0; k < n * n * n; ++k) {
    const std::size_t x = k % n, y = k / n % n, z = k / n / n;
    table.B.push_back(
        magnet({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}).B);
  }
  return table;
}

struct Kind {
  const char* name;
  magnetic::Field field;
  std::vector<double> ns = {};
};

}  // namespace

void bench_field(bool json) {
  const Frame below = Frame::along({20, 20, -30}, {0.1, 0.2, 1});
  const magnetic::BlockMagnet block{below, {15, 20, 25}, {0.1, 0, 1}};
  std::vector<Kind> kinds;
  const auto add = [&](const char* name, magnetic::Shape shape) {
    kinds.push_back({name, magnetic::Field({{std::move(shape), {}}})});
  };
  add("gradient", magnetic::AxialGradient{2, 0.1, 40});
  add("wire", magnetic::StraightWire{below, 1});
  add("coil", magnetic::CurrentLoop{below, 20, 1});
  add("cylinder", magnetic::CylinderMagnet{below, 20, 25, 1});
  add("block", block);
  add("table", magnetic::TableField(table_of(block), {0, 0, 0}, 1, 1));
  constexpr int places = 100'000;
  std::vector<Vec3> x;
  for (int k = 1; k <= places; ++k) {
    const auto share = [&](double step) { return 39 * std::fmod(k * step, 1.0); };
    x.push_back({share(0.7548776662), share(0.5698402910), share(0.4301597090)});
  }
  double checksum = 0;  // keeps the work from being left out
  for (int r = 0; r <= repetitions; ++r)
    for (Kind& kind : kinds) {
      const double seconds = timed([&] {
        for (const Vec3& p : x) checksum += gradient_norm(kind.field(p));
      });
      if (r > 0) kind.ns.push_back(seconds / places * 1e9);
    }
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0 || checksum == 0) return;
  for (const Kind& kind : kinds)
    if (json)
      std::printf(
          "%s\n",
          nlohmann::ordered_json{{"case", "field"}, {"source", kind.name}, {"ns", median(kind.ns)}}
              .dump()
              .c_str());
    else
      std::printf("field %-8s: %4.0f ns for B and its gradient at a place\n", kind.name,
                  median(kind.ns));
}

}  // namespace hemomag::app
