#include "swirl/run/message.hpp"

#include <fmt/format.h>

#include <utility>

namespace swirl {
namespace {

/// "a, b or c"
std::string joined(std::string words) {
    const std::size_t last = words.rfind('\n');
    if (last == words.npos) return words;
    words.replace(last, 1, " or ");
    for (std::size_t at; (at = words.find('\n')) != words.npos;) words.replace(at, 1, ", ");
    return words;
}

std::string english_of(const MessageValue& value) {
    switch (value.kind) {
        case MessageValue::Kind::phrase:
            return value.phrase.front().english();
        case MessageValue::Kind::words:
            return joined(value.text);
        case MessageValue::Kind::number:
        case MessageValue::Kind::text:
            break;
    }
    return value.text;
}

/// What stands for "{name}" or "{name|one|several}", without the braces.
std::string filled(std::string_view place, const std::vector<MessageValue>& values) {
    const std::size_t bar = place.find('|');
    for (const MessageValue& value : values) {
        if (place.substr(0, bar) != value.name) continue;
        const std::string text = english_of(value);
        if (bar == place.npos) return text;
        const std::size_t second = place.find('|', bar + 1);
        return std::string(text == "1" ? place.substr(bar + 1, second - bar - 1)
                                       : place.substr(second + 1));
    }
    return fmt::format("{{{}}}", place);
}

}  // namespace

MessageValue::MessageValue(const char* name_, double value)
    : name(name_), kind(Kind::number), text(fmt::format("{}", value)) {}
MessageValue::MessageValue(const char* name_, std::int64_t value)
    : name(name_), kind(Kind::number), text(fmt::format("{}", value)) {}
MessageValue::MessageValue(const char* name_, std::uint64_t value)
    : name(name_), kind(Kind::text), text(fmt::format("{}", value)) {}
MessageValue::MessageValue(const char* name_, std::string_view value)
    : name(name_), kind(Kind::text), text(value) {}
MessageValue::MessageValue(const char* name_, const char* value)
    : MessageValue(name_, std::string_view(value)) {}
MessageValue::MessageValue(const char* name_, const std::string& value)
    : MessageValue(name_, std::string_view(value)) {}
MessageValue::MessageValue(const char* name_, const std::vector<std::string>& value)
    : name(name_), kind(Kind::words) {
    for (const std::string& word : value) text += (text.empty() ? "" : "\n") + word;
}
MessageValue::MessageValue(const char* name_, const Message& phrase_)
    : name(name_), kind(Kind::phrase), phrase{phrase_} {}

MessageValue rounded(const char* name, double value, int digits) {
    MessageValue shown(name, value);
    shown.text = fmt::format("{:.{}g}", value, digits);
    return shown;
}

MessageValue with_decimals(const char* name, double value, int decimals) {
    MessageValue shown(name, value);
    shown.text = fmt::format("{:.{}f}", value, decimals);
    return shown;
}

Message::Message(Code code, std::initializer_list<MessageValue> values)
    : parts_{{code.sentence(), values}} {}

Message& Message::operator+=(const Message& further) {
    parts_.insert(parts_.end(), further.parts_.begin(), further.parts_.end());
    return *this;
}

std::string Message::english() const {
    std::string text;
    for (const auto& [sentence, values] : parts_) {
        std::string_view rest = sentence.english;
        for (std::size_t open; (open = rest.find('{')) != rest.npos;) {
            const std::size_t close = rest.find('}', open);
            text += rest.substr(0, open);
            text += filled(rest.substr(open + 1, close - open - 1), values);
            rest.remove_prefix(close + 1);
        }
        text += rest;
    }
    return text;
}

}  // namespace swirl
