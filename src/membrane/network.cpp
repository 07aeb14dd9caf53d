#include "membrane/network.hpp"

namespace hemomag::membrane {
namespace {

/// Repeat the last element until the arrays are whole groups long.
template <class... Arrays> void pad(Arrays&... arrays) {
  const auto fill = [](auto& array) {
    while (array.size() % static_cast<std::size_t>(list_padding) != 0)
      array.push_back(array.back());
  };
  (fill(arrays), ...);
}

/// The same kernel for each level.
template <class Kernel, class Args>
auto at_level(SimdLevel level, Kernel sse2, Kernel avx2, Kernel avx512, const Args& args) {
  return (level == SimdLevel::avx512 ? avx512 : level == SimdLevel::avx2 ? avx2 : sse2)(args);
}

const double* numbers(std::span<const Vec3> vectors) { return &vectors.data()->x; }
double* numbers(std::span<Vec3> vectors) { return &vectors.data()->x; }

}  // namespace

void EdgeList::clear() {
  for (auto* array : {&l_max_, &wlc_, &k_p_}) array->clear();
  for (auto& array : vertex_) array.clear();
  runs_.clear();
}

void EdgeList::add(int i, int j, const Spring& spring) {
  if (runs_.empty() || runs_.back().m != spring.m) {
    finish();
    runs_.push_back({l_max_.size(), 0, spring.m});
  }
  vertex_[0].push_back(i);
  vertex_[1].push_back(j);
  l_max_.push_back(spring.l_max);
  wlc_.push_back(spring.wlc);
  k_p_.push_back(spring.k_p);
  ++runs_.back().count;
}

void EdgeList::finish() { pad(vertex_[0], vertex_[1], l_max_, wlc_, k_p_); }

std::ptrdiff_t EdgeList::add_forces(std::span<const Vec3> x_v, std::span<Vec3> f_v,
                                    SimdLevel level) const {
  std::ptrdiff_t overstretched = -1;
  for (const Run& run : runs_) {
    const EdgeArgs args{numbers(x_v),
                        numbers(f_v),
                        {vertex_[0].data(), vertex_[1].data()},
                        l_max_.data(),
                        wlc_.data(),
                        k_p_.data(),
                        run.m,
                        static_cast<std::ptrdiff_t>(run.begin),
                        static_cast<std::ptrdiff_t>(run.count)};
    const auto first =
        at_level(level, sse2::edge_forces, avx2::edge_forces, avx512::edge_forces, args);
    if (overstretched < 0) overstretched = first;
  }
  return overstretched;
}

void TriangleList::clear() {
  for (auto& array : vertex_) array.clear();
  for (auto& array : unwrap_) array.clear();
  k_d_.clear();
  area0_.clear();
  cells_.clear();
}

void TriangleList::start_cell() {
  finish();
  cells_.push_back({k_d_.size(), 0});
}

void TriangleList::add(const std::array<int, 3>& vertices, const Vec3& unwrap, double k_d,
                       double area0) {
  for (std::size_t d = 0; d < 3; ++d) {
    vertex_[d].push_back(vertices[d]);
    unwrap_[d].push_back(unwrap[d]);
  }
  k_d_.push_back(k_d);
  area0_.push_back(area0);
  ++cells_.back().count;
}

void TriangleList::finish() {
  pad(vertex_[0], vertex_[1], vertex_[2], unwrap_[0], unwrap_[1], unwrap_[2], k_d_, area0_);
}

TriangleArgs TriangleList::arguments(std::size_t cell, std::span<const Vec3> x_v) const {
  TriangleArgs args{};
  args.x = numbers(x_v);
  for (std::size_t d = 0; d < 3; ++d) {
    args.vertex[d] = vertex_[d].data();
    args.unwrap[d] = unwrap_[d].data();
  }
  args.k_d = k_d_.data();
  args.area0 = area0_.data();
  args.begin = static_cast<std::ptrdiff_t>(cells_[cell].begin);
  args.count = static_cast<std::ptrdiff_t>(cells_[cell].count);
  return args;
}

CellGeometry TriangleList::geometry(std::size_t cell, std::span<const Vec3> x_v,
                                    SimdLevel level) const {
  return at_level(level, sse2::cell_geometry, avx2::cell_geometry, avx512::cell_geometry,
                  arguments(cell, x_v));
}

void TriangleList::add_forces(std::size_t cell, const Pull& pull, std::span<const Vec3> x_v,
                              std::span<Vec3> f_v, SimdLevel level) const {
  TriangleArgs args = arguments(cell, x_v);
  args.f = numbers(f_v);
  args.area_pull = pull.area;
  args.volume_pull = pull.volume;
  at_level(level, sse2::triangle_forces, avx2::triangle_forces, avx512::triangle_forces, args);
}

double TriangleList::bytes() const {
  return static_cast<double>(k_d_.capacity() * (3 * sizeof(int) + 5 * sizeof(double)));
}

void HingeList::clear() {
  for (auto* array : {&k_b_, &sine0_, &cosine0_}) array->clear();
  for (auto& array : vertex_) array.clear();
  count_ = 0;
}

void HingeList::add(const std::array<int, 4>& vertices, const Bending& bending) {
  for (std::size_t k = 0; k < 4; ++k) vertex_[k].push_back(vertices[k]);
  k_b_.push_back(bending.k_b);
  sine0_.push_back(bending.sine0);
  cosine0_.push_back(bending.cosine0);
  ++count_;
}

void HingeList::finish() {
  pad(vertex_[0], vertex_[1], vertex_[2], vertex_[3], k_b_, sine0_, cosine0_);
}

void HingeList::add_forces(std::span<const Vec3> x_v, std::span<Vec3> f_v, SimdLevel level) const {
  HingeArgs args{numbers(x_v),  numbers(f_v),    {}, k_b_.data(),
                 sine0_.data(), cosine0_.data(), 0,  static_cast<std::ptrdiff_t>(count_)};
  for (std::size_t k = 0; k < 4; ++k) args.vertex[k] = vertex_[k].data();
  at_level(level, sse2::hinge_forces, avx2::hinge_forces, avx512::hinge_forces, args);
}

}  // namespace hemomag::membrane
