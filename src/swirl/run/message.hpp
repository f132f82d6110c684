// An error message apart from its language: the codes of its sentences, and the values in them. The
// program prints it in English (sentences.hpp); the browser page has other languages, too.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/sentences.hpp"

namespace swirl {

/// Not constexpr, so a call at compile time is an error.
void there_is_no_sentence_with_this_code();

/// The sentence of a code. A code that is not in the table does not compile.
class Code {
  public:
    consteval Code(const char* code) : sentence_{} {
        for (const Sentence& each : sentences)
            if (std::string_view(each.code) == code) sentence_ = each;
        if (sentence_.code == nullptr) there_is_no_sentence_with_this_code();
    }
    const Sentence& sentence() const { return sentence_; }

  private:
    // A copy: a program contains the sentences that it uses, not the table.
    Sentence sentence_;
};

class Message;

/// A value in a sentence: a number, a text that is the same in each language (such as the name of
/// an option, or what the user wrote), words of which one is to be chosen, or a phrase.
struct MessageValue {
    enum class Kind { number, text, words, phrase };

    MessageValue(const char* name, double value);
    MessageValue(const char* name, std::int64_t value);
    /// A text, because 64 bits are more than a number of JavaScript has.
    MessageValue(const char* name, std::uint64_t value);
    MessageValue(const char* name, std::string_view value);
    MessageValue(const char* name, const char* value);
    MessageValue(const char* name, const std::string& value);
    MessageValue(const char* name, const std::vector<std::string>& value);
    MessageValue(const char* name, const Message& phrase);

    const char* name;
    Kind kind;
    std::string text;             // words are separated by line breaks
    std::vector<Message> phrase;  // one, if it is a phrase
};

/// A number with this many digits in all, or after the point.
MessageValue rounded(const char* name, double value, int digits);
MessageValue with_decimals(const char* name, double value, int decimals);

class Message {
  public:
    struct Part {
        Sentence sentence;
        std::vector<MessageValue> values;
    };

    Message(Code code, std::initializer_list<MessageValue> values = {});
    /// Appends a sentence, such as a hint.
    Message& operator+=(const Message& further);
    friend Message operator+(Message first, const Message& further) { return first += further; }

    const std::vector<Part>& parts() const { return parts_; }
    std::string english() const;
    operator std::string() const { return english(); }

  private:
    std::vector<Part> parts_;
};

}  // namespace swirl
