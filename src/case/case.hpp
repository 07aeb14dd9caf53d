#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "case/vessel.hpp"
#include "lattice/field_table.hpp"
#include "lattice/surface.hpp"

// A case as the user means it, in SI units, checked key by key. What the keys mean:
// docs/case_file.md.

namespace hemomag::case_ {

enum class Boundary { periodic, plates, tube, voxels };
enum class Plates { lower_rest, symmetric };
enum class Placement { random, grid, compress, grow, file };  // from compress on: all alike
enum class Hinges { rest, flat };
enum class CellKind { rbc, platelet, white };
enum class StressFree { rest_shape, sphere };
enum class CarrierKind { particle, worm };
enum class Repulsion { soft, paper };
enum class CarrierContact { vertices, surface };
enum class FieldKind { uniform, gradient, quadrupole, rotating, magnet, coil, wire, table };
enum class MagnetShape { block, cylinder };
enum class CoilPair { none, same, opposite };
enum class TimeCourse { constant, sine, ramp, pulse };
enum class LayerWalls { lower, both, vessel };

struct Channel {
  std::array<double, 3> size{};  ///< [m]; y is the flow direction, z between the plates
  Boundary boundary = Boundary::plates;
  Plates plates = Plates::lower_rest;
  double shear_rate = 0;                ///< [1/s], along +y
  std::array<double, 3> body_force{};   ///< [N/m3]; a single value in the file acts along `axis`
  std::optional<double> mean_velocity;  ///< [m/s] along `axis`, held by an adjusted body force
  int axis = 1;                         ///< the flow's: y, but a tube or voxels may choose
  double diameter = 0;                  ///< [m], tube
  std::string geometry;                 ///< path of the surface file, voxels
  double geometry_unit = 0;             ///< [m], what one unit of that file is
};

struct Fluid {
  double viscosity = 0;   ///< [Pa s]
  double density = 1000;  ///< [kg/m3]
};

struct Numerics {
  double dx = 0;  ///< [m]
  double tau = 1.0;
  std::optional<double> cell_reynolds;  ///< inertia scaling; empty: the real density
  std::optional<double> dt;             ///< [s]; excludes cell_reynolds
  std::string scheme = "trt";           ///< trt, bgk, exponential
  std::string precision = "double";     ///< of the populations: double, single
  std::string kernel = "cosine4";       ///< cosine4, peskin4, roma3, linear2
};

struct Cell {
  CellKind kind = CellKind::rbc;
  double diameter = 7.82e-6;  ///< [m]
  double thickness = 0;       ///< [m], platelet
  int vertices = 642;
  std::string mesh;                                 ///< path of a user's own surface, or empty
  double mesh_unit = 0;                             ///< [m], what one unit of that file is
  std::shared_ptr<const lattice::Surface> surface;  ///< what it holds (read_cell_surface)
  StressFree stress_free = StressFree::rest_shape;
  std::optional<double> hematocrit;
  std::optional<int> count;
  Placement placement = Placement::random;
  std::string packed;  ///< path of the packed state, placement = { file = ... }
  Hinges hinges = Hinges::rest;
  double shear_modulus = 6.3e-6;         ///< mu0 [N/m]
  double area_modulus_local = 2.31e-4;   ///< k_d [N/m]
  double area_modulus_global = 4.72e-6;  ///< k_a [N/m]
  double volume_modulus = 249;           ///< k_v [N/m2]
  double bending_modulus = 5e-19;        ///< k_b of Eq. 20 [J]
  double stretch_ratio = 1 / 2.2;        ///< x0 = l0/l_max
};

struct Carrier {
  CarrierKind kind = CarrierKind::particle;
  int count = 0;
  int beads = 32;              ///< of a worm
  double stretching = 6.3e-4;  ///< k of U = k (l - l0)^2 [N/m], worm
  double bending = 4.14e-20;   ///< kappa of U = kappa (theta - theta0)^2 [J], worm
  double radius = 0;           ///< [m]
  double susceptibility = 0.4;
  double magnetic_fraction = 0.6;
  double saturation_magnetisation = 0;  ///< [A/m] of the magnetic part; 0: linear
  std::optional<double> density;        ///< [kg/m3]; without it there is no inertia
  bool feedback = true;
};

struct Contact {
  double morse_depth = 0.04;         ///< [kBT] per vertex pair at 3286 vertices
  double morse_beta = 3.84e6;        ///< [1/m]
  double morse_r0 = 0.5e-6;          ///< [m]
  double morse_cutoff = 1.5e-6;      ///< [m]
  std::optional<double> cell_sigma;  ///< [m]; default 0.6 x longest rest edge, at least 0.25 um
  CarrierContact carrier_contact = CarrierContact::vertices;
  double carrier_sigma = 0.5e-6;    ///< [m], vertices
  double surface_range = 0.25e-6;   ///< [m], surface
  double surface_stiffness = 5e-5;  ///< [N/m], surface
  double epsilon = 1.0;             ///< [kBT] at 3286 vertices
  double plate_sigma = 0.25e-6;     ///< [m]
  Repulsion repulsion = Repulsion::soft;
  double repulsion_kappa = 30;  ///< of the soft one
};

/// One of the fields that add up; which of its values count depends on the kind.
struct MagneticSource {
  std::string key = "magnetic";  ///< path of its table in the case file
  FieldKind field = FieldKind::gradient;
  double B0 = 0.05;                ///< [T]
  Vec3 axis{0, 0, 1};              ///< of length one
  std::string plane = "yz";        ///< two axes: of a quadrupole, and from which to which B rotates
  std::optional<double> gradient;  ///< [T/m]; else B0 (1 - z/H) with the pull down
  std::array<double, 3> zero_at{};   ///< [m], where an explicit gradient's field vanishes
  std::array<double, 3> position{};  ///< [m], of a body, or of a table's origin
  MagnetShape shape = MagnetShape::block;
  std::array<double, 3> size{};  ///< [m], edges of a block
  Vec3 across{1, 0, 0};          ///< of a block's first edge
  double diameter = 0;           ///< [m], of a cylinder or coil
  double length = 0;             ///< [m], of a cylinder
  double remanence = 0;          ///< [T]
  Vec3 magnetisation{0, 0, 1};   ///< direction, of a block
  double current = 0;            ///< [A], of a coil times its turns, or of a wire
  CoilPair pair = CoilPair::none;
  double distance = 0;                               ///< [m], between the coils of a pair
  std::string file;                                  ///< path of a table
  std::shared_ptr<const lattice::FieldTable> table;  ///< what it holds
  TimeCourse time = TimeCourse::constant;
  double frequency = 0;  ///< [Hz], of a rotating field or a sine
  double start = 0;      ///< [s], of a ramp or pulse
  double duration = 0;   ///< [s], of a ramp or pulse
};

struct Magnetic {
  std::vector<MagneticSource> sources;  ///< empty: no field
  bool dipoles = true;
};

struct Analysis {
  double layer = 2.8e-6;   ///< [m]
  bool measured = false;   ///< the layer comes from a run of the cells alone (measured_layer.hpp)
  double layer_run = 0.2;  ///< [s], of that run
  LayerWalls walls = LayerWalls::lower;
  double average_from = 0;  ///< [s]
};

struct Run {
  std::optional<double> time;  ///< [s]
  std::optional<long> steps;
  std::optional<double> checkpoint = 600;  ///< [s] of wall time; empty: never between
};

struct Output {
  std::optional<double> fields;         ///< [s]; empty: never
  std::optional<double> series = 1e-3;  ///< [s]; empty: never
  std::optional<double> cells;          ///< [s]; empty: never
  std::optional<double> profiles;       ///< [s]; empty: never
};

struct Case {
  std::string title;
  std::uint64_t seed = 1;
  Channel channel;
  VesselOnGrid vessel;  ///< make_vessel of the rest
  Fluid fluid;
  Numerics numerics;
  std::vector<Cell> cells;
  std::vector<Carrier> carriers;
  Contact contact;
  Magnetic magnetic;
  Analysis analysis;
  Run run;
  Output output;
  std::string text;  ///< the file as read, overrides applied, to be kept with the run
  std::string file;  ///< its name
  std::map<std::string, std::string> positions;  ///< FILE:LINE:COL of every key, or "--set"
};

/// Where a key stands in the file, or its table if it is not given: "FILE:LINE:COL: key", the head
/// of an error message. Entries of a list are numbered from 0 when there are several: cell.1.count.
std::string position(const Case& c, std::string key);

/// The path of entry k of `count` [[name]] entries.
std::string entry_path(const char* name, std::size_t k, std::size_t count);

/// Whether the fluid fills a tube or the inside of a surface.
inline bool in_vessel(const Case& c) {
  return c.channel.boundary == Boundary::tube || c.channel.boundary == Boundary::voxels;
}

/// Whether the cells are packed, or were, rather than put one by one.
inline bool is_packed(const Case& c) {
  return !c.cells.empty() && c.cells[0].placement >= Placement::compress;
}

}  // namespace hemomag::case_
