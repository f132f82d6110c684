#include "swirl/run/failure.hpp"

namespace swirl {

void throw_usage_error(const std::string& sentence) { throw UsageError(sentence); }
void throw_interrupted(const std::string& sentence) { throw Interrupted(sentence); }

}  // namespace swirl
