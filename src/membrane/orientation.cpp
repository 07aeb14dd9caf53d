#include "membrane/orientation.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace hemomag::membrane {

std::vector<char> triangles_to_turn(std::span<const std::array<std::int64_t, 3>> triangles) {
  struct Side {
    std::size_t triangle;
    bool forward;  // runs from the smaller id to the larger
  };
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      edges[std::minmax(a, b)].push_back({t, a < b});
    }
  struct Link {
    std::size_t other;
    bool agree;
  };
  std::vector<std::vector<Link>> links(triangles.size());
  for (const auto& [edge, sides] : edges)
    if (sides.size() == 2) {
      const bool agree = sides[0].forward != sides[1].forward;
      links[sides[0].triangle].push_back({sides[1].triangle, agree});
      links[sides[1].triangle].push_back({sides[0].triangle, agree});
    }

  std::vector<char> turned(triangles.size(), 0), seen(triangles.size(), 0);
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> surface{first};
    seen[first] = 1;
    for (std::size_t next = 0; next < surface.size(); ++next)
      for (const auto& link : links[surface[next]])
        if (!seen[link.other]) {
          seen[link.other] = 1;
          turned[link.other] = link.agree ? turned[surface[next]] : !turned[surface[next]];
          surface.push_back(link.other);
        }
    const auto count =
        std::count_if(surface.begin(), surface.end(), [&](std::size_t t) { return turned[t]; });
    if (2 * static_cast<std::size_t>(count) > surface.size())
      for (const std::size_t t : surface) turned[t] = !turned[t];
  }
  return turned;
}

}  // namespace hemomag::membrane
