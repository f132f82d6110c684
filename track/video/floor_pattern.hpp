// The pattern of the container's floor, learned from the video and removed from its frames.
//
// The floor moves with the container, and the discs move over it. So in the container's frame of
// reference, the brightness at a point of the floor takes one value again and again; discs of
// different brightness scatter around it. The shortest interval with a third of the values gives
// the floor. Where a frame agrees with it, the frame is set to one level, so that only the discs
// remain. The pattern also shows where the container is: frames are registered to it.
//
// Discs of equal brightness that cover a point most of the time would be taken for the floor.
// Therefore the pattern is removed only if most frames contradict the discs that were found with
// it.
//
// A plain floor between dark and bright discs is removed by folding: |I − F| with the level F of
// the floor. It has the same edges, but all discs are bright.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "track/video/container_rim.hpp"

namespace swirl::tracking {

class FloorPattern {
  public:
    /// From frames with 8 bits per pixel, in which `rim` is found with the given reduction of their
    /// size. None if the floor is plain, or if too little of it is seen.
    static std::optional<FloorPattern> learned(const std::vector<cv::Mat>& images,
                                               const ContainerRim& rim, double reduction,
                                               unsigned threads);

    /// For frames with dark and bright discs: folds them at the commonest level inside the rim that
    /// is far from the darkest and the brightest.
    static FloorPattern folded(const std::vector<cv::Mat>& images, const ContainerRim& rim);

    bool folds() const { return fold_.has_value(); }

    /// Sets the floor of a frame to one level, or folds it. A frame without a rim stays as it is.
    void remove(cv::Mat& image) const;

  private:
    /// Calls use(row, column) for every pixel where the floor is known.
    template <typename Use>
    void for_each_known(Use&& use) const {
        for (int row = 0; row < known_.rows; ++row)
            for (int column = 0; column < known_.cols; ++column)
                if (known_.at<std::uint8_t>(row, column)) use(row, column);
    }
    /// Distance of a pixel from the container's centre.
    double distance(int row, int column) const;
    /// The container's centre in an image, from a value near it.
    Vec2 registered(const cv::Mat& image, const Vec2& centre) const;
    std::optional<Vec2> rim_centre(const cv::Mat& image) const;
    void learn(const std::vector<cv::Mat>& patches, unsigned threads);
    void leave_out_wall();
    std::vector<double> inner_levels() const;  // grey levels, where the floor is known
    bool patterned() const;
    double plain_level_for(const std::vector<cv::Mat>& patches) const;

    ContainerRim rim_;
    double reduction_ = 1.0;
    cv::Mat level_;  // 32-bit floats, in the container's frame of reference, centred
    cv::Mat slope_x_, slope_y_, slope_;  // slope of the level, per pixel, and their magnitude
    cv::Mat known_;                      // 8 bits: 255 where the floor is known
    double plain_level_ = 0.0;
    std::optional<double> fold_;
};

}  // namespace swirl::tracking
