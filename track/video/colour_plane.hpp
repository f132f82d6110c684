// Grey frames in which discs of all colours are equally bright.
//
// Grey is a poor guide if the discs have several colours: yellow discs on a dark floor are bright,
// and red ones hardly differ from the floor. The level of a pixel is therefore the share of the way
// from the floor's colour F to that of a disc, C: (c − F)·(C − F)/|C − F|², the largest over all
// colours C. It is 0 on the floor and 1 on each disc, and linear across an edge, so edges stay in
// their places.
//
//   floor    the commonest colour in the container
//   discs    the other colours, as directions from the floor's: light and texture change the
//            distance from F more than the direction
//
// Cameras record colours less sharply than grey. So a plane is proposed only if grey shows one of
// the colours with much less contrast than the colours do.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace swirl::tracking {

class ColourPlane {
  public:
    /// From colours (red, green, blue) of pixels inside the container. None if grey is as good.
    static std::optional<ColourPlane> proposed(const std::vector<cv::Vec3b>& pixels);

    /// `rgb` has three channels of 8 bits, and `grey` gets one.
    void project(const cv::Mat& rgb, cv::Mat& grey) const;

    std::size_t number_of_colours() const { return directions_.size(); }

  private:
    cv::Vec3d floor_;
    std::vector<cv::Vec3d> directions_;  // (C − F)/|C − F|²
};

/// True if so few pixels have a colour that the video shows shades of grey.
bool is_grey(const std::vector<cv::Vec3b>& pixels);

}  // namespace swirl::tracking
