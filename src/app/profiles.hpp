#pragma once
#include <string>

namespace hemomag::app {

/// `hemomag profiles DIR`: hematocrit, velocity and the cell-free layer of a run between plates
/// from its 3-D snapshots, as fix hemo/profiles finds them during a run; written to
/// DIR/profiles_of_fields.csv and layer_of_fields.csv. Rank 0 works alone.
/// @param from  [s], where the average begins
/// @return 0, 2 when there is nothing to read, 4 when it cannot be read or written
int profiles(const std::string& directory, double from);

}  // namespace hemomag::app
