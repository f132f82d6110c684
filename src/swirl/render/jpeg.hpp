// Encodes an image as a baseline JPEG file (ITU-T T.81, JFIF 1.02) in memory, without a library:
// colour without subsampling, the standard's example tables.
#pragma once

#include <cstdint>
#include <string>

#include "swirl/render/canvas.hpp"

namespace swirl {

/// `rgb`: three bytes per pixel, rows from the top. `quality` from 1 to 100, as in libjpeg.
std::string jpeg_of(const std::uint8_t* rgb, Size size, int quality);

}  // namespace swirl
