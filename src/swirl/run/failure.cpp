#include "swirl/run/failure.hpp"

namespace swirl {

void throw_wrong_call(const std::string& sentence) { throw UsageError(sentence); }
void throw_interrupted(const std::string& sentence) { throw Interrupted(sentence); }

}  // namespace swirl
