// Writes the page's JSON with the same keys as the command line's (run/json.hpp). The library used
// there is too large for a page.
#pragma once

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "swirl/measure/measurement_report.hpp"
#include "swirl/run/message.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// A JSON number; null if it is not finite.
inline std::string number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : "null"; }

inline std::string json_text(std::string_view text) {
    std::string json = "\"";
    for (const char c : text) {
        if (c == '\n') {
            json += "\\n";
            continue;
        }
        if (c == '"' || c == '\\') json += '\\';
        json += c;
    }
    return json + '"';
}

/// Members in the order of addition; values are JSON texts.
class JsonObject {
  public:
    JsonObject& add(std::string_view name, std::string_view value) {
        text_ += fmt::format("{}{}:{}", text_.empty() ? "" : ",", json_text(name), value);
        return *this;
    }
    JsonObject& add(std::string_view name, double value) { return add(name, number(value)); }
    /// Adds all members of another object.
    JsonObject& add(const JsonObject& other) {
        text_ += (text_.empty() || other.text_.empty() ? "" : ",") + other.text_;
        return *this;
    }
    std::string text() const { return '{' + text_ + '}'; }

  private:
    std::string text_;
};

/// The sentences of a message: [{"code": "not_a_number", "values": {"name": "--mu", "text": "x"}}]
inline std::string sentences_json(const Message& message);

inline std::string value_json(const MessageValue& value) {
    switch (value.kind) {
        case MessageValue::Kind::phrase:
            return sentences_json(value.phrase.front());
        case MessageValue::Kind::words:
            return JsonObject().add("words", json_text(value.text)).text();
        case MessageValue::Kind::number:
            // "inf" is no number of JSON.
            if (std::isdigit(static_cast<unsigned char>(value.text.back()))) return value.text;
            break;
        case MessageValue::Kind::text:
            break;
    }
    return json_text(value.text);
}

inline std::string sentences_json(const Message& message) {
    std::string json;
    for (const auto& [sentence, values] : message.parts()) {
        JsonObject filled;
        for (const MessageValue& value : values) filled.add(value.name, value_json(value));
        json += json.empty() ? "" : ",";
        json +=
            JsonObject().add("code", json_text(sentence.code)).add("values", filled.text()).text();
    }
    return '[' + json + ']';
}

/// The sentences with their English text, which is that of the command line.
inline std::string message_json(const Message& message) {
    return JsonObject()
        .add("text", json_text(message.english()))
        .add("sentences", sentences_json(message))
        .text();
}

inline std::string estimate_json(const Estimate& e) {
    return JsonObject()
        .add("mean", e.mean)
        .add("error", e.error)
        .add("effective_samples", e.effective_samples)
        .add("blocks", double(e.blocks))
        .text();
}

inline std::string row_json(const ReportRow& row) {
    if (!row.has_error) return number(row.estimate.mean);
    std::string json = estimate_json(row.estimate);
    json.pop_back();
    for (const ReportDetail& detail : row.details)
        json += fmt::format(",{}:{}", json_text(detail.name), number(detail.value));
    return json + '}';
}

/// Adds the columns of a table to an object.
inline void add_table(JsonObject& json, const ReportTable& table) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        std::string column;
        for (std::size_t r = 0; r < table.rows(); ++r)
            column += (r ? "," : "") + number(table.at(r, c));
        json.add(table.columns[c].name, '[' + column + ']');
    }
}

inline std::string report_json(const Report& report) {
    JsonObject json;
    for (const ReportRow& row : report.rows) json.add(row.name, row_json(row));
    for (const ReportTable& table : report.tables) {
        JsonObject columns;
        JsonObject& into = *table.name == '\0' ? json : columns;
        add_table(into, table);
        if (&into == &columns) json.add(table.name, columns.text());
    }
    return json.text();
}

}  // namespace swirl
