#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemomag::magnetic {

/// What a steady field is multiplied with at time t: cos(2 pi (frequency t - phase)) times an
/// envelope. Between -1 and 1, so that the field without the factor is the strongest.
struct TimeFactor {
  enum class Envelope { constant, ramp, pulse };

  double frequency = 0;  ///< turns per time; 0 with phase 0: steady
  double phase = 0;      ///< in turns; 1/4 makes the cosine a sine
  Envelope envelope = Envelope::constant;
  double start = 0;   ///< of the ramp or pulse
  double length = 1;  ///< of the ramp or pulse, > 0

  /// ramp: from 0 at start to 1 at start + length; pulse: 1 in [start, start + length), else 0.
  double at(double t) const {
    const double since = (t - start) / length;
    const double size = envelope == Envelope::constant ? 1
                        : envelope == Envelope::ramp   ? std::clamp(since, 0.0, 1.0)
                        : since >= 0 && since < 1      ? 1
                                                       : 0;
    // The turns are reduced first: t grows to millions of steps.
    const double turns = std::remainder(frequency * t - phase, 1.0);
    return size * std::cos(2 * std::numbers::pi * turns);
  }

  bool oscillates() const { return frequency != 0; }
  bool steady() const { return !oscillates() && phase == 0 && envelope == Envelope::constant; }
};

}  // namespace hemomag::magnetic
