#include "lab/techniques/options.h"

#include "lab/scene/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace manylights::lab {

namespace {

std::string key_list(const TechniqueInfo& info) {
    std::string keys;
    for (const OptionInfo& option : info.options) keys += (keys.empty() ? "" : ", ") + option.key;
    return keys.empty() ? "it has none" : "its options are " + keys;
}

} // namespace

OptionReader::OptionReader(const TechniqueInfo& info, const OptionValues& values)
    : technique_(info.name), values_(values) {
    for (auto value = values.begin(); value != values.end(); ++value) {
        const std::string& key = value->first;
        if (std::ranges::none_of(info.options, [&](const OptionInfo& option) { return option.key == key; }))
            throw InputError(fmt::format("{}: unknown option '{}'; {}", info.name, key, key_list(info)));
        if (std::any_of(values.begin(), value, [&](const auto& earlier) { return earlier.first == key; }))
            throw InputError(fmt::format("{}: option '{}' is given twice", info.name, key));
    }
}

const std::string* OptionReader::find(const std::string& key) const {
    for (const auto& [name, value] : values_)
        if (name == key) return &value;
    return nullptr;
}

void OptionReader::refuse(const std::string& key, const std::string& value, const std::string& rule) const {
    throw InputError(fmt::format("{}: option {}={}: must be {}", technique_, key, value, rule));
}

std::uint32_t OptionReader::whole_number(const std::string& key, std::uint32_t fallback, std::uint32_t lowest,
                                         std::uint32_t highest) const {
    const std::string* text = find(key);
    if (!text) return fallback;
    std::uint32_t number = 0;
    const char* end = text->data() + text->size();
    const auto [stop, error] = std::from_chars(text->data(), end, number);
    if (error != std::errc() || stop != end || number < lowest || number > highest)
        refuse(key, *text, fmt::format("a whole number from {} to {}", lowest, highest));
    return number;
}

std::optional<float> OptionReader::positive_number(const std::string& key) const {
    const std::string* text = find(key);
    if (!text) return std::nullopt;
    float number = 0;
    const char* end = text->data() + text->size();
    const auto [stop, error] = std::from_chars(text->data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number) || !(number > 0))
        refuse(key, *text, "a finite number above 0");
    return number;
}

std::size_t OptionReader::choice(const std::string& key, std::span<const char* const> choices) const {
    const std::string* text = find(key);
    if (!text) return 0;
    std::string allowed;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (*text == choices[i]) return i;
        allowed += fmt::format("{}{}", i == 0 ? "" : ", ", choices[i]);
    }
    refuse(key, *text, "one of " + allowed);
}

} // namespace manylights::lab
