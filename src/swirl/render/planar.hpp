// Converts the pixels that cairo draws to the planes that video encoders take.
//
// Y'CbCr 4:2:0 according to Rec. ITU-R BT.709, limited range. For R'G'B' from 0 to 255:
//
//     Y  = 16 + 0.2126·219/255 R + 0.7152·219/255 G + 0.0722·219/255 B
//     Cb = 128 + 224/255 (B − Y')/1.8556        Cr = 128 + 224/255 (R − Y')/1.5748
//
// This is computed in 16-bit fixed point. The chroma of 2 × 2 pixels is that of their mean. The
// threads that draw frames convert them, so all cores share this work, and 2.7 times fewer bytes
// flow to the encoder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "swirl/render/canvas.hpp"

namespace swirl {

/// Number of bytes of one frame. Both sides of `size` must be even.
std::size_t planar_bytes(Size size);

/// `pixels` come from Canvas::pixels(). `planes` receives Y, Cb and Cr, one after the other.
void to_planar(std::span<const std::uint8_t> pixels, Size size, std::vector<std::uint8_t>& planes);

}  // namespace swirl
