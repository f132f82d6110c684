// Where things stand in the HDF5 files of this program: frames as H5MD has them (trajectory.hpp),
// and beside them what belongs to no frame.
#pragma once

#include <string>

namespace swirl::h5md {

inline const std::string particles = "/particles/trajectory";
inline const std::string observables = "/observables";
inline const std::string parameters = "/parameters";

}  // namespace swirl::h5md
