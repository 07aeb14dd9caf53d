#pragma once

namespace hemomag::solver {

/// Holds the mean velocity of the fluid along one axis by a uniform body force, with a proportional
/// and an integral part. Without the drag of walls and cells the mean velocity obeys du/dt = g and
/// the controlled one is critically damped with the rate 1/response; drag only damps it more, and
/// the integral part takes the drag up, so that no error remains in steady flow. Lattice units.
class FlowController {
public:
  /// @param target  mean velocity
  /// @param force   body force density to start from
  FlowController(double target, double force) : target_(target), integral_(force) {}

  /// The body force for the next `steps` steps, from the present mean velocity.
  double force(double mean_velocity, int steps) {
    const double error = target_ - mean_velocity;
    integral_ += error * steps / (response * response);
    return integral_ + 2 * error / response;
  }

  /// What is remembered from one call to the next: the integral part of the force.
  double integral() const { return integral_; }
  void set_integral(double integral) { integral_ = integral; }

  static constexpr double response = 200;  ///< time steps

private:
  double target_;
  double integral_;
};

}  // namespace hemomag::solver
