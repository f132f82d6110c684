// The median of many numbers, which a few outliers do not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace swirl {

/// The median; of two middle numbers the larger one; 0 if there are no numbers.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace swirl
