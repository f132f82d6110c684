#include "swirl/run/failure.hpp"

namespace swirl {

void throw_usage_error(const Message& message) { throw UsageError(message); }
void throw_usage_error(const std::string& sentence) { throw UsageError(sentence); }
void throw_interrupted(const std::string& sentence) { throw Interrupted(sentence); }

Message without_code(const std::string& sentence) { return {"without_code", {{"text", sentence}}}; }

}  // namespace swirl
