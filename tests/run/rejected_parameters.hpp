// The message for parameters that are rejected.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

/// "" if resolve() accepts them.
inline std::string error_of(const ParameterTexts& given) {
    try {
        resolve(given);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

inline void expect_rejected(const ParameterTexts& texts, const std::string& says) {
    EXPECT_THAT(error_of(texts), testing::HasSubstr(says));
}

}  // namespace swirl
